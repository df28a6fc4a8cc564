/* Pair correlation g_ij(r) = V/(N_i N_j) <sum delta(r - r_ij)>/(4 pi r^2) from contact outwards, averaged over
 * directions; its value at contact, of pairs that approach and that part (contact_statistics.h); and the contact value
 * of the collision rate of one species, which is rate/(2 pi n d^2 v), v the mean normal speed of those about to
 * collide: 2 sqrt(T/pi) if velocities are Maxwellian and uncorrelated, or as measured. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/memory.h"
#include "measure/contact_statistics.h"
#include "measure/observable.h"
#include "measure/pairs.h"

enum { MOST_BINS = 160 };
#define WIDTH 0.025
/* Pairs a grain and snapshot, and how fast they become fewer with distance: most is asked of contact. */
#define TRIES 50
#define FALL 4.0

typedef struct pair_correlation {
  gg_model model;
  gg_pairs pairs;
  int n_pairs, bins;      /* of each g_ij */
  double sigma[GG_PAIRS]; /* where they begin */
  gg_near near[GG_PAIRS];
  double speed[GG_PAIRS]; /* mean normal speed of approach of Maxwellians, at the present temperatures */
  struct since {          /* of the snapshot before: plain bytes */
    double time;
    uint64_t collisions, known;
  } since;
} pair_correlation;

enum { COLLISIONS, TIME, TEMPERATURE, SNAPSHOTS, EXTRA }; /* behind the bins and those next to contact */

static void destroy(void *self)
{
  gg_measure_pairs_clear(&((pair_correlation *)self)->pairs);
  free(self);
}

static void *create(const gg_model *m, gg_error *err)
{
  pair_correlation *d = gg_base_array_new(1, sizeof *d, err);
  if (!d) return NULL;
  d->model = *m;
  d->n_pairs = gg_pairs_of(m->n_species);
  double widest = gg_common_model_widest(m), reach = gg_measure_pairs_longest_reach(m);
  d->bins = (int)fmin(floor((reach - widest) / WIDTH), MOST_BINS);
  if (d->bins < 1) d->bins = 1;
  for (int i = 0; i < m->n_species; i++)
    for (int j = i; j < m->n_species; j++) {
      int q = gg_pair(i, j);
      d->sigma[q] = m->sigma[q];
      d->near[q] = gg_measure_contact_setup(m, d->sigma[q], reach);
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
  ((pair_correlation *)self)->since.known = 0;
}

static size_t bins(const void *self)
{
  const pair_correlation *d = self;
  return (size_t)(d->n_pairs * (d->bins + GG_NEAR_WIDTH)) + EXTRA;
}

typedef struct counting {
  const pair_correlation *d;
  const gg_snapshot *s;
  double *bin;
} counting;

GG_INLINE void count(void *context, uint32_t one, uint32_t two, gg_vec separation, double square, double weight)
{
  const counting *c = context;
  const pair_correlation *d = c->d;
  const gg_snapshot *s = c->s;
  size_t i = d->pairs.grain[one], j = d->pairs.grain[two];
  int q = gg_pair(gg_snapshot_species(s, i), gg_snapshot_species(s, j));
  double gap = sqrt(square) - d->sigma[q], at = gap * (1 / WIDTH);
  if (at < d->bins && at > -0.01)
    c->bin[q * d->bins + (int)fmax(at, 0)] += weight; /* an overlap by rounding is a contact */
  if (gap > d->near[q].reach) return;
  gg_vec g = {s->c[0][j] - s->c[0][i] + d->model.shear_rate * separation.y, s->c[1][j] - s->c[1][i],
              s->c[2][j] - s->c[2][i]};
  gg_measure_contact_count(&d->near[q], c->bin + d->n_pairs * d->bins + q * GG_NEAR_WIDTH, separation, square, g,
                           d->speed[q], weight);
}

/* Of each species; returns that of all, sum C^2/(3N). */
static double take_temperatures(pair_correlation *d, const gg_snapshot *s)
{
  double energy[GG_MAX_SPECIES] = {0}, all = 0;
  for (size_t i = 0; i < s->n; i++)
    energy[gg_snapshot_species(s, i)] += s->c[0][i] * s->c[0][i] + s->c[1][i] * s->c[1][i] + s->c[2][i] * s->c[2][i];
  for (int i = 0; i < d->model.n_species; i++) {
    all += energy[i];
    for (int j = i; j < d->model.n_species; j++) {
      double T = energy[i] / (3 * (double)d->model.n_of[i]) + energy[j] / (3 * (double)d->model.n_of[j]);
      d->speed[gg_pair(i, j)] = sqrt(2 * T / M_PI);
    }
  }
  return all / (3 * (double)s->n);
}

static void add_snapshot(void *self, const gg_snapshot *s, double *bin)
{
  pair_correlation *d = self;
  counting c = {d, s, bin};
  gg_images box = gg_measure_pairs_images(s);
  double *extra = bin + d->n_pairs * (d->bins + GG_NEAR_WIDTH);
  extra[TEMPERATURE] += take_temperatures(d, s);
  gg_measure_pairs_sort(&d->pairs, s, &box);
  gg_pairs_each(&d->pairs, s, &box, count, &c);
  extra[SNAPSHOTS]++;
  if (d->since.known) {
    extra[COLLISIONS] += (double)(s->collisions - d->since.collisions);
    extra[TIME] += s->time - d->since.time;
  }
  d->since = (struct since){s->time, s->collisions, 1};
}

/* The rate counts pairs of a grain with the N - 1 others. */
static void put_rate(const pair_correlation *d, gg_curve *c, const double *extra, double speed)
{
  const gg_model *m = &d->model;
  if (m->n_species > 1 || !gg_model_keeps_temperature(m)) return;
  double rate = 2 * extra[COLLISIONS] / ((double)m->n * extra[TIME]), T = extra[TEMPERATURE] / extra[SNAPSHOTS];
  double others = (double)(m->n - 1) / m->volume, value = rate / (4 * others * sqrt(M_PI * T));
  gg_measure_curve_put_number(c, "contact_value_of_rate", value, "1");
  gg_measure_curve_put_number(c, "contact_value_of_flux", value / speed, "1");
}

/* In equilibrium motion reversed is as likely, and all pairs are alike. */
static void put_contact(const pair_correlation *d, int q, gg_curve *c, const double *bin, double pairs, double samples)
{
  const gg_model *m = &d->model;
  const double *near = bin + d->n_pairs * d->bins + q * GG_NEAR_WIDTH;
  gg_contact_density g = gg_measure_contact_estimate(&d->near[q], near, pairs / m->volume, samples);
  double all = gg_flow_of(m->flow)->conserves ? g.alike : 0.5 * (g.approaching + g.parting);
  gg_measure_curve_put_number(c, "contact_value", all, "1");
  gg_measure_curve_put_number(c, "contact_value_before", g.approaching, "1");
  gg_measure_curve_put_number(c, "contact_value_after", g.parting, "1");
  gg_measure_curve_put_number(c, "approach_speed", g.speed, "1");
  put_rate(d, c, bin + d->n_pairs * (d->bins + GG_NEAR_WIDTH), g.speed);
}

static void curves(const void *self, const double *bin, gg_curves *list)
{
  const pair_correlation *d = self;
  const gg_model *m = &d->model;
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
      if (c->n) put_contact(d, q, c, bin, pairs, (double)list->samples);
    }
}

const gg_observable gg_measure_pair_correlation = {
    GG_OBSERVABLE(PAIR_CORRELATION, pair_correlation),
    .create = create,
    .destroy = destroy,
    .memory = memory,
    .refuses = gg_measure_needs_bulk,
    .bins = bins,
    .every = 5,
    .positions = true,
    .add_snapshot = add_snapshot,
    .restart = restart,
    .curves = curves,
};
