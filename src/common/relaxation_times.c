/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "common/relaxation_times.h"

#include <gsl/gsl_eigen.h>
#include <math.h>

#include "base/memory.h"
#include "common/portable_math.h"
#include "common/thermostat.h"

/* Add to the loss A and to the exchange with the spins C, per collision of i, the part from collisions of i with j. */
static void add_shares(const gg_model *m, int i, int j, double *A, double *C)
{
  const int o = gg_pair(i, j);
  const gg_rule rule = gg_common_rule_select(m->beta[o], m->mu[o]);
  const double share =
      m->n_species > 1 ? gg_common_model_pair_rate(m, 1, i, j, 1) / gg_common_model_species_rate(m, i, 1) : 1;
  double K = m->inertia[i], eta1 = (1 + m->e[o]) / 2, eta2 = 0;
  if (rule != GG_SMOOTH) eta2 = (1 + m->beta[o]) * K / (2 * (1 + K));
  double exchange = eta2 / K * (1 - eta2 / K);
  /* Sliding weakens the exchange with the spins by about mu over the friction that sticking would need. */
  if (rule == GG_FRICTIONAL) exchange *= fmin(1, m->mu[o] * eta1 / eta2);
  *A += share * (fabs(eta1 * (1 - eta1)) + eta2 * (1 - eta2));
  *C += share * exchange;
}

/* Collisions per grain in which what a species loses, and what it shares with its spins, falls to 1/e: the slowest. */
static void slowest_of(const gg_model *m, double *loss, double *spins)
{
  *loss = *spins = 0;
  for (int i = 0; i < m->n_species; i++) {
    double A = 0, C = 0;
    for (int j = 0; j < m->n_species; j++) add_shares(m, i, j, &A, &C);
    /* With e above and below 1 the mean e is near 1; its slope brings the temperature back. */
    if (m->by_speed.gains) A = fmax(A, 0.02);
    if (A > 0 && !m->elastic) *loss = fmax(*loss, 0.75 / A);
    if (C > 0) *spins = fmax(*spins, 0.75 / C);
  }
}

double gg_common_model_cooling(const gg_model *m)
{
  double loss, spins;
  slowest_of(m, &loss, &spins);
  return fmax(fmax(loss, spins), 1);
}

/* For Maxwellians dT_i/dt = sum_j x_j k_ij (T_j - T_i), k_ij = (8/3) m_i m_j/(m_i + m_j)^2 times the rate at which a
 * grain of i meets those of j, were all grains j. Here at T = 1. */
static double exchange_rate(const gg_model *m, int i, int j)
{
  const int o = gg_pair(i, j);
  const double both = m->mass[i] + m->mass[j], spread = 1 / m->mass[i] + 1 / m->mass[j]; /* <c12_x^2> */
  const double meeting = m->density * m->sigma[o] * m->sigma[o] * m->chi[o] * sqrt(8 * M_PI * spread);
  return 8 / 3.0 * m->mass[i] * m->mass[j] / (both * both) * meeting;
}

/* Elastic species share their energy, the more slowly the less alike their masses are. The matrix is that of sqrt(x_i)
 * T_i, with the other sign: symmetric. */
static void fill(const gg_model *m, gsl_matrix *S)
{
  gsl_matrix_set_zero(S);
  for (int i = 0; i < m->n_species; i++)
    for (int j = 0; j < m->n_species; j++) {
      const double xi = m->fraction[i], xj = m->fraction[j];
      if (i == j) continue;
      const double k = exchange_rate(m, i, j);
      *gsl_matrix_ptr(S, (size_t)i, (size_t)i) += xj * k;
      gsl_matrix_set(S, (size_t)i, (size_t)j, -sqrt(xi * xj) * k);
    }
}

/* The eigenvalue next to 0, which is that of equal temperatures. */
static double slowest_rate(const gg_model *m)
{
  double elements[GG_MAX_SPECIES * GG_MAX_SPECIES], values[GG_MAX_SPECIES], least = INFINITY, next = INFINITY;
  const size_t n = (size_t)m->n_species;
  gsl_matrix_view S = gsl_matrix_view_array(elements, n, n);
  gsl_vector_view rates = gsl_vector_view_array(values, n);
  gg_base_gsl_enter();
  gsl_eigen_symm_workspace *w = gsl_eigen_symm_alloc(n);
  gg_base_gsl_leave();
  if (!w) {
    gg_base_memory_lacked();
    return INFINITY;
  }
  fill(m, &S.matrix);
  gsl_eigen_symm(&S.matrix, &rates.vector, w);
  gsl_eigen_symm_free(w);
  for (size_t i = 0; i < n; i++) {
    if (values[i] < least)
      next = least, least = values[i];
    else if (values[i] < next)
      next = values[i];
  }
  return next;
}

double gg_common_model_sharing(const gg_model *m)
{
  return m->n_species > 1 ? gg_common_model_collision_rate(m, 1) / slowest_rate(m) : 0;
}

/* The loss goes as T^(3/2), what drag takes as T. */
static double in_bath(const gg_model *m, double loss)
{
  double drag = INFINITY;
  for (int i = 0; i < m->n_species; i++) drag = fmin(drag, m->bath.drag[i]);
  const double rate = (loss > 0 ? 1.5 / loss : 0) + 2 * drag / gg_common_model_collision_rate(m, m->temperature0);
  return rate > 0 ? 1 / rate : 0; /* a torque alone, which nothing balances, never relaxes */
}

/* Scaled, T itself does not relax. Species lose energy at different rates, beside the exchange between them: the rates
 * add up. */
static double of_temperatures(const gg_model *m, double loss)
{
  if (m->bath.on) return in_bath(m, loss);
  const bool scaled = gg_flow_cools(m->flow) || gg_common_heat_of(m) == GG_HEAT_SCALES;
  if (m->elastic || scaled) {
    const double sharing = m->steady ? gg_common_model_sharing(m) : 0;
    return sharing > 0 && loss > 0 ? 1 / (1 / sharing + 1 / loss) : sharing;
  }
  return loss;
}

double gg_common_model_relaxation(const gg_model *m)
{
  double loss, spins;
  slowest_of(m, &loss, &spins);
  return fmax(fmax(of_temperatures(m, loss), spins), 1);
}

/* In diameters of a grain of the mean volume; n d^3 and n d^2 nu/rate are free of the temperature. */
double gg_common_model_gap_relaxation(const gg_model *m)
{
  if (!m->walled) return 0;
  double n = 6 * m->phi / M_PI, d = gg_root(n / m->density, 3), gap = fmax(m->box[1] / d - 1, 0) / M_PI;
  double chi = m->chi[0], b = 1 + 1.6 * m->phi * chi;
  double viscosity = 5.0 / 16 * (b * b / chi + 768 / (25 * M_PI) * m->phi * m->phi * chi); /* sqrt(m T/pi)/d^2 */
  return gap * gap * 4 * M_PI * n * n * chi / viscosity;
}
