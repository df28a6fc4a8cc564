/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/busy.h"

#include <stddef.h>
#include <stdint.h>

/* A thread is known by the place of its own copy. */
static const void *this_thread(void)
{
  static _Thread_local char place;
  return &place;
}

void gg_base_busy_init(gg_busy *busy, const char *what, void (*destroy)(void *handle), void *handle)
{
  atomic_init(&busy->users, 0);
  atomic_init(&busy->user, NULL);
  atomic_init(&busy->owner, NULL);
  busy->what = what;
  busy->destroy = destroy;
  busy->handle = handle;
}

void gg_base_busy_free(gg_busy *busy)
{
  if (atomic_fetch_or(&busy->users, GG_BUSY_FREED) == 0) busy->destroy(busy->handle);
}

bool gg_base_busy_is_inside(const gg_busy *busy)
{
  return (atomic_load(&busy->users) & GG_BUSY_ALONE) && atomic_load(&busy->owner) == this_thread();
}

static gg_status refuse(const gg_busy *busy, const char *function, gg_error *err)
{
  const char *user = atomic_load(&busy->user);
  if (gg_base_busy_is_freed(busy))
    return GG_REFUSE(err, "%s: the %s was freed; make another one", function, busy->what);
  if (gg_base_busy_is_inside(busy))
    return GG_REFUSE(err, "%s: called from a callback of %s, which uses this %s; call it after %s has returned",
                     function, user, busy->what, user);
  if (!(atomic_load(&busy->users) & GG_BUSY_ALONE))
    return GG_REFUSE(err, "%s: a call in progress reads this %s; call it after that has returned", function,
                     busy->what);
  return GG_REFUSE(err, "%s: another thread uses this %s; use it in one thread at a time, or one %s in each thread",
                   function, busy->what, busy->what);
}

gg_status gg_base_use_begin(gg_use *use, const gg_busy *handle, bool alone, const char *function, gg_error *err)
{
  gg_busy *busy = (gg_busy *)(uintptr_t)handle; /* calls that only read leave all but the count of users */
  unsigned users = 0;
  if (alone) {
    if (!atomic_compare_exchange_strong(&busy->users, &users, GG_BUSY_ALONE)) return refuse(busy, function, err);
    atomic_store(&busy->owner, this_thread());
    atomic_store(&busy->user, function);
  } else {
    do
      if (users >= GG_BUSY_ALONE) return refuse(busy, function, err);
    while (!atomic_compare_exchange_weak(&busy->users, &users, users + 1));
  }
  *use = (gg_use){busy, alone};
  return GG_OK;
}

void gg_base_use_end(gg_use *use)
{
  gg_busy *busy = use->busy;
  if (!busy) return;
  const unsigned mine = use->alone ? GG_BUSY_ALONE : 1;
  void (*destroy)(void *handle) = busy->destroy; /* afterwards the handle may be gone */
  void *handle = busy->handle;
  if (use->alone) atomic_store(&busy->owner, NULL);
  if (atomic_fetch_sub(&busy->users, mine) == (mine | GG_BUSY_FREED)) destroy(handle);
}
