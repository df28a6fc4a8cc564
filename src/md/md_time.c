/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Estimated time of a collision. */
#include <math.h>

#include "common/thermostat.h"
#include "md/md_operations.h"

/* Grains in a cell, which is as wide as the largest grain, over their number if all grains were equal. */
static double crowding(const gg_model *m)
{
  double cubes = 0;
  for (int i = 0; i < m->n_species; i++) cubes += pow(m->diameter[i], 3) * (double)m->n_of[i] / (double)m->n;
  return pow(gg_common_model_widest(m), 3) / cubes;
}

/* Time of a collision with the kicks between collisions, over that of a collision alone. A kick takes nearly as long as
 * a collision, in a dilute gas less. The more energy collisions lose, the more kicks there are (md/kicks.c). */
static double cost_of_kicks(const gg_model *m)
{
  const bool sheared = gg_model_is_sheared(m);
  const double rate = gg_common_model_collision_rate(m, m->temperature0);
  double mass = 0;
  for (int i = 0; i < m->n_species; i++) mass += m->mass[i] * (double)m->n_of[i] / (double)m->n;
  const double loss = mass * gg_common_thermostat_noise(m) / m->temperature0 / rate;
  const double kicks = fmin(2, sheared ? 8 * loss : fmin(8 * loss, fmax(4 * loss, 0.28)));
  if (m->bath.drag[0] != 0) return 1 + fmax(kicks, 0.4 * (sheared ? 25 : 5.5) * fabs(m->bath.drag[0]) / rate);
  return gg_common_is_kicked(m) ? 1 + kicks : 1;
}

/* A grain crosses the more cells between two collisions the more dilute the gas is. Beyond 2000 grains the data leave
 * the cache. Walls add collisions with them, and parabolic paths under gravity. */
double gg_md_nanoseconds(const gg_model *m)
{
  const double cells = 180 + 115 / sqrt(fmax(m->phi, 1e-12)), cache = 1 + 0.2 * fmax(0, log((double)m->n / 2000));
  return cells * cache * crowding(m) * cost_of_kicks(m) * (m->walled ? 1.2 : 1);
}
