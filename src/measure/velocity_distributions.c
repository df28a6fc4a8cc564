/* Distributions of the components of C and Omega, by species, about their mean and in units of their standard deviation
 * at each instant (so that a cooling gas has a steady one, too), scaled to P(0) = 1; their tails as stretched
 * exponentials; their deviation from a Gaussian at low velocity. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "measure/observable.h"
#include "measure/tail.h"

enum {
  HALF = 80,
  BINS = 2 * HALF + 1,
  GRAINS = BINS,
  CUBES,
  FOURTHS,
  SET,
  LOW = 20
}; /* bin k is centred on k WIDTH, |k| <= HALF; |k| <= LOW: head */
#define WIDTH 0.1
#define TAIL_FROM 2.0
enum { LEAST_COUNT = 25 }; /* in the last bin that a tail is fitted to */

typedef struct distributions {
  int species, vectors; /* vectors: C, and Omega if there are spins */
} distributions;

static const char *refuses(const gg_model *m)
{
  return gg_flow_is_walled(m->flow) ? "between walls velocities depend on the place; measure profiles" : NULL;
}

static void *create(const gg_model *m, gg_error *err)
{
  distributions *d = gg_new_array(1, sizeof *d, err);
  if (d) *d = (distributions){m->n_species, m->rule == GG_SMOOTH ? 1 : 2};
  return d;
}

static size_t bins(const void *self)
{
  const distributions *d = self;
  return (size_t)(d->species * d->vectors * 3) * SET;
}

typedef struct scale {
  double mean, sigma;
} scale;

static scale scale_of(const gg_snapshot *s, const double *x, int species)
{
  double n = 0, sum = 0, squares = 0;
  for (size_t i = 0; i < s->n; i++) {
    double one = gg_snapshot_species(s, i) == species;
    n += one, sum += one * x[i], squares += one * x[i] * x[i];
  }
  return (scale){sum / n, sqrt(squares / n - sum / n * (sum / n))};
}

static void count(const gg_snapshot *s, const double *x, int species, double *bin)
{
  scale u = scale_of(s, x, species);
  double inverse = 1 / u.sigma, grains = 0, cubes = 0, fourths = 0;
  for (size_t i = 0; i < s->n; i++) {
    double z = (x[i] - u.mean) * inverse, at = z * (1 / WIDTH) + (HALF + 0.5);
    if (gg_snapshot_species(s, i) != species) continue;
    grains++, cubes += z * z * z, fourths += z * z * z * z;
    if (at >= 0 && at < BINS) bin[(int)at]++;
  }
  bin[GRAINS] += grains, bin[CUBES] += cubes, bin[FOURTHS] += fourths;
}

static void look(void *self, const gg_snapshot *s, double *bin)
{
  const distributions *d = self;
  for (int species = 0; species < d->species; species++)
    for (int vector = 0; vector < d->vectors; vector++)
      for (int a = 0; a < 3; a++, bin += SET) count(s, vector ? s->s[a] : s->c[a], species, bin);
}

/* Counts at x = 0: counts over a Gaussian's in the bins |x| < 1/2 by least squares as A + B x^2, taken at x = 0. */
static double height(const double *bin)
{
  double n = 0, x2 = 0, x4 = 0, y = 0, x2y = 0;
  for (int k = -4; k <= 4; k++) {
    double xx = k * k * WIDTH * WIDTH, ratio = bin[HALF + k] * exp(xx / 2);
    n++, x2 += xx, x4 += xx * xx, y += ratio, x2y += xx * ratio;
  }
  return (y * x4 - x2 * x2y) / (n * x4 - x2 * x2);
}

static void put_tail(gg_curve *c, const double *bin, double samples)
{
  double folded[HALF];
  const int from = (int)(TAIL_FROM / WIDTH);
  int n = 0;
  for (; from + n < HALF; n++) {
    folded[n] = (bin[HALF - from - n] + bin[HALF + from + n]) * samples;
    if (folded[n] < LEAST_COUNT) break;
  }
  gg_tail_data data = {folded, (size_t)n, TAIL_FROM - WIDTH / 2, WIDTH, 2 * height(bin) * samples};
  gg_tail least = gg_tail_double_log(&data), likely = gg_tail_likelihood(&data);
  gg_curve_put_number(c, "alpha", least.alpha, "1");
  gg_curve_put_number(c, "gamma", least.gamma, "1");
  gg_curve_put_number(c, "alpha_likelihood", likely.alpha, "1");
  gg_curve_put_number(c, "gamma_likelihood", likely.gamma, "1");
  gg_curve_put_number(c, "fit_from", data.first, "1");
  gg_curve_put_number(c, "fit_to", data.first + n * WIDTH, "1");
}

/* "C_x", "C_{x,2}": how gnuplot writes it; and "Cx", "Cx_2" for names. */
typedef struct naming {
  char plain[16], label[24], argument[24];
} naming;

static naming name_of(const distributions *d, int species, int vector, int a)
{
  naming n;
  const char *what = vector ? "W" : "C", *greek = vector ? "Ω" : "C";
  if (d->species > 1) {
    snprintf(n.plain, sizeof n.plain, "%s%c_%d", what, "xyz"[a], species + 1);
    snprintf(n.label, sizeof n.label, "%s_{%c,%d}", greek, "xyz"[a], species + 1);
  } else {
    snprintf(n.plain, sizeof n.plain, "%s%c", what, "xyz"[a]);
    snprintf(n.label, sizeof n.label, "%s_%c", greek, "xyz"[a]);
  }
  snprintf(n.argument, sizeof n.argument, "%s/σ", greek);
  return n;
}

static void put_distribution(gg_curves *list, const naming *n, int vector, const double *bin)
{
  char name[48];
  double zero = height(bin);
  snprintf(name, sizeof name, "velocity_distribution_%s", n->plain);
  gg_curve *c = gg_curve_add(list, BINS, name, vector ? "distribution of Ω" : "distribution of C", n->label);
  gg_curve_axes(c, n->argument, "1", "P/P(0)", "1");
  c->log_y = true;
  for (int i = 0; i < (int)c->n; i++) c->x[i] = (i - HALF) * WIDTH, c->value[i] = bin[i] / zero;
  put_tail(c, bin, (double)list->samples);
  gg_curve_put_number(c, "kurtosis", bin[FOURTHS] / bin[GRAINS], "1");
  gg_curve_put_number(c, "skewness", bin[CUBES] / bin[GRAINS], "1");
}

static void put_deviation(gg_curves *list, const naming *n, int vector, const double *bin)
{
  char name[48];
  double zero = height(bin);
  snprintf(name, sizeof name, "velocity_deviation_%s", n->plain);
  gg_curve *c = gg_curve_add(list, 2 * LOW + 1, name,
                             vector ? "Ω: deviation from a Gaussian" : "C: deviation from a Gaussian", n->label);
  gg_curve_axes(c, n->argument, "1", "P/P(0) - exp(-x^2/2)", "1");
  for (int i = 0; i < (int)c->n; i++) {
    double x = (i - LOW) * WIDTH;
    c->x[i] = x, c->value[i] = bin[HALF - LOW + i] / zero - exp(-x * x / 2);
  }
}

static void curves(const void *self, const double *bin, gg_curves *list)
{
  const distributions *d = self;
  for (int species = 0; species < d->species; species++)
    for (int vector = 0; vector < d->vectors; vector++)
      for (int a = 0; a < 3; a++, bin += SET) {
        naming n = name_of(d, species, vector, a);
        put_distribution(list, &n, vector, bin);
        put_deviation(list, &n, vector, bin);
      }
}

const gg_observable gg_velocity_distributions = {
    .name = "velocity_distributions",
    .doc = "distributions of the components of C and Omega, their tails and heads",
    .create = create,
    .destroy = free,
    .flag = GG_MEASURE_VELOCITY_DISTRIBUTIONS,
    .refuses = refuses,
    .bins = bins,
    .every = 2,
    .look = look,
    .curves = curves,
};
