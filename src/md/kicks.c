/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "md/kicks.h"

#include <math.h>
#include <stdlib.h>

#include "base/memory.h"
#include "common/thermostat.h"
#include "md/epoch.h"

/* White noise adds at most this fraction of T to a grain from slot to slot, but slots of a grain are at least so many
 * mean free times apart, where it is up to 17 % (e = 0). */
#define FRACTION_OF_T 0.12
#define LEAST_INTERVAL 0.5

/* In a bath slots are at least LEAST_IN_BATH mean free times apart. The temperature is low by drag x cooling rate x
 * interval^2/6, at most by BIAS_OF_BATH. drag x interval is at most MOST_DRAG: its square over 12 is the relative error
 * of the diffusivity, its square over 2 the largest one of a temperature that relaxes. Under shear it is less: stresses
 * are off by a third of the square. Heating at a given rate has no kicks to compensate with (NARROWING), so slots bring
 * it less. */
#define BIAS_OF_BATH 5e-4
#define LEAST_IN_BATH 0.5
#define FRACTION_AT_RATE 0.05
#define MOST_DRAG 0.12
#define MOST_DRAG_SHEARED 0.04

/* The number of slots since a grain's last collision varies by one, which widens the distribution of velocities: a2
 * would be x^2/6 larger, where x is the fraction of T from slot to slot. A kick whose fourth moment is smaller than
 * that of a Gaussian compensates. That lasts for about a mean free time, which has 1/w slots if w is the interval in
 * mean free times: so the fourth moment is smaller by the fraction NARROWING w, of w at most WIDEST_INTERVAL. Kicks of
 * fixed length in each slot have 2/5 less; in 3/5 of the slots they have the moments of a Gaussian. */
#define NARROWING 0.118
#define WIDEST_INTERVAL 3

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

/* Rate at which collisions cool a gas at temperature T. */
static double cooling_rate(const gg_model *m, double T)
{
  double mass = 0;
  for (int i = 0; i < m->n_species; i++) mass += m->mass[i] * (double)m->n_of[i] / (double)m->n;
  return mass * gg_common_thermostat_noise(m) / m->temperature0 * sqrt(T / m->temperature0);
}

static double interval_in_bath(const gg_model *m, int species, double T)
{
  const double drag = fmax(fabs(m->bath.drag[species]), m->bath.spin_drag[species]), cooling = cooling_rate(m, T);
  const double free_time = 1 / gg_common_model_collision_rate(m, T);
  double most = (m->shear_rate != 0 ? MOST_DRAG_SHEARED : MOST_DRAG) / drag;
  if (cooling > 0) most = fmin(most, sqrt(6 * BIAS_OF_BATH / (drag * cooling)));
  if (m->bath.drag[species] < 0) return fmin(fmin(most, free_time), FRACTION_AT_RATE / cooling);
  return cooling > 0 ? fmin(most, fmax(LEAST_IN_BATH * free_time, FRACTION_OF_T / cooling)) : most;
}

/* Drag and noise of an interval in which collisions reduce an excess of a grain by e^-u. The slot of a grain finds not
 * the mean temperature, but one that lags behind by the fraction g of what the slot changes: g = 1/2 without
 * collisions, 0 if they have shared the change of the last slot with the other grains. So the map of a grain without
 * collisions, which is an Ornstein-Uhlenbeck process, would relax the mean temperature too little. This one relaxes it
 * equally for any g. */
static gg_relaxation relaxation_beside_collisions(double drag, double interval, double u)
{
  const gg_relaxation r = gg_common_relaxation(drag, interval);
  const double g = 1 - gg_common_relaxation(0.5 * u, 1).mean; /* 1/u - 1/(e^u - 1) */
  const double kept = r.decay * r.decay, relaxes = 2 * (1 - kept) / (1 + kept);
  const double spread = 2 * r.spread / ((1 + kept) * (1 + relaxes * g));
  return (gg_relaxation){.decay = sqrt(1 - 2 * drag * spread), .spread = spread};
}

/* Fraction of an excess in kinetic energy, or in that of spins, that a grain loses in a collision: of three components
 * one is exchanged (elastic), or two spins change by a part. */
#define EXCHANGE (2 / 3.)

static double exchange_of_spins(const gg_model *m, int species)
{
  const int q = gg_pair(species, species);
  const double kept = 1 - (1 + m->beta[q]) / (2 * (1 + m->inertia[species]));
  return EXCHANGE * (1 - kept * kept) * (m->rule == GG_FRICTIONAL ? fmin(1, m->mu[q]) : 1);
}

/* Fraction by which the fourth moment of a slot's kick is smaller than that of a Gaussian. In a bath a part of the
 * noise replaces what the drag takes, which does not widen the distribution. */
static double narrowing(const gg_md *e, int species, double interval)
{
  const gg_model *m = &e->model;
  const double T = e->k.kick_temperature, w = fmin(WIDEST_INTERVAL, interval * gg_common_model_collision_rate(m, T));
  const double cooling = cooling_rate(m, T), drag = e->heat == GG_HEAT_BATHES ? fabs(m->bath.drag[species]) : 0;
  const double widens = cooling > 0 ? cooling / (cooling + 2 * drag) : 0;
  return NARROWING * w * widens * widens;
}

/* Set the map of a bath over one interval: its drag and noise since the last slot of the grain. */
static void make_bath(const gg_md *e, int species, double interval, gg_md_kick_schedule *t)
{
  const gg_bath *b = &e->model.bath;
  const double w = interval * gg_common_model_collision_rate(&e->model, e->k.kick_temperature);
  const gg_relaxation r = relaxation_beside_collisions(b->drag[species], interval, EXCHANGE * w);
  const gg_relaxation s =
      relaxation_beside_collisions(b->spin_drag[species], interval, exchange_of_spins(&e->model, species) * w);
  t->keep = r.decay, t->size = sqrt(b->noise[species] * r.spread);
  t->chance = narrowing(e, species, interval) / 0.4;
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
  t->chance = 0.6 / (1 - narrowing(e, species, interval));
  t->size = e->noise > 0 ? sqrt(3 * e->noise * interval / t->chance) : 0;
  if (e->heat == GG_HEAT_BATHES) make_bath(e, species, interval, t);
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

double gg_md_compensation_interval(const gg_md *e)
{
  return 0.5 / gg_common_model_collision_rate(&e->model, gg_md_temperature(e));
}

void gg_md_kicks_begin(gg_md *e)
{
  e->k.next_kick = gg_md_compensates(e) ? gg_md_compensation_interval(e) : INFINITY;
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

static void kick(gg_md *e, uint32_t i, double sign, gg_vec change)
{
  gg_md_grain *g = &e->grain[i];
  g->r = gg_md_position(e, false, g, e->k.now);
  g->t = e->k.now;
  g->v = gg_axpy(sign, change, g->v);
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
  const double turned = gg_md_turned(e, gg_md_species_of(g));
  e->spin[i].z += turned;
  e->spin[i] = gg_scale(t->spin_keep, e->spin[i]);
  e->spin[i].z += (1 - t->spin_keep) * gg_model_rolling(&e->model, (int)g->species) - turned;
}

/* Change of the first grain's velocity in a slot; the second grain's is opposite. */
static gg_vec change_of_velocity(gg_md *e, const gg_md_kick_schedule *t)
{
  if (e->heat == GG_HEAT_KICKS) return gg_scale(t->size, gg_rng_direction(&e->k.rng));
  if (gg_rng_uniform(&e->k.rng) < t->chance) return gg_scale(sqrt(3) * t->size, gg_rng_direction(&e->k.rng));
  return gg_scale(t->size, gg_common_rng_normal_vec(&e->k.rng));
}

static void bathe(gg_md *e, const gg_md_kick_schedule *t, const uint32_t pair[2])
{
  const gg_vec spin = t->spin_size > 0 ? gg_common_rng_normal_vec(&e->k.rng) : (gg_vec){0, 0, 0};
  for (int k = 0; k < 2; k++) {
    relax(e, t, pair[k]);
    if (t->spin_size > 0) e->spin[pair[k]] = gg_axpy(k ? -t->spin_size : t->spin_size, spin, e->spin[pair[k]]);
  }
}

static void kick_pair(gg_md *e, const gg_md_kick_schedule *t, uint64_t slot)
{
  uint32_t pair[2];
  pair_of(e, t, slot, pair);
  const gg_vec change = change_of_velocity(e, t);
  if (e->heat == GG_HEAT_BATHES) bathe(e, t, pair);
  kick(e, pair[0], 1, change);
  kick(e, pair[1], -1, change);
  e->kernel->predict_two(e, pair[0], pair[1]);
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
  if (e->heat == GG_HEAT_BATHES || gg_rng_uniform(&e->k.rng) < t->chance) {
    e->k.events++;
    kick_pair(e, t, next->number);
  }
  next->at += t->interval * (0.5 + gg_rng_uniform(&e->k.rng));
  next->number++;
  if (e->n > CACHED) prefetch(e, t, next->number + AHEAD);
  e->k.next_kick = e->k.kick[due(e)].at;
}
