/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The jackknife over blocks of known scatter and correlation. */
#include "planted.h"
#include "statistics/estimator.h"
#include "statistics/jackknife.h"

enum { BLOCKS = 24 };

/* Leave out each of the blocks x in turn, and add the change of their mean. */
static void add_mean(gg_jackknife *j, const double *x, size_t n)
{
  double sum = 0;
  for (size_t b = 0; b < n; b++) sum += x[b];
  for (size_t b = 0; b < n; b++) {
    *gg_statistics_jackknife_next(j) = (sum - x[b]) / (double)(n - 1) - sum / (double)n;
    gg_statistics_jackknife_add(j);
  }
}

/* Alternating blocks get no allowance for correlation: the error is that of textbooks with Student's factor, and the
 * correlation is near -1. */
static void textbook_error(void **state)
{
  (void)state;
  double x[BLOCKS], error, sum = 0, squares = 0;
  gg_rng r = gg_common_rng_seed(21, 0);
  gg_jackknife j;
  for (int b = 0; b < BLOCKS; b++) x[b] = (b % 2 ? 1 : -1) * (1 + 0.1 * gg_rng_uniform(&r));
  for (int b = 0; b < BLOCKS; b++) sum += x[b], squares += x[b] * x[b];
  assert_int_equal(gg_statistics_jackknife_init(&j, 1, NULL), GG_OK);
  add_mean(&j, x, BLOCKS);
  double correlation = gg_statistics_jackknife_errors(&j, 0, 1, 0, NAN, &error);
  double textbook = sqrt((squares - sum * sum / BLOCKS) / BLOCKS / (BLOCKS - 1)) * gg_statistics_student(BLOCKS);
  assert_true(fabs(error / textbook - 1) < 1e-12);
  assert_true(correlation < -0.8 && correlation > -1.1);
  gg_statistics_jackknife_clear(&j);
}

/* Autoregressive blocks: over many repeats the mean square of the error is the variance of the mean of the blocks,
 * up to the effect of the correlation's own uncertainty; the scatter alone would be (1 - rho)/(1 + rho) of it. */
static void correlated_blocks(void **state)
{
  (void)state;
  enum { REPEATS = 2000, WIDTH = 9 };
  const double rho = 0.4, n = BLOCKS;
  double exact = ((1 + rho) / (1 - rho) - 2 * rho * (1 - pow(rho, n)) / (n * pow(1 - rho, 2))) / n, sum = 0;
  gg_rng r = gg_common_rng_seed(22, 0);
  for (int k = 0; k < REPEATS; k++) {
    double x[WIDTH][BLOCKS], mean[WIDTH] = {0}, error[WIDTH];
    gg_jackknife j;
    assert_int_equal(gg_statistics_jackknife_init(&j, WIDTH, NULL), GG_OK);
    for (int a = 0; a < WIDTH; a++) planted_autoregressive(&r, rho, x[a], BLOCKS);
    for (int a = 0; a < WIDTH; a++)
      for (int b = 0; b < BLOCKS; b++) mean[a] += x[a][b] / n;
    for (int b = 0; b < BLOCKS; b++) {
      double *d = gg_statistics_jackknife_next(&j);
      for (int a = 0; a < WIDTH; a++) d[a] = (mean[a] - x[a][b]) / (n - 1);
      gg_statistics_jackknife_add(&j);
    }
    gg_statistics_jackknife_errors(&j, 0, WIDTH, 0, NAN, error);
    for (int a = 0; a < WIDTH; a++) sum += error[a] * error[a] / (REPEATS * WIDTH);
    gg_statistics_jackknife_clear(&j);
  }
  print_message("# error^2 %.3f of the variance of the mean, scatter alone %.3f\n", sum / exact, (1 - rho) / (1 + rho));
  assert_true(sum / exact > 0.85 && sum / exact < 1.25);
}

/* A single number of independent blocks: chance correlations enlarge its error, because only positive ones count;
 * with the correlation of its curve the effect is smaller. */
static void beside_a_curve(void **state)
{
  (void)state;
  enum { REPEATS = 4000 };
  double alone = 0, beside = 0;
  gg_rng r = gg_common_rng_seed(23, 0);
  for (int k = 0; k < REPEATS; k++) {
    double x[BLOCKS], error[2];
    gg_jackknife j;
    assert_int_equal(gg_statistics_jackknife_init(&j, 1, NULL), GG_OK);
    for (int b = 0; b < BLOCKS; b++) x[b] = gg_common_rng_normal(&r);
    add_mean(&j, x, BLOCKS);
    gg_statistics_jackknife_errors(&j, 0, 1, 0, NAN, &error[0]);
    gg_statistics_jackknife_errors(&j, 0, 1, 0, 0, &error[1]);
    alone += error[0] * error[0] * BLOCKS / REPEATS, beside += error[1] * error[1] * BLOCKS / REPEATS;
    gg_statistics_jackknife_clear(&j);
  }
  alone /= pow(gg_statistics_student(BLOCKS), 2), beside /= pow(gg_statistics_student(BLOCKS), 2);
  print_message("# error^2 %.3f of the variance of the mean, %.3f beside a curve, Student's factor apart\n", alone,
                beside);
  assert_true(beside > 1 && beside < 1.12 && alone > beside + 0.1);
}

/* A slow mode of 20 decay times in fast noise of some times its variance, in 32 blocks: the correlation of
 * neighbours alone gives a too small error; with the decay time the mean square of the error is the variance of the
 * mean. Noise alone gets no more than chance correlations add. */
static void slow_mode_in_noise(void **state)
{
  (void)state;
  enum { REPEATS = 1000, WIDTH = 9, N = 32, LENGTH = 64 };
  const double tau = N * LENGTH / 20.0, rho = exp(-1 / tau), n = N * LENGTH, kick = sqrt(1 - rho * rho);
  const double of_mode = ((1 + rho) / (1 - rho) - 2 * rho * (1 - pow(rho, n)) / (n * pow(1 - rho, 2))) / n;
  gg_rng r = gg_common_rng_seed(24, 0);
  for (int slow = 0; slow < 2; slow++) {
    double noise = 8, known = 0, unknown = 0, variance = slow * of_mode + noise * noise / n, squares = 0;
    for (int k = 0; k < REPEATS; k++) {
      double x[WIDTH][N] = {{0}}, mean[WIDTH] = {0}, error[2][WIDTH], at = gg_common_rng_normal(&r), all = 0;
      gg_jackknife j;
      assert_int_equal(gg_statistics_jackknife_init(&j, WIDTH, NULL), GG_OK);
      for (int b = 0; b < N; b++) {
        double mode = 0;
        for (int t = 0; t < LENGTH; t++) mode += (at = rho * at + kick * gg_common_rng_normal(&r)) / LENGTH;
        for (int a = 0; a < WIDTH; a++) x[a][b] = slow * mode + noise * gg_common_rng_normal(&r) / sqrt(LENGTH);
        for (int a = 0; a < WIDTH; a++) mean[a] += x[a][b] / N;
      }
      for (int b = 0; b < N; b++) {
        double *d = gg_statistics_jackknife_next(&j);
        for (int a = 0; a < WIDTH; a++) d[a] = (mean[a] - x[a][b]) / (N - 1);
        gg_statistics_jackknife_add(&j);
      }
      gg_statistics_jackknife_errors(&j, 0, WIDTH, 0, NAN, error[0]);
      gg_statistics_jackknife_errors(&j, 0, WIDTH, tau / LENGTH, NAN, error[1]);
      for (int a = 0; a < WIDTH; a++) {
        unknown += error[0][a] * error[0][a] / (REPEATS * WIDTH * variance);
        all += error[1][a] * error[1][a] / (WIDTH * variance);
      }
      known += all / REPEATS, squares += all * all / REPEATS;
      gg_statistics_jackknife_clear(&j);
    }
    double four = 4 * sqrt((squares - known * known) / REPEATS);
    print_message("# error^2 %.3f +- %.3f of the variance of the mean, %.3f without the decay time\n", known, four / 4,
                  unknown);
    assert_true(known > 0.85 - four && known < (slow ? 1.15 : 1.5) + four);
    if (slow) assert_true(unknown < known - four);
  }
}

/* Two runs, each constant: all correlation is within the runs, and the blocks at their junction are no pair. */
static void runs_apart(void **state)
{
  (void)state;
  gg_jackknife j;
  assert_int_equal(gg_statistics_jackknife_init(&j, 1, NULL), GG_OK);
  for (int run = 0; run < 3; run++) {
    gg_statistics_jackknife_cut(&j);
    for (int b = 0; b < 8; b++) *gg_statistics_jackknife_next(&j) = run - 1, gg_statistics_jackknife_add(&j);
  }
  assert_int_equal(j.blocks, 24);
  assert_int_equal(j.pairs, 21);
  gg_statistics_jackknife_clear(&j);
}

/* One block has no scatter: its error is NaN. */
static void too_few(void **state)
{
  (void)state;
  gg_jackknife j;
  double error;
  assert_int_equal(gg_statistics_jackknife_init(&j, 1, NULL), GG_OK);
  *gg_statistics_jackknife_next(&j) = 1;
  gg_statistics_jackknife_add(&j);
  gg_statistics_jackknife_errors(&j, 0, 1, 0, NAN, &error);
  assert_true(isnan(error));
  gg_statistics_jackknife_clear(&j);
}

int main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test(textbook_error), cmocka_unit_test(correlated_blocks),
                                     cmocka_unit_test(beside_a_curve), cmocka_unit_test(slow_mode_in_noise),
                                     cmocka_unit_test(runs_apart),     cmocka_unit_test(too_few)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
