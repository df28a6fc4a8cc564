/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Dilute uniform shear by Grad's method, with the production of stress linearised: one species, smooth (J.J. Brey, M.J.
 * Ruiz-Montero & F. Moreno, Phys. Rev. E 55 (1997) 2846; A. Santos, V. Garzo & J.W. Dufty, Phys. Rev. E 69 (2004)
 * 061303) or rough. Rates in units of nu_0 = (16/5) sqrt(pi) n d^2 sqrt(T), r = theta/T, shear rate a:
 *   zeta = 5/3 [eta_1 (1 - eta_1) + eta_2 (1 - eta_2) - eta_2^2 r/K]
 *   nu   = (eta_1 + eta_2)(2 - eta_1 - eta_2) + eta_2^2 r/(6K)
 *   a^2  = (3/2) zeta nu^2/(nu - zeta),   P_yy = P_zz = nT (1 - zeta/nu),   P_xy = -nT (nu - zeta) a/nu^2
 * For smooth grains nu = beta_1 + zeta, beta_1 = (1+e)(2+e)/6. */
#include <math.h>

#include "theory/lun1991.h"
#include "theory/mixture.h"
#include "theory/range.h"
#include "theory/theory_list.h"
#include "theory/two_maxwellian.h"

static const char name[] = "grad";

static gg_status one_species(const gg_model *m, gg_theory_answer *a, gg_error *err)
{
  gg_grain g = gg_theory_grain_of(m);
  double ratio = gg_theory_lun_ratio(g), h = g.eta1 + g.eta2;
  double zeta = -5. / 12 * gg_theory_exchange_at(g, INFINITY, ratio).translation;
  double nu = h * (2 - h) + g.eta2 * g.eta2 * ratio / (6 * g.K);
  if (!(nu > zeta))
    return gg_theory_reject(err, name, "finds no steady state: grains lose energy faster than stress relaxes");
  double shear = sqrt(1.5 * zeta * nu * nu / (nu - zeta)); /* a* */
  double sqrtT = m->shear_rate / (shear * gg_common_model_nu0(m, 1)), T = sqrtT * sqrtT, p = m->density * T;
  double yy = p * (1 - zeta / nu), xy = -p * (nu - zeta) * shear / (nu * nu);
  gg_theory_answer_temperature(m, T, ratio, a);
  gg_theory_answer_stress(m, T, (gg_stress){3 * p - 2 * yy, yy, yy, xy, xy}, GG_STRESS_NEGLECTED, a);
  gg_theory_answer_collisions_one(m, T, a);
  a->value[GG_Q_DISSIPATION] = -a->value[GG_Q_P_XY] * m->shear_rate;
  return GG_OK;
}

/* Dilute uniform shear of a smooth binary mixture by Grad's method: J.M. Montanero & V. Garzo, Physica A 310 (2002) 17.
 * With a_i = T_i/m_i, Pi_i = <V V>_i - a_i, and the relaxation matrix A of Pi:
 *   sum_j A_ij Pi_j,yy = -zeta_i a_i,   sum_j A_ij Pi_j,xy = -rate (a_i + Pi_i,yy),   -2 rate Pi_i,xy = 3 zeta_i a_i
 * The first two are linear; the third, at the same rate for both species, gives T_1/T_2 and then T. */
typedef struct grad_state {
  double a[GG_BINARY], yy[GG_BINARY], xy[GG_BINARY]; /* Pi_yy; Pi_xy per unit shear rate */
  double rate2[GG_BINARY];                           /* square of the shear rate that sustains T_i */
} grad_state;

static grad_state state_at(const gg_model *m, double T, double ratio)
{
  grad_state s;
  double A[GG_BINARY][GG_BINARY], loss[GG_BINARY], drive[GG_BINARY];
  gg_theory_partial_spreads(m, T, ratio, s.a);
  gg_theory_stress_relaxation(m, s.a, A);
  for (int i = 0; i < 2; i++) loss[i] = -gg_theory_zeta(m, i, s.a).at0 * s.a[i];
  gg_theory_solve2(A, loss, s.yy);
  for (int i = 0; i < 2; i++) drive[i] = -(s.a[i] + s.yy[i]);
  gg_theory_solve2(A, drive, s.xy);
  for (int i = 0; i < 2; i++) s.rate2[i] = 1.5 * loss[i] / s.xy[i];
  return s;
}

/* Zero if one shear rate sustains both temperatures. */
static double mismatch(double ratio, void *model)
{
  grad_state s = state_at(model, 1, ratio);
  return s.xy[1] * s.rate2[0] * s.xy[0] - s.xy[0] * s.rate2[1] * s.xy[1];
}

static gg_status mixture(const gg_model *m, const char *theory, gg_theory_answer *a, gg_error *err)
{
  gg_model copy = *m;
  double ratio = gg_theory_solve_ratio(mismatch, &copy);
  grad_state s = state_at(m, 1, ratio);
  if (!(s.rate2[0] > 0)) return gg_theory_reject(err, theory, "finds no steady state for this mixture");
  double T = m->shear_rate * m->shear_rate / s.rate2[0]; /* rates are proportional to sqrt(T) */
  s = state_at(m, T, ratio);
  gg_theory_answer_partial_temperatures(m, s.a, a);
  gg_stress P = {0, 0, 0, 0, 0};
  for (int i = 0; i < 2; i++) {
    double rho = m->density * gg_theory_fraction(m, i) * m->mass[i];
    P.yy += rho * (s.a[i] + s.yy[i]);
    P.zz += rho * (s.a[i] + s.yy[i]);
    P.xx += rho * (s.a[i] - 2 * s.yy[i]);
    P.xy += rho * s.xy[i] * m->shear_rate;
  }
  P.yx = P.xy;
  gg_theory_answer_stress(m, T, P, GG_STRESS_NEGLECTED, a);
  a->value[GG_Q_DISSIPATION] = -a->value[GG_Q_P_XY] * m->shear_rate;
  return GG_OK;
}

static gg_status evaluate(const gg_model *m, gg_theory_answer *a, gg_error *err)
{
  GG_TRY(gg_theory_require_at_most_two_species(m, name, err));
  GG_TRY(gg_theory_require_constant_beta(m, name, err));
  GG_TRY(gg_theory_require_steady_shear(m, name, err));
  GG_TRY(gg_theory_require_dilute(m, name, err));
  gg_model dilute = *m; /* Boltzmann's equation: chi = 1, in collision rates as well */
  for (int pair = 0; pair < GG_PAIRS; pair++) dilute.chi[pair] = 1;
  if (m->n_species == 1) return one_species(&dilute, a, err);
  GG_TRY(gg_theory_require_smooth(m, name, err));
  return mixture(&dilute, name, a, err);
}

const gg_theory gg_theory_grad = {
    .name = name,
    .flows = GG_FLOW_BIT(GG_USF),
    .title = "Linear Grad theory of dilute shear",
    .citation = "J.J. Brey, M.J. Ruiz-Montero and F. Moreno, Phys. Rev. E 55 (1997) 2846; J.M. Montanero and V. Garzo, "
                "Physica A 310 (2002) 17",
    .answers = "temperature rotational_temperature temperature_ratio pressure compressibility_factor shear_viscosity "
               "N1 N2 " GG_ANSWERS_STRESS GG_ANSWERS_RATES "dissipation " GG_ANSWERS_MIXTURE,
    .assumptions =
        "Steady uniform shear of a dilute gas (Boltzmann's equation, phi up to 0.05). T is 3 % high at e = 0.9, 12 % "
        "in mixtures at e = 0.75; N2 = 0. One species, smooth or of constant beta, or a smooth binary mixture.",
    .evaluate = evaluate,
    .beyond = gg_theory_beyond_linear_anisotropy,
};
