/* Events that ran too early, and all that followed from them, are taken back: latest first, each leaves all as it was
 * before it. */
#include <stdlib.h>

#include "md/parallel/slab.h"

static gg_md_cell_state *state_at(const gg_md_slab *s, const int32_t at[3])
{
  return &s->all->cell[gg_md_cell_index(&s->view->cells, at)];
}

/* Equal times, too: which of both comes first is seen when both wait in one queue. */
static bool is_overtaken_at(const gg_md_slab *s, double time, const int32_t at[3])
{
  uint32_t index[GG_MD_MOST_AROUND];
  const uint32_t before = (s->number & ~3u) + 1;
  const int n = gg_md_cells_around(s->view, at, index);
  for (int k = 0; k < n; k++) {
    const gg_md_cell_state *c = &s->all->cell[index[k]];
    if (c->phase - before < s->number - before && c->last >= time) return true;
  }
  return false;
}

bool gg_md_is_overtaken(const gg_md_slab *s, double time, const gg_md_touched *t)
{
  if (s->phase == 1) return false;
  for (uint32_t k = 0; k < t->n; k++)
    if (is_overtaken_at(s, time, t->at[k])) return true;
  return false;
}

static void mark_around(const gg_md_slab *s, const gg_md_touched *t, uint32_t mark)
{
  uint32_t index[GG_MD_MOST_AROUND];
  for (uint32_t k = 0; k < t->n; k++)
    for (int n = gg_md_cells_around(s->view, t->at[k], index) - 1; n >= 0; n--) s->all->cell[index[n]].mark = mark;
}

/* Does it touch a marked cell? What is known of cells of other slabs is theirs alone. */
static bool is_marked(const gg_md_slab *s, const gg_md_touched *t, uint32_t mark)
{
  for (uint32_t k = 0; k < t->n; k++)
    if (gg_md_layer_of(s, t->at[k])->owner == s->self && state_at(s, t->at[k])->mark == mark) return true;
  return false;
}

/* The cells around are this slab's, too. */
static bool is_inside(const gg_md_slab *s, const gg_md_touched *t)
{
  for (uint32_t k = 0; k < t->n; k++) {
    const gg_md_layer *layer = gg_md_layer_of(s, t->at[k]);
    if (layer->owner != s->self || layer->depth < 1) return false;
  }
  return true;
}

/* The logs of earlier phases, from a time on. */
typedef struct reader {
  gg_md_record *next, *end;
} reader;

static reader read_from(const gg_md_growing *log, double time)
{
  uint32_t low = 0, high = log->n;
  while (low < high) {
    const uint32_t middle = (low + high) / 2;
    if (gg_md_record_at(log, middle)->time < time)
      low = middle + 1;
    else
      high = middle;
  }
  return (reader){gg_md_record_at(log, low), gg_md_record_at(log, log->n)};
}

static gg_md_record *read_earliest(reader *readers, int n)
{
  reader *first = NULL;
  for (int k = 0; k < n; k++)
    if (readers[k].next < readers[k].end && (!first || readers[k].next->time < first->next->time)) first = &readers[k];
  return first ? first->next++ : NULL;
}

/* Bring a record's grains, cells and counts back to what they were; not the event queue. */
static void undo(gg_md_parallel *p, const gg_md *e, gg_md_record *r)
{
  const int n = r->partner == GG_MD_NONE ? 1 : 2;
  if (r->crossed) gg_md_cell_remove(gg_md_cell_at(&e->cells, e->node[r->grain].cell), r->grain);
  for (int k = 0; k < n; k++) {
    const uint32_t i = k ? r->partner : r->grain;
    e->grain[i] = r->was[k].grain;
    e->node[i] = r->was[k].node;
    if (e->spin) e->spin[i] = r->was[k].spin;
    if (e->last) e->last[i] = r->was[k].last;
  }
  if (r->crossed) {
    const int32_t *at = e->node[r->grain].cell;
    gg_md_cell_add(&e->cells, at, r->grain); /* those who came later have left: there is room */
    atomic_store_explicit(&p->layer[r->grain], (uint16_t)at[2], memory_order_relaxed);
  }
  for (uint32_t k = r->touched.n; k-- > 0;) {
    gg_md_cell_state *c = &p->cell[gg_md_cell_index(&e->cells, r->touched.at[k])];
    c->last = r->last[k];
    c->phase = r->phase[k];
  }
  r->gone = true;
}

static void undo_and_requeue(gg_md_slab *s, gg_md_record *r)
{
  const uint32_t who[2] = {r->grain, r->partner};
  double now[2];
  const int n = r->partner == GG_MD_NONE ? 1 : 2;
  for (int k = 0; k < n; k++) now[k] = s->view->node[who[k]].time;
  undo(s->all, s->view, r);
  for (int k = 0; k < n; k++) gg_md_requeue(s, who[k], now[k], r->was[k].node.time);
}

/* First find out whether all of it is this slab's; in order of time, so that what follows is known when it comes. */
bool gg_md_take_back(gg_md_slab *s, double time, const gg_md_touched *t)
{
  reader readers[2 * GG_MD_MOST_SLABS];
  int n = 0;
  for (int phase = 0; phase < s->phase - 1; phase++)
    for (int k = 0; k < s->all->n_slabs; k++) readers[n++] = read_from(&s->all->slab[k].log[phase], time);
  const uint32_t mark = s->mark += (uint32_t)s->all->n_slabs;
  if (!is_inside(s, t)) return false;
  mark_around(s, t, mark);
  s->back.n = 0;
  for (gg_md_record *r; (r = read_earliest(readers, n));) {
    if (!is_marked(s, &r->touched, mark)) continue;
    if (!is_inside(s, &r->touched)) return false;
    if (r->gone) continue;
    mark_around(s, &r->touched, mark);
    *(gg_md_record **)gg_md_append(s, &s->back, sizeof r) = r;
  }
  for (uint32_t k = s->back.n; k-- > 0;) undo_and_requeue(s, ((gg_md_record **)s->back.item)[k]);
  return true;
}

void gg_md_take_back_all(gg_md_parallel *p)
{
  for (int phase = GG_MD_PHASES; phase-- > 0;)
    for (int k = 0; k < p->n_slabs; k++) {
      const gg_md_growing *log = &p->slab[k].log[phase];
      for (uint32_t m = log->n; m-- > 0;)
        if (!gg_md_record_at(log, m)->gone) undo(p, p->engine, gg_md_record_at(log, m));
    }
}
