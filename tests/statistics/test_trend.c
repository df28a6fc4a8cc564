/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The trend test detects a relaxation, and finds nothing in stationary noise. */
#include "planted.h"
#include "statistics/trend.h"

/* Stationary noise has no trend (|z| > 4 in none of 200 series); an exponential relaxation of half a standard
 * deviation over the window has one. */
static void only_a_relaxation_has_a_trend(void **state)
{
  (void)state;
  enum { N = 3000 };
  static double x[N];
  gg_rng r = gg_common_rng_seed(15, 0);
  gg_trend d;
  for (int s = 0; s < 200; s++) {
    planted_autoregressive(&r, 0.8, x, N);
    for (int i = 0; i < N; i++) x[i] += 10;
    assert_int_equal(gg_statistics_trend_test(x, N, 1, &d, NULL), GG_OK);
    assert_true(fabs(d.z) < 4);
  }
  int found = 0;
  for (int s = 0; s < 50; s++) {
    planted_autoregressive(&r, 0.8, x, N);
    for (int i = 0; i < N; i++) x[i] += 10 - 2 * exp(-3.0 * i / N);
    assert_int_equal(gg_statistics_trend_test(x, N, 1, &d, NULL), GG_OK);
    found += d.z > 4;
  }
  assert_true(found >= 48);
  assert_int_equal(gg_statistics_trend_test(x, 10, 1, &d, NULL), GG_OK);
  assert_true(isnan(d.z)); /* ten rows are not enough */
}

/* A distant start that is soon forgotten: all of it in one of 50 parts. It shifts the mean by two errors; in the
 * first third it adds as much scatter as difference, so that a comparison of thirds alone found it in no series. One
 * stretch or three; stationary skewed noise has no trend. */
static void a_distant_start_is_found(void **state)
{
  (void)state;
  enum { N = 3000, T = 50, SERIES = 60 };
  static double x[N];
  gg_rng r = gg_common_rng_seed(16, 0);
  gg_trend d;
  int found[2] = {0, 0}, silent = 0;
  for (int s = 0; s < SERIES; s++) {
    for (size_t runs = 1; runs <= 3; runs += 2) {
      size_t n = N / runs;
      for (size_t k = 0; k < runs; k++) planted_autoregressive(&r, 0.8, x + k * n, n);
      for (size_t i = 0; i < N; i++) x[i] += 10 + 6 * exp(-(double)(i % n) / T);
      assert_int_equal(gg_statistics_trend_test(x, n, runs, &d, NULL), GG_OK);
      found[runs / 2] += d.z < -4 && d.share < 0.1 && d.relative < 0;
    }
    planted_autoregressive(&r, 0.8, x, N);
    for (int i = 0; i < N; i++) x[i] = exp(x[i] / 4);
    assert_int_equal(gg_statistics_trend_test(x, N, 1, &d, NULL), GG_OK);
    silent += fabs(d.z) < 4;
  }
  print_message("# found in %d and %d of %d, silent in %d\n", found[0], found[1], SERIES, silent);
  assert_true(found[0] >= SERIES - 4 && found[1] >= SERIES - 4 && silent >= SERIES - 1);
}

/* The beginning of eight replicas has an error smaller by the root of eight than that of one. */
static void beginnings_of_replicas(void **state)
{
  (void)state;
  enum { N = 400, T = 8, RUNS = 8, SERIES = 40 };
  static double x[N * RUNS];
  gg_rng r = gg_common_rng_seed(17, 0);
  gg_trend d;
  int found = 0;
  for (int s = 0; s < SERIES; s++) {
    for (size_t k = 0; k < RUNS; k++) planted_autoregressive(&r, 0.3, x + k * N, N);
    for (size_t i = 0; i < N * RUNS; i++) x[i] += 10 + 1.5 * exp(-(double)(i % N) / T);
    assert_int_equal(gg_statistics_trend_test(x, N, RUNS, &d, NULL), GG_OK);
    found += d.z < -4 && d.share < 0.1;
  }
  print_message("# beginnings of replicas: %d of %d\n", found, SERIES);
  assert_true(found >= SERIES - 4);
}

int main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test(only_a_relaxation_has_a_trend),
                                     cmocka_unit_test(a_distant_start_is_found),
                                     cmocka_unit_test(beginnings_of_replicas)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
