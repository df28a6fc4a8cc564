/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/printable.h"

#include <string.h>

/* Bytes of the UTF-8 character that begins here, 0 if none does. */
static size_t character(const unsigned char *c)
{
  size_t n = *c < 0x80                 ? 1
             : *c >= 0xc2 && *c < 0xe0 ? 2
             : *c >= 0xe0 && *c < 0xf0 ? 3
             : *c >= 0xf0 && *c < 0xf5 ? 4
                                       : 0;
  for (size_t k = 1; k < n; k++)
    if ((c[k] & 0xc0) != 0x80) return 0;
  bool overlong = (c[0] == 0xe0 && c[1] < 0xa0) || (c[0] == 0xf0 && c[1] < 0x90);
  bool beyond = (c[0] == 0xed && c[1] > 0x9f) || (c[0] == 0xf4 && c[1] > 0x8f);
  return overlong || beyond ? 0 : n;
}

/* Control characters, line and paragraph separators, and what changes the direction of writing or is not seen. */
static bool is_control(const unsigned char *c, size_t bytes)
{
  if (bytes == 1) return *c < ' ' || *c == 0x7f;
  if (bytes == 2) return (c[0] == 0xc2 && c[1] < 0xa0) || (c[0] == 0xd8 && c[1] == 0x9c);
  if (bytes == 4) return c[0] == 0xf3 && c[1] == 0xa0; /* invisible tags */
  const unsigned code = (c[0] & 15u) << 12 | (c[1] & 63u) << 6 | (c[2] & 63u);
  return (code >= 0x200b && code <= 0x200f) || (code >= 0x2028 && code <= 0x202e) ||
         (code >= 0x2060 && code <= 0x206f) || code == 0xfeff;
}

bool gg_base_text_is_printable(const char *text)
{
  for (const unsigned char *c = (const unsigned char *)text; *c; c += character(c))
    if (!character(c) || is_control(c, character(c))) return false;
  return true;
}

void gg_base_text_make_printable(char *text)
{
  char *to = text;
  for (const unsigned char *c = (const unsigned char *)text; *c;) {
    const size_t bytes = character(c);
    if (bytes && !is_control(c, bytes))
      memmove(to, c, bytes), to += bytes;
    else
      *to++ = '?';
    c += bytes ? bytes : 1;
  }
  *to = '\0';
}

/* In any locale. */
static bool is_letter(char c)
{
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

bool gg_base_text_is_name(const char *text, size_t longest)
{
  bool good = is_letter(*text) && strlen(text) <= longest;
  for (const char *c = text; *c; c++) good &= is_letter(*c) || (*c >= '0' && *c <= '9') || *c == '_';
  return good;
}
