/* The test for a trend: silent on stationary noise, and not on a relaxation. */
#include "planted.h"
#include "statistics/trend.h"

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
    planted_autoregressive(&r, 0.8, x, N);
    for (int i = 0; i < N; i++) x[i] += 10;
    assert_int_equal(gg_trend_test(x, N, 1, &d, NULL), GG_OK);
    assert_true(fabs(d.z) < 4);
  }
  int found = 0;
  for (int s = 0; s < 50; s++) {
    planted_autoregressive(&r, 0.8, x, N);
    for (int i = 0; i < N; i++) x[i] += 10 - 2 * exp(-3.0 * i / N);
    assert_int_equal(gg_trend_test(x, N, 1, &d, NULL), GG_OK);
    found += d.z > 4;
  }
  assert_true(found >= 48);
  assert_int_equal(gg_trend_test(x, 10, 1, &d, NULL), GG_OK);
  assert_true(isnan(d.z)); /* ten rows tell nothing */
}

int main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test(trends)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
