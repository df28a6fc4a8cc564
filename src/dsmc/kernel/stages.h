/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The three stages of a block pair: load and relative speeds; accept and impulse; write back. */
#ifndef GG_DSMC_STAGES_H
#define GG_DSMC_STAGES_H

#include "dsmc/kernel/block_pairs.h"

GG_INLINE gg_vd3 gg_dsmc_lanes_load(const gg_dsmc_real_block *block, int at)
{
  return (gg_vd3){gg_load(block->x + at), gg_load(block->y + at), gg_load(block->z + at)};
}

GG_INLINE void gg_dsmc_lanes_store(gg_dsmc_real_block *block, int at, gg_vd3 v)
{
  gg_store(block->x + at, v.x);
  gg_store(block->y + at, v.y);
  gg_store(block->z + at, v.z);
}

/* Store the true lanes of `yes`, and the other lanes of `no`. */
GG_INLINE void gg_dsmc_lanes_store_either(gg_dsmc_real_block *block, int at, gg_mask mask, gg_vd3 yes, gg_vd3 no)
{
  gg_store_either(block->x + at, mask, yes.x, no.x);
  gg_store_either(block->y + at, mask, yes.y, no.y);
  gg_store_either(block->z + at, mask, yes.z, no.z);
}

/* Store a and b in their blocks; for one species the lanes of `swap` are exchanged. */
GG_INLINE void gg_dsmc_lanes_store_pair(gg_dsmc_features features, gg_dsmc_real_block *one, gg_dsmc_real_block *two,
                                        int at, gg_mask swap, gg_vd3 a, gg_vd3 b)
{
  if (features.same) {
    gg_dsmc_lanes_store_either(one, at, swap, b, a);
    gg_dsmc_lanes_store_either(two, at, swap, a, b);
  } else {
    gg_dsmc_lanes_store(one, at, a);
    gg_dsmc_lanes_store(two, at, b);
  }
}

/* A block pair between its stages. */
typedef struct gg_dsmc_block_pair {
  uint32_t one, two;
  gg_dsmc_real_block *a, *b;
  bool needs_correction;     /* the majorant was too small: a correction must follow */
  gg_word order;             /* of the lanes of the second block */
  gg_real strain, per_scale; /* if sheared */
  gg_real lowest, majorant;  /* of t (candidate.h) */
  bool from_zero;            /* lowest is 0 */
  bool is_correction;        /* this pair is a correction */
  gg_real most;              /* majorant of the correction that must follow */
  /* The first block is loaded again when it is needed: it is unchanged meanwhile. The second one is stored here,
   * permuted. */
  gg_vd3 cb[GG_PARTS], sb[GG_PARTS];
  gg_vd3 v[GG_PARTS];
  gg_vd v2[GG_PARTS], speed[GG_PARTS];
  gg_vd scale[GG_PARTS]; /* gg_dsmc_mirror_scale, if computed early */
  gg_vu word[GG_PARTS];  /* random */
  gg_vd3 k[GG_PARTS];    /* if grains have spins */
  gg_vd3 J[GG_PARTS];    /* 0 without a collision; 2 g_n k if k is not needed */
  gg_dsmc_note *note;    /* holds k and J in place of these two if the stress is summed */
} gg_dsmc_block_pair;

/* Largest C^2 of each block after its collisions, lane by lane. */
typedef struct gg_dsmc_largest_squares {
  gg_vd a, b;
} gg_dsmc_largest_squares;

GG_INLINE gg_vd3 *gg_dsmc_normals(gg_dsmc_features features, gg_dsmc_block_pair *at, int part)
{
  return features.sums == GG_DSMC_STRESS ? &at->note[part].k : &at->k[part];
}
GG_INLINE gg_vd3 *gg_dsmc_impulses(gg_dsmc_features features, gg_dsmc_block_pair *at, int part)
{
  return features.sums == GG_DSMC_STRESS ? &at->note[part].J : &at->J[part];
}

/* Peculiar velocity C of a stored velocity. */
GG_INLINE gg_vd3 gg_dsmc_streamed(gg_dsmc_features features, gg_real strain, gg_vd3 c)
{
  if (features.shear != GG_DSMC_UNSHEARED) c.x -= strain * c.y;
  return c;
}

/* Third stage: write back the spins. */
GG_INLINE void gg_dsmc_write_back_spins(gg_dsmc_features features, gg_dsmc_pass_state *state, gg_mask swap,
                                        gg_dsmc_block_pair *at, int part)
{
  gg_vd ik1 = gg_all(state->contact.ik1), ik2 = features.same ? ik1 : gg_all(state->contact.ik2);
  gg_vd3 sa = gg_dsmc_lanes_load(&state->spin_one[at->one], part * GG_WIDTH), sb = at->sb[part];
  gg_vd3_kick_spins(ik1, ik2, *gg_dsmc_normals(features, at, part), *gg_dsmc_impulses(features, at, part), &sa, &sb);
  gg_dsmc_lanes_store_pair(features, &state->spin_one[at->one], &state->spin_two[at->two], part * GG_WIDTH, swap, sa,
                           sb);
}

/* Third stage: write back the velocities. Grains of one species are exchanged so that the faster one is in the first
 * block. Returns the exchanged lanes. */
GG_INLINE gg_mask gg_dsmc_write_back_velocities(gg_dsmc_features features, gg_dsmc_pass_state *state,
                                                gg_dsmc_block_pair *at, int part, gg_dsmc_largest_squares *most)
{
  gg_vd3 J = *gg_dsmc_impulses(features, at, part);
  if (features.shear != GG_DSMC_UNSHEARED) J.x += at->strain * J.y; /* for stored velocities */
  gg_vd3 a = gg_dsmc_lanes_load(at->a, part * GG_WIDTH), b = at->cb[part];
  const gg_vd to_a = features.same && gg_dsmc_needs_k(features) ? gg_all(1) : state->to_a,
              to_b = features.same ? to_a : state->to_b;
  gg_vd3_kick_centres(to_a, to_b, J, &a, &b);
  gg_vd3 Ca = gg_dsmc_streamed(features, at->strain, a), Cb = gg_dsmc_streamed(features, at->strain, b);
  gg_vd a2 = gg_vd3_dot(Ca, Ca), b2 = gg_vd3_dot(Cb, Cb);
  gg_mask swap = state->sorts ? gg_less(a2, b2) : gg_low_bit(at->word[part] >> GG_SPARE_BIT);
  gg_vd first = features.same ? gg_select(swap, b2, a2) : a2, second = features.same ? gg_select(swap, a2, b2) : b2;
  most->a = part ? gg_larger(most->a, first) : first;
  most->b = part ? gg_larger(most->b, second) : second;
  gg_dsmc_lanes_store_pair(features, at->a, at->b, part * GG_WIDTH, swap, a, b);
  return swap;
}

/* Third stage: write back, and renew the speed bounds of both blocks. */
GG_INLINE void gg_dsmc_write_back(gg_dsmc_features features, gg_dsmc_pass_state *state, gg_dsmc_block_pair *at)
{
  gg_dsmc_largest_squares most;
  for (int part = 0; part < GG_PARTS; part++) {
    gg_mask swap = gg_dsmc_write_back_velocities(features, state, at, part, &most);
    if (features.rule != GG_SMOOTH) gg_dsmc_write_back_spins(features, state, swap, at, part);
  }
  gg_v2 peaks =
      gg_dsmc_peaks(most.a, most.b) * (features.shear == GG_DSMC_UNSHEARED ? state->per_scale : at->per_scale);
  gg_dsmc_peaks_store(peaks, &state->bound_one[at->one], &state->bound_two[at->two]);
}

/* Load a block into registers with its lanes permuted; only the low bits of `order` count. */
GG_INLINE void gg_dsmc_load_permuted(const gg_dsmc_real_block *block, gg_word order, gg_vd3 c[GG_PARTS])
{
  gg_order permutation = gg_order_of(order);
  for (unsigned part = 0; part < GG_PARTS; part++) {
    unsigned from = (part ^ (unsigned)(order / GG_WIDTH % GG_PARTS)) * GG_WIDTH;
    c[part] =
        (gg_vd3){gg_permute(gg_load(block->x + from), permutation), gg_permute(gg_load(block->y + from), permutation),
                 gg_permute(gg_load(block->z + from), permutation)};
  }
}

/* Handle a majorant overflow: a pair is faster than the sum of speed bounds by which its blocks were drawn, because one
 * of them has collided since, or because it exceeds the majorant of all. Such pairs must collide more often than once a
 * draw. So a correction over the layer above the majorant follows, with the probability that makes the rates right:
 * `needs_correction`. (Testing all lanes under a higher majorant, and sometimes twice, would give the same rates. But
 * pairs that collide twice in succession scatter no more than once, and there would be more of them.) */
GG_INLINE void gg_dsmc_check_majorant(gg_dsmc_pass_state *state, gg_dsmc_block_pair *at, gg_rng *rng)
{
  const gg_real majorant = at->majorant;
  gg_vd most = at->v2[0];
  for (int part = 0; part < GG_PARTS; part++) {
    most = gg_larger(most, at->v2[part]);
    state->overflows += (unsigned)__builtin_popcount(gg_bits(gg_less(gg_all(state->majorant), at->speed[part])));
  }
  gg_real now = (gg_real)fmin(sqrt(gg_dsmc_peaks(most, most)[0]) * (1 + 1e-15), state->majorant);
  if (now <= majorant) return;
  at->needs_correction = gg_rng_uniform(rng) * (majorant - at->lowest) < now - majorant;
  at->most = now;
}

/* First stage: load the next block pair of the list, and compute its relative speeds. */
GG_INLINE void gg_dsmc_load(gg_dsmc_features features, gg_dsmc_pass_state *state, const gg_dsmc_block_pairs *pairs,
                            gg_dsmc_block_pair *at)
{
  const unsigned i = pairs->at;
  at->one = (uint32_t)gg_dsmc_listed(pairs->one, i);
  at->two = (uint32_t)gg_dsmc_listed(pairs->two, i);
  at->a = &state->one[at->one];
  at->b = &state->two[at->two];
  at->order = gg_dsmc_listed(pairs->order, i);
  at->majorant = pairs->majorant[i];
  at->needs_correction = at->is_correction = false;
  at->lowest = state->lowest;
  at->from_zero = state->from_zero;
  if (__builtin_expect(pairs->correction, 0)) {
    at->is_correction = true;
    at->lowest = pairs->lowest;
    at->from_zero = false;
  }
  at->strain = features.shear == GG_DSMC_UNSHEARED ? 0 : pairs->strains[i];
  if (features.shear != GG_DSMC_UNSHEARED) at->per_scale = pairs->per_scale[i];
  gg_dsmc_load_permuted(at->b, at->order, at->cb);
  if (features.rule != GG_SMOOTH) gg_dsmc_load_permuted(&state->spin_two[at->two], at->order, at->sb);
  for (int part = 0; part < GG_PARTS; part++) {
    gg_vd3 ca = gg_dsmc_lanes_load(at->a, part * GG_WIDTH);
    at->v[part] = gg_dsmc_streamed(features, at->strain, gg_vd3_sub(ca, at->cb[part]));
    at->v2[part] = gg_vd3_dot(at->v[part], at->v[part]);
    at->speed[part] = gg_sqrt(at->v2[part]);
    if (gg_dsmc_scales_early(features)) at->scale[part] = gg_dsmc_mirror_scale(at->v[part], at->speed[part]);
  }
}

/* A coefficient of the contact, as tables have it, at the speeds u. */
GG_INLINE gg_vd gg_dsmc_law_at(const gg_dsmc_lane_law *law, gg_vd u)
{
  const gg_loss_table *table = law->table;
  gg_vd x = gg_vd3_loss_at(law->values, u);
  for (int k = 0; k < table->n_steps; k++)
    x += gg_select(gg_less(u, gg_all((gg_real)table->at[k])), gg_all(0), gg_all((gg_real)table->height[k]));
  return x;
}

/* Lanes in which a law itself has no allowed value, as bits. */
GG_INLINE unsigned gg_dsmc_law_clamps(const gg_dsmc_lane_law *law, gg_vd u)
{
  const gg_loss_table *table = law->table;
  unsigned lanes = 0;
  for (int k = 0; k < table->n_invalid; k++)
    lanes |= gg_bits(gg_less(u, gg_all((gg_real)table->to[k]))) & ~gg_bits(gg_less(u, gg_all((gg_real)table->from[k])));
  return lanes;
}

/* The coefficients of the contacts: the normal impulse J_n = m_r (1+e) g_n, without kicks, jt = m_t (1+beta), and
 * mu. */
typedef struct gg_dsmc_coefficients {
  gg_vd Jn, jt, mu;
} gg_dsmc_coefficients;

GG_INLINE gg_dsmc_coefficients gg_dsmc_coefficients_at(gg_dsmc_features features, gg_dsmc_pass_state *state,
                                                       gg_mask hit, gg_vd gn)
{
  const gg_dsmc_lane_contact *c = &state->contact;
  gg_dsmc_coefficients at = {c->jn * gn, gg_all(c->jt), gg_all(c->mu)};
  if (!features.own) return at;
  const gg_dsmc_lane_law *law = state->law;
  const gg_vd u = state->loss_scale * gn;
  unsigned clamped = 0;
  for (int k = 0; k < GG_N_COEFFICIENTS; k++)
    if (law[k].values) clamped |= gg_dsmc_law_clamps(&law[k], u);
  state->clamped += (unsigned)__builtin_popcount(gg_bits(hit) & clamped);
  if (law[GG_OF_E].values) at.Jn = c->mr * gn * (2 - gg_dsmc_law_at(&law[GG_OF_E], u));
  if (features.rule == GG_SMOOTH) return at;
  if (law[GG_OF_BETA].values) at.jt = c->mt * gg_dsmc_law_at(&law[GG_OF_BETA], u);
  if (law[GG_OF_MU].values) at.mu = gg_dsmc_law_at(&law[GG_OF_MU], u);
  return at;
}

/* Second stage of a part: accept candidates, and compute their directions and impulses. */
GG_INLINE void gg_dsmc_accept_part(gg_dsmc_features features, gg_dsmc_pass_state *state, gg_dsmc_samples *samples,
                                   gg_dsmc_block_pair *at, int part)
{
  gg_dsmc_candidate candidate = {.speed = at->speed[part]};
  gg_dsmc_candidate_accept(features, at->from_zero, at->lowest, at->majorant, at->word[part], &candidate);
  if (__builtin_expect(at->is_correction, 0)) gg_dsmc_candidate_correct(at->lowest, &candidate);
  candidate.q = gg_dsmc_directions_take(&samples->near, candidate.hit);
  gg_vd scale = gg_dsmc_scales_early(features) ? at->scale[part] : gg_all(0);
  gg_dsmc_candidate_direction(features, state, samples, at->v[part], scale, &candidate);
  if (features.rule != GG_SMOOTH) {
    gg_vd3 sa = gg_dsmc_lanes_load(&state->spin_one[at->one], part * GG_WIDTH);
    candidate.g = gg_vd3_contact_velocity(features.rule, candidate.k, candidate.g, sa, at->sb[part]);
  }
  const gg_dsmc_coefficients by = gg_dsmc_coefficients_at(features, state, candidate.hit, candidate.gn);
  const bool kicks = features.own && __builtin_expect(state->sums.kicks, 0);
  gg_vd3 J;
  if (kicks)
    J = gg_vd3_kicked_impulse_of(features.rule, &state->contact, by.jt, by.mu, candidate.k, candidate.g, candidate.gn,
                                 by.Jn);
  else
    J = gg_dsmc_needs_k(features)
            ? gg_vd3_impulse_of(features.rule, by.jt, by.mu, candidate.k, candidate.g, candidate.gn, by.Jn)
            : candidate.gn_k;
  J = (gg_vd3){gg_where(candidate.hit, J.x), gg_where(candidate.hit, J.y), gg_where(candidate.hit, J.z)};
  if (gg_dsmc_needs_k(features)) *gg_dsmc_normals(features, at, part) = candidate.k;
  *gg_dsmc_impulses(features, at, part) = J;
  state->largest = gg_larger(state->largest, at->v2[part]);
  state->collisions += (unsigned)__builtin_popcount(gg_bits(candidate.hit));
  if (!gg_dsmc_needs_k(features)) J = gg_vd3_scale(gg_all(0.5 * state->contact.jn), J);
  gg_dsmc_note *note = &state->sums.note[state->sums.n][part];
  const gg_vd Jn_kicked = kicks ? by.Jn + gg_vd3_normal_kick(&state->contact, candidate.k) : by.Jn;
  gg_dsmc_note_loss(features, note, candidate.g, J, gg_where(candidate.hit, Jn_kicked));
  if (kicks)
    note->given = gg_where(candidate.hit,
                           gg_vd3_kick_energy(&state->contact, candidate.k, candidate.g, candidate.gn, J, Jn_kicked));
}

/* Sample directions in advance. */
GG_INLINE void gg_dsmc_prefetch_directions(gg_dsmc_features features, gg_dsmc_samples *samples)
{
  gg_dsmc_directions_make(&samples->near, &samples->rng, gg_dsmc_needs_k(features) ? GG_DSMC_COSINE : GG_DSMC_UNIFORM);
}

/* Second stage: acceptance and impulses. */
GG_INLINE void gg_dsmc_accept(gg_dsmc_features features, gg_dsmc_pass_state *state, gg_dsmc_samples *samples,
                              gg_rng *rng, gg_dsmc_block_pair *at)
{
  unsigned faster = 0;
  for (int part = 0; part < GG_PARTS; part++) faster |= gg_bits(gg_less(gg_all(at->majorant), at->speed[part]));
  if (__builtin_expect(faster, 0)) gg_dsmc_check_majorant(state, at, rng);
  gg_dsmc_directions_ensure(&samples->near, &samples->rng,
                            gg_dsmc_needs_k(features) ? GG_DSMC_COSINE : GG_DSMC_UNIFORM);
  if (features.shear == GG_DSMC_SHEARED_DENSE)
    gg_dsmc_directions_ensure(&samples->sheared, &samples->rng, GG_DSMC_SHEAR_LAW);
  if (features.sums == GG_DSMC_STRESS) at->note = state->sums.note[state->sums.n];
  for (int part = 0; part < GG_PARTS; part++) gg_dsmc_accept_part(features, state, samples, at, part);
  gg_dsmc_sums_next(features, &state->sums);
  state->block_pairs++;
}

#endif
