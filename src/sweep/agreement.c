/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "sweep/agreement.h"

#include <gsl/gsl_cdf.h>
#include <math.h>
#include <string.h>

#include "common/quantity.h"

/* Degrees of freedom of Student's t: a standard error comes from sixteen blocks or more. The variance of a z-score is
 * nu/(nu - 2), and the variance of z^2 follows from the fourth moment. */
static const double freedom = 15;

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
  a->row[a->n] = (gg_agreement_row){.quantity = quantity};
  return &a->row[a->n++];
}

static void add(gg_agreement *a, const gg_point_row *row)
{
  gg_agreement_row *of = row_for(a, row->quantity);
  if (!of) return;
  of->n++, a->n_values++;
  of->sum += row->z, of->squares += row->z * row->z;
  of->largest = fmax(of->largest, fabs(row->z));
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

/* Points are independent of each other, quantities of one point are not. Each test has its part of the chance, so the
 * bound holds for any dependence (Bonferroni). */
static void judge(gg_agreement *a)
{
  enum { TESTS = 3 };
  const double share = GG_AGREEMENT_CHANCE / TESTS, of_one = share / (a->n ? a->n : 1);
  const double variance = freedom / (freedom - 2),
               of_squares = variance * variance * (3 * (freedom - 2) / (freedom - 4) - 1);
  a->most = a->n_values ? gsl_cdf_tdist_Qinv(share / (2 * (double)a->n_values), freedom) : INFINITY;
  for (int i = 0; i < a->n; i++) {
    gg_agreement_row *r = &a->row[i];
    const double n = (double)r->n, shape = n * variance * variance / of_squares;
    r->mean = r->sum / n, r->variance = r->squares / n;
    r->most_mean = gsl_cdf_ugaussian_Qinv(of_one / 2) * sqrt(variance / n);
    r->most_variance = r->n < 4 ? INFINITY : gsl_cdf_gamma_Qinv(of_one, shape, variance / shape);
    r->fails = fabs(r->mean) > r->most_mean || r->variance > r->most_variance || r->largest > a->most;
    a->fails |= r->fails;
  }
}

void gg_sweep_agreement_make(gg_agreement *a, const gg_grid_view *v)
{
  *a = (gg_agreement){0};
  for (size_t i = 0; i < v->table->n; i++)
    if (gg_sweep_agreement_counts(&v->table->row[i])) add(a, &v->table->row[i]);
  count_points(a, v);
  judge(a);
}
