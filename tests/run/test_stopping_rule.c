/* Proves: where a run stops by its errors, on series whose true mean and correlation time are known, the mean square of
 * deviations over stated errors is 1 (before the estimate's own doubt and its being picked were allowed for: 1.2), for
 * errors that take 40, 80 and 160 correlation times; and such a run is not much longer than that takes. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>
#include <math.h>

#include "common/rng.h"
#include "run/replicas.h"

enum { RUNS = 1000, T = 4, LONGEST = 160, MOST = 16 * LONGEST * T };
static double x[MOST];

static void autoregressive(gg_rng *r)
{
  double rho = (2.0 * T - 1) / (2 * T + 1), at = gg_common_rng_normal(r);
  for (size_t i = 0; i < MOST; i++) x[i] = at = rho * at + sqrt(1 - rho * rho) * gg_common_rng_normal(r);
}

/* As averaging.c goes from test to test; returns the length of the window at the end. */
static uint64_t stop(const gg_stopping_criteria *criteria, gg_mean *m)
{
  bool before = false;
  for (uint64_t window = gg_run_criteria_next_test(criteria, 0, NULL);;) {
    assert_true(window <= MOST);
    assert_int_equal(gg_statistics_estimate_scalar(x, window, 1, m, NULL), GG_OK);
    m->error *= gg_run_criteria_margin(criteria, m->correlation_rows, (double)window);
    gg_window_test t = {.window = window, .ratio = m->error / criteria->relative_error};
    t.exact = m->trusted && t.ratio <= 1;
    t.sure = m->trusted && (double)window >= 10 * GG_MAX_BLOCKS * m->correlation_rows;
    if (gg_run_criteria_are_met(&t, before)) return window;
    before = t.exact;
    window = gg_run_criteria_next_test(criteria, 0, &t);
  }
}

static void errors_at_the_end(void **state)
{
  (void)state;
  double all = 0;
  for (int need = 40; need <= LONGEST; need *= 2) {
    gg_stopping_criteria criteria = {.least = 150, .longest = 75000, .relative_error = sqrt(2.0 / need)};
    gg_rng r = gg_common_rng_seed(21, (uint64_t)need);
    double z2 = 0, length = 0;
    for (int k = 0; k < RUNS; k++) {
      gg_mean m;
      autoregressive(&r);
      length += (double)stop(&criteria, &m) / (need * T * RUNS);
      z2 += m.mean * m.mean / (m.error * m.error) / RUNS;
    }
    print_message("# %d correlation times needed: z^2 %.3f, %.2f times as long\n", need, z2, length);
    assert_true(need < 80 || length < 2.6);
    all += z2 / 3;
  }
  assert_true(fabs(all - 1) < 0.05 + 4 * sqrt(2.0 / (3 * RUNS)));
}

int main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test(errors_at_the_end)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
