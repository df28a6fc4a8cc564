/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "theory/range.h"

#include <math.h>

/* Least e of all pairs. (gcc 12 for 64-bit ARM crashes on a loop of fmin.) */
static double least_restitution(const gg_model *m)
{
  double least = 1;
  for (int i = 0; i < m->n_species; i++)
    for (int j = 0; j < m->n_species; j++)
      if (m->e[gg_pair(i, j)] < least) least = m->e[gg_pair(i, j)];
  return least;
}

/* Roughness between smooth and perfectly rough dissipates at any e. */
static bool half_rough(const gg_model *m)
{
  for (int i = 0; i < m->n_species; i++)
    for (int j = 0; j < m->n_species; j++) {
      int pair = gg_pair(i, j);
      if (gg_common_rule_select(m->beta[pair], m->mu[pair]) != GG_SMOOTH && fabs(m->beta[pair]) < 0.9) return true;
    }
  return false;
}

const char *gg_theory_beyond_quasi_elastic(const gg_model *m)
{
  bool within = least_restitution(m) >= 0.95 && !half_rough(m);
  return within ? NULL : "quasi-elastic theory out of its range (made for e near 1 and beta near -1 or 1)";
}

const char *gg_theory_beyond_linear_anisotropy(const gg_model *m)
{
  bool within = least_restitution(m) >= 0.9 && !half_rough(m);
  return within ? NULL : "linear in the anisotropy of the stress, which is large where collisions dissipate much";
}

const char *gg_theory_beyond_first_sonine(const gg_model *m)
{
  double mass = m->n_species > 1 ? m->mass[1] / m->mass[0] : 1;
  if (least_restitution(m) < 0.6) return "first Sonine order: velocities are far from Maxwellian below e = 0.6";
  bool unlike = (mass > 20 || mass < 0.05) && least_restitution(m) < 1;
  return unlike ? "first Sonine order: too little for such unequal masses" : NULL;
}

const char *gg_theory_beyond_gaussian(const gg_model *m)
{
  if (least_restitution(m) < 0.6) return "velocities are far from Gaussian below e = 0.6";
  return half_rough(m) ? "velocities and spins are neither Gaussian nor independent where grains are half rough" : NULL;
}
