/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <math.h>

#include "theory/answer.h"
#include "theory/hermite/operator.h"

gg_hermite_gas gg_hermite_gas_of(const gg_model *m)
{
  gg_hermite_gas gas = {.n_species = m->n_species, .stop = m->stop};
  for (int i = 0; i < m->n_species; i++) {
    gas.fraction[i] = gg_theory_fraction(m, i), gas.mass[i] = m->mass[i];
    gas.drag[i] = m->bath.drag[i], gas.diffusion[i] = m->bath.noise[i] / 2;
    for (int j = 0; j < m->n_species; j++) {
      int pair = gg_pair(i, j);
      double sigma = m->sigma[pair];
      gas.impact[i][j] =
          (gg_hermite_impact){.frequency = m->density * gg_theory_fraction(m, j) * m->chi[pair] * sigma * sigma,
                              .eta = m->contact[i][j].jn / m->mass[i],
                              .e = m->e[pair],
                              .sigma = sigma,
                              .shear = m->boltzmann ? 0 : sigma * m->shear_rate};
    }
  }
  gas.stream[0][1] = m->shear_rate;
  return gas;
}

gg_hermite_gas gg_hermite_one(double frequency, double eta, double shear)
{
  gg_hermite_gas gas = {.n_species = 1, .fraction = {1}, .mass = {1}};
  gas.impact[0][0] =
      (gg_hermite_impact){.frequency = frequency, .eta = eta, .e = 2 * eta - 1, .sigma = 1, .shear = shear};
  return gas;
}
