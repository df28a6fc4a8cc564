/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Numbers that begin a trajectory, the same on every processor and from every C library. These compute square roots and
 * fused products alike, to the last bit, but not exponentials, logarithms and other roots. */
#ifndef GG_AGREED_H
#define GG_AGREED_H

#include <math.h>

/* A number from the library's functions, or solved for with them, rounded to its first bits (Veltkamp 1968), on which
 * all agree: two that differ by a share s of themselves do so in one of 1/(s 2^bits) cases still. */
enum { GG_AGREED_FUNCTION = 32, GG_AGREED_SOLUTION = 16 };
static inline double gg_agreed(double x, int bits)
{
  const double c = x * (ldexp(1, 53 - bits) + 1);
  return c - (c - x);
}

/* x^n for whole n >= 0, as a sum of two numbers: the product is carried on with what its rounding leaves. */
static inline double gg_power_and_rest(double x, int n, double *rest)
{
  double product = 1;
  *rest = 0;
  for (int k = 0; k < n; k++) {
    const double next = product * x, left = fma(product, x, -next) + *rest * x;
    product = next + left;
    *rest = left - (product - next);
  }
  return product;
}

/* The same, rounded once. */
static inline double gg_power(double x, int n)
{
  double rest;
  return gg_power_and_rest(x, n, &rest);
}

/* e^x for moderate x: Taylor's series of a small part of it, squared again and again. */
static inline double gg_exponential(double x)
{
  int halves = 0;
  while (fabs(x) > 0.06 && halves < 60) x /= 2, halves++;
  double sum = 1;
  for (int k = 9; k > 0; k--) sum = 1 + sum * x / k;
  while (halves-- > 0) sum *= sum;
  return sum;
}

/* The n-th root of x > 0: one step of Newton from the library's, with what x - y^n leaves. */
static inline double gg_root(double x, int n)
{
  double y = pow(x, 1. / n), rest, product = gg_power_and_rest(y, n, &rest);
  return y + (x - product - rest) / (n * (product / y));
}

#endif
