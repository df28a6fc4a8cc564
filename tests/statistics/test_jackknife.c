/* The jackknife over blocks whose scatter and correlation are known. */
#include "planted.h"
#include "statistics/jackknife.h"

enum { BLOCKS = 24 };

/* Leave out each of the blocks x in turn: what that changes in their mean. */
static void add_mean(gg_jackknife *j, const double *x, size_t n)
{
  double sum = 0;
  for (size_t b = 0; b < n; b++) sum += x[b];
  for (size_t b = 0; b < n; b++) {
    *gg_jackknife_next(j) = (sum - x[b]) / (double)(n - 1) - sum / (double)n;
    gg_jackknife_add(j);
  }
}

/* Blocks that alternate allow for no correlation: the error is the textbook one, and the correlation comes out near -1.
 */
static void textbook_error(void **state)
{
  (void)state;
  double x[BLOCKS], error, sum = 0, squares = 0;
  gg_rng r = gg_rng_seed(21, 0);
  gg_jackknife j;
  for (int b = 0; b < BLOCKS; b++) x[b] = (b % 2 ? 1 : -1) * (1 + 0.1 * gg_rng_uniform(&r));
  for (int b = 0; b < BLOCKS; b++) sum += x[b], squares += x[b] * x[b];
  assert_int_equal(gg_jackknife_init(&j, 1, NULL), GG_OK);
  add_mean(&j, x, BLOCKS);
  double correlation = gg_jackknife_errors(&j, 0, 1, &error);
  double textbook = sqrt((squares - sum * sum / BLOCKS) / BLOCKS / (BLOCKS - 1));
  assert_true(fabs(error / textbook - 1) < 1e-12);
  assert_true(correlation < -0.8 && correlation > -1.1);
  gg_jackknife_clear(&j);
}

/* Autoregressive blocks: over many repeats the mean square of the error is the variance of the mean of the blocks,
 * within what the correlation's own uncertainty costs; the scatter alone would be (1 - rho)/(1 + rho) of it. */
static void correlated_blocks(void **state)
{
  (void)state;
  enum { REPEATS = 2000, WIDTH = 9 };
  const double rho = 0.4, n = BLOCKS;
  double exact = ((1 + rho) / (1 - rho) - 2 * rho * (1 - pow(rho, n)) / (n * pow(1 - rho, 2))) / n, sum = 0;
  gg_rng r = gg_rng_seed(22, 0);
  for (int k = 0; k < REPEATS; k++) {
    double x[WIDTH][BLOCKS], mean[WIDTH] = {0}, error[WIDTH];
    gg_jackknife j;
    assert_int_equal(gg_jackknife_init(&j, WIDTH, NULL), GG_OK);
    for (int a = 0; a < WIDTH; a++) planted_autoregressive(&r, rho, x[a], BLOCKS);
    for (int a = 0; a < WIDTH; a++)
      for (int b = 0; b < BLOCKS; b++) mean[a] += x[a][b] / n;
    for (int b = 0; b < BLOCKS; b++) {
      double *d = gg_jackknife_next(&j);
      for (int a = 0; a < WIDTH; a++) d[a] = (mean[a] - x[a][b]) / (n - 1);
      gg_jackknife_add(&j);
    }
    gg_jackknife_errors(&j, 0, WIDTH, error);
    for (int a = 0; a < WIDTH; a++) sum += error[a] * error[a] / (REPEATS * WIDTH);
    gg_jackknife_clear(&j);
  }
  print_message("# error^2 %.3f of the variance of the mean, scatter alone %.3f\n", sum / exact, (1 - rho) / (1 + rho));
  assert_true(sum / exact > 0.85 && sum / exact < 1.25);
}

/* Two runs that each stay where they are: all correlation is within them, and what joins them is no pair. */
static void runs_apart(void **state)
{
  (void)state;
  gg_jackknife j;
  assert_int_equal(gg_jackknife_init(&j, 1, NULL), GG_OK);
  for (int run = 0; run < 3; run++) {
    gg_jackknife_cut(&j);
    for (int b = 0; b < 8; b++) *gg_jackknife_next(&j) = run - 1, gg_jackknife_add(&j);
  }
  assert_int_equal(j.blocks, 24);
  assert_int_equal(j.pairs, 21);
  gg_jackknife_clear(&j);
}

/* One block has no scatter: its error is not a number. */
static void too_few(void **state)
{
  (void)state;
  gg_jackknife j;
  double error;
  assert_int_equal(gg_jackknife_init(&j, 1, NULL), GG_OK);
  *gg_jackknife_next(&j) = 1;
  gg_jackknife_add(&j);
  gg_jackknife_errors(&j, 0, 1, &error);
  assert_true(isnan(error));
  gg_jackknife_clear(&j);
}

int main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test(textbook_error), cmocka_unit_test(correlated_blocks),
                                     cmocka_unit_test(runs_apart), cmocka_unit_test(too_few)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
