/* The collision step on blocks: two random blocks, the lanes of one against those of the other in a random order, eight
 * candidates at once (block_contact.h). Compiled once for each set of instructions (GG_INSTRUCTIONS names it); all
 * leave the same bits.
 *
 * Fairness. Each lane of one block meets each lane of the other with probability 1/8, and every pair of grains in
 * different blocks comes up equally often. Pairs within one block, and the last block where it is not full, go through
 * the plain path at the same rate. Half the lanes, at random, change places between the two blocks, so that no two
 * grains stay together. */
#include "dsmc/collide_blocks.h"

#include "dsmc/block_contact.h"

enum { AHEAD = 8 }; /* block pairs drawn and prefetched at a time */

typedef struct gg_draw {
  uint32_t a[AHEAD], b[AHEAD];
  unsigned order[AHEAD];
} gg_draw;

GG_INLINE gg_vd3 load(const gg_block *b, int at)
{
  return (gg_vd3){gg_load(b->x + at), gg_load(b->y + at), gg_load(b->z + at)};
}

/* Put a part of both blocks back; grains of one species change places in the lanes of `swap`. */
GG_INLINE void store(bool exchange, gg_mask swap, gg_block *a, gg_block *b, int at, gg_vd3 va, gg_vd3 vb)
{
  gg_store(a->x + at, exchange ? gg_select(swap, vb.x, va.x) : va.x);
  gg_store(a->y + at, exchange ? gg_select(swap, vb.y, va.y) : va.y);
  gg_store(a->z + at, exchange ? gg_select(swap, vb.z, va.z) : va.z);
  gg_store(b->x + at, exchange ? gg_select(swap, va.x, vb.x) : vb.x);
  gg_store(b->y + at, exchange ? gg_select(swap, va.y, vb.y) : vb.y);
  gg_store(b->z + at, exchange ? gg_select(swap, va.z, vb.z) : vb.z);
}

GG_INLINE void tally(gg_features f, gg_batch *w, int part, const gg_encounter *e, gg_vd3 g, gg_vd3 J)
{
  w->collisions += (unsigned)__builtin_popcount(gg_bits(e->hit));
  if (f.tap == GG_TAP_CLOSED) return;
  w->loss[part] += gg_where(e->hit, gg_lane_energy_loss(f.rule, &w->contact, g, J, e->gn2));
  if (f.tap == GG_TAP_LOSS) return;
  const gg_vd ka[3] = {e->k.x, e->k.y, e->k.z}, Jb[3] = {J.x, J.y, J.z};
  for (int i = 0; i < 3; i++)
    for (int j = f.rule == GG_SMOOTH ? i : 0; j < 3; j++) w->stress[i][j][part] += gg_where(e->hit, ka[i] * Jb[j]);
}

/* What is left to do once the impulse is known: turn the spins, push the grains. */
GG_INLINE void turn(gg_features f, const gg_contact *c, gg_mask swap, gg_block *a, gg_block *b, int at, gg_vd3 spin_b,
                    gg_vd3 kJ)
{
  gg_vd3 turn_a = gg_vd3_scale(gg_all(c->ik1), kJ), turn_b = f.same ? turn_a : gg_vd3_scale(gg_all(c->ik2), kJ);
  store(f.same, swap, a, b, at, gg_vd3_sub(load(a, at), turn_a), gg_vd3_sub(spin_b, turn_b));
}

GG_INLINE void push(gg_features f, const gg_contact *c, gg_mask swap, gg_block *a, gg_block *b, int at, gg_vd3 ca,
                    gg_vd3 cb, gg_vd3 J)
{
  gg_vd3 push_a = gg_vd3_scale(gg_all(c->im1), J), push_b = f.same ? push_a : gg_vd3_scale(gg_all(c->im2), J);
  store(f.same, swap, a, b, at, gg_vd3_sub(ca, push_a), gg_vd3_add(cb, push_b));
}

/* A part of block a against that part of block b in whose lanes `cb` and `spin_b` are in order. */
GG_INLINE void collide_part(gg_features f, gg_batch *w, uint32_t a, uint32_t b, int part, gg_vd3 cb, gg_vd3 spin_b)
{
  const gg_contact *c = &w->contact;
  const int at = part * GG_WIDTH;
  gg_vd3 ca = load(&w->one[a], at), v = gg_vd3_sub(ca, cb);
  if (f.shear != GG_UNSHEARED) v.x -= w->drift * v.y;
  gg_vu r = gg_lane_next(&w->rng, part);
  gg_encounter e = gg_encounter_of(f, w, v, r);
  gg_vd3 g = e.g, J = gg_vd3_scale(gg_all(c->jn), e.gn_k);
  if (f.rule != GG_SMOOTH) g = gg_vd3_sub(g, gg_vd3_cross(e.k, gg_vd3_add(load(&w->spin_one[a], at), spin_b)));
  if (gg_needs_k(f)) J = gg_lane_impulse(f.rule, c, e.k, g, e.gn);
  tally(f, w, part, &e, g, J);
  J = (gg_vd3){gg_where(e.hit, J.x), gg_where(e.hit, J.y), gg_where(e.hit, J.z)};
  gg_mask swap = gg_low_bit(r);
  if (f.rule != GG_SMOOTH) turn(f, c, swap, &w->spin_one[a], &w->spin_two[b], at, spin_b, gg_vd3_cross(e.k, J));
  if (f.shear != GG_UNSHEARED) J.x += w->drift * J.y; /* as stored velocities have it */
  push(f, c, swap, &w->one[a], &w->two[b], at, ca, cb, J);
}

/* Block b with its lanes in order r, in registers. */
GG_INLINE void load_in_order(const gg_block *b, unsigned r, gg_vd3 c[GG_PARTS])
{
  gg_order order = gg_order_of(r % GG_WIDTH);
  for (int part = 0; part < GG_PARTS; part++) {
    unsigned from = ((unsigned)part ^ (r / GG_WIDTH)) * GG_WIDTH;
    c[part] = (gg_vd3){gg_permute(gg_load(b->x + from), order), gg_permute(gg_load(b->y + from), order),
                       gg_permute(gg_load(b->z + from), order)};
  }
}

GG_INLINE void collide_blocks(gg_features f, gg_batch *w, uint32_t a, uint32_t b, unsigned order)
{
  const bool spins = f.rule != GG_SMOOTH;
  gg_vd3 cb[GG_PARTS], sb[GG_PARTS];
  gg_directions_stock(&w->near, &w->rng, gg_needs_k(f) ? GG_COSINE : GG_UNIFORM);
  if (f.shear == GG_SHEARED_DENSE) gg_directions_stock(&w->sheared, &w->rng, GG_SHEARED);
  load_in_order(&w->two[b], order, cb);
  if (spins) load_in_order(&w->spin_two[b], order, sb);
  for (int part = 0; part < GG_PARTS; part++) collide_part(f, w, a, b, part, cb[part], spins ? sb[part] : cb[part]);
}

/* Draw the next block pairs and call their memory. Each half of a random word gives a block; what is left of the
 * product after the point is as good as new and gives the order. */
GG_INLINE void draw(gg_features f, gg_batch *w, gg_draw *next)
{
  uint64_t r[GG_LANES] __attribute__((aligned(64)));
  for (int part = 0; part < GG_PARTS; part++) {
    gg_vu word = gg_lane_next(&w->rng, part);
    __builtin_memcpy(&r[part * GG_WIDTH], &word, sizeof word);
  }
  for (int i = 0; i < AHEAD; i++) {
    uint64_t a = (r[i] >> 32) * w->n_one, b = (uint32_t)r[i] * w->n_two;
    next->a[i] = (uint32_t)(a >> 32);
    next->b[i] = (uint32_t)(b >> 32);
    next->order[i] = (uint32_t)b >> 29;
    for (int line = 0; line < 3; line++) {
      __builtin_prefetch((const char *)&w->one[next->a[i]] + 64 * line, 1);
      __builtin_prefetch((const char *)&w->two[next->b[i]] + 64 * line, 1);
      if (f.rule == GG_SMOOTH) continue;
      __builtin_prefetch((const char *)&w->spin_one[next->a[i]] + 64 * line, 1);
      __builtin_prefetch((const char *)&w->spin_two[next->b[i]] + 64 * line, 1);
    }
  }
}

static double sum_of_lanes(const gg_vd v[GG_PARTS])
{
  double sum = 0;
  for (int l = 0; l < GG_LANES; l++) sum += v[l / GG_WIDTH][l % GG_WIDTH];
  return sum;
}

GG_INLINE void start(gg_features f, gg_batch *w, const gg_pairing *p, const gg_rng_lanes *lanes)
{
  *w = (gg_batch){.one = p->one->c,
                  .two = p->two->c,
                  .spin_one = p->one->s,
                  .spin_two = p->two->s,
                  .n_one = p->one->n_blocks,
                  .n_two = p->two->n_blocks,
                  .contact = p->contact,
                  .bound = p->bound,
                  .shift = p->shift,
                  .s0 = f.shear == GG_SHEARED_DENSE ? GG_SHEAR_SHARE * p->shift : 0,
                  .drift = p->drift};
  double top = p->floor + p->bound - w->s0;
  w->offset = p->floor - w->s0 - p->bound;
  w->brim = top > 0 ? top * top : 0;
  gg_lane_rng_load(&w->rng, lanes);
}

GG_INLINE void finish(gg_features f, gg_batch *w, gg_pairing *p, gg_rng_lanes *lanes)
{
  gg_lane_rng_save(&w->rng, lanes);
  p->collisions += w->collisions;
  p->overflows += w->overflows;
  for (int l = 0; l < GG_WIDTH; l++) p->worst = fmax(p->worst, w->s0 + sqrt(w->worst[l]));
  if (f.tap == GG_TAP_CLOSED) return;
  p->loss += sum_of_lanes(w->loss);
  if (f.tap == GG_TAP_LOSS) return;
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++) {
      bool mirrored = f.rule == GG_SMOOTH && j < i;
      p->stress[i][j] += p->sigma * sum_of_lanes(mirrored ? w->stress[j][i] : w->stress[i][j]);
    }
}

/* Everything of a batch. `f` is a constant: each instance holds only what it needs. */
GG_INLINE void run(gg_features f, gg_pairing *p, gg_rng_lanes *lanes, gg_rng *rng)
{
  gg_batch w;
  start(f, &w, p, lanes);
  /* Blocks that are not full, if any. */
  uint32_t odd_a = p->one->n % GG_LANES ? (uint32_t)p->one->n_blocks - 1 : UINT32_MAX;
  uint32_t odd_b = p->two->n % GG_LANES ? (uint32_t)p->two->n_blocks - 1 : UINT32_MAX;
  gg_draw now, next;
  draw(f, &w, &next);
  for (uint64_t done = 0; done < p->candidates; done += AHEAD) {
    uint64_t left = p->candidates - done;
    now = next;
    draw(f, &w, &next);
    for (unsigned i = 0; i < AHEAD && i < left; i++, w.drift += p->drift_step) {
      uint32_t a = now.a[i], b = now.b[i];
      if (__builtin_expect((f.same && a == b) || a == odd_a || b == odd_b, 0)) {
        p->drift = w.drift;
        gg_collide_odd_blocks(f, p, a, b, now.order[i], rng);
      } else {
        collide_blocks(f, &w, a, b, now.order[i]);
      }
    }
  }
  finish(f, &w, p, lanes);
}

/* The table of instances: rule x shear and tap x one or two species. */
#define EACH_SAME(X, rule, shear, tap) X(rule, shear, tap, 0) X(rule, shear, tap, 1)
#define EACH_FLOW(X, rule)                                                                                             \
  EACH_SAME(X, rule, GG_UNSHEARED, GG_TAP_CLOSED)                                                                      \
  EACH_SAME(X, rule, GG_UNSHEARED, GG_TAP_LOSS)                                                                        \
  EACH_SAME(X, rule, GG_UNSHEARED, GG_TAP_STRESS)                                                                      \
  EACH_SAME(X, rule, GG_SHEARED_DILUTE, GG_TAP_CLOSED)                                                                 \
  EACH_SAME(X, rule, GG_SHEARED_DILUTE, GG_TAP_LOSS)                                                                   \
  EACH_SAME(X, rule, GG_SHEARED_DENSE, GG_TAP_CLOSED)                                                                  \
  EACH_SAME(X, rule, GG_SHEARED_DENSE, GG_TAP_LOSS)                                                                    \
  EACH_SAME(X, rule, GG_SHEARED_DENSE, GG_TAP_STRESS)
#define EACH(X) EACH_FLOW(X, GG_SMOOTH) EACH_FLOW(X, GG_ROUGH) EACH_FLOW(X, GG_FRICTIONAL)

#define INSTANCE(rule, shear, tap, same)                                                                               \
  static void run_##rule##_##shear##_##tap##_##same(gg_pairing *p, gg_rng_lanes *lanes, gg_rng *rng)                   \
  {                                                                                                                    \
    run((gg_features){rule, shear, tap, same}, p, lanes, rng);                                                         \
  }
EACH(INSTANCE)

#define NAME_OF(instructions) gg_collide_blocks_##instructions
#define NAME(instructions) NAME_OF(instructions)

gg_collide_blocks *NAME(GG_INSTRUCTIONS)(gg_features f)
{
#define ENTRY(rule, shear, tap, same) [rule][shear][tap][same] = run_##rule##_##shear##_##tap##_##same,
  static gg_collide_blocks *const table[GG_FRICTIONAL + 1][GG_SHEARED_DENSE + 1][GG_TAP_STRESS + 1][2] = {EACH(ENTRY)};
  return table[f.rule][f.shear][f.tap][f.same];
}
