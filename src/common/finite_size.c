/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "common/finite_size.h"

#include <math.h>

/* Relative bias of means, times the number of grains of the scarcest species. Fluctuations of T lower its mean by half
 * their relative variance, because dT/dt is concave in T. Measured in T, the stresses and the viscosity: 0.5 to 1.5
 * (validation/noise_free/monte_carlo_bias.c). */
#define BIAS_TIMES_N 2
/* The same between walls, where fluctuations of the flow add dissipation: T of dense Couette flows is higher by 4/N to
 * 22/N (phi = 0.1 and 0.3, e = 0.5 to 0.9, N = 1000 against 20000), of a dilute one by 0.4(7)/N (phi = 0.01). */
#define BIAS_BETWEEN_WALLS 25
#define BIAS_BY_PHI 230

double gg_common_finite_size_bias(gg_flow flow, double phi)
{
  return gg_flow_is_walled(flow) ? fmin(BIAS_TIMES_N + BIAS_BY_PHI * phi, BIAS_BETWEEN_WALLS) : BIAS_TIMES_N;
}

double gg_common_finite_size_bias_of(const gg_model *m)
{
  int64_t least = m->n;
  for (int i = 0; i < m->n_species; i++)
    if (m->n_of[i] > 0 && m->n_of[i] < least) least = m->n_of[i];
  return gg_common_finite_size_bias(m->flow, m->phi) / (double)least;
}
