/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Errors of means and of ratios of means are right for correlated series, short windows, replicas. */
#include "planted.h"
#include "statistics/estimator.h"

/* Over 400 series the deviation from the true mean, in units of the reported error, has unit variance. */
static void honest_errors(void **state)
{
  (void)state;
  enum { N = 4000, SERIES = 400 };
  static double x[N];
  gg_rng r = gg_common_rng_seed(12, 0);
  const double rho[] = {0, 0.9, 0.97};
  for (int k = 0; k < 3; k++) {
    double sum = 0;
    for (int s = 0; s < SERIES; s++) {
      gg_mean m;
      planted_autoregressive(&r, rho[k], x, N);
      assert_int_equal(gg_statistics_estimate_scalar(x, N, 1, &m, NULL), GG_OK);
      sum += m.mean * m.mean / (m.error * m.error);
    }
    double variance = sum / SERIES; /* Student's t with ~ 16-60 degrees: 1.03-1.15; scatter sqrt(2/400) = 0.07 */
    assert_true(variance > 0.75 && variance < 1.45);
  }
}

/* Windows of only 60 correlation times, whose 16 blocks are correlated: the mean square of deviation over error is 1
 * (of blocks alone 1.5; without the error's own uncertainty 1.2), in one run or three. */
static void short_windows(void **state)
{
  (void)state;
  enum { SERIES = 4000, T = 20 };
  static double x[60 * T];
  gg_rng r = gg_common_rng_seed(18, 0);
  double rho = exp(-1.0 / T);
  for (size_t runs = 1; runs <= 3; runs += 2) {
    double mean2 = 0, z2 = 0;
    size_t n = 60 * T / runs;
    for (int s = 0; s < SERIES; s++) {
      gg_mean m;
      for (size_t k = 0; k < runs; k++) planted_autoregressive(&r, rho, x + k * n, n);
      assert_int_equal(gg_statistics_estimate_scalar(x, n, runs, &m, NULL), GG_OK);
      mean2 += m.mean * m.mean / SERIES;
      z2 += m.mean * m.mean / (m.error * m.error) / SERIES;
    }
    double exact =
        ((1 + rho) / (1 - rho) - 2 * rho * (1 - pow(rho, (double)n)) / ((double)n * pow(1 - rho, 2))) / (60 * T);
    print_message("# %zu runs: z^2 %.3f, scatter %.3f of the variance of the mean\n", runs, z2, mean2 / exact);
    assert_true(fabs(mean2 / exact - 1) < 4 * sqrt(2.0 / SERIES));
    assert_true(fabs(z2 - 1) < 0.05 + 4 * sqrt(2.0 / SERIES));
  }
}

/* The intervals mean +- error and mean +- 1.96 error contain the true value in 68.3 and 95 of 100 cases. Windows of
 * 30, 60 and 200 correlation times, 2000 of each: within 3.5 % and four errors of that count (without the error's
 * own uncertainty 62 and 90 % in the shortest). */
static void intervals_cover_the_truth(void **state)
{
  (void)state;
  enum { SERIES = 2000, T = 10 };
  static double x[200 * T];
  static const int lengths[] = {30, 60, 200};
  gg_rng r = gg_common_rng_seed(19, 0);
  for (int k = 0; k < 3; k++) {
    size_t n = (size_t)lengths[k] * T;
    double in68 = 0, in95 = 0;
    for (int s = 0; s < SERIES; s++) {
      gg_mean m;
      planted_autoregressive(&r, (2.0 * T - 1) / (2 * T + 1), x, n);
      assert_int_equal(gg_statistics_estimate_scalar(x, n, 1, &m, NULL), GG_OK);
      in68 += fabs(m.mean) <= m.error, in95 += fabs(m.mean) <= 1.96 * m.error;
    }
    in68 /= SERIES, in95 /= SERIES;
    print_message("# %d correlation times: %.1f %%, %.1f %%\n", lengths[k], 100 * in68, 100 * in95);
    assert_true(fabs(in68 - 0.683) < 0.035 + 4 * sqrt(0.683 * 0.317 / SERIES));
    assert_true(fabs(in95 - 0.95) < 0.01 + 4 * sqrt(0.95 * 0.05 / SERIES));
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
  assert_int_equal(gg_statistics_series_init(&s, 3, NULL), GG_OK);
  double slow = 0;
  for (size_t i = 0; i < n; i++) {
    slow = 0.8 * slow + 0.1 * gg_common_rng_normal(r);
    double row[3] = {0, 3 * (1 + slow) + 0.02 * gg_common_rng_normal(r), 2 * (1 + slow)};
    gg_statistics_series_add(&s, (double)i, row);
  }
  return s;
}

/* A ratio of channels with common fluctuations: the common part cancels in the error, and the mean is the ratio of
 * means. */
static void errors_of_ratios_omit_common_fluctuations(void **state)
{
  (void)state;
  gg_rng r = gg_common_rng_seed(13, 0);
  gg_model model = {0};
  double sum = 0;
  for (int i = 0; i < 100; i++) {
    gg_series s = planted_ratio(&r, 2000);
    const gg_series *list[] = {&s};
    gg_mean m;
    assert_int_equal(
        gg_statistics_estimate_mean(list, 1, 0, s.n, 1, 2, (gg_function){.of = ratio}, &model, 0, &m, NULL), GG_OK);
    assert_true(m.error < 0.0005); /* 0.02/2/sqrt(2000) = 0.00022; the common part alone would give 0.005 */
    sum += pow((m.mean - 1.5) / m.error, 2);
    gg_statistics_series_clear(&s);
  }
  assert_true(sum / 100 > 0.5 && sum / 100 < 1.8);
}

static double inverse(const double *a, const gg_model *m)
{
  (void)m;
  return 1 / a[1];
}

/* Units do not matter: for channels as small as the collision rates of a gas at phi = 10^-20, the error is the same
 * fraction of the mean. */
static void small_channels(void **state)
{
  (void)state;
  gg_rng r = gg_common_rng_seed(14, 0);
  gg_model model = {0};
  gg_series s = planted_ratio(&r, 2000), t;
  gg_mean m, n;
  for (double unit = 1; unit > 1e-30; unit *= 1e-4) {
    assert_int_equal(gg_statistics_series_init(&t, 3, NULL), GG_OK);
    for (size_t i = 0; i < s.n; i++) {
      const double *x = gg_series_row(&s, i);
      gg_statistics_series_add(&t, i, (double[]){x[0], unit * x[1], unit * x[2]});
    }
    const gg_series *one[] = {&s}, *other[] = {&t};
    for (int k = 0; k < 2; k++) {
      const gg_function f = {.of = k ? inverse : ratio};
      const size_t offset = k ? 0 : 1;
      assert_int_equal(gg_statistics_estimate_mean(one, 1, 0, s.n, offset, 2, f, &model, 0, &m, NULL), GG_OK);
      assert_int_equal(gg_statistics_estimate_mean(other, 1, 0, t.n, offset, 2, f, &model, 0, &n, NULL), GG_OK);
      if (fabs(n.error / n.mean / (m.error / m.mean) - 1) > 1e-4)
        fail_msg("in units of %g: %g of %g, %g of %g", unit, n.error, n.mean, m.error, m.mean);
    }
    gg_statistics_series_clear(&t);
  }
  gg_statistics_series_clear(&s);
}

/* Two channels of which one follows the other, as spins follow T: both are slow, the ratio is fast and returns with
 * the opposite sign. Mean square of deviation over error in windows of 400 rows, 60 times of the slow channel (0.81
 * if the sum does not extend over the memory of the parts). */
static void errors_include_the_memory_of_the_parts(void **state)
{
  (void)state;
  enum { SERIES = 3000, N = 400, BEFORE = 100 };
  gg_rng r = gg_common_rng_seed(20, 0);
  gg_model model = {0};
  double z2 = 0;
  for (int k = 0; k < SERIES; k++) {
    double first = 0, second = 0;
    gg_series s;
    assert_int_equal(gg_statistics_series_init(&s, 2, NULL), GG_OK);
    for (int i = 0; i < BEFORE + N; i++) {
      second += 0.5 * (0.8 * first - second) + 0.008 * gg_common_rng_normal(&r);
      first = 0.8 * first + 0.01 * gg_common_rng_normal(&r);
      if (i >= BEFORE) gg_statistics_series_add(&s, i, (double[]){1 + second, 1 + first});
    }
    const gg_series *list[] = {&s};
    gg_mean m;
    assert_int_equal(gg_statistics_estimate_mean(list, 1, 0, N, 0, 2, (gg_function){.of = ratio}, &model, 0, &m, NULL),
                     GG_OK);
    z2 += pow((m.mean - 1) / m.error, 2) / SERIES;
    gg_statistics_series_clear(&s);
  }
  print_message("# followers: z^2 %.3f\n", z2);
  assert_true(fabs(z2 - 1) < 0.05 + 4 * sqrt(2.0 / SERIES));
}

/* Replicas: the pooled error is that of all rows together. */
static void replicas_are_pooled(void **state)
{
  (void)state;
  gg_rng r = gg_common_rng_seed(14, 0);
  gg_model model = {0};
  gg_series s[4];
  const gg_series *list[4];
  for (int i = 0; i < 4; i++) s[i] = planted_ratio(&r, 1500), list[i] = &s[i];
  gg_mean one, four;
  assert_int_equal(
      gg_statistics_estimate_mean(list, 1, 0, 1500, 1, 2, (gg_function){.of = ratio}, &model, 0, &one, NULL), GG_OK);
  assert_int_equal(
      gg_statistics_estimate_mean(list, 4, 0, 1500, 1, 2, (gg_function){.of = ratio}, &model, 0, &four, NULL), GG_OK);
  assert_true(fabs(one.error / four.error - 2) < 0.8);
  for (int i = 0; i < 4; i++) gg_statistics_series_clear(&s[i]);
}

/* A slow mode that is known from elsewhere, and too slow to change blocks or sums, adds an uncertainty of 2.5 of its
 * times over all rows. */
static void doubt_of_slow_modes(void **state)
{
  (void)state;
  gg_rng r = gg_common_rng_seed(22, 0);
  gg_model model = {0};
  gg_series s[2] = {planted_ratio(&r, 1500), planted_ratio(&r, 1500)};
  const gg_series *list[] = {&s[0], &s[1]};
  gg_mean without, with;
  const gg_function f = {.of = ratio};
  assert_int_equal(gg_statistics_estimate_mean(list, 2, 0, 1500, 1, 2, f, &model, 0, &without, NULL), GG_OK);
  const double slow = 3 * without.correlation_rows;
  assert_int_equal(gg_statistics_estimate_mean(list, 2, 0, 1500, 1, 2, f, &model, slow, &with, NULL), GG_OK);
  assert_true(fabs(with.error / without.error - (1 + 2.5 * slow / 3000)) < 1e-12);
  for (int i = 0; i < 2; i++) gg_statistics_series_clear(&s[i]);
}

/* Runs of so few rows that they are correlated: errors include that (z^2 is 2.1 if two or three rows count as
 * independent), and are rather too large. */
static void short_runs(void **state)
{
  (void)state;
  enum { SERIES = 2000, RUNS = 12 };
  double x[RUNS * 5];
  gg_rng r = gg_common_rng_seed(20, 0);
  for (size_t n = 2; n <= 5; n++) {
    double z2 = 0;
    for (int s = 0; s < SERIES; s++) {
      gg_mean m;
      for (size_t k = 0; k < RUNS; k++) planted_autoregressive(&r, 0.9, x + k * n, n);
      assert_int_equal(gg_statistics_estimate_scalar(x, n, RUNS, &m, NULL), GG_OK);
      z2 += m.mean * m.mean / (m.error * m.error) / SERIES;
    }
    print_message("# %zu rows a run: z^2 %.3f\n", n, z2);
    assert_true(z2 > 0.4 && z2 < 1.3);
  }
}

/* A ratio that is unknown below 0: of three runs, without one of which it is unknown, the error is unknown, not 0. */
static double positive_ratio(const double *mean, const gg_model *m)
{
  (void)m;
  return mean[1] > 0 ? mean[0] / mean[1] : NAN;
}

static void a_mean_that_hangs_on_one_run_has_no_error(void **state)
{
  (void)state;
  const double a[] = {1, 5}, b[] = {1, -1}, c[] = {1, -2};
  const double *rows[] = {a, b, c};
  double scratch[4];
  gg_mean m = gg_statistics_estimate_over_runs(rows, 3, 2, (gg_function){.of = positive_ratio}, NULL, scratch);
  assert_true(fabs(m.mean - 1.5) < 1e-12 && isnan(m.error) && isnan(m.scatter));
  m = gg_statistics_estimate_over_runs(rows, 2, 2, (gg_function){.of = positive_ratio}, NULL, scratch);
  assert_true(isfinite(m.mean) && isnan(m.error));
}

int main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test(honest_errors),
                                     cmocka_unit_test(short_windows),
                                     cmocka_unit_test(intervals_cover_the_truth),
                                     cmocka_unit_test(errors_of_ratios_omit_common_fluctuations),
                                     cmocka_unit_test(small_channels),
                                     cmocka_unit_test(errors_include_the_memory_of_the_parts),
                                     cmocka_unit_test(replicas_are_pooled),
                                     cmocka_unit_test(short_runs),
                                     cmocka_unit_test(a_mean_that_hangs_on_one_run_has_no_error),
                                     cmocka_unit_test(doubt_of_slow_modes)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
