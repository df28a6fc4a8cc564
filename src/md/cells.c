#include "md/cells.h"

#include <stdlib.h>

void gg_cells_count(const gg_box *box, double width, int32_t n[3])
{
  for (int a = 0; a < 3; a++) {
    double fit = gg_floor(box->edge[a] / width);
    n[a] = fit < 1 ? 1 : fit > 65535 ? 65535 : (int32_t)fit;
  }
}

gg_status gg_cells_make(gg_cells *c, const gg_box *box, const int32_t n[3], double reach, gg_error *err)
{
  *c = (gg_cells){.reach = reach};
  size_t total = 1;
  for (int a = 0; a < 3; a++) {
    c->n[a] = n[a];
    c->width[a] = box->edge[a] / n[a];
    c->inverse[a] = n[a] / box->edge[a];
    total *= (size_t)n[a];
  }
  c->head = gg_new_array(total, sizeof *c->head, err);
  if (!c->head) return GG_FAILED;
  for (size_t k = 0; k < total; k++) c->head[k] = GG_NONE;
  return GG_OK;
}

void gg_cells_free(gg_cells *c)
{
  free(c->head);
  *c = (gg_cells){0};
}
