#include "dsmc/timestep.h"

/* Relative bias of the viscosity of a split step of one mean free time, the most affected of the means: .080 at e = .9,
 * .072 at e = .6 in the Boltzmann limit (temperature: .047, .031); it goes with the square of the step. */
static const double split_bias = 0.08;

static double smaller(double a, double b)
{
  return a < b ? a : b;
}

gg_time_step gg_time_step_choose(const gg_model *model, double T)
{
  double free_time = 1 / gg_model_collision_rate(model, T);
  gg_time_step step = {.settle = free_time, .length = free_time};
  if (model->shear_rate > 0) step.length = smaller(step.length, 0.5 / model->shear_rate);
  if (model->time_step > 0) {
    step.length = model->time_step * free_time;
    step.split = model->shear_rate > 0;
    if (step.split) step.bias = split_bias * model->time_step * model->time_step;
  }
  return step;
}
