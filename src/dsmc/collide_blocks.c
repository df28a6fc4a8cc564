/* The collision step on blocks: two random blocks, the lanes of one against those of the other in a random order, eight
 * candidates at once. Compiled once for each set of instructions (GG_INSTRUCTIONS names it); all leave the same bits.
 *
 * Selection. A pair's rate integrated over directions is pi sigma^2 chi/V times
 *   without shear between the centres:  |C12|, and then k falls by the cosine law about C12;
 *   with it:  at most |C12| + s0, s0 = (8/3 pi) sigma rate, since g_n <= max(0, k.C12) + sigma rate |k_x k_y|; k falls
 * by the cosine law with the share of the first, by the law |k_x k_y| with that of the second, and is then kept with
 *   probability g_n/(max(0, k.C12) + sigma rate |k_x k_y|).
 * One uniform number t in [-s0, bound - s0) serves for all: t < 0 takes the second law, t < |C12| the first, anything
 * more is no collision; and since what is left of t is uniform again, it decides the last choice, too.
 * Smooth grains without shear need no k at all: with w uniform on the sphere, C12 - |C12| w points along a k of the
 * cosine law and is 2 (k.C12) long, since elastic hard spheres scatter isotropically.
 *
 * Fairness. Each lane of one block meets each lane of the other with probability 1/8, and every pair of grains in
 * different blocks comes up equally often. Pairs within one block, and the last block where it is not full, go through
 * the plain path at the same rate. Half the lanes, at random, change places between the two blocks, so that no two
 * grains stay together. */
#include "dsmc/collide_blocks.h"
#include "dsmc/directions.h"
#include "dsmc/lanes_collision.h"

enum { AHEAD = 8 }; /* block pairs drawn and prefetched at a time */

typedef struct gg_draw {
  uint32_t a[AHEAD], b[AHEAD];
  unsigned order[AHEAD];
} gg_draw;

/* A batch in progress: constants and sums where the compiler can keep them in registers. */
typedef struct gg_batch {
  gg_block *one, *two, *spin_one, *spin_two;
  uint64_t n_one, n_two; /* blocks */
  gg_contact contact;
  gg_lane_rng rng;
  gg_directions near, sheared;     /* about C12, and by the law |k_x k_y| */
  double bound, offset, s0, shift; /* t = bound (1 + u) + offset */
  double brim;                     /* C12^2 at which the bound overflows */
  double drift;
  uint64_t collisions, overflows;
  gg_vd worst; /* largest C12^2 */
  gg_vd loss[GG_PARTS], stress[3][3][GG_PARTS];
} gg_batch;

/* Smooth grains get by without the direction k where nobody asks for it. */
GG_INLINE bool needs_k(gg_features f)
{
  return f.rule != GG_SMOOTH || f.shear == GG_SHEARED_DENSE || f.tap == GG_TAP_STRESS;
}

/* The direction that lies about v as q lies about the z axis: q mirrored by the Householder vector v +- |v| z. */
GG_INLINE gg_vd3 about(gg_vd3 v, gg_vd speed, gg_vd3 q)
{
  const gg_vu sign = (gg_vu)v.z & (gg_vu)gg_all(-0.0);
  gg_vd side = (gg_vd)((gg_vu)speed | sign), height = speed + (gg_vd)((gg_vu)v.z ^ sign);
  gg_vd3 h = {v.x, v.y, v.z + side}, m = {q.x, q.y, (gg_vd)((gg_vu)q.z ^ sign ^ (gg_vu)gg_all(-0.0))};
  gg_vd f = gg_vd3_dot(h, m) / (speed * height + 1e-300); /* 0/0 only where nothing moves */
  return gg_vd3_sub(m, gg_vd3_scale(f, h));
}

/* Part `part` of block a against part `part ^ (r / width)` of block b, its lanes already in order r. */
GG_INLINE void collide_part(gg_features f, gg_batch *w, gg_block *a, gg_block *b, gg_block *sa, gg_block *sb, int part,
                            gg_vd3 cb, gg_vd3 spin_b)
{
  const gg_contact *c = &w->contact;
  const bool dense = f.shear == GG_SHEARED_DENSE;
  const int at = part * GG_WIDTH;
  gg_vd3 ca = {gg_load(a->x + at), gg_load(a->y + at), gg_load(a->z + at)}, v = gg_vd3_sub(ca, cb);
  if (f.shear != GG_UNSHEARED) v.x -= w->drift * v.y;
  gg_vd v2 = gg_vd3_dot(v, v);
  gg_vu r = gg_lane_next(&w->rng, part);
  gg_vd t = gg_lane_one_to_two(r) * w->bound + w->offset;
  gg_mask hit = gg_less(t * t, v2), special = gg_less(t, gg_all(0));
  gg_vd speed = gg_sqrt(v2);
  w->worst = gg_larger(w->worst, v2);
  unsigned over = gg_bits(gg_less(gg_all(w->brim), v2));
  if (__builtin_expect(over != 0, 0)) w->overflows += (unsigned)__builtin_popcount(over);
  if (dense) hit = gg_and_not(hit, special);
  gg_vd3 J, q = gg_directions_take(&w->near, hit), k = q, g = v;
  gg_vd gn, gn2;
  if (!needs_k(f)) {
    gg_vd3 d = gg_vd3_sub(v, gg_vd3_scale(speed, q)); /* 2 g_n k */
    gn = gn2 = 0.25 * gg_vd3_dot(d, d);
    J = gg_vd3_scale(gg_all(0.5 * c->jn), d);
  } else {
    k = about(v, speed, q);
    gn = speed * q.z;
    if (dense) {
      gg_vd3 other = gg_directions_take(&w->sheared, special);
      k = (gg_vd3){gg_select(special, other.x, k.x), gg_select(special, other.y, k.y),
                   gg_select(special, other.z, k.z)};
      gn = gg_vd3_dot(k, v);
      gg_vd forward = gg_where(gg_less(gg_all(0), gn), gn), shear = w->shift * k.x * k.y;
      gn -= shear;
      g.x -= w->shift * k.y;
      gg_vd most = forward + gg_larger(shear, -shear);
      gg_vd left = gg_select(special, -t, t), range = gg_select(special, gg_all(w->s0), speed);
      hit = gg_and(gg_or(hit, special), gg_less(left * most, range * gn));
    }
    gn2 = gn * gn;
    if (f.rule != GG_SMOOTH) {
      gg_vd3 spin_a = {gg_load(sa->x + at), gg_load(sa->y + at), gg_load(sa->z + at)};
      g = gg_vd3_sub(g, gg_vd3_cross(k, gg_vd3_add(spin_a, spin_b)));
    }
    J = gg_lane_impulse(f.rule, c, k, g, gn);
  }
  if (f.tap != GG_TAP_CLOSED) w->loss[part] += gg_where(hit, gg_lane_energy_loss(f.rule, c, g, J, gn2));
  J = (gg_vd3){gg_where(hit, J.x), gg_where(hit, J.y), gg_where(hit, J.z)};
  if (f.tap == GG_TAP_STRESS) {
    const gg_vd ka[3] = {k.x, k.y, k.z}, Jb[3] = {J.x, J.y, J.z};
    for (int i = 0; i < 3; i++)
      for (int j = f.rule == GG_SMOOTH ? i : 0; j < 3; j++) w->stress[i][j][part] += ka[i] * Jb[j];
  }
  w->collisions += (unsigned)__builtin_popcount(gg_bits(hit));
  gg_mask swap = gg_low_bit(r);
  if (f.rule != GG_SMOOTH) {
    gg_vd3 spin_a = {gg_load(sa->x + at), gg_load(sa->y + at), gg_load(sa->z + at)}, kJ = gg_vd3_cross(k, J);
    gg_vd3 turn_a = gg_vd3_scale(gg_all(c->ik1), kJ), turn_b = f.same ? turn_a : gg_vd3_scale(gg_all(c->ik2), kJ);
    gg_vd3 na = gg_vd3_sub(spin_a, turn_a), nb = gg_vd3_sub(spin_b, turn_b);
    gg_store(sa->x + at, f.same ? gg_select(swap, nb.x, na.x) : na.x);
    gg_store(sa->y + at, f.same ? gg_select(swap, nb.y, na.y) : na.y);
    gg_store(sa->z + at, f.same ? gg_select(swap, nb.z, na.z) : na.z);
    gg_store(sb->x + at, f.same ? gg_select(swap, na.x, nb.x) : nb.x);
    gg_store(sb->y + at, f.same ? gg_select(swap, na.y, nb.y) : nb.y);
    gg_store(sb->z + at, f.same ? gg_select(swap, na.z, nb.z) : nb.z);
  }
  if (f.shear != GG_UNSHEARED) J.x += w->drift * J.y; /* as stored velocities have it */
  gg_vd3 push_a = gg_vd3_scale(gg_all(c->im1), J), push_b = f.same ? push_a : gg_vd3_scale(gg_all(c->im2), J);
  gg_vd3 na = gg_vd3_sub(ca, push_a), nb = gg_vd3_add(cb, push_b);
  gg_store(a->x + at, f.same ? gg_select(swap, nb.x, na.x) : na.x);
  gg_store(a->y + at, f.same ? gg_select(swap, nb.y, na.y) : na.y);
  gg_store(a->z + at, f.same ? gg_select(swap, nb.z, na.z) : na.z);
  gg_store(b->x + at, f.same ? gg_select(swap, na.x, nb.x) : nb.x);
  gg_store(b->y + at, f.same ? gg_select(swap, na.y, nb.y) : nb.y);
  gg_store(b->z + at, f.same ? gg_select(swap, na.z, nb.z) : nb.z);
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
  gg_directions_stock(&w->near, &w->rng, needs_k(f) ? GG_COSINE : GG_UNIFORM);
  if (f.shear == GG_SHEARED_DENSE) gg_directions_stock(&w->sheared, &w->rng, GG_SHEARED);
  load_in_order(&w->two[b], order, cb);
  if (spins) load_in_order(&w->spin_two[b], order, sb);
  for (int part = 0; part < GG_PARTS; part++)
    collide_part(f, w, &w->one[a], &w->two[b], spins ? &w->spin_one[a] : NULL, spins ? &w->spin_two[b] : NULL, part,
                 cb[part], spins ? sb[part] : cb[part]);
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
