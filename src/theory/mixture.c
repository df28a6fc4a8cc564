/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Rates of <v^2> and <v^4> of species i by collisions with species j. With a = T_i/m_i, b = T_j/m_j, S^2 = a + b,
 * B = (1+e_ij) m_j/(m_i+m_j), F = 4 pi n_j sigma_ij^2 chi_ij sqrt(2/pi), Maxwellian averages are sums of terms
 * a^p b^q S^s:
 *   d<v^2>/dt = F [-2 B a S + B^2 S^3]
 *   d<v^4>/dt = F [-8 B a^2 S + 4 B^2 a S^3 - 16 B a^3/S + 24 B^2 a^2 S - 12 B a^2 b/S + 6 B^2 a b S
 *                  - 16 B^3 a S^3 + 4 B^4 S^5]
 * First Sonine corrections f_i = f_M [1 + (c_i/2)(x^4/2 - 5x^2/2 + 15/8)], x^2 = m_i v^2/2T_i, enter by
 * M (1 + c L_2/2) = (1 + (c/4) a^2 d^2/da^2) M. After V. Garzo & J.W. Dufty, Phys. Rev. E 60 (1999) 5706 and J.M.
 * Montanero & V. Garzo, Granular Matter 4 (2002) 17. */
#include "theory/mixture.h"

#include <math.h>
#include <stddef.h>

#include "theory/answer.h"

/* coefficient B^power a^p b^q S^s */
typedef struct term {
  double coefficient;
  int power, p, q, s;
} term;

static const term v2_terms[] = {{-2, 1, 1, 0, 1}, {1, 2, 0, 0, 3}};
static const term v4_terms[] = {{-8, 1, 2, 0, 1},   {4, 2, 1, 0, 3}, {-16, 1, 3, 0, -1}, {24, 2, 2, 0, 1},
                                {-12, 1, 2, 1, -1}, {6, 2, 1, 1, 1}, {-16, 3, 1, 0, 3},  {4, 4, 0, 0, 5}};

/* x^p and its first two derivatives times x, x^2. */
static void powers(double x, int p, double out[3])
{
  out[0] = pow(x, p);
  out[1] = p * out[0];
  out[2] = p * (p - 1) * out[0];
}

/* x^2 d^2/dx^2 of x^p (x + y)^h, the factor x^p given by its powers. */
static double curvature(const double xp[3], double x, double y, double h)
{
  double w = x / (x + y), W = pow(x + y, h);
  return W * (xp[2] + 2 * h * w * xp[1] + h * (h - 1) * w * w * xp[0]);
}

static void add_pair(const gg_model *m, int i, int j, const term *terms, size_t n, const double spread[],
                     gg_linear *rate)
{
  int o = gg_pair(i, j);
  double a = spread[i], b = spread[j], B = (1 + m->e[o]) * m->mass[j] / (m->mass[i] + m->mass[j]);
  double nj = m->density * gg_theory_fraction(m, j), sigma = m->sigma[o];
  double F = 4 * M_PI * nj * sigma * sigma * m->chi[o] * sqrt(2 / M_PI);
  for (size_t t = 0; t < n; t++) {
    double ap[3], bq[3], h = 0.5 * terms[t].s, factor = F * terms[t].coefficient * pow(B, terms[t].power);
    powers(a, terms[t].p, ap);
    powers(b, terms[t].q, bq);
    rate->at0 += factor * ap[0] * bq[0] * pow(a + b, h);
    rate->slope[i] += factor / 4 * bq[0] * curvature(ap, a, b, h);
    rate->slope[j] += factor / 4 * ap[0] * curvature(bq, b, a, h);
  }
}

static gg_linear sum_pairs(const gg_model *m, int i, const term *terms, size_t n, const double a[])
{
  gg_linear rate = {0, {0, 0}};
  for (int j = 0; j < m->n_species; j++) add_pair(m, i, j, terms, n, a, &rate);
  return rate;
}

gg_linear gg_theory_rate_v2(const gg_model *m, int i, const double a[GG_BINARY])
{
  return sum_pairs(m, i, v2_terms, sizeof v2_terms / sizeof *v2_terms, a);
}

gg_linear gg_theory_rate_v4(const gg_model *m, int i, const double a[GG_BINARY])
{
  return sum_pairs(m, i, v4_terms, sizeof v4_terms / sizeof *v4_terms, a);
}

gg_linear gg_theory_zeta(const gg_model *m, int i, const double a[GG_BINARY])
{
  gg_linear z = gg_theory_rate_v2(m, i, a);
  double scale = -1 / (3 * a[i]);
  return (gg_linear){scale * z.at0, {scale * z.slope[0], scale * z.slope[1]}};
}

/* Maxwellian weights: tau_ii, tau_ij of V. Garzo & J.M. Montanero, Phys. Rev. E 68 (2003) 041302, per grain. */
void gg_theory_stress_relaxation(const gg_model *m, const double a[GG_BINARY], double A[GG_BINARY][GG_BINARY])
{
  for (int i = 0; i < m->n_species; i++) {
    A[i][0] = A[i][1] = 0;
    for (int j = 0; j < m->n_species; j++) {
      int o = gg_pair(i, j);
      double B = (1 + m->e[o]) * m->mass[j] / (m->mass[i] + m->mass[j]), S2 = a[i] + a[j];
      double F = 4 * M_PI * m->density * gg_theory_fraction(m, j) * m->chi[o] * m->sigma[o] * m->sigma[o];
      double q = F * sqrt(2 / (M_PI * S2)), gain = 2 * B * a[i] / 15 - B * B * S2 / 5;
      A[i][i] += q * (gain + 2 * B * S2 / 3);
      A[i][j] += q * gain;
    }
  }
}

void gg_theory_partial_spreads(const gg_model *m, double T, double ratio, double a[GG_BINARY])
{
  double T2 = T / (gg_theory_fraction(m, 0) * ratio + gg_theory_fraction(m, 1));
  a[0] = ratio * T2 / m->mass[0];
  a[1] = T2 / m->mass[1];
}

void gg_theory_solve2(double A[GG_BINARY][GG_BINARY], const double b[GG_BINARY], double x[GG_BINARY])
{
  double det = A[0][0] * A[1][1] - A[0][1] * A[1][0];
  x[0] = (b[0] * A[1][1] - b[1] * A[0][1]) / det;
  x[1] = (b[1] * A[0][0] - b[0] * A[1][0]) / det;
}

double gg_theory_solve_ratio(double (*f)(double ratio, void *params), void *params)
{
  const double factor = 1.1;
  for (double far = 1; far < 1e6; far *= factor) {
    if (f(far, params) * f(far * factor, params) <= 0) return gg_theory_root_between(f, params, far, far * factor);
    if (f(1 / far, params) * f(1 / (far * factor), params) <= 0)
      return gg_theory_root_between(f, params, 1 / (far * factor), 1 / far);
  }
  return NAN;
}

void gg_theory_answer_partial_temperatures(const gg_model *m, const double a[GG_BINARY], gg_theory_answer *answer)
{
  double T[] = {m->mass[0] * a[0], m->mass[1] * a[1]};
  answer->value[GG_Q_TEMPERATURE] = gg_theory_fraction(m, 0) * T[0] + gg_theory_fraction(m, 1) * T[1];
  for (int i = 0; i < m->n_species; i++) answer->value[GG_Q_PARTIAL_TEMPERATURE + i] = T[i];
  answer->value[GG_Q_PARTIAL_TEMPERATURE_RATIO] = T[0] / T[1];
  gg_theory_answer_collisions(m, T, answer);
}
