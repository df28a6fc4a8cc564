#include "md/kicks.h"

#include <math.h>
#include <stdlib.h>

#include "base/memory.h"

/* What the noise brings a grain from turn to turn, of T: at most this, but turns come no more often than every so many
 * mean free times, where it is up to 9 % (e = 0). */
#define SHARE_OF_T 0.02
#define LEAST_INTERVAL 0.27

/* Turns that have a kick, five of eight. Three of five would give kicks of fixed length the second and fourth moment of
 * a Gaussian. But since its last collision a grain has had a turn more or less, which widens the distribution of
 * velocities: a2 would be (x^2)/6 larger, x being that share of T. What five of eight leave of the fourth moment makes
 * up for that at LEAST_INTERVAL, where it is seen: 1/25 less in each turn, which lasts for about a mean free time. */
enum { KICKED = 5, OUT_OF = 8 };

/* Turns ahead that grains are on their way to the cache. */
enum { AHEAD = 4, CACHED = 6000 };

/* Of more grains than the cache holds, so many that follow each other in memory have turns one after the other. */
enum { GROUP = 32 };

static uint32_t greatest_common_divisor(uint32_t a, uint32_t b)
{
  return b ? greatest_common_divisor(b, a % b) : a;
}

/* Turns go round in steps of the golden ratio: grains, or groups, that are near in memory, and so in space, have turns
 * far apart. */
static uint32_t golden_step(uint32_t n)
{
  uint32_t step = (uint32_t)(0.6180339887498949 * n) + (n == 1);
  while (greatest_common_divisor(step, n) != 1) step++;
  return step;
}

static double interval_of(const gg_md *e, int species)
{
  const gg_model *m = &e->model;
  const double least = LEAST_INTERVAL / gg_common_model_collision_rate(m, m->temperature0);
  return fmax(least, SHARE_OF_T * m->temperature0 / (m->mass[species] * e->noise));
}

gg_status gg_md_kicks_make(gg_md *e, gg_error *err)
{
  if (e->thermostat != GG_WHITE_NOISE) return GG_OK;
  uint32_t end[GG_MAX_SPECIES], before = 0;
  for (int s = 0; s < e->model.n_species; s++) {
    gg_md_turns *t = &e->kicks.of[s];
    *t = (gg_md_turns){.first = before, .n = (uint32_t)e->model.n_of[s]};
    t->group = e->n > CACHED && t->n > GROUP ? GROUP : 1;
    t->step = golden_step(t->n / t->group);
    const double interval = interval_of(e, s);
    t->apart = 2 * interval / t->n;
    t->size = e->noise > 0 ? sqrt(3 * e->noise * interval * OUT_OF / KICKED) : 0;
    end[s] = before;
    before += t->n;
  }
  free(e->kicks.order);
  e->kicks.order = NULL;
  if (e->model.n_species == 1) return GG_OK;
  e->kicks.order = gg_base_array_new(e->n, sizeof *e->kicks.order, err);
  if (!e->kicks.order) return GG_FAILED;
  for (uint32_t i = 0; i < e->n; i++) e->kicks.order[end[e->grain[i].species]++] = i;
  return GG_OK;
}

static int due(const gg_md *e)
{
  int first = 0;
  for (int s = 1; s < e->model.n_species; s++)
    if (e->k.turn[s].at < e->k.turn[first].at) first = s;
  return first;
}

void gg_md_kicks_begin(gg_md *e)
{
  e->k.next_kick = INFINITY;
  if (e->thermostat != GG_WHITE_NOISE) return;
  for (int s = 0; s < e->model.n_species; s++) e->k.turn[s] = (gg_md_turn){.at = 0.5 * e->kicks.of[s].apart};
  e->k.next_kick = e->k.turn[due(e)].at;
}

void gg_md_kicks_move(gg_md *e, double span)
{
  e->k.next_kick -= span;
  for (int s = 0; s < e->model.n_species; s++) e->k.turn[s].at -= span;
}

static uint32_t at_place(const gg_md *e, const gg_md_turns *t, uint64_t place)
{
  const uint64_t groups = t->n / t->group, k = place / t->group;
  const uint64_t there = k < groups ? k * t->step % groups * t->group + place % t->group : place;
  const uint32_t i = t->first + (uint32_t)there;
  return e->kicks.order ? e->kicks.order[i] : i;
}

/* The pair of a turn. Of an even number one half meets the other, one place further every time round; of an odd number
 * all go round, and the pair is half of them apart. */
static void pair_of(const gg_md *e, const gg_md_turns *t, uint64_t turn, uint32_t pair[2])
{
  const uint64_t half = t->n / 2, at = turn % (t->n % 2 ? t->n : half);
  pair[0] = at_place(e, t, at);
  pair[1] = at_place(e, t, t->n % 2 ? (at + half) % t->n : half + (at + turn / half) % half);
}

static void kick(gg_md *e, uint32_t i, double size, gg_vec direction)
{
  gg_md_grain *g = &e->grain[i];
  g->r = gg_md_position(e, false, g, e->k.now);
  g->t = e->k.now;
  g->v = gg_axpy(size, direction, g->v);
  g->counter++;
}

static void kick_pair(gg_md *e, const gg_md_turns *t, uint64_t turn, gg_vec direction)
{
  uint32_t pair[2];
  pair_of(e, t, turn, pair);
  kick(e, pair[0], t->size, direction);
  kick(e, pair[1], -t->size, direction);
  for (int k = 0; k < 2; k++) e->kernel->predict(e, pair[k], pair[k] + 1);
}

static void prefetch(const gg_md *e, const gg_md_turns *t, uint64_t turn)
{
  uint32_t pair[2];
  pair_of(e, t, turn, pair);
  for (int k = 0; k < 2; k++) {
    __builtin_prefetch(&e->grain[pair[k]]);
    __builtin_prefetch(&e->node[pair[k]]);
  }
}

/* No two turns are alike far apart: no sampling keeps in step with those of a few grains. */
void gg_md_kick(gg_md *e)
{
  const int s = due(e);
  const gg_md_turns *t = &e->kicks.of[s];
  gg_md_turn *turn = &e->k.turn[s];
  if (gg_rng_below(&e->k.rng, OUT_OF) < KICKED) {
    e->k.events++;
    kick_pair(e, t, turn->number, gg_rng_direction(&e->k.rng));
  }
  turn->at += t->apart * (0.5 + gg_rng_uniform(&e->k.rng));
  turn->number++;
  if (e->n > CACHED) prefetch(e, t, turn->number + AHEAD);
  e->k.next_kick = e->k.turn[due(e)].at;
}
