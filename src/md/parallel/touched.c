/* The cells that an event touches, and those around a cell, by kind of search. */
#include "md/parallel/slab.h"
#include "md/row_motion.h"

static int around_in_rows(const gg_md *e, const int32_t at[3], uint32_t *index)
{
  const gg_md_row *row = &e->search.rows.row[at[1]];
  const gg_md_cells *c = &e->cells;
  const uint32_t *y = c->part[1] + at[1], *z = c->part[2] + at[2];
  const uint32_t *x[3] = {c->part[0] + gg_md_index_in_row(e, at[0] + row->below), c->part[0] + at[0],
                          c->part[0] + gg_md_index_in_row(e, at[0] - row->above)};
  static const int from[3] = {-1, -1, -2}, to[3] = {2, 1, 1};
  int n = 0;
  for (int m = -1; m <= 1; m++)
    for (int l = -1; l <= 1; l++)
      for (int k = from[l + 1]; k <= to[l + 1]; k++) index[n++] = z[m] + y[l] + x[l + 1][k];
  return n;
}

int gg_md_cells_around(const gg_md *e, const int32_t at[3], uint32_t index[GG_MD_MOST_AROUND])
{
  if (e->search.kind == GG_MD_COMOVING_ROWS) return around_in_rows(e, at, index);
  const uint32_t *x = e->cells.part[0] + at[0], *y = e->cells.part[1] + at[1], *z = e->cells.part[2] + at[2];
  int n = 0;
  for (int m = -1; m <= 1; m++)
    for (int l = -1; l <= 1; l++)
      for (int k = -1; k <= 1; k++) index[n++] = z[m] + y[l] + x[k];
  return n;
}

static void add(gg_md_touched *t, int32_t x, int32_t y, int32_t z)
{
  int32_t *at = t->at[t->n++];
  at[0] = x, at[1] = y, at[2] = z;
}

static int32_t wrapped(int32_t k, int32_t n)
{
  return k < 0 ? k + n : k >= n ? k - n : k;
}

/* Into another row there are two cells in question. */
static void add_destination(const gg_md *e, const gg_md_node *node, gg_md_touched *t)
{
  const int axis = node->face >> 1, step = node->face & 1 ? 1 : -1;
  const int32_t *n = e->cells.n;
  int32_t at[3] = {node->cell[0], node->cell[1], node->cell[2]};
  at[axis] = wrapped(at[axis] + step, n[axis]);
  if (axis == 1 && e->search.kind == GG_MD_COMOVING_ROWS) {
    const gg_md_row *old = &e->search.rows.row[node->cell[1]];
    at[0] = gg_md_index_in_row(e, at[0] + (step > 0 ? -old->above - 1 : old->below));
    add(t, wrapped(at[0] + 1, n[0]), at[1], at[2]);
  }
  add(t, at[0], at[1], at[2]);
}

/* A partner that was elsewhere at the end of the last phase may be at work there: its node is not read. */
bool gg_md_find_touched(const gg_md_slab *s, uint32_t i, gg_md_touched *t)
{
  const gg_md *e = s->view;
  const gg_md_node *node = &e->node[i];
  t->n = 0;
  t->collides = false;
  add(t, node->cell[0], node->cell[1], node->cell[2]);
  if (node->time < node->collision) {
    add_destination(e, node, t);
    return true;
  }
  const uint32_t j = node->partner;
  const int32_t layer = atomic_load_explicit(&s->all->layer[j], memory_order_relaxed);
  if (s->all->layers[s->phase - 1][layer].owner != s->self) return false;
  add(t, e->node[j].cell[0], e->node[j].cell[1], e->node[j].cell[2]);
  t->collides = e->grain[j].counter == node->counter;
  return true;
}
