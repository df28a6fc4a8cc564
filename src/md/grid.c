/* The grid that suits a model, and the grains' places in it. */
#include <math.h>

#include "md/state.h"

/* Dilute, a cell holds this many grains: fewer crossings against more pairs to try. */
#define GRAINS_PER_CELL 0.5

double gg_md_reach(const gg_model *m)
{
  double widest = fmax(m->sigma[0], m->n_species > 1 ? m->sigma[3] : 0);
  return widest * (1 + 1e-9);
}

gg_status gg_md_make_grid(gg_md *e, gg_error *err)
{
  double reach = gg_md_reach(&e->model);
  double width = fmax(reach, cbrt(GRAINS_PER_CELL * e->model.volume / (double)e->model.n));
  int32_t n[3];
  gg_cells_count(&e->box, width, n);
  return gg_cells_make(&e->cells, &e->box, n, reach, err);
}

void gg_md_enter_grid(gg_md *e)
{
  for (uint32_t i = 0; i < e->n; i++) {
    gg_vec r = e->grain[i].r;
    for (int a = 0; a < 3; a++) {
      int32_t k = (int32_t)(gg_along(&r, a) * e->cells.inverse[a]);
      e->node[i].cell[a] = k < e->cells.n[a] ? k : e->cells.n[a] - 1;
    }
  }
}

void gg_md_chain_grid(gg_md *e)
{
  for (uint32_t i = e->n; i-- > 0;) {
    uint32_t *head = &e->cells.head[gg_cell_index(&e->cells, e->node[i].cell)];
    e->grain[i].next = *head;
    *head = i;
  }
}
