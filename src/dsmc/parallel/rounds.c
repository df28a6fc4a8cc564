/* Collisions in rounds of meetings between segments (segments.h).
 *
 * Rounds are played under the same bounds, as many at once as a crew takes: whoever has done with a meeting begins one
 * of the next round, if its segments are free, while others are still at theirs. To wait for all of them after each
 * round cost two threads some three hundredths of their time.
 *
 * All pairs of species take their turns within a meeting (turns.h), so that a round is worth calling others for. */
#include "dsmc/dsmc.h"

/* Candidates that a meeting should have, on average, of one species and of two, whose turns are parts of it: enough
 * that to begin a turn hardly matters, few enough that segments that differ mix as one pair after another would (4000
 * of one species cost less still, but segments of different temperatures then mix by fits and starts). */
static const double worth_a_meeting[] = {1200, 2400};
/* Candidates of a round that others are called for. */
static const double worth_calling = 400;

/* What one pair of species has in common in all meetings. */
typedef struct gg_side {
  int i, j;
  gg_path path;
  gg_features f;
  double rate; /* candidates per unit of gg_block_candidates, in a sweep */
  gg_pairing common;
} gg_side;

/* The unit of a segment's tops, and the drift at which they hold. */
typedef struct gg_tops {
  double unit, drift;
} gg_tops;

/* Rounds under the same bounds. Whoever has done with a meeting goes on to any of the next round whose two segments are
 * free: so all that changes from meeting to meeting belongs to a segment, here and in gg_tournament. */
typedef struct gg_rounds {
  gg_dsmc *d;
  int n, number[GG_MOST_PARTS], halves[GG_MOST_PARTS];
  int n_turns;
  gg_turn turn[GG_MOST_TURNS];
  double drift, each; /* where the first begins; how far one goes */
  double span;        /* of a sweep's drift */
  gg_side side[GG_PAIRS];
  gg_tops tops[GG_MOST_SEGMENTS];
  gg_pairing sum[GG_MOST_SEGMENTS][GG_PAIRS]; /* handed back, by the first segment of each meeting */
} gg_rounds;

/* Add what `p` hands back. */
static void add(gg_pairing *sum, const gg_pairing *p)
{
  sum->tried += p->tried;
  sum->collisions += p->collisions;
  sum->overflows += p->overflows;
  sum->worst = fmax(sum->worst, p->worst);
  sum->loss += p->loss;
  for (int a = 0; a < 3; a++)
    for (int b = 0; b < 3; b++) sum->stress[a][b] += p->stress[a][b];
}

/* See `candidates` in collisions.c: the same for two segments. */
static uint64_t candidates(const gg_side *s, double *owed, double mean, gg_rng *rng)
{
  if (s->common.floor > 0) return gg_rng_poisson(rng, mean);
  double due = *owed + mean, whole = floor(due);
  *owed = due - whole;
  return (uint64_t)whole;
}

/* Two segments that meet, where they stand. */
typedef struct gg_pair_met {
  int first;        /* the one whose streams they use */
  gg_ensemble tops; /* its tops alone: where this meeting has them */
  gg_rng rng;
} gg_pair_met;

/* A turn in the meeting of these segments: blocks of `one` of the first species against those of `two` of the second,
 * from `drift` on. */
static void collide(gg_rounds *r, const gg_turn *turn, double drift, int one, int two, gg_pair_met *at)
{
  const gg_side *s = &r->side[turn->pair];
  const double span = turn->length * r->span;
  gg_tournament *t = r->d->tournament;
  const int segments = r->d->ensemble.segments, pair = gg_pair_index(s->i, s->j);
  gg_pairing p = s->common;
  p.blocks[0] = gg_segment(p.one, segments, one);
  p.blocks[1] = gg_segment(p.two, segments, two);
  double mean = turn->length * s->rate * gg_block_candidates(p.blocks[0], p.blocks[1], s->f.same && one == two);
  p.candidates = candidates(s, &t->owed[pair][one][two], mean, &at->rng);
  p.drift_step = p.candidates ? span / (double)p.candidates : 0;
  p.drift = drift + 0.5 * p.drift_step;
  gg_ensemble_drift_tops(&at->tops, drift);
  p.top_unit = at->tops.top_unit;
  gg_collide(r->d->ensemble.kernels, s->path, s->f, &p, &t->lanes[at->first], &at->rng);
  at->tops.top_unit = fmax(p.top_unit, at->tops.top_unit * gg_top_growth(span));
  at->tops.top_drift = drift + span;
  add(&r->sum[at->first][pair], &p);
}

/* Bounds in some unit hold in a larger one, too. */
static void meet(gg_rounds *r, double drift, int one, int two)
{
  gg_pair_met at = {.first = one, .tops = r->d->ensemble, .rng = r->d->tournament->draws[one]};
  at.tops.top_unit = fmax(r->tops[one].unit, r->tops[two].unit);
  at.tops.top_drift = r->tops[one].drift;
  for (int k = 0; k < r->n_turns; k++) {
    const gg_turn *turn = &r->turn[k];
    const double begin = drift + turn->begin * r->span;
    collide(r, turn, begin, one, two, &at);
    if (one != two && !r->side[turn->pair].f.same) collide(r, turn, begin, two, one, &at);
  }
  r->tops[one] = r->tops[two] = (gg_tops){at.tops.top_unit, at.tops.top_drift};
  r->d->tournament->draws[one] = at.rng;
}

/* Who meets in a part of the rounds; where each meets itself, two of them. Returns how many meetings. */
static int meetings_of(const gg_rounds *r, int part, int one[2], int two[2])
{
  const int segments = r->d->ensemble.segments, columns = segments / 2;
  const int number = r->number[part / columns], each = gg_meetings(segments, number) / columns;
  for (int m = 0; m < each; m++) {
    gg_meeting_of(segments, number, part % columns * each + m, &one[m], &two[m]);
    if (number >= segments / 4) continue;
    one[m] = gg_segment_in(segments, r->halves[part / columns], one[m]);
    two[m] = gg_segment_in(segments, r->halves[part / columns], two[m]);
  }
  return each;
}

static void play_part(void *context, int part)
{
  gg_rounds *r = context;
  int one[2], two[2], n = meetings_of(r, part, one, two);
  const int nth = part / (r->d->ensemble.segments / 2);
  for (int m = 0; m < n; m++) meet(r, r->drift + nth * r->each, one[m], two[m]);
}

/* Each part waits for those that have had its segments before. */
static void find_needs(const gg_rounds *r, int parts, uint32_t need[GG_MOST_PARTS])
{
  uint32_t last[GG_MOST_SEGMENTS] = {0};
  for (int part = 0; part < parts; part++) {
    int one[2], two[2], n = meetings_of(r, part, one, two);
    need[part] = 0;
    for (int m = 0; m < n; m++) {
      need[part] |= last[one[m]] | last[two[m]];
      last[one[m]] = last[two[m]] = UINT32_C(1) << part;
    }
  }
}

static bool takes_part(const gg_rounds *r, int pair)
{
  return r->side[pair].common.one != NULL;
}

/* Play all meetings; sums by pair of species. */
static void play(gg_rounds *r, double expected, gg_pairing sum[GG_PAIRS])
{
  gg_ensemble *e = &r->d->ensemble;
  const int columns = e->segments / 2;
  uint32_t need[GG_MOST_PARTS];
  find_needs(r, r->n * columns, need);
  gg_ensemble_drift_tops(e, r->drift + r->turn[0].begin * r->span);
  for (int s = 0; s < e->segments; s++) {
    r->tops[s] = (gg_tops){e->top_unit, e->top_drift};
    for (int q = 0; q < GG_PAIRS; q++) r->sum[s][q] = (gg_pairing){0};
  }
  gg_crew_share_rounds(expected < worth_calling * r->n ? NULL : e->crew, r->n, columns, need, play_part, r);
  for (int q = 0; q < GG_PAIRS; q++) {
    sum[q] = r->side[q].common;
    for (int s = 0; s < e->segments && takes_part(r, q); s++) add(&sum[q], &r->sum[s][q]);
  }
  for (int s = 0; s < e->segments; s++) e->top_unit = fmax(e->top_unit, r->tops[s].unit);
  e->top_drift = r->tops[0].drift;
}

/* What goes over the top in these rounds (see collide_pair in collisions.c): one pair of species alone, in turns of the
 * rounds'. */
static void play_layers(gg_rounds *r, int pair, double top, double worst)
{
  if (worst <= top) return; /* as a rule */
  gg_dsmc *d = r->d;
  gg_side *s = &r->side[pair];
  gg_rounds over = *r;
  over.n_turns = 0;
  for (int k = 0; k < r->n_turns; k++)
    if (r->turn[k].pair == pair) over.turn[over.n_turns++] = r->turn[k];
  for (double base = top; worst > base;) {
    gg_pairing sum[GG_PAIRS];
    double bound = fmax(1.1 * worst, gg_rate_bound(s->path, s->f, 2 * d->now.fastest, s->common.shift)) - base;
    gg_side *above = &over.side[pair];
    above->common.floor = base;
    above->common.bound = bound;
    above->rate = s->rate / s->common.bound * bound;
    play(&over, worth_calling * over.n, sum);
    gg_dsmc_hand_over(d, pair, &sum[pair]);
    gg_majorant_learn(&d->now.majorant[pair], sum[pair].worst, sqrt(d->now.temperature), sum[pair].tried,
                      gg_dsmc_window(d, s->i, s->j));
    worst = sum[pair].worst;
    base += bound;
  }
}

static gg_side side_of(gg_dsmc *d, int i, int j)
{
  const int pair = gg_pair_index(i, j);
  gg_side s = {.i = i, .j = j, .path = d->path[pair], .f = gg_dsmc_features(d, i, j)};
  s.common = gg_dsmc_pairing(d, i, j);
  return s;
}

/* Quarters that are each for themselves stay in the halves they are in. */
static void draw_rounds(gg_rounds *r)
{
  gg_ensemble *e = &r->d->ensemble;
  for (int k = 0; k < r->n; k++) {
    r->number[k] = gg_next_round(r->d->tournament, e->segments);
    const int c = r->number[k] / (e->segments / 4);
    r->halves[k] = e->halves;
    if (c) e->halves = c;
  }
}

/* Some rounds; `time` is that of a sweep, candidates are `expected` in each. Bounds are what they are now. */
static void play_rounds(gg_rounds *r, double time, double expected)
{
  gg_dsmc *d = r->d;
  gg_pairing sum[GG_PAIRS];
  draw_rounds(r);
  for (int k = 0; k < r->n_turns; k++) {
    gg_side *s = &r->side[r->turn[k].pair];
    s->common.bound = gg_majorant_bound(&d->now.majorant[r->turn[k].pair], sqrt(d->now.temperature));
    s->rate = gg_dsmc_cross_section(d, s->i, s->j) * time * s->common.bound * d->ensemble.segments;
  }
  play(r, expected * r->n, sum);
  for (int q = 0; q < GG_PAIRS; q++) {
    if (!sum[q].tried) continue;
    gg_dsmc_hand_over(d, q, &sum[q]);
    gg_majorant_learn(&d->now.majorant[q], sum[q].worst, sqrt(d->now.temperature), sum[q].tried,
                      gg_dsmc_window(d, r->side[q].i, r->side[q].j));
    play_layers(r, q, r->side[q].common.bound, sum[q].worst);
  }
}

/* Candidates to be expected in all. */
static double expected_of(const gg_dsmc *d, const gg_side *s, double time)
{
  double bound = gg_majorant_bound(&d->now.majorant[gg_pair_index(s->i, s->j)], sqrt(d->now.temperature));
  return gg_dsmc_cross_section(d, s->i, s->j) * time * bound *
         gg_candidates(s->path, s->f, s->common.one, s->common.two);
}

void gg_dsmc_collide_in_rounds(gg_dsmc *d, double dt, double drift, double span, gg_order_of_turns order)
{
  const int segments = d->ensemble.segments, pairs = d->model.n_species == 1 ? 1 : GG_PAIRS;
  const int together = GG_MOST_PARTS / (segments / 2);
  gg_rounds r = {.d = d};
  double expected = 0;
  for (int q = 0; q < pairs; q++) {
    const int *ij = gg_species_of_pair[q];
    r.side[q] = side_of(d, ij[0], ij[1]);
    expected += expected_of(d, &r.side[q], dt);
  }
  const double worth_a_round = 0.5 * segments * worth_a_meeting[d->model.n_species - 1];
  const int rounds = (int)fmax(1, fmin(expected / worth_a_round, segments));
  const int sweeps = gg_sweeps_of_a_part(&d->now.step, order, dt, rounds);
  r.n_turns = gg_list_turns(pairs, order, sweeps, r.turn);
  r.each = span / rounds;
  r.span = r.each / sweeps;
  for (int done = 0; done < rounds; done += r.n) {
    r.drift = drift + done * r.each;
    r.n = rounds - done < together ? rounds - done : together;
    play_rounds(&r, dt / (sweeps * rounds), expected / rounds);
  }
}
