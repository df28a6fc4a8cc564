/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Text that is safe to show on a terminal. */
#ifndef GG_BASE_PRINTABLE_H
#define GG_BASE_PRINTABLE_H

#include <stdbool.h>
#include <stddef.h>

/* Foreign texts: of files, of callbacks, of the command line. Printable is one line of UTF-8 without control characters
 * and marks of writing direction, which a terminal would act on. */
bool gg_base_text_is_printable(const char *text);
/* Replace unprintable characters by '?', in place. */
void gg_base_text_make_printable(char *text);
/* A letter, then letters, digits and _, at most `longest`: the name of a quantity, a curve, a theory. */
bool gg_base_text_is_name(const char *text, size_t longest);

#endif
