/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The event loop: pop, re-check, advance the pair, collide, re-predict.
 *
 * Each grain has one entry in the event queue: the earliest of the collisions that it saw when it was last predicted
 * and of its next crossing. That no collision is missed: for every pair the one predicted last saw the other as it
 * moves now, so its entry is no later than their contact. A collision whose partner has collided since (its counter
 * tells) was merely a lower limit: the grain is re-predicted when that time comes. */
#ifndef GG_MD_EVENT_LOOP_H
#define GG_MD_EVENT_LOOP_H

#include "md/epoch.h"
#include "md/resolution.h"
#include "md/search/near_surfaces.h"
#include "md/search/neighbour_search.h"
#include "md/search/simd_pairs.h"

GG_INLINE void gg_md_schedule(gg_md *e, gg_md_search *s)
{
  gg_md_node *node = &e->node[s->grain];
  if (IS_WALLED) gg_md_try_surfaces(e, s);
  if (s->partner != node->partner || s->collision != node->collision) {
    node->collision = s->collision;
    node->partner = s->partner;
    node->counter = GG_MD_NO_GRAIN(s->partner) ? 0 : e->grain[s->partner].counter;
  }
  double crossing = gg_md_next_crossing(e, s, &node->face);
  gg_md_queue_remove(&e->queue, e->node, s->grain);
  node->time = s->collision < crossing ? s->collision : crossing;
  gg_md_queue_insert(&e->queue, e->node, s->grain);
}

/* Its record stands at the present time, and is not written: at a start threads predict side by side. */
GG_INLINE void gg_md_search_anew(gg_md *e, gg_md_search *s, uint32_t i)
{
  e->node[i].collision = INFINITY;
  e->node[i].partner = GG_MD_NONE;
  gg_md_begin_search(s, i, &e->grain[i], INFINITY, GG_MD_NONE);
  gg_md_search_all(e, s);
}

GG_INLINE void gg_md_predict_in_place(gg_md *e, uint32_t i)
{
  gg_md_search s = {.candidates = e->candidates};
  gg_md_search_anew(e, &s, i);
  gg_md_schedule(e, &s);
}

/* A call, for what is rare. */
static __attribute__((noinline)) void gg_md_predict(gg_md *e, uint32_t i)
{
  gg_md_predict_in_place(e, i);
}

/* The partner has collided since. */
GG_INLINE void gg_md_re_predict(gg_md *e, uint32_t i)
{
  gg_md_synchronise(e, i);
  if (PREDICTS_IN_PLACE)
    gg_md_predict_in_place(e, i);
  else
    gg_md_predict(e, i);
}

/* Both searches before either goes into the event queue: the processor works on both at a time. */
GG_INLINE void gg_md_predict_two(gg_md *e, uint32_t i, uint32_t j)
{
  gg_md_search one = {.candidates = e->candidates}, two = {.candidates = e->candidates + GG_MD_CANDIDATES_APART};
  gg_md_search_anew(e, &one, i);
  gg_md_search_anew(e, &two, j);
  gg_md_schedule(e, &one);
  gg_md_schedule(e, &two);
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
  if (gg_md_is_velocity(e, one) && gg_md_is_velocity(e, two)) gg_md_predict_two(e, i, j);
}

GG_INLINE void gg_md_hit_surface(gg_md *e, uint32_t i, int surface)
{
  gg_md_grain *g = gg_md_synchronise(e, i);
  e->resolve_surface(e, i, surface);
  g->counter++;
  if (gg_md_is_velocity(e, g)) gg_md_predict(e, i);
}

/* Bring what the events of a new bucket will read into the cache while the first of them are handled. */
GG_INLINE void gg_md_prefetch_bucket(const gg_md *e)
{
  if (e->n <= CACHED) return;
  for (uint32_t k = 0; k < e->queue.n_due; k++) {
    uint32_t i = e->queue.due[k].grain;
    __builtin_prefetch(&e->grain[i]);
    gg_md_prefetch_due(e, i, e->node[i].partner);
  }
}

/* While one event is handled, what the next but one will read is on its way. */
GG_INLINE void gg_md_prefetch_next(const gg_md *e)
{
  uint32_t n = e->queue.n_due;
  if (n < 2) return;
  if (e->n <= CACHED)
    gg_md_prefetch_cached(e, e->queue.due[n - 2].grain);
  else
    gg_md_prefetch_ahead(e, e->queue.due[n - 2].grain);
}

/* The next event of all; GG_MD_NONE if there is none before e->k.stop. Rows shift after all events up to then and
 * before all later ones: a matter of the trajectory alone. */
GG_INLINE uint32_t gg_md_next(gg_md *e)
{
  for (;;) {
    while (e->queue.n_due == 0)
      if (gg_md_queue_turn(&e->queue, e->node))
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
}

#endif
