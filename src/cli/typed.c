#include "cli/typed.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void put_quoted(FILE *out, const char *text)
{
  static const char plain[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+./,:=@%";
  if (*text && text[strspn(text, plain)] == '\0') {
    fputs(text, out);
    return;
  }
  fputc('\'', out);
  for (; *text; text++) fputs(*text == '\'' ? "'\\''" : (char[]){*text, '\0'}, out);
  fputc('\'', out);
}

char *gg_quoted(const char *text)
{
  char *quoted = NULL;
  size_t size;
  FILE *out = open_memstream(&quoted, &size);
  if (!out) return NULL;
  put_quoted(out, text);
  if (fclose(out) == 0) return quoted;
  free(quoted);
  return NULL;
}

char *gg_typed_again(const gg_typed *typed, const char *added)
{
  char *text = NULL;
  size_t size;
  FILE *out = open_memstream(&text, &size);
  if (!out) return NULL;
  fputs("graingas", out);
  for (int i = 0; i < typed->n; i++) {
    if (i == typed->options_end) fputs(added, out);
    if (!typed->word[i]) continue;
    fputc(' ', out);
    put_quoted(out, typed->word[i]);
  }
  if (typed->options_end == typed->n) fputs(added, out);
  if (fclose(out) == 0) return text;
  free(text);
  return NULL;
}
