/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Errors of curves: equal to the textbook error of a mean, right for a ratio and for correlated blocks; replicas are
 * pooled. */
#include "curve_test.h"

enum { WIDTH = 3 };

static void plain(const void *self, const double *mean, gg_curves *list)
{
  (void)self;
  gg_curve *c = gg_measure_curve_add(list, WIDTH, "mean", "p", "m");
  for (int i = 0; i < (int)c->n; i++) c->x[i] = i, c->value[i] = mean[i];
  gg_measure_curve_put_number(c, "ratio", mean[0] / mean[1], "1");
}

static void plain_means(const void *self, const double *mean, gg_curves *list)
{
  (void)self;
  gg_curve *c = gg_measure_curve_add(list, WIDTH, "mean", "p", "m");
  for (int i = 0; i < (int)c->n; i++) c->x[i] = i, c->value[i] = mean[i];
}

static void add(gg_bins *b, gg_rng *r)
{
  double *bin = gg_statistics_bins_sample(b), common = 0.3 * gg_common_rng_normal(r);
  bin[0] += 6 * (1 + common) + 0.1 * gg_common_rng_normal(r);
  bin[1] += 3 * (1 + common);
  bin[2] += 1;
  gg_statistics_bins_commit(b);
}

/* Alternating blocks: neighbours differ, and need no allowance for correlation. */
static void add_alternating(gg_bins *b, gg_rng *r, int block)
{
  double *bin = gg_statistics_bins_sample(b), sign = block % 2 ? 1 : -1;
  for (int k = 0; k < WIDTH - 1; k++) bin[k] += 6 + sign * (1 + 0.1 * gg_rng_uniform(r));
  bin[2] += 1;
  gg_statistics_bins_commit(b);
}

/* The jackknife of a mean is the scatter of its blocks over sqrt(n), times the factor for n numbers; two replicas pool.
 */
static void error_of_a_mean(void **state)
{
  (void)state;
  gg_bins b[2];
  gg_rng r = gg_common_rng_seed(5, 0);
  for (int k = 0; k < 2; k++) {
    assert_int_equal(gg_statistics_bins_init(&b[k], WIDTH, NULL), GG_OK);
    for (int i = 0; i < 20 * 16; i++) add_alternating(&b[k], &r, i / 16);
  }
  const gg_bins *list[] = {&b[0], &b[1]};
  gg_curves curves = {0};
  assert_int_equal(gg_measure_curves_estimate(list, 2, plain, NULL, "test", 0, &curves, NULL), GG_OK);
  double sum = 0, squares = 0, n = (double)(2 * b[0].blocks);
  for (int k = 0; k < 2; k++)
    for (size_t i = 0; i < b[k].blocks; i++) {
      double x = gg_bins_block(&b[k], i)[0] / (double)b[k].per_block;
      sum += x, squares += x * x;
    }
  double mean = sum / n, x = 1 / (n - 1), error = sqrt((squares / n - mean * mean) / (n - 1)) * (1 + x + 1.5 * x * x);
  const gg_curve *c = ct_find(&curves, "mean");
  assert_true(fabs(c->value[0] - mean) < 1e-12 && fabs(c->error[0] / error - 1) < 1e-9);
  assert_true(c->value[2] == 1 && c->error[2] == 0);
  assert_int_equal(c->samples, (uint64_t)n * b[0].per_block);
  gg_measure_curves_clear(&curves);
  for (int k = 0; k < 2; k++) gg_statistics_bins_clear(&b[k]);
}

/* A ratio of two bins with common fluctuations: over 300 repeats its deviation in units of its error has the
 * variance 1 (scatter 0.1), and the common fluctuation cancels. */
static void honest_ratio(void **state)
{
  (void)state;
  gg_rng r = gg_common_rng_seed(6, 0);
  double sum = 0;
  for (int k = 0; k < 300; k++) {
    gg_bins b;
    assert_int_equal(gg_statistics_bins_init(&b, WIDTH, NULL), GG_OK);
    for (int i = 0; i < 20 * 8; i++) add(&b, &r);
    const gg_bins *list[] = {&b};
    gg_curves curves = {0};
    assert_int_equal(gg_measure_curves_estimate(list, 1, plain, NULL, "test", 0, &curves, NULL), GG_OK);
    gg_curve_number ratio = ct_number(&curves.curve[0], "ratio");
    assert_true(ratio.error < 0.0064); /* 0.1/3/sqrt(160) = 0.0026; the common part alone: 0.05 */
    sum += pow((ratio.value - 2) / ratio.error, 2);
    gg_measure_curves_clear(&curves);
    gg_statistics_bins_clear(&b);
  }
  print_message("# variance of the reduced deviation: %.3f\n", sum / 300);
  assert_true(sum / 300 > 0.7 && sum / 300 < 1.6);
}

/* Samples with a memory of `memory` samples (x' = exp(-1/memory) x + noise), in blocks of 16: over many repeats the
 * deviation of a mean in units of its error has the variance 1, or little more, even if a block is shorter than the
 * integrated correlation time, 2 memory; the scatter of blocks alone is wrong by a factor of two there. Without
 * memory the allowance adds next to nothing. */
static void honest_mean(void **state)
{
  (void)state;
  const double memory[] = {0.05, 2, 5, 10}, most[] = {1.25, 1.25, 1.4, 1.4};
  for (int m = 0; m < 4; m++) {
    gg_rng r = gg_common_rng_seed(16, (uint64_t)m);
    double keep = exp(-1 / memory[m]), sum = 0, plain = 0, n = 0;
    for (int k = 0; k < 400; k++) {
      gg_bins b;
      double x[WIDTH];
      assert_int_equal(gg_statistics_bins_init(&b, WIDTH, NULL), GG_OK);
      for (int a = 0; a < WIDTH; a++) x[a] = gg_common_rng_normal(&r);
      for (int i = 0; i < 24 * 16; i++) {
        double *bin = gg_statistics_bins_sample(&b);
        for (int a = 0; a < WIDTH; a++) {
          bin[a] += 5 + x[a];
          x[a] = keep * x[a] + sqrt(1 - keep * keep) * gg_common_rng_normal(&r);
        }
        gg_statistics_bins_commit(&b);
      }
      const gg_bins *list[] = {&b};
      gg_curves curves = {0};
      assert_int_equal(gg_measure_curves_estimate(list, 1, plain_means, NULL, "test", 0, &curves, NULL), GG_OK);
      const gg_curve *c = &curves.curve[0];
      for (int a = 0; a < WIDTH; a++) {
        double squares = 0, blocks = (double)b.blocks;
        for (size_t i = 0; i < b.blocks; i++)
          squares += pow(gg_bins_block(&b, i)[a] / (double)b.per_block - c->value[a], 2);
        sum += pow((c->value[a] - 5) / c->error[a], 2), n++;
        plain += pow(c->value[a] - 5, 2) / (squares / (blocks * (blocks - 1)));
      }
      gg_measure_curves_clear(&curves);
      gg_statistics_bins_clear(&b);
    }
    print_message("# memory %4.2f: variance of the reduced deviation %.3f, of blocks alone %.3f\n", memory[m], sum / n,
                  plain / n);
    assert_true(sum / n > 0.75 && sum / n < most[m]);
    if (m == 3) assert_true(plain / n > 1.3 * sum / n);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(error_of_a_mean),
      cmocka_unit_test(honest_ratio),
      cmocka_unit_test(honest_mean),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
