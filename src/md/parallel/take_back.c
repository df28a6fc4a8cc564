/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Events that ran too early, and all that followed from them, are taken back: latest first, each restores the state
 * before it. */
#include <string.h>

#include "md/overlapping_members.h"
#include "md/parallel/slab.h"
#include "md/search/list_update.h"

/* Equal times, too: which of both comes first is seen when both wait in one queue. */
static bool is_overtaken_in(const gg_md_slab *s, float time, const uint32_t *cells, int n)
{
  for (int k = 0; k < n; k++) {
    const gg_md_cell_state *c = &s->all->cell[cells[k]];
    const uint32_t phase = gg_md_bits_of(s->all, c) & GG_MD_LAST;
    if (phase > 0 && phase < (uint32_t)s->phase && c->last >= time) return true;
  }
  return false;
}

bool gg_md_is_overtaken(const gg_md_slab *s, double time, const gg_md_touched *t)
{
  uint32_t index[GG_MD_MOST_AROUND];
  const float at = gg_md_window_time(s->all, time);
  if (s->phase == 1) return false;
  if (t->wide) return is_overtaken_in(s, at, t->cell, (int)t->n);
  for (uint32_t k = 0; k < t->n; k++)
    if (is_overtaken_in(s, at, index, gg_md_cells_around(s->all, t->cell[k], index))) return true;
  return false;
}

/* What depends on an event that touches this cell touches one of these. */
static void mark(const gg_md_slab *s, uint32_t cell, bool wide)
{
  uint32_t index[GG_MD_MOST_AROUND];
  s->all->mark[cell] = s->mark;
  if (wide) return;
  for (int n = gg_md_cells_around(s->all, cell, index) - 1; n >= 0; n--) s->all->mark[index[n]] = s->mark;
}

static gg_md_stamp *stamps_of(const gg_md_log *log, const gg_md_record *r)
{
  return (gg_md_stamp *)log->stamp.item + r->stamp;
}

/* Does it touch a marked cell? What is known of cells of other slabs is theirs alone. */
static bool is_marked(const gg_md_slab *s, const gg_md_log *log, const gg_md_record *r)
{
  const gg_md_stamp *stamp = stamps_of(log, r);
  for (uint32_t k = 0; k < r->touched; k++)
    if (gg_md_layer_of(s, stamp[k].layer)->owner == s->self && s->all->mark[stamp[k].cell] == s->mark) return true;
  return false;
}

/* The cells around are this slab's, too. */
static bool is_inside(const gg_md_slab *s, const gg_md_log *log, const gg_md_record *r)
{
  const gg_md_stamp *stamp = stamps_of(log, r);
  for (uint32_t k = 0; k < r->touched; k++) {
    const gg_md_layer *layer = gg_md_layer_of(s, stamp[k].layer);
    if (layer->owner != s->self || layer->outer) return false;
  }
  return true;
}

/* The logs of earlier phases, from a time on. */
typedef struct reader {
  gg_md_record *next, *end;
  const gg_md_log *log;
} reader;

/* What is taken back, and the log that it stands in. */
typedef struct gg_md_undone {
  gg_md_record *record;
  const gg_md_log *log;
} gg_md_undone;

static reader read_from(const gg_md_log *log, double time)
{
  uint32_t low = 0, high = log->record.n;
  while (low < high) {
    const uint32_t middle = (low + high) / 2;
    if (gg_md_record_at(log, middle)->time < time)
      low = middle + 1;
    else
      high = middle;
  }
  return (reader){gg_md_record_at(log, low), gg_md_record_at(log, log->record.n), log};
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

/* The neighbours' lists as far as they concern this grain: there may be others, far from it, that stay. */
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

/* If it is there: in a cell that was full it is not. */
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

/* Out of all cells that a grain is in, or into them: those who came later have left, so there is room. */
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

/* Bring a record's grains and cells back to what they were; not the event queue. */
static void undo(gg_md_parallel *p, gg_md *e, const gg_md_log *log, gg_md_record *r)
{
  const gg_md_saved *was = (gg_md_saved *)log->saved.item + r->saved;
  const gg_md_saved_more *more = (gg_md_saved_more *)log->more.item + r->saved;
  const uint32_t who[2] = {r->grain, r->partner};
  const int n = r->partner == GG_MD_NONE ? 1 : 2;
  const bool moves = r->crosses || gg_md_search_overlaps(e->search.kind); /* there cells are left in any event */
  for (int k = 0; moves && k < n; k++) change_cells(e, who[k], false);
  if (r->crosses && e->search.kind == GG_MD_NEIGHBOUR_LISTS)
    undo_list(e, r->grain, (gg_md_saved_list *)log->list.item + r->beside);
  for (int k = 0; k < n; k++) {
    e->grain[who[k]] = was[k].grain;
    e->node[who[k]] = was[k].node;
    if (e->spin) e->spin[who[k]] = more[k].spin;
    if (e->last) e->last[who[k]] = more[k].last;
    if (!moves) continue;
    change_cells(e, who[k], true);
    gg_md_note_layer(p, e, who[k]);
  }
  const gg_md_stamp *stamp = stamps_of(log, r);
  for (uint32_t k = r->touched; k-- > 0;) {
    gg_md_cell_state *c = &p->cell[stamp[k].cell];
    c->word = (c->word & ~(uint32_t)GG_MD_LAST) | (gg_md_bits_of(p, &stamp[k].before) & GG_MD_LAST);
    c->last = stamp[k].before.last;
  }
  r->gone = true;
}

static void undo_and_requeue(gg_md_slab *s, gg_md_undone *u)
{
  gg_md_record *r = u->record;
  const uint32_t who[2] = {r->grain, r->partner};
  double now[2];
  const int n = r->partner == GG_MD_NONE ? 1 : 2;
  for (int k = 0; k < n; k++) now[k] = s->view->node[who[k]].time;
  undo(s->all, s->view, u->log, r);
  for (int k = 0; k < n; k++) gg_md_requeue(s, who[k], now[k], s->view->node[who[k]].time);
}

/* First find out whether all of it is this slab's; in order of time, so that what follows is known when it comes. */
gg_md_taken gg_md_take_back(gg_md_slab *s, double time, const gg_md_touched *t)
{
  reader readers[2 * GG_MD_MOST_SLABS];
  int n = 0;
  for (int phase = 0; phase < s->phase - 1; phase++)
    for (int k = 0; k < s->all->n_slabs; k++) readers[n++] = read_from(&s->all->slab[k].log[phase], time);
  s->mark += (uint32_t)s->all->n_slabs;
  s->back.n = 0;
  for (uint32_t k = 0; k < t->n; k++) mark(s, t->cell[k], t->wide);
  for (reader *first; (first = earliest(readers, n));) {
    gg_md_record *r = first->next++;
    if (!is_marked(s, first->log, r)) continue;
    if (!is_inside(s, first->log, r)) return GG_MD_NOT_MINE;
    if (r->gone) continue;
    const gg_md_stamp *stamp = stamps_of(first->log, r);
    for (uint32_t k = 0; k < r->touched; k++) mark(s, stamp[k].cell, r->wide);
    *(gg_md_undone *)gg_md_append(s, &s->back, sizeof(gg_md_undone)) = (gg_md_undone){r, first->log};
  }
  for (uint32_t k = s->back.n; k-- > 0;) undo_and_requeue(s, (gg_md_undone *)s->back.item + k);
  return s->back.n ? GG_MD_TAKEN_BACK : GG_MD_NOTHING;
}

void gg_md_take_back_all(gg_md_parallel *p)
{
  for (int phase = GG_MD_PHASES; phase-- > 0;)
    for (int k = 0; k < p->n_slabs; k++) {
      const gg_md_log *log = &p->slab[k].log[phase];
      for (uint32_t m = log->record.n; m-- > 0;)
        if (!gg_md_record_at(log, m)->gone) undo(p, p->engine, log, gg_md_record_at(log, m));
    }
}
