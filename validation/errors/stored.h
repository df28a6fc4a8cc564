/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Series on disk: NAME.f64, doubles one after another; NAME.txt, a line with how many there are, their integrated
 * correlation time in rows, and the true mean. */
#ifndef GG_ERRORS_STORED_H
#define GG_ERRORS_STORED_H

#include <stdbool.h>
#include <stddef.h>

typedef struct stored {
  size_t n;
  double time, truth;
  double *y; /* owned; NULL when it is only written */
} stored;

/* false, with a message on standard error, where the files cannot be written or read. */
bool stored_write(const char *folder, const char *name, const double *y, size_t n, double time, double truth);
bool stored_read(const char *folder, const char *name, stored *s);

#endif
