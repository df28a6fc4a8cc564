/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The collision rule for lanes: common/collision_of.h with the operations of lanes. */
#ifndef GG_DSMC_LANES_COLLISION_H
#define GG_DSMC_LANES_COLLISION_H

#include "dsmc/kernel/kernel_lanes.h"

/* A gg_contact in the lanes' precision. */
typedef struct gg_dsmc_lane_contact {
  gg_real jn, jt, mu, im1, im2, ik1, ik2, kick[GG_N_KICKS];
  gg_real mr, mt;       /* 1/(1/m1 + 1/m2); jt/(1+beta) */
  gg_real push1, push2; /* velocity changes from 2 g_n k */
} gg_dsmc_lane_contact;

/* Absolute value. */
GG_INLINE gg_vd gg_dsmc_abs(gg_vd x)
{
  return (gg_vd)((gg_vu)x & ~(gg_vu)gg_all(-0.0));
}

/* Unit of impulses: for grains of one species their mass, so that an impulse is a change of velocity; else 1. */
GG_INLINE double gg_dsmc_impulse_unit(bool same, const gg_contact *c)
{
  return same ? 1 / c->im1 : 1;
}

GG_INLINE gg_dsmc_lane_contact gg_dsmc_lane_contact_of(bool same, const gg_contact *c)
{
  const double mass = gg_dsmc_impulse_unit(same, c);
  gg_dsmc_lane_contact lane = {.jn = (gg_real)(c->jn / mass),
                               .jt = (gg_real)(c->jt / mass),
                               .mu = (gg_real)c->mu,
                               .im1 = (gg_real)(c->im1 * mass),
                               .im2 = (gg_real)(c->im2 * mass),
                               .ik1 = (gg_real)(c->ik1 * mass),
                               .ik2 = (gg_real)(c->ik2 * mass),
                               .mr = (gg_real)(1 / (gg_inverse_mr(c) * mass)),
                               .mt = (gg_real)(1 / (gg_inverse_mt(c) * mass)),
                               .push1 = (gg_real)(0.5 * c->jn * c->im1),
                               .push2 = (gg_real)(0.5 * c->jn * c->im2)};
  for (int k = 0; k < GG_N_KICKS; k++) lane.kick[k] = (gg_real)(c->kick[k] / mass);
  return lane;
}

#define GG_NUMBER gg_vd
#define GG_VECTOR gg_vd3
#define GG_OF(name) gg_vd3_##name
#define GG_CONTACT gg_dsmc_lane_contact
#define GG_ALL(x) gg_all(x)
#define GG_ABS(x) gg_dsmc_abs(x)
#define GG_SQRT(x) gg_sqrt(x)
#define GG_IF_LESS(a, b, yes, no) gg_select(gg_less(a, b), yes, no)
#include "common/collision_of.h"

#define GG_NUMBER gg_vd
#define GG_OF(name) gg_vd3_##name
#define GG_REAL gg_real
#define GG_WORDS gg_vu
#ifdef GG_SINGLE_LANES
#define GG_MANTISSA 23
#define GG_BIAS UINT32_C(127)
#define GG_ONE UINT32_C(1)
#else
#define GG_MANTISSA 52
#define GG_BIAS UINT64_C(1023)
#define GG_ONE UINT64_C(1)
#endif
#define GG_BETWEEN(x, low, high) gg_smaller(gg_larger(x, gg_all((gg_real)low)), gg_all((gg_real)high))
#define GG_BITS(x) ((gg_vu)(x))
#define GG_FROM_BITS(w) ((gg_vd)(w))
#define GG_LOOK_UP(table, at) gg_look_up(table, at)
#include "common/laws/loss_at_of.h"

/* Complete the terms of the loss by those that follow from others: smooth grains need the first term alone
 * (J.g = m_r (1+e) g_n^2), rough grains two (J_t^2 = m_t (1+beta) J_t.g_t). */
GG_INLINE gg_loss_terms gg_dsmc_all_terms(gg_rule rule, const gg_contact *c, gg_loss_terms sum)
{
  if (rule == GG_SMOOTH) sum.Jn2 = sum.J2 = c->jn * sum.Jg;
  if (rule == GG_ROUGH) sum.J2 = sum.Jn2 + c->jt * (sum.Jg - sum.Jn2 / c->jn);
  return sum;
}

#endif
