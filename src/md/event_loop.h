/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The event loop: pop, re-check, advance the pair, collide, re-predict.
 *
 * Each grain has one entry in the event queue: the earliest of its predicted collisions and its next crossing. No
 * collision is missed: of every pair the grain that was predicted last knew the present motion of the other, so its
 * entry is no later than their contact. If the partner has collided since, by its collision counter, the predicted time
 * was only a lower limit: the grain is re-predicted at that time. */
#ifndef GG_MD_EVENT_LOOP_H
#define GG_MD_EVENT_LOOP_H

#include "md/epoch.h"
#include "md/resolution.h"
#include "md/search/near_surfaces.h"
#include "md/search/neighbour_search.h"
#include "md/search/simd_pairs.h"

/* Replace the entry of a grain in the event queue, which is not deferred, by the result of a search. The new entry is
 * deferred to the schedule of the next event: by then the line of its bucket has arrived. `is_next`, a constant: the
 * grain is that of the event in progress, whose entry is the next one. */
GG_INLINE void gg_md_schedule_at(gg_md *e, gg_md_search *s, int place, bool is_next)
{
  gg_md_node *node = &e->node[s->grain];
  if (IS_WALLED) gg_md_try_surfaces(e, s);
  if (s->partner != node->partner || s->collision != node->collision) {
    node->collision = s->collision;
    node->partner = s->partner;
    node->counter = GG_MD_NO_GRAIN(s->partner) ? 0 : e->grain[s->partner].counter;
  }
  double crossing = gg_md_next_crossing(e, s, &node->face);
  if (is_next)
    gg_md_queue_remove_next(&e->queue);
  else
    gg_md_queue_remove(&e->queue, e->node, s->grain);
  node->time = s->collision < crossing ? s->collision : crossing;
  gg_md_queue_defer(&e->queue, e->node, s->grain, place);
}

GG_INLINE void gg_md_schedule(gg_md *e, gg_md_search *s, bool is_next)
{
  gg_md_queue_store_pending(&e->queue, e->node);
  gg_md_schedule_at(e, s, 0, is_next);
}

/* Search from scratch for a grain whose record is at the present time. The record is not written: at a start several
 * threads predict at once. */
GG_INLINE void gg_md_search_anew(gg_md *e, gg_md_search *s, uint32_t i)
{
  e->node[i].collision = INFINITY;
  e->node[i].partner = GG_MD_NONE;
  gg_md_begin_search(s, i, &e->grain[i], INFINITY, GG_MD_NONE);
  gg_md_search_all(e, s);
}

GG_INLINE void gg_md_predict_in_place(gg_md *e, uint32_t i, bool is_next)
{
  gg_md_search s = {.candidates = e->candidates};
  gg_md_search_anew(e, &s, i);
  gg_md_schedule(e, &s, is_next);
}

/* The same as a call, for rare events. */
static __attribute__((noinline)) void gg_md_predict(gg_md *e, uint32_t i)
{
  gg_md_predict_in_place(e, i, false);
}

/* Re-predict a grain whose partner has collided since. */
GG_INLINE void gg_md_re_predict(gg_md *e, uint32_t i)
{
  gg_md_synchronise(e, i);
  if (PREDICTS_IN_PLACE)
    gg_md_predict_in_place(e, i, true);
  else
    gg_md_predict(e, i);
}

/* Predict two grains. Both searches precede both insertions into the event queue, so the processor overlaps them. */
GG_INLINE void gg_md_predict_two(gg_md *e, uint32_t i, uint32_t j, bool i_is_next)
{
  gg_md_search one = {.candidates = e->candidates}, two = {.candidates = e->candidates + GG_MD_CANDIDATES_APART};
  gg_md_search_anew(e, &one, i);
  gg_md_search_anew(e, &two, j);
  gg_md_schedule(e, &one, i_is_next);
  gg_md_schedule_at(e, &two, 1, false);
}

GG_INLINE void gg_md_collide(gg_md *e, uint32_t i, uint32_t j)
{
  const bool again = (e->grain[i].t == e->k.now) & (e->grain[j].t == e->k.now);
  gg_md_grain *one = gg_md_synchronise(e, i), *two = gg_md_synchronise(e, j);
  gg_vec dr = gg_sub(two->r, one->r), dv = gg_sub(two->v, one->v);
  gg_md_minimum_image(&e->box, IS_SHEARED, e->k.now, &dr, &dv);
  (__builtin_expect(again, 0) ? gg_md_resolve_again : e->resolve)(e, i, j, dr, gg_scale(-1, dv));
  one->counter++;
  two->counter++;
  e->k.collisions++;
  e->k.collisions_left--;
  if (gg_md_is_velocity(e, one) && gg_md_is_velocity(e, two)) gg_md_predict_two(e, i, j, true);
}

GG_INLINE void gg_md_hit_surface(gg_md *e, uint32_t i, int surface)
{
  gg_md_grain *g = gg_md_synchronise(e, i);
  e->resolve_surface(e, i, surface);
  g->counter++;
  if (gg_md_is_velocity(e, g)) gg_md_predict(e, i);
}

/* Prefetch the data of all events of a new bucket, and the nodes that the bucket after it names. */
GG_INLINE void gg_md_prefetch_bucket(const gg_md *e)
{
  const gg_md_bucket *next = e->queue.bucket + e->queue.current + 1;
  if (e->n <= CACHED) return;
  for (uint32_t k = 0; k < next->count; k++) __builtin_prefetch(&e->node[next->grain[k]]);
  for (uint32_t k = 0; k < e->queue.n_due; k++) {
    uint32_t i = e->queue.due[k].grain;
    __builtin_prefetch(&e->grain[i]);
    gg_md_prefetch_due(e, i, e->node[i].partner);
  }
}

/* Prefetch the data of the next event but one. */
GG_INLINE void gg_md_prefetch_next(const gg_md *e)
{
  uint32_t n = e->queue.n_due;
  if (n < 2) return;
  if (e->n <= CACHED)
    gg_md_prefetch_cached(e, e->queue.due[n - 2].grain);
  else
    gg_md_prefetch_ahead(e, e->queue.due[n - 2].grain);
}

/* Grain of the next event; GG_MD_NONE: none before e->k.stop. Rows shift after all events up to that time and before
 * all later ones, so shifts depend on the trajectory alone. */
GG_INLINE uint32_t gg_md_next(gg_md *e)
{
  for (;;) {
    while (e->queue.n_due == 0)
      if (gg_md_queue_next_bucket(&e->queue, e->node))
        gg_md_prefetch_bucket(e);
      else if (ROWS_SHIFT && e->search.rows.next_shift <= gg_md_queue_span(&e->queue) &&
               e->search.rows.next_shift <= e->k.stop)
        gg_md_shift_all(e);
      else if (gg_md_queue_span(&e->queue) > e->k.stop)
        return GG_MD_NONE;
      else if (!gg_md_next_epoch(e))
        return GG_MD_NONE;
    gg_md_due due = e->queue.due[e->queue.n_due - 1];
    if (ROWS_SHIFT && e->search.rows.next_shift < due.time && e->search.rows.next_shift <= e->k.stop)
      gg_md_shift_all(e);
    else
      return due.time <= e->k.stop ? due.grain : GG_MD_NONE;
  }
}

GG_INLINE void gg_md_run_events(gg_md *e)
{
  uint32_t i;
  while (e->k.collisions_left && e->k.events < e->look_at && (i = gg_md_next(e)) != GG_MD_NONE) {
    gg_md_prefetch_next(e);
    const gg_md_node *node = &e->node[i];
    uint32_t partner = node->partner;
    e->k.now = node->time;
    e->k.events++;
    if (node->time < node->collision)
      gg_md_cross(e, i);
    else if (IS_WALLED && GG_MD_NO_GRAIN(partner))
      gg_md_hit_surface(e, i, GG_MD_SURFACE_OF(partner));
    else if (e->grain[partner].counter != node->counter)
      gg_md_re_predict(e, i);
    else
      gg_md_collide(e, i, partner);
  }
  gg_md_queue_store_pending(&e->queue, e->node);
}

#endif
