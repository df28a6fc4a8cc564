/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "measure/bursts.h"

#include <math.h>

/* A burst lasts for 24 collisions of a grain of the slowest species. Only flights that begin and end within the burst
 * are observed whole; with few collisions per burst only short flights would be. A species that collides more than
 * MOST_LONGER times more seldom than the average has no observed flights, instead of short ones only. */
enum { BURST = 12, BURSTS_ALIKE = 16, APART_FIRST = 32, GROWTH = 32, MOST_LONGER = 32 };
gg_bursts gg_measure_bursts_of(const gg_model *m)
{
  double slowest = INFINITY;
  for (int i = 0; i < m->n_species; i++) slowest = fmin(slowest, gg_common_model_species_rate(m, i, 1));
  double longer = fmin(ceil(gg_common_model_collision_rate(m, 1) / slowest * (1 - 1e-9)), MOST_LONGER);
  uint64_t length = BURST * (uint64_t)fmax(longer, 1), first = 2 * length > APART_FIRST ? 2 * length : APART_FIRST;
  return (gg_bursts){length, first, GROWTH * first, BURSTS_ALIKE * (GROWTH - 1) * first};
}

/* Sixteen bursts follow each other at the least distance, as many at twice it, and so on up to the largest. */
uint64_t gg_measure_since_burst(const gg_bursts *e, uint64_t sample)
{
  uint64_t apart = e->first;
  for (; apart < e->apart && sample >= BURSTS_ALIKE * apart; apart *= 2) sample -= BURSTS_ALIKE * apart;
  return sample % apart;
}
