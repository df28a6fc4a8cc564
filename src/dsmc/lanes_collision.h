/* The collision rule of common/collision.h, eight lanes at a time; a test holds the two against each other. */
#ifndef GG_DSMC_LANES_COLLISION_H
#define GG_DSMC_LANES_COLLISION_H

#include "dsmc/lanes.h"

/* A gg_contact in the lanes' precision. */
typedef struct gg_lane_contact {
  gg_real jn, jt, mu, im1, im2, ik1, ik2;
  gg_real inverse_mr, inverse_mt;
  gg_real normal_loss; /* energy destroyed for g_n^2 = 1, but for what the tangential impulse destroys */
} gg_lane_contact;

GG_INLINE gg_lane_contact gg_lane_contact_of(const gg_contact *c)
{
  return (gg_lane_contact){.jn = (gg_real)c->jn,
                           .jt = (gg_real)c->jt,
                           .mu = (gg_real)c->mu,
                           .im1 = (gg_real)c->im1,
                           .im2 = (gg_real)c->im2,
                           .ik1 = (gg_real)c->ik1,
                           .ik2 = (gg_real)c->ik2,
                           .inverse_mr = (gg_real)gg_inverse_mr(c),
                           .inverse_mt = (gg_real)gg_inverse_mt(c),
                           .normal_loss = (gg_real)(c->jn - 0.5 * gg_inverse_mr(c) * c->jn * c->jn)};
}

/* Impulse from the contact velocity g and gn = k.g (gg_impulse): (jn - jt) g_n k + jt g. */
GG_INLINE gg_vd3 gg_lane_impulse(gg_rule rule, const gg_lane_contact *c, gg_vd3 k, gg_vd3 g, gg_vd gn)
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

/* Energy destroyed, from g_n^2 (gg_energy_loss). */
GG_INLINE gg_vd gg_lane_energy_loss(gg_rule rule, const gg_lane_contact *c, gg_vd3 g, gg_vd3 J, gg_vd gn2)
{
  if (rule == GG_SMOOTH) return c->normal_loss * gn2;
  gg_vd Jn2 = c->jn * c->jn * gn2, Jt2 = gg_vd3_dot(J, J) - Jn2;
  return gg_vd3_dot(J, g) - 0.5 * (c->inverse_mr * Jn2 + c->inverse_mt * Jt2);
}

#endif
