/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "theory/enskog_hermite.h"

#include <math.h>
#include <string.h>

#include "theory/answer.h"
#include "theory/garzo_dufty1999.h"
#include "theory/gaussian_moments.h"
#include "theory/hermite/hermite_state.h"
#include "theory/rough/distribution.h"
#include "theory/rough/response.h"
#include "theory/spin_escape.h"
#include "theory/two_maxwellian.h"

static const char name[] = "enskog_hermite";

/* Relative error above which there is no answer. */
static const double poor = 0.05;

/* Shear: plain moments about a Gaussian of the same second moments. In dilute gases their series alternates with even
 * and odd degrees, and the mean of the last two is ten times better than either; in dense ones they agree. */
enum { FIRST_DEGREE = 4, LAST_DEGREE = 6, LAST_ISOTROPIC = 8 };
static const gg_rough_choice moments = {.width = 1, .spin_width = 1};

/* Error of Lambda = <cos^2 Psi>, which is not smooth at C = 0 and W = 0, so that its series is slow: what degrees
 * differ by; `lacks`, the share of Lambda - 1/3 that was missing in sheared frictional gases; and `rough_angle`, which
 * covers Monte Carlo at beta = 1. Beyond `poor_angle` there is no answer. */
static const double lacks = 0.08, rough_angle = 5e-4, poor_angle = 0.015;

/* Relative contribution of products of degrees beyond N. */
static const double left_out = 7e-4;

/* Homogeneous states: spins have long tails there (kurtosis 6.3 at e = .7, beta = -.5), which tests that decay
 * suppress and a wide weight can follow. Among weights 1 to 4 times as wide as f and decays of .05 to 1 the first
 * choice is best at degree 8 for all beta (plain moments diverge). The second is for states in which the last degree
 * still changes theta/T by more than `restless`, at e = .7 and beta from -.7 to -.3. */
static const gg_rough_choice tails[] = {
    {.width = 1.1, .spin_width = 1.4, .decay = 0.1, .spin_decay = 0.07, .extra = 2},
    {.width = 1.1, .spin_width = 1.6, .decay = 0.1, .spin_decay = 0.1, .extra = 2},
};
enum { CHOICES = sizeof tails / sizeof *tails };
static const double restless = 0.02;

/* With friction spins have no long tails where noise or a thermostat heats translation, and plain moments converge; in
 * free cooling about a somewhat wider Gaussian. Tests that decay make it worse. */
static const gg_rough_choice wider_spins = {.width = 1, .spin_width = 1.2};

static gg_rough_steady begin(const gg_model *m, const gg_rough_choice *choice)
{
  double sigma = m->sigma[0];
  return (gg_rough_steady){.choice = *choice,
                           .gas = {.frequency = m->density * m->chi[0] * sigma * sigma,
                                   .eta1 = m->contact[0][0].jn,
                                   .eta2 = m->contact[0][0].jt,
                                   .mu = m->contact[0][0].mu,
                                   .K = m->inertia[0],
                                   .shear = m->boltzmann ? 0 : sigma * m->shear_rate,
                                   .stop = m->stop}};
}

static double mean(const gg_rough_steady *s, const double *functional)
{
  return s->gas.frequency * gg_rough_pair_mean(&s->form, &s->relative, functional, s->a);
}

static double speed(const gg_rough_steady *s)
{
  return gg_rough_mean_speed(&s->form, &s->relative.f, &s->weight, s->a);
}

static double third_of_trace(const gg_rough_steady *s, bool spin)
{
  double M[3][3];
  gg_rough_covariance(&s->form, &s->relative.f, &s->weight, s->a, spin, M);
  return (M[0][0] + M[1][1] + M[2][2]) / 3;
}

/* Fourth (third) central moment over the second to the power 2 (3/2). */
static double cumulant(const gg_rough_steady *s, bool spin, int axis, int order)
{
  double x[5], central = 0;
  static const int choose[5][5] = {{1}, {1, 1}, {1, 2, 1}, {1, 3, 3, 1}, {1, 4, 6, 4, 1}};
  gg_rough_moments(&s->form, &s->relative.f, &s->weight, s->a, spin, axis, x);
  for (int i = 0; i <= order; i++) central += choose[order][i] * x[i] * pow(-x[1], order - i);
  return central / pow(x[2] - x[1] * x[1], order / 2.);
}

static void answer_cumulants(const gg_rough_steady *s, gg_theory_answer *a)
{
  a->value[GG_Q_COS2_PSI] = gg_rough_orientation(s);
  static const gg_quantity kurtosis[2][3] = {{GG_Q_KURTOSIS_CX, GG_Q_KURTOSIS_CY, GG_Q_KURTOSIS_CZ},
                                             {GG_Q_KURTOSIS_WX, GG_Q_KURTOSIS_WY, GG_Q_KURTOSIS_WZ}};
  for (int k = 0; k < 6; k++) a->value[kurtosis[k / 3][k % 3]] = cumulant(s, k / 3, k % 3, 4);
  const gg_rough_correlation c = gg_rough_correlations(&s->form, &s->relative.f, &s->weight, s->a);
  a->value[GG_Q_A11] = c.a11, a->value[GG_Q_ORIENTATION_B] = c.b;
}

static void answer_flights(const gg_model *m, double rate, double mean_speed, gg_theory_answer *a)
{
  a->value[GG_Q_COLLISION_RATE] = rate;
  a->value[GG_Q_MEAN_FREE_PATH] = mean_speed / rate;
  if (!m->boltzmann) a->value[GG_Q_KNUDSEN] = mean_speed / rate / m->length;
}

/* Energy per grain that a bath supplies. */
static double from_bath(const gg_model *m, const gg_rough_steady *s)
{
  const gg_bath *b = &m->bath;
  const double spin = gg_rough_mean_spin(&s->form, &s->relative.f, &s->weight, s->a);
  const double rolling = spin * (spin - gg_model_rolling(m, 0)), square = 3 * third_of_trace(s, true) + rolling;
  return 1.5 * b->noise[0] - b->drag[0] * 3 * third_of_trace(s, false) +
         m->inertia[0] * (1.5 * b->spin_noise[0] - b->spin_drag[0] * square);
}

static void answer_shear(const gg_model *m, const gg_rough_steady *s, gg_theory_answer *a)
{
  double M[3][3], P[3][3], T = third_of_trace(s, false), n = m->density;
  gg_rough_covariance(&s->form, &s->relative.f, &s->weight, s->a, false, M);
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++) P[i][j] = (i == 2) == (j == 2) ? m->sigma[0] / 2 * mean(s, s->relative.J[i][j]) : 0;
  gg_theory_answer_temperature(m, T, m->inertia[0] * third_of_trace(s, true) / T, a);
  gg_theory_answer_stress(m, T, (gg_stress){n * M[0][0], n * M[1][1], n * M[2][2], n * M[0][1], n * M[1][0]},
                          (gg_stress){n * P[0][0], n * P[1][1], n * P[2][2], n * P[0][1], n * P[1][0]}, a);
  answer_flights(m, mean(s, s->relative.rate), speed(s), a);
  a->value[GG_Q_DISSIPATION] = -a->value[GG_Q_P_XY] * m->shear_rate + m->stress_unit * n * from_bath(m, s);
  if (!m->boltzmann)
    a->value[GG_Q_SPIN_Z] = gg_rough_mean_spin(&s->form, &s->relative.f, &s->weight, s->a) * 2 / m->diameter[0];
  answer_cumulants(s, a);
  a->value[GG_Q_SKEWNESS_WZ] = cumulant(s, true, 2, 3);
}

static gg_theory_answer nothing(void)
{
  gg_theory_answer a = {.remark = ""};
  for (int q = 0; q < GG_MOST_QUANTITIES; q++) a.value[q] = a.error[q] = NAN;
  return a;
}

static void set_angle_error(gg_theory_answer *a)
{
  double *value = &a->value[GG_Q_COS2_PSI], *error = &a->error[GG_Q_COS2_PSI];
  *error += rough_angle + lacks * fabs(*value - 1. / 3);
  if (!(*error < poor_angle)) *value = *error = NAN;
}

static gg_status refuse_poor(const gg_theory_answer *a, gg_quantity judge, double limit, gg_error *err)
{
  double left = a->error[judge] / fabs(a->value[judge]);
  if (left < limit) return GG_OK;
  return gg_theory_reject(err, name, "does not converge here: it is still %.1g %% off", 100 * left);
}

static bool gaussian_start(const gg_model *m, gg_rough_weight *w)
{
  gg_gaussian start[GG_MAX_SPECIES];
  if (!(gg_theory_gaussian_steady(m, start) < 1e-6)) return false;
  w->spin = start[0].spin;
  return gg_hermite_cholesky(start[0].M.at, w->L) && gg_hermite_cholesky(start[0].Theta.at, w->S);
}

/* The latest approximation first. */
static void keep(const gg_rough_steady *s, gg_rough_marginals *to)
{
  if (!to) return;
  memmove(to->of[1], to->of[0], 2 * sizeof to->of[0]);
  for (int k = 0; k < 6; k++) to->of[0][k / 3][k % 3] = gg_rough_component_of(s, k / 3, k % 3);
}

static gg_status solve_degrees(const gg_model *m, gg_rough_steady *s, gg_theory_answer rung[], gg_rough_marginals *kept,
                               gg_error *err)
{
  gg_error why;
  for (int degree = FIRST_DEGREE; degree <= LAST_DEGREE; degree++) {
    gg_theory_answer *a = &rung[degree - FIRST_DEGREE];
    *a = nothing();
    if (gg_rough_shear_solve(s, degree, &why) != GG_OK)
      return gg_theory_reject(err, name, "fails here: %s",
                              gg_theory_is_nearly_elastic(m) ? "the loss of energy is below numerical resolution"
                                                             : why.message);
    answer_shear(m, s, a);
    keep(s, kept);
    if (!gg_rough_follow(s)) return gg_theory_reject(err, name, "fails here: no second moments");
  }
  return GG_OK;
}

static gg_status sheared(const gg_model *m, gg_theory_answer *a, gg_rough_marginals *kept, gg_error *err)
{
  gg_theory_answer rung[LAST_DEGREE - FIRST_DEGREE + 1];
  gg_rough_steady s = begin(m, &moments);
  GG_TRY(gg_theory_require_steady_shear(m, name, err));
  s.stream = (gg_rough_stream){.spin = m->bath.spin_drag[0],
                               .rolling = gg_model_rolling(m, 0),
                               .diffusion = m->bath.noise[0] / 2,
                               .spin_diffusion = m->bath.spin_noise[0] / 2};
  for (int i = 0; i < 3; i++) s.stream.velocity[i][i] = m->bath.drag[0];
  s.stream.velocity[0][1] = m->shear_rate;
  if (!gaussian_start(m, &s.weight)) return gg_theory_reject(err, name, "fails here: no steady state was found");
  gg_status status = solve_degrees(m, &s, rung, kept, err);
  gg_rough_steady_clear(&s);
  GG_TRY(status);
  for (int q = 0; q < GG_N_QUANTITIES; q++) {
    double even = rung[2].value[q], odd = rung[1].value[q], first = rung[0].value[q];
    a->value[q] = (even + odd) / 2;
    a->error[q] = fmax(fabs(even - odd), fabs(even - first)) / 2 + left_out * fabs(a->value[q]);
  }
  set_angle_error(a);
  return refuse_poor(a, GG_Q_TEMPERATURE, poor, err);
}

/* At T = 1, in units of its own rates. */
static void answer_isotropic(const gg_model *m, const gg_rough_steady *s, const gg_heating *heating, double x,
                             gg_theory_answer *a)
{
  double ratio = m->inertia[0] * third_of_trace(s, true);
  double T = gg_theory_heating_temperature(heating, x, m->temperature0), p = m->density * T;
  double cooling = 2 * (s->stream.diffusion - s->stream.velocity[0][0]); /* of translation */
  answer_cumulants(s, a);
  a->value[GG_Q_A2] = a->value[GG_Q_KURTOSIS_CX] / 3 - 1;
  a->value[GG_Q_TEMPERATURE_RATIO] = ratio;
  a->value[GG_Q_COOLING_RATE] = cooling / gg_common_model_nu0(m, 1);
  if (heating->kind == GG_HEATING_NOISE || m->linear_response) return; /* the state determines its temperature */
  gg_theory_answer_temperature(m, T, ratio, a);
  gg_theory_answer_pressure(m, T, p, p * m->sigma[0] / 6 * mean(s, s->relative.J[2][2]),
                            a); /* one direction: the trace */
  answer_flights(m, mean(s, s->relative.rate) * sqrt(T), speed(s) * sqrt(T), a);
}

/* In units of 15/(4 nu_0), at n = T = m = 1. */
static gg_status answer_heat(const gg_model *m, const gg_rough_steady *s, gg_theory_answer *a, gg_error *err)
{
  gg_rough_heat heat;
  const gg_hermite_density density = {gg_theory_phi_chi(m), m->chi_slope};
  const double unit = 15 / (4 * gg_common_model_nu0(m, 1));
  GG_TRY(gg_rough_heat_of(s, density, &heat, err));
  a->value[GG_Q_THERMAL_CONDUCTIVITY_REDUCED] = heat.conductivity[0] / unit;
  a->value[GG_Q_THERMAL_CONDUCTIVITY_REDUCED_KINETIC] = heat.conductivity_kinetic[0] / unit;
  a->value[GG_Q_ROTATIONAL_CONDUCTIVITY_REDUCED] = heat.conductivity[1] / unit;
  a->value[GG_Q_DIFFUSIVE_HEAT_CONDUCTIVITY_REDUCED] = m->elastic ? 0 : heat.diffusive[0] / unit;
  a->value[GG_Q_ROTATIONAL_DIFFUSIVE_CONDUCTIVITY_REDUCED] = m->elastic ? 0 : heat.diffusive[1] / unit;
  return GG_OK;
}

static gg_status answer_viscosity(const gg_model *m, const gg_rough_steady *s, gg_theory_answer *a, gg_error *err)
{
  gg_rough_viscosity v;
  const double fading = gg_theory_thermostat_factor(m) == 0.5, nu0 = gg_common_model_nu0(m, 1);
  GG_TRY(gg_rough_viscosity_of(s, gg_theory_phi_chi(m), fading, &v, err));
  a->value[GG_Q_VISCOSITY_REDUCED_KINETIC] = v.kinetic * nu0;
  a->value[GG_Q_VISCOSITY_REDUCED] = v.total * nu0;
  return GG_OK;
}

/* With friction: response to a shear so slow, beside collisions, that its square is below other errors. */
static gg_status answer_slow_shear(const gg_model *m, const gg_rough_steady *isotropic, gg_theory_answer *a,
                                   gg_error *err)
{
  const double cools = gg_theory_thermostat_factor(m) == 0.5 ? -isotropic->stream.velocity[0][0] : 0;
  const double rate = 1e-3 * isotropic->gas.frequency, nu0 = gg_common_model_nu0(m, 1);
  double M[3][3];
  gg_rough_steady s = {.choice = isotropic->choice, .gas = isotropic->gas, .stream = isotropic->stream};
  s.stream.velocity[0][1] = rate;
  s.stream.rolling = m->boltzmann ? 0 : -rate * m->diameter[0] / 4;
  s.gas.shear = m->boltzmann ? 0 : m->sigma[0] * rate;
  gg_status status = gg_rough_slow_shear_solve(&s, isotropic, cools, err);
  if (status == GG_OK) {
    gg_rough_covariance(&s.form, &s.relative.f, &s.weight, s.a, false, M);
    const double J = (mean(&s, s.relative.J[0][1]) + mean(&s, s.relative.J[1][0])) / 2;
    const double transferred = m->boltzmann ? 0 : m->sigma[0] / 2 * J;
    a->value[GG_Q_VISCOSITY_REDUCED_KINETIC] = -M[0][1] / rate * nu0;
    a->value[GG_Q_VISCOSITY_REDUCED] = -(M[0][1] + transferred) / rate * nu0;
  }
  gg_rough_steady_clear(&s);
  return status;
}

/* A sequence of solutions, the weight of each from the last. */
static gg_status isotropic(const gg_model *m, gg_rough_steady *s, int degree, gg_theory_answer *a,
                           gg_rough_marginals *kept, gg_error *err)
{
  const gg_heating heating = gg_theory_heating_of(m);
  double x;
  *a = nothing();
  GG_TRY(gg_rough_isotropic_solve(s, degree, &heating, &x, err));
  answer_isotropic(m, s, &heating, x, a);
  keep(s, kept);
  if (!kept && m->rule == GG_FRICTIONAL && degree <= LAST_DEGREE) GG_TRY(answer_slow_shear(m, s, a, err));
  if (!kept && m->rule != GG_FRICTIONAL) GG_TRY(answer_viscosity(m, s, a, err));
  if (!kept && m->rule != GG_FRICTIONAL && m->flow == GG_HCS) GG_TRY(answer_heat(m, s, a, err));
  return gg_rough_follow(s) ? GG_OK : gg_base_fail(err, GG_FAILED, "no second moments");
}

static double maxwellian_ratio(const gg_model *m)
{
  const gg_grain g = gg_theory_grain_of(m);
  const double mu = m->contact[0][0].mu;
  return gg_theory_heating_of(m).kind == GG_HEATING_COOLS ? gg_theory_ratio_cooling(g, mu)
                                                          : gg_theory_ratio_driven(g, mu);
}

static const gg_quantity of_heat[] = {GG_Q_THERMAL_CONDUCTIVITY_REDUCED, GG_Q_THERMAL_CONDUCTIVITY_REDUCED_KINETIC,
                                      GG_Q_DIFFUSIVE_HEAT_CONDUCTIVITY_REDUCED, GG_Q_ROTATIONAL_CONDUCTIVITY_REDUCED,
                                      GG_Q_ROTATIONAL_DIFFUSIVE_CONDUCTIVITY_REDUCED};

/* Error of heat fluxes. Their series oscillates: two degrees may agree by chance, so that the change before counts,
 * too. It is an estimate: degree 10 differs by less at e = 0.9, by up to 1.7 errors at e = 0.8, beta = 0.2, by 2.3
 * at e = 0.7, beta = 0. There is no answer if the error is above `poor`, of the value itself or of kappa: mu
 * vanishes where spins have no effect. */
static void set_heat_errors(const gg_theory_answer *first, const gg_theory_answer *before, gg_theory_answer *now)
{
  for (size_t k = 0; k < sizeof of_heat / sizeof *of_heat; k++) {
    double *value = &now->value[of_heat[k]], *error = &now->error[of_heat[k]];
    *error = fmax(*error, fabs(before->value[of_heat[k]] - first->value[of_heat[k]]) / 5);
    if (*error > poor * fmax(fabs(*value), fabs(now->value[GG_Q_THERMAL_CONDUCTIVITY_REDUCED]))) *value = *error = NAN;
  }
}

/* The viscosity with friction ends one degree earlier: its operator is that of all directions. */
static void take_slow_shear(const gg_theory_answer *first, const gg_theory_answer *last, gg_theory_answer *to)
{
  static const gg_quantity of[] = {GG_Q_VISCOSITY_REDUCED, GG_Q_VISCOSITY_REDUCED_KINETIC};
  for (int k = 0; k < 2; k++) {
    to->value[of[k]] = last->value[of[k]];
    to->error[of[k]] = fabs(last->value[of[k]] - first->value[of[k]]) + left_out * fabs(last->value[of[k]]);
  }
}

/* Degree after degree; the error is the change by the last one. */
static gg_status converge_isotropic(const gg_model *m, const gg_rough_choice *choice, double ratio, double limit,
                                    gg_theory_answer *a, gg_rough_marginals *kept, gg_error *err)
{
  gg_theory_answer now = nothing(), before = now, first = now;
  gg_error why;
  gg_status status = GG_OK;
  gg_rough_steady s = begin(m, choice);
  for (int i = 0; i < 3; i++) s.weight.S[i][i] = sqrt(choice->spin_width * ratio / m->inertia[0]);
  for (int degree = FIRST_DEGREE; status == GG_OK && degree <= LAST_ISOTROPIC; degree += 2) {
    first = before, before = now;
    status = isotropic(m, &s, degree, &now, kept, &why);
  }
  gg_rough_steady_clear(&s);
  if (status != GG_OK) return gg_theory_reject(err, name, "fails here: %s", why.message);
  for (int q = 0; q < GG_N_QUANTITIES; q++) now.error[q] = fabs(now.value[q] - before.value[q]);
  if (m->rule == GG_FRICTIONAL) take_slow_shear(&first, &before, &now);
  set_heat_errors(&first, &before, &now);
  set_angle_error(&now);
  GG_TRY(refuse_poor(&now, GG_Q_TEMPERATURE_RATIO, limit, err));
  *a = now;
  return GG_OK;
}

static gg_status homogeneous(const gg_model *m, gg_theory_answer *a, gg_rough_marginals *kept, gg_error *err)
{
  GG_TRY(gg_theory_require_lasting(m, name, err));
  double ratio = maxwellian_ratio(m);
  if (isnan(ratio)) return gg_theory_reject(err, name, "finds no steady theta/T");
  gg_status status = GG_FAILED;
  if (m->rule == GG_FRICTIONAL) {
    const bool cools = gg_theory_heating_of(m).kind == GG_HEATING_COOLS;
    return converge_isotropic(m, cools ? &wider_spins : &moments, ratio, poor, a, kept, err);
  }
  for (int i = 0; i < CHOICES && status != GG_OK; i++)
    status = converge_isotropic(m, &tails[i], ratio, i + 1 < CHOICES ? restless : poor, a, kept, err);
  if (status == GG_OK && m->flow == GG_HCS) gg_theory_answer_critical_lengths(m, a->value[GG_Q_TEMPERATURE_RATIO], a);
  return status;
}

static gg_status solve(const gg_model *m, gg_theory_answer *a, gg_rough_marginals *kept, gg_error *err)
{
  if (m->flow == GG_HEATED_SHEAR && !m->bath.on)
    return gg_theory_reject(err, name, "has no heated shear of rough grains");
  return m->shear_rate != 0 && !m->linear_response ? sheared(m, a, kept, err) : homogeneous(m, a, kept, err);
}

gg_status gg_rough_answer(const gg_model *m, gg_theory_answer *a, gg_error *err)
{
  return solve(m, a, NULL, err);
}

gg_status gg_rough_marginals_of(const gg_model *m, gg_rough_marginals *marginals, gg_error *err)
{
  gg_theory_answer a = nothing();
  return solve(m, &a, marginals, err);
}
