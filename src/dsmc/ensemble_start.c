/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Initial velocities and spins. */
#include <math.h>

#include "dsmc/ensemble.h"

/* Scale the spins to exactly sum K m s^2 = 3 N theta, since perfectly rough grains conserve their total energy. Then
 * add the mean spin, by default that of the vorticity. */
static void start_spins(const gg_model *model, gg_dsmc_ensemble *e)
{
  double energy = 0, grains = 0;
  for (int i = 0; i < e->n_species; i++) {
    const gg_dsmc_population *p = &e->of[i];
    grains += p->n;
    for (uint32_t a = 0; p->s && a < p->n; a++) {
      gg_vec s = gg_dsmc_block_get(p, p->s, a);
      energy += p->inertia * p->mass * gg_dot(s, s);
    }
  }
  double factor = energy > 0 ? sqrt(3 * grains * model->ratio0 * model->temperature0 / energy) : 0;
  for (int i = 0; i < e->n_species; i++) {
    gg_dsmc_population *p = &e->of[i];
    double mean_spin = gg_model_starting_spin(model, i);
    for (uint32_t a = 0; p->s && a < p->n; a++) {
      gg_vec s = gg_scale(factor, gg_dsmc_block_get(p, p->s, a));
      s.z += mean_spin;
      gg_dsmc_block_set(p, p->s, a, s);
    }
  }
}

bool gg_dsmc_ensemble_start(const gg_model *model, gg_dsmc_ensemble *e, gg_rng *rng)
{
  for (int i = 0; i < e->n_species; i++) {
    gg_dsmc_population *p = &e->of[i];
    double speed = sqrt(model->temperature0 / p->mass), spin = sqrt(model->ratio0 * model->temperature0 / p->mass);
    for (uint32_t a = 0; a < p->n; a++) {
      if (gg_dsmc_start_is_stopped(model, a)) return false;
      gg_dsmc_block_set(p, p->c, a, gg_scale(speed, gg_common_rng_velocity(rng, model->a2_0)));
      if (p->s) gg_dsmc_block_set(p, p->s, a, gg_scale(spin / sqrt(p->inertia), gg_common_rng_normal_vec(rng)));
    }
  }
  start_spins(model, e);
  gg_vec none = {0, 0, 0};
  gg_dsmc_moments m = gg_dsmc_ensemble_synchronise(e, 0, 1, gg_dsmc_ensemble_synchronise(e, 0, 1, none, 1).centre, 1);
  double factor = sqrt(model->temperature0 / m.temperature);
  for (int i = 0; i < e->n_species; i++) {
    gg_dsmc_population *p = &e->of[i];
    for (uint32_t a = 0; a < p->n; a++) gg_dsmc_block_set(p, p->c, a, gg_scale(factor, gg_dsmc_block_get(p, p->c, a)));
  }
  return true;
}
