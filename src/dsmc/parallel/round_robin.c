/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Collisions of an ensemble in segments, by rounds of a round-robin schedule (schedule.h).
 *
 * Several rounds have the same majorants, as many as the thread pool can run at once: a thread that has finished a pair
 * of segments begins a pair of the next round, if its segments are free, while other threads still work. A barrier
 * after each round would cost two threads some 3 % of their time.
 *
 * All pairs of species have their substeps (splitting.h) within a pair of segments, so that a round has enough work for
 * several threads. */
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "base/thread_pool.h"
#include "dsmc/dsmc.h"

/* Mean number of candidates of a pair of segments, for one species and for several, whose substeps divide it: large
 * enough that the start of a substep hardly matters, small enough that segments of different temperature mix as fast as
 * single pairs would. (4000 for one species are faster still, but such segments then mix unevenly.) */
static const double worth_one_species = 1200, worth_mixture = 2400;
/* Candidates for each of their blocks; with 80 000 grains this is the number above. With more grains a block that was
 * loaded into the cache takes part in two on average before the next pair of segments evicts it. */
static const double worth_a_block = 0.48;
/* Fewest candidates of a round for several threads. */
static const double worth_waking = 400;

/* Constants of one pair of species in all pairs of segments. */
typedef struct species_pair {
  int i, j;
  gg_dsmc_path path;
  gg_dsmc_features features;
  double rate; /* candidates per unit of gg_dsmc_block_pairs_per_unit, in a sweep */
  gg_dsmc_pass common;
} species_pair;

/* Scale of the speed bounds of a segment, and the range of strains over which it is valid. */
typedef struct speed_bounds {
  double scale, strain, width;
} speed_bounds;

/* Rounds with the same majorants. Threads run pairs of segments of different rounds at once: so everything that is
 * carried over belongs to a segment, here and in gg_dsmc_schedule. */
typedef struct rounds {
  gg_dsmc *d;
  int n, number[GG_MOST_PARTS], grouping[GG_MOST_PARTS];
  int n_substeps;
  const gg_dsmc_substep *substep;
  double strain, each; /* strain at the beginning of the first round; strain of one round */
  double span, hold;   /* strain of a sweep; gg_dsmc_strains_to_hold */
  int pairs;           /* of species */
  species_pair *species;
  speed_bounds bounds[GG_DSMC_MAX_SEGMENTS];
  gg_dsmc_pass *sum; /* results: `pairs` for each segment that is the first one of a pair, then their totals */
} rounds;

/* Memory for rounds, and for their corrections, which depends on the number of species. */
struct gg_dsmc_rounds_room {
  species_pair *species[2];
  gg_dsmc_pass *sum[2];
};

gg_dsmc_rounds_room *gg_dsmc_rounds_room_new(int n_species, int segments, gg_error *err)
{
  const size_t pairs = (size_t)gg_pairs_of(n_species), sums = pairs * ((size_t)segments + 1);
  gg_dsmc_rounds_room *room = gg_base_array_new(1, sizeof *room, err);
  if (!room) return NULL;
  for (int k = 0; k < 2; k++) {
    room->species[k] = gg_base_array_new(pairs, sizeof *room->species[k], err);
    room->sum[k] = gg_base_array_new(sums, sizeof *room->sum[k], err);
    if (room->species[k] && room->sum[k]) continue;
    gg_dsmc_rounds_room_free(room);
    return NULL;
  }
  return room;
}

void gg_dsmc_rounds_room_free(gg_dsmc_rounds_room *room)
{
  for (int k = 0; room && k < 2; k++) {
    free(room->species[k]);
    free(room->sum[k]);
  }
  free(room);
}

/* Sums of a segment; the totals are behind the last segment. */
static gg_dsmc_pass *sums_of(const rounds *r, int segment)
{
  return r->sum + (size_t)segment * (size_t)r->pairs;
}

/* Add the results of a pass. */
static void add(gg_dsmc_pass *sum, const gg_dsmc_pass *pass)
{
  sum->tried += pass->tried;
  sum->collisions += pass->collisions;
  sum->overflows += pass->overflows;
  sum->clamped += pass->clamped;
  sum->largest = fmax(sum->largest, pass->largest);
  sum->loss += pass->loss;
  sum->given += pass->given;
  for (int a = 0; a < 3; a++)
    for (int b = 0; b < 3; b++) sum->stress[a][b] += pass->stress[a][b];
}

/* A pair of segments whose blocks collide. */
typedef struct segment_pair {
  int first;               /* segment whose random streams are used */
  gg_dsmc_ensemble bounds; /* scale and strain of their speed bounds */
  gg_rng rng;
} segment_pair;

/* Run a substep of a pair of segments: blocks of the first species in `one` collide with blocks of the second in `two`,
 * from `strain`. */
static void collide(rounds *r, const gg_dsmc_substep *substep, double strain, int one, int two, segment_pair *at)
{
  const species_pair *s = &r->species[substep->pair];
  const double span = substep->length * r->span;
  gg_dsmc_schedule *schedule = r->d->schedule;
  const int segments = r->d->ensemble.segments, pair = gg_pair(s->i, s->j);
  gg_dsmc_pass pass = s->common;
  pass.blocks[0] = gg_dsmc_segment(pass.one, segments, one);
  pass.blocks[1] = gg_dsmc_segment(pass.two, segments, two);
  double mean = substep->length * s->rate *
                gg_dsmc_block_pairs_per_unit(pass.blocks[0], pass.blocks[1], s->features.same && one == two);
  pass.candidates = gg_dsmc_candidates(s->common.floor > 0, mean, &schedule->remainder[pair][one][two], &at->rng);
  pass.strain_step = pass.candidates ? span / (double)pass.candidates : 0;
  pass.strain = strain + 0.5 * pass.strain_step;
  gg_dsmc_ensemble_strain_bounds(&at->bounds, span < 0 ? strain - r->hold : strain, r->hold);
  pass.bound_scale = at->bounds.bound_scale;
  if (r->hold > 0) pass.bound_margin = gg_dsmc_bound_growth(r->hold);
  gg_dsmc_collide_pass(r->d->ensemble.kernels, s->path, s->features, &pass, &schedule->lanes[at->first], &at->rng);
  if (!(r->hold > 0)) {
    at->bounds.bound_scale = fmax(pass.bound_scale, at->bounds.bound_scale * gg_dsmc_bound_growth(span));
    at->bounds.bound_strain = strain + span;
  }
  add(&sums_of(r, at->first)[pair], &pass);
}

/* Run all substeps of a pair of segments. Speed bounds are also valid with a larger scale. */
static void collide_segments(rounds *r, double strain, int one, int two)
{
  segment_pair at = {.first = one, .bounds = r->d->ensemble, .rng = r->d->schedule->rng[one]};
  at.bounds.bound_scale = fmax(r->bounds[one].scale, r->bounds[two].scale);
  at.bounds.bound_strain = r->bounds[one].strain;
  at.bounds.bound_width = r->bounds[one].width;
  for (int k = 0; k < r->n_substeps; k++) {
    const gg_dsmc_substep *substep = &r->substep[k];
    const double begin = strain + substep->begin * r->span;
    collide(r, substep, begin, one, two, &at);
    if (one != two && !r->species[substep->pair].features.same) collide(r, substep, begin, two, one, &at);
  }
  r->bounds[one] = r->bounds[two] =
      (speed_bounds){at.bounds.bound_scale, at.bounds.bound_strain, at.bounds.bound_width};
  r->d->schedule->rng[one] = at.rng;
}

/* Find the pairs of segments in a part of the rounds: one, or two if each segment is paired with itself. Returns their
 * number. */
static int pairs_of_part(const rounds *r, int part, int one[2], int two[2])
{
  const int segments = r->d->ensemble.segments, columns = segments / 2;
  const int number = r->number[part / columns], each = gg_dsmc_segment_pairs(segments, number) / columns;
  for (int m = 0; m < each; m++) {
    gg_dsmc_segment_pair(segments, number, part % columns * each + m, &one[m], &two[m]);
    if (number >= segments / 4) continue;
    one[m] = gg_dsmc_segment_in(segments, r->grouping[part / columns], one[m]);
    two[m] = gg_dsmc_segment_in(segments, r->grouping[part / columns], two[m]);
  }
  return each;
}

static void run_part(void *context, int part)
{
  rounds *r = context;
  int one[2], two[2], n = pairs_of_part(r, part, one, two);
  const int nth = part / (r->d->ensemble.segments / 2);
  for (int m = 0; m < n; m++) collide_segments(r, r->strain + nth * r->each, one[m], two[m]);
}

/* Find the earlier parts that must be finished before each part, because they use its segments. */
static void find_needs(const rounds *r, int parts, uint32_t need[GG_MOST_PARTS])
{
  uint32_t last[GG_DSMC_MAX_SEGMENTS] = {0};
  for (int part = 0; part < parts; part++) {
    int one[2], two[2], n = pairs_of_part(r, part, one, two);
    need[part] = 0;
    for (int m = 0; m < n; m++) {
      need[part] |= last[one[m]] | last[two[m]];
      last[one[m]] = last[two[m]] = UINT32_C(1) << part;
    }
  }
}

/* Run all rounds. Returns the totals by pair of species. */
static const gg_dsmc_pass *run(rounds *r, double expected)
{
  gg_dsmc_ensemble *e = &r->d->ensemble;
  const int columns = e->segments / 2;
  uint32_t need[GG_MOST_PARTS];
  find_needs(r, r->n * columns, need);
  gg_dsmc_ensemble_strain_bounds(e, r->strain + r->substep[0].begin * r->span - (r->span < 0 ? r->hold : 0), r->hold);
  for (int s = 0; s < e->segments; s++) {
    r->bounds[s] = (speed_bounds){e->bound_scale, e->bound_strain, e->bound_width};
    for (int q = 0; q < r->pairs; q++) sums_of(r, s)[q] = (gg_dsmc_pass){0};
  }
  gg_base_thread_pool_rounds(expected < worth_waking * r->n ? NULL : e->pool, r->n, columns, need, run_part, r);
  gg_dsmc_pass *sum = sums_of(r, e->segments);
  for (int q = 0; q < r->pairs; q++) {
    sum[q] = r->species[q].common;
    for (int s = 0; s < e->segments; s++) add(&sum[q], &sums_of(r, s)[q]);
  }
  for (int s = 0; s < e->segments; s++) e->bound_scale = fmax(e->bound_scale, r->bounds[s].scale);
  e->bound_strain = r->bounds[0].strain;
  e->bound_width = r->bounds[0].width;
  return sum;
}

/* Run correction passes for the majorant overflows of these rounds (as in collision_loop.c), for one pair of species in
 * its own substeps. */
static void correct_overflows(rounds *r, int pair, double majorant, double largest)
{
  if (largest <= majorant) return; /* usually */
  gg_dsmc *d = r->d;
  species_pair *s = &r->species[pair];
  rounds correction = *r;
  gg_dsmc_substep substep[GG_DSMC_MAX_SWEEPS];
  correction.substep = substep;
  correction.species = d->rounds->species[1];
  correction.sum = d->rounds->sum[1];
  correction.n_substeps = 0;
  memcpy(correction.species, r->species, (size_t)r->pairs * sizeof *r->species);
  for (int k = 0; k < r->n_substeps; k++)
    if (r->substep[k].pair == pair) substep[correction.n_substeps++] = r->substep[k];
  for (double floor = majorant; largest > floor;) {
    double layer =
        fmax(1.1 * largest, gg_dsmc_sure_majorant(s->path, s->features, 2 * d->now.fastest, s->common.shift)) - floor;
    species_pair *layer_pair = &correction.species[pair];
    layer_pair->common.floor = floor;
    layer_pair->common.majorant = layer;
    layer_pair->rate = s->rate / s->common.majorant * layer;
    const gg_dsmc_pass *sum = run(&correction, worth_waking * correction.n) + pair;
    gg_dsmc_add_pass(d, pair, sum);
    gg_dsmc_majorant_learn(&d->now.majorant[pair], sum->largest, sqrt(d->now.temperature), sum->tried,
                           gg_dsmc_window(d, s->i, s->j));
    largest = sum->largest;
    floor += layer;
  }
}

static species_pair species_pair_of(gg_dsmc *d, int i, int j)
{
  const int pair = gg_pair(i, j);
  species_pair s = {.i = i, .j = j, .path = d->path[pair], .features = gg_dsmc_features_of(d, i, j)};
  s.common = gg_dsmc_pass_of(d, i, j);
  return s;
}

/* Take the numbers of the next rounds. Rounds in which quarters are paired within themselves keep the present grouping.
 */
static void next_rounds(rounds *r)
{
  gg_dsmc_ensemble *e = &r->d->ensemble;
  for (int k = 0; k < r->n; k++) {
    r->number[k] = gg_dsmc_next_round(r->d->schedule, e->segments);
    const int c = r->number[k] / (e->segments / 4);
    r->grouping[k] = e->grouping;
    if (c) e->grouping = c;
  }
}

/* Run some rounds with the present majorants. `time`: of a sweep; `expected`: candidates of each round. */
static void run_rounds(rounds *r, double time, double expected)
{
  gg_dsmc *d = r->d;
  next_rounds(r);
  for (int k = 0; k < r->n_substeps; k++) {
    species_pair *s = &r->species[r->substep[k].pair];
    s->common.majorant = gg_dsmc_majorant_at(&d->now.majorant[r->substep[k].pair], sqrt(d->now.temperature));
    s->rate = gg_dsmc_cross_section(d, s->i, s->j) * time * s->common.majorant * d->ensemble.segments;
  }
  const gg_dsmc_pass *sum = run(r, expected * r->n);
  for (int q = 0; q < r->pairs; q++) {
    if (!sum[q].tried) continue;
    gg_dsmc_add_pass(d, q, &sum[q]);
    gg_dsmc_majorant_learn(&d->now.majorant[q], sum[q].largest, sqrt(d->now.temperature), sum[q].tried,
                           gg_dsmc_window(d, r->species[q].i, r->species[q].j));
    correct_overflows(r, q, r->species[q].common.majorant, sum[q].largest);
  }
}

/* Expected number of candidates of a pair of species. */
static double expected_of(const gg_dsmc *d, const species_pair *s, double time)
{
  double majorant = gg_dsmc_majorant_at(&d->now.majorant[gg_pair(s->i, s->j)], sqrt(d->now.temperature));
  return gg_dsmc_cross_section(d, s->i, s->j) * time * majorant *
         gg_dsmc_candidates_per_unit(s->path, s->features, s->common.one, s->common.two);
}

/* Number of candidates that a round should have. */
static double worth_a_round(const gg_dsmc *d)
{
  const int segments = d->ensemble.segments;
  size_t blocks = 0;
  for (int i = 0; i < d->model.n_species; i++) blocks += d->ensemble.of[i].n_blocks;
  const double least = d->model.n_species == 1 ? worth_one_species : worth_mixture;
  return 0.5 * segments * fmax(least, worth_a_block * 2 * (double)blocks / segments);
}

void gg_dsmc_collide_segments(gg_dsmc *d, double dt, double strain, double span, gg_dsmc_splitting splitting)
{
  const int segments = d->ensemble.segments, pairs = gg_pairs_of(d->model.n_species);
  const int together = GG_MOST_PARTS / (segments / 2);
  gg_dsmc_substep substep[GG_DSMC_MAX_SUBSTEPS];
  rounds r = {.d = d, .pairs = pairs, .substep = substep, .species = d->rounds->species[0], .sum = d->rounds->sum[0]};
  double expected = 0;
  for (int q = 0; q < pairs; q++) {
    const gg_species_pair s = gg_common_pair_species(q);
    r.species[q] = species_pair_of(d, s.i, s.j);
    expected += expected_of(d, &r.species[q], dt);
  }
  const int n_rounds = (int)fmax(1, fmin(expected / worth_a_round(d), segments));
  const int sweeps = gg_dsmc_sweeps_of_part(&d->now.step, splitting, dt, n_rounds);
  r.n_substeps = gg_dsmc_list_substeps(pairs, splitting, sweeps, substep);
  r.each = span / n_rounds;
  r.span = r.each / sweeps;
  r.hold = gg_dsmc_strains_to_hold(d->model.n_species, r.span);
  for (int done = 0; done < n_rounds; done += r.n) {
    r.strain = strain + done * r.each;
    r.n = n_rounds - done < together ? n_rounds - done : together;
    run_rounds(&r, dt / (sweeps * n_rounds), expected / n_rounds);
  }
}
