/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "dsmc/time_step.h"

#include <math.h>

#include "common/thermostat.h"

/* Relative bias of the most affected mean for a step of one mean free time; it is proportional to the square of the
 * step. Measured in the Boltzmann limit. Streaming split from collisions: viscosity .080 at e = .9, .072 at e = .6
 * (temperature: .047, .031). Pairs of species: temperature ratio .003. A thermostat split from collisions, over the
 * square of 1 - e^2, the energy lost in a collision of smooth grains: cooling rate .0139 at e = .5, .0128 at .8
 * (Gaussian), .0144 and .0125 (white noise). */
static const double bias_of_splitting = 0.08, bias_of_alternation = 0.008, bias_of_thermostat = 0.0145;
/* Bath: if drag takes 2 gamma h and collisions zeta h in a step h, both small, the temperature at its end is lower by
 * another gamma zeta h^2/6 than with a thermostat; zeta is the collision rate times a third of the loss. */
static const double bias_of_drag = 1. / 18;
/* Bath under shear, where drag alternates with collisions, which reduce anisotropy. Over the square of h gamma the bias
 * of T was .02 to .45 in eleven states, most if drag alone balances the work of shear (T_b = 0, phi = .3). If streaming
 * is split, too: over the square of h times the shear rate .005 to .33, most near a turning point. */
static const double bias_of_sheared_drag = 0.6, bias_of_sheared_bath = 0.3;
/* Torques against the friction of rough grains: of the mean spin, and of the balance of its energy. */
static const double bias_of_torque = 0.03;

/* Bias of the step as a fraction of the requested error. In a bath this limit holds without a requested error, too. */
static const double fraction = 0.2, usual_error = 0.01;

static double smaller(double a, double b)
{
  return a < b ? a : b;
}

/* Relative energy loss of a collision: 1 - e^2, and the loss of the tangential motion of rough grains. */
static double loss_of(const gg_model *m)
{
  const double eta1 = (1 + m->e[GG_11]) / 2, K = m->inertia[0];
  const double eta2 = m->rule == GG_SMOOTH ? 0 : (1 + m->beta[GG_11]) * K / (2 * (1 + K));
  return 4 * (eta1 * (1 - eta1) + eta2 * (1 - eta2));
}

/* Largest drag coefficient times the mean free time. */
static double drag_of(const gg_model *m, double free_time)
{
  double drag = 0;
  for (int i = 0; i < m->n_species; i++) drag = fmax(drag, fmax(fabs(m->bath.drag[i]), m->bath.spin_drag[i]));
  return drag * free_time;
}

/* Bias of means over the square of the step, by alternation of collisions with a thermostat or of pairs of species. */
static double alternation_of(const gg_model *m, double free_time)
{
  const double loss = loss_of(m), drag = drag_of(m, free_time);
  const double sheared = m->shear_rate != 0 ? bias_of_sheared_drag * drag * drag : 0;
  const double bath = bias_of_drag * loss * drag + sheared + (m->turns ? bias_of_torque : 0);
  if (m->n_species > 1) return bias_of_alternation + bath;
  if (m->bath.on || m->turns) return bias_of_thermostat * loss * loss + bath;
  return gg_common_heat_of(m) != GG_UNHEATED ? bias_of_thermostat * loss * loss : 0;
}

/* The same with streaming split from collisions. */
static double split_of(const gg_model *m, double free_time)
{
  const double strain = m->shear_rate * free_time;
  return bias_of_splitting +
         (m->bath.on || m->turns ? bias_of_sheared_bath * strain * strain + alternation_of(m, free_time) : 0);
}

/* Longest time of an alternation, in mean free times. */
static double alternate_every(const gg_model *m, double free_time)
{
  const double bias = alternation_of(m, free_time);
  const double error = m->asked_error > 0 ? m->asked_error : m->bath.on || m->turns ? usual_error : 0;
  return error > 0 && bias > 0 ? smaller(0.25, sqrt(fraction * error / bias)) : 0.25;
}

gg_dsmc_time_step gg_dsmc_time_step_choose(const gg_model *model, double T)
{
  bool heated = gg_common_heat_of(model) != GG_UNHEATED || model->turns;
  double free_time = 1 / gg_common_model_collision_rate(model, T);
  gg_dsmc_time_step step = {.synchronise = heated ? free_time : 3 * free_time,
                            .length = heated ? alternate_every(model, free_time) * free_time : free_time};
  if (!heated && model->shear_rate == 0) step.length = step.synchronise; /* collisions alone need no step */
  if (model->shear_rate != 0) step.length = smaller(step.length, 0.5 / fabs(model->shear_rate));
  step.splitting =
      model->n_species == 1 ? step.length : smaller(step.length, alternate_every(model, free_time) * free_time);
  if (model->time_step > 0) {
    step.splitting = step.length = model->time_step * free_time;
    step.split = model->shear_rate != 0;
  }
  const double h = step.splitting / free_time;
  step.bias = (step.split ? split_of(model, free_time) : alternation_of(model, free_time)) * h * h;
  return step;
}
