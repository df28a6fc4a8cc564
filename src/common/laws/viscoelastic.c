/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Viscoelastic spheres: Hertz's contact with dissipation in the bulk, F = rho (xi^(3/2) + (3/2) A xi^(1/2) dxi/dt).
 * With x = (A kappa^(2/5))^(1/2) g^(1/10), kappa = (3/2)^(5/2) rho/m_eff,
 *
 *   e = 1 - C1 x^2 + C2 x^4 + ...,   C1 = 1.15344, C2 = (3/5) C1^2
 *
 * (R. Ramirez, T. Poeschel, N.V. Brilliantov & T. Schwager, Phys. Rev. E 60 (1999) 4465); summed by the Pade form of P.
 * Mueller & T. Poeschel, Phys. Rev. E 84 (2011) 021302, as A.K. Dubey, A. Bodrova, S. Puri & N. Brilliantov, Phys. Rev.
 * E 87 (2013) 062202, took it. It is within 4e-4 of the equation of motion where e > 0.75, within 0.009 everywhere. */
#include "common/laws/laws.h"
#include "common/portable_math.h"

/* The unit of speed is that at which x = 1. */
double gg_common_loss_viscoelastic(double u)
{
  const double c1 = 0.501086, b2 = 1.15345, b3 = 0.577977, b4 = 0.532178, x = gg_root(u, 10);
  const double numerator = 1 + c1 * x, rest = x * x * (b2 + x * (b3 + x * b4));
  return rest / (numerator + rest);
}
