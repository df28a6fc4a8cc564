/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "md/kicks.h"

#include <math.h>
#include <stdlib.h>

#include "base/memory.h"
#include "common/thermostat.h"
#include "md/epoch.h"

/* White noise adds at most this fraction of T to a grain from slot to slot, but slots of a grain are at least so many
 * mean free times apart, where it is up to 9 % (e = 0). */
#define FRACTION_OF_T 0.02
#define LEAST_INTERVAL 0.27

/* Limits of the interval in a bath. The temperature is low by drag x cooling rate x interval^2/6
 * (tests/md/test_bath.c), at most by BIAS_OF_BATH. drag x interval is at most MOST_DRAG, less under shear: stresses are
 * off by a third of its square. */
#define BIAS_OF_BATH 2e-4
#define MOST_DRAG 0.1
#define MOST_DRAG_SHEARED 0.04

/* Five of eight slots have a kick. Three of five would give kicks of fixed length the second and fourth moments of a
 * Gaussian. But the number of slots since a grain's last collision varies by one, which widens the distribution of
 * velocities: a2 would be x^2/6 larger, where x is the fraction of T from slot to slot. With five of eight the fourth
 * moment is 1/25 smaller in each slot, which lasts for about a mean free time: this compensates at LEAST_INTERVAL,
 * where x is largest. */
enum { KICKED = 5, OUT_OF = 8 };

enum {
  AHEAD = 4,     /* grains are prefetched so many slots before their kick */
  CACHED = 6000, /* the cache holds so many grains */
  GROUP = 32     /* of more grains, so many neighbours in memory are kicked one after the other */
};

static uint32_t greatest_common_divisor(uint32_t a, uint32_t b)
{
  return b ? greatest_common_divisor(b, a % b) : a;
}

/* Step of the schedule, near the golden ratio of n and prime to n: grains or groups that are near in memory, and so in
 * space, have slots far apart in time. */
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

/* Set the map of a bath over one interval: its drag and noise since the last slot of the grain. */
static void make_bath(const gg_bath *b, int species, double interval, gg_md_kick_schedule *t)
{
  const gg_relaxation r = gg_common_relaxation(b->drag[species], interval);
  const gg_relaxation s = gg_common_relaxation(b->spin_drag[species], interval);
  t->keep = r.decay, t->size = sqrt(b->noise[species] * r.spread);
  t->spin_keep = s.decay, t->spin_size = sqrt(b->spin_noise[species] * s.spread);
}

static double interval_of(const gg_md *e, int species)
{
  const gg_model *m = &e->model;
  if (e->heat == GG_HEAT_BATHES) return interval_in_bath(m, species, e->k.kick_temperature);
  const double T = e->k.kick_temperature, least = LEAST_INTERVAL / gg_common_model_collision_rate(m, T);
  return fmax(least, FRACTION_OF_T * T / (m->mass[species] * e->noise));
}

static void choose_interval(gg_md *e, int species)
{
  gg_md_kick_schedule *t = &e->kicks.schedule[species];
  const double interval = interval_of(e, species);
  t->interval = 2 * interval / t->n;
  t->size = e->noise > 0 ? sqrt(3 * e->noise * interval * OUT_OF / KICKED) : 0;
  if (e->heat == GG_HEAT_BATHES) make_bath(&e->model.bath, species, interval, t);
}

/* Choose the temperature for which intervals are short enough. A gas in a bath, or with noise of a given strength, may
 * begin colder than its steady state. Heating by shear is noticed from epoch to epoch (gg_md_kicks_follow). */
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
    gg_md_kick_schedule *t = &e->kicks.schedule[s];
    *t = (gg_md_kick_schedule){.first = before, .n = (uint32_t)e->model.n_of[s]};
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
    if (e->k.kick[s].at < e->k.kick[first].at) first = s;
  return first;
}

void gg_md_kicks_begin(gg_md *e)
{
  e->k.next_kick = INFINITY;
  if (!gg_md_has_kicks(e)) return;
  for (int s = 0; s < e->model.n_species; s++)
    e->k.kick[s] = (gg_md_kick_progress){.at = 0.5 * e->kicks.schedule[s].interval};
  e->k.next_kick = e->k.kick[due(e)].at;
}

void gg_md_kicks_move(gg_md *e, double span)
{
  e->k.next_kick -= span;
  for (int s = 0; s < e->model.n_species; s++) e->k.kick[s].at -= span;
}

static uint32_t at_place(const gg_md *e, const gg_md_kick_schedule *t, uint64_t place)
{
  const uint64_t groups = t->n / t->group, k = place / t->group;
  const uint64_t there = k < groups ? k * t->step % groups * t->group + place % t->group : place;
  const uint32_t i = t->first + (uint32_t)there;
  return e->kicks.order ? e->kicks.order[i] : i;
}

/* Pair of grains of a slot. If n is even, the grains of one half are paired with the other half, shifted by one in
 * every round; if n is odd, the slot runs over all grains and the pair is half of them apart. */
static void pair_of(const gg_md *e, const gg_md_kick_schedule *t, uint64_t slot, uint32_t pair[2])
{
  const uint64_t half = t->n / 2, at = slot % (t->n % 2 ? t->n : half);
  pair[0] = at_place(e, t, at);
  pair[1] = at_place(e, t, t->n % 2 ? (at + half) % t->n : half + (at + slot / half) % half);
}

static void kick(gg_md *e, uint32_t i, double size, gg_vec direction)
{
  gg_md_grain *g = &e->grain[i];
  g->r = gg_md_position(e, false, g, e->k.now);
  g->t = e->k.now;
  g->v = gg_axpy(size, direction, g->v);
  g->counter++;
}

/* Apply drag to a grain: to its velocity relative to the imposed flow, and to its spin relative to rolling with it. */
static void relax(gg_md *e, const gg_md_kick_schedule *t, uint32_t i)
{
  gg_md_grain *g = &e->grain[i];
  g->r = gg_md_position(e, false, g, e->k.now);
  g->t = e->k.now;
  const double flow = e->model.shear_rate * (g->r.y - 0.5 * e->box.edge[1]);
  g->v = gg_scale(t->keep, g->v);
  g->v.x += (1 - t->keep) * flow;
  if (!e->spin) return;
  const double turned = gg_md_turned(e, (int)g->species);
  e->spin[i].z += turned;
  e->spin[i] = gg_scale(t->spin_keep, e->spin[i]);
  e->spin[i].z += (1 - t->spin_keep) * gg_model_rolling(&e->model, (int)g->species) - turned;
}

static void bathe(gg_md *e, const gg_md_kick_schedule *t, const uint32_t pair[2])
{
  const gg_vec directions[2] = {gg_common_rng_normal_vec(&e->k.rng),
                                t->spin_size > 0 ? gg_common_rng_normal_vec(&e->k.rng) : (gg_vec){0, 0, 0}};
  for (int k = 0; k < 2; k++) {
    const double sign = k ? -1 : 1;
    relax(e, t, pair[k]);
    kick(e, pair[k], sign * t->size, directions[0]);
    if (t->spin_size > 0) e->spin[pair[k]] = gg_axpy(sign * t->spin_size, directions[1], e->spin[pair[k]]);
  }
}

static void kick_pair(gg_md *e, const gg_md_kick_schedule *t, uint64_t slot)
{
  uint32_t pair[2];
  pair_of(e, t, slot, pair);
  if (e->heat == GG_HEAT_BATHES) {
    bathe(e, t, pair);
  } else {
    const gg_vec direction = gg_rng_direction(&e->k.rng);
    kick(e, pair[0], t->size, direction);
    kick(e, pair[1], -t->size, direction);
  }
  for (int k = 0; k < 2; k++) e->kernel->predict(e, pair[k], pair[k] + 1);
}

static void prefetch(const gg_md *e, const gg_md_kick_schedule *t, uint64_t slot)
{
  uint32_t pair[2];
  pair_of(e, t, slot, pair);
  for (int k = 0; k < 2; k++) {
    __builtin_prefetch(&e->grain[pair[k]]);
    __builtin_prefetch(&e->node[pair[k]]);
  }
}

/* Slots are at random distances, from half an interval to one and a half: samples of a few grains cannot keep in step
 * with them. */
void gg_md_kick(gg_md *e)
{
  const int s = due(e);
  const gg_md_kick_schedule *t = &e->kicks.schedule[s];
  gg_md_kick_progress *next = &e->k.kick[s];
  if (e->heat == GG_HEAT_BATHES || gg_rng_below(&e->k.rng, OUT_OF) < KICKED) {
    e->k.events++;
    kick_pair(e, t, next->number);
  }
  next->at += t->interval * (0.5 + gg_rng_uniform(&e->k.rng));
  next->number++;
  if (e->n > CACHED) prefetch(e, t, next->number + AHEAD);
  e->k.next_kick = e->k.kick[due(e)].at;
}
