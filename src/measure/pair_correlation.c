/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Pair correlation g_ij(r) = V/(N_i N_j) <sum delta(r - r_ij)>/(4 pi r^2) from contact outwards, averaged over
 * directions; its value at contact, for approaching and for separating pairs; and the contact value of the collision
 * rate of one species, which is rate/(2 pi n d^2 v), v the mean normal speed before collisions: 2 sqrt(T/pi) if
 * velocities are Maxwellian and uncorrelated, or as measured.
 *
 * Contact values come from collisions, without extrapolation. Pairs of normal speed g_n collide at the rate (density
 * at contact) x 4 pi sigma^2 g_n, so that the sum of 1/g_n over collisions is that density; with g_n after the
 * collision it is the density of separating pairs, 1/e times as large (Lutsko, Phys. Rev. E 63 (2001) 061211). As a
 * function of distance the density of separating pairs is not smooth at contact: pairs of small g_n collide with
 * third grains first. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "measure/observable.h"
#include "measure/pairs.h"

enum { MOST_BINS = 160 };
#define WIDTH 0.025
/* Pairs a grain and snapshot, and the exponent by which their number falls with distance: contact has most of them. */
#define TRIES 50
#define FALL 4.0
/* Sums over the collisions of a pair of species, in units of its mean normal speed: their number; 1/g_n before and
 * after; the time they took. */
enum { COLLISIONS, BEFORE, AFTER, ELAPSED, CONTACT };
#define STUCK 1e-6 /* for e = 0: separating pairs are infinitely dense */
#define SLOW 0.1   /* normal speeds below this fraction of the mean are averaged over */

typedef struct pair_correlation {
  const gg_model *model;
  gg_pairs pairs;
  int n_pairs, bins;      /* of each g_ij */
  double sigma[GG_PAIRS]; /* where they begin */
  struct since {          /* data since the last snapshot: plain bytes */
    double time, elapsed;
    uint64_t collisions, known, taken; /* taken: at the end of this interval */
    double speed[GG_PAIRS],
        earlier[GG_PAIRS]; /* mean normal speeds of Maxwellians at this snapshot and the one before */
    double open[GG_PAIRS][CONTACT], closed[GG_PAIRS][CONTACT];
  } since;
} pair_correlation;

enum { RATE_COLLISIONS, TIME, TEMPERATURE, SNAPSHOTS, EXTRA }; /* after the bins and the contacts */

static void destroy(void *self)
{
  gg_measure_pairs_clear(&((pair_correlation *)self)->pairs);
  free(self);
}

static void *create(const gg_model *m, gg_error *err)
{
  pair_correlation *d = gg_base_array_new(1, sizeof *d, err);
  if (!d) return NULL;
  d->model = m;
  d->n_pairs = gg_pairs_of(m->n_species);
  double widest = gg_common_model_widest(m), reach = gg_measure_pairs_longest_reach(m);
  d->bins = (int)fmin(floor((reach - widest) / WIDTH), MOST_BINS);
  if (d->bins < 1) d->bins = 1;
  for (int i = 0; i < m->n_species; i++)
    for (int j = i; j < m->n_species; j++) {
      int q = gg_pair(i, j);
      d->sigma[q] = m->sigma[q];
    }
  if (gg_measure_pairs_init(&d->pairs, m, fmin(reach, widest + d->bins * WIDTH), TRIES, FALL, err) == GG_OK) return d;
  free(d);
  return NULL;
}

static void *memory(void *self, size_t *bytes)
{
  pair_correlation *d = self;
  *bytes = sizeof d->since;
  return &d->since;
}

static void restart(void *self)
{
  pair_correlation *d = self;
  memset(&d->since, 0, sizeof d->since);
}

static size_t bins(const void *self)
{
  const pair_correlation *d = self;
  return (size_t)(d->n_pairs * (d->bins + CONTACT)) + EXTRA;
}

typedef struct counting {
  const pair_correlation *d;
  const gg_snapshot *s;
  double *bin;
} counting;

GG_INLINE void count(void *context, uint32_t one, uint32_t two, gg_vec separation, double square, double weight)
{
  (void)separation;
  const counting *c = context;
  const pair_correlation *d = c->d;
  const gg_snapshot *s = c->s;
  size_t i = d->pairs.grain[one], j = d->pairs.grain[two];
  int q = gg_pair(gg_snapshot_species(s, i), gg_snapshot_species(s, j));
  double at = (sqrt(square) - d->sigma[q]) * (1 / WIDTH);
  if (at < d->bins && at > -0.01)
    c->bin[q * d->bins + (int)fmax(at, 0)] += weight; /* an overlap by rounding is a contact */
}

/* Weight of a slow collision: 1/g has no finite variance, because the number of slow collisions is proportional to
 * g. Below s it is replaced by the line with the same sums over densities that are linear there. */
static double inverse_speed(double g, double s)
{
  return g < s ? 6 / s * (1 - g / s) : 1 / g;
}

static void add_collision(void *self, const gg_collision_record *c)
{
  pair_correlation *d = self;
  const gg_model *m = d->model;
  int q = gg_pair(c->species[0], c->species[1]);
  double before = gg_dot(c->k, c->c12), over_mass = 1 / m->mass[c->species[0]] + 1 / m->mass[c->species[1]];
  double after = gg_dot(c->k, c->J) * over_mass - before;
  if (!d->since.known || !(before > 0)) return;
  double inverse = inverse_speed(before, SLOW * d->since.speed[q]);
  d->since.open[q][COLLISIONS]++;
  d->since.open[q][BEFORE] += inverse;
  d->since.open[q][AFTER] += after > STUCK * before ? inverse * before / after : INFINITY;
}

/* The mean in time of a speed that falls from `a` to `b` as 1/(1 + t). */
static double mean_speed(double a, double b)
{
  double log_ratio = log(a / b);
  return fabs(log_ratio) < 1e-4 ? 0.5 * (a + b) : log_ratio * a * b / (a - b);
}

/* Add the collisions between two snapshots, in units of the speed then. */
static void close_interval(pair_correlation *d)
{
  struct since *s = &d->since;
  for (int q = 0; q < d->n_pairs; q++) {
    double unit = mean_speed(s->earlier[q], s->speed[q]);
    const double by[CONTACT] = {[COLLISIONS] = 1, [BEFORE] = unit, [AFTER] = unit, [ELAPSED] = unit};
    s->open[q][ELAPSED] = s->elapsed;
    for (int k = 0; k < CONTACT; k++) s->closed[q][k] += by[k] * s->open[q][k];
  }
  memset(s->open, 0, sizeof s->open);
  s->elapsed = 0;
}

/* Called after the snapshot at the end of the interval. The interval of the very first snapshot is not counted. */
static void add_interval(void *self, const gg_interval *interval)
{
  pair_correlation *d = self;
  struct since *s = &d->since;
  bool counted = s->earlier[0] > 0;
  if (counted) s->elapsed += interval->elapsed;
  if (counted && s->taken) close_interval(d);
  if (s->taken) memcpy(s->earlier, s->speed, sizeof s->speed);
  s->taken = 0;
}

static void rescaled(void *self, double factor)
{
  struct since *s = &((pair_correlation *)self)->since;
  s->elapsed /= factor;
  for (int q = 0; q < GG_PAIRS; q++) {
    s->speed[q] *= factor, s->earlier[q] *= factor;
    s->open[q][BEFORE] /= factor, s->open[q][AFTER] /= factor;
  }
}

/* Temperatures of each species; returns that of all, sum C^2/(3N). */
static double take_temperatures(pair_correlation *d, const gg_snapshot *s)
{
  double energy[GG_MAX_SPECIES] = {0}, all = 0;
  for (size_t i = 0; i < s->n; i++)
    energy[gg_snapshot_species(s, i)] += s->c[0][i] * s->c[0][i] + s->c[1][i] * s->c[1][i] + s->c[2][i] * s->c[2][i];
  for (int i = 0; i < d->model->n_species; i++) {
    all += energy[i];
    for (int j = i; j < d->model->n_species; j++) {
      double T = energy[i] / (3 * (double)d->model->n_of[i]) + energy[j] / (3 * (double)d->model->n_of[j]);
      d->since.speed[gg_pair(i, j)] = sqrt(2 * T / M_PI);
    }
  }
  return all / (3 * (double)s->n);
}

static void add_snapshot(void *self, const gg_snapshot *s, double *bin)
{
  pair_correlation *d = self;
  counting c = {d, s, bin};
  gg_images box = gg_measure_pairs_images(s);
  double *extra = bin + d->n_pairs * (d->bins + CONTACT);
  extra[TEMPERATURE] += take_temperatures(d, s);
  gg_measure_pairs_sort(&d->pairs, s, &box);
  gg_pairs_each(&d->pairs, s, &box, count, &c);
  extra[SNAPSHOTS]++;
  if (d->since.known) {
    extra[RATE_COLLISIONS] += (double)(s->collisions - d->since.collisions);
    extra[TIME] += s->time - d->since.time;
  }
  double *contact = bin + d->n_pairs * d->bins;
  for (int i = 0; i < d->n_pairs * CONTACT; i++) contact[i] += (&d->since.closed[0][0])[i];
  memset(d->since.closed, 0, sizeof d->since.closed);
  d->since.time = s->time, d->since.collisions = s->collisions;
  d->since.known = d->since.taken = 1;
}

/* The rate counts pairs of a grain with the N - 1 others. */
static void put_rate(const pair_correlation *d, gg_curve *c, const double *extra, double speed)
{
  const gg_model *m = d->model;
  if (m->n_species > 1 || !gg_model_keeps_temperature(m)) return;
  double rate = 2 * extra[RATE_COLLISIONS] / ((double)m->n * extra[TIME]), T = extra[TEMPERATURE] / extra[SNAPSHOTS];
  double others = (double)(m->n - 1) / m->volume, value = rate / (4 * others * sqrt(M_PI * T));
  gg_measure_curve_put_number(c, "contact_value_of_rate", value, "1");
  gg_measure_curve_put_number(c, "contact_value_of_flux", value / speed, "1");
}

/* `pairs` of grains in the volume, half of those at contact approaching, half separating. */
static void put_contact(const pair_correlation *d, int q, gg_curve *c, const double *bin, double pairs)
{
  const double *sum = bin + d->n_pairs * d->bins + q * CONTACT;
  double sphere = 4 * M_PI * d->sigma[q] * d->sigma[q], half = 0.5 * pairs / d->model->volume;
  double before = sum[BEFORE] / (sphere * half * sum[ELAPSED]), after = sum[AFTER] / (sphere * half * sum[ELAPSED]);
  if (isinf(after)) after = NAN;
  double speed = sum[COLLISIONS] / sum[BEFORE];
  gg_measure_curve_put_number(c, "contact_value", 0.5 * (before + after), "1");
  gg_measure_curve_put_number(c, "contact_value_before", before, "1");
  gg_measure_curve_put_number(c, "contact_value_after", after, "1");
  gg_measure_curve_put_number(c, "approach_speed", speed, "1");
  put_rate(d, c, bin + d->n_pairs * (d->bins + CONTACT), speed);
}

static void curves(const void *self, const double *bin, gg_curves *list)
{
  const pair_correlation *d = self;
  const gg_model *m = d->model;
  for (int i = 0; i < m->n_species; i++)
    for (int j = i; j < m->n_species; j++) {
      int q = gg_pair(i, j);
      char name[48] = "pair_correlation", label[24] = "g", both[GG_PAIR_NAME];
      if (m->n_species > 1) {
        snprintf(name, sizeof name, "pair_correlation_%s", gg_common_pair_name(q, both));
        snprintf(label, sizeof label, "g_{%s}", both);
      }
      double a = (double)m->n_of[i], b = (double)m->n_of[j], pairs = i == j ? a * (a - 1) / 2 : a * b;
      gg_curve *c = gg_measure_curve_add(list, (size_t)d->bins, name, "pair correlation", label);
      gg_measure_curve_axes(c, "r", gg_measure_curve_unit(m, "length"), "g", "1");
      for (size_t k = 0; k < c->n; k++) {
        double from = d->sigma[q] + (double)k * WIDTH, to = from + WIDTH;
        double shell = 4.0 / 3 * M_PI * (to * to * to - from * from * from);
        c->x[k] = from + WIDTH / 2;
        c->value[k] = bin[(size_t)(q * d->bins) + k] / (pairs * shell / m->volume);
      }
      gg_measure_curve_beside(c, "ideal gas", gg_measure_curve_level, &(double){1});
      if (c->n) put_contact(d, q, c, bin, pairs);
    }
}

const gg_observable gg_measure_pair_correlation = {
    GG_OBSERVABLE(PAIR_CORRELATION, pair_correlation),
    .create = create,
    .destroy = destroy,
    .memory = memory,
    .refuses = gg_measure_needs_bulk,
    .positions = true,
    .rescaled = rescaled,
    .restart = restart,
    .curves =
        &(const gg_observable_curves){
            .bins = bins, .every = 5, .add_snapshot = add_snapshot, .add_interval = add_interval, .of_bins = curves},
    .collisions = &(const gg_observable_collisions){.add = add_collision},
    .cost = {.bytes = 34, .ns = {140, 0}},
};
