/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Acceptance, direction k and contact velocity of candidates, one pair of grains a lane.
 *
 * The rate of a pair, integrated over directions, is pi sigma^2 chi/V times
 *   without shear between the centres:  |C12|; k then has the cosine law about C12;
 *   with shear:  at most |C12| + s0, s0 = (8/3 pi) sigma rate, since g_n <= max(0, k.C12) + sigma rate |k_x k_y|. k has
 * the cosine law or the law |k_x k_y|, with probabilities in the ratio of the two terms, and is then accepted with
 * probability g_n/(max(0, k.C12) + sigma rate |k_x k_y|). One uniform number t in [-s0, majorant) decides everything:
 * t < 0 selects the second law, t < |C12| the first, larger t reject the candidate; the remainder of t is uniform again
 * and decides the last acceptance.
 *
 * Smooth grains without shear need no k: with w uniform on the sphere, C12 - |C12| w points along a k of the cosine law
 * and has the length 2 (k.C12), since elastic hard spheres scatter isotropically. */
#ifndef GG_DSMC_CANDIDATE_H
#define GG_DSMC_CANDIDATE_H

#include "dsmc/kernel/collision_sums.h"
#include "dsmc/kernel/directions.h"

/* The table of a coefficient of the contact that depends on the normal speed. */
typedef struct gg_dsmc_lane_law {
  const gg_real *values;      /* NULL: the coefficient is constant */
  const gg_loss_table *table; /* its steps */
} gg_dsmc_lane_law;

/* A pass in progress: constants and sums that the compiler can keep in registers. */
typedef struct gg_dsmc_pass_state {
  gg_dsmc_real_block *one, *two, *spin_one, *spin_two;
  float *bound_one, *bound_two;
  bool any_odd; /* a last block is not full: odd_one, odd_two; UINT32_MAX: none */
  gg_vu odd_one, odd_two, first_one, first_two, n_one, n_two; /* the same in all lanes */
  gg_dsmc_lane_contact contact;
  gg_dsmc_lane_law law[GG_N_COEFFICIENTS];
  gg_real loss_scale;      /* unit of their speeds over the present one */
  bool sorts;              /* lanes are exchanged by speed; false: at random */
  gg_real floor, majorant; /* layer of |C12| */
  gg_real s0, shift;
  gg_real lowest;          /* lower end of t: floor - s0 */
  bool from_zero;          /* lowest is 0 */
  gg_vd to_a, to_b;        /* factors of J, or of 2 g_n k, in changes of velocity */
  bool correction_pass;    /* correction pass: all block pairs have the same majorant */
  gg_vd most, most_rate;   /* majorant; majorant + s0 */
  double scale;            /* of the speed bounds, at the next draw */
  double margin;           /* of new speed bounds; above 1: the scale is constant */
  gg_real root, per_scale; /* square root and inverse of the scale at the last draws */
  uint64_t block_pairs, collisions, overflows, clamped;
  gg_vd largest; /* largest C12^2 */
  gg_dsmc_sums sums;
} gg_dsmc_pass_state;

/* Random streams and prefetched samples, separate from the pass state so that they stay in registers. */
typedef struct gg_dsmc_samples {
  gg_dsmc_lane_rng rng;
  gg_dsmc_directions near, sheared; /* about C12; by the law |k_x k_y| */
} gg_dsmc_samples;

/* A candidate pair in each lane. Without a collision the other members are finite and unused. */
typedef struct gg_dsmc_candidate {
  gg_mask hit, special; /* hit: it collides; special: by the second law */
  gg_vd speed, t;
  gg_vd3 q;    /* direction by the cosine law about the z axis, or uniform */
  gg_vd3 k, g; /* k: if needed; g: contact velocity without spins */
  gg_vd3 gn_k; /* 2 g_n k, if k is not needed */
  gg_vd gn;
} gg_dsmc_candidate;

GG_INLINE bool gg_dsmc_needs_k(gg_dsmc_features features)
{
  return features.rule != GG_SMOOTH || features.shear == GG_DSMC_SHEARED_DENSE || features.sums == GG_DSMC_STRESS ||
         features.own;
}

/* True if gg_dsmc_mirror_scale is computed in the first stage. With shear between the centres the second stage is
 * longer. */
GG_INLINE bool gg_dsmc_scales_early(gg_dsmc_features features)
{
  return features.shear == GG_DSMC_SHEARED_DENSE;
}

/* z component of the Householder vector v +- |v| z that mirrors the z axis to the direction of v, or against it. */
GG_INLINE gg_vd gg_dsmc_mirror_z(gg_vd3 v, gg_vd speed)
{
  return v.z + (gg_vd)((gg_vu)speed | ((gg_vu)v.z & (gg_vu)gg_all(-0.0)));
}

/* Half the inverse square of the length of the Householder vector. Its latency is long, so it is computed as soon as v
 * is known. */
GG_INLINE gg_vd gg_dsmc_mirror_scale(gg_vd3 v, gg_vd speed)
{
  return 1 / (speed * gg_dsmc_abs(gg_dsmc_mirror_z(v, speed)) + GG_TINY); /* GG_TINY prevents 0/0 for v = 0 */
}

/* Map q from the z axis to the direction of v, by reflection. */
GG_INLINE gg_vd3 gg_dsmc_mirror(gg_vd3 v, gg_vd speed, gg_vd scale, gg_vd3 q)
{
  const gg_vu sign = (gg_vu)v.z & (gg_vu)gg_all(-0.0);
  gg_vd3 h = {v.x, v.y, gg_dsmc_mirror_z(v, speed)};
  gg_vd3 m = {q.x, q.y, (gg_vd)((gg_vu)q.z ^ sign ^ (gg_vu)gg_all(-0.0))};
  return gg_vd3_sub(m, gg_vd3_scale(gg_vd3_dot(h, m) * scale, h));
}

/* Accept candidates by a random word, with t from `lowest` (0 if from_zero) to `majorant`: `hit` by the first law,
 * `special` are candidates of the second law. */
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

/* Rescale t in a correction, so that its remainder is uniform from 0 to the speed. */
GG_INLINE void gg_dsmc_candidate_correct(gg_real lowest, gg_dsmc_candidate *candidate)
{
  candidate->t = (candidate->t - lowest) * candidate->speed / (candidate->speed - lowest);
}

/* Shear between the centres: draw k by the second law in lanes of `special`, then make the last acceptance. */
GG_INLINE void gg_dsmc_candidate_accept_sheared(const gg_dsmc_pass_state *state, gg_dsmc_samples *samples, gg_vd3 v,
                                                gg_dsmc_candidate *candidate)
{
  gg_vd3 k = candidate->k, other = gg_dsmc_directions_take(&samples->sheared, candidate->special);
  k = (gg_vd3){gg_select(candidate->special, other.x, k.x), gg_select(candidate->special, other.y, k.y),
               gg_select(candidate->special, other.z, k.z)};
  gg_vd gn = gg_vd3_dot(k, v), shear = state->shift * k.x * k.y, most = gg_larger(gn, gg_all(0)) + gg_dsmc_abs(shear);
  gg_vd left = gg_dsmc_abs(candidate->t),
        range = gg_select(candidate->special, gg_all(state->s0), candidate->speed); /* special lanes: t < 0 */
  candidate->k = k;
  candidate->gn = gn - shear;
  candidate->g.x -= state->shift * k.y;
  candidate->hit = gg_and(gg_or(candidate->hit, candidate->special), gg_less(left * most, range * candidate->gn));
}

/* Compute the direction k of candidates with relative velocity v. `scale`: gg_dsmc_mirror_scale of v, if computed
 * early. */
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
