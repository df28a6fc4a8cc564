/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Deviation of the distribution of speeds from a Maxwellian: Phi_i/Phi_iM = 1 + (c_i/2) Delta_i(v*), with v* = v/v_0,
 * v_0^2 = 2T (m_1 + m_2)/(m_1 m_2) for mixtures and 2T/m for one species; in the first Sonine approximation Delta_i =
 * x^4/2 - 5 x^2/2 + 15/8, x^2 = m_i v^2/(2 T_i) (Montanero & Garzo, Granular Matter 4 (2002) 17). c_i = 2 a_2 is
 * measured along with it: c_i = (8/15)(<x^4> - 15/4), and the third Sonine
 * coefficient a_3 = 1 + 3 a_2 - (8/105) <x^6> (Brilliantov & Poschel, Europhys. Lett. 74 (2006) 424). Velocities are
 * scaled by T_i at each instant. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/memory.h"
#include "measure/observable.h"
#include "measure/sonine.h"

enum { BINS = GG_SONINE_BINS, FOURTH = BINS, SIXTH, SHARE, SET };

static const double width = GG_SONINE_WIDTH;

/* Integral of 4/sqrt(pi) x^2 exp(-x^2) from 0. */
static double maxwellian_below(double x)
{
  return erf(x) - M_2_SQRTPI * x * exp(-x * x);
}

/* 1/sqrt(lambda_i): v* = x/sqrt(lambda_i), lambda_i = T/(T_i mu_ji); for one species, and for more than two, which
 * have several mu: v* = x. */
static double reduced(const gg_model *m, int k, double temperature_ratio)
{
  if (m->n_species != 2) return 1;
  return sqrt(temperature_ratio * m->mass[1 - k] / (m->mass[0] + m->mass[1]));
}

static double polynomial(double x)
{
  double xx = x * x;
  return xx * xx / 2 - 2.5 * xx + 15.0 / 8;
}

/* First Sonine approximation; parameters: its factor, and the unit of x. */
static double first_sonine(double x, const double *p)
{
  return p[0] * polynomial(x / p[1]);
}

static gg_curve *add(gg_curves *list, const gg_model *m, int k, const char *what, const char *panel, const char *label,
                     const char *y_name)
{
  char name[48], of_species[24];
  snprintf(name, sizeof name, m->n_species > 1 ? "%s_%d" : "%s", what, k + 1);
  snprintf(of_species, sizeof of_species, "species %d", k + 1);
  gg_curve *c = gg_measure_curve_add(list, BINS, name, panel,
                                     label              ? label
                                     : m->n_species > 1 ? of_species
                                                        : "measured");
  gg_measure_curve_axes(c, "v*", "1", y_name, "1");
  return c;
}

void gg_measure_sonine_curves_put(gg_curves *list, const gg_model *m, int k, const gg_sonine_sums *s)
{
  double cumulant = 8.0 / 15 * (s->fourth - 15.0 / 4), a3 = 1 + 1.5 * cumulant - 8.0 / 105 * s->sixth;
  double unit = reduced(m, k, s->temperature_ratio);
  gg_curve *excess = add(list, m, k, "sonine_excess", "excess over a Maxwellian", NULL, "Φ/Φ_M - 1");
  gg_curve *delta = add(list, m, k, "sonine_deviation", "Δ(v*)", NULL, "Δ");
  gg_measure_curve_put_number(excess, "c", cumulant, "1");
  gg_measure_curve_put_number(excess, "a3", a3, "1");
  gg_measure_curve_put_number(delta, "c", cumulant, "1");
  delta->divisor = "c";
  for (size_t i = 0; i < excess->n && i < delta->n; i++) {
    double from = (double)i * width, expected = maxwellian_below(from + width) - maxwellian_below(from);
    excess->x[i] = delta->x[i] = (from + width / 2) * unit;
    excess->value[i] = s->share[i] / expected - 1;
    delta->value[i] = 2 / cumulant * excess->value[i];
  }
  gg_measure_curve_beside(excess, "first Sonine", first_sonine, (const double[]){cumulant / 2, unit});
}

void gg_measure_sonine_polynomial_put(gg_curves *list, const gg_model *m, int k, double temperature_ratio)
{
  char label[32] = "first Sonine";
  if (m->n_species > 1) snprintf(label, sizeof label, "first Sonine, %d", k + 1);
  gg_curve *c = add(list, m, k, "sonine_polynomial", "Δ(v*)", label, "Δ");
  double unit = reduced(m, k, temperature_ratio);
  for (size_t i = 0; i < c->n; i++) {
    double x = ((double)i + 0.5) * width;
    c->x[i] = x * unit, c->value[i] = polynomial(x);
  }
}

typedef struct sonine {
  const gg_model *model;
} sonine;

static const char *refuses(const gg_model *m)
{
  if (m->shear_rate != 0) return "under shear the distribution is not isotropic; see velocity_distributions";
  return gg_measure_needs_homogeneity(m);
}

static void *create(const gg_model *m, gg_error *err)
{
  sonine *d = gg_base_array_new(1, sizeof *d, err);
  if (d) d->model = m;
  return d;
}

static size_t bins(const void *self)
{
  return (size_t)((const sonine *)self)->model->n_species * SET;
}

static double square(const gg_snapshot *s, size_t i)
{
  return s->c[0][i] * s->c[0][i] + s->c[1][i] * s->c[1][i] + s->c[2][i] * s->c[2][i];
}

static void add_snapshot(void *self, const gg_snapshot *s, double *bin)
{
  const gg_model *m = ((const sonine *)self)->model;
  double T[GG_MAX_SPECIES] = {0}, total = 0; /* T_i/m_i; sum of m C^2/3 */
  for (size_t i = 0; i < s->n; i++) T[gg_snapshot_species(s, i)] += square(s, i) / 3;
  for (int k = 0; k < m->n_species; k++) total += m->mass[k] * T[k], T[k] /= (double)m->n_of[k];
  for (size_t i = 0; i < s->n; i++) {
    int k = gg_snapshot_species(s, i);
    double xx = square(s, i) / (2 * T[k]), at = sqrt(xx) / GG_SONINE_WIDTH;
    if (at < BINS) bin[k * SET + (int)at]++;
    bin[k * SET + FOURTH] += xx * xx;
    bin[k * SET + SIXTH] += xx * xx * xx;
  }
  for (int k = 0; k < m->n_species; k++) bin[k * SET + SHARE] += m->mass[k] * T[k] * (double)m->n / total;
}

/* Degrees of freedom of the correction. Velocities over the T_i of the same instant share a fixed energy, that of
 * the species: <x^4> of Gaussian grains is lower by D/(D + 2), D the species' degrees of freedom. Conservation of
 * momentum leaves those of the species' mean in proportion to the mass of the others: so D = 3(N_i - 1) for all
 * grains, 3 N_i for few light ones, 3 for one grain however heavy. */
static double freedom_of(const gg_model *m, int k)
{
  double mass = 0, n = (double)m->n_of[k];
  for (int i = 0; i < m->n_species; i++) mass += m->mass[i] * (double)m->n_of[i];
  double left = 1 - n * m->mass[k] / mass, sum = n - 1 + left;
  return 3 * sum * sum / (n - 1 + left * left);
}

static void put_species(const gg_model *m, int k, const double *bin, gg_curves *list)
{
  double D = freedom_of(m, k), n = (double)m->n_of[k];
  gg_sonine_sums s = {.fourth = bin[FOURTH] / n * (D + 2) / D,
                      .sixth = bin[SIXTH] / n * (D + 2) * (D + 4) / (D * D),
                      .temperature_ratio = bin[SHARE]};
  for (int i = 0; i < BINS; i++) s.share[i] = bin[i] / n;
  gg_measure_sonine_curves_put(list, m, k, &s);
  gg_measure_sonine_polynomial_put(list, m, k, s.temperature_ratio);
}

static void curves(const void *self, const double *bin, gg_curves *list)
{
  const gg_model *m = ((const sonine *)self)->model;
  for (int k = 0; k < m->n_species; k++) put_species(m, k, bin + k * SET, list);
}

const gg_observable gg_measure_sonine = {
    GG_OBSERVABLE(SONINE, sonine),
    .create = create,
    .destroy = free,
    .refuses = refuses,
    .curves =
        &(const gg_observable_curves){
            .bins = bins, .every = 2, .framed = true, .add_snapshot = add_snapshot, .of_bins = curves},
    .cost = {.ns = {6, 4}},
};
