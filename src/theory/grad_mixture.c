/* Dilute uniform shear of a smooth binary mixture by Grad's method: J.M. Montanero & V. Garzo, Physica A 310 (2002) 17.
 * With a_i = T_i/m_i, Pi_i = <V V>_i - a_i, and the relaxation matrix A of Pi:
 *   sum_j A_ij Pi_j,yy = -zeta_i a_i,   sum_j A_ij Pi_j,xy = -rate (a_i + Pi_i,yy),   -2 rate Pi_i,xy = 3 zeta_i a_i
 * The first two are linear; the third, at the same rate for both species, gives T_1/T_2 and then T. */
#include <math.h>

#include "theory/grad.h"
#include "theory/mixture.h"

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

/* Zero where one shear rate sustains both temperatures. */
static double mismatch(double ratio, void *model)
{
  grad_state s = state_at(model, 1, ratio);
  return s.xy[1] * s.rate2[0] * s.xy[0] - s.xy[0] * s.rate2[1] * s.xy[1];
}

gg_status gg_theory_grad_mixture(const gg_model *m, const char *theory, gg_theory_answer *a, gg_error *err)
{
  gg_model copy = *m;
  double ratio = gg_theory_solve_ratio(mismatch, &copy);
  grad_state s = state_at(m, 1, ratio);
  if (!(s.rate2[0] > 0)) return gg_theory_reject(err, theory, "finds no steady state for this mixture");
  double T = m->shear_rate * m->shear_rate / s.rate2[0]; /* rates go as sqrt(T) */
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
