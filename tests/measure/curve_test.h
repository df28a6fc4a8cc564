/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Helpers for tests of curves: planted snapshots for an observable, its curves with errors, comparisons. */
#ifndef GG_CURVE_TEST_H
#define GG_CURVE_TEST_H

#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>

#include <cmocka.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "common/rng.h"
#include "measure/observable.h"
#include "run/run.h"
#include "scene/model_of_scene.h"

static inline gg_model ct_model(gg_flow flow, double phi, double beta, int64_t n, int species)
{
  gg_scene s = gg_scene_defaults();
  s.flow = flow, s.phi = phi, s.particles = n, s.n_species = species;
  for (int p = 0; p < GG_PAIRS; p++) s.collision.beta[p] = beta;
  if (flow == GG_EQUILIBRIUM)
    for (int p = 0; p < GG_PAIRS; p++) s.collision.e[p] = 1;
  if (species == 2) {
    s.species[0] = (gg_species){0.6, 1, 1, 0.4, 1, 0};
    s.species[1] = (gg_species){0.4, 1.5, 3, 0.5, 1, 0};
  }
  gg_model m;
  assert_int_equal(gg_scene_model_make(&s, GG_MD, &m, NULL), GG_OK);
  return m;
}

/* Add `samples` snapshots, each made by `fill`, and return the curves; the caller clears them. */
static inline gg_curves ct_curves(const gg_observable *o, const gg_model *m, int samples,
                                  void (*fill)(gg_snapshot *s, gg_rng *r, int sample), uint64_t seed)
{
  gg_snapshot s;
  gg_bins bins;
  gg_rng r = gg_common_rng_seed(seed, 0);
  void *self = o->create(m, NULL);
  assert_non_null(self);
  assert_int_equal(gg_measure_snapshot_init(&s, m, o->positions && !m->homogeneous, NULL), GG_OK);
  for (size_t i = 0; i < s.n; i++) { /* species and numbers in no order; 7919 is prime, and no factor of any n here */
    if (s.species) s.species[i] = (int64_t)(i * 7919 % s.n) >= m->n_of[0];
    if (s.id) s.id[i] = (int64_t)((i * 7919 + 5) % s.n);
  }
  assert_int_equal(gg_statistics_bins_init(&bins, o->curves->bins(self), NULL), GG_OK);
  if (o->restart) o->restart(self);
  for (int k = 0; k < samples; k++) {
    fill(&s, &r, k);
    o->curves->add_snapshot(self, &s, gg_statistics_bins_sample(&bins));
    gg_statistics_bins_commit(&bins);
  }
  const gg_bins *list[] = {&bins};
  gg_curves curves = {.model = m};
  gg_error err = {0};
  if (gg_measure_curves_estimate(list, 1, o->curves->of_bins, self, o->name, 0, &curves, &err) != GG_OK)
    fail_msg("%s", err.message);
  gg_statistics_bins_clear(&bins);
  gg_measure_snapshot_clear(&s);
  o->destroy(self);
  return curves;
}

static inline const gg_curve *ct_find(const gg_curves *list, const char *name)
{
  for (int k = 0; k < list->n; k++)
    if (strcmp(list->curve[k].name, name) == 0) return &list->curve[k];
  fail_msg("no curve '%s'", name);
  return NULL;
}

static inline gg_curve_number ct_number(const gg_curve *c, const char *name)
{
  for (int i = 0; i < c->n_numbers; i++)
    if (strcmp(c->number[i].name, name) == 0) return c->number[i];
  fail_msg("%s: no number '%s'", c->name, name);
  return (gg_curve_number){0};
}

/* The value is right within four standard errors, and the error is small enough to detect a deviation `sight` at
 * four. */
static inline void ct_expect(const char *what, double value, double error, double expected, double sight)
{
  print_message("# %-34s %.6g +- %.2g, expected %.6g (%+.2f sigma)\n", what, value, error, expected,
                (value - expected) / error);
  if (!(fabs(value - expected) <= 4 * error)) fail_msg("%s: %g +- %g is not %g", what, value, error, expected);
  if (!(4 * error <= sight)) fail_msg("%s: an error of %g is too large to prove anything", what, error);
}

/* Points of a curve against a function: chi^2 per point about 1. Student-like tails of errors from few blocks are
 * allowed for: 16 blocks make <t^2> = 15/13. */
static inline double ct_chi2(const gg_curve *c, size_t from, size_t to, double (*f)(double x, const void *context),
                             const void *context)
{
  double sum = 0;
  size_t n = 0;
  for (size_t i = from; i < to && i < c->n; i++) {
    if (!(c->error[i] > 0)) continue;
    sum += pow((c->value[i] - f(c->x[i], context)) / c->error[i], 2), n++;
  }
  print_message("# %-34s chi^2/points = %.3f over %zu\n", c->name, sum / (double)n, n);
  assert_true(n > 0);
  return sum / (double)n;
}

/* A run's result, which must be steady. */
static inline gg_result *ct_run(gg_scene s)
{
  gg_result *r = NULL;
  gg_error err = {0};
  if (gg_run_scene(&s, NULL, 1, NULL, &r, &err) != GG_OK) fail_msg("%s", err.message);
  return r;
}

#endif
