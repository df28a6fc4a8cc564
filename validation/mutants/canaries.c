/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Apply the canaries to a model. Compiled in the mutants' tree only. */
#include <math.h>

#include "common/model.h"

/* Factor of the misprint of the thesis: eta_2 = (1+beta)/K(1+K) instead of (1+beta)K/2(1+K) (eqs 2.7 and 2.17). */
static double scanned(double inertia)
{
  return 2 / (inertia * inertia);
}

static void change_pair(gg_model *m, int i, int j, double e_off, double as_scanned)
{
  int o = gg_pair(i, j);
  double e = m->e[o] >= e_off ? m->e[o] - e_off : m->e[o] + e_off, rolls = m->contact[i][j].jt;
  m->contact[i][j] = gg_common_contact_make((gg_partner){m->mass[i], m->inertia[i]},
                                            (gg_partner){m->mass[j], m->inertia[j]}, e, m->beta[o], m->mu[o]);
  if (as_scanned > 0 && rolls > 0) m->contact[i][j].jt *= scanned(m->inertia[i]);
}

/* `first`: the numbers of the canaries are first + 1 (e), + 2 (diameter), + 3 (eta_2), + 5 (chi). GG_MUTANT records
 * that a canary was reached, so it is evaluated only if the canary changes this model. */
void gg_canary_model(gg_model *m, int first)
{
  bool spins = m->rule != GG_SMOOTH;
  bool e = !m->law.name && GG_MUTANT(first + 1), diameter = GG_MUTANT(first + 2), eta2 = spins && GG_MUTANT(first + 3),
       chi = !m->boltzmann && first != 900 && GG_MUTANT(first + 5);
  if (!e && !diameter && !eta2 && !chi) return;
  for (int i = 0; i < m->n_species; i++) {
    for (int j = 0; (e || eta2) && j < m->n_species; j++) change_pair(m, i, j, e ? 0.02 : 0, eta2 ? 1 : 0);
    if (diameter) m->diameter[i] *= 1.01;
  }
  for (int o = 0; o < gg_pairs_of(m->n_species); o++) {
    if (e) m->e[o] = m->e[o] >= 0.02 ? m->e[o] - 0.02 : m->e[o] + 0.02;
    if (diameter) m->sigma[o] *= 1.01;
    if (chi) m->chi[o] *= 1.02;
  }
}
