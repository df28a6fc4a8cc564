/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "theory/walls/wall_condition.h"

#include <math.h>

#include "theory/walls/half_range.h"
#include "theory/walls/knudsen_layer.h"

/* With x = phi: A = x (1-x)^4/(1 + 4x + 4x^2 - 4x^3 + x^4) f'(x), f = 9 x^2 (1 + 44/35 x - 4/5 x^2)/(2 pi (1-x)^3), the
 * derivative of surface tension to pressure. */
double gg_theory_wall_layer(double x)
{
  const double polynomial = 1 + 44. / 35 * x - 0.8 * x * x, change = 44. / 35 - 1.6 * x, left = 1 - x;
  const double slope = 9 / (2 * M_PI) * x * (2 * polynomial + x * change + 3 * x * polynomial / left);
  return slope * left * x / (1 + x * (4 + x * (4 + x * (x - 4))));
}

double gg_theory_wall_share(const gg_surface *wall, double phi, double less)
{
  return 0.5 - wall->accommodation * less / (1 + 50 * phi);
}

bool gg_theory_wall_grips(const gg_surface *wall)
{
  const gg_contact *c = &wall->contact[0];
  return wall->accommodation > 0 || (c->jt > 0 && c->mu > 0);
}

bool gg_theory_walls_grip(const gg_model *m)
{
  return gg_theory_wall_grips(&m->surface[0]) || gg_theory_wall_grips(&m->surface[1]);
}

gg_wall_takes gg_theory_wall_takes(const gg_surface *wall, const gg_arrival *in)
{
  const gg_gap_local *gas = in->gas;
  const gg_contact *c = &wall->contact[0];
  const double h = gg_theory_wall_share(wall, gas->phi, gas->path > 0 ? 0.0526 : 0.0636), a = wall->accommodation,
               e = c->jn - 1;
  const gg_knudsen_layer layer = gg_theory_knudsen_layer(wall, in, h);
  const double G = in->slip + wall->side * layer.velocity, J = in->P / sqrt(2 * M_PI * layer.normal);
  const double heat = in->heat + in->shear * (in->slip - G) - layer.loss, carried = h * (heat - layer.heat);
  const double momentum =
      J * G + gg_theory_wall_share(wall, gas->phi, 0.0571) * in->shear + J * in->along / (5 * in->P);
  const double normal = J * layer.normal + h * layer.heat;
  const double tangential = J * (layer.tangential - 0.5 * G * G) + carried + G * momentum;
  double grip = c->jt, slides = c->jt * (2 - c->jt) * tangential;
  if (!isinf(c->mu) && c->jt > 0) {
    const gg_half_range mean = gg_theory_half_range(c, layer.normal, layer.tangential, G);
    grip = mean.impulse, slides = (J + carried / layer.tangential) * (mean.loss - (1 - e * e) * layer.normal);
  }
  return (gg_wall_takes){
      .momentum = (a + (1 - a) * grip) * momentum,
      .energy = layer.loss + a * (normal + tangential - 2 * J * wall->temperature) +
                (1 - a) * ((1 - e * e) * normal + slides),
      .grains = gg_theory_wall_layer(gas->phi) + layer.grains,
      .warmth = gg_theory_wall_layer(gas->phi) * in->T + layer.warmth,
      .loss = layer.loss,
  };
}
