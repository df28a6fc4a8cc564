/* Exchange of energy between translation and rotation of rough grains, with r = theta/T, per collision, m = T = 1.
 *
 * Constant beta: M. Huthmann & A. Zippelius, Phys. Rev. E 56 (1997) R6275; A. Santos, G.M. Kremer & V. Garzo, Prog.
 * Theor. Phys. Suppl. 184 (2010) 31:
 *   dE_tr = -4 (A - B r),   dE_rot = 4 (B - C r)
 *   A = eta_1 (1 - eta_1) + eta_2 (1 - eta_2),   B = eta_2^2/K,   C = (eta_2/K)(1 - eta_2/K)
 *
 * Coulomb friction: O. Herbst, M. Huthmann & A. Zippelius, Granular Matter 2 (2000) 211. Tangential and normal contact
 * velocities are independent, <g_t^2> = 2V with V = 2(1 + r/K), and collisions with cot(psi) > u = cot(psi_0) slide,
 * u = eta_2 sqrt(V/2)/(mu eta_1):
 *   <J_t g_t> = 2 eta_2 V sin^4 psi_0 + mu eta_1 sqrt(2V) (pi/2 - psi_0 + sin(4 psi_0)/4)
 *   <J_t^2>   = 2 eta_2^2 V sin^4 psi_0 + 4 mu^2 eta_1^2 cos^4 psi_0
 *   dE_tr  = -4 eta_1 (1 - eta_1) - <J_t g_t>/(1 + r/K) + <J_t^2>
 *   dE_rot = -(r/K) <J_t g_t>/(1 + r/K) + <J_t^2>/K,    P(slide) = cos^2 psi_0 */
#include "theory/two_maxwellian.h"

#include <math.h>

#include "theory/root.h"

typedef struct contact_law {
  gg_grain grain;
  double mu;
} contact_law;

static double contact_spread(gg_grain g, double ratio)
{
  return 2 * (1 + ratio / g.K);
}

static double critical_angle(gg_grain g, double mu, double ratio)
{
  return atan2(1, g.eta2 / (mu * g.eta1) * sqrt(contact_spread(g, ratio) / 2));
}

double gg_sliding_share(gg_grain g, double mu, double ratio)
{
  if (isinf(mu)) return 0;
  double c = cos(critical_angle(g, mu, ratio));
  return c * c;
}

static gg_exchange constant_beta(gg_grain g, double r)
{
  double A = g.eta1 * (1 - g.eta1) + g.eta2 * (1 - g.eta2), B = g.eta2 * g.eta2 / g.K;
  double C = g.eta2 / g.K * (1 - g.eta2 / g.K);
  return (gg_exchange){-4 * (A - B * r), 4 * (B - C * r)};
}

gg_exchange gg_exchange_at(gg_grain g, double mu, double r)
{
  if (isinf(mu)) return constant_beta(g, r);
  double V = contact_spread(g, r), psi = critical_angle(g, mu, r), s4 = pow(sin(psi), 4), c4 = pow(cos(psi), 4);
  double Jg = 2 * g.eta2 * V * s4 + mu * g.eta1 * sqrt(2 * V) * (M_PI_2 - psi + sin(4 * psi) / 4);
  double JJ = 2 * g.eta2 * g.eta2 * V * s4 + 4 * mu * mu * g.eta1 * g.eta1 * c4;
  double lost = Jg / (1 + r / g.K);
  return (gg_exchange){-4 * g.eta1 * (1 - g.eta1) - lost + JJ, -r / g.K * lost + JJ / g.K};
}

/* Signs are those of d(theta/T)/dt: a root where it falls through zero attracts. */
static double growth_driven(double ratio, void *law)
{
  const contact_law *l = law;
  return gg_exchange_at(l->grain, l->mu, ratio).rotation;
}

static double growth_cooling(double ratio, void *law)
{
  const contact_law *l = law;
  gg_exchange e = gg_exchange_at(l->grain, l->mu, ratio);
  return e.rotation - ratio * e.translation;
}

/* The attracting ratio that a gas reaches which starts without spin. */
static double attractor(double (*growth)(double, void *), gg_grain grain, double mu)
{
  contact_law law = {grain, mu};
  for (double low = 1e-12; low < 1e12; low *= 1.5)
    if (growth(low, &law) >= 0 && growth(1.5 * low, &law) < 0) return gg_root_between(growth, &law, low, 1.5 * low);
  return NAN;
}

double gg_ratio_driven(gg_grain grain, double mu)
{
  return attractor(growth_driven, grain, mu);
}

double gg_ratio_cooling(gg_grain grain, double mu)
{
  return attractor(growth_cooling, grain, mu);
}
