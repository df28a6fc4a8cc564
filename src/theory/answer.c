/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "theory/answer.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_roots.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>

gg_status gg_theory_reject(gg_error *err, const char *theory, const char *format, ...)
{
  char reason[512];
  va_list args;
  va_start(args, format);
  vsnprintf(reason, sizeof reason, format, args);
  va_end(args);
  return gg_base_fail(err, GG_BAD_INPUT, "%s %s", theory, reason);
}

gg_status gg_theory_require_steady_shear(const gg_model *m, const char *theory, gg_error *err)
{
  if (!m->steady)
    return gg_theory_reject(
        err, theory, "describes steady shear; collisions of this scene lose no energy, so that it heats up for ever");
  return GG_OK;
}

gg_status gg_theory_require_one_species(const gg_model *m, const char *theory, gg_error *err)
{
  if (m->n_species == 1) return GG_OK;
  return gg_theory_reject(err, theory, "describes grains of one species; this scene has %d", m->n_species);
}

gg_status gg_theory_require_at_most_two_species(const gg_model *m, const char *theory, gg_error *err)
{
  if (m->n_species <= 2) return GG_OK;
  return gg_theory_reject(err, theory, "describes grains of one or two species; this scene has %d", m->n_species);
}

gg_status gg_theory_require_smooth(const gg_model *m, const char *theory, gg_error *err)
{
  if (m->rule == GG_SMOOTH) return GG_OK;
  return gg_theory_reject(err, theory, "describes smooth grains; grains of this scene are %s",
                          m->rule == GG_ROUGH ? "rough" : "frictional");
}

gg_status gg_theory_require_constant_beta(const gg_model *m, const char *theory, gg_error *err)
{
  if (m->rule != GG_FRICTIONAL) return GG_OK;
  return gg_theory_reject(
      err, theory, "describes grains of constant beta; enskog_hermite and gaussian_closure have Coulomb friction");
}

gg_status gg_theory_require_dilute(const gg_model *m, const char *theory, gg_error *err)
{
  if (m->phi <= GG_DILUTE_PHI) return GG_OK;
  return gg_theory_reject(err, theory, "describes dilute gases (phi up to %g); this scene has phi = %g", GG_DILUTE_PHI,
                          m->phi);
}

bool gg_theory_is_nearly_elastic(const gg_model *m)
{
  for (int i = 0; i < m->n_species; i++)
    for (int j = 0; j < m->n_species; j++) {
      int pair = gg_pair(i, j);
      if (1 - m->e[pair] > 5e-7 || (m->contact[i][j].jt > 0 && 1 - fabs(m->beta[pair]) > 5e-7)) return false;
    }
  return true;
}

gg_grain gg_theory_grain_of(const gg_model *m)
{
  const gg_contact *c = &m->contact[0][0]; /* unit masses: m_r (1+e) = eta_1, m_t (1+beta) = eta_2 */
  return (gg_grain){.eta1 = c->jn, .eta2 = c->jt, .K = m->inertia[0]};
}

double gg_theory_phi_chi(const gg_model *m)
{
  return m->phi * m->chi[0];
}

double gg_theory_bulk_viscosity(const gg_model *m, double share)
{
  return m->boltzmann ? 0 : 256 / (5 * M_PI) * m->phi * gg_theory_phi_chi(m) * gg_theory_grain_of(m).eta1 * share;
}

static void answer_length(gg_quantity q, double square, double relative_error, gg_theory_answer *a)
{
  if (!(square > 0)) return;
  a->value[q] = 2 * M_PI * sqrt(square);
  a->error[q] = a->value[q] * relative_error / 2;
}

void gg_theory_answer_critical_lengths(const gg_model *m, double ratio, gg_theory_answer *a)
{
  const double *v = a->value, *error = a->error, zeta = v[GG_Q_COOLING_RATE];
  if (m->elastic || m->bath.on || !(zeta > 0)) return; /* drag damps the modes */
  double y = gg_theory_phi_chi(m), Z = 1 + 4 * gg_theory_grain_of(m).eta1 * y, g = 1 + m->chi_slope;
  double Cp = 1 + (Z - 1) / Z * g, unit = 1 / gg_common_model_nu0(m, 1), mass = 0;
  for (int i = 0; i < m->n_species; i++) mass += gg_theory_fraction(m, i) * m->mass[i];
  const gg_quantity eta = GG_Q_VISCOSITY_REDUCED, kappa = GG_Q_THERMAL_CONDUCTIVITY_REDUCED,
                    mu = GG_Q_DIFFUSIVE_HEAT_CONDUCTIVITY_REDUCED;
  const double off = error[GG_Q_COOLING_RATE] / zeta;
  answer_length(GG_Q_CLUSTERING_LENGTH, unit * unit * 2 * v[eta] / zeta / mass, error[eta] / v[eta] + off, a);
  double spins =
      ratio > 0 ? v[GG_Q_ROTATIONAL_CONDUCTIVITY_REDUCED] * Cp - v[GG_Q_ROTATIONAL_DIFFUSIVE_CONDUCTIVITY_REDUCED] : 0;
  double heat = v[kappa] * Cp - v[mu] + spins;
  answer_length(GG_Q_HEAT_MODE_LENGTH, unit * unit * 2.5 * heat / (zeta * (1 + ratio) * (g - Cp / 2)),
                (error[kappa] * Cp + error[mu]) / heat + off, a);
}

double gg_theory_fraction(const gg_model *m, int species)
{
  return m->fraction[species];
}

static gg_stress stress_sum(gg_stress a, gg_stress b)
{
  return (gg_stress){a.xx + b.xx, a.yy + b.yy, a.zz + b.zz, a.xy + b.xy, a.yx + b.yx};
}

#define COMPONENTS(part)                                                                                               \
  {                                                                                                                    \
    GG_Q_P_XX##part, GG_Q_P_YY##part, GG_Q_P_ZZ##part, GG_Q_P_XY##part, GG_Q_P_YX##part                                \
  }
static const gg_quantity total_stress[] = COMPONENTS(), kinetic_stress[] = COMPONENTS(_KINETIC),
                         collisional_stress[] = COMPONENTS(_COLLISIONAL);

static void set_components(const gg_model *m, const gg_quantity part[5], gg_stress s, gg_theory_answer *a)
{
  const double component[] = {s.xx, s.yy, s.zz, s.xy, s.yx};
  for (int i = 0; i < 5; i++) a->value[part[i]] = m->stress_unit * component[i];
}

void gg_theory_answer_stress(const gg_model *m, double T, gg_stress kinetic, gg_stress collisional, gg_theory_answer *a)
{
  bool transfer = !m->boltzmann && !isnan(collisional.xx);
  gg_stress total = transfer ? stress_sum(kinetic, collisional) : kinetic;
  double p = (total.xx + total.yy + total.zz) / 3;
  set_components(m, total_stress, total, a);
  set_components(m, kinetic_stress, kinetic, a);
  if (transfer) set_components(m, collisional_stress, collisional, a);
  a->value[GG_Q_PRESSURE] = m->stress_unit * p;
  a->value[GG_Q_COMPRESSIBILITY] = p / (m->density * T);
  a->value[GG_Q_N1] = (total.xx - total.yy) / p;
  a->value[GG_Q_N2] = (total.yy - total.zz) / p;
  if (m->shear_rate > 0) a->value[GG_Q_SHEAR_VISCOSITY] = m->stress_unit * fabs(total.xy) / m->shear_rate;
}

void gg_theory_answer_pressure(const gg_model *m, double T, double kinetic, double collisional, gg_theory_answer *a)
{
  double p = m->boltzmann ? kinetic : kinetic + collisional;
  a->value[GG_Q_PRESSURE] = m->stress_unit * p;
  a->value[GG_Q_COMPRESSIBILITY] = p / (m->density * T);
}

void gg_theory_answer_temperature(const gg_model *m, double T, double ratio, gg_theory_answer *a)
{
  a->value[GG_Q_TEMPERATURE] = T;
  if (m->rule == GG_SMOOTH) return;
  a->value[GG_Q_TEMPERATURE_RATIO] = ratio;
  a->value[GG_Q_ROTATIONAL_TEMPERATURE] = ratio * T;
}

void gg_theory_answer_rolling(const gg_model *m, double spin, gg_theory_answer *a)
{
  if (m->rule != GG_SMOOTH && m->phi >= GG_ROLLING_PHI) a->value[GG_Q_SPIN_Z] = spin;
}

void gg_theory_answer_collisions(const gg_model *m, const double T[], gg_theory_answer *a)
{
  double rate = 0, speed = 0;
  for (int i = 0; i < m->n_species; i++) {
    speed += gg_theory_fraction(m, i) * gg_theory_mean_speed(m, i, T);
    for (int j = 0; j < m->n_species; j++) rate += gg_theory_fraction(m, i) * gg_theory_pair_collision_rate(m, i, j, T);
  }
  a->value[GG_Q_COLLISION_RATE] = rate;
  a->value[GG_Q_MEAN_FREE_PATH] = speed / rate;
  /* The box has no size in the Boltzmann limit. */
  if (!m->boltzmann) a->value[GG_Q_KNUDSEN] = speed / rate / m->length;
}

void gg_theory_answer_collisions_one(const gg_model *m, double T, gg_theory_answer *a)
{
  double each[GG_MAX_SPECIES];
  for (int i = 0; i < m->n_species; i++) each[i] = T;
  gg_theory_answer_collisions(m, each, a);
}

/* S. Chapman & T.G. Cowling, The Mathematical Theory of Non-Uniform Gases, sects 5.21 and 16.2:
 *   nu_ij = n_j sigma_ij^2 chi_ij sqrt(8 pi (T_i/m_i + T_j/m_j)),   l_i = sqrt(8 T_i/(pi m_i))/sum_j nu_ij
 * One species: nu = 4 n d^2 chi sqrt(pi T), l = d/(6 sqrt(2) phi chi). */
double gg_theory_pair_collision_rate(const gg_model *m, int i, int j, const double T[])
{
  double nj = m->number_density[j], sigma = m->sigma[gg_pair(i, j)];
  return nj * sigma * sigma * m->chi[gg_pair(i, j)] * sqrt(8 * M_PI * (T[i] / m->mass[i] + T[j] / m->mass[j]));
}

double gg_theory_mean_speed(const gg_model *m, int i, const double T[])
{
  return sqrt(8 * T[i] / (M_PI * m->mass[i]));
}

double gg_theory_mean_free_path(const gg_model *m, int i, const double T[])
{
  double rate = 0;
  for (int j = 0; j < m->n_species; j++) rate += gg_theory_pair_collision_rate(m, i, j, T);
  return gg_theory_mean_speed(m, i, T) / rate;
}

double gg_theory_root_between(double (*f)(double x, void *params), void *params, double low, double high)
{
  gsl_function function = {f, params};
  gsl_root_fsolver *solver = gsl_root_fsolver_alloc(gsl_root_fsolver_brent);
  double root = NAN;
  if (!solver) return root;
  int status = gsl_root_fsolver_set(solver, &function, low, high);
  for (int i = 0; i < 200 && status == GSL_SUCCESS; i++) {
    status = gsl_root_fsolver_iterate(solver);
    root = gsl_root_fsolver_root(solver);
    double a = gsl_root_fsolver_x_lower(solver), b = gsl_root_fsolver_x_upper(solver);
    if (gsl_root_test_interval(a, b, 0, 1e-14) == GSL_SUCCESS) break;
  }
  gsl_root_fsolver_free(solver);
  return root;
}
