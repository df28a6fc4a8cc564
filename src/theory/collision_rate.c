/* S. Chapman & T.G. Cowling, The Mathematical Theory of Non-Uniform Gases, sects 5.21 and 16.2:
 *   nu_ij = n_j sigma_ij^2 chi_ij sqrt(8 pi (T_i/m_i + T_j/m_j)),   l_i = sqrt(8 T_i/(pi m_i))/sum_j nu_ij
 * One species: nu = 4 n d^2 chi sqrt(pi T), l = d/(6 sqrt(2) phi chi). */
#include "theory/collision_rate.h"

#include <math.h>

double gg_theory_pair_collision_rate(const gg_model *m, int i, int j, const double T[])
{
  double nj = m->density * (double)m->n_of[j] / (double)m->n, sigma = m->sigma[gg_pair(i, j)];
  return nj * sigma * sigma * m->chi[gg_pair(i, j)] * sqrt(8 * M_PI * (T[i] / m->mass[i] + T[j] / m->mass[j]));
}

double gg_theory_mean_speed(const gg_model *m, int i, const double T[])
{
  return sqrt(8 * T[i] / (M_PI * m->mass[i]));
}

double gg_theory_mean_free_path(const gg_model *m, int i, const double T[])
{
  double rate = 0;
  for (int j = 0; j < m->n_species; j++) rate += gg_theory_pair_collision_rate(m, i, j, T);
  return gg_theory_mean_speed(m, i, T) / rate;
}
