/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Errors are values: every call that can fail returns a status and fills a message a user can act on. */
#ifndef GG_ERROR_H
#define GG_ERROR_H

#include "base/status.h" /* made of the public header (src/base/meson.build) */

#define GG_PRINTF(fmt, args) __attribute__((format(printf, fmt, args)))

/* Write the message (err may be NULL) and return the status, so that a call site reads `return gg_base_fail(...)`. */
gg_status gg_base_fail(gg_error *err, gg_status status, const char *format, ...) GG_PRINTF(3, 4);

/* Put `prefix: ` before a message already there (a file name, a scene key), and pass the status on. */
gg_status gg_base_error_prefix(gg_error *err, gg_status status, const char *format, ...) GG_PRINTF(3, 4);

/* Propagate: leave the calling function with the status of a failed call. */
#define GG_TRY(call)                                                                                                   \
  do {                                                                                                                 \
    gg_status gg_try_status = (call);                                                                                  \
    if (gg_try_status != GG_OK) return gg_try_status;                                                                  \
  } while (0)

/* The commonest failure: bad input. */
#define GG_REFUSE(err, ...) gg_base_fail(err, GG_BAD_INPUT, __VA_ARGS__)

#endif
