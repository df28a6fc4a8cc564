/* A visit: two blocks that meet, what comes of it, and how it is written back. */
#ifndef GG_DSMC_BLOCK_VISIT_H
#define GG_DSMC_BLOCK_VISIT_H

#include "dsmc/kernel/block_draw.h"

GG_INLINE gg_vd3 gg_lanes_load(const gg_real_block *b, int at)
{
  return (gg_vd3){gg_load(b->x + at), gg_load(b->y + at), gg_load(b->z + at)};
}

GG_INLINE void gg_lanes_store(gg_real_block *b, int at, gg_vd3 v)
{
  gg_store(b->x + at, v.x);
  gg_store(b->y + at, v.y);
  gg_store(b->z + at, v.z);
}

/* The true lanes of `yes`, the others of `no`. */
GG_INLINE void gg_lanes_store_either(gg_real_block *b, int at, gg_mask m, gg_vd3 yes, gg_vd3 no)
{
  gg_store_either(b->x + at, m, yes.x, no.x);
  gg_store_either(b->y + at, m, yes.y, no.y);
  gg_store_either(b->z + at, m, yes.z, no.z);
}

/* a and b go to their blocks; if they are of one species, lanes of `swap` change places. */
GG_INLINE void gg_lanes_settle(gg_features f, gg_real_block *one, gg_real_block *two, int at, gg_mask swap, gg_vd3 a,
                               gg_vd3 b)
{
  if (f.same) {
    gg_lanes_store_either(one, at, swap, b, a);
    gg_lanes_store_either(two, at, swap, a, b);
  } else {
    gg_lanes_store(one, at, a);
    gg_lanes_store(two, at, b);
  }
}

/* Two blocks that meet. Worked out in three steps, each of which waits for the one before: approach, decide, carry out.
 */
typedef struct gg_meeting {
  uint32_t one, two;
  gg_real_block *a, *b;
  bool again;              /* once more */
  gg_word order;           /* of the lanes of the second */
  gg_real drift, per_unit; /* if sheared */
  gg_real lowest, bound;   /* of t (block_contact.h) */
  bool from_zero;          /* lowest is 0 */
  bool layer;              /* above a visit before */
  gg_real most;            /* bound of the layer above this one, if again */
  /* Of the first: what is in its block, for no one comes between. Of the second: in their order. */
  gg_vd3 cb[GG_PARTS], sb[GG_PARTS];
  gg_vd3 v[GG_PARTS];
  gg_vd v2[GG_PARTS], speed[GG_PARTS];
  gg_vd scale[GG_PARTS]; /* gg_mirror_scale, if asked for early */
  gg_vu word[GG_PARTS];  /* random */
  gg_vd3 k[GG_PARTS];    /* if grains turn */
  gg_vd3 J[GG_PARTS];    /* 0 without a hit; 2 g_n k where k is not needed */
} gg_meeting;

/* Largest C^2 after a visit, lane by lane. */
typedef struct gg_fastest {
  gg_vd a, b;
} gg_fastest;

/* C of a stored velocity. */
GG_INLINE gg_vd3 gg_streamed(gg_features f, gg_real drift, gg_vd3 c)
{
  if (f.shear != GG_UNSHEARED) c.x -= drift * c.y;
  return c;
}

GG_INLINE void gg_turn(gg_features f, gg_batch *w, gg_mask swap, const gg_meeting *at, int part)
{
  const gg_lane_contact *c = &w->contact;
  gg_vd3 kJ = gg_vd3_cross(at->k[part], at->J[part]);
  gg_vd3 turn_a = gg_vd3_scale(gg_all(c->ik1), kJ), turn_b = f.same ? turn_a : gg_vd3_scale(gg_all(c->ik2), kJ);
  gg_vd3 sa = gg_vd3_sub(gg_lanes_load(&w->spin_one[at->one], part * GG_WIDTH), turn_a);
  gg_vd3 sb = gg_vd3_sub(at->sb[part], turn_b);
  gg_lanes_settle(f, &w->spin_one[at->one], &w->spin_two[at->two], part * GG_WIDTH, swap, sa, sb);
}

/* Grains of one species change places so that the faster one is in the first block. Returns where. */
GG_INLINE gg_mask gg_push(gg_features f, gg_batch *w, const gg_meeting *at, int part, gg_fastest *top)
{
  gg_vd3 J = at->J[part];
  if (f.shear != GG_UNSHEARED) J.x += at->drift * J.y; /* as stored velocities have it */
  gg_vd3 push_a = gg_vd3_scale(w->to_a, J), push_b = f.same ? push_a : gg_vd3_scale(w->to_b, J);
  gg_vd3 a = gg_vd3_sub(gg_lanes_load(at->a, part * GG_WIDTH), push_a);
  gg_vd3 b = gg_vd3_add(at->cb[part], push_b);
  gg_vd3 Ca = gg_streamed(f, at->drift, a), Cb = gg_streamed(f, at->drift, b);
  gg_vd a2 = gg_vd3_dot(Ca, Ca), b2 = gg_vd3_dot(Cb, Cb);
  gg_mask swap = w->sorts ? gg_less(a2, b2) : gg_low_bit(at->word[part] >> GG_SPARE_BIT);
  gg_vd first = f.same ? gg_select(swap, b2, a2) : a2, second = f.same ? gg_select(swap, a2, b2) : b2;
  top->a = part ? gg_larger(top->a, first) : first;
  top->b = part ? gg_larger(top->b, second) : second;
  gg_lanes_settle(f, at->a, at->b, part * GG_WIDTH, swap, a, b);
  return swap;
}

/* Write back what comes of it. */
GG_INLINE void gg_carry_out(gg_features f, gg_batch *w, const gg_meeting *at)
{
  gg_fastest top;
  for (int part = 0; part < GG_PARTS; part++) {
    gg_mask swap = gg_push(f, w, at, part, &top);
    if (f.rule != GG_SMOOTH) gg_turn(f, w, swap, at, part);
  }
  gg_v2 peaks = gg_peaks(top.a, top.b) * (f.shear == GG_UNSHEARED ? w->per_unit : at->per_unit);
  gg_peaks_store(peaks, &w->top_one[at->one], &w->top_two[at->two]);
}

/* Block b with its lanes in order r (of which the low bits count), in registers. */
GG_INLINE void gg_load_in_order(const gg_real_block *b, gg_word r, gg_vd3 c[GG_PARTS])
{
  gg_order order = gg_order_of(r);
  for (unsigned part = 0; part < GG_PARTS; part++) {
    unsigned from = (part ^ (unsigned)(r / GG_WIDTH % GG_PARTS)) * GG_WIDTH;
    c[part] = (gg_vd3){gg_permute(gg_load(b->x + from), order), gg_permute(gg_load(b->y + from), order),
                       gg_permute(gg_load(b->z + from), order)};
  }
}

/* Some pair is faster than the sum of tops by which its blocks were drawn: one of them has been visited since, or the
 * gas is faster than the bound of all. What such pairs should collide more often than at every visit is made good by
 * another visit in the layer above the bound, which comes with the probability that makes the rates right: `again`.
 * (All lanes under a higher bound, and all of them again now and then, would have the same rates; but pairs that meet
 * twice in a row scatter no further than once, and there would be more of them.) */
GG_INLINE void gg_reconsider(gg_batch *w, gg_meeting *at, gg_rng *rng)
{
  const gg_real bound = at->bound;
  gg_vd most = at->v2[0];
  for (int part = 0; part < GG_PARTS; part++) {
    most = gg_larger(most, at->v2[part]);
    w->overflows += (unsigned)__builtin_popcount(gg_bits(gg_less(gg_all(w->bound), at->speed[part])));
  }
  gg_real now = (gg_real)fmin(sqrt(gg_peaks(most, most)[0]) * (1 + 1e-15), w->bound);
  if (now <= bound) return;
  at->again = gg_rng_uniform(rng) * (bound - at->lowest) < now - bound;
  at->most = now;
}

/* Take the next visit of the list: how fast do they meet? */
GG_INLINE void gg_approach(gg_features f, gg_batch *w, const gg_draws *d, gg_meeting *at)
{
  const unsigned i = d->at;
  at->one = (uint32_t)gg_listed(d->one, i);
  at->two = (uint32_t)gg_listed(d->two, i);
  at->a = &w->one[at->one];
  at->b = &w->two[at->two];
  at->order = gg_listed(d->order, i);
  at->bound = d->bound[i];
  at->again = at->layer = false;
  at->lowest = w->lowest;
  at->from_zero = w->from_zero;
  if (__builtin_expect(d->layer, 0)) {
    at->layer = true;
    at->lowest = d->lowest;
    at->from_zero = false;
  }
  at->drift = f.shear == GG_UNSHEARED ? 0 : d->drifts[i];
  if (f.shear != GG_UNSHEARED) at->per_unit = d->per_unit[i];
  gg_load_in_order(at->b, at->order, at->cb);
  if (f.rule != GG_SMOOTH) gg_load_in_order(&w->spin_two[at->two], at->order, at->sb);
  for (int part = 0; part < GG_PARTS; part++) {
    gg_vd3 ca = gg_lanes_load(at->a, part * GG_WIDTH);
    at->v[part] = gg_streamed(f, at->drift, gg_vd3_sub(ca, at->cb[part]));
    at->v2[part] = gg_vd3_dot(at->v[part], at->v[part]);
    at->speed[part] = gg_sqrt(at->v2[part]);
    if (gg_scales_early(f)) at->scale[part] = gg_mirror_scale(at->v[part], at->speed[part]);
  }
}

/* Who collides, along which k, with what impulse? */
GG_INLINE void gg_aim(gg_features f, gg_batch *w, gg_chance *c, gg_meeting *at, int part)
{
  gg_encounter e = {.speed = at->speed[part]};
  gg_encounter_meet(f, at->from_zero, at->lowest, at->bound, at->word[part], &e);
  if (__builtin_expect(at->layer, 0)) gg_encounter_in_layer(at->lowest, &e);
  e.q = gg_directions_take(&c->near, e.hit);
  gg_encounter_aim(f, w, c, at->v[part], at->scale[part], &e);
  if (f.rule != GG_SMOOTH) {
    gg_vd3 sa = gg_lanes_load(&w->spin_one[at->one], part * GG_WIDTH);
    e.g = gg_vd3_sub(e.g, gg_vd3_cross(e.k, gg_vd3_add(sa, at->sb[part])));
    at->k[part] = e.k;
  }
  gg_vd3 J = gg_needs_k(f) ? gg_lane_impulse(f.rule, &w->contact, e.k, e.g, e.gn) : e.gn_k;
  J = (gg_vd3){gg_where(e.hit, J.x), gg_where(e.hit, J.y), gg_where(e.hit, J.z)};
  at->J[part] = J;
  w->worst = gg_larger(w->worst, at->v2[part]);
  w->collisions += (unsigned)__builtin_popcount(gg_bits(e.hit));
  gg_tally_note(f, &w->tally, part, e.k, e.g, gg_needs_k(f) ? J : gg_vd3_scale(gg_all(0.5 * w->contact.jn), J),
                gg_where(e.hit, w->contact.jn * e.gn));
}

GG_INLINE void gg_make_directions(gg_features f, gg_chance *c)
{
  gg_directions_make(&c->near, &c->rng, gg_needs_k(f) ? GG_COSINE : GG_UNIFORM);
}

/* What comes of it, but for writing it back. */
GG_INLINE void gg_decide(gg_features f, gg_batch *w, gg_chance *c, gg_rng *rng, gg_meeting *at)
{
  unsigned faster = 0;
  for (int part = 0; part < GG_PARTS; part++) faster |= gg_bits(gg_less(gg_all(at->bound), at->speed[part]));
  if (__builtin_expect(faster, 0)) gg_reconsider(w, at, rng);
  gg_directions_stock(&c->near, &c->rng, gg_needs_k(f) ? GG_COSINE : GG_UNIFORM);
  if (f.shear == GG_SHEARED_DENSE) gg_directions_stock(&c->sheared, &c->rng, GG_SHEARED);
  for (int part = 0; part < GG_PARTS; part++) gg_aim(f, w, c, at, part);
  gg_tally_turn(f, &w->tally);
  w->visits++;
}

#endif
