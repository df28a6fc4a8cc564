/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Correlation times of autoregressive noise agree with their known values. */
#include "planted.h"
#include "statistics/autocorrelation.h"

/* Autoregressive noise on 10^5 rows, in one stretch or ten: the integrated correlation time is right within 10 %,
 * and so is the variance of the mean of L neighbouring rows, (1 + rho)/(1 - rho) - 2 rho (1 - rho^L)/(L (1 -
 * rho)^2). */
static void correlation_time(void **state)
{
  (void)state;
  enum { N = 100000 };
  static double x[N];
  gg_rng r = gg_common_rng_seed(11, 0);
  const double rho[] = {0, 0.5, 0.9, 0.98};
  for (int i = 0; i < 4; i++) {
    double p = rho[i], expected = (1 + p) / (2 * (1 - p));
    planted_autoregressive(&r, p, x, N);
    for (size_t runs = 1; runs <= 10; runs += 9) {
      gg_correlation c;
      assert_int_equal(gg_statistics_correlation_of(x, N / runs, runs, 0, &c, NULL), GG_OK);
      assert_true(fabs(c.time / expected - 1) < (runs == 1 ? 0.1 : 0.15));
      assert_true(fabs(gg_statistics_correlation_inflation(&c, N) / (2 * c.time) - 1) < 0.01);
      for (size_t L = 1; L < 300; L *= 4) {
        double few = (1 + p) / (1 - p) - 2 * p * (1 - pow(p, (double)L)) / ((double)L * (1 - p) * (1 - p));
        assert_true(fabs(gg_statistics_correlation_inflation(&c, L) / few - 1) < 0.15);
      }
      gg_statistics_correlation_clear(&c);
    }
  }
}

static double pairs(const double *x, size_t n, size_t runs, size_t lag)
{
  double sum = 0;
  for (size_t r = 0; r < runs; r++)
    for (size_t i = 0; i + lag < n; i++) sum += x[r * n + i] * x[r * n + i + lag];
  return sum / (double)(n - lag);
}

/* rho is normalised by the pairs at each lag, also near the end of short stretches, whether the sum takes few lags,
 * some, or so many that transforms are used; the correction for the mean is the same at all lags. */
static void pairs_of_each_lag(void **state)
{
  (void)state;
  static double x[6000];
  gg_rng r = gg_common_rng_seed(12, 0);
  const double rho[] = {0.5, 0.9, 0.97, 0.995};
  const size_t rows[] = {5, 21, 63, 64, 65, 3000}, least[] = {1, 20, 64, 256};
  for (int i = 0; i < 4; i++)
    for (int k = 0; k < 6; k++)
      for (size_t runs = 1; runs <= 2; runs++) {
        gg_correlation c;
        planted_autoregressive(&r, rho[i], x, rows[k] * runs);
        assert_int_equal(gg_statistics_correlation_of(x, rows[k], runs, 0, &c, NULL), GG_OK);
        double one = pairs(x, rows[k], runs, 1), none = pairs(x, rows[k], runs, 0);
        for (size_t t = 2; t <= c.window; t++)
          assert_true(fabs((c.rho[t] - 1) / (c.rho[1] - 1) - (pairs(x, rows[k], runs, t) - none) / (one - none)) <
                      1e-8);
        assert_true(rows[k] < 3000 || c.window >= least[i]);
        gg_statistics_correlation_clear(&c);
      }
}

int main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test(correlation_time), cmocka_unit_test(pairs_of_each_lag)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
