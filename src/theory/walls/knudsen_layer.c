/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "theory/walls/knudsen_layer.h"

#include <math.h>

/* Share of normal energy that a wall takes; a thermal one gives that of its temperature back. */
static double share_of(const gg_surface *wall)
{
  const double a = wall->accommodation, e = wall->contact[0].jn - 1;
  return a + (1 - a) * (1 - e * e);
}

/* s q_n = share (J T_n + h s q_n) - a J T_w, J = P/sqrt(2 pi T_n), as a function of z = sqrt(T_n). */
static double taken(const gg_surface *wall, double P, double h, double z)
{
  const double share = share_of(wall), a = wall->accommodation;
  return P / (sqrt(2 * M_PI) * (1 - share * h)) * (share * z - a * wall->temperature / z);
}

/* T_n at the wall: what arrives is what the wall takes. Tangential velocities keep a tenth of their energy. */
static double normal_temperature(const gg_surface *wall, const gg_arrival *in, double h)
{
  const gg_gap_local *gas = in->gas;
  const double stiff = in->P / sqrt(1.2 * in->T), share = share_of(wall);
  double z = sqrt(gas->Tyy);
  for (int k = 0; k < 50; k++) {
    const double excess = 0.6 * in->heat - stiff * (z * z - gas->Tyy) - taken(wall, in->P, h, z);
    const double rate = in->P / (sqrt(2 * M_PI) * (1 - share * h));
    const double slope = 2 * stiff * z + rate * (share + wall->accommodation * wall->temperature / (z * z));
    const double step = excess / slope;
    z = fmax(z + step, 0.5 * z);
    if (fabs(step) < 1e-15 * z) break;
  }
  return fmin(z * z, gas->Tyy + 0.3 * (gas->Txx + gas->Tzz));
}

/* Sums across the layer, by Gauss's formula in w. At constant P and tau n goes as 1/(1 + w), T as 1 - k w, u' as
 * n sqrt(T) and the loss as n^2 T^(3/2). */
static void put_sums(const gg_arrival *in, gg_knudsen_layer *to)
{
  static const double place[] = {-0.774596669241483377, 0, 0.774596669241483377}, weight[] = {5. / 18, 4. / 9, 5. / 18};
  const gg_gap_local *gas = in->gas;
  const double D = to->normal / gas->Tyy - 1, k = 2 * gas->Tyy / (3 * in->T);
  for (int i = 0; i < 3; i++) {
    const double x = 0.5 * (1 + place[i]), w = D * x, dy = gas->path * weight[i] / x;
    const double n = 1 / (1 + w), T = 1 - k * w;
    to->grains += dy * gas->n * (n - 1), to->warmth += dy * gas->n * in->T * (n * T - 1);
    to->velocity += dy * gas->shear * (n * sqrt(T) - 1), to->loss += dy * gas->loss * (n * n * T * sqrt(T) - 1);
  }
}

gg_knudsen_layer gg_theory_knudsen_layer(const gg_surface *wall, const gg_arrival *in, double h)
{
  const gg_gap_local *gas = in->gas;
  gg_knudsen_layer to = {.normal = gas->Tyy, .tangential = 0.5 * (gas->Txx + gas->Tzz), .heat = 0.6 * in->heat};
  if (gas->path == 0) return to;
  to.normal = normal_temperature(wall, in, h), to.tangential -= 1.5 * (to.normal - gas->Tyy);
  to.heat = taken(wall, in->P, h, sqrt(to.normal));
  put_sums(in, &to);
  return to;
}
