/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The collision rate of an elastic gas is that of kinetic theory, for ensembles of 2 to 1000 grains. Velocities of N
 * grains of zero total momentum and fixed energy are uniform on a sphere in 3(N-1) dimensions, so the mean relative
 * speed <g> of a pair is known for every N. Each of the N(N-1)/2 pairs collides at the rate pi sigma^2 chi <g>/V. */
#include "lab.h"

/* The collision rate over its limit for many grains, 4 n d^2 chi sqrt(pi T). */
static double finite_size(double N)
{
  /* g/sqrt(2) is the projection of a vector of length sqrt(3 N T) in 3(N-1) dimensions on 3 of them. */
  double D = 3 * (N - 1), part = exp(lgamma(2) - lgamma(1.5) + lgamma(D / 2) - lgamma((D + 1) / 2));
  return (N - 1) / N * part * sqrt(6 * N) / (4 / sqrt(M_PI));
}

static void rate(double phi, int64_t n)
{
  gg_scene s = lab_scene(GG_EQUILIBRIUM, phi, 1, -1, n);
  gg_model m = lab_model(&s);
  lab_mean rate = {0};
  for (int r = 0; r < 20; r++) {
    gg_engine *g = lab_engine(&m, 10 + (uint64_t)r);
    double time = 0;
    lab_advance(g, INFINITY, 10 * (uint64_t)n); /* forgets the start */
    uint64_t target = 20000;
    gg_collision_sums t;
    gg_dsmc_ops.take_sums(g, &t);
    time = lab_advance(g, target / (0.5 * (double)n * gg_common_model_collision_rate(&m, 0.5)), UINT64_MAX);
    gg_dsmc_ops.take_sums(g, &t);
    lab_add(&rate, 2 * (double)t.collisions[GG_11] / ((double)n * time));
    gg_dsmc_ops.destroy(g);
  }
  char what[64];
  snprintf(what, sizeof what, "rate, phi %g, N %d", phi, (int)n);
  lab_expect(what, &rate, 4 * m.density * m.chi[0] * sqrt(M_PI * 0.5) * finite_size((double)n), 0, 0.02);
}

static void collision_rate_is_that_of_kinetic_theory(void **state)
{
  (void)state;
  assert_true(fabs(finite_size(1e6) - 1) < 1e-6);
  for (int64_t n = 2; n <= 1000; n = n == 2 ? 10 : 10 * n) {
    rate(0, n);
    rate(0.3, n);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test(collision_rate_is_that_of_kinetic_theory)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
