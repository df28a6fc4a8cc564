/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "md/md_thermostat.h"

#include <math.h>

static double kinetic_energy(const gg_md *e)
{
  double sum = 0;
  for (uint32_t i = 0; i < e->n; i++)
    sum += 0.5 * e->model.mass[gg_md_species_of(&e->grain[i])] * gg_dot(e->grain[i].v, e->grain[i].v);
  return sum;
}

void gg_md_thermostat_begin(gg_md *e)
{
  e->k.scale = 1;
  e->k.kinetic = e->k.kinetic0 = kinetic_energy(e);
}

void gg_md_thermostat_fold(gg_md *e)
{
  gg_md_counts *k = &e->k;
  double v = k->scale, t = 1 / v;
  for (uint32_t i = 0; i < e->n; i++) {
    e->grain[i].v = gg_scale(v, e->grain[i].v);
    e->node[i].time *= t;
    e->node[i].collision *= t;
    if (e->last) e->last[i] *= t;
    e->node[i].skin_time *= t;
  }
  double *times[] = {&k->now, &k->mark, &k->contact_time, &k->mean_free_time, &k->window_time, &k->epoch_start};
  for (size_t i = 0; i < sizeof times / sizeof *times; i++) *times[i] *= t;
  k->kinetic = kinetic_energy(e);
  k->scale = sqrt(k->kinetic0 / k->kinetic);
  k->stop = k->mark + (k->asked - k->outer) * k->scale;
}

/* Momentum relative to the imposed shear; all grains at the same time. */
static gg_vec momentum_of(const gg_md *e, double *total_mass, double *energy_twice)
{
  const double rate = e->model.shear_rate, middle = 0.5 * e->box.edge[1];
  gg_vec momentum = {0, 0, 0};
  double mass = 0, energy = 0;
  for (uint32_t i = 0; i < e->n; i++) {
    const gg_md_grain *g = &e->grain[i];
    double m = e->model.mass[gg_md_species_of(g)];
    gg_vec c = g->v;
    if (rate != 0) c.x -= rate * (g->r.y - middle);
    momentum = gg_axpy(m, c, momentum);
    mass += m;
    energy += m * gg_dot(c, c);
  }
  *total_mass = mass;
  *energy_twice = energy;
  return momentum;
}

/* Velocities that come from a run have a mean of the order of rounding, and must stay unchanged. */
bool gg_md_has_drift(const gg_md *e)
{
  double mass, energy;
  const gg_vec momentum = momentum_of(e, &mass, &energy);
  return gg_dot(momentum, momentum) > 1e-18 * mass * energy;
}

/* Rounding of the mean peculiar velocity must not become visible. A gas that cools without end cools below it; under
 * shear its y component drives its x component (dP_x/dt = -rate P_y). So the frame follows the centre of mass: relative
 * motion, and every predicted collision, is unchanged. */
double gg_md_follow_centre_of_mass(gg_md *e)
{
  double mass, energy;
  const gg_vec momentum = momentum_of(e, &mass, &energy);
  for (uint32_t i = 0; i < e->n; i++) e->grain[i].v = gg_axpy(-1 / mass, momentum, e->grain[i].v);
  return energy / (3.0 * e->n);
}

double gg_md_outer_time(const gg_md *e)
{
  return e->k.outer + (e->k.now - e->k.mark) / e->k.scale;
}

double gg_md_time(const gg_md *e)
{
  return e->heat == GG_HEAT_SCALES ? e->k.outer_time + gg_md_outer_time(e) : e->k.epoch_start + e->k.now;
}
