/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "statistics/scores.h"

#include <gsl/gsl_cdf.h>
#include <math.h>

/* Degrees of freedom of Student's t: a standard error comes from sixteen blocks or more. The variance of a z-score is
 * nu/(nu - 2), and the variance of z^2 follows from the fourth moment. */
static const double freedom = 15;

/* Each test has its part of the chance, so the bound holds for any dependence (Bonferroni). */
enum { TESTS = 3 };

void gg_statistics_scores_add(gg_scores *s, double z)
{
  s->n++;
  s->sum += z, s->squares += z * z;
  s->largest = fmax(s->largest, fabs(z));
}

double gg_statistics_scores_most(double chance, size_t values)
{
  return values ? gsl_cdf_tdist_Qinv(chance / TESTS / (2 * (double)values), freedom) : INFINITY;
}

bool gg_statistics_scores_judge(gg_scores *s, double chance, int quantities, double most)
{
  const double share = chance / TESTS, of_one = share / quantities, variance = freedom / (freedom - 2),
               of_squares = variance * variance * (3 * (freedom - 2) / (freedom - 4) - 1), n = (double)s->n,
               shape = n * variance * variance / of_squares;
  s->mean = s->sum / n, s->variance = s->squares / n;
  s->most_mean = gsl_cdf_ugaussian_Qinv(of_one / 2) * sqrt(variance / n);
  s->most_variance = s->n < 4 ? INFINITY : gsl_cdf_gamma_Qinv(of_one, shape, variance / shape);
  return s->fails = fabs(s->mean) > s->most_mean || s->variance > s->most_variance || s->largest > most;
}
