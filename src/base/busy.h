/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Guard of a handle of the public interface, in use by one call that changes it, or by any number that only read it.
 *
 * A call that comes in between, from a callback of the call in progress or from another thread, is an error and not
 * a crash. A handle that is freed in the meantime goes when the last call that uses it returns. */
#ifndef GG_BUSY_H
#define GG_BUSY_H

#include <stdatomic.h>
#include <stdbool.h>

#include "base/error.h"

typedef struct gg_busy {
  atomic_uint users;           /* calls that read; or GG_BUSY_ALONE; and GG_BUSY_FREED */
  _Atomic(const char *) user;  /* the call that changes it */
  _Atomic(const void *) owner; /* the thread of that call */
  const char *what;            /* "simulation" */
  void (*destroy)(void *handle);
  void *handle;
} gg_busy;

enum { GG_BUSY_ALONE = 1 << 20, GG_BUSY_FREED = 1 << 21 };

void gg_base_busy_init(gg_busy *busy, const char *what, void (*destroy)(void *handle), void *handle);
/* Destroy the handle, now or when the last call returns. */
void gg_base_busy_free(gg_busy *busy);
/* True if the call in progress is one of this thread, so that the present one comes from its callback. */
bool gg_base_busy_is_inside(const gg_busy *busy);
/* True if the handle was freed while a call uses it. */
static inline bool gg_base_busy_is_freed(const gg_busy *busy)
{
  return (atomic_load_explicit(&busy->users, memory_order_relaxed) & GG_BUSY_FREED) != 0;
}

typedef struct gg_use {
  gg_busy *busy;
  bool alone;
} gg_use;

/* GG_BAD_INPUT: the handle is in use, or another call changes it. */
gg_status gg_base_use_begin(gg_use *use, const gg_busy *busy, bool alone, const char *function, gg_error *err);
void gg_base_use_end(gg_use *use);

/* Declarations: until the end of the block the call has the handle for itself, or reads it. They return a failure. */
#define GG_USE_ALONE(handle) GG_USE(handle, true)
#define GG_USE_READING(handle) GG_USE(handle, false)
#define GG_USE(handle, alone)                                                                                          \
  __attribute__((cleanup(gg_base_use_end))) gg_use use_of_##handle = {NULL, false};                                    \
  GG_TRY(gg_base_use_begin(&use_of_##handle, &(handle)->busy, alone, __func__, err))

#endif
