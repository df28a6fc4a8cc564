/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Arriving grains have the normal speed v with density v exp(-v^2/2T_n), and the tangential velocity g with variance V
 * about the drift G. A contact takes the impulse min(alpha g, alpha r v) along g, r = mu (1+e)/alpha: it slides where
 * g > r v. With w = g^2/(2 r^2 T_n), E = exp(-w), F = int_0^(g/r) v^2 exp(-v^2/2T_n) dv/T_n the means over v are
 *   <min>/g = alpha (E + (r/g) F),   <min^2> = 2 alpha^2 r^2 T_n (1 - E),
 *   loss = (1-e^2) T_n + <min> g - <min^2>/2.
 * J.T. Jenkins, J. Appl. Mech. 59 (1992) 120; J.T. Jenkins & M.Y. Louge, Phys. Fluids 9 (1997) 2835. */
#include "theory/walls/half_range.h"

#include <math.h>

#include "common/model.h"

typedef struct mean_over_normal {
  double over_g, square; /* <min>/g, <min^2> */
} mean_over_normal;

static mean_over_normal over_normal(double alpha, double r, double Tn, double g)
{
  const double last = g / r, w = last * last / (2 * Tn), E = exp(-w);
  const double F = sqrt(M_PI * Tn / 2) * erf(sqrt(w)) - last * E;
  const double sticks = w < 1e-6 ? 1 - w / 3 : E + F / last;
  return (mean_over_normal){alpha * sticks, alpha * alpha * r * r * 2 * Tn * (w < 1e-6 ? w : -expm1(-w))};
}

/* Sums over g in polar coordinates about the wall at rest, where the impulse is smooth, at midpoints of x with
 * g = most (x - sin(2 pi x)/(2 pi)): the weight vanishes at both ends, so that the sum converges fast. */
gg_half_range gg_theory_half_range(const gg_contact *c, double Tn, double V, double G)
{
  enum { RADII = 160, ANGLES = 48 };
  const double alpha = c->jt, e = c->jn - 1, r = c->mu * c->jn / alpha, D = fabs(G), most = D + 8 * sqrt(V);
  const double slow = 1e-6 * sqrt(V); /* the impulse over the drift is constant to this order */
  if (D < slow) return gg_theory_half_range(c, Tn, V, slow);
  double along = 0, rate = 0, drift = 0, all = 0;
  for (int i = 0; i < RADII; i++) {
    const double x = (i + 0.5) / RADII, g = most * (x - sin(2 * M_PI * x) / (2 * M_PI));
    const double weight = g * (1 - cos(2 * M_PI * x));
    const mean_over_normal m = over_normal(alpha, r, Tn, g);
    for (int k = 0; k < ANGLES; k++) {
      const double turn = cos(M_PI * (k + 0.5) / ANGLES);
      const double p = weight * exp(-(g * g - 2 * g * D * turn + D * D) / (2 * V));
      all += p, drift += p * g * turn, along += p * m.over_g * g * turn;
      rate += p * (m.over_g * g * g - 0.5 * m.square);
    }
  }
  return (gg_half_range){along / drift, (1 - e * e) * Tn + rate / all};
}
