/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "md/kicks.h"

#include <math.h>
#include <stdlib.h>

#include "base/memory.h"
#include "common/thermostat.h"

/* What the noise brings a grain from turn to turn, of T: at most this, but turns come no more often than every so many
 * mean free times, where it is up to 9 % (e = 0). */
#define SHARE_OF_T 0.02
#define LEAST_INTERVAL 0.27

/* A bath: the temperature is low by drag x cooling rate x interval^2/6 (see tests/md/test_bath.c), at most this; what
 * drag takes in a turn is at most so much, less under shear: stresses are off by a third of its square. */
#define BIAS_OF_BATH 2e-4
#define MOST_DRAG 0.1
#define MOST_DRAG_SHEARED 0.04

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

static double interval_in_bath(const gg_model *m, int species, double T)
{
  const double drag = fmax(fabs(m->bath.drag[species]), m->bath.spin_drag[species]);
  double mass = 0;
  for (int i = 0; i < m->n_species; i++) mass += m->mass[i] * (double)m->n_of[i] / (double)m->n;
  const double cooling = mass * gg_common_thermostat_noise(m) / m->temperature0 * sqrt(T / m->temperature0);
  const double free_time = 1 / gg_common_model_collision_rate(m, T);
  const double most = (m->shear_rate != 0 ? MOST_DRAG_SHEARED : MOST_DRAG) / drag;
  return fmin(fmin(free_time, most), cooling > 0 ? sqrt(6 * BIAS_OF_BATH / (drag * cooling)) : INFINITY);
}

/* The bath does at a turn what it would have done since the last one. */
static void make_bath(const gg_bath *b, int species, double interval, gg_md_turns *t)
{
  const gg_relaxation r = gg_common_relaxation(b->drag[species], interval);
  const gg_relaxation s = gg_common_relaxation(b->spin_drag[species], interval);
  t->keep = r.decay, t->size = sqrt(b->noise[species] * r.spread);
  t->spin_keep = s.decay, t->spin_size = sqrt(b->spin_noise[species] * s.spread);
}

static double interval_of(const gg_md *e, int species)
{
  const gg_model *m = &e->model;
  if (e->thermostat == GG_BATH) return interval_in_bath(m, species, e->k.kick_temperature);
  const double T = e->k.kick_temperature, least = LEAST_INTERVAL / gg_common_model_collision_rate(m, T);
  return fmax(least, SHARE_OF_T * T / (m->mass[species] * e->noise));
}

static void choose_interval(gg_md *e, int species)
{
  gg_md_turns *t = &e->kicks.of[species];
  const double interval = interval_of(e, species);
  t->apart = 2 * interval / t->n;
  t->size = e->noise > 0 ? sqrt(3 * e->noise * interval * OUT_OF / KICKED) : 0;
  if (e->thermostat == GG_BATH) make_bath(&e->model.bath, species, interval, t);
}

/* A gas in a bath, or with noise of a given strength, may begin colder than it will be: what heats it is the bath or,
 * as epochs show, the shear. */
static void choose_temperature(gg_md *e)
{
  const gg_model *m = &e->model;
  const bool balanced = m->bath.on && m->shear_rate == 0;
  const double hot = fmax(m->temperature0, balanced ? gg_common_thermostat_balance(m, 0) : 0);
  e->k.kick_temperature = fmax(e->k.kick_temperature, hot);
}

void gg_md_kicks_follow(gg_md *e, double T)
{
  if (!e->model.bath.on || !(T > 2 * e->k.kick_temperature)) return;
  e->k.kick_temperature = T;
  for (int s = 0; s < e->model.n_species; s++) choose_interval(e, s);
}

gg_status gg_md_kicks_make(gg_md *e, gg_error *err)
{
  if (!gg_md_has_kicks(e)) return GG_OK;
  uint32_t end[GG_MAX_SPECIES], before = 0;
  choose_temperature(e);
  for (int s = 0; s < e->model.n_species; s++) {
    gg_md_turns *t = &e->kicks.of[s];
    *t = (gg_md_turns){.first = before, .n = (uint32_t)e->model.n_of[s]};
    t->group = e->n > CACHED && t->n > GROUP ? GROUP : 1;
    t->step = golden_step(t->n / t->group);
    choose_interval(e, s);
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
  if (!gg_md_has_kicks(e)) return;
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

/* Velocities relative to the imposed flow shrink, spins relative to those of grains that roll with it. */
static void relax(gg_md *e, const gg_md_turns *t, uint32_t i)
{
  gg_md_grain *g = &e->grain[i];
  g->r = gg_md_position(e, false, g, e->k.now);
  g->t = e->k.now;
  const double flow = e->model.shear_rate * (g->r.y - 0.5 * e->box.edge[1]);
  g->v = gg_scale(t->keep, g->v);
  g->v.x += (1 - t->keep) * flow;
  if (!e->spin) return;
  e->spin[i] = gg_scale(t->spin_keep, e->spin[i]);
  e->spin[i].z += (1 - t->spin_keep) * gg_model_rolling(&e->model, (int)g->species);
}

static void bathe(gg_md *e, const gg_md_turns *t, const uint32_t pair[2])
{
  const gg_vec ways[2] = {gg_common_rng_normal_vec(&e->k.rng),
                          t->spin_size > 0 ? gg_common_rng_normal_vec(&e->k.rng) : (gg_vec){0, 0, 0}};
  for (int k = 0; k < 2; k++) {
    const double sign = k ? -1 : 1;
    relax(e, t, pair[k]);
    kick(e, pair[k], sign * t->size, ways[0]);
    if (t->spin_size > 0) e->spin[pair[k]] = gg_axpy(sign * t->spin_size, ways[1], e->spin[pair[k]]);
  }
}

static void kick_pair(gg_md *e, const gg_md_turns *t, uint64_t turn)
{
  uint32_t pair[2];
  pair_of(e, t, turn, pair);
  if (e->thermostat == GG_BATH) {
    bathe(e, t, pair);
  } else {
    const gg_vec direction = gg_rng_direction(&e->k.rng);
    kick(e, pair[0], t->size, direction);
    kick(e, pair[1], -t->size, direction);
  }
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
  if (e->thermostat == GG_BATH || gg_rng_below(&e->k.rng, OUT_OF) < KICKED) {
    e->k.events++;
    kick_pair(e, t, turn->number);
  }
  turn->at += t->apart * (0.5 + gg_rng_uniform(&e->k.rng));
  turn->number++;
  if (e->n > CACHED) prefetch(e, t, turn->number + AHEAD);
  e->k.next_kick = e->k.turn[due(e)].at;
}
