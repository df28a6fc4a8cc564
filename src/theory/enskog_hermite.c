/* Enskog's equation itself, solved without random numbers: an expansion of the distribution about an anisotropic
 * Gaussian, all collision integrals by quadrature, the steady state by Newton's method (theory/hermite). Degree after
 * degree, so that each number tells how far it is from its limit. Rough grains: theory/rough. */
#include <math.h>

#include "common/thermostat.h"
#include "theory/answer.h"
#include "theory/garzo_dufty1999.h"
#include "theory/hermite/isotropic.h"
#include "theory/hermite/mixture_answer.h"
#include "theory/hermite/rungs.h"
#include "theory/hermite/shear.h"
#include "theory/hermite/spectrum.h"
#include "theory/hermite/viscosity.h"
#include "theory/rough/answer.h"
#include "theory/theory_list.h"

static const char name[] = "enskog_hermite";

/* Degrees of shear and of the isotropic state. Shear goes beyond GOOD_DEGREE where errors are above `good` there. */
enum {
  FIRST_DEGREE = 4,
  GOOD_DEGREE = 10,
  LAST_DEGREE = 12,
  ISOTROPIC_DEGREE = 18,
  VISCOSITY_DEGREE = 8,
  SPECTRUM_DEGREE = 8
};
static const double good = 1e-4, isotropic_good = 1e-8;

static gg_stress stress_of(double factor, double P[3][3])
{
  return (gg_stress){factor * P[0][0], factor * P[1][1], factor * P[2][2], factor * P[0][1], factor * P[1][0]};
}

static double fourth_x(const double C[3])
{
  return C[0] * C[0] * C[0] * C[0];
}

static double fourth_y(const double C[3])
{
  return C[1] * C[1] * C[1] * C[1];
}

static double fourth_z(const double C[3])
{
  return C[2] * C[2] * C[2] * C[2];
}

static void answer_kurtoses(const gg_hermite_basis *b, const gg_hermite_state *s, double M[3][3], gg_theory_answer *a)
{
  a->value[GG_Q_KURTOSIS_CX] = gg_hermite_mean(b, s, fourth_x) / (M[0][0] * M[0][0]);
  a->value[GG_Q_KURTOSIS_CY] = gg_hermite_mean(b, s, fourth_y) / (M[1][1] * M[1][1]);
  a->value[GG_Q_KURTOSIS_CZ] = gg_hermite_mean(b, s, fourth_z) / (M[2][2] * M[2][2]);
}

static void answer_flights(const gg_model *m, double rate, double speed, gg_theory_answer *a)
{
  a->value[GG_Q_COLLISION_RATE] = rate;
  a->value[GG_Q_MEAN_FREE_PATH] = speed / rate;
  if (!m->boltzmann) a->value[GG_Q_KNUDSEN] = speed / rate / cbrt(m->volume);
}

static void answer_shear(gg_hermite_shear *h, gg_theory_answer *a)
{
  const gg_model *m = h->model;
  double M[3][3];
  gg_hermite_sums sums;
  gg_hermite_second_moments(&h->op.basis, h->state, M);
  gg_hermite_sums_at(&h->op, &h->gas, h->state, &sums);
  double T = (M[0][0] + M[1][1] + M[2][2]) / 3;
  gg_answer_temperature(m, T, NAN, a);
  gg_answer_stress(m, T, stress_of(m->density, M), stress_of(m->density, sums.transfer), a);
  answer_flights(m, sums.rate, sums.speed, a);
  a->value[GG_Q_DISSIPATION] = -a->value[GG_Q_P_XY] * m->shear_rate;
  answer_kurtoses(&h->op.basis, h->state, M, a);
}

/* The slowest of all modes: that of the temperature, mostly. */
static void answer_relaxation(gg_hermite_shear *h, gg_theory_answer *a)
{
  gg_error ignored;
  gg_hermite_mode mode[GG_HERMITE_MOST_FUNCTIONS];
  if (gg_hermite_spectrum(&h->op, &h->gas, h->state, mode, &ignored) == GG_OK)
    a->value[GG_Q_RELAXATION_RATE] = mode[0].decay;
}

/* `slow`: answers of its own, of the relaxation alone, which a low degree knows well. */
static gg_status climb(gg_hermite_shear *h, gg_rungs *rungs, gg_rungs *slow, gg_error *err)
{
  for (int degree = FIRST_DEGREE; degree <= LAST_DEGREE; degree += 2) {
    if (degree > GOOD_DEGREE && gg_rungs_error(rungs, GG_Q_TEMPERATURE) < good) break;
    gg_error why;
    if (gg_hermite_shear_solve(h, degree, &why) != GG_OK) return gg_refuse(err, name, "fails here: %s", why.message);
    answer_shear(h, gg_rungs_next(rungs));
    if (degree <= SPECTRUM_DEGREE) answer_relaxation(h, gg_rungs_next(slow));
  }
  return GG_OK;
}

static gg_status sheared(const gg_model *m, gg_theory_answer *a, gg_error *err)
{
  gg_hermite_shear h;
  gg_rungs rungs = {.n = 0}, slow = {.n = 0};
  GG_TRY(gg_require_steady_shear(m, name, err));
  gg_error why;
  if (gg_hermite_shear_begin(&h, m, &why) != GG_OK) return gg_refuse(err, name, "fails here: %s", why.message);
  gg_status status = climb(&h, &rungs, &slow, err);
  gg_hermite_shear_end(&h);
  if (status == GG_OK) status = gg_rungs_finish(&rungs, name, GG_Q_TEMPERATURE, a, err);
  if (status == GG_OK) {
    a->value[GG_Q_RELAXATION_RATE] = slow.answer[0].value[GG_Q_RELAXATION_RATE];
    a->error[GG_Q_RELAXATION_RATE] = gg_rungs_error_of(&slow, GG_Q_RELAXATION_RATE);
  }
  return status;
}

static double fourth(const double C[3])
{
  double square = C[0] * C[0] + C[1] * C[1] + C[2] * C[2];
  return square * square;
}

/* White noise is set to balance Maxwellians at temperature0 (thermostat.h). */
static double temperature_of(const gg_model *m, double cooling, bool noise)
{
  double e = m->e[0], maxwellian = 5. / 12 * m->chi[0] * (1 - e * e) * gg_model_nu0(m, 1);
  return m->temperature0 * (noise && cooling > 0 ? pow(maxwellian / cooling, 2. / 3) : 1);
}

static void answer_isotropic(const gg_model *m, gg_hermite_isotropic *h, bool noise, gg_theory_answer *a)
{
  gg_hermite_sums sums;
  gg_hermite_sums_at(&h->op, &h->gas, &h->state, &sums);
  double a2 = gg_hermite_mean(&h->op.basis, &h->state, fourth) / 15 - 1;
  a->value[GG_Q_A2] = a2;
  a->value[GG_Q_KURTOSIS_CX] = a->value[GG_Q_KURTOSIS_CY] = a->value[GG_Q_KURTOSIS_CZ] = 3 * (1 + a2);
  a->value[GG_Q_COOLING_RATE] = h->cooling_rate / gg_model_nu0(m, 1);
  if (m->linear_response) return; /* no temperature of its own: it grows */
  double T = temperature_of(m, h->cooling_rate, noise), p = m->density * T;
  gg_answer_temperature(m, T, NAN, a);
  gg_answer_pressure(m, T, p, p * sums.transfer[2][2] / 3, a); /* all along the one direction: the trace */
  answer_flights(m, sums.rate * sqrt(T), sums.speed * sqrt(T), a);
}

static gg_status answer_viscosity(const gg_model *m, gg_hermite_isotropic *h, gg_theory_answer *a, gg_error *err)
{
  gg_hermite_viscosity v;
  double fading = gg_thermostat_share(m) == 0.5 ? h->cooling_rate / 2 : 0, nu0 = gg_model_nu0(m, 1);
  GG_TRY(gg_hermite_viscosity_of(&h->gas, &h->state, h->op.basis.degree, !m->boltzmann, fading, &v, err));
  a->value[GG_Q_VISCOSITY_REDUCED_KINETIC] = v.kinetic * nu0;
  a->value[GG_Q_VISCOSITY_REDUCED] = v.total * nu0;
  return GG_OK;
}

/* The isotropic state is cheap, its viscosity is not: that one up to a lower degree, from which on its series does
 * nothing any more. */
static gg_status homogeneous(const gg_model *m, gg_theory_answer *a, gg_error *err)
{
  gg_rungs rungs = {.n = 0}, viscous = {.n = 0};
  bool noise = gg_thermostat_of(m) == GG_WHITE_NOISE;
  double frequency = m->density * m->chi[0] * m->sigma[0] * m->sigma[0];
  GG_TRY(gg_require_smooth(m, name, err));
  for (int degree = FIRST_DEGREE; degree <= ISOTROPIC_DEGREE; degree += 2) {
    if (degree > GOOD_DEGREE && gg_rungs_error(&rungs, GG_Q_COOLING_RATE) < isotropic_good) break;
    gg_hermite_isotropic h;
    gg_error why;
    gg_status status = gg_hermite_isotropic_solve(&h, degree, frequency, m->contact[0][0].jn, noise, &why);
    if (status != GG_OK) return gg_refuse(err, name, "fails here: %s", why.message);
    answer_isotropic(m, &h, noise, gg_rungs_next(&rungs));
    if (degree <= VISCOSITY_DEGREE) status = answer_viscosity(m, &h, gg_rungs_next(&viscous), &why);
    gg_hermite_isotropic_end(&h);
    if (status != GG_OK) return gg_refuse(err, name, "fails here: %s", why.message);
  }
  GG_TRY(gg_rungs_finish(&rungs, name, GG_Q_COOLING_RATE, a, err));
  const gg_quantity viscosity[] = {GG_Q_VISCOSITY_REDUCED, GG_Q_VISCOSITY_REDUCED_KINETIC};
  for (int i = 0; i < 2; i++) {
    a->value[viscosity[i]] = viscous.answer[0].value[viscosity[i]];
    a->error[viscosity[i]] = gg_rungs_error_of(&viscous, viscosity[i]);
  }
  return GG_OK;
}

static gg_status evaluate(const gg_model *m, gg_theory_answer *a, gg_error *err)
{
  GG_TRY(gg_require_constant_beta(m, name, err));
  if (m->n_species > 1) return gg_hermite_mixture_answer(m, a, err);
  if (m->rule == GG_ROUGH) return gg_rough_answer(m, a, err);
  return m->flow == GG_USF ? sheared(m, a, err) : homogeneous(m, a, err);
}

const gg_theory gg_enskog_hermite = {
    .name = name,
    .flows = GG_FLOW_BIT(GG_HCS) | GG_FLOW_BIT(GG_HSS) | GG_FLOW_BIT(GG_USF) | GG_FLOW_BIT(GG_SMALL_SHEAR),
    .title = "Enskog's equation, solved by expansion without random numbers",
    .citation = "J.J. Brey, J.W. Dufty and A. Santos, J. Stat. Phys. 87 (1997) 1051, for the equation",
    .assumptions =
        "One species at any density, smooth or of constant beta: steady uniform shear, free cooling, heated states, "
        "and of smooth grains their viscosity; smooth mixtures that cool or are heated. Molecular chaos, and nothing "
        "else: what is left is a numerical error, of smooth grains mostly below 0.01 % (0.1 % in dilute shear of "
        "e = 0.5), of rough ones 0.1 % for e from 0.7.",
    .evaluate = evaluate,
};
