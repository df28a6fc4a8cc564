/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Why hydrodynamics errs in a flow between walls, from its solution. Thresholds are where deviations from Monte Carlo
 * exceed some 5 % (docs/appendix/walls.md). */
#include <math.h>
#include <stdio.h>

#include "base/text.h"
#include "theory/walls/gap.h"

static const double many_paths = 0.1, thermal_speed = 1, least_e = 0.7, much_shear = 0.1, much_heat = 0.2;

#define ADD(text, ...)                                                                                                 \
  (gg_base_text_append(text, GG_THEORY_REMARK, "%s", *(text) ? "; " : ""),                                             \
   gg_base_text_append(text, GG_THEORY_REMARK, __VA_ARGS__))

void gg_theory_gap_remark(const gg_gap_flow *flow, double Kn, char text[GG_THEORY_REMARK])
{
  const gg_model *m = flow->gap.model;
  double shear = 0, slip = 0, heat = 0, given = 0;
  bool newtonian = true;
  for (int w = 0; w < 2; w++) {
    const gg_gap_wall *wall = &flow->wall[w];
    newtonian &= wall->gas.xx == 0 && wall->gas.zz == 0;
    shear = fmax(shear, fabs(wall->tau) / wall->P), slip = fmax(slip, fabs(wall->slip) / sqrt(wall->T));
    heat = fmax(heat, wall->heat / (wall->P * sqrt(wall->T))), given -= wall->heat;
  }
  text[0] = '\0';
  if (Kn > many_paths) ADD(text, "Kn = %.2g: walls are felt throughout the gap", Kn);
  if (newtonian && shear > much_shear)
    ADD(text, "P_yx/P_yy reaches %.2g: normal stress differences grow as its square, and a Newtonian theory has none",
        shear);
  if (m->e[0] < least_e) ADD(text, "e = %g: velocities are far from Gaussian", m->e[0]);
  if (slip > thermal_speed)
    ADD(text, "the slip is %.2g thermal speeds: grains that met a wall and others are two streams", slip);
  if (!m->elastic_grains && given > 0)
    ADD(text, "walls heat a gas that loses energy (%.0f %% of the loss): it is cold within mean free paths of them",
        100 * given / flow->loss);
  else if (heat > much_heat)
    ADD(text, "a wall takes heat, %.2g P sqrt(T/m): gradients are strong within a mean free path of it", heat);
}
