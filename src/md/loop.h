/* The event loop: pop, re-check, advance the pair, collide, re-predict. One always-inlined body; kernels.c makes the
 * instances.
 *
 * Each grain has one entry in the calendar: the earliest of the collisions that it saw when it was last predicted and
 * of its next crossing. That no collision is missed: for every pair the one predicted last saw the other as it moves
 * now, so its entry is no later than their contact. A collision whose partner has changed course since (its stamp
 * tells) was merely a bound: the grain is predicted anew when that time comes. */
#ifndef GG_MD_LOOP_H
#define GG_MD_LOOP_H

#include "md/shared_rows.h"

GG_INLINE void gg_leave_cell(gg_md *e, uint32_t i)
{
  gg_cell_remove(gg_cell_at(&e->cells, e->node[i].cell), i);
}

GG_INLINE void gg_enter_cell(gg_md *e, uint32_t i)
{
  while (!gg_cell_add(&e->cells, e->node[i].cell, i))
    if (!gg_cells_grow(&e->cells)) {
      e->out_of_memory = true;
      e->collisions_left = 0;
      return;
    }
}

GG_INLINE void gg_check_memory(gg_md *e, bool good)
{
  if (good) return;
  e->out_of_memory = true;
  e->collisions_left = 0;
}

/* The search is over: what it found goes into the calendar. */
GG_INLINE void gg_schedule(gg_md *e, gg_features f, gg_search *s)
{
  gg_node *node = &e->node[s->grain];
  if (f.walled) gg_try_walls(e, f, s);
  if (s->partner != node->partner || s->collision != node->collision) {
    node->collision = s->collision;
    node->partner = s->partner;
    node->stamp = GG_NO_GRAIN(s->partner) ? 0 : e->grain[s->partner].stamp;
  }
  double exit = f.listed   ? gg_shell_exit(e, f, s->grain, s->self)
                : f.shared ? (f.drifts ? gg_rows_next(e, s, &node->face) : gg_shared_next(e, s, &node->face))
                           : gg_next_face(e, f, s, &node->face);
  gg_queue_remove(&e->queue, e->node, s->grain);
  node->time = s->collision < exit ? s->collision : exit;
  gg_queue_insert(&e->queue, e->node, s->grain);
}

/* All that a grain can meet, from scratch. */
GG_INLINE void gg_search_all(gg_md *e, gg_features f, gg_search *s, uint32_t i)
{
  e->node[i].collision = INFINITY;
  e->node[i].partner = GG_NONE;
  gg_begin_search(s, i, gg_settle(e, f, i), INFINITY, GG_NONE);
  if (f.listed)
    gg_scan_batches(e, f, s, gg_list(e, i), e->node[i].neighbours);
  else if (f.shared && f.drifts)
    gg_rows_scan(e, f, s);
  else if (f.shared)
    gg_shared_scan(e, f, s);
  else if (f.drifts)
    gg_drift_around(e, f, s);
  else
    gg_scan_around(e, f, s);
  if (f.wide) gg_scan_near(e, f, s);
}

GG_INLINE void gg_predict(gg_md *e, gg_features f, uint32_t i)
{
  gg_search s = {.near = e->near};
  gg_search_all(e, f, &s, i);
  gg_schedule(e, f, &s);
}

/* Both searches before either goes into the calendar: the processor works on both at a time. */
GG_INLINE void gg_predict_two(gg_md *e, gg_features f, uint32_t i, uint32_t j)
{
  gg_search one = {.near = e->near}, two = {.near = e->near + GG_NEAR_APART};
  gg_search_all(e, f, &one, i);
  gg_search_all(e, f, &two, j);
  gg_schedule(e, f, &one);
  gg_schedule(e, f, &two);
}

/* Through the sheared boundary: the image that takes the grain's place has another velocity and cell. */
GG_INLINE void gg_cross_sheared(gg_md *e, gg_grain *g, gg_node *node, int side)
{
  g->r.x = gg_wrap(g->r.x - side * gg_offset(&e->box, e->k.now), e->box.edge[0], e->box.inverse[0]);
  g->v.x -= side * e->box.slide;
  int32_t x = (int32_t)(g->r.x * e->cells.inverse[0]);
  node->cell[0] = x < e->cells.n[0] ? x : e->cells.n[0] - 1;
}

/* Into another cell that overlaps with those that the grain is in. */
GG_INLINE void gg_come_into_cell(gg_md *e, gg_features f, uint32_t i)
{
  const gg_node *node = &e->node[i];
  gg_search s = {.near = e->near};
  int lane = node->face >> 1, up = node->face & 1;
  gg_grain *g = f.drifts ? gg_settle_in_rows(e, f, i, lane) : gg_settle_step(e, i, (gg_step){lane, up});
  gg_begin_search(&s, i, g, node->collision, node->partner);
  gg_check_memory(e, f.drifts ? gg_rows_cross(e, f, &s, lane, up) : gg_shared_cross(e, f, &s, (gg_step){lane, up}));
  gg_scan_near(e, f, &s);
  gg_schedule(e, f, &s);
}

GG_INLINE void gg_cross_face(gg_md *e, gg_features f, uint32_t i)
{
  gg_node *node = &e->node[i];
  gg_search s = {.near = e->near};
  gg_begin_search(&s, i, gg_settle(e, f, i), node->collision, node->partner);
  if (f.sheared && node->face == GG_SLIDE) {
    gg_scan_sliding_rows(e, f, &s);
    gg_schedule(e, f, &s);
    return;
  }
  gg_grain *g = &e->grain[i];
  int axis = node->face >> 1, step = node->face & 1 ? 1 : -1;
  gg_leave_cell(e, i);
  int32_t at = node->cell[axis] + step, n = e->cells.n[axis];
  int side = at < 0 ? -1 : at >= n ? 1 : 0;
  node->cell[axis] = at - side * n;
  if (side) {
    *gg_component(&g->r, axis) -= side * e->box.edge[axis];
    if (f.sheared && axis == 1) {
      gg_cross_sheared(e, g, node, side);
      gg_enter_cell(e, i);
      gg_predict(e, f, i);
      return;
    }
  }
  gg_enter_cell(e, i);
  gg_scan_ahead(e, f, &s, axis, step);
  if (f.wide) gg_scan_near(e, f, &s);
  gg_schedule(e, f, &s);
}

/* The same in rows that drift. */
GG_INLINE void gg_cross_drifting(gg_md *e, gg_features f, uint32_t i)
{
  gg_node *node = &e->node[i];
  gg_search s = {.near = e->near};
  gg_begin_search(&s, i, gg_settle(e, f, i), node->collision, node->partner);
  gg_grain *g = &e->grain[i];
  int axis = node->face >> 1, step = node->face & 1 ? 1 : -1;
  gg_leave_cell(e, i);
  if (axis == 1) {
    gg_window window = gg_change_row(e, i, step);
    gg_enter_cell(e, i);
    gg_drift_scan(e, f, &s, window);
  } else {
    int32_t at = node->cell[axis] + step, n = e->cells.n[axis], side = at < 0 ? -1 : at >= n ? 1 : 0;
    node->cell[axis] = at - side * n;
    *gg_component(&g->r, axis) -= side * e->box.edge[axis];
    gg_enter_cell(e, i);
    gg_drift_ahead(e, f, &s, axis, step);
  }
  if (f.wide) gg_scan_near(e, f, &s);
  gg_schedule(e, f, &s);
}

/* Rows have slipped by a cell: everybody looks at what comes within reach above. Most see nothing that changes their
 * next event, and stay as they are. */
GG_INLINE void gg_slip(gg_md *e, gg_features f)
{
  e->k.now = e->slip;
  gg_md_slip_rows(e);
  for (uint32_t i = 0; i < e->n; i++) {
    const gg_node *node = &e->node[i];
    gg_search s = {.near = e->near};
    gg_grain here = e->grain[i];
    here.r = gg_position(e, f.gravity, &here, e->k.now);
    gg_begin_search(&s, i, &here, node->collision, node->partner);
    gg_drift_scan(e, f, &s, (gg_window){{0, -1}, {-2, -2}, {0, -1}, {-1, 1}});
    if (f.wide) gg_scan_near(e, f, &s);
    if (s.collision < node->collision) gg_schedule(e, f, &s);
  }
}

/* Out of its shell: a new one, lists mended, and a new prediction. */
GG_INLINE void gg_leave_shell(gg_md *e, gg_features f, uint32_t i)
{
  uint32_t found[GG_FOUND];
  gg_leave_cell(e, i);
  gg_new_shell(e, f, i);
  gg_enter_cell(e, i);
  uint32_t count = gg_search_shell(e, f, i, found);
  if (gg_mend_lists(e, i, found, count)) {
    gg_predict(e, f, i);
    return;
  }
  gg_md_build_lists(e);
  e->predict_all(e);
}

GG_INLINE void gg_collide(gg_md *e, gg_features f, uint32_t i, uint32_t j)
{
  gg_grain *one = gg_settle(e, f, i), *two = gg_settle(e, f, j);
  gg_vec dr = gg_sub(two->r, one->r), dv = gg_sub(two->v, one->v);
  gg_nearest_image(&e->box, f.sheared, e->k.now, &dr, &dv);
  e->impact(e, i, j, dr, gg_scale(-1, dv));
  one->stamp += 2;
  two->stamp += 2;
  e->k.collisions++;
  gg_predict_two(e, f, i, j);
}

GG_INLINE void gg_hit_wall(gg_md *e, gg_features f, uint32_t i, int upper)
{
  gg_grain *g = gg_settle(e, f, i);
  e->wall_impact(e, i, upper);
  g->stamp += 2;
  gg_predict(e, f, i);
}

/* So many grains are in the cache anyway. */
GG_INLINE bool gg_is_cached(const gg_md *e, gg_features f)
{
  return e->n <= (f.shared ? 20000 : 6000);
}

/* Of a grain that will come into another cell: that cell, or the grains in it. Else the partner. */
GG_INLINE void gg_prefetch_shared(const gg_md *e, gg_features f, uint32_t i, bool members)
{
  const gg_node *node = &e->node[i];
  const gg_cells *c = &e->cells;
  if (!(node->time < node->collision)) {
    if (GG_NO_GRAIN(node->partner) || members) return;
    __builtin_prefetch(&e->grain[node->partner]);
    __builtin_prefetch(&e->node[node->partner]);
    return;
  }
  int axis = node->face >> 1, up = node->face & 1, both = node->neighbours >> axis & 1;
  int32_t at[3] = {node->cell[0], node->cell[1], node->cell[2]};
  if (f.drifts && axis == 1) return; /* the cell there depends on how far its row has drifted */
  if (f.drifts && axis == GG_UPPER_X) axis = 0, at[0] = node->upper, at[1] = gg_cell_after(e, 1, at[1]);
  if (!up)
    at[axis]--;
  else
    at[axis] = (both ? gg_cell_after(e, axis, at[axis]) : at[axis]) + 1;
  const uint32_t *cell = c->cell + (size_t)(c->part[0][at[0]] + c->part[1][at[1]] + c->part[2][at[2]]) * c->stride;
  if (!members)
    __builtin_prefetch(cell);
  else
    for (uint32_t m = 1; m <= 8; m++) __builtin_prefetch(&e->grain[m <= cell[0] ? cell[m] : i]);
}

/* Of a grain that will come into another cell, should the cache hold it all: from its outer level into the inner. */
GG_INLINE void gg_prefetch_step(const gg_md *e, gg_features f, uint32_t i)
{
  const gg_node *node = &e->node[i];
  const gg_cells *c = &e->cells;
  const int32_t *at = node->cell;
  __builtin_prefetch(&e->grain[i]);
  if (f.drifts) return;
  int axis = node->face >> 1, step = 2 * (node->face & 1) - 1;
  const uint32_t *part = c->part[axis] + at[axis];
  uint32_t own = c->part[0][at[0]] + c->part[1][at[1]] + c->part[2][at[2]], next = own + part[step] - part[0];
  __builtin_prefetch(c->cell + (size_t)own * c->stride);
  __builtin_prefetch(c->cell + (size_t)next * c->stride);
}

/* Bring what the events of a new bucket will read into the cache while the first of them are handled. */
GG_INLINE void gg_prefetch_due(const gg_md *e, gg_features f)
{
  if (gg_is_cached(e, f)) return;
  for (uint32_t k = 0; k < e->queue.n_due; k++) {
    uint32_t i = e->queue.due[k].grain, j = e->node[i].partner;
    __builtin_prefetch(&e->grain[i]);
    if (f.shared) gg_prefetch_shared(e, f, i, false);
    if (f.shared || GG_NO_GRAIN(j)) continue;
    __builtin_prefetch(&e->grain[j]);
    __builtin_prefetch(&e->node[j]);
    if (!f.listed) continue;
    __builtin_prefetch(gg_list(e, i));
    __builtin_prefetch(gg_list(e, j));
  }
}

/* Two events ahead: the neighbours too. */
GG_INLINE void gg_prefetch_neighbours(const gg_md *e, gg_features f)
{
  if (!f.listed || e->queue.n_due < 2) return;
  uint32_t i = e->queue.due[e->queue.n_due - 2].grain, j = e->node[i].partner;
  const uint32_t *mine = gg_list(e, i);
  for (uint32_t k = 0; k < 16; k++) __builtin_prefetch(&e->grain[mine[k]]);
  if (GG_NO_GRAIN(j)) return;
  const uint32_t *others = gg_list(e, j);
  for (uint32_t k = 0; k < 16; k++) __builtin_prefetch(&e->grain[others[k]]);
}

/* Two events ahead: the plain cells around, of which three neighbours along x stand on two lines, four on three. */
GG_INLINE void gg_prefetch_around(const gg_md *e, gg_features f, uint32_t i)
{
  const int32_t *at = e->node[i].cell;
  const gg_cells *c = &e->cells;
  const uint32_t *y = c->part[1] + at[1], *z = c->part[2] + at[2];
  int32_t below = f.drifts ? gg_drifting_index(e, at[0] + e->row[at[1]].below) : at[0],
          above = f.drifts ? gg_drifting_index(e, at[0] - e->row[at[1]].above) : at[0];
  const uint32_t *x[3] = {c->part[0] + below, c->part[0] + at[0], c->part[0] + above};
  for (int m = -1; m <= 1; m++)
    for (int l = -1; l <= 1; l++) {
      const uint32_t *row = c->cell + (size_t)(z[m] + y[l]) * c->stride;
      __builtin_prefetch(row + (size_t)x[l + 1][-1] * c->stride);
      __builtin_prefetch(row + (size_t)x[l + 1][1] * c->stride);
      if (f.drifts && l) __builtin_prefetch(row + (size_t)x[l + 1][-2 * l] * c->stride);
    }
}

/* While one event is handled, what the next ones will read is on its way. */
GG_INLINE void gg_prefetch_next(const gg_md *e, gg_features f)
{
  uint32_t n = e->queue.n_due;
  if (gg_is_cached(e, f)) {
    if (f.shared && n >= 2) gg_prefetch_step(e, f, e->queue.due[n - 2].grain);
    return;
  }
  if (f.listed) gg_prefetch_neighbours(e, f);
  if (!f.listed && !f.shared && n >= 2 && e->n > 40000) gg_prefetch_around(e, f, e->queue.due[n - 2].grain);
  if (f.shared && n >= 2) gg_prefetch_shared(e, f, e->queue.due[n - 2].grain, true);
}

/* The next event of all; GG_NONE if there is none before e->stop. Rows slip after all events up to then and before all
 * later ones: a matter of the trajectory alone. */
GG_INLINE uint32_t gg_next(gg_md *e, gg_features f)
{
  bool slips = f.drifts && !f.shared;
  for (;;) {
    while (e->queue.n_due == 0)
      if (gg_queue_turn(&e->queue, e->node))
        gg_prefetch_due(e, f);
      else if (slips && e->slip <= gg_queue_span(&e->queue) && e->slip <= e->stop)
        gg_slip(e, f);
      else if (gg_queue_span(&e->queue) > e->stop)
        return GG_NONE;
      else if (!gg_md_next_epoch(e))
        return GG_NONE;
    gg_due due = e->queue.due[e->queue.n_due - 1];
    if (slips && e->slip < due.time && e->slip <= e->stop)
      gg_slip(e, f);
    else
      return due.time <= e->stop ? due.grain : GG_NONE;
  }
}

/* Every grain anew: at a start, or after kicks to all. */
GG_INLINE void gg_forecast_all(gg_md *e, gg_features f)
{
  for (uint32_t i = 0; i < e->n; i++) gg_predict(e, f, i);
}

GG_INLINE void gg_loop(gg_md *e, gg_features f)
{
  uint32_t i;
  while (e->collisions_left && (i = gg_next(e, f)) != GG_NONE) {
    gg_prefetch_next(e, f);
    const gg_node *node = &e->node[i];
    uint32_t partner = node->partner;
    e->k.now = node->time;
    e->k.events++;
    if (node->time < node->collision) {
      if (f.listed)
        gg_leave_shell(e, f, i);
      else if (f.shared)
        gg_come_into_cell(e, f, i);
      else if (f.drifts)
        gg_cross_drifting(e, f, i);
      else
        gg_cross_face(e, f, i);
    } else if (f.walled && GG_NO_GRAIN(partner))
      gg_hit_wall(e, f, i, partner == GG_UPPER_WALL);
    else if (e->grain[partner].stamp != node->stamp)
      gg_predict(e, f, i);
    else {
      gg_collide(e, f, i, partner);
      e->collisions_left--;
    }
  }
}

#endif
