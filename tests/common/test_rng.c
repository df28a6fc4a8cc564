/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Random streams: uniform, independent of each other, the same for the same seed; directions and normals have the right
 * moments within five standard errors. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>
#include <math.h>

#include "common/rng.h"

enum { DRAWS = 1000000 };

static void within(double mean, double expected, double sd, double n)
{
  assert_true(fabs(mean - expected) < 5 * sd / sqrt(n));
}

/* Moments of the uniform and of the correlation between neighbouring streams. */
static void uniform_and_independent(void **state)
{
  (void)state;
  gg_rng a = gg_common_rng_seed(1, 0), b = gg_common_rng_seed(1, 1);
  double sum = 0, square = 0, cross = 0;
  for (int i = 0; i < DRAWS; i++) {
    double u = gg_rng_uniform(&a), v = gg_rng_uniform(&b);
    assert_true(u >= 0 && u < 1);
    sum += u, square += u * u, cross += (u - 0.5) * (v - 0.5);
  }
  within(sum / DRAWS, 0.5, sqrt(1.0 / 12), DRAWS);
  within(square / DRAWS, 1.0 / 3, sqrt(4.0 / 45), DRAWS);
  within(cross / DRAWS, 0, 1.0 / 12, DRAWS);
}

/* Same seed and stream: same numbers; another seed: others. */
static void same_seed_and_stream_give_the_same_numbers(void **state)
{
  (void)state;
  gg_rng a = gg_common_rng_seed(7, 3), b = gg_common_rng_seed(7, 3), c = gg_common_rng_seed(8, 3);
  int equal = 0;
  for (int i = 0; i < 1000; i++) {
    uint64_t x = gg_rng_next(&a);
    assert_true(x == gg_rng_next(&b));
    equal += x == gg_rng_next(&c);
  }
  assert_int_equal(equal, 0);
}

/* Unit length, no mean, isotropic second moments. */
static void directions_are_isotropic(void **state)
{
  (void)state;
  gg_rng r = gg_common_rng_seed(2, 0);
  gg_vec sum = {0, 0, 0}, square = {0, 0, 0};
  for (int i = 0; i < DRAWS; i++) {
    gg_vec k = gg_rng_direction(&r);
    assert_true(fabs(gg_dot(k, k) - 1) < 1e-15 * 4);
    sum = gg_add(sum, k);
    square = gg_add(square, (gg_vec){k.x * k.x, k.y * k.y, k.z * k.z});
  }
  double sd1 = sqrt(1.0 / 3), sd2 = sqrt(4.0 / 45);
  within(sum.x / DRAWS, 0, sd1, DRAWS), within(sum.y / DRAWS, 0, sd1, DRAWS), within(sum.z / DRAWS, 0, sd1, DRAWS);
  within(square.x / DRAWS, 1.0 / 3, sd2, DRAWS), within(square.z / DRAWS, 1.0 / 3, sd2, DRAWS);
}

/* Normal: moments up to the fourth. Bounded integers: in range, uniform. */
static void normals_and_integers(void **state)
{
  (void)state;
  gg_rng r = gg_common_rng_seed(3, 0);
  double m1 = 0, m2 = 0, m4 = 0, counts[7] = {0};
  for (int i = 0; i < DRAWS; i++) {
    double x = gg_common_rng_normal(&r);
    m1 += x, m2 += x * x, m4 += x * x * x * x;
    uint32_t k = gg_rng_below(&r, 7);
    assert_true(k < 7);
    counts[k]++;
  }
  within(m1 / DRAWS, 0, 1, DRAWS);
  within(m2 / DRAWS, 1, sqrt(2), DRAWS);
  within(m4 / DRAWS, 3, sqrt(96), DRAWS);
  for (int k = 0; k < 7; k++) within(counts[k] / DRAWS, 1.0 / 7, sqrt(6.0 / 49), DRAWS);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(uniform_and_independent),
      cmocka_unit_test(same_seed_and_stream_give_the_same_numbers),
      cmocka_unit_test(directions_are_isotropic),
      cmocka_unit_test(normals_and_integers),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
