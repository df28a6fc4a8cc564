/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Neighbour search in overlapping cells in rows that move with the flow (overlapping_members.h). */
#ifndef GG_MD_SEARCH_OVERLAPPING_ROWS_H
#define GG_MD_SEARCH_OVERLAPPING_ROWS_H

#include "md/overlapping_members.h"
#include "md/search/overlapping.h"

/* Distances from the lower edges of its lower cells to a grain, and their rates of change, in each lane. */
typedef struct gg_md_row_depths {
  gg_axes depth, v, width;
} gg_md_row_depths;

GG_INLINE gg_md_row_depths gg_md_depths_in_rows(const gg_md *e, const gg_md_node *node, const gg_md_grain *g)
{
  int32_t row = gg_md_lower_row(e, node, g->r.y);
  const gg_md_row *lower = e->search.rows.row + row, *upper = lower + 1;
  const double *w = e->cells.width, *L = e->box.edge, *inverse = e->box.inverse;
  gg_md_row_depths f;
  f.width = (gg_axes){w[0], w[1], w[2], w[0]};
  gg_axes corner = {gg_md_row_begins(e, row), 0, 0, gg_md_row_begins(e, row + 1)};
  gg_axes cell = {node->cell[0], node->cell[1], node->cell[2], node->upper};
  f.depth = (gg_axes){g->r.x, g->r.y, g->r.z, g->r.x} - corner - cell * f.width;
  f.depth -= (gg_axes){L[0], L[1], L[2], L[0]} *
             gg_nearest_axes(f.depth * (gg_axes){inverse[0], inverse[1], inverse[2], inverse[0]});
  f.v = (gg_axes){g->v.x - lower->speed, g->v.y, g->v.z, g->v.x - upper->speed};
  return f;
}

/* Cells along a lane that a grain keeps: bit 0 the lower one, bit 1 the upper one. */
GG_INLINE uint32_t gg_md_kept(uint32_t both, uint32_t above, uint32_t below, int lane)
{
  uint32_t had = 1 | (both >> lane & 1) << 1;
  return had & ~((above >> lane & 1) | (below >> lane & 1) << 1);
}

/* Remove the grain from the cells that it has left, and from the cells behind its step. *in: the remaining cells, by
 * their old numbers. Returns the lane of the step. It changes if the grain has left the lower row; it is GG_MD_NO_LANE
 * if the grain has left the row of the step. */
GG_INLINE int gg_md_leave_behind_in_rows(gg_md *e, uint32_t i, int lane, int up, gg_md_members *in)
{
  gg_md_node *node = &e->node[i];
  gg_md_row_depths f = gg_md_depths_in_rows(e, node, &e->grain[i]);
  double half = 0.5 * e->cells.reach;
  uint32_t both = node->neighbours, stepping = 1u << lane & 15, rising = up ? stepping : 0;
  uint32_t above = ((gg_axes_bits(f.depth > f.width + half) & ~stepping) | rising) & both;
  uint32_t below = ((gg_axes_bits(f.depth < f.width - half) & ~stepping) | (stepping ^ rising)) & both;
  uint32_t rows = gg_md_kept(both, above, below, 1), deep = gg_md_kept(both, above, below, 2);
  uint32_t kept = (rows & 1) * gg_md_kept(both, above, below, 0) | (rows & 2) * 2 * gg_md_kept(both, above, below, 3);
  kept = (deep & 1) * kept | (deep & 2) * 8 * kept;
  gg_md_members_in_rows_of(e, node, in);
  gg_md_members_leave(e, i, in, in->which & ~kept);
  in->which &= kept;
  int32_t lower = gg_md_index_in_row(e, node->cell[0] + (int32_t)(above & 1)),
          upper = gg_md_index_in_row(e, node->upper + (int32_t)(above >> 3 & 1));
  both &= ~(above | below);
  node->cell[2] += (int32_t)(above >> 2 & 1);
  if (node->cell[2] == e->cells.n[2]) node->cell[2] = 0;
  if (above & 2) {
    lower = upper;
    both = (both & ~1u) | both >> 3;
    if (++node->cell[1] == e->cells.n[1]) node->cell[1] = 0;
    lane = lane == GG_MD_UPPER_X ? GG_MD_LOWER_X : lane == GG_MD_LOWER_X ? GG_MD_NO_LANE : lane;
  } else if ((below & 2) && lane == GG_MD_UPPER_X) {
    lane = GG_MD_NO_LANE;
  }
  node->cell[0] = lower;
  node->upper = upper;
  node->neighbours = both & 2 ? both : both & ~8u;
  return lane;
}

/* Search all grains that share a cell with the grain, after removing it from the cells that it has left. */
GG_INLINE void gg_md_search_all(gg_md *e, gg_md_search *s)
{
  gg_md_members in;
  gg_md_leave_behind_in_rows(e, s->grain, GG_MD_NO_LANE, 0, &in);
  gg_md_take_members(e, s, &in);
  gg_md_try_candidates(e, s);
}

/* Enter the row above or below the rows of the grain. */
GG_INLINE void gg_md_enter_row(gg_md *e, gg_md_node *node, const gg_md_grain *g, int up)
{
  int32_t row = gg_md_lower_row(e, node, g->r.y);
  uint32_t both, *bits = &node->neighbours;
  int32_t cell = gg_md_place_in_row(e, up ? row + 1 : row - 1, g->r.x, &both);
  if (up) {
    node->upper = cell;
    *bits |= 2 | both << 3;
  } else {
    node->upper = node->cell[0];
    node->cell[0] = cell;
    *bits = (*bits & 4) | 2 | (*bits & 1) << 3 | both;
    if (node->cell[1]-- == 0) node->cell[1] += e->cells.n[1];
  }
}

/* Enter the next cell along a lane, and gather its grains as candidates. False: out of memory. */
GG_INLINE bool gg_md_enter_next_in_rows(gg_md *e, gg_md_search *s, int lane, int up)
{
  static const uint32_t fresh[4][2] = {{0x11, 0x22}, {0x33, 0xcc}, {0x0f, 0xf0}, {0x44, 0x88}};
  gg_md_node *node = &e->node[s->grain];
  gg_md_members in;
  lane = gg_md_leave_behind_in_rows(e, s->grain, lane, up, &in);
  if (lane == GG_MD_NO_LANE) return true;
  if (lane == GG_MD_ALONG_Y) {
    gg_md_enter_row(e, node, s->self, up);
  } else {
    int32_t *cell = lane == GG_MD_LOWER_X ? &node->cell[0] : lane == GG_MD_UPPER_X ? &node->upper : &node->cell[2];
    if (!up && (*cell)-- == 0) *cell += e->cells.n[lane == GG_MD_ALONG_Z ? 2 : 0];
    node->neighbours |= 1u << lane;
  }
  gg_md_members_in_rows_of(e, node, &in);
  in.which &= fresh[lane][up];
  gg_md_take_members(e, s, &in);
  return gg_md_members_enter(e, s->grain, &in);
}

/* Time at which the grain enters another cell; *face: lane and direction. */
GG_INLINE double gg_md_next_crossing(const gg_md *e, const gg_md_search *s, int32_t *face)
{
  const gg_md_node *node = &e->node[s->grain];
  gg_md_row_depths f = gg_md_depths_in_rows(e, node, s->self);
  double half = 0.5 * e->cells.reach;
  gg_axes zero = {0}, never = {INFINITY, INFINITY, INFINITY, INFINITY};
  gg_axes upwards = gg_choose_axes(gg_axes_of(node->neighbours), 2 * f.width, f.width) - half - f.depth;
  gg_axes way = gg_choose_axes(f.v > 0, upwards, f.depth - half);
  gg_axes delay = way / (gg_axes)((gg_axes_mask)f.v & INT64_MAX);
  delay = gg_choose_axes(delay > 0, delay, zero); /* NaN or infinite for a grain at rest */
  gg_axes_mask open = {-1, -1, -1, -(int64_t)(node->neighbours >> 1 & 1)};
  delay = gg_choose_axes((f.v != 0) & open, delay, never);
  gg_axes first = gg_least_axes(delay);
  int lane = __builtin_ctz(gg_axes_bits(delay == first));
  *face = 2 * lane + (int)(gg_axes_bits(f.v > 0) >> lane & 1);
  return e->k.now + first[0];
}

/* Synchronise a grain, and wrap it into the box along the lane of a step. An image above or below has another velocity.
 */
GG_INLINE gg_md_grain *gg_md_synchronise_in_rows(gg_md *e, uint32_t i, int lane)
{
  gg_md_grain *g = gg_md_synchronise(e, i);
  const gg_vec was = g->r;
  if (lane == GG_MD_ALONG_Z) {
    g->r.z = gg_wrap(g->r.z, e->box.edge[2], e->box.inverse[2]);
  } else {
    double layers = lane == GG_MD_ALONG_Y ? gg_floor(g->r.y * e->box.inverse[1]) : 0;
    if (layers != 0) {
      g->r.y -= layers * e->box.edge[1];
      g->r.x -= layers * gg_md_offset(&e->box, e->k.now);
      g->v.x -= layers * e->box.image_velocity;
    }
    g->r.x = gg_wrap(g->r.x, e->box.edge[0], e->box.inverse[0]);
  }
  if (e->image) gg_md_count_image(e, i, was);
  return g;
}

/* The grain enters another overlapping cell. */
GG_INLINE void gg_md_cross(gg_md *e, uint32_t i)
{
  const gg_md_node *node = &e->node[i];
  gg_md_search s = {.candidates = e->candidates};
  int lane = node->face >> 1, up = node->face & 1;
  gg_md_begin_search(&s, i, gg_md_synchronise_in_rows(e, i, lane), node->collision, node->partner);
  gg_md_check_memory(e, gg_md_enter_next_in_rows(e, &s, lane, up));
  gg_md_try_candidates(e, &s);
  gg_md_schedule(e, &s, true);
}

GG_INLINE bool gg_md_step_of(const gg_md *e, const gg_md_node *node, int *axis, int32_t at[3])
{
  if (*axis == GG_MD_ALONG_Y) return false; /* the cell there depends on the motion of its row */
  if (*axis == GG_MD_UPPER_X) *axis = 0, at[0] = node->upper, at[1] = gg_md_cell_after(e, 1, at[1]);
  return true;
}

GG_INLINE void gg_md_prefetch_cached(const gg_md *e, uint32_t i)
{
  __builtin_prefetch(&e->grain[i]);
}

#endif
