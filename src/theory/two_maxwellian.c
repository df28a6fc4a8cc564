/* SPDX-License-Identifier: GPL-3.0-or-later */
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
 *   dE_rot = -(r/K) <J_t g_t>/(1 + r/K) + <J_t^2>/K,    P(slide) = cos^2 psi_0
 * With delta = pi/2 - psi_0 = atan(u), and mu eta_1 = eta_2 sqrt(V/2)/u, no large mu multiplies a small difference:
 *   <J_t g_t> = eta_2 V [2 cos^4 delta + (delta - sin(4 delta)/4)/u],   <J_t^2> = 2 eta_2^2 V cos^2 delta */
#include "theory/two_maxwellian.h"

#include <math.h>

#include "theory/answer.h"

typedef struct contact_law {
  gg_grain grain;
  double mu;
} contact_law;

static double contact_spread(gg_grain g, double ratio)
{
  return 2 * (1 + ratio / g.K);
}

/* u: a contact slides where its tangent of the angle of impact, in units of the mean, is above it; > 0. */
static double sliding_tangent(gg_grain g, double mu, double ratio)
{
  return g.eta2 / (mu * g.eta1) * sqrt(contact_spread(g, ratio) / 2);
}

double gg_theory_sliding_fraction(gg_grain g, double mu, double ratio)
{
  if (isinf(mu)) return 0;
  double u = sliding_tangent(g, mu, ratio);
  return 1 / (1 + 1 / (u * u));
}

/* A, B, C of constant beta. */
typedef struct rough_rates {
  double A, B, C;
} rough_rates;

static rough_rates rates_of(gg_grain g)
{
  double turned = g.eta2 / g.K;
  return (rough_rates){g.eta1 * (1 - g.eta1) + g.eta2 * (1 - g.eta2), g.eta2 * turned, turned * (1 - turned)};
}

static gg_exchange constant_beta(gg_grain g, double r)
{
  rough_rates x = rates_of(g);
  return (gg_exchange){-4 * (x.A - x.B * r), 4 * (x.B - x.C * r)};
}

/* delta - sin(4 delta)/4, (8/3) delta^3 for small delta: there from the series of the sine. */
static double cubic_excess(double delta)
{
  double x = 4 * delta, x2 = x * x;
  if (x > 0.2) return delta - sin(x) / 4;
  return x * x2 / 24 * (1 - x2 / 20 * (1 - x2 / 42 * (1 - x2 / 72 * (1 - x2 / 110))));
}

/* <J_t g_t> of friction. */
static double tangential_work(gg_grain g, double V, double u)
{
  const double delta = atan(u), c2 = 1 / (1 + u * u);
  return g.eta2 * V * (2 * c2 * c2 + (u > 0 ? cubic_excess(delta) / u : 0));
}

double gg_theory_mean_grip(gg_grain g, double mu, double r)
{
  const double V = contact_spread(g, r);
  return g.eta2 == 0 ? 0 : tangential_work(g, V, sliding_tangent(g, mu, r)) / (2 * V);
}

gg_exchange gg_theory_exchange_at(gg_grain g, double mu, double r)
{
  if (isinf(mu)) return constant_beta(g, r);
  double V = contact_spread(g, r), u = sliding_tangent(g, mu, r);
  double Jg = tangential_work(g, V, u), JJ = 2 * g.eta2 * g.eta2 * V / (1 + u * u);
  double lost = Jg / (1 + r / g.K);
  return (gg_exchange){-4 * g.eta1 * (1 - g.eta1) - lost + JJ, -r / g.K * lost + JJ / g.K};
}

double gg_theory_cooling_at(gg_grain g, double mu, double r)
{
  gg_exchange x = gg_theory_exchange_at(g, mu, r);
  return r > 1 ? -x.rotation / r : -x.translation;
}

/* The sign is that of d(theta/T)/dt: a root where it falls through zero is stable. */
static double growth_driven(double ratio, void *law)
{
  const contact_law *l = law;
  return gg_theory_exchange_at(l->grain, l->mu, ratio).rotation;
}

static double growth_cooling(double ratio, void *law)
{
  const contact_law *l = law;
  gg_exchange e = gg_theory_exchange_at(l->grain, l->mu, ratio);
  return e.rotation - ratio * e.translation;
}

/* The stable ratio that a gas without initial spin reaches. */
static double attractor(double (*growth)(double, void *), gg_grain grain, double mu)
{
  contact_law law = {grain, mu};
  for (double low = 1e-40; low < 1e40; low *= 1.5)
    if (growth(low, &law) >= 0 && growth(1.5 * low, &law) < 0)
      return gg_theory_root_between(growth, &law, low, 1.5 * low);
  return NAN;
}

double gg_theory_ratio_driven(gg_grain grain, double mu)
{
  rough_rates x = rates_of(grain);
  return isinf(mu) ? x.B / x.C : attractor(growth_driven, grain, mu);
}

/* Constant beta: the positive root of B r^2 - (A - C) r - B = 0, by the form without cancellation. */
static double positive_root(rough_rates x)
{
  double d = x.A - x.C, root = hypot(d, 2 * x.B);
  return d > 0 ? (d + root) / (2 * x.B) : 2 * x.B / (root - d);
}

double gg_theory_ratio_cooling(gg_grain grain, double mu)
{
  return isinf(mu) ? positive_root(rates_of(grain)) : attractor(growth_cooling, grain, mu);
}
