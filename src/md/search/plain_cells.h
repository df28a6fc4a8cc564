/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Neighbour search in plain cells: the cells around a grain, image by image.
 *
 * Every neighbouring cell is searched as one definite image, with its shift, so that boxes of one or two cells across,
 * and grains that can touch several images of one partner, are no special cases.
 *
 * In small sheared boxes the cells are at rest (else: comoving_rows.h), and the image row across the sheared boundary
 * has any offset and moves. The grain searches all cells of it that can come within reach of its own cell until a time
 * `valid`, and searches again then. Incremental searches are complete because each of them includes the whole window of
 * each moving row, and all other neighbourhoods are symmetric. */
#ifndef GG_MD_SEARCH_PLAIN_CELLS_H
#define GG_MD_SEARCH_PLAIN_CELLS_H

#include "md/search/features.h"

enum {
  ROWS_SHIFT = false,
  ROWS_MOVE = false,
  KNOWS_IMAGES = true,
  FEW_MEET = false,
  HAS_COPIES = false,
  CACHED = 6000,
  SMALL_CELLS = true,
  PREDICTS_IN_PLACE = true
};

#include "md/search/candidates.h"
#include "md/search/faces.h"
#include "md/search/neighbour_search.h"
#include "md/search/pair.h"
#include "md/search/prefetch_partner.h"
#include "md/search/simd_pairs.h"

/* Search cells from..to (unwrapped) of row (y, z): images shifted by `shift`, moving at `image_velocity`. */
GG_INLINE void gg_md_scan_row(const gg_md *e, gg_md_search *s, int32_t from, int32_t to, int32_t y, int32_t z,
                              gg_vec shift, double image_velocity)
{
  const gg_md_cells *c = &e->cells;
  const uint32_t *row = gg_md_cell_at(c, (int32_t[3]){0, y, z});
  for (int32_t k = from; k <= to; k++) {
    int32_t x = k;
    gg_vec here = shift;
    while (x < 0) x += c->n[0], here.x -= e->box.edge[0];
    while (x >= c->n[0]) x -= c->n[0], here.x += e->box.edge[0];
    const uint32_t *cell = row + (size_t)x * c->stride;
    if (IS_SIMD && gg_md_take_cell(s, cell)) continue;
    uint32_t found[GG_MD_MOST_IN_SMALL];
    const uint32_t *who = gg_md_cell_members(c, cell, found);
    for (uint32_t m = 0; m < cell[0]; m++)
      if (who[m] != s->grain) gg_md_try_pair(e, s, who[m], here, image_velocity);
  }
}

/* Search cells from..to (unwrapped) of the row at (y, z), unless it is across a wall or the sheared boundary. */
GG_INLINE void gg_md_scan_plain_row(const gg_md *e, gg_md_search *s, int32_t from, int32_t to, int32_t y, int32_t z)
{
  gg_vec shift = {0, 0, 0};
  if (IS_WALLED && (y < 0 || y >= e->cells.n[1])) return;
  int32_t iy = gg_md_image_cell(e, 1, y, &shift.y);
  if (IS_SHEARED && shift.y != 0) return;
  int32_t iz = gg_md_image_cell(e, 2, z, &shift.z);
  gg_md_scan_row(e, s, from, to, iy, iz, shift, 0);
}

/* Search the moving row above (side = 1) or below (-1): its cell k now covers x from k w + D to (k+1) w + D. */
GG_INLINE void gg_md_scan_moving_row(const gg_md *e, gg_md_search *s, int side)
{
  const gg_md_cells *c = &e->cells;
  const gg_md_node *node = &e->node[s->grain];
  double w = c->width[0], D = side * gg_md_offset(&e->box, e->k.now);
  double left = node->cell[0] * w - c->reach, right = (node->cell[0] + 1) * w + c->reach;
  int32_t from = (int32_t)gg_floor((left - D) / w), to = (int32_t)gg_floor((right - D) / w);
  const bool right_going = (side > 0) == (e->box.image_velocity >= 0);
  if (right_going)
    from--; /* one more cell on the left */
  else
    to++;
  double room = right_going ? left - (from * w + D) : (to + 1) * w + D - right;
  double valid = e->k.now + room / fabs(e->box.image_velocity);
  if (valid < s->valid) s->valid = valid;
  for (int32_t z = node->cell[2] - 1; z <= node->cell[2] + 1; z++) {
    gg_vec shift = {D, side * e->box.edge[1], 0};
    int32_t iz = gg_md_image_cell(e, 2, z, &shift.z);
    gg_md_scan_row(e, s, from, to, side > 0 ? 0 : c->n[1] - 1, iz, shift, side * e->box.image_velocity);
  }
}

GG_INLINE void gg_md_scan_moving_rows(const gg_md *e, gg_md_search *s)
{
  s->valid = INFINITY;
  if (!IS_SHEARED) return;
  int32_t y = e->node[s->grain].cell[1];
  if (y == e->cells.n[1] - 1) gg_md_scan_moving_row(e, s, 1);
  if (y == 0) gg_md_scan_moving_row(e, s, -1);
}

/* True if all cells around are in the same image of the box. */
GG_INLINE bool gg_md_is_inside(const gg_md *e, const int32_t at[3])
{
  const int32_t *n = e->cells.n;
  return ((uint32_t)(at[0] - 1) < (uint32_t)(n[0] - 2)) & ((uint32_t)(at[1] - 1) < (uint32_t)(n[1] - 2)) &
         ((uint32_t)(at[2] - 1) < (uint32_t)(n[2] - 2));
}

/* Gather the cells from `from` to `to` relative to `at`, where there is no wall. False: a small cell has an overflow
 * list. Constants are in local variables: the compiler must assume that a store into `candidates` overwrites anything
 * else. */
GG_INLINE bool gg_md_take_rows(const gg_md *e, gg_md_search *s, const int32_t at[3], const int from[3], const int to[3],
                               gg_md_cell_size size)
{
  const gg_md_cells *c = &e->cells;
  const uint32_t *x = c->part[0] + at[0], *y = c->part[1] + at[1], *z = c->part[2] + at[2];
  const uint32_t *row[3][3];
  size_t stride = c->stride, step[3];
  for (int k = from[0]; k <= to[0]; k++) step[k + 1] = x[k] * stride;
  for (int m = from[2]; m <= to[2]; m++)
    for (int l = from[1]; l <= to[1]; l++) row[m + 1][l + 1] = c->cell + (size_t)(z[m] + y[l]) * stride;
  gg_md_gathered found = {s->candidates, s->n_candidates, 0};
  for (int m = from[2]; m <= to[2]; m++)
    for (int l = from[1]; l <= to[1]; l++)
      for (int k = from[0]; k <= to[0]; k++) gg_md_gather_cell(&found, c, row[m + 1][l + 1] + step[k + 1], size);
  return gg_md_keep_gathered(s, &found);
}

static __attribute__((noinline, cold, unused)) void
gg_md_take_overfull_rows(const gg_md *e, gg_md_search *s, const int32_t at[3], const int from[3], const int to[3])
{
  gg_md_take_rows(e, s, at, from, to, GG_MD_OVERFULL_CELLS);
}

GG_INLINE void gg_md_take_small_rows(const gg_md *e, gg_md_search *s, const int32_t at[3], const int from[3],
                                     const int to[3])
{
  if (!gg_md_take_rows(e, s, at, from, to, GG_MD_SMALL_CELLS)) gg_md_take_overfull_rows(e, s, at, from, to);
}

/* The same for large cells: a call, because they are rare. */
static __attribute__((noinline, unused)) void
gg_md_take_large_rows(const gg_md *e, gg_md_search *s, const int32_t at[3], const int from[3], const int to[3])
{
  gg_md_take_rows(e, s, at, from, to, GG_MD_LARGE_CELLS);
}

static __attribute__((noinline, unused)) void
gg_md_take_rows_at_wall(const gg_md *e, gg_md_search *s, const int32_t at[3], const int from[3], const int to[3])
{
  const int lower[3] = {from[0], gg_md_is_wall_below(e, at) && from[1] < 0 ? 0 : from[1], from[2]};
  const int upper[3] = {to[0], gg_md_is_wall_above(e, at) && to[1] > 0 ? 0 : to[1], to[2]};
  gg_md_take_rows(e, s, at, lower, upper, GG_MD_LARGE_CELLS);
}

/* Gather those of these cells that are in the box, in SIMD kernels. False: there may be no room for all. */
GG_INLINE bool gg_md_take_box(const gg_md *e, gg_md_search *s, const int32_t at[3], const int from[3], const int to[3])
{
  if (!IS_SIMD || !gg_md_has_room(e, 27)) return false;
  if (gg_md_is_wall_below(e, at) || gg_md_is_wall_above(e, at))
    gg_md_take_rows_at_wall(e, s, at, from, to);
  else if (!IS_WALLED && e->cells.stride == GG_MD_SMALL_CELL)
    gg_md_take_small_rows(e, s, at, from, to);
  else if (e->cells.stride == 8)
    gg_md_take_rows(e, s, at, from, to, GG_MD_EIGHT_WORDS);
  else
    gg_md_take_large_rows(e, s, at, from, to);
  s->inside = gg_md_is_inside(e, at);
  return true;
}

/* Search the cells from `from` to `to` one by one: on the reference path, and where there may be no room for all. */
static __attribute__((noinline)) void gg_md_scan_one_by_one(const gg_md *e, gg_md_search *s, const int32_t at[3],
                                                            const int from[3], const int to[3])
{
  for (int32_t z = at[2] + from[2]; z <= at[2] + to[2]; z++)
    for (int32_t y = at[1] + from[1]; y <= at[1] + to[1]; y++)
      gg_md_scan_plain_row(e, s, at[0] + from[0], at[0] + to[0], y, z);
}

/* Search the cells from `from` to `to`, and the moving rows. */
GG_INLINE void gg_md_scan_cells(const gg_md *e, gg_md_search *s, const int from[3], const int to[3])
{
  const int32_t *at = e->node[s->grain].cell;
  if (!gg_md_take_box(e, s, at, from, to)) gg_md_scan_one_by_one(e, s, at, from, to);
  gg_md_scan_moving_rows(e, s);
}

/* Search all 27 cells. */
GG_INLINE void gg_md_search_all(gg_md *e, gg_md_search *s)
{
  gg_md_scan_cells(e, s, (const int[3]){-1, -1, -1}, (const int[3]){1, 1, 1});
  if (IS_SIMD) gg_md_try_candidates(e, s);
}

/* Search the nine cells that came within reach by crossing a face. */
GG_INLINE void gg_md_scan_ahead(const gg_md *e, gg_md_search *s, int axis, int32_t step)
{
  int from[3] = {-1, -1, -1}, to[3] = {1, 1, 1};
  from[axis] = to[axis] = step;
  gg_md_scan_cells(e, s, from, to);
}

GG_INLINE double gg_md_next_crossing(const gg_md *e, const gg_md_search *s, int32_t *face)
{
  double first = HAS_GRAVITY ? gg_md_first_fall_out(e, s, face)
                             : gg_md_first_exit(e, e->node[s->grain].cell, gg_load_axes(&s->self->r.x),
                                                gg_load_axes(&s->self->v.x), face);
  double t = e->k.now + first;
  if (IS_SHEARED && s->valid < t) t = s->valid, *face = GG_MD_IMAGES_MOVED;
  return t;
}

/* Replace a grain that crosses the sheared boundary by its image, which has another velocity and cell. */
GG_INLINE void gg_md_cross_sheared(gg_md *e, gg_md_grain *g, gg_md_node *node, int side)
{
  g->r.x = gg_wrap(g->r.x - side * gg_md_offset(&e->box, e->k.now), e->box.edge[0], e->box.inverse[0]);
  g->v.x -= side * e->box.image_velocity;
  int32_t x = (int32_t)(g->r.x * e->cells.inverse[0]);
  node->cell[0] = gg_md_within(x, e->cells.n[0]);
}

GG_INLINE void gg_md_cross(gg_md *e, uint32_t i)
{
  gg_md_node *node = &e->node[i];
  gg_md_search s = {.candidates = e->candidates};
  gg_md_begin_search(&s, i, gg_md_synchronise(e, i), node->collision, node->partner);
  if (IS_SHEARED && node->face == GG_MD_IMAGES_MOVED) {
    gg_md_scan_moving_rows(e, &s);
    gg_md_schedule(e, &s, true);
    return;
  }
  gg_md_grain *g = &e->grain[i];
  int axis = node->face >> 1, step = node->face & 1 ? 1 : -1;
  gg_md_leave_cell(e, i);
  int32_t at = node->cell[axis] + step, n = e->cells.n[axis];
  int side = at < 0 ? -1 : at >= n ? 1 : 0;
  node->cell[axis] = at - side * n;
  if (side) {
    const gg_vec was = g->r;
    *gg_component(&g->r, axis) -= side * e->box.edge[axis];
    if (IS_SHEARED && axis == 1) gg_md_cross_sheared(e, g, node, side);
    if (e->image) gg_md_count_image(e, i, was);
    if (IS_SHEARED && axis == 1) {
      gg_md_enter_cell(e, i);
      gg_md_predict(e, i);
      return;
    }
  }
  gg_md_enter_cell(e, i);
  gg_md_scan_ahead(e, &s, axis, step);
  if (IS_SIMD) gg_md_try_candidates(e, &s);
  gg_md_schedule(e, &s, true);
}

GG_INLINE void gg_md_shift_all(gg_md *e)
{
  (void)e;
}

/* Prefetch the cells around. Three neighbours along x are on two cache lines. */
GG_INLINE void gg_md_prefetch_ahead(const gg_md *e, uint32_t i)
{
  if (e->n <= 40000) return;
  const int32_t *at = e->node[i].cell;
  const gg_md_cells *c = &e->cells;
  const uint32_t *x = c->part[0] + at[0], *y = c->part[1] + at[1], *z = c->part[2] + at[2];
  for (int m = -1; m <= 1; m++)
    for (int l = -1; l <= 1; l++) {
      const uint32_t *row = c->cell + (size_t)(z[m] + y[l]) * c->stride;
      __builtin_prefetch(row + (size_t)x[-1] * c->stride);
      __builtin_prefetch(row + (size_t)x[1] * c->stride);
    }
}

#endif
