/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cli/outputs.h"

#include <ctype.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "cli/print.h"

/* Endings begin with a letter: ".h5" is an ending, the ".1" of "phi_0.1" is not. */
char *gg_cli_path_with_suffix(const char *path, const char *suffix)
{
  const char *slash = strrchr(path, '/'), *name = slash ? slash + 1 : path, *dot = strrchr(name, '.');
  bool ends = dot && dot > name && isalpha((unsigned char)dot[1]);
  char *result = NULL;
  return asprintf(&result, "%.*s%s", (int)(ends ? dot - path : (long)strlen(path)), path, suffix) < 0 ? NULL : result;
}

char *gg_cli_path_of_checkpoint(const char *output)
{
  char *path = NULL;
  const int length = (int)strlen(output) - (gg_cli_has_ending(output, ".h5") ? 3 : 0);
  return asprintf(&path, "%.*s.checkpoint.h5", length, output) < 0 ? NULL : path;
}

char *gg_cli_options_beside(const gg_options *o, const char *suffix)
{
  const char *slash = strrchr(o->input, '/');
  return gg_cli_path_with_suffix(strcmp(o->input, "-") == 0 ? "stdin" : slash ? slash + 1 : o->input, suffix);
}

bool gg_cli_file_is_same(const char *a, const char *b)
{
  struct stat one, two;
  return stat(a, &one) == 0 && stat(b, &two) == 0 && one.st_dev == two.st_dev && one.st_ino == two.st_ino;
}

char *gg_cli_options_output(const gg_options *o, const char *suffix, gg_error *err)
{
  char *output = o->output ? strdup(o->output) : gg_cli_options_beside(o, suffix);
  if (!output) gg_cli_refuse(err, GG_FAILED, "out of memory");
  if (!output || o->extend || !gg_cli_file_is_same(output, o->input)) return output;
  gg_cli_refuse(err, GG_BAD_INPUT, "%s: would be overwritten by its own result; choose another --output", o->input);
  free(output);
  return NULL;
}

bool gg_cli_file_exists(const char *path)
{
  struct stat about;
  return stat(path, &about) == 0;
}

bool gg_cli_file_is_device(const char *path)
{
  struct stat about;
  return stat(path, &about) == 0 && !S_ISREG(about.st_mode) && !S_ISDIR(about.st_mode);
}

void gg_cli_report_written(const gg_options *o, const char *what, const char *path, bool replaced)
{
  fflush(stdout);
  if (o->quiet) return;
  fprintf(stderr, "%s: ", what);
  gg_cli_print_name(stderr, "", path, replaced ? " (in place of an older one)\n" : "\n");
}

/* Write to a memory stream; false if memory was insufficient. fclose() would not report the missing text. */
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

/* Close a memory stream; the text if all writes succeeded, otherwise NULL. */
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

char *gg_cli_command_line_quote(const char *program, const gg_command_line *line, const char *added)
{
  char *text = NULL;
  size_t size;
  FILE *out = open_memstream(&text, &size);
  if (!out) return NULL;
  bool whole = put_quoted(out, program);
  for (int i = 0; i < line->n; i++) {
    if (i == line->options_end) whole &= put(out, added);
    if (line->word[i]) whole &= put(out, " ") && put_quoted(out, line->word[i]);
  }
  if (line->options_end == line->n) whole &= put(out, added);
  return taken(out, whole, &text);
}
