#include "dsmc/time_step.h"

#include "common/thermostat.h"

/* Relative bias of the most affected mean for a step of one mean free time; it goes with the square of the step.
 * Measured in the Boltzmann limit: streaming and collisions split: viscosity .080 at e = .9, .072 at e = .6
 * (temperature: .047, .031); thermostat, or pairs of species, split from collisions: cooling rate .008 at e = .5,
 * temperature ratio .003. */
static const double bias_of_splitting = 0.08, bias_of_alternation = 0.008;

static double smaller(double a, double b)
{
  return a < b ? a : b;
}

gg_dsmc_time_step gg_dsmc_time_step_choose(const gg_model *model, double T)
{
  bool heated = gg_thermostat_of(model) != GG_NO_THERMOSTAT;
  double free_time = 1 / gg_model_collision_rate(model, T);
  gg_dsmc_time_step step = {.synchronise = heated ? free_time : 3 * free_time,
                            .length = heated ? 0.25 * free_time : free_time};
  if (!heated && model->shear_rate == 0) step.length = step.synchronise; /* the kernel needs no step at all */
  if (model->shear_rate > 0) step.length = smaller(step.length, 0.5 / model->shear_rate);
  step.splitting = model->n_species == 1 ? step.length : smaller(step.length, 0.25 * free_time);
  if (model->time_step > 0) {
    step.splitting = step.length = model->time_step * free_time;
    step.split = model->shear_rate > 0;
  }
  double h = step.splitting / free_time;
  step.bias = step.split ? bias_of_splitting * h * h : heated || model->n_species > 1 ? bias_of_alternation * h * h : 0;
  return step;
}
