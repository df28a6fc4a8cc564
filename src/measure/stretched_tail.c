/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "measure/stretched_tail.h"

#include <math.h>
#include <stdio.h>

static const gg_stretched_tail nothing = {NAN, NAN};

gg_stretched_tail gg_measure_stretched_tail_double_log(const gg_stretched_tail_data *d)
{
  double w = 0, x = 0, y = 0, xx = 0, xy = 0;
  int used = 0;
  for (size_t i = 0; i < d->n; i++) {
    double P = d->counts[i] / d->at_zero;
    if (!(P > 0 && P < 1)) continue;
    double log_P = log(P), u = log(d->first + ((double)i + 0.5) * d->width), v = log(-log_P);
    double weight = d->counts[i] * log_P * log_P; /* 1/var of v: var(P)/P^2 = 1/counts */
    w += weight, x += weight * u, y += weight * v, xx += weight * u * u, xy += weight * u * v;
    used++;
  }
  if (used < 4) return nothing;
  double slope = (w * xy - x * y) / (w * xx - x * x);
  return (gg_stretched_tail){slope, exp((y - slope * x) / w)};
}

/* The expected count of a bin by Simpson's rule, and its derivatives in a = ln gamma and in alpha. */
typedef struct expected {
  double value, by_a, by_alpha;
} expected;

static expected expect(const gg_stretched_tail_data *d, double a, double alpha, size_t i)
{
  static const double weight[] = {1.0 / 6, 4.0 / 6, 1.0 / 6};
  expected e = {0, 0, 0};
  for (int k = 0; k < 3; k++) {
    double x = d->first + ((double)i + 0.5 * k) * d->width;
    double u = exp(a + alpha * log(x)), f = d->at_zero * weight[k] * exp(-u);
    e.value += f;
    e.by_a -= f * u;
    e.by_alpha -= f * u * log(x);
  }
  return e;
}

static double log_likelihood(const gg_stretched_tail_data *d, double a, double alpha)
{
  double sum = 0;
  for (size_t i = 0; i < d->n; i++) {
    double e = expect(d, a, alpha, i).value;
    sum += d->counts[i] * log(e) - e;
  }
  return sum;
}

/* Fisher scoring from the least-squares line: Newton's step with the expected curvature, halved until the likelihood
 * grows. */
gg_stretched_tail gg_measure_stretched_tail_likelihood(const gg_stretched_tail_data *d)
{
  gg_stretched_tail start = gg_measure_stretched_tail_double_log(d);
  double a = log(start.gamma), alpha = start.alpha;
  if (!isfinite(a) || !isfinite(alpha)) return nothing;
  for (int round = 0; round < 100; round++) {
    double ga = 0, gb = 0, aa = 0, ab = 0, bb = 0;
    for (size_t i = 0; i < d->n; i++) {
      expected e = expect(d, a, alpha, i);
      if (!(e.value > 0)) continue;
      double excess = d->counts[i] / e.value - 1;
      ga += excess * e.by_a, gb += excess * e.by_alpha;
      aa += e.by_a * e.by_a / e.value, ab += e.by_a * e.by_alpha / e.value, bb += e.by_alpha * e.by_alpha / e.value;
    }
    double det = aa * bb - ab * ab, da = (bb * ga - ab * gb) / det, db = (aa * gb - ab * ga) / det;
    if (!isfinite(da) || !isfinite(db)) return nothing;
    double now = log_likelihood(d, a, alpha), share = 1;
    while (share > 1e-6 && !(log_likelihood(d, a + share * da, alpha + share * db) >= now)) share /= 2;
    a += share * da, alpha += share * db;
    if (fabs(share * da) + fabs(share * db) < 1e-11) break;
  }
  return (gg_stretched_tail){alpha, exp(a)};
}

const double gg_measure_stretched_tail_range[GG_TAIL_RANGES][2] = {{2, 4.5}, {3.3, 5.5}};

void gg_measure_stretched_tail_name(char *name, size_t size, const char *number, const double range[2])
{
  const char *of = range[0] == gg_measure_stretched_tail_range[0][0]
                       ? "2_4.5"
                       : "3.3_5.5"; /* independent of the locale's decimal point */
  snprintf(name, size, "%s_%s", number, of);
}
