/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Collisions on blocks, a Monte Carlo pass: the lanes of a random block collide with the lanes of another one in a
 * random order, eight candidates at once (candidate.h). Compiled once for each collision rule (GG_RULE), with and
 * without a contact of its own (GG_OWN), set of instructions and precision (GG_SINGLE_LANES), into the table
 * GG_INSTANCES. All sets leave the same bits.
 *
 * There is no bias. Each lane of one block is paired with each lane of the other with probability 1/8, and every pair
 * of grains in different blocks is a candidate equally often. Pairs within one block, and a last block that is not
 * full, use the plain path at the same rate.
 *
 * Acceptance-rejection has two steps. The majorant of all pairs is set by the fastest grains of all. So a block pair is
 * accepted with probability (sum of its speed bounds)/(this majorant), and its lanes have this sum as their majorant:
 * the rate of every pair of grains is the same. When they are written back, the faster grain of each lane goes to the
 * block of lower number. Any order is valid; this one sorts grains by speed and makes speed bounds tighter. Half of the
 * candidates collide, against a quarter without it.
 *
 * Sorting has a price: eight fast grains act at once, so means fluctuate more. Over 200 to 300 seeds of a sheared rough
 * gas the spread of T was 1.2 times that without sorting, of the stress 1.1 times, at 2000 to 20 000 grains; of a2 in a
 * cooling gas 1.4 times. That is too much for a tenth less time at 2000 and 5000 grains, but not for half the time at
 * 100 000 grains, which are not cached. Below a thousand blocks lanes are exchanged at random instead. */
#include "dsmc/kernel/collide_blocks.h"

#include <string.h>

#include "dsmc/kernel/stages.h"

enum { SORTED_FROM = 1000 }; /* blocks from which grains are sorted by speed */

GG_INLINE void prefetch_block(const gg_dsmc_real_block *block)
{
  for (size_t line = 0; line < (sizeof *block + 63) / 64; line++)
    __builtin_prefetch((const char *)block + 64 * line, 1);
}

/* Prefetch the memory of a block pair. */
GG_INLINE void prefetch_pair(gg_dsmc_features features, const gg_dsmc_pass_state *state, uint32_t a, uint32_t b)
{
  prefetch_block(&state->one[a]);
  prefetch_block(&state->two[b]);
  if (features.rule == GG_SMOOTH) return;
  prefetch_block(&state->spin_one[a]);
  prefetch_block(&state->spin_two[b]);
}

/* Prefetch the speed bounds of a segment: another thread may have written them last. */
GG_INLINE void prefetch_speed_bounds(const gg_dsmc_population *population, gg_dsmc_range range)
{
  if (range.n == population->n_blocks) return;
  for (uint32_t b = range.first; b < range.first + range.n; b += 64 / sizeof *population->speed_bound)
    __builtin_prefetch(&population->speed_bound[b], 1);
}

GG_INLINE uint32_t odd_block(const gg_dsmc_population *population)
{
  return population->n % GG_DSMC_LANES ? (uint32_t)population->n_blocks - 1 : UINT32_MAX;
}

GG_INLINE void start(gg_dsmc_features features, gg_dsmc_pass_state *state, const gg_dsmc_pass *pass)
{
  *state = (gg_dsmc_pass_state){
      .one = pass->one->c,
      .two = pass->two->c,
      .spin_one = pass->one->s,
      .spin_two = pass->two->s,
      .bound_one = pass->one->speed_bound,
      .bound_two = pass->two->speed_bound,
      .any_odd = pass->one->n % GG_DSMC_LANES || pass->two->n % GG_DSMC_LANES,
      .odd_one = gg_all_words(odd_block(pass->one)),
      .odd_two = gg_all_words(odd_block(pass->two)),
      .first_one = gg_all_words(pass->blocks[0].first),
      .first_two = gg_all_words(pass->blocks[1].first),
      .n_one = gg_all_words(pass->blocks[0].n),
      .n_two = gg_all_words(pass->blocks[1].n),
      .contact = gg_dsmc_lane_contact_of(features.same, &pass->contact),
      .loss_scale = (gg_real)pass->loss_scale,
      .floor = (gg_real)pass->floor,
      .shift = (gg_real)pass->shift,
      .s0 = features.shear == GG_DSMC_SHEARED_DENSE ? (gg_real)(GG_DSMC_SHEAR_SHARE * fabs(pass->shift)) : 0,
      .scale = pass->bound_scale,
      .margin = pass->bound_margin,
      .root = (gg_real)(sqrt(pass->bound_scale) * (1 + 1e-6)),
      .per_scale = (gg_real)gg_dsmc_per_bound(pass->bound_scale)};
  for (int c = 0; features.own && pass->tables && c < GG_N_COEFFICIENTS; c++) {
    const gg_loss_table *table = pass->tables->of[c][gg_pair(pass->species[0], pass->species[1])];
#ifdef GG_SINGLE_LANES
    if (table) state->law[c] = (gg_dsmc_lane_law){table->single, table};
#else
    if (table) state->law[c] = (gg_dsmc_lane_law){table->loss, table};
#endif
  }
  state->sums.kicks = false;
  for (int k = 0; k < GG_N_KICKS; k++) state->sums.kicks |= pass->contact.kick[k] != 0;
  state->majorant = (gg_real)(pass->floor + pass->majorant - state->s0);
  state->correction_pass = pass->floor > 0;
  state->most = gg_all(state->majorant);
  state->most_rate = gg_all(state->majorant + state->s0);
  state->lowest = state->floor - state->s0;
  state->from_zero = state->lowest == 0;
  state->to_a = gg_all(gg_dsmc_needs_k(features) ? state->contact.im1 : state->contact.push1);
  state->to_b = gg_all(gg_dsmc_needs_k(features) ? state->contact.im2 : state->contact.push2);
  state->sorts = pass->one->n_blocks >= SORTED_FROM;
}

GG_INLINE void finish(gg_dsmc_features features, gg_dsmc_pass_state *state, gg_dsmc_pass *pass)
{
  pass->tried += state->block_pairs * GG_DSMC_LANES;
  pass->collisions += state->collisions;
  pass->overflows += state->overflows;
  pass->clamped += state->clamped;
  for (int l = 0; l < GG_WIDTH; l++) pass->largest = fmax(pass->largest, state->s0 + sqrt(state->largest[l]));
  gg_dsmc_sums_finish(features, &state->sums, pass);
}

/* Collide the next block pair on the plain path. */
GG_INLINE void collide_odd(gg_dsmc_features features, const gg_dsmc_pass_state *state, const gg_dsmc_block_pairs *pairs,
                           gg_dsmc_pass *pass, gg_rng *rng)
{
  const unsigned i = pairs->at;
  pass->strain = features.shear == GG_DSMC_UNSHEARED ? pairs->strain : (double)pairs->strains[i];
  pass->bound_scale =
      features.shear == GG_DSMC_UNSHEARED || state->margin > 1 ? state->scale : 1 / (double)pairs->per_scale[i];
  gg_dsmc_collide_odd_blocks(features, pass, (uint32_t)gg_dsmc_listed(pairs->one, i),
                             (uint32_t)gg_dsmc_listed(pairs->two, i) & ~GG_DSMC_ODD,
                             (unsigned)gg_dsmc_listed(pairs->order, i) % GG_DSMC_LANES, rng);
}

/* Block pairs in progress, each at another stage. */
typedef struct pipeline {
  gg_dsmc_block_pair *next, *loaded, *accepted;
  bool to_accept, to_write_back;
} pipeline;

GG_INLINE bool in_common(const gg_dsmc_block_pair *at, uint32_t one, uint32_t two)
{
  return (at->one == one) | (at->two == one) | (at->one == two) | (at->two == two);
}

/* True if the next block pair is blocked by one in progress, because they have a block in common. */
GG_INLINE bool is_blocked(const pipeline *line, const gg_dsmc_block_pairs *pairs)
{
  const uint32_t one = (uint32_t)gg_dsmc_listed(pairs->one, pairs->at),
                 two = (uint32_t)gg_dsmc_listed(pairs->two, pairs->at) & ~GG_DSMC_ODD;
  if (line->to_accept && in_common(line->loaded, one, two)) return true;
  return line->to_write_back && in_common(line->accepted, one, two);
}

/* Start the first stage of the next block pair, if it is not blocked. Returns whether it was started. */
GG_INLINE bool take(gg_dsmc_features features, gg_dsmc_pass_state *state, gg_dsmc_block_pairs *pairs, pipeline *line,
                    gg_dsmc_pass *pass, gg_rng *rng)
{
  if (__builtin_expect(pairs->at == pairs->n || is_blocked(line, pairs), 0)) return false;
  const bool odd = gg_dsmc_listed(pairs->two, pairs->at) & GG_DSMC_ODD;
  if (__builtin_expect(odd, 0))
    collide_odd(features, state, pairs, pass, rng);
  else
    gg_dsmc_load(features, state, pairs, line->next);
  pairs->correction = false;
  pairs->at++;
  return !odd;
}

/* Take random words for a block pair; they are drawn for two pairs at a time. */
GG_INLINE void take_words(gg_dsmc_samples *samples, gg_dsmc_block_pair *at, gg_vu second[GG_PARTS], unsigned cycle)
{
  for (int part = 0; part < GG_PARTS; part++)
    if (cycle % 2)
      at->word[part] = second[part];
    else
      gg_dsmc_lane_two(&samples->rng, part, &at->word[part], &second[part]);
}

/* Collide all block pairs in a pipeline. Up to three pairs are in progress, each at another stage: the results of the
 * previous stage are ready, and the processor is always busy. Directions are sampled in between, a few at a time, for
 * the same reason. Arithmetic on registers of eight lanes is scarce: so constants are whole registers, and one of two
 * velocities is chosen by a masked store. */
GG_INLINE void collide_all(gg_dsmc_features features, gg_dsmc_pass_state *state, gg_dsmc_samples *samples,
                           gg_dsmc_block_pairs *pairs, gg_dsmc_pass *pass, gg_rng *rng)
{
  static const unsigned makes = 0xb6db; /* directions are sampled in eleven of sixteen cycles */
  gg_dsmc_block_pair room[3];
  pipeline line = {.next = &room[0], .loaded = &room[1], .accepted = &room[2]};
  gg_vu second[GG_PARTS] = {0};
  unsigned making = 0;
  for (unsigned cycle = 0;; cycle++) {
    if (cycle % 4 == 0) gg_dsmc_draw_ahead(features, state, samples, pairs, pass->strain_step);
    if (cycle % 16 == 0) making = gg_dsmc_directions_begin(&samples->near) ? makes : 0;
    if (pairs->at == pairs->n && !line.to_accept && !line.to_write_back) break;
    take_words(samples, line.next, second, cycle);
    const bool taken = take(features, state, pairs, &line, pass, rng);
    prefetch_pair(features, state, (uint32_t)gg_dsmc_listed(pairs->one, pairs->at + GG_DSMC_PREFETCH_AHEAD),
                  (uint32_t)gg_dsmc_listed(pairs->two, pairs->at + GG_DSMC_PREFETCH_AHEAD) & ~GG_DSMC_ODD);
    if (making >> cycle % 16 & 1) gg_dsmc_prefetch_directions(features, samples);
    if (line.to_accept) gg_dsmc_accept(features, state, samples, rng, line.loaded);
    gg_dsmc_block_pair *last = line.accepted;
    if (line.to_write_back) {
      gg_dsmc_write_back(features, state, last);
      if (__builtin_expect(last->needs_correction, 0))
        gg_dsmc_draw_correction(features, pairs, last->one, last->two, last->order, last->majorant, last->most,
                                last->strain, last->per_scale);
    }
    line.accepted = line.loaded;
    line.loaded = line.next;
    line.next = last;
    line.to_write_back = line.to_accept;
    line.to_accept = taken;
  }
}

/* Run a whole pass. `features` is a constant: each instance has only the code that it needs. */
GG_INLINE void run(gg_dsmc_features features, gg_dsmc_pass *pass, gg_dsmc_rng_lanes *lanes, gg_rng *rng)
{
  gg_dsmc_pass_state state;
  gg_real near[3 * GG_DSMC_DIRECTIONS_ROOM], sheared[3 * GG_DSMC_DIRECTIONS_ROOM];
  gg_dsmc_block_pairs pairs;
  start(features, &state, pass);
  gg_dsmc_samples samples = {.near = {.x = near}, .sheared = {.x = sheared}};
  gg_dsmc_lane_rng_load(&samples.rng, lanes);
  pairs.at = pairs.n = 1;
  pairs.left = pass->candidates;
  pairs.correction = false;
  pairs.strain = pass->strain;
  memset(pairs.one, 0, sizeof pairs.one); /* entries past the end are prefetched, too */
  memset(pairs.two, 0, sizeof pairs.two);
  prefetch_speed_bounds(pass->one, pass->blocks[0]);
  prefetch_speed_bounds(pass->two, pass->blocks[1]);
  collide_all(features, &state, &samples, &pairs, pass, rng);
  pass->bound_scale = state.scale;
  finish(features, &state, pass);
  gg_dsmc_lane_rng_save(&samples.rng, lanes);
}

/* Instances: shear and sums, for one or two species. No scene needs other combinations (gg_dsmc_features_of). */
#define EACH_SAME(X, shear, sums) X(shear, sums, 0) X(shear, sums, 1)
#define EACH(X)                                                                                                        \
  EACH_SAME(X, GG_DSMC_UNSHEARED, GG_DSMC_LOSS)                                                                        \
  EACH_SAME(X, GG_DSMC_UNSHEARED, GG_DSMC_STRESS)                                                                      \
  EACH_SAME(X, GG_DSMC_SHEARED_DILUTE, GG_DSMC_LOSS)                                                                   \
  EACH_SAME(X, GG_DSMC_SHEARED_DENSE, GG_DSMC_STRESS)

#define INSTANCE(shear, sums, same)                                                                                    \
  static void run_##shear##_##sums##_##same(gg_dsmc_pass *pass, gg_dsmc_rng_lanes *lanes, gg_rng *rng)                 \
  {                                                                                                                    \
    run((gg_dsmc_features){GG_RULE, shear, sums, same, GG_OWN}, pass, lanes, rng);                                     \
  }
EACH(INSTANCE)

#define ENTRY(shear, sums, same) [shear][sums][same] = run_##shear##_##sums##_##same,
const gg_dsmc_instances GG_INSTANCES = {.of = {EACH(ENTRY)}};
