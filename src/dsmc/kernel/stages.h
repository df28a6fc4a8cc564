/* A block pair goes through three stages: load and relative speeds; accept and impulse; write back. */
#ifndef GG_DSMC_STAGES_H
#define GG_DSMC_STAGES_H

#include "dsmc/kernel/block_pairs.h"

GG_INLINE gg_vd3 gg_dsmc_lanes_load(const gg_dsmc_real_block *b, int at)
{
  return (gg_vd3){gg_load(b->x + at), gg_load(b->y + at), gg_load(b->z + at)};
}

GG_INLINE void gg_dsmc_lanes_store(gg_dsmc_real_block *b, int at, gg_vd3 v)
{
  gg_store(b->x + at, v.x);
  gg_store(b->y + at, v.y);
  gg_store(b->z + at, v.z);
}

/* The true lanes of `yes`, the others of `no`. */
GG_INLINE void gg_dsmc_lanes_store_either(gg_dsmc_real_block *b, int at, gg_mask m, gg_vd3 yes, gg_vd3 no)
{
  gg_store_either(b->x + at, m, yes.x, no.x);
  gg_store_either(b->y + at, m, yes.y, no.y);
  gg_store_either(b->z + at, m, yes.z, no.z);
}

/* a and b go to their blocks; if they are of one species, lanes of `swap` are exchanged. */
GG_INLINE void gg_dsmc_lanes_store_pair(gg_dsmc_features f, gg_dsmc_real_block *one, gg_dsmc_real_block *two, int at,
                                        gg_mask swap, gg_vd3 a, gg_vd3 b)
{
  if (f.same) {
    gg_dsmc_lanes_store_either(one, at, swap, b, a);
    gg_dsmc_lanes_store_either(two, at, swap, a, b);
  } else {
    gg_dsmc_lanes_store(one, at, a);
    gg_dsmc_lanes_store(two, at, b);
  }
}

/* A block pair between its stages, each of which waits for the one before. */
typedef struct gg_dsmc_block_pair {
  uint32_t one, two;
  gg_dsmc_real_block *a, *b;
  bool correct;              /* the majorant was too small: to be followed by a correction */
  gg_word order;             /* of the lanes of the second */
  gg_real strain, per_scale; /* if sheared */
  gg_real lowest, majorant;  /* of t (candidate.h) */
  bool from_zero;            /* lowest is 0 */
  bool layer;                /* is a correction itself */
  gg_real most;              /* majorant of the correction */
  /* The first block is read again where it is needed: nothing writes it meanwhile. The second is permuted: kept here.
   */
  gg_vd3 cb[GG_PARTS], sb[GG_PARTS];
  gg_vd3 v[GG_PARTS];
  gg_vd v2[GG_PARTS], speed[GG_PARTS];
  gg_vd scale[GG_PARTS]; /* gg_dsmc_mirror_scale, if computed early */
  gg_vu word[GG_PARTS];  /* random */
  gg_vd3 k[GG_PARTS];    /* if grains have spins */
  gg_vd3 J[GG_PARTS];    /* 0 without a collision; 2 g_n k where k is not needed */
  gg_dsmc_note *note;    /* has these two, part by part, if there is a stress to be summed */
} gg_dsmc_block_pair;

/* Largest C^2 of each block after its collisions, lane by lane. */
typedef struct gg_dsmc_largest_squares {
  gg_vd a, b;
} gg_dsmc_largest_squares;

GG_INLINE gg_vd3 *gg_dsmc_normals(gg_dsmc_features f, gg_dsmc_block_pair *at, int part)
{
  return f.sums == GG_DSMC_STRESS ? &at->note[part].k : &at->k[part];
}
GG_INLINE gg_vd3 *gg_dsmc_impulses(gg_dsmc_features f, gg_dsmc_block_pair *at, int part)
{
  return f.sums == GG_DSMC_STRESS ? &at->note[part].J : &at->J[part];
}

/* C of a stored velocity. */
GG_INLINE gg_vd3 gg_dsmc_streamed(gg_dsmc_features f, gg_real strain, gg_vd3 c)
{
  if (f.shear != GG_DSMC_UNSHEARED) c.x -= strain * c.y;
  return c;
}

/* Third stage: spins. */
GG_INLINE void gg_dsmc_write_back_spins(gg_dsmc_features f, gg_dsmc_pass_state *w, gg_mask swap, gg_dsmc_block_pair *at,
                                        int part)
{
  gg_vd ik1 = gg_all(w->contact.ik1), ik2 = f.same ? ik1 : gg_all(w->contact.ik2);
  gg_vd3 sa = gg_dsmc_lanes_load(&w->spin_one[at->one], part * GG_WIDTH), sb = at->sb[part];
  gg_vd3_kick_spins(ik1, ik2, *gg_dsmc_normals(f, at, part), *gg_dsmc_impulses(f, at, part), &sa, &sb);
  gg_dsmc_lanes_store_pair(f, &w->spin_one[at->one], &w->spin_two[at->two], part * GG_WIDTH, swap, sa, sb);
}

/* Third stage: velocities. Grains of one species are exchanged so that the faster one is in the first block. Returns
 * where. */
GG_INLINE gg_mask gg_dsmc_write_back_velocities(gg_dsmc_features f, gg_dsmc_pass_state *w, gg_dsmc_block_pair *at,
                                                int part, gg_dsmc_largest_squares *most)
{
  gg_vd3 J = *gg_dsmc_impulses(f, at, part);
  if (f.shear != GG_DSMC_UNSHEARED) J.x += at->strain * J.y; /* as stored velocities have it */
  gg_vd3 a = gg_dsmc_lanes_load(at->a, part * GG_WIDTH), b = at->cb[part];
  const gg_vd to_a = f.same && gg_dsmc_needs_k(f) ? gg_all(1) : w->to_a, to_b = f.same ? to_a : w->to_b;
  gg_vd3_kick_centres(to_a, to_b, J, &a, &b);
  gg_vd3 Ca = gg_dsmc_streamed(f, at->strain, a), Cb = gg_dsmc_streamed(f, at->strain, b);
  gg_vd a2 = gg_vd3_dot(Ca, Ca), b2 = gg_vd3_dot(Cb, Cb);
  gg_mask swap = w->sorts ? gg_less(a2, b2) : gg_low_bit(at->word[part] >> GG_SPARE_BIT);
  gg_vd first = f.same ? gg_select(swap, b2, a2) : a2, second = f.same ? gg_select(swap, a2, b2) : b2;
  most->a = part ? gg_larger(most->a, first) : first;
  most->b = part ? gg_larger(most->b, second) : second;
  gg_dsmc_lanes_store_pair(f, at->a, at->b, part * GG_WIDTH, swap, a, b);
  return swap;
}

/* Third stage: write back, and renew the speed bounds of both blocks. */
GG_INLINE void gg_dsmc_write_back(gg_dsmc_features f, gg_dsmc_pass_state *w, gg_dsmc_block_pair *at)
{
  gg_dsmc_largest_squares most;
  for (int part = 0; part < GG_PARTS; part++) {
    gg_mask swap = gg_dsmc_write_back_velocities(f, w, at, part, &most);
    if (f.rule != GG_SMOOTH) gg_dsmc_write_back_spins(f, w, swap, at, part);
  }
  gg_v2 peaks = gg_dsmc_peaks(most.a, most.b) * (f.shear == GG_DSMC_UNSHEARED ? w->per_scale : at->per_scale);
  gg_dsmc_peaks_store(peaks, &w->bound_one[at->one], &w->bound_two[at->two]);
}

/* Block b with its lanes in order r (of which the low bits count), in registers. */
GG_INLINE void gg_dsmc_load_permuted(const gg_dsmc_real_block *b, gg_word r, gg_vd3 c[GG_PARTS])
{
  gg_order order = gg_order_of(r);
  for (unsigned part = 0; part < GG_PARTS; part++) {
    unsigned from = (part ^ (unsigned)(r / GG_WIDTH % GG_PARTS)) * GG_WIDTH;
    c[part] = (gg_vd3){gg_permute(gg_load(b->x + from), order), gg_permute(gg_load(b->y + from), order),
                       gg_permute(gg_load(b->z + from), order)};
  }
}

/* Majorant overflow: some pair is faster than the sum of speed bounds by which its blocks were drawn. One of them has
 * collided since, or the gas is faster than the majorant of all. Such pairs should collide more often than once a draw.
 * So a correction over the layer above the majorant follows, with the probability that makes the rates right:
 * `correct`. (All lanes under a higher majorant, and a second time now and then, would have the same rates. But pairs
 * that collide twice in a row scatter no further than once, and there would be more of them.) */
GG_INLINE void gg_dsmc_check_majorant(gg_dsmc_pass_state *w, gg_dsmc_block_pair *at, gg_rng *rng)
{
  const gg_real majorant = at->majorant;
  gg_vd most = at->v2[0];
  for (int part = 0; part < GG_PARTS; part++) {
    most = gg_larger(most, at->v2[part]);
    w->overflows += (unsigned)__builtin_popcount(gg_bits(gg_less(gg_all(w->majorant), at->speed[part])));
  }
  gg_real now = (gg_real)fmin(sqrt(gg_dsmc_peaks(most, most)[0]) * (1 + 1e-15), w->majorant);
  if (now <= majorant) return;
  at->correct = gg_rng_uniform(rng) * (majorant - at->lowest) < now - majorant;
  at->most = now;
}

/* First stage: load the next block pair of the list, and its relative speeds. */
GG_INLINE void gg_dsmc_load(gg_dsmc_features f, gg_dsmc_pass_state *w, const gg_dsmc_block_pairs *d,
                            gg_dsmc_block_pair *at)
{
  const unsigned i = d->at;
  at->one = (uint32_t)gg_dsmc_listed(d->one, i);
  at->two = (uint32_t)gg_dsmc_listed(d->two, i);
  at->a = &w->one[at->one];
  at->b = &w->two[at->two];
  at->order = gg_dsmc_listed(d->order, i);
  at->majorant = d->majorant[i];
  at->correct = at->layer = false;
  at->lowest = w->lowest;
  at->from_zero = w->from_zero;
  if (__builtin_expect(d->layer, 0)) {
    at->layer = true;
    at->lowest = d->lowest;
    at->from_zero = false;
  }
  at->strain = f.shear == GG_DSMC_UNSHEARED ? 0 : d->strains[i];
  if (f.shear != GG_DSMC_UNSHEARED) at->per_scale = d->per_scale[i];
  gg_dsmc_load_permuted(at->b, at->order, at->cb);
  if (f.rule != GG_SMOOTH) gg_dsmc_load_permuted(&w->spin_two[at->two], at->order, at->sb);
  for (int part = 0; part < GG_PARTS; part++) {
    gg_vd3 ca = gg_dsmc_lanes_load(at->a, part * GG_WIDTH);
    at->v[part] = gg_dsmc_streamed(f, at->strain, gg_vd3_sub(ca, at->cb[part]));
    at->v2[part] = gg_vd3_dot(at->v[part], at->v[part]);
    at->speed[part] = gg_sqrt(at->v2[part]);
    if (gg_dsmc_scales_early(f)) at->scale[part] = gg_dsmc_mirror_scale(at->v[part], at->speed[part]);
  }
}

/* J_n = m_r (1+e) g_n. */
GG_INLINE gg_vd gg_dsmc_normal_impulse(gg_dsmc_features f, const gg_dsmc_pass_state *w, gg_vd gn)
{
  if (!f.law) return w->contact.jn * gn;
  return w->contact.mr * gn * (2 - gg_vd3_loss_at(w->losses, w->loss_scale * gn));
}

/* Who is accepted, along which k, with what impulse? */
GG_INLINE void gg_dsmc_accept_part(gg_dsmc_features f, gg_dsmc_pass_state *w, gg_dsmc_samples *c,
                                   gg_dsmc_block_pair *at, int part)
{
  gg_dsmc_candidate e = {.speed = at->speed[part]};
  gg_dsmc_candidate_accept(f, at->from_zero, at->lowest, at->majorant, at->word[part], &e);
  if (__builtin_expect(at->layer, 0)) gg_dsmc_candidate_in_layer(at->lowest, &e);
  e.q = gg_dsmc_directions_take(&c->near, e.hit);
  gg_vd scale = gg_dsmc_scales_early(f) ? at->scale[part] : gg_all(0);
  gg_dsmc_candidate_direction(f, w, c, at->v[part], scale, &e);
  if (f.rule != GG_SMOOTH) {
    gg_vd3 sa = gg_dsmc_lanes_load(&w->spin_one[at->one], part * GG_WIDTH);
    e.g = gg_vd3_contact_velocity(f.rule, e.k, e.g, sa, at->sb[part]);
  }
  const gg_vd Jn = gg_dsmc_normal_impulse(f, w, e.gn);
  gg_vd3 J = gg_dsmc_needs_k(f) ? gg_vd3_impulse_of(f.rule, &w->contact, e.k, e.g, e.gn, Jn) : e.gn_k;
  J = (gg_vd3){gg_where(e.hit, J.x), gg_where(e.hit, J.y), gg_where(e.hit, J.z)};
  if (gg_dsmc_needs_k(f)) *gg_dsmc_normals(f, at, part) = e.k;
  *gg_dsmc_impulses(f, at, part) = J;
  w->largest = gg_larger(w->largest, at->v2[part]);
  w->collisions += (unsigned)__builtin_popcount(gg_bits(e.hit));
  if (!gg_dsmc_needs_k(f)) J = gg_vd3_scale(gg_all(0.5 * w->contact.jn), J);
  gg_dsmc_note_loss(f, &w->sums.note[w->sums.n][part], e.g, J, gg_where(e.hit, Jn));
}

/* Some directions more than are needed now. */
GG_INLINE void gg_dsmc_prefetch_directions(gg_dsmc_features f, gg_dsmc_samples *c)
{
  gg_dsmc_directions_make(&c->near, &c->rng, gg_dsmc_needs_k(f) ? GG_DSMC_COSINE : GG_DSMC_UNIFORM);
}

/* Second stage: acceptance and impulses. */
GG_INLINE void gg_dsmc_accept(gg_dsmc_features f, gg_dsmc_pass_state *w, gg_dsmc_samples *c, gg_rng *rng,
                              gg_dsmc_block_pair *at)
{
  unsigned faster = 0;
  for (int part = 0; part < GG_PARTS; part++) faster |= gg_bits(gg_less(gg_all(at->majorant), at->speed[part]));
  if (__builtin_expect(faster, 0)) gg_dsmc_check_majorant(w, at, rng);
  gg_dsmc_directions_ensure(&c->near, &c->rng, gg_dsmc_needs_k(f) ? GG_DSMC_COSINE : GG_DSMC_UNIFORM);
  if (f.shear == GG_DSMC_SHEARED_DENSE) gg_dsmc_directions_ensure(&c->sheared, &c->rng, GG_DSMC_SHEAR_LAW);
  if (f.sums == GG_DSMC_STRESS) at->note = w->sums.note[w->sums.n];
  for (int part = 0; part < GG_PARTS; part++) gg_dsmc_accept_part(f, w, c, at, part);
  gg_dsmc_sums_next(f, &w->sums);
  w->block_pairs++;
}

#endif
