/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The end of an epoch: every grain is brought to this time, all times are re-zeroed, and the buckets of the event queue
 * and the contact time are tuned to the present rate of events. An epoch ends when the queue is empty, which depends on
 * the trajectory alone, not on how a caller divides a run. */
#include <math.h>

#include "md/epoch.h"
#include "md/grid.h"
#include "md/images.h"
#include "md/kicks.h"
#include "md/md_thermostat.h"
#include "md/row_motion.h"

enum { COLLISIONS_TO_MEASURE = 16 };

/* Measure the present mean free time per grain; each collision counts for both partners. */
static void measure_mean_free_time(gg_md *e, double span)
{
  gg_md_counts *k = &e->k;
  k->window_time += span;
  if (k->window_collisions < COLLISIONS_TO_MEASURE) return;
  k->mean_free_time = k->window_time * e->n / (2.0 * (double)k->window_collisions);
  k->window_time = 0;
  k->window_collisions = 0;
}

/* Time of the next event, or of any event before `soon`. */
static double earliest_event(const gg_md *e, double soon)
{
  double t = INFINITY;
  for (uint32_t i = 0; i < e->n && !(t < soon); i++)
    if (e->node[i].time < t) t = e->node[i].time;
  return t;
}

/* Move the centres of skins under shear to their positions at the start of the next epoch. */
static void move_skins(gg_md *e, double span)
{
  for (uint32_t i = 0; i < e->n; i++) {
    gg_vec *c = &e->search.lists.skin[i].centre;
    double x = c->x + e->model.shear_rate * (c->y - 0.5 * e->box.edge[1]) * span;
    c->x = gg_wrap(x, e->box.edge[0], e->box.inverse[0]);
  }
  gg_md_enter_grid(e);
  gg_md_fill_grid(e);
}

void gg_md_turn_spins(gg_md *e, double span)
{
  if (!e->model.turns) return;
  for (uint32_t i = 0; i < e->n; i++) e->spin[i].z += e->model.torque[gg_md_species_of(&e->grain[i])] * span;
}

bool gg_md_next_epoch(gg_md *e)
{
  double span = gg_md_queue_span(&e->queue), wait = earliest_event(e, 2 * span);
  if (!(wait < INFINITY)) return false; /* all grains are at rest, or move with their rows */
  if (gg_md_search_has_rows(e->search.kind) && e->search.rows.next_shift < wait) wait = e->search.rows.next_shift;
  if (e->k.next_kick < wait) wait = e->k.next_kick; /* events that it predicts have times in the next epoch */
  while (span < 0.5 * wait) span *= 2;              /* skip a long time without events */
  e->k.window_collisions += e->k.collisions - e->k.epoch_collisions;
  measure_mean_free_time(e, span);
  gg_md_move_images(e, span);
  for (uint32_t i = 0; i < e->n; i++) {
    gg_md_grain *g = &e->grain[i];
    g->r = gg_md_position(e, e->falls, g, span);
    g->v = gg_md_velocity(e, e->falls, g, span);
    g->t = 0;
    e->node[i].time -= span;
    e->node[i].collision -= span;
    if (e->last) e->last[i] -= span;
    e->node[i].skin_time -= span;
  }
  if (gg_md_search_has_rows(e->search.kind)) gg_md_move_rows(e, span);
  if (e->search.kind == GG_MD_NEIGHBOUR_LISTS && gg_model_is_sheared(&e->model)) move_skins(e, span);
  e->k.epoch_start += span;
  e->k.now -= span;
  e->k.mark -= span;
  gg_md_kicks_move(e, span);
  gg_md_turn_spins(e, span);
  e->k.stop -= span;
  if (gg_flow_of(e->model.flow)->frame != GG_LABORATORY) gg_md_kicks_follow(e, gg_md_follow_centre_of_mass(e));
  if (e->heat == GG_HEAT_SCALES && !e->model.linear_response) {
    span /= e->k.scale;
    gg_md_thermostat_fold(e);
  }
  gg_md_follow_contact_time(e);
  double events = (double)(e->k.events - e->k.epoch_events);
  gg_md_queue_reset(&e->queue, gg_md_bucket_width(fmax(events, 1) / span));
  for (uint32_t i = 0; i < e->n; i++) gg_md_queue_insert(&e->queue, e->node, i);
  e->k.epoch_events = e->k.events;
  e->k.epoch_collisions = e->k.collisions;
  return true;
}
