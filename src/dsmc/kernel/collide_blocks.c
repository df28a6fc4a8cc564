/* Collisions on blocks, a Monte Carlo pass: two random blocks, the lanes of one against those of the other in a random
 * order, eight candidates at once (candidate.h). Compiled once for each collision rule (GG_RULE), with and without a
 * law of restitution (GG_LAW), set of instructions and precision (GG_SINGLE_LANES): GG_INSTANCES is what they are found
 * by. All sets leave the same bits.
 *
 * No bias. Each lane of one block is paired with each lane of the other with probability 1/8, and every pair of grains
 * in different blocks is a candidate equally often. Pairs within one block, and the last block where it is not full, go
 * through the plain path at the same rate.
 *
 * Acceptance-rejection in two steps. The majorant of all pairs is set by the fastest grains of all. So a block pair is
 * accepted with probability (sum of its speed bounds)/(that majorant) only, and its lanes with that sum as their
 * majorant, which comes to the same rate for every pair of grains. Written back, the faster grain of each lane lies in
 * the block of lower number. Any order would do, but this one sorts grains by speed, and speed bounds are tighter yet.
 * Half the candidates collide, against a quarter without. Below a thousand blocks lanes are exchanged at random
 * instead: eight fast grains that always act at once would be too large a part of the ensemble. */
#include "dsmc/kernel/collide_blocks.h"

#include <string.h>

#include "dsmc/kernel/stages.h"

enum { SORTED_FROM = 1000 }; /* blocks: from so many on grains are sorted by speed */

GG_INLINE void prefetch_block(const gg_dsmc_real_block *b)
{
  for (size_t line = 0; line < (sizeof *b + 63) / 64; line++) __builtin_prefetch((const char *)b + 64 * line, 1);
}

/* The memory of a block pair to come. */
GG_INLINE void prefetch_pair(gg_dsmc_features f, const gg_dsmc_pass_state *w, uint32_t a, uint32_t b)
{
  prefetch_block(&w->one[a]);
  prefetch_block(&w->two[b]);
  if (f.rule == GG_SMOOTH) return;
  prefetch_block(&w->spin_one[a]);
  prefetch_block(&w->spin_two[b]);
}

/* Speed bounds of some blocks of a population: another thread may have written them last. */
GG_INLINE void prefetch_speed_bounds(const gg_dsmc_population *p, gg_dsmc_range r)
{
  if (r.n == p->n_blocks) return;
  for (uint32_t b = r.first; b < r.first + r.n; b += 64 / sizeof *p->speed_bound)
    __builtin_prefetch(&p->speed_bound[b], 1);
}

GG_INLINE uint32_t odd_block(const gg_dsmc_population *p)
{
  return p->n % GG_DSMC_LANES ? (uint32_t)p->n_blocks - 1 : UINT32_MAX;
}

GG_INLINE void start(gg_dsmc_features f, gg_dsmc_pass_state *w, const gg_dsmc_pass *p)
{
  *w = (gg_dsmc_pass_state){.one = p->one->c,
                            .two = p->two->c,
                            .spin_one = p->one->s,
                            .spin_two = p->two->s,
                            .bound_one = p->one->speed_bound,
                            .bound_two = p->two->speed_bound,
                            .any_odd = p->one->n % GG_DSMC_LANES || p->two->n % GG_DSMC_LANES,
                            .odd_one = gg_all_words(odd_block(p->one)),
                            .odd_two = gg_all_words(odd_block(p->two)),
                            .first_one = gg_all_words(p->blocks[0].first),
                            .first_two = gg_all_words(p->blocks[1].first),
                            .n_one = gg_all_words(p->blocks[0].n),
                            .n_two = gg_all_words(p->blocks[1].n),
                            .contact = gg_dsmc_lane_contact_of(f.same, &p->contact),
                            .loss_scale = (gg_real)p->loss_scale,
                            .floor = (gg_real)p->floor,
                            .shift = (gg_real)p->shift,
                            .s0 = f.shear == GG_DSMC_SHEARED_DENSE ? (gg_real)(GG_DSMC_SHEAR_SHARE * p->shift) : 0,
                            .scale = p->bound_scale,
                            .margin = p->bound_margin,
                            .root = (gg_real)(sqrt(p->bound_scale) * (1 + 1e-6)),
                            .per_scale = (gg_real)gg_dsmc_per_bound(p->bound_scale)};
#ifdef GG_SINGLE_LANES
  if (f.law) w->losses = p->losses->single;
#else
  if (f.law) w->losses = p->losses->loss;
#endif
  w->majorant = (gg_real)(p->floor + p->majorant - w->s0);
  w->layer = p->floor > 0;
  w->most = gg_all(w->majorant);
  w->most_rate = gg_all(w->majorant + w->s0);
  w->lowest = w->floor - w->s0;
  w->from_zero = w->lowest == 0;
  w->to_a = gg_all(gg_dsmc_needs_k(f) ? w->contact.im1 : w->contact.push1);
  w->to_b = gg_all(gg_dsmc_needs_k(f) ? w->contact.im2 : w->contact.push2);
  w->sorts = p->one->n_blocks >= SORTED_FROM;
}

GG_INLINE void finish(gg_dsmc_features f, gg_dsmc_pass_state *w, gg_dsmc_pass *p)
{
  p->tried += w->block_pairs * GG_DSMC_LANES;
  p->collisions += w->collisions;
  p->overflows += w->overflows;
  for (int l = 0; l < GG_WIDTH; l++) p->largest = fmax(p->largest, w->s0 + sqrt(w->largest[l]));
  gg_dsmc_sums_finish(f, &w->sums, p);
}

/* The next block pair is for the plain path. */
GG_INLINE void collide_odd(gg_dsmc_features f, const gg_dsmc_pass_state *w, const gg_dsmc_block_pairs *d,
                           gg_dsmc_pass *p, gg_rng *rng)
{
  const unsigned i = d->at;
  p->strain = f.shear == GG_DSMC_UNSHEARED ? d->strain : (double)d->strains[i];
  p->bound_scale = f.shear == GG_DSMC_UNSHEARED || w->margin > 1 ? w->scale : 1 / (double)d->per_scale[i];
  gg_dsmc_collide_odd_blocks(f, p, (uint32_t)gg_dsmc_listed(d->one, i),
                             (uint32_t)gg_dsmc_listed(d->two, i) & ~GG_DSMC_ODD,
                             (unsigned)gg_dsmc_listed(d->order, i) % GG_DSMC_LANES, rng);
}

/* Block pairs in progress, each at another stage, or none. */
typedef struct pipeline {
  gg_dsmc_block_pair *next, *loaded, *accepted;
  bool to_accept, to_write_back;
} pipeline;

GG_INLINE bool in_common(const gg_dsmc_block_pair *at, uint32_t one, uint32_t two)
{
  return (at->one == one) | (at->two == one) | (at->one == two) | (at->two == two);
}

/* Does the next block pair of the list have to wait for one in progress, since they have a block in common? */
GG_INLINE bool has_to_wait(const pipeline *l, const gg_dsmc_block_pairs *d)
{
  const uint32_t one = (uint32_t)gg_dsmc_listed(d->one, d->at),
                 two = (uint32_t)gg_dsmc_listed(d->two, d->at) & ~GG_DSMC_ODD;
  if (l->to_accept && in_common(l->loaded, one, two)) return true;
  return l->to_write_back && in_common(l->accepted, one, two);
}

/* The next block pair enters the first stage, if it can. Returns whether. */
GG_INLINE bool take(gg_dsmc_features f, gg_dsmc_pass_state *w, gg_dsmc_block_pairs *d, pipeline *l, gg_dsmc_pass *p,
                    gg_rng *rng)
{
  if (__builtin_expect(d->at == d->n || has_to_wait(l, d), 0)) return false;
  const bool odd = gg_dsmc_listed(d->two, d->at) & GG_DSMC_ODD;
  if (__builtin_expect(odd, 0))
    collide_odd(f, w, d, p, rng);
  else
    gg_dsmc_load(f, w, d, l->next);
  d->layer = false;
  d->at++;
  return !odd;
}

/* Random words of two block pairs at a time. */
GG_INLINE void take_words(gg_dsmc_samples *c, gg_dsmc_block_pair *at, gg_vu second[GG_PARTS], unsigned cycle)
{
  for (int part = 0; part < GG_PARTS; part++)
    if (cycle % 2)
      at->word[part] = second[part];
    else
      gg_dsmc_lane_two(&c->rng, part, &at->word[part], &second[part]);
}

/* All block pairs, as a pipeline. Up to three are in progress, each at another stage: a stage finds ready what the one
 * before has left, and the processor always has something to do. Directions are made in their midst, a few at a time,
 * for the same reason. Arithmetic on registers of eight is scarce: so constants come as whole registers, and of two
 * velocities one is chosen by a masked store. */
GG_INLINE void collide_all(gg_dsmc_features f, gg_dsmc_pass_state *w, gg_dsmc_samples *c, gg_dsmc_block_pairs *d,
                           gg_dsmc_pass *p, gg_rng *rng)
{
  static const unsigned makes = 0xb6db; /* directions: in eleven of sixteen cycles */
  gg_dsmc_block_pair room[3];
  pipeline l = {.next = &room[0], .loaded = &room[1], .accepted = &room[2]};
  gg_vu second[GG_PARTS] = {0};
  unsigned making = 0;
  for (unsigned cycle = 0;; cycle++) {
    if (cycle % 4 == 0) gg_dsmc_draw_ahead(f, w, c, d, p->strain_step);
    if (cycle % 16 == 0) making = gg_dsmc_directions_begin(&c->near) ? makes : 0;
    if (d->at == d->n && !l.to_accept && !l.to_write_back) break;
    take_words(c, l.next, second, cycle);
    const bool taken = take(f, w, d, &l, p, rng);
    prefetch_pair(f, w, (uint32_t)gg_dsmc_listed(d->one, d->at + GG_DSMC_PREFETCH_AHEAD),
                  (uint32_t)gg_dsmc_listed(d->two, d->at + GG_DSMC_PREFETCH_AHEAD) & ~GG_DSMC_ODD);
    if (making >> cycle % 16 & 1) gg_dsmc_prefetch_directions(f, c);
    if (l.to_accept) gg_dsmc_accept(f, w, c, rng, l.loaded);
    gg_dsmc_block_pair *last = l.accepted;
    if (l.to_write_back) {
      gg_dsmc_write_back(f, w, last);
      if (__builtin_expect(last->correct, 0))
        gg_dsmc_draw_correction(f, d, last->one, last->two, last->order, last->majorant, last->most, last->strain,
                                last->per_scale);
    }
    l.accepted = l.loaded;
    l.loaded = l.next;
    l.next = last;
    l.to_write_back = l.to_accept;
    l.to_accept = taken;
  }
}

/* A whole pass. `f` is a constant: each instance holds only what it needs. */
GG_INLINE void run(gg_dsmc_features f, gg_dsmc_pass *p, gg_dsmc_rng_lanes *lanes, gg_rng *rng)
{
  gg_dsmc_pass_state w;
  gg_real near[3 * GG_DSMC_DIRECTIONS_ROOM], sheared[3 * GG_DSMC_DIRECTIONS_ROOM];
  gg_dsmc_block_pairs list;
  start(f, &w, p);
  gg_dsmc_samples samples = {.near = {.x = near}, .sheared = {.x = sheared}};
  gg_dsmc_lane_rng_load(&samples.rng, lanes);
  list.at = list.n = 1;
  list.left = p->candidates;
  list.layer = false;
  list.strain = p->strain;
  memset(list.one, 0, sizeof list.one); /* what is past the end is prefetched, too */
  memset(list.two, 0, sizeof list.two);
  prefetch_speed_bounds(p->one, p->blocks[0]);
  prefetch_speed_bounds(p->two, p->blocks[1]);
  collide_all(f, &w, &samples, &list, p, rng);
  p->bound_scale = w.scale;
  finish(f, &w, p);
  gg_dsmc_lane_rng_save(&samples.rng, lanes);
}

/* The instances: shear and sums x one or two species. What is not here, no scene needs (gg_dsmc_features_by_law). */
#define EACH_SAME(X, shear, sums) X(shear, sums, 0) X(shear, sums, 1)
#define EACH_WITH_LAW(X)                                                                                               \
  EACH_SAME(X, GG_DSMC_UNSHEARED, GG_DSMC_LOSS)                                                                        \
  EACH_SAME(X, GG_DSMC_UNSHEARED, GG_DSMC_STRESS)                                                                      \
  EACH_SAME(X, GG_DSMC_SHEARED_DILUTE, GG_DSMC_LOSS)                                                                   \
  EACH_SAME(X, GG_DSMC_SHEARED_DENSE, GG_DSMC_STRESS)
#if GG_LAW
#define EACH(X) EACH_WITH_LAW(X)
#else
#define EACH(X)                                                                                                        \
  EACH_WITH_LAW(X)                                                                                                     \
  EACH_SAME(X, GG_DSMC_UNSHEARED, GG_DSMC_NO_SUMS)                                                                     \
  EACH_SAME(X, GG_DSMC_SHEARED_DILUTE, GG_DSMC_NO_SUMS)                                                                \
  EACH_SAME(X, GG_DSMC_SHEARED_DENSE, GG_DSMC_NO_SUMS)                                                                 \
  EACH_SAME(X, GG_DSMC_SHEARED_DENSE, GG_DSMC_LOSS)
#endif

#define INSTANCE(shear, sums, same)                                                                                    \
  static void run_##shear##_##sums##_##same(gg_dsmc_pass *p, gg_dsmc_rng_lanes *lanes, gg_rng *rng)                    \
  {                                                                                                                    \
    run((gg_dsmc_features){GG_RULE, shear, sums, same, GG_LAW}, p, lanes, rng);                                        \
  }
EACH(INSTANCE)

#define ENTRY(shear, sums, same) [shear][sums][same] = run_##shear##_##sums##_##same,
const gg_dsmc_instances GG_INSTANCES = {.of = {EACH(ENTRY)}};
