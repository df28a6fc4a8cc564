/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The contact time, in units of the measured mean free time, but of no less than half of Enskog's mean free time at the
 * present temperature. In an inelastic collapse the time between collisions shrinks, and a contact time that followed
 * it would not end the collapse. */
#include <math.h>

#include "md/epoch.h"

static gg_vec peculiar(const gg_md *e, const gg_md_grain *g)
{
  gg_vec c = g->v;
  c.x -= e->model.shear_rate * (g->r.y - 0.5 * e->box.edge[1]);
  return c;
}

double gg_md_temperature(const gg_md *e)
{
  gg_vec momentum = {0, 0, 0};
  double mass = 0, energy = 0;
  for (uint32_t i = 0; i < e->n; i++) {
    const double m = e->model.mass[gg_md_species_of(&e->grain[i])];
    const gg_vec c = peculiar(e, &e->grain[i]);
    momentum = gg_axpy(m, c, momentum);
    mass += m;
    energy += m * gg_dot(c, c);
  }
  return fmax(energy - gg_dot(momentum, momentum) / mass, 0) / (3.0 * e->n);
}

double gg_md_early_temperature(const gg_md *e, double T)
{
  const double sheared = gg_model_is_sheared(&e->model) ? 0.01 : 0, bath = e->model.bath.on ? e->k.kick_temperature : 0;
  return fmax(T, fmax(sheared, bath));
}

/* Largest energy m g L_y, over the temperature, of a gravity that keeps no grain down. */
#define LIGHT 1.0

/* Unit of the contact time. Under gravity grains come to rest on a wall and on each other, where the mean free time
 * shrinks to t_c itself: there the unit is the time of a fall by a diameter. But under very weak gravity that is longer
 * than all times between collisions, and no collision would lose energy: there the smaller of both times is the unit.
 */
static double unit_of(const gg_md *e, double free_time, double T)
{
  const double g = fabs(e->gravity.y), fall = 1 / sqrt(g);
  double mass = 0;
  if (g == 0) return free_time;
  for (int k = 0; k < e->model.n_species; k++) mass += e->model.mass[k] * (double)e->model.n_of[k] / e->n;
  return mass * g * e->box.edge[1] < LIGHT * T && free_time < fall ? free_time : fall;
}

void gg_md_begin_contact_time(gg_md *e, double T)
{
  e->k.contact_time = e->model.contact_time * unit_of(e, e->k.mean_free_time, T);
}

void gg_md_follow_contact_time(gg_md *e)
{
  if (!(e->model.contact_time > 0)) return;
  const double T = gg_md_temperature(e),
               rate = gg_common_model_collision_rate(&e->model, gg_md_early_temperature(e, T));
  const double free_time = fmax(e->k.mean_free_time, rate > 0 ? 0.5 / rate : 0);
  e->k.contact_time = e->model.contact_time * unit_of(e, free_time, T);
}
