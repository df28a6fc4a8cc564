#include "md/md_thermostat.h"

#include <math.h>

/* Between kicks, in mean free times, on average. */
#define KICK_INTERVAL 0.1

static double kinetic_energy(const gg_md *e)
{
  double sum = 0;
  for (uint32_t i = 0; i < e->n; i++)
    sum += 0.5 * e->model.mass[gg_md_species_of(&e->grain[i])] * gg_dot(e->grain[i].v, e->grain[i].v);
  return sum;
}

static double kick_interval(const gg_md *e)
{
  return KICK_INTERVAL / gg_common_model_collision_rate(&e->model, e->model.temperature0);
}

void gg_md_thermostat_begin(gg_md *e)
{
  e->k.scale = 1;
  e->k.kinetic = e->k.kinetic0 = kinetic_energy(e);
  e->k.next_kick = e->thermostat == GG_WHITE_NOISE ? kick_interval(e) : INFINITY;
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

/* Relative to the imposed shear; all grains at the same time. */
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

/* Velocities that were read from a run have a mean of rounding, and are to stay as they are. */
bool gg_md_has_drift(const gg_md *e)
{
  double mass, energy;
  const gg_vec momentum = momentum_of(e, &mass, &energy);
  return gg_dot(momentum, momentum) > 1e-18 * mass * energy;
}

/* Rounding of the mean peculiar velocity must not take over. A gas that cools forever cools below it; under shear, that
 * along y drives the one along x for ever (dP_x/dt = -rate P_y). The frame follows it: relative motion, and so every
 * predicted collision, stays as it is. */
void gg_md_follow_centre_of_mass(gg_md *e)
{
  double mass, energy;
  const gg_vec momentum = momentum_of(e, &mass, &energy);
  for (uint32_t i = 0; i < e->n; i++) e->grain[i].v = gg_axpy(-1 / mass, momentum, e->grain[i].v);
}

/* Each kick brings what the time to the next one takes. No two intervals are alike: between equal ones T falls by some
 * percent, and a run whose samples keep in step with them would see the same part of that again and again (e = 0: means
 * off by up to 1 %). */
void gg_md_thermostat_kick(gg_md *e)
{
  const double interval = kick_interval(e) * (0.5 + gg_rng_uniform(&e->k.rng)), size = sqrt(3 * e->noise * interval);
  for (uint32_t i = 0; i < e->n; i++) {
    gg_md_grain *g = &e->grain[i];
    g->r = gg_md_position(e, false, g, e->k.now);
    g->t = e->k.now;
    g->v = gg_axpy(size, gg_rng_direction(&e->k.rng), g->v);
    g->counter++;
  }
  gg_md_follow_centre_of_mass(e);
  e->kernel->predict(e, 0, e->n);
  e->k.next_kick += interval;
}
