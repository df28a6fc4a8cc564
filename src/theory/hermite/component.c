/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "theory/hermite/component.h"

#include <math.h>
#include <string.h>

#include "measure/histogram.h"

static double factorial(int n)
{
  double product = 1;
  for (int i = 2; i <= n; i++) product *= i;
  return product;
}

/* Ho_k(e*c) = sum_{|r| = k} sqrt(k!/r!) e^r Ho_r(c) for a unit vector e; here C_axis = s (e*c). */
gg_hermite_component gg_hermite_component_of(const gg_hermite_basis *b, const gg_hermite_state *state, int axis)
{
  gg_hermite_component m = {.degree = b->degree};
  const double *row = state->L[axis];
  double s = sqrt(row[0] * row[0] + row[1] * row[1] + row[2] * row[2]);
  for (int i = 0; i < b->n; i++) {
    const int *r = b->function[i].r;
    int k = r[0] + r[1] + r[2];
    double weight = sqrt(factorial(k) / (factorial(r[0]) * factorial(r[1]) * factorial(r[2])));
    for (int j = 0; j < 3; j++) weight *= pow(row[j] / s, r[j]);
    m.t[k] += state->a[i] * weight;
  }
  return m;
}

double gg_hermite_component_moment(const gg_hermite_component *m, int order)
{
  /* c^n in normalised Hermite polynomials. */
  const double *t = m->t;
  switch (order) {
  case 0: return 1;
  case 1: return t[1];
  case 2: return M_SQRT2 * t[2] + 1;
  case 3: return sqrt(6) * t[3] + 3 * t[1];
  case 4: return sqrt(24) * t[4] + 6 * M_SQRT2 * t[2] + 3;
  case 5: return sqrt(120) * t[5] + 10 * sqrt(6) * t[3] + 15 * t[1];
  case 6: return sqrt(720) * t[6] + 15 * sqrt(24) * t[4] + 45 * M_SQRT2 * t[2] + 15;
  default: return NAN;
  }
}

/* Gauss-Legendre, enough for bins of a tenth. */
enum { POINTS = 4 };
static const double node[POINTS] = {-0.86113631159405258, -0.33998104358485626, 0.33998104358485626,
                                    0.86113631159405258};
static const double weight[POINTS] = {0.34785484513745386, 0.65214515486254614, 0.65214515486254614,
                                      0.34785484513745386};

typedef double density(const gg_hermite_component *m, double c);

static double integral(const gg_hermite_component *m, density *f, double from, double to)
{
  double sum = 0, half = (to - from) / 2, middle = (to + from) / 2;
  for (int i = 0; i < POINTS; i++) sum += weight[i] * f(m, middle + half * node[i]);
  return sum * half;
}

static double component(const gg_hermite_component *m, double c)
{
  double value[GG_HERMITE_MOST_DEGREE + 1], sum = 0;
  gg_hermite_values(m->degree, c, value);
  for (int k = 0; k <= m->degree; k++) sum += m->t[k] * value[k];
  return sum * exp(-c * c / 2) / sqrt(2 * M_PI);
}

/* F(c) = -2 c dP/dc of an isotropic distribution, and d(phi He_k)/dc = -phi He_{k+1}. */
static double speed(const gg_hermite_component *m, double c)
{
  double value[GG_HERMITE_MOST_DEGREE + 2], sum = 0;
  gg_hermite_values(m->degree + 1, c, value);
  for (int k = 0; k <= m->degree; k++) sum += m->t[k] * sqrt(k + 1) * value[k + 1];
  return 2 * c * sum * exp(-c * c / 2) / sqrt(2 * M_PI);
}

void gg_hermite_component_histogram(const gg_hermite_component *m, double *bin)
{
  double moment[5], mean = gg_hermite_component_moment(m, 1);
  for (int k = 0; k < 5; k++) moment[k] = gg_hermite_component_moment(m, k);
  double square = moment[2] - mean * mean, sigma = sqrt(square);
  double cube = moment[3] - 3 * mean * moment[2] + 2 * mean * mean * mean;
  double fourth = moment[4] - 4 * mean * moment[3] + 6 * mean * mean * moment[2] - 3 * pow(mean, 4);
  for (int k = 0; k < GG_HISTOGRAM_BINS; k++) {
    double x = (k - GG_HISTOGRAM_HALF) * GG_HISTOGRAM_WIDTH, half = GG_HISTOGRAM_WIDTH / 2;
    bin[k] = integral(m, component, mean + (x - half) * sigma, mean + (x + half) * sigma);
  }
  bin[GG_HISTOGRAM_GRAINS] = bin[GG_HISTOGRAM_SQUARES] = 1;
  bin[GG_HISTOGRAM_CUBES] = cube / (square * sigma);
  bin[GG_HISTOGRAM_FOURTHS] = fourth / (square * square);
}

/* x^2 = C^2/(2 sigma^2); <C^4> = 5 <C_x^4>, <C^6> = 7 <C_x^6>. */
void gg_hermite_component_speeds(const gg_hermite_component *m, gg_sonine_sums *s)
{
  double square = gg_hermite_component_moment(m, 2), unit = sqrt(2 * square);
  for (int i = 0; i < GG_SONINE_BINS; i++)
    s->share[i] = integral(m, speed, i * GG_SONINE_WIDTH * unit, (i + 1) * GG_SONINE_WIDTH * unit);
  s->fourth = 5 * gg_hermite_component_moment(m, 4) / (4 * square * square);
  s->sixth = 7 * gg_hermite_component_moment(m, 6) / (8 * square * square * square);
}
