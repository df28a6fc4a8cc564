/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Statistics of single collisions: path and time between successive ones, and the angles at which grains collide.
 *
 * A free path is peculiar, the integral of |C| over the flight, or the path in the laboratory, |c| times its
 * duration. Under shear C_x changes in flight: back from the collision, C_x + shear_rate C_y s. Omitted are: times
 * in free cooling, which grow without end; paths with thermostats or gravity, which bend the flight; and paths
 * between walls, which depend on the place.
 * The impact angle lies between k and the relative velocity; molecular chaos gives it the density 2 cos (a uniform
 * impact parameter). The other angle is that of k in the plane of shear, from the x axis (Alam & Luding, Phys.
 * Fluids 15 (2003) 2298): either grain of a pair may be the first, so it is kept on [0, pi). */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "common/thermostat.h"
#include "measure/free_flight.h"
#include "measure/observable.h"

/* Bins of flights: sixteen of equal width in every octave of the expected mean, from 2^-8 to 2^8 of it. */
enum { PARTS = 16, LOWEST = -8, HIGHEST = 8, FLIGHT_BINS = (HIGHEST - LOWEST) * PARTS };
enum { COUNT, SUM, SQUARES, FLIGHT_FIRST, FLIGHT = FLIGHT_FIRST + FLIGHT_BINS }; /* one distribution of flights */
enum { TIME, PATH, LABORATORY, KINDS };
enum { COS_BINS = 50, PLANE_BINS = 72 };
enum { COLLISIONS, FABRIC, COSINES = FABRIC + 4, PLANE = COSINES + COS_BINS, ANGLES = PLANE + PLANE_BINS };

typedef struct collisions {
  const gg_model *model;
  double unit[KINDS]; /* inverse of the expected mean time and path between collisions */
  bool has[KINDS];
  size_t width;
  uint64_t first[GG_MAX_SPECIES]; /* contacts of grains of a species since averaging began, until its flights count */
  double sums[];                  /* since the last snapshot: angles, then the flights of each species */
} collisions;

/* Set the kinds of collisions from the present model. */
static void set_kinds(collisions *d)
{
  const gg_model *m = d->model;
  double rate = gg_common_model_collision_rate(m, m->temperature0), speed = sqrt(8 * m->temperature0 / M_PI);
  d->unit[TIME] = rate;
  d->unit[PATH] = d->unit[LABORATORY] = rate / speed;
  /* A time has a meaning if the temperature is constant; under md's Gaussian thermostat the engine's clock is not
   * that of the gas. A path follows from the velocity at its end if only shear changes the velocity in flight. */
  bool other_clock = gg_common_thermostats[m->thermostat].heat == GG_HEAT_SCALES && !m->homogeneous;
  d->has[TIME] = gg_model_keeps_temperature(m) && !other_clock; /* else it changes with T */
  d->has[PATH] = gg_common_heat_of(m) == GG_UNHEATED && !gg_flow_is_walled(m->flow);
  d->has[LABORATORY] = d->has[PATH] && m->steady && m->shear_rate != 0 && !m->homogeneous;
}

static void *create(const gg_model *m, gg_error *err)
{
  size_t width = ANGLES + (size_t)(m->n_species * KINDS * FLIGHT);
  collisions *d = gg_base_array_new(1, sizeof *d + width * sizeof *d->sums, err);
  if (!d) return NULL;
  d->model = m;
  d->width = width;
  set_kinds(d);
  return d;
}

static size_t bins(const void *self)
{
  return ((const collisions *)self)->width;
}

/* The bits of a number are its octave, followed by its position in the octave. */
GG_INLINE void add_flight(double *to, double x, double unit)
{
  uint64_t bits;
  double relative = x * unit;
  memcpy(&bits, &relative, sizeof bits);
  int64_t bin = (int64_t)(bits >> 48) - (1023 + LOWEST) * PARTS;
  to[COUNT]++;
  to[SUM] += x;
  to[SQUARES] += x * x;
  if (bin >= 0 && bin < FLIGHT_BINS) to[FLIGHT_FIRST + bin]++;
}

static double lower_edge(int bin)
{
  return ldexp(1 + (double)(bin % PARTS) / PARTS, LOWEST + bin / PARTS);
}

/* Integral of |C| back over the time t; Gauss's rule of five points. */
static double peculiar_path(gg_vec c, double rate, double t)
{
  static const double at[] = {0.5, 0.23076534494715845, 0.76923465505284155, 0.04691007703066802, 0.95308992296933198};
  static const double weight[] = {0.28444444444444444, 0.23931433524968324, 0.23931433524968324, 0.11846344252809454,
                                  0.11846344252809454};
  double sum = 0, across = c.y * c.y + c.z * c.z;
  if (rate == 0) return t * sqrt(c.x * c.x + across);
  for (int k = 0; k < 5; k++) {
    double x = c.x + rate * c.y * at[k] * t;
    sum += weight[k] * sqrt(x * x + across);
  }
  return sum * t;
}

/* Flights are counted when they end. Long flights that end soon after averaging began started before it and are
 * unknown. So counting starts when hardly a grain of the species is left without a collision: else means would be
 * too small by one part in the number of collisions of such a grain. */
#define FIRST_COLLISIONS 12 /* a grain; exp(-12) of the grains have had none */
static bool flights_count(collisions *d, int species)
{
  uint64_t enough = FIRST_COLLISIONS * (uint64_t)d->model->n_of[species];
  if (d->first[species] == enough) return true;
  d->first[species]++;
  return false;
}

static void add_flights(collisions *d, const gg_collision_record *m, int which)
{
  double t = m->since[which], rate = d->model->shear_rate, *to = d->sums + ANGLES + m->species[which] * KINDS * FLIGHT;
  gg_vec c = m->c[which];
  if (!(t < INFINITY)) return;
  if (d->has[TIME]) add_flight(to + TIME * FLIGHT, t, d->unit[TIME]);
  if (d->has[PATH]) add_flight(to + PATH * FLIGHT, peculiar_path(c, rate, t), d->unit[PATH]);
  if (!d->has[LABORATORY]) return;
  c.x += rate * m->height[which];
  add_flight(to + LABORATORY * FLIGHT, t * sqrt(gg_dot(c, c)), d->unit[LABORATORY]);
}

/* The bin of the angle as a fraction of half a turn. */
static int plane_bin(gg_vec k)
{
  double share = atan2(k.y, k.x) / M_PI;
  int bin = (int)((share < 0 ? share + 1 : share) * PLANE_BINS);
  return bin < PLANE_BINS ? bin : 0;
}

static void add_collision(void *self, const gg_collision_record *m)
{
  collisions *d = self;
  gg_vec k = m->k;
  int cosine = (int)(gg_dot(k, m->c12) / sqrt(gg_dot(m->c12, m->c12)) * COS_BINS);
  double *fabric = d->sums + FABRIC;
  d->sums[COLLISIONS]++;
  fabric[0] += k.x * k.x, fabric[1] += k.y * k.y, fabric[2] += k.z * k.z, fabric[3] += k.x * k.y;
  d->sums[COSINES + (cosine < 0 ? 0 : cosine < COS_BINS ? cosine : COS_BINS - 1)]++;
  d->sums[PLANE + plane_bin(k)]++;
  for (int i = 0; i < 2; i++)
    if (flights_count(d, m->species[i])) add_flights(d, m, i);
}

static void begin_burst(void *self)
{
  collisions *d = self;
  memset(d->first, 0, sizeof d->first);
  memset(d->sums, 0, d->width * sizeof *d->sums);
}

static void *memory(void *self, size_t *bytes)
{
  collisions *d = self;
  *bytes = sizeof d->first +
           d->width * sizeof *d->sums; /* first and sums are adjacent; a run may be stopped in an interval */
  return d->first;
}

static void add_snapshot(void *self, const gg_snapshot *s, double *bin)
{
  collisions *d = self;
  (void)s;
  for (size_t i = 0; i < d->width; i++) bin[i] += d->sums[i];
  memset(d->sums, 0, d->width * sizeof *d->sums);
}

static void restart(void *self)
{
  collisions *d = self;
  set_kinds(d);
  memset(d->sums, 0, d->width * sizeof *d->sums);
}

/* Mean, its inverse, and the second moment over the square of the first: 2 if exponential. */
static void put_numbers(gg_curve *c, const gg_model *m, int kind, const double *at)
{
  double mean = at[SUM] / at[COUNT], dispersion = at[SQUARES] / at[COUNT] / (mean * mean);
  const char *length = gg_measure_curve_unit(m, "length");
  if (kind == TIME) {
    gg_measure_curve_put_number(c, "mean_free_time", mean, gg_measure_curve_unit(m, "time"));
  } else {
    gg_measure_curve_put_number(c, kind == PATH ? "mean_free_path" : "mean_free_path_laboratory", mean, length);
    if (!m->ensemble) /* an ensemble without a box has no width */
      gg_measure_curve_put_number(c, kind == PATH ? "knudsen" : "knudsen_laboratory", mean / m->length, "1");
  }
  gg_measure_curve_put_number(c, "second_moment_over_mean_squared", dispersion, "1");
}

static void put_flight(const collisions *d, gg_curves *list, int kind, int species, const double *at)
{
  static const char *const names[] = {"free_time", "free_path", "free_path_laboratory"};
  static const char *const panels[] = {"time between collisions", "free path", "free path"};
  static const char *const labels[] = {"", "peculiar", "laboratory"};
  const gg_model *m = d->model;
  const char *unit = gg_measure_curve_unit(m, kind == TIME ? "time" : "length");
  char name[48], label[24], inverse[40];
  bool two = m->n_species > 1;
  snprintf(name, sizeof name, two ? "%s_%d" : "%s", names[kind], species + 1);
  snprintf(label, sizeof label, two ? "%s %d" : "%s", labels[kind], species + 1);
  snprintf(inverse, sizeof inverse, kind == TIME ? "%.30s" : "1/%.30s",
           kind == TIME ? gg_measure_curve_unit(m, "spin") : unit);
  gg_curve *c = gg_measure_curve_add(list, FLIGHT_BINS, name, panels[kind], label);
  gg_measure_curve_axes(c, kind == TIME ? "t" : "l", unit, "P", inverse);
  c->log_y = true;
  for (int i = 0; i < (int)c->n; i++) {
    double from = lower_edge(i) / d->unit[kind], to = lower_edge(i + 1) / d->unit[kind];
    c->x[i] = 0.5 * (from + to);
    c->value[i] = at[FLIGHT_FIRST + i] / (at[COUNT] * (to - from));
  }
  put_numbers(c, m, kind, at);
  double law[GG_FLIGHT_LAW];
  gg_measure_free_flight_of(m, species, law);
  law[GG_FLIGHT_MEAN] = at[SUM] / at[COUNT];
  gg_measure_curve_beside(c, "Maxwellian gas", kind == TIME ? gg_measure_free_time_law : gg_measure_free_path_law, law);
}

static double twice(double x, const double *none)
{
  (void)none;
  return 2 * x;
}

static void put_angles(const collisions *d, gg_curves *list, const double *bin)
{
  static const char *const fabric[] = {"fabric_xx", "fabric_yy", "fabric_zz", "fabric_xy"};
  gg_curve *c = gg_measure_curve_add(list, COS_BINS, "impact_cos", "impact angle", "");
  gg_measure_curve_axes(c, "cos χ", "1", "P", "1");
  for (int i = 0; i < (int)c->n; i++) {
    c->x[i] = (i + 0.5) / COS_BINS;
    c->value[i] = bin[COSINES + i] * COS_BINS / bin[COLLISIONS];
  }
  gg_measure_curve_beside(c, "molecular chaos", twice, NULL);
  c = gg_measure_curve_add(
      list, PLANE_BINS, "collision_angle",
      d->model->shear_rate != 0 ? "angle of k in the plane of shear" : "angle of k in the plane xy", "");
  gg_measure_curve_axes(c, "θ_c/π", "1", "P", "1");
  for (int i = 0; i < (int)c->n; i++) {
    c->x[i] = (i + 0.5) / PLANE_BINS;
    c->value[i] = bin[PLANE + i] * PLANE_BINS / bin[COLLISIONS];
  }
  gg_measure_curve_beside(c, "no direction", gg_measure_curve_level, &(double){1});
  for (int a = 0; a < 4; a++) gg_measure_curve_put_number(c, fabric[a], bin[FABRIC + a] / bin[COLLISIONS], "1");
}

static void curves(const void *self, const double *bin, gg_curves *list)
{
  const collisions *d = self;
  put_angles(d, list, bin);
  for (int kind = 0; kind < KINDS; kind++)
    for (int k = 0; k < d->model->n_species && d->has[kind]; k++)
      put_flight(d, list, kind, k, bin + ANGLES + (k * KINDS + kind) * FLIGHT);
}

const gg_observable gg_measure_collisions = {
    GG_OBSERVABLE(COLLISIONS, collisions),
    .create = create,
    .destroy = free,
    .memory = memory,
    .restart = restart,
    .curves = &(const gg_observable_curves){.bins = bins, .every = 1, .add_snapshot = add_snapshot, .of_bins = curves},
    .collisions = &(const gg_observable_collisions){.add = add_collision, .begin_burst = begin_burst},
    .cost = {.bytes = 8, .ns = {90, 6}},
};
