/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "md/start/all_grains.h"

#include <stdatomic.h>

#include "base/memory.h"
#include "base/thread_pool.h"
#include "md/parallel/parallel.h"

enum { PARTS = 16 };

typedef struct work {
  gg_md *local[PARTS];
  int parts;
  gg_md_for_grains *part;
  const gg_stop *stop;
  _Atomic int state; /* gg_md_all_grains */
} work;

static void run_part(void *context, int self)
{
  work *w = context;
  gg_md *e = w->local[self];
  const uint64_t n = e->n, parts = (uint64_t)w->parts;
  const uint32_t end = (uint32_t)(n * (uint64_t)(self + 1) / parts);
  for (uint32_t from = (uint32_t)(n * (uint64_t)self / parts), to; from < end; from = to) {
    if (atomic_load(&w->state) != GG_MD_ALL_DONE) return;
    to = end - from > GG_MD_GRAINS_PER_POLL ? from + GG_MD_GRAINS_PER_POLL : end;
    if (!w->part(e, from, to)) atomic_store(&w->state, GG_MD_GIVEN_UP);
    if (to < n && gg_stop_asked(w->stop)) atomic_store(&w->state, GG_MD_STOPPED);
  }
}

static bool make_local_engines(work *w, const gg_md *e)
{
  for (int k = 0; k < w->parts; k++) {
    if (!(w->local[k] = gg_md_local_new())) return false;
    gg_md_local_renew(w->local[k], e);
  }
  return true;
}

gg_md_all_grains gg_md_for_all_grains(gg_md *e, gg_md_for_grains *part, const gg_stop *stop)
{
  const int threads = e->n < GG_MD_FEWEST_PARALLEL ? 1 : e->model.threads;
  work w = {.part = part, .stop = stop, .parts = threads > 1 ? PARTS : 1, .state = GG_MD_NO_MEMORY};
  gg_thread_pool *pool = gg_base_thread_pool_new(threads);
  if (make_local_engines(&w, e)) {
    atomic_store(&w.state, GG_MD_ALL_DONE);
    gg_base_thread_pool_for(pool, w.parts, run_part, &w);
  }
  gg_base_thread_pool_free(pool);
  for (int k = 0; k < w.parts; k++) gg_md_local_free(w.local[k]);
  return (gg_md_all_grains)atomic_load(&w.state);
}

gg_status gg_md_start_stopped(const gg_md *e, gg_error *err)
{
  if (e->out_of_memory) return gg_base_out_of_memory_for(err, "the start of md");
  return gg_base_fail(err, GG_INTERRUPTED, "md: stopped at the start");
}

gg_status gg_md_poll_stop(const gg_md *e, gg_error *err)
{
  return e->n > GG_MD_GRAINS_PER_POLL && gg_stop_asked(e->model.stop) ? gg_md_start_stopped(e, err) : GG_OK;
}
