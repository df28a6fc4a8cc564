/* SPDX-License-Identifier: GPL-3.0-or-later */
/* From positions and velocities to an engine that is ready to run. */
#include <math.h>

#include "base/memory.h"
#include "md/epoch.h"
#include "md/event_loops.h"
#include "md/grid.h"
#include "md/kicks.h"
#include "md/md_thermostat.h"
#include "md/start/all_grains.h"
#include "md/start/start.h"

/* Estimate of the temperature that a fall gives its grains, m g times a part of the height, if that is higher than T.
 * Events that come much faster than estimated would all be in one bucket for the whole first epoch. */
static double soon_temperature(const gg_md *e, double T)
{
  const double *g = e->model.gravity;
  return fmax(T, 0.01 * e->model.mass[0] * hypot(g[0], g[1]) * e->model.box[1]);
}

/* Expected event rate at the start: collisions (each predicted about 1.25 times) and crossings. */
static double guess_event_rate(const gg_md *e, double T)
{
  double rate = 0.625 * gg_common_model_collision_rate(&e->model, T);
  for (int a = 0; a < 3; a++) rate += 0.8 * sqrt(T) / e->cells.width[a];
  return e->n * fmax(rate, 1e-300);
}

static bool predict_some(gg_md *e, uint32_t from, uint32_t to)
{
  e->kernel->predict(e, from, to);
  return true;
}

static gg_status predict_all(gg_md *e, gg_error *err)
{
  for (uint32_t i = 0; i < e->n; i++) e->node[i].time = INFINITY;
  const gg_md_all_grains how = gg_md_for_all_grains(e, predict_some, e->model.stop);
  e->out_of_memory |= how == GG_MD_NO_MEMORY;
  if (how != GG_MD_ALL_DONE) return gg_md_start_stopped(e, err);
  for (uint32_t i = 0; i < e->n; i++) gg_md_queue_insert(&e->queue, e->node, i);
  return GG_OK;
}

static gg_status enter_all(gg_md *e, gg_error *err)
{
  if (e->search.kind == GG_MD_NEIGHBOUR_LISTS) {
    if (!gg_md_build_lists(e, e->model.stop)) return gg_md_start_stopped(e, err);
  } else {
    gg_md_enter_grid(e);
    GG_TRY(gg_md_poll_stop(e, err));
    if (!gg_md_fill_grid(e)) return gg_base_out_of_memory_for(err, "the grid of cells");
  }
  return gg_md_poll_stop(e, err);
}

gg_status gg_md_predict_anew(gg_md *e, gg_error *err)
{
  GG_TRY(enter_all(e, err));
  gg_md_queue_reset(&e->queue, e->queue.width);
  return predict_all(e, err);
}

gg_status gg_md_begin_at(gg_md *e, double T, gg_error *err)
{
  if (!e->cells.cell) GG_TRY(gg_md_make_grid(e, err));
  GG_TRY(gg_md_kicks_make(e, err));
  GG_TRY(gg_md_poll_stop(e, err));
  GG_TRY(enter_all(e, err));
  const double early = gg_md_early_temperature(e, T);
  e->k.mean_free_time = 1 / fmax(gg_common_model_collision_rate(&e->model, early), 1e-300);
  gg_md_begin_contact_time(e, T);
  if (e->last)
    for (uint32_t i = 0; i < e->n; i++) e->last[i] = -INFINITY;
  gg_md_queue_reset(&e->queue, gg_md_bucket_width(guess_event_rate(e, soon_temperature(e, early))));
  gg_md_select(e);
  gg_md_thermostat_begin(e);
  gg_md_kicks_begin(e);
  GG_TRY(gg_md_poll_stop(e, err));
  return predict_all(e, err);
}

gg_status gg_md_begin(gg_md *e, gg_error *err)
{
  return gg_md_begin_at(e, e->model.temperature0, err);
}
