/* One step: streaming, collisions, thermostat. */
#include "dsmc/dsmc.h"
#include "dsmc/thermostat.h"

void gg_dsmc_settle(gg_dsmc *d)
{
  gg_dsmc_state *s = &d->now;
  double unit = s->temperature > 0 ? s->temperature : d->model.temperature0;
  gg_moments m = gg_ensemble_settle(&d->ensemble, s->drift, 1, s->centre, unit);
  s->temperature = m.temperature;
  s->fastest = m.fastest;
  s->centre = m.centre;
  s->drift = s->unsettled = 0;
  s->step = gg_time_step_choose(&d->model, s->temperature);
}

static void heat(gg_dsmc *d, double dt, double drift, double half)
{
  if (d->thermostat == GG_GAUSSIAN) {
    d->now.lost = -gg_thermostat_return(&d->ensemble, drift, d->now.lost, half);
  } else {
    gg_rng_lanes *lanes = d->tournament ? d->tournament->lanes : &d->now.lanes;
    gg_thermostat_kick(&d->ensemble, drift, d->noise * dt, lanes);
  }
}

/* Collisions and thermostat over `dt`, while the drift goes from `drift` to `drift + span`. */
static void collide(gg_dsmc *d, double dt, double drift, double span)
{
  d->stretch = d->now.time;
  /* The second half mirrors the first, so that turns cancel to second order. */
  if (d->thermostat == GG_NO_THERMOSTAT) {
    gg_dsmc_collide(d, dt, drift, span, d->model.n_species == 1 ? GG_TURNS_THERE : GG_TURNS_THERE_AND_BACK);
    return;
  }
  double lost = d->now.lost;
  gg_dsmc_collide(d, 0.5 * dt, drift, 0.5 * span, GG_TURNS_THERE);
  heat(d, dt, drift + 0.5 * span, d->now.lost - lost);
  d->stretch += 0.5 * dt;
  gg_dsmc_collide(d, 0.5 * dt, drift + 0.5 * span, 0.5 * span, GG_TURNS_BACK);
}

/* The step to take with `left` time and `wanted` collisions to go: a step that the scene asked for is taken whole. */
static double next_length(const gg_dsmc *d, double left, double wanted)
{
  double dt = d->now.step.length;
  if (d->model.time_step > 0) return dt;
  double rate = 0.5 * (double)d->model.n * gg_model_collision_rate(&d->model, d->now.temperature);
  return fmin(fmin(dt, left), fmax(wanted / rate, 1e-3 * dt));
}

double gg_dsmc_step(gg_dsmc *d, double left, double wanted)
{
  gg_dsmc_state *s = &d->now;
  double dt = next_length(d, left, wanted), span = d->model.shear_rate * dt;
  /* Strang (SIAM J. Numer. Anal. 5 (1968) 506): half the streaming, all collisions, the other half. With collisions in
   * stored velocities this is nothing but a constant half drift. */
  if (s->step.split)
    collide(d, dt, s->drift + 0.5 * span, 0);
  else
    collide(d, dt, s->drift, span);
  s->drift += span;
  s->time += dt;
  s->unsettled += dt;
  /* Going through the ensemble costs as much as some collisions a grain: not oftener than the temperature changes. */
  if (s->unsettled >= s->step.settle || s->drift >= 1) gg_dsmc_settle(d);
  return dt;
}
