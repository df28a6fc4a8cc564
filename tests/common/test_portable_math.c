/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Numbers on which all C libraries agree: roots and powers are rounded as IEEE 754 rounds, against long double, and two
 * answers that differ in their last bits agree in their first ones. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>
#include <float.h>
#include <math.h>

#include "common/portable_math.h"
#include "common/rng.h"

static long double power(long double x, int n)
{
  long double product = 1;
  for (int k = 0; k < n; k++) product *= x;
  return product;
}

/* x lies between the powers of the midpoints to the neighbours; powers of whole numbers give their root. */
static void roots_are_correctly_rounded(void **state)
{
  (void)state;
  const int order[] = {3, 5, 10};
  gg_rng rng = gg_common_rng_seed(1, 0);
  for (int i = 0; i < 100000; i++) {
    const int n = order[i % 3];
    double x = ldexp(1 + gg_rng_uniform(&rng), i % 60 - 30), y = gg_root(x, n);
    long double above = ((long double)y + nextafter(y, INFINITY)) / 2, below = ((long double)y + nextafter(y, 0)) / 2;
    long double slack = 2 * n * LDBL_EPSILON * x; /* of the powers, where a long double is short */
    assert_true(power(below, n) <= x + slack && x - slack <= power(above, n));
    double whole = (double)(1 + gg_rng_below(&rng, n == 3 ? 100000 : n == 5 ? 1000 : 30));
    assert_true(gg_root((double)power(whole, n), n) == whole);
  }
}

/* Half a unit in the last place, where a long double is sure of it; a plain product is off by several. */
static void powers_are_within_half_a_unit(void **state)
{
  (void)state;
  gg_rng rng = gg_common_rng_seed(2, 0);
  int plain_is_off = 0;
  for (int i = 0; i < 100000; i++) {
    const int n = i % 23;
    double x = 0.5 + gg_rng_uniform(&rng), y = gg_power(x, n), plain = 1;
    for (int k = 0; k < n; k++) plain *= x;
    long double exact = power(x, n), unit = nextafter(y, INFINITY) - y;
    assert_true(fabsl(exact - y) <= unit / 2 + n * LDBL_EPSILON * exact);
    plain_is_off += plain != y;
  }
  assert_true(plain_is_off > 50000);
  assert_true(gg_power(3, 0) == 1 && gg_power(0, 2) == 0 && gg_power(-2, 3) == -8);
}

/* The rounded number has this many bits and is the nearest such number. Arguments two units in the last place apart
 * give the same number in all but 2^(bits - 52) of cases. */
static void first_bits(void **state)
{
  (void)state;
  gg_rng rng = gg_common_rng_seed(3, 0);
  int apart = 0;
  for (int i = 0; i < 100000; i++) {
    double x = ldexp(i % 2 ? 1 + gg_rng_uniform(&rng) : -1 - gg_rng_uniform(&rng), i % 80 - 40),
           y = gg_agreed(x, GG_AGREED_FUNCTION);
    int exponent;
    double share = ldexp(frexp(y, &exponent), GG_AGREED_FUNCTION);
    assert_true(share == floor(share));
    assert_true(fabs(x - y) <= ldexp(fabs(x), -GG_AGREED_FUNCTION));
    apart += gg_agreed(nextafter(nextafter(x, 1), 1), GG_AGREED_FUNCTION) != y;
  }
  assert_true(apart <= 1);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(roots_are_correctly_rounded),
      cmocka_unit_test(powers_are_within_half_a_unit),
      cmocka_unit_test(first_bits),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
