/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Rollback of events that ran before a straggler, and of all events that followed from them: latest first, each
 * restores the state before it. */
#include <string.h>

#include "md/overlapping_members.h"
#include "md/parallel/slab.h"
#include "md/search/list_update.h"

/* True if an event of equal or later time has run here in an earlier phase. The queue orders events of equal times,
 * once both are in it. */
static bool is_straggler_in(const gg_md_slab *s, float time, const uint32_t *cells, int n)
{
  for (int k = 0; k < n; k++) {
    const gg_md_cell_state *c = &s->all->cell[cells[k]];
    const uint32_t phase = gg_md_bits_of(s->all, c) & GG_MD_LAST;
    if (phase > 0 && phase < (uint32_t)s->phase && c->last >= time) return true;
  }
  return false;
}

bool gg_md_is_straggler(const gg_md_slab *s, double time, const gg_md_footprint *t)
{
  uint32_t index[GG_MD_MOST_AROUND];
  const float at = gg_md_window_time(s->all, time);
  if (s->phase == 1) return false;
  if (t->wide) return is_straggler_in(s, at, t->cell, (int)t->n);
  for (uint32_t k = 0; k < t->n; k++)
    if (is_straggler_in(s, at, index, gg_md_cells_around(s->all, t->cell[k], index))) return true;
  return false;
}

/* Mark the cells of which every event that depends on an event in this cell has one in its footprint. */
static void mark(const gg_md_slab *s, uint32_t cell, bool wide)
{
  uint32_t index[GG_MD_MOST_AROUND];
  s->all->mark[cell] = s->mark;
  if (wide) return;
  for (int n = gg_md_cells_around(s->all, cell, index) - 1; n >= 0; n--) s->all->mark[index[n]] = s->mark;
}

static gg_md_saved_cell *saved_cells_of(const gg_md_log *log, const gg_md_record *r)
{
  return (gg_md_saved_cell *)log->part[GG_MD_LOG_CELLS].item + r->cells;
}

/* True if the footprint of the record includes a marked cell of this slab. Marks of other slabs may change meanwhile.
 */
static bool is_marked(const gg_md_slab *s, const gg_md_log *log, const gg_md_record *r)
{
  const gg_md_saved_cell *cell = saved_cells_of(log, r);
  for (uint32_t k = 0; k < r->n_cells; k++)
    if (gg_md_layer_of(s, cell[k].layer)->owner == s->self && s->all->mark[cell[k].cell] == s->mark) return true;
  return false;
}

/* True if the footprint and the cells around it belong to this slab. */
static bool is_inside(const gg_md_slab *s, const gg_md_log *log, const gg_md_record *r)
{
  const gg_md_saved_cell *cell = saved_cells_of(log, r);
  for (uint32_t k = 0; k < r->n_cells; k++) {
    const gg_md_layer *layer = gg_md_layer_of(s, cell[k].layer);
    if (layer->owner != s->self || layer->outer) return false;
  }
  return true;
}

/* Reader of the log of an earlier phase, from a time on. */
typedef struct reader {
  gg_md_record *next, *end;
  const gg_md_log *log;
} reader;

/* A record to roll back, and its log. */
typedef struct undone {
  gg_md_record *record;
  const gg_md_log *log;
} undone;

static reader read_from(const gg_md_log *log, double time)
{
  uint32_t low = 0, high = log->part[GG_MD_LOG_RECORDS].n;
  while (low < high) {
    const uint32_t middle = (low + high) / 2;
    if (gg_md_record_at(log, middle)->time < time)
      low = middle + 1;
    else
      high = middle;
  }
  return (reader){gg_md_record_at(log, low), gg_md_record_at(log, log->part[GG_MD_LOG_RECORDS].n), log};
}

static reader *earliest(reader *readers, int n)
{
  reader *first = NULL;
  for (int k = 0; k < n; k++)
    if (readers[k].next < readers[k].end && (!first || readers[k].next->time < first->next->time)) first = &readers[k];
  return first;
}

static bool lists(const gg_md *e, uint32_t i, uint32_t j)
{
  return gg_md_list_places(gg_md_list(e, i), j) != 0;
}

/* Restore the list of grain i, and i in the lists of its neighbours. Other entries of these lists stay: later events
 * far from i may have changed them. */
static void undo_list(gg_md *e, uint32_t i, const gg_md_saved_list *was)
{
  uint32_t *list = gg_md_list(e, i);
  for (int k = 0; k < GG_MD_LIST; k++) {
    const uint32_t j = list[k];
    if (j != e->n && !gg_md_list_places(was->neighbour, j) && lists(e, j, i)) gg_md_list_remove(e, j, i);
  }
  for (int k = 0; k < GG_MD_LIST; k++) {
    const uint32_t j = was->neighbour[k];
    if (j != e->n && !lists(e, j, i)) gg_md_list_add(e, j, i);
  }
  memcpy(list, was->neighbour, sizeof was->neighbour);
  e->search.lists.skin[i] = was->skin;
}

/* Remove a grain from a cell, if it is there: a full cell may not have taken it. */
static void leave_cell(const gg_md_cells *c, size_t index, uint32_t i)
{
  uint32_t *cell = c->cell + index * c->stride, found[GG_MD_MOST_IN_SMALL];
  const uint32_t *who = gg_md_cell_members(c, cell, found);
  for (uint32_t k = 0; k < cell[0]; k++)
    if (who[k] == i) {
      gg_md_cell_remove_from(c, cell, i);
      return;
    }
}

/* Remove a grain from all its cells or enter it there. There is room: grains that came later have been removed before.
 */
static void change_cells(const gg_md *e, uint32_t i, bool enters)
{
  const gg_md_node *node = &e->node[i];
  gg_md_members in = {.index = {(uint32_t)gg_md_cell_index(&e->cells, node->cell)}, .which = 1};
  if (e->search.kind == GG_MD_OVERLAPPING_ROWS)
    gg_md_members_in_rows_of(e, node, &in);
  else if (e->search.kind == GG_MD_OVERLAPPING_CELLS)
    gg_md_members_of(e, node, &in);
  for (uint32_t which = in.which; which; which &= which - 1) {
    const size_t index = in.index[__builtin_ctz(which)];
    uint32_t *cell = e->cells.cell + index * e->cells.stride;
    if (enters)
      gg_md_cell_put(&e->cells, cell, i);
    else
      leave_cell(&e->cells, index, i);
  }
}

/* Restore the grains and cells of a record; not the event queue. */
static void undo(gg_md_parallel *p, gg_md *e, const gg_md_log *log, gg_md_record *r)
{
  const gg_md_saved *was = (gg_md_saved *)log->part[GG_MD_LOG_SAVED].item + r->saved;
  const gg_md_saved_more *more = (gg_md_saved_more *)log->part[GG_MD_LOG_MORE].item + r->saved;
  const uint32_t who[2] = {r->grain, r->partner};
  const int n = r->partner == GG_MD_NONE ? 1 : 2;
  const bool moves =
      r->crosses || gg_md_search_overlaps(e->search.kind); /* with overlapping cells any event may leave a cell */
  for (int k = 0; moves && k < n; k++) change_cells(e, who[k], false);
  if (r->crosses && e->search.kind == GG_MD_NEIGHBOUR_LISTS)
    undo_list(e, r->grain, (gg_md_saved_list *)log->part[GG_MD_LOG_LISTS].item + r->beside);
  for (int k = 0; k < n; k++) {
    e->grain[who[k]] = was[k].grain;
    e->node[who[k]] = was[k].node;
    if (e->spin) e->spin[who[k]] = more[k].spin;
    if (e->last) e->last[who[k]] = more[k].last;
    if (e->image) e->image[who[k]] = more[k].image;
    if (!moves) continue;
    change_cells(e, who[k], true);
    gg_md_set_layer(p, e, who[k]);
  }
  const gg_md_saved_cell *cell = saved_cells_of(log, r);
  for (uint32_t k = r->n_cells; k-- > 0;) {
    gg_md_cell_state *c = &p->cell[cell[k].cell];
    c->word = (c->word & ~(uint32_t)GG_MD_LAST) | (gg_md_bits_of(p, &cell[k].before) & GG_MD_LAST);
    c->last = cell[k].before.last;
  }
  r->rolled_back = true;
}

static void undo_and_requeue(gg_md_slab *s, undone *u)
{
  gg_md_record *r = u->record;
  const uint32_t who[2] = {r->grain, r->partner};
  double now[2];
  const int n = r->partner == GG_MD_NONE ? 1 : 2;
  for (int k = 0; k < n; k++) now[k] = s->local->node[who[k]].time;
  undo(s->all, s->local, u->log, r);
  for (int k = 0; k < n; k++) gg_md_requeue(s, who[k], now[k], s->local->node[who[k]].time);
}

/* Collect all dependent events in the order of time, so that cells of an event are marked before later events are read;
 * then roll them back, unless one belongs to another slab. */
gg_md_rollback_status gg_md_rollback(gg_md_slab *s, double time, const gg_md_footprint *t)
{
  reader readers[2 * GG_MD_MOST_SLABS];
  int n = 0;
  for (int phase = 0; phase < s->phase - 1; phase++)
    for (int k = 0; k < s->all->n_slabs; k++) readers[n++] = read_from(&s->all->slab[k].log[phase], time);
  s->mark += (uint32_t)s->all->n_slabs;
  s->rolled_back.n = 0;
  for (uint32_t k = 0; k < t->n; k++) mark(s, t->cell[k], t->wide);
  for (reader *first; (first = earliest(readers, n));) {
    gg_md_record *r = first->next++;
    if (!is_marked(s, first->log, r)) continue;
    if (!is_inside(s, first->log, r)) return GG_MD_ROLLBACK_BLOCKED;
    if (r->rolled_back) continue;
    const gg_md_saved_cell *cell = saved_cells_of(first->log, r);
    for (uint32_t k = 0; k < r->n_cells; k++) mark(s, cell[k].cell, r->wide);
    *(undone *)gg_md_append(s, &s->rolled_back, sizeof(undone)) = (undone){r, first->log};
  }
  for (uint32_t k = s->rolled_back.n; k-- > 0;) undo_and_requeue(s, (undone *)s->rolled_back.item + k);
  return s->rolled_back.n ? GG_MD_ROLLED_BACK : GG_MD_NO_ROLLBACK;
}

void gg_md_rollback_all(gg_md_parallel *p)
{
  for (int phase = GG_MD_PHASES; phase-- > 0;)
    for (int k = 0; k < p->n_slabs; k++) {
      const gg_md_log *log = &p->slab[k].log[phase];
      for (uint32_t m = log->part[GG_MD_LOG_RECORDS].n; m-- > 0;)
        if (!gg_md_record_at(log, m)->rolled_back) undo(p, p->engine, log, gg_md_record_at(log, m));
    }
}
