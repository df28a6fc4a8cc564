/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Proves: the mean square of deviations over stated errors of a gas that is followed in time, means over replicas, is
 * 1: of a temperature (without Student's allowance 1.4 for 8 replicas), and of a free path from intervals with few
 * collisions (3.1 as a mean of ratios). On an engine whose means are known; bounds on both sides. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "fake_engine.h"
#include "graingas.h"
#include "run/run.h"
#include "scene/model_of_scene.h"
#include "statistics/estimator.h"

enum { INTERVALS = 100 };
#define APART 3.0 /* collisions per grain of an interval */

typedef struct tally {
  double n, z2;
} tally;

static void add(tally *t, double value, double error, double truth)
{
  assert_true(isfinite(value) && error > 0);
  t->n++, t->z2 += pow((value - truth) / error, 2);
}

static gg_scene followed(int replicas)
{
  gg_scene s = planted_scene(-1);
  gg_model m;
  s.flow = GG_EQUILIBRIUM, s.collision.e[0] = 1;
  s.particles = 8;
  s.run.replicas = replicas;
  assert_int_equal(gg_scene_model_make(&s, GG_MD, &m, NULL), GG_OK);
  s.run.duration = INTERVALS * APART / gg_common_model_collision_rate(&m, fake.T) / gg_scene_clock_rate(&s);
  fake.counted = true;
  return s;
}

/* Temperatures at all times; free paths and T at the end. Every point is one of ten or so that chance makes, of which
 * z^2 scatters by 2. */
static void square_deviations(int runs, int replicas, tally *curve, tally *T, tally *path)
{
  gg_scene s = followed(replicas);
  gg_error err;
  for (int k = 0; k < runs; k++) {
    gg_result *r = NULL;
    s.run.seed = (uint64_t)k + 1;
    if (gg_run_scene(&s, NULL, 1, NULL, &r, &err) != GG_OK) fail_msg("%s", err.message);
    const gg_estimate *l = &r->value[GG_Q_MEAN_FREE_PATH], *t = &r->value[GG_Q_TEMPERATURE];
    add(path, l->mean, l->error, sqrt(3 * fake.T) / gg_common_model_collision_rate(&r->model, fake.T));
    add(T, t->mean, t->error, fake.T);
    for (int i = 0; i < r->curves.n; i++)
      for (size_t p = 1; strcmp(r->curves.curve[i].name, "temperature_in_time") == 0 && p < r->curves.curve[i].n; p++)
        add(curve, r->curves.curve[i].value[p], r->curves.curve[i].error[p], fake.T);
    gg_result_free(r);
  }
}

/* Student's t of n - 1 degrees of freedom has the mean square (n - 1)/(n - 3), the factor on errors takes it to this.
 */
static double expected(int n)
{
  return (n - 1) / (n - 3.0) / pow(gg_statistics_student((size_t)n), 2);
}

static void errors_over_replicas(void **state)
{
  (void)state;
  static const int replicas[] = {8, 16};
  const bool nightly = getenv("NIGHTLY") != NULL;
  const int runs = nightly ? 800 : 200;
  for (int k = 0; k < (nightly ? 2 : 1); k++) {
    tally curve = {0}, T = {0}, path = {0};
    square_deviations(runs, replicas[k], &curve, &T, &path);
    print_message("# %d replicas: z^2 of T in time %.3f, at the end %.3f, of the free path %.3f; expected %.3f\n",
                  replicas[k], curve.z2 / curve.n, T.z2 / T.n, path.z2 / path.n, expected(replicas[k]));
    const double one = 2 / sqrt(runs); /* standard error at one time */
    assert_true(fabs(expected(replicas[k]) - 1) < 0.02);
    assert_true(fabs(curve.z2 / curve.n - expected(replicas[k])) < 4 * one / 5);
    assert_true(fabs(T.z2 / T.n - expected(replicas[k])) < 4 * one);
    assert_true(fabs(path.z2 / path.n - expected(replicas[k])) < 4 * one);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test(errors_over_replicas)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
