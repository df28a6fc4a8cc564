/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Functions with the sizes of the caller's structs (graingas.h, "Sizes"). A struct that is read is zero beyond what the
 * caller's compiler knew of it; of one that is written the caller gets what it knew of. */
#ifndef GG_API_SIZED_H
#define GG_API_SIZED_H

#include <string.h>

#include "api/api.h"

/* text.c: the caller may know less of a struct than the library, not more. */
gg_status gg_api_size_check(const char *function, const char *type, size_t size, size_t own, gg_error *err);

#define GG_SIZE(type, size) GG_TRY(gg_api_size_check(__func__, #type, size, sizeof(type), err))

#define GG_READS(function, type, from, parameters, arguments)                                                          \
  gg_status function##_sized parameters                                                                                \
  {                                                                                                                    \
    type own = {0};                                                                                                    \
    GG_SIZE(type, size);                                                                                               \
    if (from) memcpy(&own, from, size), from = &own;                                                                   \
    return function arguments;                                                                                         \
  }

#define GG_WRITES(function, type, into, parameters, arguments)                                                         \
  gg_status function##_sized parameters                                                                                \
  {                                                                                                                    \
    type own, *const theirs = into;                                                                                    \
    GG_SIZE(type, size);                                                                                               \
    if (into) into = &own;                                                                                             \
    GG_TRY(function arguments);                                                                                        \
    if (theirs) memcpy(theirs, &own, size);                                                                            \
    return GG_OK;                                                                                                      \
  }

#endif
