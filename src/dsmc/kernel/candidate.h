/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One candidate pair a lane: is it accepted, along which direction k, with what contact velocity?
 *
 * A pair's rate integrated over directions is pi sigma^2 chi/V times
 *   without shear between the centres:  |C12|, and then k falls by the cosine law about C12;
 *   with it:  at most |C12| + s0, s0 = (8/3 pi) sigma rate, since g_n <= max(0, k.C12) + sigma rate |k_x k_y|; k falls
 * by the cosine law with the share of the first, by the law |k_x k_y| with that of the second, and is then accepted
 * with probability g_n/(max(0, k.C12) + sigma rate |k_x k_y|). One uniform number t in [-s0, majorant) serves for all:
 * t < 0 takes the second law, t < |C12| the first, anything more is no collision; and since what is left of t is
 * uniform again, it serves for the last acceptance, too.
 *
 * Smooth grains without shear need no k at all: with w uniform on the sphere, C12 - |C12| w points along a k of the
 * cosine law and is 2 (k.C12) long, since elastic hard spheres scatter isotropically. */
#ifndef GG_DSMC_CANDIDATE_H
#define GG_DSMC_CANDIDATE_H

#include "dsmc/kernel/collision_sums.h"
#include "dsmc/kernel/directions.h"

/* A pass in progress: constants and sums where the compiler can keep them in registers. */
typedef struct gg_dsmc_pass_state {
  gg_dsmc_real_block *one, *two, *spin_one, *spin_two;
  float *bound_one, *bound_two;
  bool any_odd; /* blocks that are not full: odd_one, odd_two, or UINT32_MAX */
  gg_vu odd_one, odd_two, first_one, first_two, n_one, n_two; /* in all lanes */
  gg_dsmc_lane_contact contact;
  const gg_real *losses; /* of a law of restitution: its table, and the speed in its units over the present one */
  gg_real loss_scale;
  bool sorts;              /* lanes are exchanged by speed, not at random */
  gg_real floor, majorant; /* the layer of |C12| */
  gg_real s0, shift;
  gg_real lowest;          /* t: floor - s0 */
  bool from_zero;          /* that is so */
  gg_vd to_a, to_b;        /* from J, or 2 g_n k, to velocities */
  bool correction_pass;    /* a correction pass: all block pairs under one majorant */
  gg_vd most, most_rate;   /* majorant; majorant + s0 */
  double scale;            /* of the speed bounds, at the next draw */
  double margin;           /* of new speed bounds; above 1: the scale stays */
  gg_real root, per_scale; /* its square root, and its inverse at the last draws */
  uint64_t block_pairs, collisions, overflows;
  gg_vd largest; /* largest C12^2 */
  gg_dsmc_sums sums;
} gg_dsmc_pass_state;

/* Random streams and prefetched samples: apart from the rest, so that they stay in registers. */
typedef struct gg_dsmc_samples {
  gg_dsmc_lane_rng rng;
  gg_dsmc_directions near, sheared; /* about C12, and by the law |k_x k_y| */
} gg_dsmc_samples;

/* A candidate pair in each lane; where it does not collide, the rest means nothing (but is finite). */
typedef struct gg_dsmc_candidate {
  gg_mask hit, special; /* special: by the second law */
  gg_vd speed, t;
  gg_vd3 q;    /* of the law about the z axis, or uniform */
  gg_vd3 k, g; /* k: only if needed; g: contact velocity without spins */
  gg_vd3 gn_k; /* 2 g_n k, if not */
  gg_vd gn;
} gg_dsmc_candidate;

GG_INLINE bool gg_dsmc_needs_k(gg_dsmc_features features)
{
  return features.rule != GG_SMOOTH || features.shear == GG_DSMC_SHEARED_DENSE || features.sums == GG_DSMC_STRESS ||
         features.law;
}

/* Shear between the centres makes the second stage longer than the first: the scale moves to the first. */
GG_INLINE bool gg_dsmc_scales_early(gg_dsmc_features features)
{
  return features.shear == GG_DSMC_SHEARED_DENSE;
}

/* z component of the Householder vector v +- |v| z that mirrors the z axis to the direction of v, or against it. */
GG_INLINE gg_vd gg_dsmc_mirror_z(gg_vd3 v, gg_vd speed)
{
  return v.z + (gg_vd)((gg_vu)speed | ((gg_vu)v.z & (gg_vu)gg_all(-0.0)));
}

/* Half the inverse square of its length: known as soon as v is; its latency is long, so that it is best computed
 * then. */
GG_INLINE gg_vd gg_dsmc_mirror_scale(gg_vd3 v, gg_vd speed)
{
  return 1 / (speed * gg_dsmc_abs(gg_dsmc_mirror_z(v, speed)) + GG_TINY); /* 0/0 only where nothing moves */
}

/* The direction that lies about v as q lies about the z axis: q mirrored. */
GG_INLINE gg_vd3 gg_dsmc_mirror(gg_vd3 v, gg_vd speed, gg_vd scale, gg_vd3 q)
{
  const gg_vu sign = (gg_vu)v.z & (gg_vu)gg_all(-0.0);
  gg_vd3 h = {v.x, v.y, gg_dsmc_mirror_z(v, speed)};
  gg_vd3 m = {q.x, q.y, (gg_vd)((gg_vu)q.z ^ sign ^ (gg_vu)gg_all(-0.0))};
  return gg_vd3_sub(m, gg_vd3_scale(gg_vd3_dot(h, m) * scale, h));
}

/* Acceptance of candidates by a random word, t from `lowest` (0 if from_zero) to `majorant`: who
 * collides by the first law, who may by the second. */
GG_INLINE void gg_dsmc_candidate_accept(gg_dsmc_features features, bool from_zero, gg_real lowest, gg_real majorant,
                                        gg_vu word, gg_dsmc_candidate *candidate)
{
  gg_vd range = gg_all(majorant);
  if (!from_zero) range -= gg_all(lowest);
  candidate->t = gg_dsmc_lane_one_to_two(word) * range - range;
  if (!from_zero) candidate->t += gg_all(lowest);
  candidate->hit = gg_less(candidate->t, candidate->speed);
  if (features.shear != GG_DSMC_SHEARED_DENSE) return;
  candidate->special = gg_less(candidate->t, gg_all(0));
  candidate->hit = gg_and_not(candidate->hit, candidate->special);
}

/* In a correction: what is left of t is to be uniform from 0 to the speed. */
GG_INLINE void gg_dsmc_candidate_correct(gg_real lowest, gg_dsmc_candidate *candidate)
{
  candidate->t = (candidate->t - lowest) * candidate->speed / (candidate->speed - lowest);
}

/* Shear between the centres: lanes in `special` take the second law; then the last acceptance. */
GG_INLINE void gg_dsmc_candidate_accept_sheared(const gg_dsmc_pass_state *state, gg_dsmc_samples *samples, gg_vd3 v,
                                                gg_dsmc_candidate *candidate)
{
  gg_vd3 k = candidate->k, other = gg_dsmc_directions_take(&samples->sheared, candidate->special);
  k = (gg_vd3){gg_select(candidate->special, other.x, k.x), gg_select(candidate->special, other.y, k.y),
               gg_select(candidate->special, other.z, k.z)};
  gg_vd gn = gg_vd3_dot(k, v), shear = state->shift * k.x * k.y, most = gg_larger(gn, gg_all(0)) + gg_dsmc_abs(shear);
  gg_vd left = gg_dsmc_abs(candidate->t),
        range = gg_select(candidate->special, gg_all(state->s0), candidate->speed); /* special: t < 0 */
  candidate->k = k;
  candidate->gn = gn - shear;
  candidate->g.x -= state->shift * k.y;
  candidate->hit = gg_and(gg_or(candidate->hit, candidate->special), gg_less(left * most, range * candidate->gn));
}

/* Along which k do they collide, with relative velocity v, whose gg_dsmc_mirror_scale is known? */
GG_INLINE void gg_dsmc_candidate_direction(gg_dsmc_features features, const gg_dsmc_pass_state *state,
                                           gg_dsmc_samples *samples, gg_vd3 v, gg_vd scale,
                                           gg_dsmc_candidate *candidate)
{
  candidate->g = v;
  if (!gg_dsmc_needs_k(features)) {
    candidate->gn_k = gg_vd3_sub(v, gg_vd3_scale(candidate->speed, candidate->q));
    return;
  }
  candidate->k =
      gg_dsmc_mirror(v, candidate->speed,
                     gg_dsmc_scales_early(features) ? scale : gg_dsmc_mirror_scale(v, candidate->speed), candidate->q);
  candidate->gn = candidate->speed * candidate->q.z;
  if (features.shear == GG_DSMC_SHEARED_DENSE) gg_dsmc_candidate_accept_sheared(state, samples, v, candidate);
}

#endif
