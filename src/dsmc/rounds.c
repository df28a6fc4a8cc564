/* The collisions of a pair of species in rounds of meetings between segments (segments.h). */
#include "dsmc/dsmc.h"

/* Candidates that a meeting should have, on average: enough that what it costs to begin one is no matter. */
static const double worth_a_meeting = 600;
/* Candidates that others are called for. */
static const double worth_calling = 400;

typedef struct gg_round {
  gg_dsmc *d;
  gg_path path;
  gg_features f;
  int pair, number;
  double rate; /* candidates per unit of gg_block_candidates */
  double span; /* of the drift */
  gg_pairing common, of[GG_MOST_SEGMENTS];
} gg_round;

/* See `candidates` in collisions.c: the same for a meeting. */
static uint64_t candidates(const gg_round *r, int meeting, double mean, gg_rng *rng)
{
  if (r->common.floor > 0) return gg_rng_poisson(rng, mean);
  double *owed = &r->d->tournament->of[r->pair].owed[r->number][meeting], due = *owed + mean, whole = floor(due);
  *owed = due - whole;
  return (uint64_t)whole;
}

static void meet(void *context, int meeting)
{
  gg_round *r = context;
  gg_tournament *t = r->d->tournament;
  gg_rng rng = t->draws[meeting];
  gg_pairing p = r->common;
  const int segments = r->d->ensemble.segments;
  int one, two;
  gg_meeting_of(segments, r->f.same, r->number, meeting, &one, &two);
  p.blocks[0] = gg_segment(p.one, segments, one);
  p.blocks[1] = gg_segment(p.two, segments, two);
  double weight = gg_block_candidates(p.blocks[0], p.blocks[1], r->f.same && one == two);
  p.candidates = candidates(r, meeting, r->rate * weight, &rng);
  p.drift_step = p.candidates ? r->span / (double)p.candidates : 0;
  p.drift += 0.5 * p.drift_step;
  gg_collide(r->path, r->f, &p, &t->lanes[meeting], &rng);
  t->draws[meeting] = rng;
  r->of[meeting] = p;
}

/* Play all meetings; returns what a single pairing would have handed back. */
static gg_pairing play(gg_round *r, double drift, double expected)
{
  gg_ensemble *e = &r->d->ensemble;
  const int meetings = gg_meetings(e->segments, r->f.same, r->number);
  gg_ensemble_drift_tops(e, drift);
  r->common.drift = drift;
  r->common.top_unit = e->top_unit;
  gg_crew_share(expected < worth_calling ? NULL : e->crew, meetings, meet, r);
  gg_pairing sum = r->common;
  /* A bound of speeds in some unit is one in a larger unit, too. */
  sum.top_unit *= gg_top_growth(r->span);
  for (int m = 0; m < meetings; m++) {
    const gg_pairing *p = &r->of[m];
    sum.tried += p->tried;
    sum.collisions += p->collisions;
    sum.overflows += p->overflows;
    sum.worst = fmax(sum.worst, p->worst);
    sum.top_unit = fmax(sum.top_unit, p->top_unit);
    sum.loss += p->loss;
    for (int a = 0; a < 3; a++)
      for (int b = 0; b < 3; b++) sum.stress[a][b] += p->stress[a][b];
  }
  e->top_unit = sum.top_unit;
  e->top_drift = drift + r->span;
  return sum;
}

/* One round over `dt` and all its layers (as in collisions.c). */
static void play_layers(gg_dsmc *d, gg_round *r, int i, int j, double rate, double drift)
{
  gg_majorant *majorant = &d->now.majorant[r->pair];
  double thermal = sqrt(d->now.temperature), all = gg_candidates(r->path, r->f, r->common.one, r->common.two);
  r->number = gg_next_round(d->tournament, d->ensemble.segments, r->pair);
  for (double base = 0, bound = gg_majorant_bound(majorant, thermal); bound > 0;) {
    r->common.floor = base;
    r->common.bound = bound;
    r->rate = rate * bound * d->ensemble.segments;
    gg_pairing sum = play(r, drift, rate * bound * all);
    gg_dsmc_hand_over(d, r->pair, &sum);
    gg_majorant_learn(majorant, sum.worst, thermal, sum.tried, gg_dsmc_window(d, i, j));
    base += bound;
    if (sum.worst <= base) break;
    bound = fmax(1.1 * sum.worst, gg_rate_bound(r->path, r->f, 2 * d->now.fastest, sum.shift)) - base;
  }
}

void gg_dsmc_collide_in_rounds(gg_dsmc *d, int i, int j, double dt, double drift, double span)
{
  const int pair = gg_pair_index(i, j);
  gg_round r = {.d = d, .path = d->path[pair], .f = gg_dsmc_features(d, i, j), .pair = pair};
  r.common = gg_dsmc_pairing(d, i, j);
  double rate = gg_dsmc_cross_section(d, i, j) * dt;
  double bound = gg_majorant_bound(&d->now.majorant[pair], sqrt(d->now.temperature));
  double expected = rate * bound * gg_candidates(r.path, r.f, r.common.one, r.common.two);
  double most = d->ensemble.segments, least = expected / (0.5 * most * worth_a_meeting);
  int rounds = (int)fmax(1, fmin(least, most));
  r.span = span / rounds;
  for (int k = 0; k < rounds; k++) play_layers(d, &r, i, j, rate / rounds, drift + k * r.span);
}
