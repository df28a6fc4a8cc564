/* Spatial velocity correlations G(r) = <zeta_a(R) zeta_b(R + r)>/<zeta_a^2>: C with C and Omega with Omega by
 * component, C_x with Omega_z (over the root of both), over all directions, and within half a diameter of the axes.
 * Without correlations G is a little below 0, for the total momentum is 0. Spins are about their mean, by species. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "measure/needs.h"
#include "measure/observable.h"
#include "measure/pairs.h"

enum { MOST_BINS = 60, RADIAL_WIDTH = 8, AXIS_WIDTH = 4 };
/* Radial: count, C_a C_a, W_a W_a, C_x W_z. Along each axis: count, C_x C_x, W_z W_z, C_x W_z. Behind: sums of squares.
 */
enum { COUNT, CC, WW = CC + 3, CW = WW + 3 };
enum { AXIS_CC = 1, AXIS_WW, AXIS_CW };
enum { SQUARES = 7 }; /* grains, C_a^2, Omega_a^2 */
#define SPACING 0.25
#define TUBE 0.5

typedef struct correlations {
  gg_model model;
  gg_pairs pairs;
  int bins;
  double *spin[3]; /* about the mean */
} correlations;

static void destroy(void *self)
{
  correlations *d = self;
  gg_pairs_clear(&d->pairs);
  for (int a = 0; a < 3; a++) free(d->spin[a]);
  free(d);
}

static void *create(const gg_model *m, gg_error *err)
{
  correlations *d = gg_new_array(1, sizeof *d, err);
  if (!d) return NULL;
  d->model = *m;
  double reach = gg_pairs_longest_reach(m);
  d->bins = (int)fmin(floor(reach / SPACING), MOST_BINS);
  bool whole = gg_pairs_init(&d->pairs, m, d->bins * SPACING, err) == GG_OK;
  for (int a = 0; a < 3 && whole && m->rule != GG_SMOOTH; a++)
    if (!(d->spin[a] = gg_new_array((size_t)m->n, sizeof(double), err))) whole = false;
  if (whole) return d;
  destroy(d);
  return NULL;
}

static size_t bins(const void *self)
{
  return (size_t)((const correlations *)self)->bins * (RADIAL_WIDTH + 3 * AXIS_WIDTH) + SQUARES;
}

typedef struct summing {
  const correlations *d;
  const gg_snapshot *s;
  double *bin;
} summing;

GG_INLINE void add_along(const summing *c, double *bin, size_t i, size_t j)
{
  double *const *v = c->s->c, *const *w = c->d->spin;
  bin[COUNT]++;
  bin[AXIS_CC] += v[0][i] * v[0][j];
  if (!w[0]) return;
  bin[AXIS_WW] += w[2][i] * w[2][j];
  bin[AXIS_CW] += 0.5 * (v[0][i] * w[2][j] + v[0][j] * w[2][i]);
}

GG_INLINE void add_pair(void *context, size_t i, size_t j, gg_vec r, double square)
{
  const summing *c = context;
  double *const *v = c->s->c, *const *w = c->d->spin;
  int k = (int)(sqrt(square) * (1 / SPACING));
  if (k >= c->d->bins) return;
  double *bin = c->bin + k * RADIAL_WIDTH;
  bin[COUNT]++;
  for (int a = 0; a < 3; a++) bin[CC + a] += v[a][i] * v[a][j];
  if (w[0]) {
    for (int a = 0; a < 3; a++) bin[WW + a] += w[a][i] * w[a][j];
    bin[CW] += 0.5 * (v[0][i] * w[2][j] + v[0][j] * w[2][i]);
  }
  const double along[3] = {r.x, r.y, r.z};
  for (int a = 0; a < 3; a++)
    if (square - along[a] * along[a] < TUBE * TUBE)
      add_along(c, c->bin + c->d->bins * (RADIAL_WIDTH + a * AXIS_WIDTH) + k * AXIS_WIDTH, i, j);
}

static void centre_spins(correlations *d, const gg_snapshot *s)
{
  for (int a = 0; a < 3; a++) {
    double sum[GG_MAX_SPECIES] = {0};
    for (size_t i = 0; i < s->n; i++) sum[gg_snapshot_species(s, i)] += s->s[a][i];
    for (size_t i = 0; i < s->n; i++) {
      int k = gg_snapshot_species(s, i);
      d->spin[a][i] = s->s[a][i] - sum[k] / (double)d->model.n_of[k];
    }
  }
}

static void add_snapshot(void *self, const gg_snapshot *s, double *bin)
{
  correlations *d = self;
  summing c = {d, s, bin};
  if (d->spin[0]) centre_spins(d, s);
  gg_pairs_each(&d->pairs, s, add_pair, &c);
  double *squares = bin + d->bins * (RADIAL_WIDTH + 3 * AXIS_WIDTH);
  squares[0] += (double)s->n;
  for (int a = 0; a < 3; a++)
    for (size_t i = 0; i < s->n; i++) {
      squares[1 + a] += s->c[a][i] * s->c[a][i];
      if (d->spin[0]) squares[4 + a] += d->spin[a][i] * d->spin[a][i];
    }
}

/* In equilibrium without momentum <C_i C_j> = -T/M for any two of total mass M, and <C_i^2> = T (1/m_i - 1/M): over all
 * pairs and grains -1/(M <1/m> - 1), which is -1/(N - 1) for one species. Spins, about their mean by species: that. */
static double of_no_momentum(const gg_model *m)
{
  double mass = 0, inverse = 0;
  for (int k = 0; k < m->n_species; k++) {
    mass += (double)m->n_of[k] * m->mass[k];
    inverse += (double)m->n_of[k] / m->mass[k] / (double)m->n;
  }
  return -1 / (mass * inverse - 1);
}

/* One curve from a channel of `width`-wide bins, from the first bin that can hold a pair. */
static void put(const correlations *d, gg_curves *list, const char *name, const char *panel, const char *label,
                const double *bin, int width, int channel, double norm)
{
  const gg_model *m = &d->model;
  int first = (int)(fmin(m->diameter[0], m->n_species > 1 ? m->diameter[1] : m->diameter[0]) / SPACING);
  if (d->bins <= first) return;
  gg_curve *c = gg_curve_add(list, (size_t)(d->bins - first), name, panel, label);
  gg_curve_axes(c, "r", gg_curve_unit(m, "length"), "G", "1");
  for (size_t i = 0; i < c->n; i++) {
    const double *at = bin + ((int)i + first) * width;
    c->x[i] = ((double)i + first + 0.5) * SPACING;
    c->value[i] = at[COUNT] > 0 ? at[channel] / (at[COUNT] * norm) : NAN;
  }
  double level = strstr(name, "CxW") ? 0 : strchr(name, 'W') ? -1 / ((double)m->n - 1) : of_no_momentum(m);
  gg_curve_beside(c, "uncorrelated", gg_level, &level);
}

static void put_radial(const correlations *d, const double *bin, const double *square, gg_curves *list)
{
  char name[48], label[24];
  bool spins = d->spin[0] != NULL;
  for (int vector = 0; vector < 1 + spins; vector++)
    for (int a = 0; a < 3; a++) {
      snprintf(name, sizeof name, "velocity_correlation_%s%c", vector ? "W" : "C", "xyz"[a]);
      snprintf(label, sizeof label, "%s_%c", vector ? "Ω" : "C", "xyz"[a]);
      put(d, list, name, vector ? "G_{ΩΩ}(r)" : "G_{CC}(r)", label, bin, RADIAL_WIDTH, (vector ? WW : CC) + a,
          square[3 * vector + a]);
    }
  if (spins)
    put(d, list, "velocity_correlation_CxWz", "G_{CΩ}(r)", "radial", bin, RADIAL_WIDTH, CW,
        sqrt(square[0] * square[5]));
}

static void curves(const void *self, const double *bin, gg_curves *list)
{
  const correlations *d = self;
  const double *sums = bin + d->bins * (RADIAL_WIDTH + 3 * AXIS_WIDTH);
  double square[6];
  for (int a = 0; a < 6; a++) square[a] = sums[1 + a] / sums[0];
  put_radial(d, bin, square, list);
  char name[48], label[24];
  for (int a = 0; a < 3; a++) {
    const double *along = bin + d->bins * (RADIAL_WIDTH + a * AXIS_WIDTH);
    snprintf(label, sizeof label, "along %c", "xyz"[a]);
    snprintf(name, sizeof name, "velocity_correlation_Cx_along_%c", "xyz"[a]);
    put(d, list, name, "G_{CC}^{xx} along axes", label, along, AXIS_WIDTH, AXIS_CC, square[0]);
    if (!d->spin[0]) continue;
    snprintf(name, sizeof name, "velocity_correlation_Wz_along_%c", "xyz"[a]);
    put(d, list, name, "G_{ΩΩ}^{zz} along axes", label, along, AXIS_WIDTH, AXIS_WW, square[5]);
    snprintf(name, sizeof name, "velocity_correlation_CxWz_along_%c", "xyz"[a]);
    put(d, list, name, "G_{CΩ}(r)", label, along, AXIS_WIDTH, AXIS_CW, sqrt(square[0] * square[5]));
  }
}

const gg_observable gg_velocity_correlations = {
    GG_OBSERVABLE(VELOCITY_CORRELATIONS, velocity_correlations),
    .create = create,
    .destroy = destroy,
    .refuses = gg_needs_bulk,
    .bins = bins,
    .every = 16,
    .positions = true,
    .add_snapshot = add_snapshot,
    .curves = curves,
};
