/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Distributions of the components of C and Omega, by species, about their mean and in units of their standard deviation
 * at each instant (so that a cooling gas has a steady one, too), scaled to P(0) = 1; their tails as stretched
 * exponentials; their deviation from a Gaussian at low velocity. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/memory.h"
#include "measure/observable.h"
#include "measure/velocity_distributions.h"

enum { LOW = 20 }; /* bins |k| <= LOW about 0: the head */

/* "C_x", "C_{x,2}" for gnuplot; and "Cx", "Cx_2" for names. */
typedef struct naming {
  char plain[16], label[24], argument[24];
} naming;

static naming name_of(gg_velocity_component c)
{
  naming n;
  const char *what = c.spin ? "W" : "C", *greek = c.spin ? "Ω" : "C";
  if (c.n_species > 1) {
    snprintf(n.plain, sizeof n.plain, "%s%c_%d", what, "xyz"[c.axis], c.species + 1);
    snprintf(n.label, sizeof n.label, "%s_{%c,%d}", greek, "xyz"[c.axis], c.species + 1);
  } else {
    snprintf(n.plain, sizeof n.plain, "%s%c", what, "xyz"[c.axis]);
    snprintf(n.label, sizeof n.label, "%s_%c", greek, "xyz"[c.axis]);
  }
  snprintf(n.argument, sizeof n.argument, "%s/σ", greek);
  return n;
}

static void put_distribution(gg_curves *list, const naming *n, bool spin, const double *bin, double samples)
{
  char name[48];
  snprintf(name, sizeof name, "velocity_distribution_%s", n->plain);
  gg_curve *c =
      gg_measure_histogram_put(list, name, spin ? "distribution of Ω" : "distribution of C", n->label, bin, 1, samples);
  gg_measure_curve_axes(c, n->argument, "1", "P/P(0)", "1");
}

static void put_deviation(gg_curves *list, const naming *n, bool spin, const double *bin)
{
  char name[48];
  double zero = gg_measure_histogram_height(bin, 1);
  snprintf(name, sizeof name, "velocity_deviation_%s", n->plain);
  gg_curve *c = gg_measure_curve_add(list, 2 * LOW + 1, name,
                                     spin ? "Ω: deviation from a Gaussian" : "C: deviation from a Gaussian", n->label);
  gg_measure_curve_axes(c, n->argument, "1", "P/P(0) - exp(-x^2/2)", "1");
  for (int i = 0; i < (int)c->n; i++) {
    double x = (i - LOW) * GG_HISTOGRAM_WIDTH;
    c->x[i] = x, c->value[i] = bin[GG_HISTOGRAM_HALF - LOW + i] / zero - exp(-x * x / 2);
  }
  gg_measure_curve_beside(c, "Gaussian", gg_measure_curve_level, &(double){0});
}

void gg_measure_velocity_curves_put(gg_curves *list, gg_velocity_component which, const double *bin, double samples)
{
  naming n = name_of(which);
  put_distribution(list, &n, which.spin, bin, samples);
  put_deviation(list, &n, which.spin, bin);
}

typedef struct distributions {
  int species, vectors; /* vectors: C, and Omega if there are spins */
  double *scratch;      /* scratch for the grains of one of several species; NULL for one */
} distributions;

static void destroy(void *self)
{
  free(((distributions *)self)->scratch);
  free(self);
}

static void *create(const gg_model *m, gg_error *err)
{
  distributions *d = gg_base_array_new(1, sizeof *d, err);
  if (!d) return NULL;
  *d = (distributions){m->n_species, m->rule == GG_SMOOTH ? 1 : 2, NULL};
  if (m->n_species == 1 || (d->scratch = gg_base_array_new((size_t)m->n, sizeof(double), err))) return d;
  free(d);
  return NULL;
}

static size_t bins(const void *self)
{
  const distributions *d = self;
  return (size_t)(d->species * d->vectors * 3) * GG_HISTOGRAM;
}

/* The values of one species: in place if it is the only one, else gathered. */
static size_t values_of(const distributions *d, const gg_snapshot *s, const double *x, int species,
                        const double **values)
{
  size_t n = 0;
  *values = x;
  if (d->species == 1) return s->n;
  for (size_t i = 0; i < s->n; i++) {
    d->scratch[n] = x[i];
    n += s->species[i] == species;
  }
  *values = d->scratch;
  return n;
}

static void count(const distributions *d, const gg_snapshot *s, const double *x, int species, double *bin)
{
  const double *values;
  size_t n = values_of(d, s, x, species, &values);
  gg_scale_of u = gg_measure_scale_of_values(values, n);
  gg_measure_histogram_add_all(bin, values, n, u.mean, u.sigma);
}

static void add_snapshot(void *self, const gg_snapshot *s, double *bin)
{
  const distributions *d = self;
  for (int species = 0; species < d->species; species++)
    for (int vector = 0; vector < d->vectors; vector++)
      for (int a = 0; a < 3; a++, bin += GG_HISTOGRAM) count(d, s, vector ? s->s[a] : s->c[a], species, bin);
}

static void curves(const void *self, const double *bin, gg_curves *list)
{
  const distributions *d = self;
  for (int species = 0; species < d->species; species++)
    for (int vector = 0; vector < d->vectors; vector++)
      for (int a = 0; a < 3; a++, bin += GG_HISTOGRAM)
        gg_measure_velocity_curves_put(list, (gg_velocity_component){d->species, species, vector, a}, bin,
                                       (double)list->samples);
}

const gg_observable gg_measure_velocity_distributions = {
    GG_OBSERVABLE(VELOCITY_DISTRIBUTIONS, velocity_distributions),
    .create = create,
    .destroy = destroy,
    .refuses = gg_measure_needs_homogeneity,
    .curves =
        &(const gg_observable_curves){
            .bins = bins, .every = 2, .framed = true, .add_snapshot = add_snapshot, .of_bins = curves},
    .cost = {.ns = {10, 6}},
};
