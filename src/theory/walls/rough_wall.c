/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "theory/walls/rough_wall.h"

#include <math.h>

/* Sums over grains that arrive: momentum along x, spin, half the squares of normal and tangential velocity; with
 * S the spin's velocity at the contact, v.S and S^2 along the wall, and s^2. */
typedef struct sums {
  double number, momentum, spin, normal, tangential, vS, SS, ss;
} sums;

static sums arriving(const gg_surface *wall, const gg_rough_arrival *in)
{
  const gg_arrival *c = &in->centres;
  const gg_gap_local *gas = c->gas;
  const double h_shear = gg_theory_wall_share(wall, gas->phi, 0.0571);
  const double h_heat = gg_theory_wall_share(wall, gas->phi, 0.0636);
  const double J = c->P / sqrt(2 * M_PI * gas->Tyy), G = c->slip, heat = h_heat * c->heat, s = 0.5 * in->omega;
  const double turns = 2 / in->K * h_heat * in->heat; /* of s^2, all three components */
  sums f = {.number = J, .spin = J * s + 2 / in->K * h_shear * in->couple};
  f.momentum = J * G + h_shear * c->shear + wall->side * J * gas->carried_x * c->heat / (5 * c->P);
  f.normal = J * gas->Tyy + 0.6 * heat;
  f.tangential = J * (0.5 * (gas->Txx + gas->Tzz) - 0.5 * G * G) + 0.4 * heat + G * f.momentum;
  const double mean = 2 * s * f.spin - J * s * s;
  f.vS = wall->side * (s * f.momentum + G * f.spin - J * G * s);
  f.SS = J * 2 * in->theta / in->K + 2. / 3 * turns + mean;
  f.ss = J * 3 * in->theta / in->K + turns + mean;
  return f;
}

gg_rough_takes gg_theory_rough_wall_takes(const gg_surface *wall, const gg_rough_arrival *in)
{
  const gg_contact *c = &wall->contact[0];
  const sums f = arriving(wall, in);
  const double a = wall->accommodation, e = c->jn - 1, alpha = c->jt, K = in->K, T = wall->temperature;
  const double gg = 2 * f.tangential - 2 * f.vS + f.SS, vg = 2 * f.tangential - f.vS, Sg = f.vS - f.SS;
  const double impulse = alpha * (f.momentum - wall->side * f.spin);
  const gg_rough_takes rule = {.momentum = impulse,
                               .couple = -0.5 * wall->side * impulse,
                               .translation = (1 - e * e) * f.normal + alpha * vg - 0.5 * alpha * alpha * gg,
                               .rotation = -alpha * Sg - 0.5 * alpha * alpha / K * gg};
  const gg_rough_takes all = {.momentum = f.momentum,
                              .couple = 0.5 * K * f.spin,
                              .translation = f.normal + f.tangential - 2 * f.number * T,
                              .rotation = 0.5 * K * f.ss - 1.5 * f.number * T};
  return (gg_rough_takes){.momentum = a * all.momentum + (1 - a) * rule.momentum,
                          .couple = a * all.couple + (1 - a) * rule.couple,
                          .translation = a * all.translation + (1 - a) * rule.translation,
                          .rotation = a * all.rotation + (1 - a) * rule.rotation};
}
