/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "script.h"

#include <ctype.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_PIXELS = 20000 };

static void refuse(const char *why, const char *line, size_t length)
{
  fprintf(stderr, "a script for gnuplot with %s: %.*s\n", why, (int)length, line);
  abort();
}

static bool begins(const char *line, const char *with)
{
  return strncmp(line, with, strlen(with)) == 0;
}

/* True for the commands that set up a page, a panel or a curve. None of them takes a file name or a shell command. */
static bool is_known(const char *line)
{
  static const char *const known[] = {
      "set arrow ",    "set bmargin ",  "set border ", "set encoding ", "set errorbars ",
      "set format ",   "set grid ",     "set key ",    "set label ",    "set lmargin ",
      "set logscale ", "set multiplot", "set object ", "set offsets ",  "set pointintervalbox ",
      "set rmargin ",  "set terminal ", "set tics ",   "set title ",    "set tmargin ",
      "set xlabel ",   "set xrange ",   "set xtics ",  "set ylabel ",   "set yrange ",
      "set ytics ",    "unset ",        "plot ",       "set style "};
  for (size_t i = 0; i < sizeof known / sizeof *known; i++)
    if (begins(line, known[i])) return true;
  return false;
}

/* Index after the quoted text that starts at `at`. */
static size_t text_end(const char *line, size_t at, size_t length)
{
  const char quote = line[at++];
  while (at < length && line[at] != quote) {
    const bool escape = quote == '"' && line[at] == '\\';
    if (escape) at++;
    if ((escape && !strchr("n\\", line[at])) || (quote == '"' && line[at] == '`'))
      refuse("what a double quote lets through", line, length);
    at++;
  }
  if (at >= length) refuse("a text without an end", line, length);
  return at + 1;
}

/* False if a quoted text in `plot` names data: a file or a shell command. After a word such as `title` it does not. */
static bool follows_word(const char *line, size_t at)
{
  while (at > 0 && line[at - 1] == ' ') at--;
  return at > 0 && isalpha((unsigned char)line[at - 1]) && !(at == 4 && begins(line, "plot"));
}

static void check_command(const char *line, size_t length)
{
  if (!is_known(line)) refuse("a command that it does not need", line, length);
  for (size_t at = 0; at < length;) {
    const char c = line[at];
    if (c == '\'' || c == '"') {
      if (begins(line, "plot") && !follows_word(line, at)) refuse("data from a file", line, length);
      at = text_end(line, at, length);
    } else {
      if (c == '`' || c == '!' || c == ';' || c == '\\' || c == '#' || c == '<' || c == '@')
        refuse("a letter that runs something", line, length);
      at++;
    }
  }
}

static void check_number(const char *line, size_t length)
{
  for (size_t i = 0; i < length; i++)
    if (!strchr("0123456789+-.e naif", line[i])) refuse("data that are no numbers", line, length);
}

static void check_size(const char *line, size_t length)
{
  const char *size = strstr(line, " size ");
  double wide = 0, tall = 0; /* pixels; inches for PDF */
  if (!begins(line, "set terminal ")) return;
  if (!size || size > line + length || sscanf(size, " size %lf,%lf", &wide, &tall) != 2 || wide < 1 || tall < 1 ||
      wide > MOST_PIXELS || tall > MOST_PIXELS)
    refuse("a page that nobody can draw", line, length);
}

static void check_letters(const char *line, size_t length)
{
  for (size_t i = 0; i < length; i++)
    if ((unsigned char)line[i] < ' ') refuse("a control character", line, length);
}

/* "$curve0 << EOD" */
static bool opens_block(const char *line, size_t length)
{
  size_t at = 1;
  if (line[0] != '$') return false;
  while (at < length && isalnum((unsigned char)line[at])) at++;
  return at > 1 && length == at + 7 && begins(line + at, " << EOD");
}

void fuzz_check_script(const char *script)
{
  bool in_block = false;
  while (*script) {
    const size_t length = strcspn(script, "\n");
    check_letters(script, length);
    if (in_block && length == 3 && begins(script, "EOD")) {
      in_block = false;
    } else if (in_block) {
      check_number(script, length);
    } else if (opens_block(script, length)) {
      in_block = true;
    } else if (length) {
      check_command(script, length);
      check_size(script, length);
    }
    script += length + (script[length] == '\n');
  }
  if (in_block) refuse("data without an end", "", 0);
}
