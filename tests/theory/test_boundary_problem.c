/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The solver of boundary value problems on a steep layer, on a nonlinear problem with a known solution, and on one
 * without a solution. */
#include "theory_test.h"

#include "theory/walls/boundary_problem.h"

/* v'' = k^2 v, v(0) = 1, v(1) = 0: a layer of thickness 1/k. */
static const double steepness = 60;

static void layer_slope(void *self, const double v[], double f[])
{
  (void)self;
  f[0] = v[1], f[1] = steepness * steepness * v[0];
}
static void starts_at_1(void *self, const double v[], double left[])
{
  (void)self;
  left[0] = v[0] - 1;
}
static void ends_at_0(void *self, const double v[], double left[])
{
  (void)self;
  left[0] = v[0];
}

static gg_boundary_solution *uniform_points(int n)
{
  gg_boundary_solution *s = calloc(1, sizeof *s);
  assert_non_null(s);
  s->points = n;
  for (int i = 0; i < n; i++) s->y[i] = (double)i / (n - 1);
  return s;
}

static void steep_layer(void **state)
{
  (void)state;
  gg_error err;
  gg_boundary_solution *s = uniform_points(11);
  const gg_boundary_problem p = {.n = 2,
                                 .n_lower = 1,
                                 .scale = {1, steepness},
                                 .tolerance = 1e-7,
                                 .slope = layer_slope,
                                 .lower = starts_at_1,
                                 .upper = ends_at_0};
  if (gg_theory_boundary_solve(&p, s, &err) != GG_OK) fail_msg("%s", err.message);
  for (double y = 0.003; y < 1; y += 0.0371) {
    double v[2];
    gg_theory_boundary_at(s, 2, y, v, NULL);
    assert_true(fabs(v[0] - sinh(steepness * (1 - y)) / sinh(steepness)) < 1e-8);
  }
  assert_true(s->y[1] < 0.02); /* points are dense where the layer is */
  free(s);
}

/* G.I. Bratu's problem v'' = -exp(v), v(0) = v(1) = 0: v = -2 ln[cosh((y - 1/2) t/2)/cosh(t/4)], t = sqrt(2) cosh(t/4).
 */
static void bratu_slope(void *self, const double v[], double f[])
{
  (void)self;
  f[0] = v[1], f[1] = -exp(v[0]);
}

static void bratus_problem_has_its_exact_solution(void **state)
{
  (void)state;
  gg_error err;
  gg_boundary_solution *s = uniform_points(5);
  const gg_boundary_problem p = {.n = 2,
                                 .n_lower = 1,
                                 .scale = {1, 1},
                                 .tolerance = 1e-8,
                                 .slope = bratu_slope,
                                 .lower = ends_at_0,
                                 .upper = ends_at_0};
  double t = 1.5;
  for (int k = 0; k < 100; k++) t = sqrt(2) * cosh(t / 4);
  if (gg_theory_boundary_solve(&p, s, &err) != GG_OK) fail_msg("%s", err.message);
  for (double y = 0.01; y < 1; y += 0.07) {
    double v[2];
    gg_theory_boundary_at(s, 2, y, v, NULL);
    assert_close(v[0], -2 * log(cosh((y - 0.5) * t / 2) / cosh(t / 4)), 1e-8);
  }
  free(s);
}

/* Without a solution (v'' = -4 exp(v)) it fails, and does not pretend. */
static void no_bratu_slope(void *self, const double v[], double f[])
{
  (void)self;
  f[0] = v[1], f[1] = -4 * exp(v[0]);
}

static void no_solution(void **state)
{
  (void)state;
  gg_error err;
  gg_boundary_solution *s = uniform_points(21);
  const gg_boundary_problem p = {.n = 2,
                                 .n_lower = 1,
                                 .scale = {1, 1},
                                 .tolerance = 1e-6,
                                 .slope = no_bratu_slope,
                                 .lower = ends_at_0,
                                 .upper = ends_at_0};
  assert_int_equal(gg_theory_boundary_solve(&p, s, &err), GG_FAILED);
  free(s);
}

/* v'' = -rate exp(v), of which v < 1 alone counts as a value. A solution within is found from a start outside; without
 * one, five steps outside are enough to give up. */
typedef struct bounded {
  double rate;
  bool outside;
  int calls;
} bounded;

static void bounded_slope(void *self, const double v[], double f[])
{
  bounded *b = self;
  b->calls++;
  f[0] = v[1], f[1] = -b->rate * exp(v[0]);
  if (v[0] >= 1) b->outside = true;
}

static gg_status solve_bounded(bounded *b, bool tells)
{
  gg_error err;
  gg_boundary_solution *s = uniform_points(21);
  for (int i = 0; i < s->points; i++) s->v[i][0] = 2;
  const gg_boundary_problem p = {.n = 2,
                                 .n_lower = 1,
                                 .scale = {1, 1},
                                 .tolerance = 1e-6,
                                 .self = b,
                                 .outside = tells ? &b->outside : NULL,
                                 .slope = bounded_slope,
                                 .lower = ends_at_0,
                                 .upper = ends_at_0};
  const gg_status status = gg_theory_boundary_solve(&p, s, &err);
  free(s);
  return status;
}

static void a_step_that_ends_outside_gives_up_early(void **state)
{
  (void)state;
  bounded within = {.rate = 1}, beyond = {.rate = 4}, untold = {.rate = 4};
  assert_int_equal(solve_bounded(&within, true), GG_OK);
  assert_false(within.outside);
  assert_int_equal(solve_bounded(&beyond, true), GG_FAILED);
  assert_int_equal(solve_bounded(&untold, false), GG_FAILED);
  print_message("# %d calls until it gives up, %d if no step counts as outside\n", beyond.calls, untold.calls);
  assert_true(beyond.calls < untold.calls);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(steep_layer), cmocka_unit_test(bratus_problem_has_its_exact_solution),
      cmocka_unit_test(no_solution), cmocka_unit_test(a_step_that_ends_outside_gives_up_early)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
