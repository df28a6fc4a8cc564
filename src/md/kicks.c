/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "md/kicks.h"

#include <math.h>
#include <stdlib.h>

#include "base/memory.h"
#include "common/thermostat.h"
#include "md/epoch.h"

/* A slot brings a grain FRACTION_OF_T, but is at most WIDEST_INTERVAL mean free times after the last one, unless it
 * then brings less than FRACTION_AT_ANY. Under shear it brings FRACTION_AT_ANY. Slots are at least LEAST_INTERVAL mean
 * free times apart. */
#define FRACTION_OF_T 0.25
#define WIDEST_INTERVAL 3.5
#define FRACTION_AT_ANY 0.12
#define LEAST_INTERVAL 0.5

/* drag x interval in a bath is at most MOST_DRAG: its square over 12 is the relative error of the diffusivity. It is at
 * most MOST_DRAG_RELAXING in the first SETTLING intervals, when the temperature may relax: from up to four times the
 * bath's its square over 2 is the largest error of that, relative to the distance. Under shear it is less: stresses are
 * off by a third of the square. The temperature of spins that have drag is low by drag x cooling rate x interval^2/6,
 * at most by BIAS_OF_SPINS. Heating at a given rate has no kicks to compensate with (narrowing), so slots bring it
 * less. */
#define MOST_DRAG 0.18
#define MOST_DRAG_RELAXING 0.12
#define SETTLING 25
#define MOST_DRAG_SHEARED 0.04
#define BIAS_OF_SPINS 5e-4
#define FRACTION_AT_RATE 0.05

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

/* Longest interval beside collisions, if slots bring a grain this fraction of T per time. */
static double interval_beside_collisions(const gg_model *m, double T, double fraction)
{
  const double free_time = 1 / gg_common_model_collision_rate(m, T);
  const double least = fmax(LEAST_INTERVAL * free_time, FRACTION_AT_ANY / fraction);
  return gg_model_is_sheared(m) ? least : fmax(least, fmin(FRACTION_OF_T / fraction, WIDEST_INTERVAL * free_time));
}

/* Number of slots after which intervals may be longer. */
static uint64_t settled_at(const gg_md_kick_schedule *t)
{
  return (uint64_t)SETTLING * t->n / 2;
}

static double most_drag(const gg_md *e, int species)
{
  if (gg_model_is_sheared(&e->model)) return MOST_DRAG_SHEARED;
  return e->k.kick[species].number < settled_at(&e->kicks.schedule[species]) ? MOST_DRAG_RELAXING : MOST_DRAG;
}

static double interval_in_bath(const gg_md *e, int species, double T)
{
  const gg_model *m = &e->model;
  const double drag = fmax(fabs(m->bath.drag[species]), m->bath.spin_drag[species]), cooling = cooling_rate(m, T);
  double most = most_drag(e, species) / drag;
  if (m->bath.drag[species] < 0)
    return fmin(fmin(most, 1 / gg_common_model_collision_rate(m, T)), FRACTION_AT_RATE / cooling);
  if (!(cooling > 0)) return most;
  if (m->bath.spin_drag[species] > 0)
    most = fmin(most, sqrt(6 * BIAS_OF_SPINS / (m->bath.spin_drag[species] * cooling)));
  return fmin(most, interval_beside_collisions(m, T, cooling));
}

/* Fraction g of what a slot changes by which the temperature that the slot finds lags behind the mean temperature.
 * Collisions reduce an excess of a grain by e^-u in an interval. g is 1/2 without collisions, 0 if collisions have
 * shared the change of the last slot with the other grains. */
static double lag(double u)
{
  return 1 - gg_common_relaxation(0.5 * u, 1).mean; /* 1/u - 1/(e^u - 1) */
}

/* Drag and noise of an interval. The map of a grain without collisions, which is an Ornstein-Uhlenbeck process, would
 * relax the mean temperature too little, because of the lag g. This one relaxes it equally for any g. */
static gg_relaxation relaxation_beside_collisions(double drag, double interval, double u)
{
  const gg_relaxation r = gg_common_relaxation(drag, interval);
  const double kept = r.decay * r.decay, relaxes = 2 * (1 - kept) / (1 + kept);
  const double spread = 2 * r.spread / ((1 + kept) * (1 + relaxes * lag(u)));
  return (gg_relaxation){.decay = sqrt(1 - 2 * drag * spread), .spread = spread};
}

static double sliding(const gg_model *m, int pair)
{
  return m->rule == GG_FRICTIONAL ? fmin(1, m->mu[pair]) : 1;
}

/* Fraction of an excess in kinetic energy, or in that of spins, that a grain loses in a collision: of three components
 * elastic smooth grains exchange one; roughness exchanges parts of the others. */
#define EXCHANGE (2 / 3.)

static double exchange(const gg_model *m, int species)
{
  const int q = gg_pair(species, species);
  const double K = m->inertia[species];
  const double kept = 1 - (1 + m->beta[q]) * K / (2 * (1 + K)) * sliding(m, q);
  return EXCHANGE * (2 - kept * kept);
}

static double exchange_of_spins(const gg_model *m, int species)
{
  const int q = gg_pair(species, species);
  const double kept = 1 - (1 + m->beta[q]) / (2 * (1 + m->inertia[species]));
  return EXCHANGE * (1 - kept * kept) * sliding(m, q);
}

/* Temperature of the steady state that is balanced, else the one that the intervals suit. */
static double steady_temperature(const gg_md *e)
{
  const gg_model *m = &e->model;
  return m->bath.on && !gg_model_is_sheared(m) ? gg_common_thermostat_balance(m, 0) : e->k.kick_temperature;
}

#define SHAPE 0.075 /* fitted to a2 in baths (docs/explanation/md.md) */

/* Fraction by which the fourth moment of a slot's kick is smaller than that of a Gaussian. From slot to slot the
 * temperature of a grain falls from (1 - g) J above the mean to g J below it, where J is what the slot brings. With
 * Gaussian kicks this would widen the distribution of velocities: a2 would be larger by about J^2/6. A slot multiplies
 * the velocity by `keep` and adds noise of variance T x `noise`. It changes <v^4>/(15 T^2) by
 * ((1 - g)^2 - keep^4 g^2) J^2 more than drag and noise without intervals do. But collisions give the cooler grains a
 * larger a2, of which the drag takes (1 - keep^4) SHAPE u g J. */
static double narrowing(double noise, double keep, double u)
{
  if (!(noise > 0)) return 0;
  const double g = lag(u), kept = keep * keep, J = fmax(0, (noise - 1 + kept) / (1 - (1 - kept) * g));
  const double widens = ((1 - g) * (1 - g) - kept * kept * g * g) * J - (1 - kept * kept) * SHAPE * u * g;
  return fmin(0.4, fmax(0, widens * J / (noise * noise)));
}

/* Set the map of a bath over one interval: its drag and noise since the last slot of the grain. Beside collisions that
 * cool, a slot would bring too little in the steady state, by the fraction (drag x interval)^2/3, so the noise is
 * larger. A torque may give any estimate of T: the noise changes by about 1 % at most. */
static void make_bath(const gg_md *e, int species, double interval, double u, gg_md_kick_schedule *t)
{
  const gg_model *m = &e->model;
  const gg_bath *b = &m->bath;
  const double w = interval * gg_common_model_collision_rate(m, e->k.kick_temperature), drag = b->drag[species];
  const gg_relaxation r = relaxation_beside_collisions(drag, interval, u);
  const gg_relaxation s =
      relaxation_beside_collisions(b->spin_drag[species], interval, exchange_of_spins(m, species) * w);
  const double T = steady_temperature(e), kept = gg_common_relaxation(2 * drag, interval).decay;
  const bool cooled = drag > 0 && b->noise[species] > 0 && !gg_model_is_sheared(m);
  const double below = cooled ? fmax(-1, 1 - 2 * drag * T / (m->mass[species] * b->noise[species])) : 0;
  const double more = cooled ? (drag * interval * (1 + kept) / (1 - kept) - 1) * below : 0;
  const double variance = b->noise[species] * r.spread * (1 + more);
  t->keep = r.decay, t->size = sqrt(variance);
  t->chance = narrowing(m->mass[species] * variance / T, t->keep, u) / 0.4;
  t->spin_keep = s.decay, t->spin_size = sqrt(b->spin_noise[species] * s.spread);
}

static double interval_of(const gg_md *e, int species)
{
  const gg_model *m = &e->model;
  const double T = e->k.kick_temperature;
  if (e->heat == GG_HEAT_BATHES) return interval_in_bath(e, species, T);
  return interval_beside_collisions(m, T, m->mass[species] * e->noise / T);
}

static void choose_interval(gg_md *e, int species)
{
  gg_md_kick_schedule *t = &e->kicks.schedule[species];
  const gg_model *m = &e->model;
  const double interval = interval_of(e, species), T = steady_temperature(e);
  const double rate = exchange(m, species) * gg_common_model_collision_rate(m, T) + 0.25 * cooling_rate(m, T);
  const double u = rate * interval;
  t->interval = 2 * interval / t->n;
  t->chance = 0.6 / (1 - narrowing(m->mass[species] * e->noise * interval / T, 1, u));
  t->size = e->noise > 0 ? sqrt(3 * e->noise * interval / t->chance) : 0;
  if (e->heat == GG_HEAT_BATHES) make_bath(e, species, interval, u, t);
}

/* Choose the temperature for which intervals are short enough. A gas in a bath, or with noise of a given strength, may
 * begin colder than its steady state. Heating by shear is noticed from epoch to epoch (gg_md_kicks_follow). */
static void choose_temperature(gg_md *e)
{
  const gg_model *m = &e->model;
  const bool balanced = m->bath.on && !gg_model_is_sheared(m);
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
  for (int s = 0; s < e->model.n_species; s++) {
    e->k.kick[s].number = 0; /* so that intervals are those of a gas that may relax */
    choose_interval(e, s);
    e->k.kick[s].at = 0.5 * e->kicks.schedule[s].interval;
  }
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
  if (next->number == settled_at(t) && e->model.bath.on && !gg_model_is_sheared(&e->model)) choose_interval(e, s);
  if (e->n > CACHED) prefetch(e, t, next->number + AHEAD);
  e->k.next_kick = e->k.kick[due(e)].at;
}
