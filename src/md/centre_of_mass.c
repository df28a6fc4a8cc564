/* The frame follows the centre of mass. */
#include "md/md_state.h"

/* Rounding of the mean peculiar velocity must not take over. A gas that cools forever cools below it; under shear, that
 * along y drives the one along x for ever (dP_x/dt = -rate P_y). The frame follows it: relative motion, and so every
 * predicted collision, stays as it is. */
void gg_md_follow_centre_of_mass(gg_md *e)
{
  const double rate = e->model.shear_rate, middle = 0.5 * e->box.edge[1];
  gg_vec momentum = {0, 0, 0};
  double mass = 0;
  for (uint32_t i = 0; i < e->n; i++) {
    const gg_md_grain *g = &e->grain[i];
    double m = e->model.mass[gg_md_species_of(g)];
    gg_vec c = g->v;
    if (rate != 0) c.x -= rate * (g->r.y - middle);
    momentum = gg_axpy(m, c, momentum);
    mass += m;
  }
  for (uint32_t i = 0; i < e->n; i++) e->grain[i].v = gg_axpy(-1 / mass, momentum, e->grain[i].v);
}
