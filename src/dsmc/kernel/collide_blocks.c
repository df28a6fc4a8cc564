/* The collision step on blocks: two random blocks, the lanes of one against those of the other in a random order, eight
 * candidates at once (block_contact.h). Compiled once for each collision rule (GG_RULE), set of instructions and
 * precision (GG_SINGLE_LANES): GG_INSTANCES is what they are found by. All sets leave the same bits.
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
#include "dsmc/kernel/collide_blocks.h"

#include <string.h>

#include "dsmc/kernel/block_visit.h"

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

GG_INLINE void start(gg_features f, gg_batch *w, const gg_pairing *p)
{
  *w = (gg_batch){.one = p->one->c,
                  .two = p->two->c,
                  .spin_one = p->one->s,
                  .spin_two = p->two->s,
                  .top_one = p->one->top,
                  .top_two = p->two->top,
                  .any_odd = p->one->n % GG_LANES || p->two->n % GG_LANES,
                  .odd_one = gg_all_words(odd_block(p->one)),
                  .odd_two = gg_all_words(odd_block(p->two)),
                  .first_one = gg_all_words(p->blocks[0].first),
                  .first_two = gg_all_words(p->blocks[1].first),
                  .n_one = gg_all_words(p->blocks[0].n),
                  .n_two = gg_all_words(p->blocks[1].n),
                  .contact = gg_lane_contact_of(&p->contact),
                  .floor = (gg_real)p->floor,
                  .shift = (gg_real)p->shift,
                  .s0 = f.shear == GG_SHEARED_DENSE ? (gg_real)(GG_SHEAR_SHARE * p->shift) : 0,
                  .unit = p->top_unit,
                  .root = (gg_real)(sqrt(p->top_unit) * (1 + 1e-6)),
                  .per_unit = (gg_real)gg_per_top(p->top_unit)};
  w->bound = (gg_real)(p->floor + p->bound - w->s0);
  w->layer = p->floor > 0;
  w->most = gg_all(w->bound);
  w->most_rate = gg_all(w->bound + w->s0);
  w->lowest = w->floor - w->s0;
  w->from_zero = w->lowest == 0;
  w->to_a = gg_all(gg_needs_k(f) ? w->contact.im1 : w->contact.push1);
  w->to_b = gg_all(gg_needs_k(f) ? w->contact.im2 : w->contact.push2);
  w->sorts = p->one->n_blocks > SORTED;
}

GG_INLINE void finish(gg_features f, gg_batch *w, gg_pairing *p)
{
  p->tried += w->visits * GG_LANES;
  p->collisions += w->collisions;
  p->overflows += w->overflows;
  for (int l = 0; l < GG_WIDTH; l++) p->worst = fmax(p->worst, w->s0 + sqrt(w->worst[l]));
  gg_tally_finish(f, &w->tally, p);
}

/* The next visit is not for this path. */
GG_INLINE void visit_odd(gg_features f, const gg_batch *w, const gg_draws *d, gg_pairing *p, gg_rng *rng)
{
  const unsigned i = d->at;
  p->drift = f.shear == GG_UNSHEARED ? d->drift : (double)d->drifts[i];
  p->top_unit = f.shear == GG_UNSHEARED ? w->unit : 1 / (double)d->per_unit[i];
  gg_collide_odd_blocks(f, p, (uint32_t)gg_listed(d->one, i), (uint32_t)gg_listed(d->two, i) & ~GG_ODD,
                        (unsigned)gg_listed(d->order, i) % GG_LANES, rng);
}

/* Visits in progress, each at another step, or none. */
typedef struct gg_pipeline {
  gg_meeting *next, *approached, *decided;
  bool to_decide, to_carry_out;
} gg_pipeline;

GG_INLINE bool in_common(const gg_meeting *at, uint32_t one, uint32_t two)
{
  return (at->one == one) | (at->two == one) | (at->one == two) | (at->two == two);
}

/* Does the next visit of the list have to wait for one in progress, since they have a block in common? */
GG_INLINE bool has_to_wait(const gg_pipeline *l, const gg_draws *d)
{
  const uint32_t one = (uint32_t)gg_listed(d->one, d->at), two = (uint32_t)gg_listed(d->two, d->at) & ~GG_ODD;
  if (l->to_decide && in_common(l->approached, one, two)) return true;
  return l->to_carry_out && in_common(l->decided, one, two);
}

/* The next visit takes its first step, if there is one that can. Returns whether. */
GG_INLINE bool take(gg_features f, gg_batch *w, gg_draws *d, gg_pipeline *l, gg_pairing *p, gg_rng *rng)
{
  if (__builtin_expect(d->at == d->n || has_to_wait(l, d), 0)) return false;
  const bool odd = gg_listed(d->two, d->at) & GG_ODD;
  if (__builtin_expect(odd, 0))
    visit_odd(f, w, d, p, rng);
  else
    gg_approach(f, w, d, l->next);
  d->layer = false;
  d->at++;
  return !odd;
}

/* Random words of two visits at a time. */
GG_INLINE void give_words(gg_chance *c, gg_meeting *at, gg_vu second[GG_PARTS], unsigned turn)
{
  for (int part = 0; part < GG_PARTS; part++)
    if (turn % 2)
      at->word[part] = second[part];
    else
      gg_lane_two(&c->rng, part, &at->word[part], &second[part]);
}

/* All visits. Up to three are in progress, each at another step, so that a step finds ready what the one before has
 * left, and a processor always has something to do; and directions are made in their midst, a few at a time, for the
 * same reason. What is scarce is the arithmetic on registers of eight: so constants come as whole registers, either of
 * two velocities is chosen by what is stored. */
GG_INLINE void visit_all(gg_features f, gg_batch *w, gg_chance *c, gg_draws *d, gg_pairing *p, gg_rng *rng)
{
  static const unsigned makes = 0xb6db; /* directions: in eleven of sixteen turns */
  gg_meeting room[3];
  gg_pipeline l = {.next = &room[0], .approached = &room[1], .decided = &room[2]};
  gg_vu second[GG_PARTS] = {0};
  unsigned making = 0;
  for (unsigned turn = 0;; turn++) {
    if (turn % 4 == 0) gg_draw_ahead(f, w, c, d, p->drift_step);
    if (turn % 16 == 0) making = gg_directions_begin(&c->near) ? makes : 0;
    if (d->at == d->n && !l.to_decide && !l.to_carry_out) break;
    give_words(c, l.next, second, turn);
    const bool taken = take(f, w, d, &l, p, rng);
    call(f, w, (uint32_t)gg_listed(d->one, d->at + GG_CALLED),
         (uint32_t)gg_listed(d->two, d->at + GG_CALLED) & ~GG_ODD);
    if (making >> turn % 16 & 1) gg_make_directions(f, c);
    if (l.to_decide) gg_decide(f, w, c, rng, l.approached);
    gg_meeting *last = l.decided;
    if (l.to_carry_out) {
      gg_carry_out(f, w, last);
      if (__builtin_expect(last->again, 0))
        gg_draw_again(f, d, last->one, last->two, last->order, last->bound, last->most, last->drift, last->per_unit);
    }
    l.decided = l.approached;
    l.approached = l.next;
    l.next = last;
    l.to_carry_out = l.to_decide;
    l.to_decide = taken;
  }
}

/* Everything of a batch. `f` is a constant: each instance holds only what it needs. */
GG_INLINE void run(gg_features f, gg_pairing *p, gg_rng_lanes *lanes, gg_rng *rng)
{
  gg_batch w;
  gg_real near[3 * GG_DIRECTIONS_ROOM], sheared[3 * GG_DIRECTIONS_ROOM];
  gg_draws draws;
  start(f, &w, p);
  gg_chance chance = {.near = {.x = near}, .sheared = {.x = sheared}};
  gg_lane_rng_load(&chance.rng, lanes);
  draws.at = draws.n = 1;
  draws.left = p->candidates;
  draws.layer = false;
  draws.drift = p->drift;
  memset(draws.one, 0, sizeof draws.one); /* what is past the end is called, too */
  memset(draws.two, 0, sizeof draws.two);
  call_tops(p->one, p->blocks[0]);
  call_tops(p->two, p->blocks[1]);
  visit_all(f, &w, &chance, &draws, p, rng);
  p->top_unit = w.unit;
  finish(f, &w, p);
  gg_lane_rng_save(&chance.rng, lanes);
}

/* The instances: shear and tap x one or two species. What is not here, no scene needs. */
#define EACH_SAME(X, shear, tap) X(shear, tap, 0) X(shear, tap, 1)
#define EACH(X)                                                                                                        \
  EACH_SAME(X, GG_UNSHEARED, GG_TAP_CLOSED)                                                                            \
  EACH_SAME(X, GG_UNSHEARED, GG_TAP_LOSS)                                                                              \
  EACH_SAME(X, GG_UNSHEARED, GG_TAP_STRESS)                                                                            \
  EACH_SAME(X, GG_SHEARED_DILUTE, GG_TAP_CLOSED)                                                                       \
  EACH_SAME(X, GG_SHEARED_DILUTE, GG_TAP_LOSS)                                                                         \
  EACH_SAME(X, GG_SHEARED_DENSE, GG_TAP_CLOSED)                                                                        \
  EACH_SAME(X, GG_SHEARED_DENSE, GG_TAP_LOSS)                                                                          \
  EACH_SAME(X, GG_SHEARED_DENSE, GG_TAP_STRESS)

#define INSTANCE(shear, tap, same)                                                                                     \
  static void run_##shear##_##tap##_##same(gg_pairing *p, gg_rng_lanes *lanes, gg_rng *rng)                            \
  {                                                                                                                    \
    run((gg_features){GG_RULE, shear, tap, same}, p, lanes, rng);                                                      \
  }
EACH(INSTANCE)

#define ENTRY(shear, tap, same) [shear][tap][same] = run_##shear##_##tap##_##same,
const gg_collide_instances GG_INSTANCES = {.of = {EACH(ENTRY)}};
