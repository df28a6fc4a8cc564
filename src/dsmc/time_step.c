/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "dsmc/time_step.h"

#include <math.h>

#include "common/thermostat.h"

/* Relative bias of the most affected mean for a step of one mean free time; it goes with the square of the step.
 * Measured in the Boltzmann limit: streaming and collisions split: viscosity .080 at e = .9, .072 at e = .6
 * (temperature: .047, .031); pairs of species: temperature ratio .003; a thermostat split from collisions, over the
 * square of the energy that a collision of smooth grains destroys, 1 - e^2: cooling rate .0139 at e = .5, .0128 at .8,
 * Gaussian, and .0144, .0125 of white noise. */
static const double bias_of_splitting = 0.08, bias_of_alternation = 0.008, bias_of_thermostat = 0.0145;
/* A bath: where drag takes 2 gamma h and collisions zeta h, small, in a step h, the temperature at its end is lower by
 * gamma zeta h^2/6 more than that of a thermostat; zeta is the collision rate times a third of the loss. */
static const double bias_of_drag = 1. / 18;
/* A bath under shear, over the square of h gamma in time: drag and the anisotropy that collisions undo take turns.
 * Found in T: .02 to .45 in eleven states, most where drag alone balances the work of shear (T_b = 0, phi = .3). Where
 * streaming is split, too, over the square of h times the shear rate: .005 to .33, most near a turning point. */
static const double bias_of_sheared_drag = 0.6, bias_of_sheared_bath = 0.3;

/* A run that asks for an error takes steps whose bias is so small a share of it; in a bath all do. */
static const double share = 0.2, usual_error = 0.01;

static double smaller(double a, double b)
{
  return a < b ? a : b;
}

/* 1 - e^2, and what rough grains lose besides. */
static double loss_of(const gg_model *m)
{
  const double eta1 = (1 + m->e[GG_11]) / 2, K = m->inertia[0];
  const double eta2 = m->rule == GG_SMOOTH ? 0 : (1 + m->beta[GG_11]) * K / (2 * (1 + K));
  return 4 * (eta1 * (1 - eta1) + eta2 * (1 - eta2));
}

/* Of the fastest drag, in a mean free time. */
static double drag_of(const gg_model *m, double free_time)
{
  double drag = 0;
  for (int i = 0; i < m->n_species; i++) drag = fmax(drag, fmax(fabs(m->bath.drag[i]), m->bath.spin_drag[i]));
  return drag * free_time;
}

/* Of means, over the square of the step: where a thermostat or pairs of species take turns with collisions. */
static double alternation_of(const gg_model *m, double free_time)
{
  const double loss = loss_of(m), drag = drag_of(m, free_time);
  const double sheared = m->shear_rate != 0 ? bias_of_sheared_drag * drag * drag : 0;
  const double bath = bias_of_drag * loss * drag + sheared;
  if (m->n_species > 1) return bias_of_alternation + bath;
  if (m->bath.on) return bias_of_thermostat * loss * loss + bath;
  return gg_common_thermostat_of(m) != GG_NO_THERMOSTAT ? bias_of_thermostat * loss * loss : 0;
}

/* Where streaming and collisions take turns, too. */
static double split_of(const gg_model *m, double free_time)
{
  const double strain = m->shear_rate * free_time;
  return bias_of_splitting + (m->bath.on ? bias_of_sheared_bath * strain * strain + alternation_of(m, free_time) : 0);
}

/* In mean free times. */
static double alternate_every(const gg_model *m, double free_time)
{
  const double bias = alternation_of(m, free_time);
  const double error = m->asked_error > 0 ? m->asked_error : m->bath.on ? usual_error : 0;
  return error > 0 && bias > 0 ? smaller(0.25, sqrt(share * error / bias)) : 0.25;
}

gg_dsmc_time_step gg_dsmc_time_step_choose(const gg_model *model, double T)
{
  bool heated = gg_common_thermostat_of(model) != GG_NO_THERMOSTAT;
  double free_time = 1 / gg_common_model_collision_rate(model, T);
  gg_dsmc_time_step step = {.synchronise = heated ? free_time : 3 * free_time,
                            .length = heated ? alternate_every(model, free_time) * free_time : free_time};
  if (!heated && model->shear_rate == 0) step.length = step.synchronise; /* the kernel needs no step at all */
  if (model->shear_rate > 0) step.length = smaller(step.length, 0.5 / model->shear_rate);
  step.splitting =
      model->n_species == 1 ? step.length : smaller(step.length, alternate_every(model, free_time) * free_time);
  if (model->time_step > 0) {
    step.splitting = step.length = model->time_step * free_time;
    step.split = model->shear_rate > 0;
  }
  const double h = step.splitting / free_time;
  step.bias = (step.split ? split_of(model, free_time) : alternation_of(model, free_time)) * h * h;
  return step;
}
