/* The collision step on blocks: two random blocks, the lanes of one against those of the other in a random order, eight
 * candidates at once (block_contact.h). Compiled once for each set of instructions (GG_INSTRUCTIONS names it), and for
 * either precision (GG_SINGLE_LANES); all sets leave the same bits.
 *
 * Fairness. Each lane of one block meets each lane of the other with probability 1/8, and every pair of grains in
 * different blocks comes up equally often. Pairs within one block, and the last block where it is not full, go through
 * the plain path at the same rate.
 *
 * Rejection. The bound of all pairs is set by the fastest grains of all. So two blocks that are drawn are visited with
 * probability (sum of their tops)/(that bound) only, and their lanes judged under the sum of their tops, which comes to
 * the same rate for every pair of grains. After a visit the faster grain of each lane lies in the block of lower
 * number: any order would do, but this one sorts grains by speed, and bounds are tighter yet. Half the candidates
 * collide, against a quarter without. Below a thousand blocks lanes change places at random instead: eight fast grains
 * that always act at once would be too large a part of the ensemble. */
#include "dsmc/collide_blocks.h"

#include "dsmc/block_contact.h"

enum { SORTED = 999 }; /* blocks, at least, to be sorted by speed */
#define ODD (UINT32_C(1) << 31)
enum { DRAWS = 32 };   /* block pairs drawn at a time, and those to be visited prefetched */

/* What is to be visited, in order of time. Lists as gg_pack leaves them: each a number's worth of bits. The top one of 32
 * in `two` says that the visit is none for this path. */
typedef struct gg_draw {
  unsigned n;
  double drift, unit; /* where these draws begin */
  gg_real one[DRAWS + GG_LANES], two[DRAWS + GG_LANES], order[DRAWS + GG_LANES], bound[DRAWS + GG_LANES],
      nth[DRAWS + GG_LANES];
} gg_draw;

/* What the tap has seen, lane by lane. */
typedef struct gg_folded {
  double gn2[GG_LANES], Jg[GG_LANES], J2[GG_LANES];
  double xx[GG_LANES], yy[GG_LANES], zz[GG_LANES], xy[GG_LANES], yx[GG_LANES];
} gg_folded;

GG_INLINE gg_vd3 load(const gg_real_block *b, int at)
{
  return (gg_vd3){gg_load(b->x + at), gg_load(b->y + at), gg_load(b->z + at)};
}

GG_INLINE void store(gg_real_block *b, int at, gg_vd3 v)
{
  gg_store(b->x + at, v.x);
  gg_store(b->y + at, v.y);
  gg_store(b->z + at, v.z);
}

/* Lanes of `swap` change places. */
GG_INLINE void exchange(gg_mask swap, gg_vd3 *a, gg_vd3 *b)
{
  gg_vd3 old = *a;
  *a = (gg_vd3){gg_select(swap, b->x, a->x), gg_select(swap, b->y, a->y), gg_select(swap, b->z, a->z)};
  *b = (gg_vd3){gg_select(swap, old.x, b->x), gg_select(swap, old.y, b->y), gg_select(swap, old.z, b->z)};
}

/* J is 0 where nothing hits. */
GG_INLINE void tally(gg_features f, gg_batch *w, int part, const gg_encounter *e, gg_vd3 g, gg_vd3 J)
{
  w->collisions += (unsigned)__builtin_popcount(gg_bits(e->hit));
  if (f.tap == GG_TAP_CLOSED) return;
  w->gn2[part] += gg_where(e->hit, e->gn2);
  if (f.rule != GG_SMOOTH) w->Jg[part] += gg_vd3_dot(J, g);
  if (f.rule == GG_FRICTIONAL) w->J2[part] += gg_vd3_dot(J, J);
  if (f.tap == GG_TAP_LOSS) return;
  w->xx[part] += e->k.x * J.x;
  w->yy[part] += e->k.y * J.y;
  w->zz[part] += e->k.z * J.z;
  w->xy[part] += e->k.x * J.y;
  if (f.rule != GG_SMOOTH) w->yx[part] += e->k.y * J.x;
}

/* Two blocks, the lanes of the second in their order of this visit. */
typedef struct gg_meeting {
  uint32_t a, b;
  bool odd; /* not for this path */
  gg_real drift;
  gg_vd3 ca[GG_PARTS], cb[GG_PARTS], sb[GG_PARTS];
  gg_vd3 v[GG_PARTS];
  gg_vd v2[GG_PARTS];
} gg_meeting;

/* Largest C^2 after a visit, lane by lane. */
typedef struct gg_fastest {
  gg_vd a, b;
} gg_fastest;

/* C of a stored velocity. */
GG_INLINE gg_vd3 streamed(gg_features f, gg_real drift, gg_vd3 c)
{
  if (f.shear != GG_UNSHEARED) c.x -= drift * c.y;
  return c;
}

GG_INLINE void turn(gg_features f, gg_batch *w, gg_mask swap, const gg_meeting *at, int part, gg_vd3 kJ)
{
  const gg_lane_contact *c = &w->contact;
  gg_vd3 turn_a = gg_vd3_scale(gg_all(c->ik1), kJ), turn_b = f.same ? turn_a : gg_vd3_scale(gg_all(c->ik2), kJ);
  gg_vd3 sa = gg_vd3_sub(load(&w->spin_one[at->a], part * GG_WIDTH), turn_a), sb = gg_vd3_sub(at->sb[part], turn_b);
  if (f.same) exchange(swap, &sa, &sb);
  store(&w->spin_one[at->a], part * GG_WIDTH, sa);
  store(&w->spin_two[at->b], part * GG_WIDTH, sb);
}

/* Grains of one species change places so that the faster one is in the first block. Returns where. */
GG_INLINE gg_mask push(gg_features f, gg_batch *w, const gg_meeting *at, int part, gg_vd3 J, gg_vu r, gg_fastest *top)
{
  const gg_lane_contact *c = &w->contact;
  if (f.shear != GG_UNSHEARED) J.x += at->drift * J.y; /* as stored velocities have it */
  gg_vd3 push_a = gg_vd3_scale(gg_all(c->im1), J), push_b = f.same ? push_a : gg_vd3_scale(gg_all(c->im2), J);
  gg_vd3 a = gg_vd3_sub(at->ca[part], push_a), b = gg_vd3_add(at->cb[part], push_b);
  gg_vd3 Ca = streamed(f, at->drift, a), Cb = streamed(f, at->drift, b);
  gg_vd a2 = gg_vd3_dot(Ca, Ca), b2 = gg_vd3_dot(Cb, Cb);
  gg_mask swap = gg_or(gg_and(gg_less(a2, b2), w->sorts), gg_and_not(gg_low_bit(r >> GG_SPARE_BIT), w->sorts));
  gg_vd first = f.same ? gg_select(swap, b2, a2) : a2, second = f.same ? gg_select(swap, a2, b2) : b2;
  top->a = part ? gg_larger(top->a, first) : first;
  top->b = part ? gg_larger(top->b, second) : second;
  if (f.same) exchange(swap, &a, &b);
  store(&w->one[at->a], part * GG_WIDTH, a);
  store(&w->two[at->b], part * GG_WIDTH, b);
  return swap;
}

GG_INLINE void collide_part(gg_features f, gg_batch *w, const gg_meeting *at, int part, gg_real bound, gg_vu r,
                            gg_fastest *top)
{
  gg_encounter e = gg_encounter_of(f, w, at->v[part], at->v2[part], bound, r);
  gg_vd3 g = e.g, J = gg_vd3_scale(gg_all(0.5 * w->contact.jn), e.gn_k);
  if (f.rule != GG_SMOOTH)
    g = gg_vd3_sub(g, gg_vd3_cross(e.k, gg_vd3_add(load(&w->spin_one[at->a], part * GG_WIDTH), at->sb[part])));
  if (gg_needs_k(f)) J = gg_lane_impulse(f.rule, &w->contact, e.k, g, e.gn);
  J = (gg_vd3){gg_where(e.hit, J.x), gg_where(e.hit, J.y), gg_where(e.hit, J.z)};
  tally(f, w, part, &e, g, J);
  gg_mask swap = push(f, w, at, part, J, r, top);
  if (f.rule != GG_SMOOTH) turn(f, w, swap, at, part, gg_vd3_cross(e.k, J));
}

/* Block b with its lanes in order r, in registers. */
GG_INLINE void load_in_order(const gg_real_block *b, unsigned r, gg_vd3 c[GG_PARTS])
{
  gg_order order = gg_order_of(r % GG_WIDTH);
  for (int part = 0; part < GG_PARTS; part++) {
    unsigned from = ((unsigned)part ^ (r / GG_WIDTH)) * GG_WIDTH;
    c[part] = (gg_vd3){gg_permute(gg_load(b->x + from), order), gg_permute(gg_load(b->y + from), order),
                       gg_permute(gg_load(b->z + from), order)};
  }
}

/* Of a bound: 0 if even pairs at rest are over it. */
GG_INLINE gg_real square(gg_real bound)
{
  return bound > 0 ? bound * bound : 0;
}

/* Some pair is faster than the sum of tops by which its blocks were drawn: one of them has been visited since, or the
 * gas is faster than the bound of all. The former is made good exactly: the visit goes under the bound of now, and is
 * repeated with such a probability that its mean number is what it should have been: `again`. Returns the bound. */
GG_INLINE gg_real reconsider(gg_features f, gg_batch *w, const gg_meeting *at, gg_real bound, gg_rng *rng, bool *again)
{
  gg_vd a2 = gg_all(0), b2 = a2;
  for (int part = 0; part < GG_PARTS; part++) {
    gg_vd3 a = streamed(f, at->drift, at->ca[part]), b = streamed(f, at->drift, at->cb[part]);
    a2 = gg_larger(a2, gg_vd3_dot(a, a));
    b2 = gg_larger(b2, gg_vd3_dot(b, b));
    w->overflows += (unsigned)__builtin_popcount(gg_bits(gg_less(gg_all(square(w->bound)), at->v2[part])));
  }
  gg_v2 peaks = gg_peaks(a2, b2);
  gg_real now = (gg_real)fmin((sqrt(peaks[0]) + sqrt(peaks[1])) * (1 + 1e-15), w->bound);
  if (now <= bound) return bound;
  *again = gg_rng_uniform(rng) * (bound + w->s0) < now - bound;
  return now;
}

GG_INLINE void look(gg_features f, const gg_batch *w, gg_meeting *at, unsigned order)
{
  load_in_order(&w->two[at->b], order, at->cb);
  if (f.rule != GG_SMOOTH) load_in_order(&w->spin_two[at->b], order, at->sb);
  for (int part = 0; part < GG_PARTS; part++) {
    at->ca[part] = load(&w->one[at->a], part * GG_WIDTH);
    at->v[part] = streamed(f, at->drift, gg_vd3_sub(at->ca[part], at->cb[part]));
    at->v2[part] = gg_vd3_dot(at->v[part], at->v[part]);
  }
}

GG_INLINE bool any_faster(const gg_meeting *at, gg_real bound)
{
  unsigned over = 0;
  for (int part = 0; part < GG_PARTS; part++) over |= gg_bits(gg_less(gg_all(square(bound)), at->v2[part]));
  return over != 0;
}

GG_INLINE void collide(gg_features f, gg_batch *w, const gg_meeting *at, gg_real bound)
{
  gg_fastest top;
  gg_directions_stock(&w->near, &w->rng, gg_needs_k(f) ? GG_COSINE : GG_UNIFORM);
  if (f.shear == GG_SHEARED_DENSE) gg_directions_stock(&w->sheared, &w->rng, GG_SHEARED);
  for (int part = 0; part < GG_PARTS; part++) {
    if (!w->words_left) gg_lane_two(&w->rng, part, &w->word[1][part], &w->word[0][part]);
    w->worst = gg_larger(w->worst, at->v2[part]);
    collide_part(f, w, at, part, bound, w->word[!w->words_left][part], &top);
  }
  w->words_left = !w->words_left;
  w->visits++;
  gg_v2 peaks = gg_peaks(top.a, top.b) * w->per_unit;
  w->top_one[at->a] = (float)peaks[0];
  w->top_two[at->b] = (float)peaks[1];
}

GG_INLINE void visit(gg_features f, gg_batch *w, gg_meeting *at, gg_real bound, gg_rng *rng)
{
  bool again = false;
  if (__builtin_expect(any_faster(at, bound), 0)) bound = reconsider(f, w, at, bound, rng, &again);
  for (;;) {
    collide(f, w, at, bound);
    if (__builtin_expect(!again, 1)) break;
    again = false;
    look(f, w, at, 0);
  }
}

GG_INLINE uint32_t item(const gg_real *list, unsigned i)
{
  gg_word bits;
  __builtin_memcpy(&bits, &list[i], sizeof bits);
  return (uint32_t)bits;
}

GG_INLINE gg_vu lane_numbers(unsigned first)
{
  gg_vu n;
  for (unsigned l = 0; l < GG_WIDTH; l++) n[l] = first + l;
  return n;
}

/* All bits of the lanes where a == b. */
GG_INLINE gg_vu equal(gg_vu a, gg_vu b)
{
  return (gg_vu)(a == b);
}

GG_INLINE gg_vu all_bits(gg_word x)
{
  return x - (gg_vu){0};
}

/* One draw a lane: which blocks, and under which bound of |C12|; another random word gives the order, and whether to
 * visit. */
GG_INLINE void draw_part(gg_features f, gg_batch *w, gg_draw *next, int part, gg_real root, unsigned first, unsigned n)
{
  gg_vu a, b, more, spare;
  gg_lane_two_below(&w->rng, part, w->n_one, w->n_two, &a, &b);
  gg_lane_two(&w->rng, part, &more, &spare);
  gg_vd bound = (gg_roots_at(w->top_one, a) + gg_roots_at(w->top_two, b)) * root;
  bound = gg_smaller(bound + (w->floor == 0 ? 0 : (gg_real)INFINITY), gg_all(w->bound)); /* an upper layer: under one bound */
  gg_vd u = gg_lane_one_to_two(more) - 1;
  gg_vu odd = equal(a, all_bits(w->odd_one)) | equal(b, all_bits(w->odd_two));
  if (f.same) {
    gg_vu swap = (a ^ b) & (gg_vu)(b < a);
    odd |= equal(a, b);
    a ^= swap;
    b ^= swap;
  }
  gg_mask keep = gg_or(gg_less(u * (w->bound + w->s0), bound + w->s0), gg_low_bit(odd));
  gg_vu nth = lane_numbers(first);
  if (first + GG_WIDTH > n) keep = gg_and(keep, gg_low_bit((gg_vu)(nth < all_bits(n))));
  gg_pack(next->one + next->n, keep, (gg_vd)a);
  gg_pack(next->two + next->n, keep, (gg_vd)(b | (odd & all_bits(ODD))));
  gg_pack(next->order + next->n, keep, (gg_vd)more);
  gg_pack(next->bound + next->n, keep, bound);
  if (f.shear != GG_UNSHEARED) gg_pack(next->nth + next->n, keep, (gg_vd)nth);
  next->n += (unsigned)__builtin_popcount(gg_bits(keep));
}

GG_INLINE void prefetch(const gg_real_block *b)
{
  for (size_t line = 0; line < (sizeof *b + 63) / 64; line++) __builtin_prefetch((const char *)b + 64 * line, 1);
}

/* Draw `n` block pairs and keep those to be visited. */
GG_INLINE void draw(gg_features f, gg_batch *w, gg_draw *next, unsigned n, double drift_step)
{
  const double delta = n * drift_step;
  next->drift = w->next_drift;
  next->unit = w->next_unit;
  next->n = 0;
  w->next_drift += delta;
  w->next_unit *= gg_top_growth(delta);
  const gg_real root = (gg_real)(sqrt(w->next_unit) * (1 + 1e-6));
  for (unsigned first = 0; first < n; first += GG_LANES)
    for (int part = 0; part < GG_PARTS; part++) draw_part(f, w, next, part, root, first + (unsigned)part * GG_WIDTH, n);
}

/* Call the memory of a visit to come. */
GG_INLINE void call(gg_features f, const gg_batch *w, uint32_t a, uint32_t b)
{
  prefetch(&w->one[a]);
  prefetch(&w->two[b]);
  if (f.rule == GG_SMOOTH) return;
  prefetch(&w->spin_one[a]);
  prefetch(&w->spin_two[b]);
}

/* Sums in single precision are good for a few visits: then they go into double ones. */
GG_INLINE void fold(gg_vd v[GG_PARTS], double folded[GG_LANES])
{
  for (int l = 0; l < GG_LANES; l++) folded[l] += v[l / GG_WIDTH][l % GG_WIDTH];
  for (int part = 0; part < GG_PARTS; part++) v[part] = gg_all(0);
}

GG_INLINE void fold_tally(gg_features f, gg_batch *w, gg_folded *to)
{
  if (f.tap == GG_TAP_CLOSED) return;
  fold(w->gn2, to->gn2);
  fold(w->Jg, to->Jg);
  fold(w->J2, to->J2);
  if (f.tap == GG_TAP_LOSS) return;
  fold(w->xx, to->xx);
  fold(w->yy, to->yy);
  fold(w->zz, to->zz);
  fold(w->xy, to->xy);
  fold(w->yx, to->yx);
}

static double sum_of_lanes(const double v[GG_LANES])
{
  double sum = 0;
  for (int l = 0; l < GG_LANES; l++) sum += v[l];
  return sum;
}

GG_INLINE uint32_t odd_block(const gg_population *p)
{
  return p->n % GG_LANES ? (uint32_t)p->n_blocks - 1 : UINT32_MAX;
}

GG_INLINE void start(gg_features f, gg_batch *w, const gg_pairing *p, const gg_rng_lanes *lanes)
{
  *w = (gg_batch){.one = p->one->c,
                  .two = p->two->c,
                  .spin_one = p->one->s,
                  .spin_two = p->two->s,
                  .top_one = p->one->top,
                  .top_two = p->two->top,
                  .n_one = (uint32_t)p->one->n_blocks,
                  .n_two = (uint32_t)p->two->n_blocks,
                  .odd_one = odd_block(p->one),
                  .odd_two = odd_block(p->two),
                  .contact = gg_lane_contact_of(&p->contact),
                  .floor = (gg_real)p->floor,
                  .shift = (gg_real)p->shift,
                  .s0 = f.shear == GG_SHEARED_DENSE ? (gg_real)(GG_SHEAR_SHARE * p->shift) : 0,
                  .next_drift = p->drift,
                  .next_unit = p->top_unit};
  w->bound = (gg_real)(p->floor + p->bound - w->s0);
  w->sorts = gg_less(gg_all(SORTED), gg_all((gg_real)p->one->n_blocks));
  gg_lane_rng_load(&w->rng, lanes);
}

GG_INLINE void finish(gg_features f, gg_batch *w, gg_folded *sums, gg_pairing *p, gg_rng_lanes *lanes)
{
  fold_tally(f, w, sums);
  gg_lane_rng_save(&w->rng, lanes);
  p->tried += w->visits * GG_LANES;
  p->collisions += w->collisions;
  p->overflows += w->overflows;
  for (int l = 0; l < GG_WIDTH; l++) p->worst = fmax(p->worst, w->s0 + sqrt(w->worst[l]));
  if (f.tap == GG_TAP_CLOSED) return;
  p->loss += gg_loss_of(f.rule, &p->contact,
                        (gg_loss_terms){sum_of_lanes(sums->gn2), sum_of_lanes(sums->Jg), sum_of_lanes(sums->J2)});
  if (f.tap == GG_TAP_LOSS) return;
  p->stress[0][0] += p->sigma * sum_of_lanes(sums->xx);
  p->stress[1][1] += p->sigma * sum_of_lanes(sums->yy);
  p->stress[2][2] += p->sigma * sum_of_lanes(sums->zz);
  p->stress[0][1] += p->sigma * sum_of_lanes(sums->xy);
  p->stress[1][0] += p->sigma * sum_of_lanes(f.rule == GG_SMOOTH ? sums->xy : sums->yx);
}

/* The i-th visit of the list; past its end, some blocks or other. */
GG_INLINE void meet(gg_features f, const gg_batch *w, const gg_draw *now, unsigned i, double drift_step, gg_meeting *at)
{
  const uint32_t two = item(now->two, i);
  at->a = item(now->one, i);
  at->b = two & ~ODD;
  at->odd = two & ODD;
  at->drift = f.shear == GG_UNSHEARED ? 0 : (gg_real)(now->drift + item(now->nth, i) * drift_step);
  look(f, w, at, item(now->order, i) % GG_LANES);
}

/* Each visit is loaded before the one ahead of it is stored: with stores that come late and addresses that agree in
 * their last bits now and then, a processor would rather wait than let loads pass. */
GG_INLINE void visit_all(gg_features f, gg_batch *w, const gg_draw *now, const gg_draw *next, gg_pairing *p,
                         gg_rng *rng)
{
  w->per_unit = (gg_real)gg_per_top(now->unit);
  gg_meeting at, ahead;
  meet(f, w, now, 0, p->drift_step, &at);
  for (unsigned i = 0; i < now->n; i++, at = ahead) {
    call(f, w, item(next->one, i), item(next->two, i) & ~ODD); /* about as many; what is past the end is old, and harmless */
    meet(f, w, now, i + 1, p->drift_step, &ahead);
    bool touched = (ahead.a == at.a) | (ahead.a == at.b) | (ahead.b == at.a) | (ahead.b == at.b);
    if (__builtin_expect(at.odd, 0)) {
      p->drift = at.drift;
      p->top_unit = now->unit;
      gg_collide_odd_blocks(f, p, at.a, at.b, item(now->order, i) % GG_LANES, rng);
    } else {
      visit(f, w, &at, now->bound[i], rng);
    }
    if (__builtin_expect(touched, 0)) look(f, w, &ahead, item(now->order, i + 1) % GG_LANES);
  }
}

/* Everything of a batch. `f` is a constant: each instance holds only what it needs. */
GG_INLINE void run(gg_features f, gg_pairing *p, gg_rng_lanes *lanes, gg_rng *rng)
{
  gg_batch w;
  gg_real near[3][GG_DIRECTIONS_ROOM], sheared[3][GG_DIRECTIONS_ROOM];
  gg_draw queue[2] = {{0}, {0}};
  gg_folded sums = {{0}, {0}, {0}, {0}, {0}, {0}, {0}, {0}};
  start(f, &w, p, lanes);
  w.near = (gg_directions){.x = near[0], .y = near[1], .z = near[2]};
  w.sheared = (gg_directions){.x = sheared[0], .y = sheared[1], .z = sheared[2]};
  unsigned n = p->candidates < DRAWS ? (unsigned)p->candidates : DRAWS;
  draw(f, &w, &queue[0], n, p->drift_step);
  for (uint64_t left = p->candidates - n, turn = 0; n; turn ^= 1) {
    n = left < DRAWS ? (unsigned)left : DRAWS;
    left -= n;
    draw(f, &w, &queue[turn ^ 1], n, p->drift_step);
    visit_all(f, &w, &queue[turn], &queue[turn ^ 1], p, rng);
    if (sizeof(gg_real) < sizeof(double)) fold_tally(f, &w, &sums);
  }
  p->top_unit = w.next_unit;
  finish(f, &w, &sums, p, lanes);
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

#ifdef GG_SINGLE_LANES
#define NAME_OF(instructions) gg_collide_blocks_single_##instructions
#else
#define NAME_OF(instructions) gg_collide_blocks_##instructions
#endif
#define NAME(instructions) NAME_OF(instructions)

gg_collide_blocks *NAME(GG_INSTRUCTIONS)(gg_features f)
{
#define ENTRY(rule, shear, tap, same) [rule][shear][tap][same] = run_##rule##_##shear##_##tap##_##same,
  static gg_collide_blocks *const table[GG_FRICTIONAL + 1][GG_SHEARED_DENSE + 1][GG_TAP_STRESS + 1][2] = {EACH(ENTRY)};
  return table[f.rule][f.shear][f.tap][f.same];
}
