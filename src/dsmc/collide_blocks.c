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

#include "dsmc/block_visit.h"

enum { SORTED = 999 }; /* blocks, at least, to be sorted by speed */

GG_INLINE void prefetch(const gg_real_block *b)
{
  for (size_t line = 0; line < (sizeof *b + 63) / 64; line++) __builtin_prefetch((const char *)b + 64 * line, 1);
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

/* The same for all of a list. */
GG_INLINE void call_all(gg_features f, const gg_batch *w, const gg_draw *list)
{
  for (unsigned i = 0; i < list->n; i++)
    call(f, w, (uint32_t)gg_listed(list->one, i), (uint32_t)gg_listed(list->two, i) & ~GG_ODD);
}

/* Of some blocks of a population the tops: another thread may have had them before. */
GG_INLINE void call_tops(const gg_population *p, gg_range r)
{
  if (r.n == p->n_blocks) return;
  for (uint32_t b = r.first; b < r.first + r.n; b += 64 / sizeof *p->top) __builtin_prefetch(&p->top[b], 1);
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
                  .blocks_one = p->blocks[0],
                  .blocks_two = p->blocks[1],
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

GG_INLINE void finish(gg_features f, gg_batch *w, gg_pairing *p, gg_rng_lanes *lanes)
{
  gg_lane_rng_save(&w->rng, lanes);
  p->tried += w->visits * GG_LANES;
  p->collisions += w->collisions;
  p->overflows += w->overflows;
  for (int l = 0; l < GG_WIDTH; l++) p->worst = fmax(p->worst, w->s0 + sqrt(w->worst[l]));
  gg_tally_finish(f, &w->tally, p);
}

/* What is not an ordinary visit. Returns whether the i-th is to be made once more. */
GG_INLINE bool carry_out_odd(gg_features f, gg_batch *w, gg_draw *now, unsigned i, const gg_meeting *at, gg_pairing *p,
                             gg_rng *rng)
{
  if (at->odd) {
    p->drift = at->drift;
    p->top_unit = now->unit;
    gg_collide_odd_blocks(f, p, at->a, at->b, (unsigned)gg_listed(now->order, i) % GG_LANES, rng);
    return false;
  }
  gg_vu spare;
  gg_carry_out(f, w, at);
  now->bound[i] = at->bound;
  for (int part = 0; part < GG_PARTS; part++) gg_lane_two(&w->rng, part, &now->words[i][part], &spare);
  return true;
}

/* A list of draws being visited. */
typedef struct gg_visits {
  gg_draw *now;
  const gg_draw *next; /* whose memory is called meanwhile */
  unsigned i;          /* visits looked at */
  bool pending;        /* the last of them is still to be written back */
} gg_visits;

GG_INLINE bool in_common(const gg_meeting *one, const gg_meeting *two)
{
  return (one->a == two->a) | (one->a == two->b) | (one->b == two->a) | (one->b == two->b);
}

/* Work out the next visit, then write back the one before. If they have a block in common, the next is worked out anew.
 * Returns false at the end. */
GG_INLINE bool visit(gg_features f, gg_batch *w, gg_visits *r, gg_pairing *p, gg_rng *rng, const gg_meeting *at,
                     gg_meeting *ahead)
{
  const bool end = r->i == r->now->n;
  if (end)
    gg_stock(f, w);
  else
    gg_foresee(f, w, r->now, r->i, p->drift_step, rng, ahead);
  /* About as many to come; what is past the end of their list is old, and harmless. */
  call(f, w, (uint32_t)gg_listed(r->next->one, r->i), (uint32_t)gg_listed(r->next->two, r->i) & ~GG_ODD);
  if (r->pending) {
    bool anew = !end && in_common(ahead, at);
    if (__builtin_expect(at->odd | at->again, 0)) {
      r->i -= carry_out_odd(f, w, r->now, r->i - 1, at, p, rng);
      anew = true;
    } else {
      gg_carry_out(f, w, at);
    }
    r->pending = !anew;
    if (__builtin_expect(anew, 0)) return true;
  }
  if (end) return false;
  r->pending = true;
  r->i++;
  return true;
}

/* What comes of a visit is worked out before the one ahead of it is written back: there is more to do meanwhile, and
 * with stores that come late and addresses that agree in their last bits now and then, a processor would rather wait
 * than let loads pass. Two meetings take turns as the one and the other: copying them would cost as much as the sums.
 */
GG_INLINE void visit_all(gg_features f, gg_batch *w, gg_draw *now, const gg_draw *next, gg_meeting turn[2],
                         gg_pairing *p, gg_rng *rng)
{
  gg_visits r = {.now = now, .next = next};
  w->per_unit = (gg_real)gg_per_top(now->unit);
  while (visit(f, w, &r, p, rng, &turn[0], &turn[1]) && visit(f, w, &r, p, rng, &turn[1], &turn[0])) continue;
}

/* Everything of a batch. `f` is a constant: each instance holds only what it needs. */
GG_INLINE void run(gg_features f, gg_pairing *p, gg_rng_lanes *lanes, gg_rng *rng)
{
  gg_batch w;
  gg_real near[3][GG_DIRECTIONS_ROOM], sheared[3][GG_DIRECTIONS_ROOM];
  gg_draw queue[2] = {{0}, {0}};
  gg_meeting meeting[2] = {{0}, {0}};
  start(f, &w, p, lanes);
  w.near = (gg_directions){.x = near[0], .y = near[1], .z = near[2]};
  w.sheared = (gg_directions){.x = sheared[0], .y = sheared[1], .z = sheared[2]};
  unsigned n = p->candidates < GG_DRAWS ? (unsigned)p->candidates : GG_DRAWS;
  call_tops(p->one, p->blocks[0]);
  call_tops(p->two, p->blocks[1]);
  gg_draw_visits(f, &w, &queue[0], n, p->drift_step);
  call_all(f, &w, &queue[0]);
  for (uint64_t left = p->candidates - n, turn = 0; n; turn ^= 1) {
    n = left < GG_DRAWS ? (unsigned)left : GG_DRAWS;
    left -= n;
    gg_draw_visits(f, &w, &queue[turn ^ 1], n, p->drift_step);
    visit_all(f, &w, &queue[turn], &queue[turn ^ 1], meeting, p, rng);
  }
  p->top_unit = w.next_unit;
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
