/* Collisions in rounds of meetings between segments (segments.h).
 *
 * All pairs of species take their turns within a meeting, so that a round is worth calling others for. Where nothing
 * comes between the two halves of a step, each round has both, the second in reverse order. */
#include "dsmc/dsmc.h"

/* Candidates that a turn within a meeting should have, on average: enough that to begin one and to wait for who is last
 * hardly matter, few enough that segments that differ mix as one pair after another would (4000 cost less still, but
 * segments of different temperatures then mix by fits and starts). */
static const double worth_a_turn = 1200;
/* Candidates of a round that others are called for. */
static const double worth_calling = 400;

enum { MOST_TURNS = 2 * GG_PAIRS };

/* What one pair of species has in common in all meetings. */
typedef struct gg_side {
  int i, j;
  gg_path path;
  gg_features f;
  double rate; /* candidates per unit of gg_block_candidates, in one turn */
  gg_pairing common;
} gg_side;

/* A pair of species over a part of the round. */
typedef struct gg_turn {
  int pair;
  double drift; /* where it begins */
} gg_turn;

typedef struct gg_round {
  gg_dsmc *d;
  int number, n_turns;
  gg_turn turn[MOST_TURNS];
  double span; /* of a turn's drift */
  gg_side side[GG_PAIRS];
  double unit[GG_MOST_SEGMENTS];              /* of the tops, after each meeting */
  gg_pairing sum[GG_MOST_SEGMENTS][GG_PAIRS]; /* handed back by each */
} gg_round;

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

/* Blocks of segment `one` of the first species against those of `two` of the second. */
static void collide(gg_round *r, int meeting, const gg_turn *turn, int one, int two, gg_ensemble *tops, gg_rng *rng)
{
  const gg_side *s = &r->side[turn->pair];
  gg_tournament *t = r->d->tournament;
  const int segments = r->d->ensemble.segments;
  gg_pairing p = s->common;
  p.blocks[0] = gg_segment(p.one, segments, one);
  p.blocks[1] = gg_segment(p.two, segments, two);
  double mean = s->rate * gg_block_candidates(p.blocks[0], p.blocks[1], s->f.same && one == two);
  p.candidates = candidates(s, &t->owed[turn->pair][one][two], mean, rng);
  p.drift_step = p.candidates ? r->span / (double)p.candidates : 0;
  p.drift = turn->drift + 0.5 * p.drift_step;
  gg_ensemble_drift_tops(tops, turn->drift);
  p.top_unit = tops->top_unit;
  gg_collide(s->path, s->f, &p, &t->lanes[meeting], rng);
  tops->top_unit = fmax(p.top_unit, tops->top_unit * gg_top_growth(r->span));
  tops->top_drift = turn->drift + r->span;
  add(&r->sum[meeting][turn->pair], &p);
}

static void meet(void *context, int meeting)
{
  gg_round *r = context;
  gg_rng rng = r->d->tournament->draws[meeting];
  gg_ensemble tops = r->d->ensemble; /* its tops alone: where this meeting has them */
  int one, two;
  gg_meeting_of(r->d->ensemble.segments, r->number, meeting, &one, &two);
  for (int k = 0; k < r->n_turns; k++) {
    const gg_turn *turn = &r->turn[k];
    collide(r, meeting, turn, one, two, &tops, &rng);
    if (one != two && !r->side[turn->pair].f.same) collide(r, meeting, turn, two, one, &tops, &rng);
  }
  r->unit[meeting] = tops.top_unit;
  r->d->tournament->draws[meeting] = rng;
}

static bool takes_part(const gg_round *r, int pair)
{
  return r->side[pair].common.one != NULL;
}

/* Play all meetings; sums by pair of species. */
static void play(gg_round *r, double expected, gg_pairing sum[GG_PAIRS])
{
  gg_ensemble *e = &r->d->ensemble;
  const int meetings = gg_meetings(e->segments, r->number);
  for (int q = 0; q < GG_PAIRS; q++) {
    sum[q] = r->side[q].common;
    for (int m = 0; m < meetings && takes_part(r, q); m++) r->sum[m][q] = (gg_pairing){0};
  }
  gg_ensemble_drift_tops(e, r->turn[0].drift);
  gg_crew_share(expected < worth_calling ? NULL : e->crew, meetings, meet, r);
  for (int m = 0; m < meetings; m++) {
    for (int q = 0; q < GG_PAIRS; q++)
      if (takes_part(r, q)) add(&sum[q], &r->sum[m][q]);
    e->top_unit = fmax(e->top_unit, r->unit[m]); /* bounds in some unit hold in a larger one, too */
  }
  e->top_drift = r->turn[r->n_turns - 1].drift + r->span;
}

/* What goes over the top in this round (see collide_pair in collisions.c): one pair of species alone, in turns of the
 * round's. */
static void play_layers(gg_round *r, int pair, double top, double worst)
{
  if (worst <= top) return; /* as a rule */
  gg_dsmc *d = r->d;
  gg_side *s = &r->side[pair];
  gg_round over = *r;
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
    play(&over, worth_calling, sum);
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

/* One round; `time` is that of a turn. Bounds are what they are now. */
static void play_round(gg_round *r, double time, double expected)
{
  gg_dsmc *d = r->d;
  gg_pairing sum[GG_PAIRS];
  r->number = gg_next_round(d->tournament, d->ensemble.segments);
  for (int k = 0; k < r->n_turns; k++) {
    gg_side *s = &r->side[r->turn[k].pair];
    s->common.bound = gg_majorant_bound(&d->now.majorant[r->turn[k].pair], sqrt(d->now.temperature));
    s->rate = gg_dsmc_cross_section(d, s->i, s->j) * time * s->common.bound * d->ensemble.segments;
  }
  play(r, expected, sum);
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
  const int halves = order == GG_TURNS_THERE_AND_BACK ? 2 : 1, segments = d->ensemble.segments;
  const int n = d->model.n_species == 1 ? 1 : GG_PAIRS, calls = halves * (n == 1 ? 1 : 4);
  gg_round r = {.d = d, .n_turns = halves * n};
  double expected = 0;
  for (int q = 0; q < n; q++) {
    const int *ij = gg_turns[q];
    r.side[q] = side_of(d, ij[0], ij[1]);
    expected += expected_of(d, &r.side[q], dt);
  }
  int rounds = (int)fmax(1, fmin(expected / (0.5 * segments * worth_a_turn * calls), segments));
  r.span = span / (halves * rounds);
  for (int k = 0; k < rounds; k++) {
    for (int h = 0; h < halves; h++)
      for (int q = 0; q < n; q++) {
        bool back = order == GG_TURNS_BACK || h == 1;
        r.turn[h * n + q] = (gg_turn){back ? n - 1 - q : q, drift + (k * halves + h) * r.span};
      }
    play_round(&r, dt / (halves * rounds), expected / rounds);
  }
}
