#include "dsmc/timestep.h"

static double smaller(double a, double b)
{
  return a < b ? a : b;
}

gg_time_step gg_time_step_choose(const gg_model *model, double T)
{
  double free_time = 1 / gg_model_collision_rate(model, T);
  gg_time_step step = {.length = 0.25 * free_time};
  if (model->shear_rate > 0) step.length = smaller(step.length, 0.25 / model->shear_rate);
  if (model->time_step > 0) {
    step.length = model->time_step * free_time;
    step.split = model->shear_rate > 0;
  }
  return step;
}
