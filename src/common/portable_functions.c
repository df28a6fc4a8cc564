/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "common/portable_functions.h"

#include <math.h>
#include <stdbool.h>

#include "common/portable_math.h"

/* ln 2 and pi/2 as sums of two numbers; the first has zeros at its end, so that a small multiple of it is exact. */
static const double ln2[2] = {0x1.62e42fefap-1, 0x1.cf79abc9e3b3ap-40};
static const double half_pi[2] = {0x1.921fb544p+0, 0x1.0b4611a626331p-34};

/* Taylor's series of a rest of at most ln(2)/2, times a power of two. */
double gg_common_portable_exp(double x)
{
  if (isnan(x)) return x;
  if (x > 709.7) return INFINITY;
  if (x < -745) return 0;
  const double k = floor(x / ln2[0] + 0.5), r = (x - k * ln2[0]) - k * ln2[1];
  double sum = 1;
  for (int n = 14; n > 0; n--) sum = 1 + sum * r / n;
  return ldexp(sum, (int)k);
}

/* ln m = 2 artanh((m - 1)/(m + 1)), m from sqrt(1/2) to sqrt(2). */
double gg_common_portable_ln(double x)
{
  int k;
  if (!(x > 0)) return x == 0 ? -INFINITY : NAN;
  if (isinf(x)) return x;
  double m = frexp(x, &k);
  if (m < M_SQRT1_2) m *= 2, k--;
  const double s = (m - 1) / (m + 1), s2 = s * s;
  double sum = 0;
  for (int n = 23; n > 1; n -= 2) sum = (sum + 1. / n) * s2;
  return k * ln2[0] + (2 * s + (2 * s * sum + k * ln2[1]));
}

double gg_common_portable_log10(double x)
{
  return gg_common_portable_ln(x) / gg_common_portable_ln(10);
}

static bool is_odd(double whole)
{
  return fmod(whole, 2) != 0;
}

double gg_common_portable_pow(double a, double b)
{
  const bool whole = b == floor(b);
  if (b == 0 || a == 1) return 1;
  if (isnan(a) || isnan(b) || (a < 0 && !whole)) return NAN;
  if (whole && fabs(b) <= 64) return b > 0 ? gg_power(a, (int)b) : 1 / gg_power(a, (int)-b);
  if (b == 0.5) return sqrt(a);
  const double size = gg_common_portable_exp(b * gg_common_portable_ln(fabs(a)));
  return a < 0 && is_odd(b) ? -size : size;
}

/* sin(x + quarters pi/2). */
static double sine(double x, double quarters)
{
  if (!(fabs(x) < 1e9)) return NAN;
  const double k = floor(x / half_pi[0] + 0.5), r = (x - k * half_pi[0]) - k * half_pi[1], r2 = r * r;
  const double quarter = fmod(fmod(k + quarters, 4) + 4, 4);
  const bool cosine = is_odd(quarter);
  double sum = 1;
  for (int n = cosine ? 20 : 21; n > 1; n -= 2) sum = 1 - sum * r2 / (n * (n - 1));
  if (!cosine) sum *= r;
  return quarter < 2 ? sum : -sum;
}

double gg_common_portable_sin(double x)
{
  return sine(x, 0);
}

double gg_common_portable_cos(double x)
{
  return sine(x, 1);
}

/* The angle halved twice, then its series. */
double gg_common_portable_atan(double x)
{
  if (isnan(x)) return x;
  if (fabs(x) > 1) return copysign(half_pi[0] + half_pi[1], x) - gg_common_portable_atan(1 / x);
  double y = x / (1 + sqrt(1 + x * x));
  y = y / (1 + sqrt(1 + y * y));
  const double y2 = y * y;
  double sum = 0;
  for (int n = 25; n > 1; n -= 2) sum = (1. / n - sum) * y2;
  return 4 * (y - y * sum);
}

/* Near 0 the continued fraction x/(1 + x^2/(3 + x^2/(5 + ...))). */
double gg_common_portable_tanh(double x)
{
  if (isnan(x)) return x;
  if (fabs(x) > 1) return copysign(1 - 2 / (gg_common_portable_exp(2 * fabs(x)) + 1), x);
  double rest = 23;
  for (int n = 21; n > 0; n -= 2) rest = n + x * x / rest;
  return x / rest;
}

/* erf x = 2/sqrt(pi) e^(-x^2) sum_n 2^n x^(2n+1)/(2n+1)!!, a sum of terms of one sign. */
double gg_common_portable_erf(double x)
{
  if (isnan(x)) return x;
  if (fabs(x) > 6) return copysign(1, x);
  double sum = 0, term = x;
  for (int n = 1; n < 160 && term != 0; n++) sum += term, term *= 2 * x * x / (2 * n + 1);
  return 2 / sqrt(M_PI) * gg_common_portable_exp(-x * x) * sum;
}
