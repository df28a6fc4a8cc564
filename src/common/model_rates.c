/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <math.h>

#include "common/model.h"

double gg_common_model_pair_rate(const gg_model *m, double share, int i, int j, double T)
{
  int o = gg_pair(i, j);
  double nj = m->number_density[j];
  double spread = T * (1 / m->mass[i] + 1 / m->mass[j]); /* <c12_x^2> */
  return share * nj * m->sigma[o] * m->sigma[o] * m->chi[o] * sqrt(8 * M_PI * spread);
}

double gg_common_model_collision_rate(const gg_model *m, double T)
{
  double rate = 0;
  for (int i = 0; i < m->n_species; i++)
    for (int j = 0; j < m->n_species; j++) rate += gg_common_model_pair_rate(m, m->fraction[i], i, j, T);
  return rate;
}

double gg_common_model_species_rate(const gg_model *m, int i, double T)
{
  double rate = 0;
  for (int j = 0; j < m->n_species; j++) rate += gg_common_model_pair_rate(m, 1, i, j, T);
  return rate;
}

static double unlike_rate(const gg_model *m, int i, int j, double T)
{
  double v0 = sqrt(2 * T * (m->mass[i] + m->mass[j]) / (m->mass[i] * m->mass[j]));
  return sqrt(M_PI) * m->density * m->sigma[gg_pair(i, j)] * m->sigma[gg_pair(i, j)] * v0;
}

double gg_common_model_nu0(const gg_model *m, double T)
{
  if (m->n_species == 1) return 3.2 * sqrt(M_PI) * m->density * sqrt(T);
  if (m->n_species == 2) return unlike_rate(m, 0, 1, T);
  double sum = 0, weight = 0;
  for (int i = 0; i < m->n_species; i++)
    for (int j = 0; j < i; j++) {
      double pairs = m->fraction[i] * m->fraction[j];
      sum += pairs * unlike_rate(m, i, j, T), weight += pairs;
    }
  return sum / weight;
}
