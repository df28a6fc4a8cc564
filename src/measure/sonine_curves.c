#include "measure/sonine_curves.h"

#include <math.h>
#include <stdio.h>

enum { BINS = GG_SONINE_BINS };
static const double width = GG_SONINE_WIDTH;

/* Integral of 4/sqrt(pi) x^2 exp(-x^2) from 0. */
static double maxwellian_below(double x)
{
  return erf(x) - M_2_SQRTPI * x * exp(-x * x);
}

/* 1/sqrt(lambda_i): v* = x/sqrt(lambda_i), lambda_i = T/(T_i mu_ji); of one species, and of more than two, whose mu are
 * several: v* = x. */
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
