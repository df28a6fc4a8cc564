/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Description of the methods for a model, for `graingas info`. */
#include <stdio.h>

#include "common/thermostat.h"
#include "dsmc/dsmc.h"

const char *gg_dsmc_rule_line(gg_rule rule)
{
  static const char *const lines[] = {"smooth grains: no spins are kept", "rough grains: spins, constant beta",
                                      "frictional grains: spins, Coulomb's law"};
  return lines[rule];
}

void gg_dsmc_describe(const gg_model *m, void (*line)(void *context, const char *text), void *context)
{
  char text[160];
  snprintf(text, sizeof text, "%lld velocities in blocks of %d, in %s precision", (long long)m->n, GG_DSMC_LANES,
           m->single ? "single" : "double");
  line(context, text);
  size_t blocks = 0;
  for (int i = 0; i < m->n_species; i++) blocks += ((size_t)m->n_of[i] + GG_DSMC_LANES - 1) / GG_DSMC_LANES;
  int segments = gg_dsmc_segments_of(blocks);
  snprintf(text, sizeof text, "in %d segments, which threads share", segments);
  line(context, segments > 1 ? text : "not enough for threads to share");
  line(context, gg_dsmc_rule_line(m->rule));
  if (m->law.e) line(context, "a restitution law: collisions one by one, without the block kernels");
  if (m->law.name && !m->law.e) line(context, "coefficients follow from the speed of each collision, by a table");
  if (m->kicks) line(context, "kicks at every contact between grains");
  if (m->turns) line(context, "torques act in the middle of each step");
  line(context, m->boltzmann ? "Boltzmann limit: no contact value, no collisional stress, neither is computed"
                             : "Enskog: contact value and collisional stress");
  if (m->shear_rate == 0)
    line(context, "no shear: no streaming");
  else if (m->time_step > 0)
    line(context, "shear: streaming and collisions, symmetric splitting");
  else
    line(context, "shear: streaming followed exactly between collisions");
  static const char *const heats[] = {"no thermostat", "Gaussian thermostat: returns what collisions destroy",
                                      "white-noise thermostat",
                                      "bath: drag and noise, followed exactly between collisions"};
  line(context, heats[gg_common_heat_of(m)]);
  const gg_dsmc_time_step step = gg_dsmc_time_step_choose(m, m->temperature0);
  if (step.bias > 0) {
    snprintf(text, sizeof text, "step: %.2g mean free times%s; means lie about %.1g %% off by it",
             step.splitting * gg_common_model_collision_rate(m, m->temperature0), m->time_step > 0 ? "" : ", chosen",
             100 * step.bias);
    line(context, text);
  }
  line(context, m->n_species == 1 ? "one species: one majorant" : "several species: a majorant for each pair");
}
