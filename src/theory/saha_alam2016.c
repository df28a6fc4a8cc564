/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sheared smooth grains to Burnett order: S. Saha & M. Alam, J. Fluid Mech. 795 (2016) 549. The second moment of the
 * velocity is closed by an anisotropic Gaussian (gaussian_closure), its balance expanded to second order in the shear
 * rate and in the anisotropy, with e in full. The expansion is ours, from the collision integrals of the closure.
 *
 * M = T (1 + s), s_xy = x, (s_xx - s_yy)/2 = D, s_zz = Z; h = (1+e)/2, G = phi chi, N = n d^2 chi, R = rate d/T^1/2:
 *   nu = (16/5) sqrt(pi) N h (2 - h),   A = 1 + (8/5) h (3h - 2) G,   B = 1 + h (96/35 h - 16/5) G
 *   x = -A R/nu,   D = A R^2/nu^2,
 *   Z = (2/3) x R B/nu - (16/315) sqrt(pi) N h (3h - 1) R^2/nu + (2/21) x^2
 *   R^2 {2 A^2/nu + (4/15) sqrt(pi) N h (3h - 1) - (8/5) sqrt(pi) N h (1 - h) A^2/nu^2} = 16 sqrt(pi) N h (1 - h)
 * The collisional stress in units of 4 n h G T:
 *   xx, yy = 1 +- (2/5) D - Z/5 + (3/70) R^2 - 6 x R/(35 sqrt(pi)),   zz = 1 + (2/5) Z + R^2/70 - 2 x R/(35 sqrt(pi))
 *   xy = (2/5) [x - R/sqrt(pi)]
 * Collisions per grain: 4 N sqrt(pi T) (1 - x^2/30 + R^2/60). In the Boltzmann limit G and all terms in R that stand
 * for the flow across a diameter vanish. */
#include <math.h>

#include "theory/answer.h"
#include "theory/theory_list.h"

static const char name[] = "saha_alam2016";

/* Second moment and shear rate of the steady state, in thermal units. */
typedef struct burnett_state {
  double h, G, R;
  double across; /* R of the flow across a diameter; 0 in the Boltzmann limit */
  double x, D, Z;
} burnett_state;

static burnett_state state_of(const gg_model *m)
{
  const double h = gg_theory_grain_of(m).eta1, G = gg_theory_phi_chi(m), N = m->density * m->chi[0];
  const double unit = sqrt(M_PI) * N * h, nu = 16. / 5 * unit * (2 - h), width = m->boltzmann ? 0 : 1;
  const double A = 1 + 8. / 5 * h * (3 * h - 2) * G, B = 1 + h * (96. / 35 * h - 16. / 5) * G;
  const double heating = 2 * A * A / nu + width * 4. / 15 * unit * (3 * h - 1);
  const double R2 = 16 * unit * (1 - h) / (heating - 8. / 5 * unit * (1 - h) * A * A / (nu * nu)), R = sqrt(R2);
  const double x = -A * R / nu;
  return (burnett_state){h,
                         G,
                         R,
                         width * R,
                         x,
                         A * R2 / (nu * nu),
                         2. / 3 * x * R * B / nu - width * 16. / 315 * unit * (3 * h - 1) * R2 / nu + 2. / 21 * x * x};
}

static gg_stress collisional_stress(burnett_state s)
{
  const double R = s.across, flow = s.x * R / sqrt(M_PI), plane = 1 - s.Z / 5 + 3. / 70 * R * R - 6. / 35 * flow;
  const double xy = 0.4 * (s.x - R / sqrt(M_PI));
  return (gg_stress){plane + 0.4 * s.D, plane - 0.4 * s.D, 1 + 0.4 * s.Z + R * R / 70 - 2. / 35 * flow, xy, xy};
}

static gg_stress times(gg_stress s, double factor)
{
  return (gg_stress){s.xx * factor, s.yy * factor, s.zz * factor, s.xy * factor, s.yx * factor};
}

static gg_status evaluate(const gg_model *m, gg_theory_answer *a, gg_error *err)
{
  GG_TRY(gg_theory_require_one_species(m, name, err));
  GG_TRY(gg_theory_require_smooth(m, name, err));
  GG_TRY(gg_theory_require_steady_shear(m, name, err));
  const burnett_state s = state_of(m);
  const double T = m->shear_rate * m->shear_rate / (s.R * s.R), n = m->density;
  const gg_stress kinetic = {1 - s.Z / 2 + s.D, 1 - s.Z / 2 - s.D, 1 + s.Z, s.x, s.x};
  if (!(kinetic.yy > 0 && kinetic.zz > 0))
    return gg_theory_reject(err, name, "has no state here: to second order a second moment is negative");
  gg_theory_answer_temperature(m, T, NAN, a);
  gg_theory_answer_stress(m, T, times(kinetic, n * T), times(collisional_stress(s), n * T * 4 * s.h * s.G), a);
  gg_theory_answer_collisions_one(m, T, a);
  a->value[GG_Q_COLLISION_RATE] *= 1 - s.x * s.x / 30 + s.across * s.across / 60;
  a->value[GG_Q_MEAN_FREE_PATH] = a->value[GG_Q_KNUDSEN] = NAN;
  a->value[GG_Q_DISSIPATION] = -a->value[GG_Q_P_XY] * m->shear_rate;
  return GG_OK;
}

static const char *beyond(const gg_model *m)
{
  return m->e[0] < 0.9
             ? "second order in the shear rate, which is large in thermal units where collisions dissipate much"
             : NULL;
}

const gg_theory gg_theory_saha_alam2016 = {
    .name = name,
    .flows = GG_FLOW_BIT(GG_USF),
    .title = "Anisotropic Gaussian to Burnett order",
    .citation = "S. Saha and M. Alam, J. Fluid Mech. 795 (2016) 549",
    .answers =
        "temperature pressure compressibility_factor shear_viscosity N1 N2 " GG_ANSWERS_STRESS GG_ANSWERS_TRANSFER
        "collision_rate dissipation",
    .assumptions =
        "Steady uniform shear of one species of smooth grains at any density, contact value of the scene. The "
        "Gaussian closure to second order in the shear rate, in closed form; our expansion, not compared "
        "with the printed one. Made for e near 1.",
    .evaluate = evaluate,
    .beyond = beyond,
};
