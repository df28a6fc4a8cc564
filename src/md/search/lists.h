/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Neighbour lists (Verlet, with skins), for dense systems.
 *
 * Each grain has a skin, a sphere of radius s around its position when its list was made. The list holds all grains
 * whose skin centres were then within rho = sigma + 2 s of its own; lists are symmetric. Two grains that are not listed
 * cannot touch while both are in their skins. A grain that leaves its skin gets a new one, and the lists are updated.
 *
 * Under shear the centres move with the flow at their height, and skins shrink at the rate kappa = |shear_rate| rho/4:
 * two centres at a distance R approach at a speed of at most |shear_rate| R/2, so the condition holds until the exit. A
 * centre is stored by its position at the start of the epoch, which does not change: the cells of the centres are at
 * rest.
 *
 * A prediction tests the whole list, a batch of grains at a time. */
#ifndef GG_MD_SEARCH_LISTS_H
#define GG_MD_SEARCH_LISTS_H

#include "md/search/features.h"

enum {
  ROWS_SHIFT = false,
  ROWS_MOVE = false,
  KNOWS_IMAGES = false,
  FEW_MEET = false,
  HAS_COPIES = false,
  CACHED = 6000,
  SMALL_CELLS = false,
  PREDICTS_IN_PLACE = true
};

#include "md/grid.h"
#include "md/search/list_update.h"
#include "md/search/neighbour_search.h"
#include "md/search/simd_pairs.h"

/* Centre of skin i at the present time. */
GG_INLINE gg_vec gg_md_centre(const gg_md *e, uint32_t i)
{
  gg_vec c = e->search.lists.skin[i].centre;
  if (IS_SHEARED) c.x += e->model.shear_rate * (c.y - 0.5 * e->box.edge[1]) * e->k.now;
  return c;
}

/* Time until a straight path leaves a shrinking sphere: |dr + dv t| = radius - kappa t, without cancellation. */
GG_INLINE double gg_md_sphere_exit(gg_vec dr, gg_vec dv, double radius, double kappa)
{
  double a = gg_dot(dv, dv) - kappa * kappa, b = gg_dot(dr, dv) + kappa * radius;
  double c = gg_dot(dr, dr) - radius * radius;
  if (!(c < 0) || radius < 0) return 0;
  double root = sqrt(b * b - a * c);
  bool out = b > 0; /* true for half of all: no branch */
  double delay = (out ? -c : root - b) / (out ? b + root : a);
  return (out | (a > 0)) ? delay : INFINITY;
}

/* Time on a parabola that is not later than the exit from the skin nor than the next collision. Its steps are straight
 * paths in a sphere that is smaller by the fall during the step, at most half of the distance to its surface. */
GG_INLINE double gg_md_fall_out_of_skin(const gg_md *e, const gg_md_search *s)
{
  enum { MOST_STEPS = 8 };
  gg_vec dr = gg_sub(s->self->r, e->search.lists.skin[s->grain].centre), v = s->self->v;
  const double radius = e->search.lists.radius, weight = sqrt(gg_dot(e->gravity, e->gravity));
  double gone = 0, left = s->collision - e->k.now, fall = 0.5 * weight * left * left;
  if (fall < radius && gg_md_sphere_exit(dr, v, radius - fall, 0) >= left) return s->collision;
  for (int k = 0; k < MOST_STEPS; k++) {
    double room = radius - sqrt(gg_dot(dr, dr)), dt = left;
    if (!(room > (k ? 0.02 * radius : 0))) break;
    bool all = weight * left * left < room;
    if (!all) dt = sqrt(room / weight);
    double exit = gg_md_sphere_exit(dr, v, radius - 0.5 * weight * dt * dt, 0);
    if (all && exit >= left) return s->collision;
    if (exit < dt) dt = exit;
    dr = gg_axpy(0.5 * dt * dt, e->gravity, gg_axpy(dt, v, dr));
    v = gg_axpy(dt, e->gravity, v);
    gone += dt, left -= dt;
  }
  return e->k.now + gone;
}

/* Time at which a grain leaves its skin on a straight path. */
GG_INLINE double gg_md_skin_exit(const gg_md *e, uint32_t i, const gg_md_grain *g)
{
  gg_vec centre = gg_md_centre(e, i), dr = gg_sub(g->r, centre), dv = g->v;
  double radius = e->search.lists.radius, kappa = IS_SHEARED ? e->search.lists.shrinkage : 0;
  if (IS_SHEARED) {
    dr.x -= e->box.edge[0] * gg_nearest(dr.x * e->box.inverse[0]); /* the stored centre is wrapped */
    dv.x -= e->model.shear_rate * (centre.y - 0.5 * e->box.edge[1]);
    radius -= kappa * (e->k.now - e->node[i].skin_time);
  }
  return e->k.now + gg_md_sphere_exit(dr, dv, radius, kappa);
}

GG_INLINE void gg_md_search_all(gg_md *e, gg_md_search *s)
{
  uint32_t i = s->grain;
  gg_md_try_list(e, s, gg_md_list(e, i), e->node[i].neighbours, IS_SHEARED ? GG_MD_MOVING : GG_MD_AT_REST);
}

GG_INLINE double gg_md_next_crossing(const gg_md *e, const gg_md_search *s, int32_t *face)
{
  (void)face;
  return HAS_GRAVITY ? gg_md_fall_out_of_skin(e, s) : gg_md_skin_exit(e, s->grain, s->self);
}

/* A grain leaves its skin: renew the skin, update lists, and predict. */
GG_INLINE void gg_md_cross(gg_md *e, uint32_t i)
{
  uint32_t found[GG_MD_FOUND];
  gg_md_leave_cell(e, i);
  gg_md_new_skin(e, i);
  gg_md_enter_cell(e, i);
  uint32_t count = gg_md_search_skin(e, i, found);
  if (gg_md_update_lists(e, i, found, count)) {
    gg_md_predict(e, i);
    return;
  }
  if (e->is_thread_local) {
    e->lists_are_full = true;
    return;
  }
  gg_md_build_lists(e, NULL);
  e->kernel->predict(e, 0, e->n);
}

GG_INLINE void gg_md_shift_all(gg_md *e)
{
  (void)e;
}

GG_INLINE void gg_md_prefetch_due(const gg_md *e, uint32_t i, uint32_t partner)
{
  if (GG_MD_NO_GRAIN(partner)) return;
  __builtin_prefetch(&e->grain[partner]);
  __builtin_prefetch(&e->node[partner]);
  __builtin_prefetch(gg_md_list(e, i));
  __builtin_prefetch(gg_md_list(e, partner));
}

GG_INLINE void gg_md_prefetch_cached(const gg_md *e, uint32_t i)
{
  (void)e;
  (void)i;
}

/* Prefetch the neighbours of the grain and of its partner. */
GG_INLINE void gg_md_prefetch_ahead(const gg_md *e, uint32_t i)
{
  uint32_t j = e->node[i].partner;
  const uint32_t *mine = gg_md_list(e, i);
  for (uint32_t k = 0; k < 16; k++) __builtin_prefetch(&e->grain[mine[k]]);
  if (GG_MD_NO_GRAIN(j)) return;
  const uint32_t *others = gg_md_list(e, j);
  for (uint32_t k = 0; k < 16; k++) __builtin_prefetch(&e->grain[others[k]]);
}

#endif
