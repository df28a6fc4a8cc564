/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "sweep/agreement.h"

#include <math.h>
#include <string.h>

#include "common/quantity.h"

bool gg_sweep_is_main_quantity(const char *quantity)
{
  const gg_quantity q = gg_common_quantity_find(quantity);
  return q < GG_N_QUANTITIES && gg_common_quantity_mask(q) & (GG_DRAWN | GG_DRAWN_AS_RATIO);
}

static bool is_of_solution(const gg_point_row *row)
{
  return strcmp(row->method, "dsmc") == 0 && row->reference && strcmp(row->reference, "enskog_hermite") == 0 &&
         isfinite(row->z) && gg_sweep_is_main_quantity(row->quantity);
}

bool gg_sweep_agreement_counts(const gg_point_row *row)
{
  return row->steady && is_of_solution(row);
}

static gg_agreement_row *row_for(gg_agreement *a, const char *quantity)
{
  for (int i = 0; i < a->n; i++)
    if (strcmp(a->row[i].quantity, quantity) == 0) return &a->row[i];
  if (a->n == GG_AGREEMENT_QUANTITIES) return NULL;
  a->row[a->n].quantity = quantity;
  return &a->row[a->n++];
}

static void add(gg_agreement *a, const gg_point_row *row)
{
  gg_agreement_row *of = row_for(a, row->quantity);
  if (!of) return;
  a->n_values++;
  gg_statistics_scores_add(&of->scores, row->z);
}

static void count_points(gg_agreement *a, const gg_grid_view *v)
{
  for (size_t i = 0; i < v->sweep->n; i++) {
    size_t counted = 0, solved = 0;
    for (size_t r = v->first[i]; r < v->first[i + 1]; r++) {
      counted += gg_sweep_agreement_counts(&v->table->row[r]);
      solved += is_of_solution(&v->table->row[r]);
    }
    a->n_points += counted > 0;
    a->unsteady += solved > 0 && !counted;
    a->unanswered += gg_sweep_grid_has(v, i) && !solved;
  }
}

void gg_sweep_agreement_make(gg_agreement *a, const gg_grid_view *v)
{
  *a = (gg_agreement){0};
  for (size_t i = 0; i < v->table->n; i++)
    if (gg_sweep_agreement_counts(&v->table->row[i])) add(a, &v->table->row[i]);
  count_points(a, v);
  /* Points are independent of each other, quantities of one point are not. */
  a->most = gg_statistics_scores_most(GG_AGREEMENT_CHANCE, a->n_values);
  for (int i = 0; i < a->n; i++)
    a->fails |= gg_statistics_scores_judge(&a->row[i].scores, GG_AGREEMENT_CHANCE, a->n, a->most);
}
