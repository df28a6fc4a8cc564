/* Pair correlation g_ij(r) = V/(N_i N_j) <sum delta(r - r_ij)>/(4 pi r^2) from contact outwards, averaged over
 * directions; its value at contact by extrapolation, ln g taken as quadratic in the gap; and the contact value that the
 * collision rate of one species asks for if velocities at contact are uncorrelated, rate/(4 n d^2 sqrt(pi T)). */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include <gsl/gsl_multifit.h>

#include "measure/needs.h"
#include "measure/observable.h"
#include "measure/pairs.h"

enum { MOST_BINS = 160, FIT_BINS = 10 };
#define WIDTH 0.025
/* Pairs a grain and snapshot, and how fast they become fewer with distance: most is asked of contact. */
#define TRIES 50
#define FALL 4.0

typedef struct pair_correlation {
  gg_model model;
  gg_pairs pairs;
  int bins;               /* of each g_ij */
  double sigma[GG_PAIRS]; /* where they begin */
  struct since {          /* of the snapshot before: plain bytes */
    double time;
    uint64_t collisions, known;
  } since;
} pair_correlation;

enum { COLLISIONS, TIME, TEMPERATURE, SNAPSHOTS, EXTRA }; /* behind the bins */

static void destroy(void *self)
{
  gg_pairs_clear(&((pair_correlation *)self)->pairs);
  free(self);
}

static void *create(const gg_model *m, gg_error *err)
{
  pair_correlation *d = gg_new_array(1, sizeof *d, err);
  if (!d) return NULL;
  d->model = *m;
  double widest = fmax(m->sigma[0], m->sigma[3]), reach = gg_pairs_longest_reach(m);
  d->bins = (int)fmin(floor((reach - widest) / WIDTH), MOST_BINS);
  if (d->bins < 1) d->bins = 1;
  for (int i = 0; i < m->n_species; i++)
    for (int j = i; j < m->n_species; j++) d->sigma[gg_pair_index(i, j)] = m->sigma[2 * i + j];
  if (gg_pairs_init(&d->pairs, m, fmin(reach, widest + d->bins * WIDTH), TRIES, FALL, err) == GG_OK) return d;
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
  return (size_t)(GG_PAIRS * d->bins) + EXTRA;
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
  const uint32_t *grain = c->d->pairs.grain;
  int q = gg_pair_index(gg_snapshot_species(c->s, grain[one]), gg_snapshot_species(c->s, grain[two]));
  double at = (sqrt(square) - c->d->sigma[q]) * (1 / WIDTH);
  if (at < c->d->bins && at > -0.01)
    c->bin[q * c->d->bins + (int)fmax(at, 0)] += weight; /* an overlap by rounding is a contact */
}

static void add_snapshot(void *self, const gg_snapshot *s, double *bin)
{
  pair_correlation *d = self;
  counting c = {d, s, bin};
  gg_images box = gg_images_of(s);
  gg_pairs_sort(&d->pairs, s, &box);
  gg_pairs_each(&d->pairs, s, &box, count, &c);
  double *extra = bin + GG_PAIRS * d->bins, energy = 0;
  for (size_t i = 0; i < s->n; i++)
    energy += s->c[0][i] * s->c[0][i] + s->c[1][i] * s->c[1][i] + s->c[2][i] * s->c[2][i];
  extra[TEMPERATURE] += energy / (3 * (double)s->n);
  extra[SNAPSHOTS]++;
  if (d->since.known) {
    extra[COLLISIONS] += (double)(s->collisions - d->since.collisions);
    extra[TIME] += s->time - d->since.time;
  }
  d->since = (struct since){s->time, s->collisions, 1};
}

/* g at the gap 0: ln g = a + b x + c x^2 by least squares, weighted by counts. NaN where there were too few pairs. */
static double extrapolate(const double *g, const double *counts, int n)
{
  gsl_matrix *X = gsl_matrix_alloc((size_t)n, 3), *cov = gsl_matrix_alloc(3, 3);
  gsl_vector *y = gsl_vector_alloc((size_t)n), *w = gsl_vector_alloc((size_t)n), *c = gsl_vector_alloc(3);
  gsl_multifit_linear_workspace *work = gsl_multifit_linear_alloc((size_t)n, 3);
  double value = NAN, chi2;
  bool enough = X && cov && y && w && c && work;
  for (int i = 0; enough && i < n; i++) {
    double x = (i + 0.5) * WIDTH;
    if (!(counts[i] > 1)) enough = false;
    for (int k = 0; k < 3; k++) gsl_matrix_set(X, (size_t)i, (size_t)k, pow(x, k));
    gsl_vector_set(y, (size_t)i, log(g[i]));
    gsl_vector_set(w, (size_t)i, counts[i]);
  }
  if (enough && gsl_multifit_wlinear(X, w, y, c, cov, &chi2, work) == 0) value = exp(gsl_vector_get(c, 0));
  gsl_multifit_linear_free(work);
  gsl_vector_free(c);
  gsl_vector_free(w);
  gsl_vector_free(y);
  gsl_matrix_free(cov);
  gsl_matrix_free(X);
  return value;
}

static void put_contact(const pair_correlation *d, gg_curve *c, const double *bin, const double *extra, double samples)
{
  const gg_model *m = &d->model;
  double counts[FIT_BINS];
  int n = d->bins < FIT_BINS ? d->bins : FIT_BINS;
  for (int i = 0; i < n; i++) counts[i] = bin[i] * samples;
  gg_curve_put_number(c, "contact_value", n > 4 ? extrapolate(c->value, counts, n) : NAN, "1");
  if (m->n_species > 1 || m->flow == GG_HCS || !m->steady) return;
  double rate = 2 * extra[COLLISIONS] / ((double)m->n * extra[TIME]), T = extra[TEMPERATURE] / extra[SNAPSHOTS];
  gg_curve_put_number(c, "contact_value_of_rate", rate / (4 * m->density * sqrt(M_PI * T)), "1");
}

static void curves(const void *self, const double *bin, gg_curves *list)
{
  const pair_correlation *d = self;
  const gg_model *m = &d->model;
  const double *extra = bin + GG_PAIRS * d->bins;
  for (int i = 0; i < m->n_species; i++)
    for (int j = i; j < m->n_species; j++) {
      int q = gg_pair_index(i, j);
      char name[48] = "pair_correlation", label[24] = "g";
      if (m->n_species > 1) {
        snprintf(name, sizeof name, "pair_correlation_%d%d", i + 1, j + 1);
        snprintf(label, sizeof label, "g_{%d%d}", i + 1, j + 1);
      }
      double a = (double)m->n_of[i], b = (double)m->n_of[j], pairs = i == j ? a * (a - 1) / 2 : a * b;
      gg_curve *c = gg_curve_add(list, (size_t)d->bins, name, "pair correlation", label);
      gg_curve_axes(c, "r", gg_curve_unit(m, "length"), "g", "1");
      for (size_t k = 0; k < c->n; k++) {
        double from = d->sigma[q] + (double)k * WIDTH, to = from + WIDTH;
        double shell = 4.0 / 3 * M_PI * (to * to * to - from * from * from);
        c->x[k] = from + WIDTH / 2;
        c->value[k] = bin[(size_t)(q * d->bins) + k] / (pairs * shell / m->volume);
      }
      gg_curve_beside(c, "ideal gas", gg_level, &(double){1});
      if (c->n) put_contact(d, c, bin + q * d->bins, extra, (double)list->samples);
    }
}

const gg_observable gg_pair_correlation = {
    GG_OBSERVABLE(PAIR_CORRELATION, pair_correlation),
    .create = create,
    .destroy = destroy,
    .memory = memory,
    .refuses = gg_needs_bulk,
    .bins = bins,
    .every = 4,
    .positions = true,
    .add_snapshot = add_snapshot,
    .restart = restart,
    .curves = curves,
};
