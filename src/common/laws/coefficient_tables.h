/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tables of the coefficients of a model that depend on the normal speed, by pair of species, for the engines. */
#ifndef GG_COEFFICIENT_TABLES_H
#define GG_COEFFICIENT_TABLES_H

#include "common/laws/loss_table.h"
#include "common/model.h"

typedef struct gg_coefficient_tables {
  const gg_loss_table *of[GG_N_COEFFICIENTS][GG_PAIRS]; /* NULL: constant; equal laws share one */
  double scale[GG_PAIRS];                               /* a speed in units of the table over that of the model */
  int n;
  gg_loss_table *made[GG_N_COEFFICIENTS * GG_PAIRS];
} gg_coefficient_tables;

/* NULL: all coefficients are constant, or the law of e is the user's. */
gg_status gg_common_coefficient_tables_new(const gg_model *model, gg_coefficient_tables **tables, gg_error *err);
void gg_common_coefficient_tables_free(gg_coefficient_tables *tables);

/* Draw each coefficient of a pair against the speed, from 1/16 to 8 times the mean speed at impact at the start. */
void gg_common_coefficients_describe(const gg_model *model, void (*line)(void *context, const char *text),
                                     void *context);

/* Number of coefficients of a pair that the speed u, in units of the table, takes out of what is allowed, as 0 or 1. */
GG_INLINE bool gg_coefficients_clamp(const gg_coefficient_tables *t, int pair, double u)
{
  bool clamps = false;
  for (int c = 0; c < GG_N_COEFFICIENTS; c++)
    if (t->of[c][pair] && t->of[c][pair]->n_invalid) clamps |= gg_law_table_clamps(t->of[c][pair], u);
  return clamps;
}

/* Set jt = m_t (1+beta) and mu of a contact at the speed u. */
GG_INLINE void gg_coefficients_set_friction(const gg_coefficient_tables *t, int pair, double u, gg_contact *contact)
{
  const gg_loss_table *beta = t->of[GG_OF_BETA][pair], *mu = t->of[GG_OF_MU][pair];
  if (beta) contact->jt = gg_law_table_at(beta, u) / gg_inverse_mt(contact);
  if (mu) contact->mu = gg_law_table_at(mu, u);
}

#endif
