/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Texts and numbers that every reader of YAML 1.1 or 1.2 takes for the same texts and numbers. */
#include <stdio.h>
#include <string.h>
#include <strings.h>

#include "scene/fields.h"

/* Words that YAML 1.1 reads as truth values or as nothing. */
static bool is_reserved(const char *text)
{
  static const char *const words[] = {"y", "n", "yes", "no", "on", "off", "true", "false", "null", NULL};
  for (int i = 0; words[i]; i++)
    if (strcasecmp(text, words[i]) == 0) return true;
  return false;
}

/* A letter, then letters, digits and marks that mean nothing to YAML: no number, no indicator, no comment. */
static bool is_plain(const char *text)
{
  static const char letters[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ";
  static const char marks[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_./-+";
  return *text && strchr(letters, *text) && !text[strspn(text, marks)] && !is_reserved(text);
}

/* Bytes of the character of UTF-8 at `c` that only an escape can hold, as they break lines or cannot be printed (C1,
 * U+2028, U+2029, U+FEFF), with its number; 0: it stands for itself. */
static int escaped(const unsigned char *c, unsigned *number)
{
  if (c[0] < 0x20 || c[0] == 0x7f) return *number = c[0], 1;
  if (c[0] == 0xc2 && c[1] >= 0x80 && c[1] < 0xa0) return *number = c[1], 2;
  const bool separator = c[0] == 0xe2 && c[1] == 0x80 && (c[2] == 0xa8 || c[2] == 0xa9);
  const bool mark = c[0] == 0xef && c[1] == 0xbb && c[2] == 0xbf;
  if (separator || mark) return *number = (c[0] & 0xfu) << 12 | (c[1] & 0x3fu) << 6 | (c[2] & 0x3fu), 3;
  return 0;
}

void gg_scene_yaml_quoted_print(FILE *out, const char *text)
{
  unsigned number;
  fputc('"', out);
  for (const unsigned char *c = (const unsigned char *)text; *c;) {
    const int length = escaped(c, &number);
    if (length)
      fprintf(out, "\\u%04x", number);
    else
      fprintf(out, "%s%c", *c == '"' || *c == '\\' ? "\\" : "", *c);
    c += length ? length : 1;
  }
  fputc('"', out);
}

void gg_scene_yaml_text_print(FILE *out, const char *text)
{
  if (is_plain(text))
    fputs(text, out);
  else
    gg_scene_yaml_quoted_print(out, text);
}

/* "1e-07" is a text to YAML 1.1: a number has a point. */
void gg_scene_yaml_number(double value, char text[GG_NUMBER_TEXT])
{
  gg_io_number_format(value, text);
  char *exponent = strchr(text, 'e');
  if (!exponent || strchr(text, '.')) return;
  memmove(exponent + 2, exponent, strlen(exponent) + 1);
  memcpy(exponent, ".0", 2);
}
