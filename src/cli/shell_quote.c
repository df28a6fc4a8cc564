#include "cli/shell_quote.h"

#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* False: there was no room. (A text in memory leaves out what it has no room for, and its closing does not tell.) */
static bool put(FILE *out, const char *text)
{
  return fputs(text, out) >= 0;
}

static bool put_quoted(FILE *out, const char *text)
{
  static const char plain[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+./,:=@%";
  if (*text && text[strspn(text, plain)] == '\0') return put(out, text);
  bool whole = put(out, "'");
  for (; *text; text++) whole &= put(out, *text == '\'' ? "'\\''" : (char[]){*text, '\0'});
  return put(out, "'") && whole;
}

/* The text if it is whole; else NULL. */
static char *taken(FILE *out, bool whole, char **text)
{
  whole &= fclose(out) == 0;
  if (whole) return *text;
  free(*text);
  return NULL;
}

char *gg_cli_shell_quote(const char *text)
{
  char *quoted = NULL;
  size_t size;
  FILE *out = open_memstream(&quoted, &size);
  if (!out) return NULL;
  const bool whole = put_quoted(out, text);
  return taken(out, whole, &quoted);
}

char *gg_cli_command_line_quote(const gg_typed *typed, const char *added)
{
  char *text = NULL;
  size_t size;
  FILE *out = open_memstream(&text, &size);
  if (!out) return NULL;
  bool whole = put(out, "graingas");
  for (int i = 0; i < typed->n; i++) {
    if (i == typed->options_end) whole &= put(out, added);
    if (typed->word[i]) whole &= put(out, " ") && put_quoted(out, typed->word[i]);
  }
  if (typed->options_end == typed->n) whole &= put(out, added);
  return taken(out, whole, &text);
}
