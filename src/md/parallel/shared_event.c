/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One event of a window: it runs in the event loop of the serial engine, and its log holds all that a rollback needs.
 */
#include <string.h>

#include "md/parallel/slab.h"

static void save(gg_md_slab *s, gg_md_log *log, uint32_t i)
{
  const gg_md *e = s->local;
  gg_md_saved *was = gg_md_append(s, &log->part[GG_MD_LOG_SAVED], sizeof *was);
  was->grain = e->grain[i];
  was->node = e->node[i];
  if (!e->spin && !e->last && !e->image) return;
  gg_md_saved_more *more = gg_md_append(s, &log->part[GG_MD_LOG_MORE], sizeof *more);
  if (e->spin) more->spin = e->spin[i];
  if (e->last) more->last = e->last[i];
  if (e->image) more->image = e->image[i];
}

static void save_list(gg_md_slab *s, gg_md_log *log, uint32_t i)
{
  const gg_md_lists *lists = &s->local->search.lists;
  gg_md_saved_list *was = gg_md_append(s, &log->part[GG_MD_LOG_LISTS], sizeof *was);
  memcpy(was->neighbour, lists->neighbour + (size_t)i * GG_MD_LIST, sizeof was->neighbour);
  was->skin = lists->skin[i];
}

static gg_md_record *begin_record(gg_md_slab *s, gg_md_due due, const gg_md_footprint *t)
{
  gg_md_log *log = &s->log[s->phase - 1];
  gg_md_record *r = gg_md_append(s, &log->part[GG_MD_LOG_RECORDS], sizeof *r);
  *r = (gg_md_record){.time = due.time,
                      .grain = due.grain,
                      .partner = t->collides ? s->local->node[due.grain].partner : GG_MD_NONE,
                      .saved = log->part[GG_MD_LOG_SAVED].n,
                      .cells = log->part[GG_MD_LOG_CELLS].n,
                      .n_cells = t->n,
                      .beside = t->crosses ? log->part[GG_MD_LOG_LISTS].n : log->part[GG_MD_LOG_ADDENDS].n,
                      .crosses = t->crosses,
                      .wide = t->wide};
  for (uint32_t k = 0; k < t->n; k++)
    *(gg_md_saved_cell *)gg_md_append(s, &log->part[GG_MD_LOG_CELLS], sizeof(gg_md_saved_cell)) =
        (gg_md_saved_cell){t->cell[k], t->layer[k], s->all->cell[t->cell[k]]};
  save(s, log, due.grain);
  if (t->collides) save(s, log, s->local->node[due.grain].partner);
  if (t->crosses && s->local->search.kind == GG_MD_NEIGHBOUR_LISTS) save_list(s, log, due.grain);
  return r;
}

/* Reset the counts of the local engine: they are of this event alone. */
static void clear_counts(gg_md *v, gg_md_record *r)
{
  v->k.events = v->k.collisions = v->k.treated = v->k.clamped = 0;
  v->k.worst_overlap = 0;
  if (r->partner == GG_MD_NONE) return;
  r->pair = (uint16_t)gg_pair(gg_md_species_of(&v->grain[r->grain]), gg_md_species_of(&v->grain[r->partner]));
  memset(v->k.transfer.stress[r->pair], 0, sizeof v->k.transfer.stress[r->pair]);
  v->k.transfer.loss[r->pair] = v->k.transfer.given[r->pair] = 0;
}

static void keep_counts(gg_md_slab *s, gg_md_record *r)
{
  const gg_md_counts *k = &s->local->k;
  if (r->partner == GG_MD_NONE) return;
  gg_md_addend *a = gg_md_append(s, &s->log[s->phase - 1].part[GG_MD_LOG_ADDENDS], sizeof *a);
  r->treated = k->treated > 0, r->clamped = k->clamped > 0;
  a->overlap = k->worst_overlap;
  const double(*stress)[3] = k->transfer.stress[r->pair];
  *a = (gg_md_addend){{stress[0][0], stress[1][1], stress[2][2], stress[0][1], stress[1][0]},
                      k->transfer.loss[r->pair],
                      k->transfer.given[r->pair],
                      k->worst_overlap};
}

/* Run one event in the event loop of the local engine. Its queue holds this event and, to be prefetched, the next one.
 */
static void run_event(gg_md_slab *s, gg_md_due due)
{
  gg_md *v = s->local;
  const bool more = s->at < s->due.n;
  if (more) s->pair[0] = ((gg_md_due *)s->due.item)[s->at];
  s->pair[more] = due;
  v->queue.n_due = 1 + more;
  v->kernel->run(v);
}

void gg_md_run_in_window(gg_md_slab *s, gg_md_due due, const gg_md_footprint *t)
{
  gg_md *v = s->local;
  gg_md_record *r = begin_record(s, due, t);
  if (s->out_of_memory) return;
  const gg_md_log *log = &s->log[s->phase - 1];
  clear_counts(v, r);
  run_event(s, due);
  keep_counts(s, r);
  for (uint32_t k = 0; k < t->n; k++) {
    gg_md_cell_state *c = &s->all->cell[t->cell[k]];
    gg_md_set_bits(s->all, c, GG_MD_LAST, (uint32_t)s->phase);
    c->last = gg_md_window_time(s->all, due.time);
  }
  const bool moves = t->crosses || gg_md_search_overlaps(v->search.kind);
  if (moves) gg_md_set_layer(s->all, v, due.grain);
  if (moves && t->collides) gg_md_set_layer(s->all, v, r->partner);
  gg_md_requeue(s, due.grain, due.time, v->node[due.grain].time);
  if (!t->collides) return;
  const gg_md_saved *was = (gg_md_saved *)log->part[GG_MD_LOG_SAVED].item + r->saved + 1;
  gg_md_requeue(s, r->partner, was->node.time, v->node[r->partner].time);
}
