/* The collision rule of common/collision.h, eight lanes at a time; a test holds the two against each other. */
#ifndef GG_DSMC_LANES_COLLISION_H
#define GG_DSMC_LANES_COLLISION_H

#include "dsmc/kernel/lanes.h"

/* A gg_contact in the lanes' precision. */
typedef struct gg_dsmc_lane_contact {
  gg_real jn, jt, mu, im1, im2, ik1, ik2;
  gg_real push1, push2; /* velocity changes from 2 g_n k */
} gg_dsmc_lane_contact;

GG_INLINE gg_dsmc_lane_contact gg_dsmc_lane_contact_of(const gg_contact *c)
{
  return (gg_dsmc_lane_contact){.jn = (gg_real)c->jn,
                                .jt = (gg_real)c->jt,
                                .mu = (gg_real)c->mu,
                                .im1 = (gg_real)c->im1,
                                .im2 = (gg_real)c->im2,
                                .ik1 = (gg_real)c->ik1,
                                .ik2 = (gg_real)c->ik2,
                                .push1 = (gg_real)(0.5 * c->jn * c->im1),
                                .push2 = (gg_real)(0.5 * c->jn * c->im2)};
}

/* Impulse from the contact velocity g and gn = k.g (gg_impulse): (jn - jt) g_n k + jt g. */
GG_INLINE gg_vd3 gg_dsmc_lane_impulse(gg_rule rule, const gg_dsmc_lane_contact *c, gg_vd3 k, gg_vd3 g, gg_vd gn)
{
  if (rule == GG_SMOOTH) return gg_vd3_scale(c->jn * gn, k);
  gg_vd jt = gg_all(c->jt);
  if (rule == GG_FRICTIONAL) {
    gg_vd3 gt = gg_vd3_sub(g, gg_vd3_scale(gn, k));
    gg_vd gt2 = gg_vd3_dot(gt, gt), limit = c->mu * c->jn * gn;
    gg_mask slides = gg_less(limit * limit, jt * jt * gt2); /* never with gt = 0 */
    jt = gg_select(slides, limit / gg_sqrt(gt2), jt);
  }
  return gg_vd3_add(gg_vd3_scale((c->jn - jt) * gn, k), gg_vd3_scale(jt, g));
}

/* What the energy that collisions destroy (gg_energy_loss) follows from, one or their sum: it is linear in J.g, J_n^2
 * and J.J, and smooth grains need the first alone (J.g = m_r (1+e) g_n^2), rough ones two (J_t^2 = m_t (1+beta) J_t.g).
 */
typedef struct gg_dsmc_loss_terms {
  double Jg, Jn2, J2;
} gg_dsmc_loss_terms;

GG_INLINE double gg_dsmc_loss_of(gg_rule rule, const gg_contact *c, gg_dsmc_loss_terms sum)
{
  if (rule == GG_SMOOTH) return (1 - 0.5 * gg_inverse_mr(c) * c->jn) * sum.Jg;
  double Jt2 = rule == GG_ROUGH ? c->jt * (sum.Jg - sum.Jn2 / c->jn) : sum.J2 - sum.Jn2;
  return sum.Jg - 0.5 * (gg_inverse_mr(c) * sum.Jn2 + gg_inverse_mt(c) * Jt2);
}

#endif
