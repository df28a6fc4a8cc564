/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One step: streaming, collisions, thermostat. */
#include <math.h>

#include "dsmc/dsmc.h"
#include "dsmc/dsmc_thermostat.h"

void gg_dsmc_synchronise(gg_dsmc *d)
{
  gg_dsmc_state *s = &d->now;
  double unit = s->temperature > 0 ? s->temperature : d->model.temperature0;
  /* A bath changes the velocity of the centre at every step, and removes it itself. */
  const gg_vec none = {0, 0, 0}, off = d->heat == GG_HEAT_BATHES ? none : s->centre;
  gg_dsmc_moments m = gg_dsmc_ensemble_synchronise(&d->ensemble, s->strain, 1, off, unit);
  s->temperature = m.temperature;
  s->fastest = m.fastest;
  s->centre = m.centre;
  s->strain = s->unsynchronised = 0;
  s->step = gg_dsmc_time_step_choose(&d->model, s->temperature);
}

/* Energy of centres that the Gaussian thermostat keeps, for rough grains without shear; else 0, and it returns the
 * energy lost in collisions. */
static double kept_by_centres(const gg_dsmc *d)
{
  const gg_model *m = &d->model;
  return m->rule != GG_SMOOTH && m->shear_rate == 0 ? d->now.kept : 0;
}

static void heat(gg_dsmc *d, double dt, double strain, double half)
{
  if (d->heat == GG_HEAT_SCALES) {
    d->now.lost = -gg_dsmc_thermostat_return(&d->ensemble, strain, kept_by_centres(d), d->now.lost, half);
    return;
  }
  if (d->heat == GG_UNHEATED) return;
  gg_dsmc_rng_lanes *lanes = d->schedule ? d->schedule->lanes : &d->now.lanes;
  if (d->heat == GG_HEAT_BATHES) {
    const gg_dsmc_bath_step step = {d->now.strain, strain, dt};
    gg_dsmc_thermostat_bath(&d->ensemble, &d->model, &step, &d->now.centre, lanes);
  } else {
    gg_dsmc_thermostat_kick(&d->ensemble, strain, d->noise * dt, lanes);
  }
}

/* Collisions and thermostat over `dt`, while the strain goes from `strain` to `strain + span`. */
static void collide(gg_dsmc *d, double dt, double strain, double span)
{
  d->interval_begin = d->now.time;
  /* Symmetric splitting: the second half mirrors the first. */
  if (d->heat == GG_UNHEATED && !d->model.turns) {
    gg_dsmc_collide(d, dt, strain, span, d->model.n_species == 1 ? GG_DSMC_FORWARD : GG_DSMC_SYMMETRIC);
  } else {
    double lost = d->now.lost;
    gg_dsmc_collide(d, 0.5 * dt, strain, 0.5 * span, GG_DSMC_FORWARD);
    heat(d, dt, strain + 0.5 * span, d->now.lost - lost);
    if (d->model.turns && d->heat != GG_HEAT_BATHES) gg_dsmc_ensemble_turn(&d->ensemble, d->model.torque, dt);
    d->interval_begin += 0.5 * dt;
    gg_dsmc_collide(d, 0.5 * dt, strain + 0.5 * span, 0.5 * span, GG_DSMC_BACKWARD);
  }
  if (d->heat == GG_UNHEATED) d->now.lost = 0; /* without a thermostat it would only grow, or change by units */
}

/* Length of the next step, if `left` time and `wanted` collisions remain. Steps of the length given by the scene are
 * cut short only if the model says so: in transient runs and for callers who advance by a given time. */
static double next_length(const gg_dsmc *d, double left, double wanted)
{
  double dt = d->now.step.length;
  if (d->model.time_step > 0) return d->model.cuts_steps ? fmin(dt, left) : dt;
  double rate = 0.5 * (double)d->model.n * gg_common_model_collision_rate(&d->model, d->now.temperature);
  return fmin(fmin(dt, left), fmax(wanted / rate, 1e-3 * dt));
}

double gg_dsmc_step(gg_dsmc *d, double left, double wanted)
{
  gg_dsmc_state *s = &d->now;
  double dt = next_length(d, left, wanted), span = d->model.shear_rate * dt;
  /* Strang (SIAM J. Numer. Anal. 5 (1968) 506): half the streaming, all collisions, the other half. For collisions of
   * stored velocities this is a constant strain of one half. */
  if (s->step.split)
    collide(d, dt, s->strain + 0.5 * span, 0);
  else
    collide(d, dt, s->strain, span);
  s->strain += span;
  s->time += dt;
  s->unsynchronised += dt;
  /* A synchronisation costs as much as several collisions a grain: it is done only as often as the temperature changes.
   */
  if (s->unsynchronised >= s->step.synchronise || fabs(s->strain) >= 1) gg_dsmc_synchronise(d);
  return dt;
}
