/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Smooth binary mixtures, free cooling or with a Gaussian thermostat: partial temperatures and fourth cumulants V.
 * Garzo & J.W. Dufty, Phys. Rev. E 60 (1999) 5706, J.M. Montanero & V. Garzo, Granular Matter 4 (2002) 17; viscosity
 * J.M. Montanero & V. Garzo, Phys. Rev. E 67 (2003) 021308 and V. Garzo & J.M. Montanero, Phys. Rev. E 68 (2003)
 * 041302.
 *
 * T_1/T_2, c_1, c_2 from zeta_1 = zeta_2 and d<v^4>_i/dt = -2 zeta_i <v^4>_i, <v^4>_i = 15 a_i^2 (1 + c_i/2), linear in
 * c; or divided by 1 + c_i/2 before that (Montanero & Santos 2000), which is nearer to simulations.
 *
 * Viscosity, s = 1/2 cooling, 1 heated, F_ij = 4 pi n_j chi_ij sigma_ij^2, B = (1+e_ij) m_j/(m_i+m_j), S^2 = a_i + a_j:
 *   sum_j (tau_ij - s zeta delta_ij) eta_j = n_i T_i - (n_i m_i/2) sum_j F_ij sigma_ij [4 a_i B/15 - B^2 S^2/5]
 *   eta_c = sum_ij (4 pi/15) n_i n_j chi_ij sigma_ij^3 m_ij (1+e_ij)
 *           [(eta_i/(n_i m_i) + eta_j/(n_j m_j))/2 + sigma_ij S/sqrt(2 pi)],   m_ij = m_i m_j/(m_i+m_j)
 * with Maxwellian tau_ij = A_ij n_i m_i/(n_j m_j). */
#include "theory/garzo_montanero2003.h"
#include "common/thermostat.h"

#include <math.h>

#include "theory/garzo_dufty1999.h"
#include "theory/range.h"
#include "theory/theory_list.h"

static const char name[] = "garzo_montanero2003";

/* c_1, c_2 at given partial temperatures. */
static void cumulants(const gg_model *m, gg_linearisation how, const double a[], double c[GG_BINARY])
{
  double A[GG_BINARY][GG_BINARY], b[GG_BINARY];
  for (int i = 0; i < 2; i++) {
    gg_linear z = gg_theory_zeta(m, i, a), r = gg_theory_rate_v4(m, i, a);
    double v4 = 15 * a[i] * a[i];
    for (int j = 0; j < 2; j++) A[i][j] = r.slope[j] + 2 * v4 * z.slope[j];
    A[i][i] += how == GG_LINEAR ? v4 * z.at0 : -r.at0 / 2;
    b[i] = -(r.at0 + 2 * v4 * z.at0);
  }
  gg_theory_solve2(A, b, c);
}

static double zeta_with(const gg_model *m, int i, const double a[], const double c[])
{
  gg_linear z = gg_theory_zeta(m, i, a);
  return z.at0 + z.slope[0] * c[0] + z.slope[1] * c[1];
}

typedef struct equipartition {
  const gg_model *model;
  gg_linearisation how;
} equipartition;

static double difference(double ratio, void *params)
{
  const equipartition *q = params;
  double a[GG_BINARY], c[GG_BINARY];
  gg_theory_partial_spreads(q->model, 1, ratio, a);
  cumulants(q->model, q->how, a, c);
  return zeta_with(q->model, 0, a, c) - zeta_with(q->model, 1, a, c);
}

gg_mixture_state gg_theory_mixture_cooling(const gg_model *m, gg_linearisation how, double T)
{
  equipartition q = {m, how};
  gg_mixture_state s;
  double ratio = gg_theory_solve_ratio(difference, &q);
  gg_theory_partial_spreads(m, T, ratio, s.a);
  cumulants(m, how, s.a, s.c);
  s.zeta = zeta_with(m, 0, s.a, s.c);
  return s;
}

static double sigma3(const gg_model *m, int o)
{
  return m->boltzmann ? 0 : pow(m->sigma[o], 3) * m->chi[o];
}

/* Kinetic viscosities eta_i; returns their sum. */
static double kinetic_viscosity(const gg_model *m, const gg_mixture_state *s, double share, double eta[GG_BINARY])
{
  double tau[GG_BINARY][GG_BINARY], source[GG_BINARY], rho[GG_BINARY];
  for (int i = 0; i < 2; i++) rho[i] = m->density * gg_theory_fraction(m, i) * m->mass[i];
  gg_theory_stress_relaxation(m, s->a, tau);
  for (int i = 0; i < 2; i++) {
    source[i] = rho[i] * s->a[i];
    for (int j = 0; j < 2; j++) {
      int o = gg_pair(i, j);
      double B = (1 + m->e[o]) * m->mass[j] / (m->mass[i] + m->mass[j]), S2 = s->a[i] + s->a[j];
      double F = 4 * M_PI * m->density * gg_theory_fraction(m, j) * sigma3(m, o);
      source[i] -= rho[i] / 2 * F * (4 * s->a[i] * B / 15 - B * B * S2 / 5);
      tau[i][j] *= rho[i] / rho[j];
    }
    tau[i][i] -= share * s->zeta;
  }
  gg_theory_solve2(tau, source, eta);
  return eta[0] + eta[1];
}

gg_mixture_viscosity gg_theory_mixture_viscosity_of(const gg_model *m, const gg_mixture_state *s, double share)
{
  double eta[GG_BINARY];
  gg_mixture_viscosity v;
  v.kinetic = v.total = kinetic_viscosity(m, s, share, eta);
  for (int i = 0; i < 2; i++)
    for (int j = 0; j < 2; j++) {
      int o = gg_pair(i, j);
      double ni = m->density * gg_theory_fraction(m, i), nj = m->density * gg_theory_fraction(m, j);
      double reduced = m->mass[i] * m->mass[j] / (m->mass[i] + m->mass[j]), S = sqrt(s->a[i] + s->a[j]);
      double flow = 0.5 * (eta[i] / (ni * m->mass[i]) + eta[j] / (nj * m->mass[j]));
      v.total +=
          4 * M_PI / 15 * ni * nj * sigma3(m, o) * reduced * (1 + m->e[o]) * (flow + m->sigma[o] * S / sqrt(2 * M_PI));
    }
  return v;
}

/* p_c = (2 pi/3) sum_ij n_i n_j sigma_ij^3 chi_ij (1+e_ij) m_j T_i/(m_i+m_j) */
static double collisional_pressure(const gg_model *m, const gg_mixture_state *s)
{
  double sum = 0;
  for (int i = 0; i < 2; i++)
    for (int j = 0; j < 2; j++) {
      int o = gg_pair(i, j);
      double reduced = m->mass[i] * m->mass[j] / (m->mass[i] + m->mass[j]);
      sum += gg_theory_fraction(m, i) * gg_theory_fraction(m, j) * sigma3(m, o) * (1 + m->e[o]) * reduced * s->a[i];
    }
  return 2 * M_PI / 3 * m->density * m->density * sum;
}

static gg_status answer_in(const gg_model *m, const char *theory, gg_linearisation how, gg_theory_answer *a,
                           gg_error *err)
{
  if (m->n_species != 2)
    return gg_theory_reject(err, theory, "describes binary mixtures; this scene has %d species", m->n_species);
  GG_TRY(gg_theory_require_smooth(m, theory, err));
  if (gg_common_heat_of(m) == GG_HEAT_KICKS)
    return gg_theory_reject(err, theory,
                            "describes free cooling and the Gaussian thermostat; this scene is heated by white "
                            "noise");
  double T = m->linear_response ? 0.5 : m->temperature0;
  gg_mixture_state s = gg_theory_mixture_cooling(m, how, T);
  if (isnan(s.zeta)) return gg_theory_reject(err, theory, "finds no common cooling rate for this mixture");
  gg_mixture_viscosity v = gg_theory_mixture_viscosity_of(m, &s, gg_theory_thermostat_factor(m));
  double nu0 = gg_common_model_nu0(m, T), p = m->density * T, pc = collisional_pressure(m, &s);
  for (int i = 0; i < 2; i++) a->value[GG_Q_CUMULANT + i] = s.c[i];
  a->value[GG_Q_COOLING_RATE] = s.zeta / nu0;
  a->value[GG_Q_VISCOSITY_REDUCED] = nu0 * v.total / p;
  a->value[GG_Q_VISCOSITY_REDUCED_KINETIC] = nu0 * v.kinetic / p;
  if (m->flow == GG_HCS) gg_theory_answer_critical_lengths(m, 0, a);
  a->value[GG_Q_PARTIAL_TEMPERATURE_RATIO] = m->mass[0] * s.a[0] / (m->mass[1] * s.a[1]);
  if (m->linear_response) return GG_OK; /* T grows with time: no value */
  gg_theory_answer_partial_temperatures(m, s.a, a);
  gg_theory_answer_pressure(m, T, p, pc, a);
  return GG_OK;
}

static gg_status evaluate(const gg_model *m, gg_theory_answer *a, gg_error *err)
{
  return answer_in(m, name, GG_LINEAR, a, err);
}

const gg_theory gg_theory_garzo_montanero2003 = {
    .name = name,
    .flows = GG_FLOW_BIT(GG_HCS) | GG_FLOW_BIT(GG_HSS) | GG_FLOW_BIT(GG_SMALL_SHEAR),
    .title = "Cooling and viscosity of smooth binary mixtures",
    .citation = "V. Garzo and J.M. Montanero, Phys. Rev. E 68 (2003) 041302; V. Garzo and J.W. Dufty, Phys. Rev. E 60 "
                "(1999) 5706",
    .answers = "temperature pressure compressibility_factor " GG_ANSWERS_RATES
               "cooling_rate c_1 c_2 " GG_ANSWERS_MIXTURE GG_ANSWERS_VISCOSITY "clustering_length",
    .assumptions =
        "Cooling or Gaussian-heated state of a smooth binary mixture, any density with molecular chaos. T_1/T_2 is "
        "within 0.5 % of Enskog's equation, the viscosity within 1 % at one e for all pairs (5 % high at e = 0.6, 0.9, "
        "0.99), c_1 and c_2 are some 10 % high at e = 0.5. First Sonine order, linear in c_1 and c_2.",
    .evaluate = evaluate,
    .beyond = gg_theory_beyond_first_sonine,
};

static const char name_ms[] = "garzo_montanero2003_ms";

static gg_status evaluate_ms(const gg_model *m, gg_theory_answer *a, gg_error *err)
{
  return answer_in(m, name_ms, GG_DIVIDED, a, err);
}

const gg_theory gg_theory_garzo_montanero2003_ms = {
    .name = name_ms,
    .flows = GG_FLOW_BIT(GG_HCS) | GG_FLOW_BIT(GG_HSS) | GG_FLOW_BIT(GG_SMALL_SHEAR),
    .title = "Binary mixtures, the other linearisation of c_1 and c_2",
    .citation = "As garzo_montanero2003, linearised as in J.M. Montanero and A. Santos, Granular Matter 2 (2000) 53",
    .answers = "temperature pressure compressibility_factor " GG_ANSWERS_RATES
               "cooling_rate c_1 c_2 " GG_ANSWERS_MIXTURE GG_ANSWERS_VISCOSITY "clustering_length",
    .assumptions = "As garzo_montanero2003, but the fourth-moment equations are divided by 1 + c_i/2 before they are "
                   "linearised: c_1 and c_2 are closer to simulations.",
    .evaluate = evaluate_ms,
};
