/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Estimated time of a collision. */
#include <math.h>

#include "common/thermostat.h"
#include "dsmc/dsmc.h"

/* Nanoseconds a collision of two species: one by one where either has too few grains for blocks of eight
 * (gg_dsmc_choose_path), or where a law of restitution is the user's. */
static double pace_of_pair(const gg_model *m, int i, int j)
{
  enum { FEWEST_IN_BLOCKS = 793 }; /* a hundred blocks */
  const bool blocks = m->n_of[i] >= FEWEST_IN_BLOCKS && m->n_of[j] >= FEWEST_IN_BLOCKS && !m->law.e;
  return blocks ? (m->rule == GG_SMOOTH ? 12 : 18) * (1 + 0.5 * exp(-(double)m->n / 1000)) : 330;
}

/* Between walls the time includes the flight. Without walls it is a mean over the pairs of species, weighted with their
 * collision rates, times the cost of a sweep for each pair; baths and kicks add the time to draw noise. */
double gg_dsmc_nanoseconds(const gg_model *m)
{
  double sum = 0, rates = 0;
  if (m->walled || m->wave > 0) return m->rule == GG_SMOOTH ? 150 : 200;
  for (int i = 0; i < m->n_species; i++)
    for (int j = 0; j < m->n_species; j++) {
      const int q = gg_pair(i, j);
      const double rate = m->fraction[i] * m->fraction[j] * m->sigma[q] * m->sigma[q] * m->chi[q] *
                          sqrt(1 / m->mass[i] + 1 / m->mass[j]);
      sum += rate * pace_of_pair(m, i, j), rates += rate;
    }
  const double pairs = 0.5 + 0.5 * m->n_species;
  return sum / rates * pairs + (m->bath.on || gg_common_heat_of(m) == GG_HEAT_KICKS ? 30 : 0);
}
