/* Deviation of the distribution of speeds from a Maxwellian: Phi_i/Phi_iM = 1 + (c_i/2) Delta_i(v*), with v* = v/v_0,
 * v_0^2 = 2T (m_1 + m_2)/(m_1 m_2) for mixtures and 2T/m for one species; in the first Sonine approximation Delta_i =
 * x^4/2 - 5 x^2/2 + 15/8, x^2 = m_i v^2/(2 T_i) (Montanero & Garzo, Granular Matter 4 (2002) 17). c_i = 2 a_2 is
 * measured along with it: c_i = (8/15)(<x^4> - 15/4), and the third Sonine
 * coefficient a_3 = 1 + 3 a_2 - (8/105) <x^6> (Brilliantov & Poschel, Europhys. Lett. 74 (2006) 424). Velocities are
 * scaled by T_i at each instant. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "measure/needs.h"
#include "measure/observable.h"

enum { BINS = 60, FOURTH = BINS, SIXTH, SHARE, SET };
#define WIDTH 0.05

typedef struct sonine {
  gg_model model;
} sonine;

static const char *refuses(const gg_model *m)
{
  if (m->shear_rate != 0) return "under shear the distribution is not isotropic; see velocity_distributions";
  return gg_needs_homogeneity(m);
}

static void *create(const gg_model *m, gg_error *err)
{
  sonine *d = gg_new_array(1, sizeof *d, err);
  if (d) d->model = *m;
  return d;
}

static size_t bins(const void *self)
{
  return (size_t)((const sonine *)self)->model.n_species * SET;
}

static double square(const gg_snapshot *s, size_t i)
{
  return s->c[0][i] * s->c[0][i] + s->c[1][i] * s->c[1][i] + s->c[2][i] * s->c[2][i];
}

static void add_snapshot(void *self, const gg_snapshot *s, double *bin)
{
  const gg_model *m = &((const sonine *)self)->model;
  double T[GG_MAX_SPECIES] = {0}, total = 0; /* T_i/m_i; sum of m C^2/3 */
  for (size_t i = 0; i < s->n; i++) T[gg_snapshot_species(s, i)] += square(s, i) / 3;
  for (int k = 0; k < m->n_species; k++) total += m->mass[k] * T[k], T[k] /= (double)m->n_of[k];
  for (size_t i = 0; i < s->n; i++) {
    int k = gg_snapshot_species(s, i);
    double xx = square(s, i) / (2 * T[k]), at = sqrt(xx) / WIDTH;
    if (at < BINS) bin[k * SET + (int)at]++;
    bin[k * SET + FOURTH] += xx * xx;
    bin[k * SET + SIXTH] += xx * xx * xx;
  }
  for (int k = 0; k < m->n_species; k++) bin[k * SET + SHARE] += m->mass[k] * T[k] * (double)m->n / total;
}

/* Integral of 4/sqrt(pi) x^2 exp(-x^2) from 0. */
static double maxwellian_below(double x)
{
  return erf(x) - M_2_SQRTPI * x * exp(-x * x);
}

/* 1/sqrt(lambda_i): v* = x/sqrt(lambda_i), lambda_i = T/(T_i mu_ji); of one species, and of more than two, whose mu are
 * several: v* = x. */
static double reduced(const gg_model *m, int k, const double *bin)
{
  if (m->n_species != 2) return 1;
  return sqrt(bin[SHARE] * m->mass[1 - k] / (m->mass[0] + m->mass[1]));
}

/* First Sonine approximation; parameters: its factor, and the unit of x. */
static double first_sonine(double x, const double *p)
{
  double xx = x * x / (p[1] * p[1]);
  return p[0] * (xx * xx / 2 - 2.5 * xx + 15.0 / 8);
}

static void put_species(const gg_model *m, int k, const double *bin, gg_curves *list)
{
  char name[3][48], label[24] = "measured", theory[24] = "first Sonine";
  static const char *const what[] = {"sonine_excess", "sonine_deviation", "sonine_polynomial"};
  bool mixed = m->n_species > 1;
  for (int i = 0; i < 3; i++) snprintf(name[i], sizeof name[i], mixed ? "%s_%d" : "%s", what[i], k + 1);
  if (mixed)
    snprintf(label, sizeof label, "species %d", k + 1), snprintf(theory, sizeof theory, "first Sonine, %d", k + 1);
  double n = (double)m->n_of[k], unit = reduced(m, k, bin);
  /* A fixed total energy lowers <x^4> of Gaussian grains by D/(D+2), D = 3(N-1). */
  double D = 3 * ((double)m->n - 1), fourth = bin[FOURTH] / n * (D + 2) / D, cumulant = 8.0 / 15 * (fourth - 15.0 / 4);
  double sixth = bin[SIXTH] / n * (D + 2) * (D + 4) / (D * D), a3 = 1 + 1.5 * cumulant - 8.0 / 105 * sixth;
  gg_curve *excess = gg_curve_add(list, BINS, name[0], "excess over a Maxwellian", label);
  gg_curve *delta = gg_curve_add(list, BINS, name[1], "Δ(v*)", label);
  gg_curve *series = gg_curve_add(list, BINS, name[2], "Δ(v*)", theory);
  gg_curve_axes(excess, "v*", "1", "Φ/Φ_M - 1", "1");
  gg_curve_axes(delta, "v*", "1", "Δ", "1");
  gg_curve_axes(series, "v*", "1", "Δ", "1");
  gg_curve_put_number(excess, "c", cumulant, "1");
  gg_curve_put_number(excess, "a3", a3, "1");
  for (size_t i = 0; i < excess->n && i < delta->n && i < series->n; i++) {
    double from = (double)i * WIDTH, x = from + WIDTH / 2, xx = x * x;
    double expected = n * (maxwellian_below(from + WIDTH) - maxwellian_below(from));
    excess->x[i] = delta->x[i] = series->x[i] = x * unit;
    excess->value[i] = bin[i] / expected - 1;
    delta->value[i] = 2 / cumulant * excess->value[i];
    series->value[i] = xx * xx / 2 - 2.5 * xx + 15.0 / 8;
  }
  gg_curve_beside(excess, "first Sonine", first_sonine, (const double[]){cumulant / 2, unit});
}

static void curves(const void *self, const double *bin, gg_curves *list)
{
  const gg_model *m = &((const sonine *)self)->model;
  for (int k = 0; k < m->n_species; k++) put_species(m, k, bin + k * SET, list);
}

const gg_observable gg_sonine = {
    GG_OBSERVABLE(SONINE, sonine), .create = create, .destroy = free, .refuses = refuses, .bins = bins, .every = 2,
    .add_snapshot = add_snapshot,  .curves = curves,
};
