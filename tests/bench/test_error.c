/* SPDX-License-Identifier: GPL-3.0-or-later */
/* bench error: of made-up runs whose noise and floors are known, the seconds to an error are those; and of a state that
 * is really measured, briefly, all ways have errors, and the truth is the best there is. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>
#include <math.h>
#include <stdlib.h>

#include "bench/error_state.h"

enum { MARKS = 12, WAY = 5 };

/* Means at 2 +- 0.1/sqrt(t): relative noise 0.05 a second and run. */
static void make_up(gg_error_state *s)
{
  gg_course *c = &s->course[WAY];
  c->seeds = 8, c->marks = MARKS;
  for (int k = 0; k < MARKS; k++) {
    c->seconds[k] = 0.001 * pow(2, k);
    for (int i = 0; i < 8; i++)
      for (int q = 0; q < GG_COURSE_QUANTITIES; q++)
        c->mean[q][k][i] = 2 + (i % 2 ? 0.1 : -0.1) * sqrt(7.0 / 8) / sqrt(c->seconds[k]);
  }
}

static void made_up_runs(void **state)
{
  (void)state;
  gg_error_state *s = calloc(1, sizeof *s);
  double of_error;
  make_up(s);
  assert_true(fabs(gg_statistics_course_noise(&s->course[WAY], 0) - 0.1) < 1e-12);
  s->noise[WAY][0] = 0.05, s->unit[0] = 2, s->truth[GG_DSMC][0] = 2;
  assert_true(fabs(gg_bench_error_at(s, WAY, 0, 3, &of_error) - 0.05 * sqrt(7.0 / 8) / sqrt(0.008)) < 1e-12);
  assert_true(fabs(of_error / gg_bench_error_at(s, WAY, 0, 3, &of_error) - 0.25) < 1e-12); /* of 8 squares */
  assert_true(fabs(gg_bench_seconds_to(s, WAY, 0, 0.01) - 25) < 1e-9);
  s->floor[WAY][0] = s->shift[WAY][0] = 0.006;
  assert_true(fabs(gg_bench_seconds_to(s, WAY, 0, 0.01) - 25 / (1 - 0.36)) < 1e-9);
  assert_true(isinf(gg_bench_seconds_to(s, WAY, 0, 0.0059)));
  s->shift_error[WAY][0] = 0.003; /* the shift is not distinguishable from 0: unknown instead of never */
  assert_true(isnan(gg_bench_seconds_to(s, WAY, 0, 0.0059)));
  s->floor[WAY][0] = 0; /* still unknown below the error of the shift, known above it */
  assert_true(isnan(gg_bench_seconds_to(s, WAY, 0, 0.001)) && gg_bench_seconds_to(s, WAY, 0, 0.01) > 0);
  assert_true(gg_bench_seconds_to(s, WAY, 0, 100) ==
              s->course[WAY].seconds[0]); /* at least the warm-up and the first mark */
  free(s);
}

/* Noise falls with the time that is averaged over, and the warm-up comes once: the same runs 0.05 s later, which is
 * most of the first marks and 2 % of the last one. */
static void warm_up(void **state)
{
  (void)state;
  gg_error_state *s = calloc(1, sizeof *s);
  gg_course *c = &s->course[WAY];
  make_up(s);
  c->warmup = 0.05;
  for (int k = 0; k < MARKS; k++) c->seconds[k] += c->warmup;
  assert_true(fabs(gg_statistics_course_noise(c, 0) - 0.1) < 1e-12);
  s->noise[WAY][0] = 0.05, s->unit[0] = 2, s->truth[GG_DSMC][0] = 2;
  assert_true(fabs(gg_bench_seconds_to(s, WAY, 0, 0.01) - 25.05) < 1e-9);
  assert_true(fabs(gg_bench_seconds_to(s, WAY, 0, 1) - 0.0525) < 1e-9);
  assert_true(gg_bench_seconds_to(s, WAY, 0, 100) == c->seconds[0]);
  free(s);
}

/* The coefficient c of shifts c h^2 at steps of 1 and 1/2, by least squares: where the sum of squares is least. */
static void check_step(const gg_error_state *s, int q)
{
  double least = INFINITY, best = NAN;
  const double around = s->step_coefficient[q], wide = 3 * s->step_coefficient_error[q];
  for (double c = around - wide; c < around + wide; c += wide / 1000) {
    double sum = 0;
    for (int i = 0; i < GG_ERROR_METHODS; i++) {
      const gg_error_method *w = &gg_bench_error_methods[i];
      if (w->step != 1 && w->step != 0.5) continue;
      const gg_course_end end = gg_statistics_course_last(&s->course[i], q);
      const double off = end.mean - s->truth[GG_DSMC][q] - s->size[GG_DSMC][q].per_grain / (double)w->n -
                         c * w->step * w->step * s->unit[q];
      sum += off * off / (end.error * end.error + s->truth_error[GG_DSMC][q] * s->truth_error[GG_DSMC][q]);
    }
    if (sum < least) least = sum, best = c;
  }
  if (!(fabs(best - around) < wide / 400)) fail_msg("%d: %g, least squares at %g", q, around, best);
}

static void measured_state(void **state)
{
  (void)state;
  gg_bench_options options = {.quick = true};
  gg_bench b = {.options = &options, .seed = 1};
  gg_error_state *s = calloc(1, sizeof *s);
  gg_error err;
  s->phi = 0.3, s->e = 0.9, s->flow = GG_USF;
  assert_int_equal(gg_bench_error_state_measure(&b, s, 3, 0.01, &err), GG_OK);
  for (int i = 0; i < GG_ERROR_METHODS; i++) {
    const gg_course *c = &s->course[i];
    assert_true(s->done[i] && c->marks > 0 && c->seeds == 3);
    assert_true(c->warmup > 0 && c->warmup < c->seconds[0]);
    for (int k = 1; k < c->marks; k++) assert_true(c->seconds[k] > c->seconds[k - 1]);
    for (int q = 0; q < 3; q++) {
      assert_true(s->noise[i][q] > 0 && s->floor[i][q] >= 0);
      const double early = gg_bench_seconds_to(s, i, q, 0.5), late = gg_bench_seconds_to(s, i, q, 0.1);
      assert_true(isnan(early) || isnan(late) || early <= late);
    }
    assert_true(isnan(s->noise[i][4])); /* smooth: no theta */
    assert_true(s->noise[i][0] < 0.1);  /* of T, a second: some thousand times the noise of one grain a collision */
  }
  for (int q = 0; q < 3; q++) check_step(s, q);
  assert_string_equal(s->source[GG_DSMC][0], "solved without noise");
  assert_true(fabs(s->truth[GG_DSMC][0] / 1.2 - 1) < 1); /* T is of order one at this density */
  assert_true(s->truth_error[GG_DSMC][0] < 1e-4 * s->unit[0]);
  free(s);
}

int main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test(made_up_runs), cmocka_unit_test(warm_up),
                                     cmocka_unit_test(measured_state)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
