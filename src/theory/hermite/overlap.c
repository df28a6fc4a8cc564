/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "theory/hermite/overlap.h"

#include <gsl/gsl_integration.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "theory/hermite/basis.h"

static gg_status rule(const gsl_integration_fixed_type *type, int n, double scale, double norm, double *x, double *w,
                      gg_error *err)
{
  gsl_integration_fixed_workspace *r = gsl_integration_fixed_alloc(type, (size_t)n, 0, scale, 0, 0);
  if (!r) return gg_base_out_of_memory(err);
  memcpy(x, gsl_integration_fixed_nodes(r), (size_t)n * sizeof *x);
  for (int i = 0; i < n; i++) w[i] = gsl_integration_fixed_weights(r)[i] / norm;
  gsl_integration_fixed_free(r);
  return GG_OK;
}

gg_status gg_hermite_rule(int n, double *x, double *w, gg_error *err)
{
  return rule(gsl_integration_fixed_hermite, n, 0.5, sqrt(2 * M_PI), x, w, err);
}

gg_status gg_hermite_legendre_rule(int n, double *x, double *w, gg_error *err)
{
  return rule(gsl_integration_fixed_legendre, n, 1, 1, x, w, err);
}

gg_status gg_hermite_overlap_make(gg_hermite_overlap *o, int tests, int trials, double decay, gg_error *err)
{
  *o = (gg_hermite_overlap){.tests = tests, .trials = trials, .decay = decay, .n = (tests + trials) / 2};
  o->x = malloc(2 * (size_t)o->n * sizeof *o->x);
  if (!o->x) return gg_base_out_of_memory(err);
  o->w = o->x + o->n;
  gg_status status = gg_hermite_rule(o->n, o->x, o->w, err);
  if (status != GG_OK) gg_hermite_overlap_clear(o);
  return status;
}

void gg_hermite_overlap_clear(gg_hermite_overlap *o)
{
  free(o->x);
  *o = (gg_hermite_overlap){0};
}

/* The weight times exp(-decay (x + shift)^2/2) is a Gaussian of mean -decay shift/(1 + decay) and variance
 * 1/(1 + decay). */
void gg_hermite_overlap_at(const gg_hermite_overlap *o, double shift, double *matrix)
{
  double a = o->decay, mean = -a * shift / (1 + a), spread = 1 / sqrt(1 + a);
  double share = spread * exp(-a * shift * shift / (2 * (1 + a)));
  double trial[GG_HERMITE_MOST_DEGREE + 3], test[GG_HERMITE_MOST_DEGREE + 3];
  memset(matrix, 0, (size_t)(o->tests * o->trials) * sizeof *matrix);
  for (int k = 0; k < o->n; k++) {
    double x = mean + spread * o->x[k];
    gg_hermite_values(o->trials - 1, x, trial);
    gg_hermite_values(o->tests - 1, x + shift, test);
    for (int m = 0; m < o->tests; m++)
      for (int s = 0; s < o->trials; s++) matrix[m * o->trials + s] += share * o->w[k] * test[m] * trial[s];
  }
}
