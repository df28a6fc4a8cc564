/* Errors and correlation times on series whose answer is known: autoregressive noise, ratios of correlated channels,
 * planted trends. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>
#include <math.h>
#include <stdlib.h>

#include "common/rng.h"
#include "statistics/autocorrelation.h"
#include "statistics/estimator.h"
#include "statistics/trend.h"

/* x_t = rho x_{t-1} + noise, stationary, unit variance: tau_int = (1+rho)/(2(1-rho)). */
static void autoregressive(gg_rng *r, double rho, double *x, size_t n)
{
  double at = gg_rng_normal(r), kick = sqrt(1 - rho * rho);
  for (size_t i = 0; i < n; i++) x[i] = at = rho * at + kick * gg_rng_normal(r);
}

/* Autoregressive noise on 10^5 rows, in one stretch or ten: the integrated correlation time within 10 %, the variance
 * of the mean of a few rows that belong together, (1 + rho)/(1 - rho) - 2 rho (1 - rho^L)/(L (1 - rho)^2), as well. */
static void correlation_time(void **state)
{
  (void)state;
  enum { N = 100000 };
  static double x[N];
  gg_rng r = gg_rng_seed(11, 0);
  const double rho[] = {0, 0.5, 0.9, 0.98};
  for (int i = 0; i < 4; i++) {
    double p = rho[i], expected = (1 + p) / (2 * (1 - p));
    autoregressive(&r, p, x, N);
    for (size_t runs = 1; runs <= 10; runs += 9) {
      gg_correlation c;
      assert_int_equal(gg_correlation_of(x, N / runs, runs, &c, NULL), GG_OK);
      assert_true(fabs(c.time / expected - 1) < (runs == 1 ? 0.1 : 0.15));
      assert_true(fabs(gg_correlation_inflation(&c, N) / (2 * c.time) - 1) < 0.01);
      for (size_t L = 1; L < 300; L *= 4) {
        double few = (1 + p) / (1 - p) - 2 * p * (1 - pow(p, (double)L)) / ((double)L * (1 - p) * (1 - p));
        assert_true(fabs(gg_correlation_inflation(&c, L) / few - 1) < 0.15);
      }
      gg_correlation_clear(&c);
    }
  }
}

/* Honest errors: over 400 series the deviation from the true mean, in units of the reported error, has unit variance.
 */
static void honest_errors(void **state)
{
  (void)state;
  enum { N = 4000, SERIES = 400 };
  static double x[N];
  gg_rng r = gg_rng_seed(12, 0);
  const double rho[] = {0, 0.9, 0.97};
  for (int k = 0; k < 3; k++) {
    double sum = 0;
    for (int s = 0; s < SERIES; s++) {
      gg_mean m;
      autoregressive(&r, rho[k], x, N);
      assert_int_equal(gg_estimate_scalar(x, N, 1, &m, NULL), GG_OK);
      sum += m.mean * m.mean / (m.error * m.error);
    }
    double variance = sum / SERIES; /* of Student's t with ~ 16-60 degrees: 1.03-1.15; scatter sqrt(2/400) = 0.07 */
    assert_true(variance > 0.75 && variance < 1.45);
  }
}

/* Windows of only 30 correlation times, whose 16 blocks hang together: the mean square of the reported error is not
 * below the variance of the mean, nor far above. Blocks alone give 0.75 of it (0.8 in three runs). */
static void short_windows(void **state)
{
  (void)state;
  enum { SERIES = 4000, T = 20 };
  static double x[60 * T];
  gg_rng r = gg_rng_seed(18, 0);
  double rho = exp(-1.0 / T);
  for (size_t runs = 1; runs <= 3; runs += 2) {
    double mean2 = 0, error2 = 0;
    size_t n = 60 * T / runs;
    for (int s = 0; s < SERIES; s++) {
      gg_mean m;
      for (size_t k = 0; k < runs; k++) autoregressive(&r, rho, x + k * n, n);
      assert_int_equal(gg_estimate_scalar(x, n, runs, &m, NULL), GG_OK);
      mean2 += m.mean * m.mean / SERIES;
      error2 += m.error * m.error / SERIES;
    }
    double exact =
        ((1 + rho) / (1 - rho) - 2 * rho * (1 - pow(rho, (double)n)) / ((double)n * pow(1 - rho, 2))) / (60 * T);
    print_message("# %zu runs: error^2 %.3f, scatter %.3f of the variance of the mean\n", runs, error2 / exact,
                  mean2 / exact);
    assert_true(fabs(mean2 / exact - 1) < 4 * sqrt(2.0 / SERIES));
    assert_true(error2 / exact > 0.94 && error2 / exact < 1.25);
  }
}

static double ratio(const double *mean, const gg_model *m)
{
  (void)m;
  return mean[0] / mean[1];
}

static gg_series planted_ratio(gg_rng *r, size_t n)
{
  gg_series s;
  assert_int_equal(gg_series_init(&s, 3, NULL), GG_OK);
  double slow = 0;
  for (size_t i = 0; i < n; i++) {
    slow = 0.8 * slow + 0.1 * gg_rng_normal(r);
    double row[3] = {0, 3 * (1 + slow) + 0.02 * gg_rng_normal(r), 2 * (1 + slow)};
    gg_series_add(&s, (double)i, row);
  }
  return s;
}

/* A ratio of channels that fluctuate together: the common part drops out of the error (jackknife-like), and the mean is
 * the ratio of means. */
static void ratios(void **state)
{
  (void)state;
  gg_rng r = gg_rng_seed(13, 0);
  gg_model model = {0};
  double sum = 0;
  for (int i = 0; i < 100; i++) {
    gg_series s = planted_ratio(&r, 2000);
    const gg_series *list[] = {&s};
    gg_mean m;
    assert_int_equal(gg_estimate_mean(list, 1, 0, s.n, 1, 2, ratio, &model, &m, NULL), GG_OK);
    assert_true(m.error < 0.0005); /* 0.02/2/sqrt(2000) = 0.00022; the common part alone would give 0.005 */
    sum += pow((m.mean - 1.5) / m.error, 2);
    gg_series_clear(&s);
  }
  assert_true(sum / 100 > 0.5 && sum / 100 < 1.8);
}

/* Replicas: the pooled error is that of all rows together. */
static void replicas(void **state)
{
  (void)state;
  gg_rng r = gg_rng_seed(14, 0);
  gg_model model = {0};
  gg_series s[4];
  const gg_series *list[4];
  for (int i = 0; i < 4; i++) s[i] = planted_ratio(&r, 1500), list[i] = &s[i];
  gg_mean one, four;
  assert_int_equal(gg_estimate_mean(list, 1, 0, 1500, 1, 2, ratio, &model, &one, NULL), GG_OK);
  assert_int_equal(gg_estimate_mean(list, 4, 0, 1500, 1, 2, ratio, &model, &four, NULL), GG_OK);
  assert_true(fabs(one.error / four.error - 2) < 0.8);
  for (int i = 0; i < 4; i++) gg_series_clear(&s[i]);
}

/* Stationary noise is not called a trend (|z| > 4 in none of 200 series); an exponential relaxation of half a standard
 * deviation over the window is. */
static void trends(void **state)
{
  (void)state;
  enum { N = 3000 };
  static double x[N];
  gg_rng r = gg_rng_seed(15, 0);
  gg_trend d;
  for (int s = 0; s < 200; s++) {
    autoregressive(&r, 0.8, x, N);
    for (int i = 0; i < N; i++) x[i] += 10;
    assert_int_equal(gg_trend_test(x, N, 1, &d, NULL), GG_OK);
    assert_true(fabs(d.z) < 4);
  }
  int found = 0;
  for (int s = 0; s < 50; s++) {
    autoregressive(&r, 0.8, x, N);
    for (int i = 0; i < N; i++) x[i] += 10 - 2 * exp(-3.0 * i / N);
    assert_int_equal(gg_trend_test(x, N, 1, &d, NULL), GG_OK);
    found += d.z > 4;
  }
  assert_true(found >= 48);
  assert_int_equal(gg_trend_test(x, 10, 1, &d, NULL), GG_OK);
  assert_true(isnan(d.z)); /* ten rows tell nothing */
}

/* A series that overflows its memory keeps its mean, its window and its times; a checkpoint restores it bit for bit. */
static void long_series(void **state)
{
  (void)state;
  gg_series s, t;
  assert_int_equal(gg_series_init(&s, 2, NULL), GG_OK);
  double n = 3.7 * GG_SERIES_ROWS, in_window = 0, sum = 0;
  gg_rng r = gg_rng_seed(16, 0);
  for (int i = 0; i < (int)n; i++) {
    if (i == 5001) gg_series_open_window(&s);
    double row[2] = {gg_rng_normal(&r), i};
    gg_series_add(&s, i, row);
    if (i >= 5001) sum += row[0], in_window++;
  }
  assert_int_equal(s.per_row, 4);
  double mean = 0;
  for (size_t i = s.window; i < s.n; i++) mean += gg_series_row(&s, i)[0];
  mean /= (double)gg_series_window_rows(&s);
  assert_true(fabs(mean - sum / in_window) <
              5e-4); /* up to 3 samples where the window opens and 3 pending are left out */
  assert_true(gg_series_row(&s, s.window)[1] >= 5001); /* no row mixes warm-up into the window */
  gg_archive a = {0};
  assert_int_equal(gg_series_save(&s, &a, NULL), GG_OK);
  assert_int_equal(gg_series_init(&t, 2, NULL), GG_OK);
  assert_int_equal(gg_series_restore(&t, &a, NULL), GG_OK);
  for (int i = 0; i < 10; i++) {
    double row[2] = {i, i};
    gg_series_add(&s, n + i, row), gg_series_add(&t, n + i, row);
  }
  assert_int_equal(s.n, t.n);
  assert_memory_equal(s.rows, t.rows, s.n * 2 * sizeof(double));
  gg_archive_clear(&a), gg_series_clear(&s), gg_series_clear(&t);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(correlation_time), cmocka_unit_test(honest_errors), cmocka_unit_test(ratios),
      cmocka_unit_test(short_windows),    cmocka_unit_test(replicas),      cmocka_unit_test(trends),
      cmocka_unit_test(long_series),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
