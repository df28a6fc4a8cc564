/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The footprint of an event, and the cells around a cell, by kind of search. */
#include <math.h>

#include "md/overlapping_members.h"
#include "md/parallel/slab.h"
#include "md/row_motion.h"
#include "md/search/list_update.h"

static int32_t wrapped(int32_t k, int32_t n)
{
  while (k < 0) k += n;
  while (k >= n) k -= n;
  return k;
}

static int around_in_rows(const gg_md *e, const int32_t at[3], uint32_t *index)
{
  static const int from[3] = {-1, -1, -2}, to[3] = {2, 1, 1};
  const gg_md_row *row = &e->search.rows.row[at[1]];
  const gg_md_cells *c = &e->cells;
  const uint32_t *y = c->part[1] + at[1], *z = c->part[2] + at[2];
  const uint32_t *x[3] = {c->part[0] + gg_md_index_in_row(e, at[0] + row->below), c->part[0] + at[0],
                          c->part[0] + gg_md_index_in_row(e, at[0] - row->above)};
  int n = 0;
  for (int m = -1; m <= 1; m++)
    for (int l = -1; l <= 1; l++)
      for (int k = from[l + 1]; k <= to[l + 1]; k++) index[n++] = z[m] + y[l] + x[l + 1][k];
  return n;
}

/* Cells around a cell for skins that move with the flow. A list may be as old as its skin: its grains were within reach
 * when it was made, and the flow has displaced the centres since. So the range covers all strains from then to the end
 * of the window. */
bool gg_md_measure_around(gg_md_parallel *p)
{
  const gg_md *e = p->engine;
  const double rho = e->cells.reach, rate = e->model.shear_rate, *w = e->cells.width;
  if (e->search.kind != GG_MD_NEIGHBOUR_LISTS || !gg_model_is_sheared(&e->model)) return true;
  const double span = gg_md_queue_span(&e->queue),
               age = rate != 0 ? e->search.lists.radius / e->search.lists.shrinkage : 0, more = rate < 0 ? -1e-6 : 1e-6;
  const double strain[2] = {rate * (p->begin * e->queue.width - age) - more,
                            rate * fmin(p->end * e->queue.width, span) + more};
  for (int l = -1; l <= 1; l++) {
    const double height[2] = {fmax((l - 1) * w[1], -rho), fmin((l + 1) * w[1], rho)};
    double least = INFINITY, most = -INFINITY;
    for (int k = 0; k < 4; k++) {
      least = fmin(least, strain[k & 1] * height[k >> 1]);
      most = fmax(most, strain[k & 1] * height[k >> 1]);
    }
    for (int image = 0; image < 2; image++) {
      const double shift = image * l * e->box.offset0;
      p->from[l + 1][image] = (int32_t)gg_floor((-rho - most - shift) / w[0] - 1e-9);
      p->to[l + 1][image] = (int32_t)gg_floor(1 + (rho - least - shift) / w[0] + 1e-9);
      if (9 * (p->to[l + 1][image] - p->from[l + 1][image] + 1) > GG_MD_MOST_AROUND) return false;
    }
  }
  return true;
}

static int around_in_flow(const gg_md_parallel *p, const int32_t at[3], uint32_t *index)
{
  const gg_md_cells *c = &p->engine->cells;
  int n = 0;
  for (int m = -1; m <= 1; m++)
    for (int l = -1; l <= 1; l++) {
      const int image = at[1] + l < 0 || at[1] + l >= c->n[1];
      const uint32_t row = c->part[2][at[2] + m] + c->part[1][at[1] + l];
      int32_t x = wrapped(at[0] + p->from[l + 1][image], c->n[0]);
      for (int k = p->from[l + 1][image]; k <= p->to[l + 1][image]; k++) {
        index[n++] = row + (uint32_t)x;
        if (++x == c->n[0]) x = 0;
      }
    }
  return n;
}

int gg_md_cells_around(const gg_md_parallel *p, uint32_t cell, uint32_t index[GG_MD_MOST_AROUND])
{
  const gg_md *e = p->engine;
  const uint32_t row = cell / (uint32_t)e->cells.n[0];
  const int32_t at[3] = {(int32_t)(cell % (uint32_t)e->cells.n[0]), (int32_t)(row % (uint32_t)e->cells.n[1]),
                         (int32_t)(row / (uint32_t)e->cells.n[1])};
  if (e->search.kind == GG_MD_COMOVING_ROWS) return around_in_rows(e, at, index);
  if (e->search.kind == GG_MD_NEIGHBOUR_LISTS && gg_model_is_sheared(&e->model)) return around_in_flow(p, at, index);
  const uint32_t *x = e->cells.part[0] + at[0], *y = e->cells.part[1] + at[1], *z = e->cells.part[2] + at[2];
  int n = 0;
  for (int m = -1; m <= 1; m++)
    for (int l = -1; l <= 1; l++)
      for (int k = -1; k <= 1; k++) index[n++] = z[m] + y[l] + x[k];
  return n;
}

static void add(const gg_md *e, gg_md_footprint *t, const int32_t at[3])
{
  t->cell[t->n] = (uint32_t)gg_md_cell_index(&e->cells, at);
  t->layer[t->n++] = (uint16_t)at[2];
}

static void add_around(const gg_md_slab *s, gg_md_footprint *t, const int32_t at[3])
{
  const gg_md_cells *c = &s->local->cells;
  const int n = gg_md_cells_around(s->all, (uint32_t)gg_md_cell_index(c, at), t->cell + t->n);
  for (int k = 0; k < n; k++) t->layer[t->n++] = (uint16_t)wrapped(at[2] + 3 * k / n - 1, c->n[2]);
}

/* Add the cells around the old and the new skin: lists of all grains there may change. */
static void add_skins(const gg_md_slab *s, uint32_t i, gg_md_footprint *t)
{
  const gg_md *e = s->local;
  const gg_md_node *node = &e->node[i];
  gg_md_grain g = e->grain[i];
  int32_t at[3];
  g.r = gg_md_position(e, false, &g, node->time);
  gg_md_cell_of(&e->cells, gg_md_into_box(e, node->time, &g), at);
  t->n = 0;
  t->wide = true;
  add_around(s, t, node->cell);
  if (at[0] != node->cell[0] || at[1] != node->cell[1] || at[2] != node->cell[2]) add_around(s, t, at);
}

/* Add the cell that the grain enters. In another row it may be either of two cells. */
static void add_destination(const gg_md *e, const gg_md_node *node, gg_md_footprint *t)
{
  const int axis = node->face >> 1, step = node->face & 1 ? 1 : -1;
  const int32_t *n = e->cells.n;
  int32_t at[3] = {node->cell[0], node->cell[1], node->cell[2]};
  at[axis] = wrapped(at[axis] + step, n[axis]);
  if (axis == 1 && e->search.kind == GG_MD_COMOVING_ROWS) {
    const gg_md_row *old = &e->search.rows.row[node->cell[1]];
    at[0] = gg_md_index_in_row(e, at[0] + (step > 0 ? -old->above - 1 : old->below));
    add(e, t, (int32_t[3]){wrapped(at[0] + 1, n[0]), at[1], at[2]});
  }
  add(e, t, at);
}

/* Add overlapping cells from `low` to `high` along each axis. */
static void add_box(const gg_md *e, gg_md_footprint *t, const int32_t low[3], const int32_t high[3])
{
  const int32_t *n = e->cells.n;
  for (int32_t z = low[2]; z <= high[2]; z++)
    for (int32_t y = low[1]; y <= high[1]; y++)
      for (int32_t x = low[0]; x <= high[0]; x++)
        add(e, t, (int32_t[3]){wrapped(x, n[0]), wrapped(y, n[1]), wrapped(z, n[2])});
}

/* Add the cells of a grain and, with a step (1 up, -1 down, 0 none) along an axis, the cells beyond. */
static void add_members(const gg_md *e, const gg_md_node *node, int axis, int step, gg_md_footprint *t)
{
  int32_t low[3], high[3];
  for (int a = 0; a < 3; a++) {
    low[a] = node->cell[a] - (a == axis && step < 0);
    high[a] = node->cell[a] + (int32_t)(node->neighbours >> a & 1) + (a == axis && step > 0);
  }
  add_box(e, t, low, high);
}

/* Add the cells of the row that a grain is about to enter. */
static void add_entered_row(const gg_md *e, const gg_md_node *node, gg_md_grain g, int step, const int32_t deep[2],
                            gg_md_footprint *t)
{
  uint32_t both;
  g.r = gg_md_position(e, false, &g, node->time);
  const double layers = gg_floor(g.r.y * e->box.inverse[1]);
  g.r.y -= layers * e->box.edge[1];
  g.r.x = gg_wrap(g.r.x - layers * gg_md_offset(&e->box, node->time), e->box.edge[0], e->box.inverse[0]);
  const int32_t upper = (int32_t)(node->neighbours >> 1 & 1), row = gg_md_lower_row(e, node, g.r.y),
                next = step > 0 ? row + upper + 1 : row - 1, x = gg_md_place_in_row(e, next, g.r.x, &both);
  add_box(e, t, (int32_t[3]){x, next, deep[0]}, (int32_t[3]){x + (int32_t)both, next, deep[1]});
}

/* Add the cells of a grain in rows that move with the flow. `lane`: of the step. */
static void add_members_in_rows(const gg_md *e, uint32_t i, int lane, int step, gg_md_footprint *t)
{
  const gg_md_node *node = &e->node[i];
  const uint32_t bits = node->neighbours;
  const int32_t deep[2] = {node->cell[2] - (lane == GG_MD_ALONG_Z && step < 0),
                           node->cell[2] + (int32_t)(bits >> 2 & 1) + (lane == GG_MD_ALONG_Z && step > 0)};
  for (int row = 0; row <= (int)(bits >> 1 & 1); row++) {
    const int own = row ? GG_MD_UPPER_X : GG_MD_LOWER_X;
    const int32_t x = row ? node->upper : node->cell[0], y = node->cell[1] + row;
    add_box(e, t, (int32_t[3]){x - (lane == own && step < 0), y, deep[0]},
            (int32_t[3]){x + (int32_t)(bits >> own & 1) + (lane == own && step > 0), y, deep[1]});
  }
  if (lane == GG_MD_ALONG_Y && step) add_entered_row(e, node, e->grain[i], step, deep, t);
}

/* Footprint with overlapping cells: an event reads no other cells. */
static bool find_overlapping(const gg_md_slab *s, uint32_t i, gg_md_footprint *t)
{
  gg_md *e = s->local;
  const gg_md_node *node = &e->node[i];
  const bool rows = e->search.kind == GG_MD_OVERLAPPING_ROWS;
  const int lane = node->face >> 1, step = !t->crosses ? 0 : node->face & 1 ? 1 : -1;
  t->wide = true;
  e->k.now = node->time; /* rows are placed by it */
  rows ? add_members_in_rows(e, i, lane, step, t) : add_members(e, node, lane, step, t);
  if (t->crosses) return true;
  const uint32_t j = node->partner;
  if (gg_md_layer_of(s, gg_md_layer_of_grain(s->all, j))->owner != s->self) return false;
  rows ? add_members_in_rows(e, j, 0, 0, t) : add_members(e, &e->node[j], 0, 0, t);
  t->collides = e->grain[j].counter == node->counter;
  return true;
}

/* A partner in another slab may have an event there at this moment: its node is not read. */
bool gg_md_find_footprint(const gg_md_slab *s, uint32_t i, gg_md_footprint *t)
{
  const gg_md *e = s->local;
  const gg_md_node *node = &e->node[i];
  t->n = 0;
  t->collides = t->wide = false;
  t->crosses = node->time < node->collision;
  if (gg_md_search_overlaps(e->search.kind)) return find_overlapping(s, i, t);
  add(e, t, node->cell);
  if (t->crosses) {
    if (e->search.kind == GG_MD_NEIGHBOUR_LISTS)
      add_skins(s, i, t);
    else
      add_destination(e, node, t);
    return true;
  }
  const uint32_t j = node->partner;
  if (gg_md_layer_of(s, gg_md_layer_of_grain(s->all, j))->owner != s->self) return false;
  add(e, t, e->node[j].cell);
  t->collides = e->grain[j].counter == node->counter;
  return true;
}
