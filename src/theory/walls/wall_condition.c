/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "theory/walls/wall_condition.h"

#include <math.h>

#include "theory/walls/half_range.h"

/* With x = phi: A = x (1-x)^4/(1 + 4x + 4x^2 - 4x^3 + x^4) f'(x), f = 9 x^2 (1 + 44/35 x - 4/5 x^2)/(2 pi (1-x)^3), the
 * derivative of surface tension to pressure. */
double gg_theory_wall_layer(double x)
{
  const double polynomial = 1 + 44. / 35 * x - 0.8 * x * x, change = 44. / 35 - 1.6 * x, left = 1 - x;
  const double slope = 9 / (2 * M_PI) * x * (2 * polynomial + x * change + 3 * x * polynomial / left);
  return slope * left * x / (1 + x * (4 + x * (4 + x * (x - 4))));
}

/* Shares of the shear stress and of the heat flux that arriving grains carry. Half is Maxwell's. At a diffuse wall, of
 * a dilute gas, these give the slip 1.2540 and the jump 2.4001 sqrt(pi)/2 mean free paths of Boltzmann's equation. */
static double share_of(const gg_surface *wall, double phi, double less)
{
  return 0.5 - wall->accommodation * less / (1 + 50 * phi);
}

bool gg_theory_wall_grips(const gg_surface *wall)
{
  const gg_contact *c = &wall->contact[0];
  return wall->accommodation > 0 || (c->jt > 0 && c->mu > 0);
}

gg_wall_takes gg_theory_wall_takes(const gg_surface *wall, const gg_arrival *in)
{
  const gg_gap_local *gas = in->gas;
  const gg_contact *c = &wall->contact[0];
  const double h_shear = share_of(wall, gas->phi, 0.0571), h_heat = share_of(wall, gas->phi, 0.0636);
  const double a = wall->accommodation, G = in->slip, heat = h_heat * in->heat;
  const double J = in->P / sqrt(2 * M_PI * gas->Tyy), across = 0.5 * (gas->Txx + gas->Tzz);
  const double momentum = J * G + h_shear * in->shear + J * in->along / (5 * in->P);
  const double normal = J * gas->Tyy + 0.6 * heat;
  const double tangential = J * (across - 0.5 * G * G) + 0.4 * heat + G * momentum;
  gg_wall_takes rule;
  if (isinf(c->mu) || c->jt == 0) {
    const double e = c->jn - 1, beta = c->jt - 1;
    rule = (gg_wall_takes){c->jt * momentum, (1 - e * e) * normal + (1 - beta * beta) * tangential};
  } else {
    const gg_half_range mean = gg_theory_half_range(c, gas->Tyy, across, G);
    rule = (gg_wall_takes){momentum * mean.impulse, (J + heat / (gas->Tyy + across)) * mean.loss};
  }
  const double brought = normal + tangential - 2 * J * wall->temperature;
  return (gg_wall_takes){a * momentum + (1 - a) * rule.momentum, a * brought + (1 - a) * rule.energy};
}
