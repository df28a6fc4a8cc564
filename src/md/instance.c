/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One instance of the event loop: compiled once for each row of the table in meson.build (search/features.h). */
#include GG_SEARCH

#include "md/event_loop.h"

#define JOIN2(a, b) a##b
#define JOIN(a, b) JOIN2(a, b)

static void run(gg_md *e)
{
  gg_md_run_events(e);
}

/* Predict grains from scratch at a start. */
static void predict(gg_md *e, uint32_t from, uint32_t to)
{
  for (uint32_t i = from; i < to; i++) gg_md_predict(e, i);
  gg_md_queue_store_pending(&e->queue, e->node);
}

/* The same for two grains after a kick. */
static void predict_two(gg_md *e, uint32_t i, uint32_t j)
{
  gg_md_predict_two(e, i, j, false);
  gg_md_queue_store_pending(&e->queue, e->node);
}

const gg_md_kernel JOIN(gg_md_kernel_, GG_INSTANCE) = {run, predict, predict_two};
