#include "measure/pairs.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

double gg_pairs_longest_reach(const gg_model *m)
{
  return fmin(fmin(m->box[0], m->box[1]), m->box[2]) / 2;
}

/* Cells at least half a reach wide, also across when the box is most oblique, D = L_x/2. */
gg_status gg_pairs_init(gg_pairs *p, const gg_model *m, double reach, gg_error *err)
{
  double slant = m->shear_rate != 0 ? hypot(1, 0.5 * m->box[0] / m->box[1]) : 1, count = 1;
  *p = (gg_pairs){.reach = reach, .n = (size_t)m->n};
  for (int a = 0; a < 3; a++) {
    double width = fmax(reach / 2, cbrt(m->volume / (double)m->n)); /* about one grain a cell at the least */
    p->cells[a] = (int)fmin(floor(m->box[a] / (a == 0 ? slant : 1) / width), 1024);
    count *= fmax(p->cells[a], 1);
  }
  p->start = gg_new_array((size_t)count + 1, sizeof *p->start, err);
  p->grain = gg_new_array(p->n, sizeof *p->grain, err);
  p->cell = gg_new_array(p->n, sizeof *p->cell, err);
  if (p->start && p->grain && p->cell) return GG_OK;
  gg_pairs_clear(p);
  return GG_FAILED;
}

void gg_pairs_clear(gg_pairs *p)
{
  free(p->start);
  free(p->grain);
  free(p->cell);
  *p = (gg_pairs){0};
}

gg_images gg_images_of(const gg_snapshot *s)
{
  gg_images b = {.offset = s->model->shear_rate != 0 ? s->offset : 0};
  for (int a = 0; a < 3; a++) b.edge[a] = s->model->box[a], b.inverse[a] = 1 / b.edge[a];
  b.offset -= b.edge[0] * gg_round_half(b.offset * b.inverse[0]);
  return b;
}

static int index_of(double share, int n)
{
  int k = (int)((share - floor(share)) * n);
  return k < n ? k : n - 1;
}

void gg_pairs_sort(gg_pairs *p, const gg_snapshot *s, const gg_images *b)
{
  size_t cells = (size_t)p->cells[0] * (size_t)p->cells[1] * (size_t)p->cells[2];
  memset(p->start, 0, (cells + 1) * sizeof *p->start);
  for (size_t i = 0; i < s->n; i++) {
    double y = s->r[1][i] * b->inverse[1], x = (s->r[0][i] - b->offset * y) * b->inverse[0];
    int cx = index_of(x, p->cells[0]), cy = index_of(y, p->cells[1]);
    int cz = index_of(s->r[2][i] * b->inverse[2], p->cells[2]);
    p->cell[i] = (uint32_t)((cz * p->cells[1] + cy) * p->cells[0] + cx);
    p->start[p->cell[i]]++;
  }
  uint32_t end = 0;
  for (size_t c = 0; c <= cells; c++) {
    end += c < cells ? p->start[c] : 0;
    p->start[c] = end;
  }
  for (size_t i = s->n; i-- > 0;) p->grain[--p->start[p->cell[i]]] = (uint32_t)i;
}
