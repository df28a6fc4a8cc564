/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The distribution of the normal relative speed g_n of collisions, on which a law of restitution e(g) depends.
 *
 * Under molecular chaos of Maxwellian velocities a pair of species i, j collides at g_n with the density g_n/s^2
 * exp(-g_n^2/(2 s^2)), s^2 = T_i/m_i + T_j/m_j (Chapman & Cowling 1970, 5.2: one factor of g_n is the flux). With x
 * = g_n sqrt(2)/s, which is g_n/sqrt(T) for one species of unit mass, that is x/2 exp(-x^2/4) for every pair, and
 * all are counted together. The temperatures are those of the previous snapshot; if the gas cools or heats up, they
 * are assumed to change at the same rate per collision as before it. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "measure/observable.h"

enum { BINS = 80, COUNT = BINS, SUM, SQUARES, WIDTH_OF_ALL };
#define WIDTH 0.1

/* Data to keep if a run is stopped within an interval. */
typedef struct state {
  double over_m[GG_MAX_SPECIES]; /* T_i/m_i of the last snapshot; 0: none yet */
  double total, collisions;      /* its sum over all grains; collisions since */
  double fall;                   /* of ln T a collision; NaN: unknown */
  double sums[WIDTH_OF_ALL];     /* since the last snapshot */
} state;

typedef struct impact_speed {
  const gg_model *model;
  state state;
} impact_speed;

static const char *refuses(const gg_model *m)
{
  if (m->linear_response) return "its temperature rises and falls";
  return gg_measure_needs_homogeneity(m);
}

static void *create(const gg_model *m, gg_error *err)
{
  impact_speed *d = gg_base_array_new(1, sizeof *d, err);
  if (d) d->model = m;
  return d;
}

static size_t bins(const void *self)
{
  (void)self;
  return WIDTH_OF_ALL;
}

static void *memory(void *self, size_t *bytes)
{
  impact_speed *d = self;
  *bytes = sizeof d->state;
  return &d->state;
}

static void add_collision(void *self, const gg_collision_record *c)
{
  state *s = &((impact_speed *)self)->state;
  double unit2 = 0.5 * (s->over_m[c->species[0]] + s->over_m[c->species[1]]) * exp(-s->fall * s->collisions);
  s->collisions++;
  if (!(unit2 > 0)) return;
  double x = gg_dot(c->k, c->c12) / sqrt(unit2), at = x / WIDTH;
  if (at >= 0 && at < BINS) s->sums[(int)at]++;
  s->sums[COUNT]++;
  s->sums[SUM] += x;
  s->sums[SQUARES] += x * x;
}

/* T_i/m_i, and the sum of C^2 over all grains. */
static double take_temperatures(const gg_model *m, const gg_snapshot *g, double *over_m)
{
  double total = 0;
  for (int i = 0; i < m->n_species; i++) over_m[i] = 0;
  for (size_t i = 0; i < g->n; i++) {
    double cc = g->c[0][i] * g->c[0][i] + g->c[1][i] * g->c[1][i] + g->c[2][i] * g->c[2][i];
    over_m[gg_snapshot_species(g, i)] += cc / 3;
    total += cc;
  }
  for (int i = 0; i < m->n_species; i++) over_m[i] /= (double)m->n_of[i];
  return total;
}

static void add_snapshot(void *self, const gg_snapshot *g, double *bin)
{
  impact_speed *d = self;
  state *s = &d->state;
  for (int i = 0; i < WIDTH_OF_ALL; i++) bin[i] += s->sums[i];
  memset(s->sums, 0, sizeof s->sums);
  double before = s->total;
  s->total = take_temperatures(d->model, g, s->over_m);
  bool lasts = d->model->steady && !gg_flow_cools(d->model->flow);
  s->fall = lasts ? 0 : before > 0 && s->collisions > 0 ? log(before / s->total) / s->collisions : NAN;
  s->collisions = 0;
}

/* Called also when averaging begins. */
static void begin_burst(void *self)
{
  state *s = &((impact_speed *)self)->state;
  memset(s, 0, sizeof *s);
}

static void rescaled(void *self, double factor)
{
  impact_speed *d = self;
  for (int i = 0; i < d->model->n_species; i++) d->state.over_m[i] *= factor * factor;
  d->state.total *= factor * factor;
}

static double maxwellian(double x, const double *none)
{
  (void)none;
  return 0.5 * x * exp(-0.25 * x * x);
}

static void curves(const void *self, const double *bin, gg_curves *list)
{
  const bool mixture = ((const impact_speed *)self)->model->n_species > 1;
  gg_curve *c = gg_measure_curve_add(list, BINS, "impact_speed", "normal speed at impact", "");
  gg_measure_curve_axes(c, mixture ? "√2 g_n/s" : "g_n/√T", "1", "P", "1");
  for (int i = 0; i < (int)c->n; i++) {
    c->x[i] = (i + 0.5) * WIDTH;
    c->value[i] = bin[i] / (bin[COUNT] * WIDTH);
  }
  gg_measure_curve_beside(c, "Maxwellian gas", maxwellian, NULL);
  gg_measure_curve_put_number(c, "mean_impact_speed", bin[SUM] / bin[COUNT], "1");
  gg_measure_curve_put_number(c, "mean_square_impact_speed", bin[SQUARES] / bin[COUNT], "1");
}

const gg_observable gg_measure_impact_speed = {
    GG_OBSERVABLE(IMPACT_SPEED, impact_speed),
    .refuses = refuses,
    .create = create,
    .destroy = free,
    .memory = memory,
    .rescaled = rescaled,
    .restart = begin_burst,
    .curves = &(const gg_observable_curves){.bins = bins, .every = 1, .add_snapshot = add_snapshot, .of_bins = curves},
    .collisions = &(const gg_observable_collisions){.add = add_collision, .begin_burst = begin_burst},
    .cost = {.ns = {13, 6}},
};
