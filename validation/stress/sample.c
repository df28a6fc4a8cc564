/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "sample.h"

#include <math.h>
#include <stdlib.h>

#include "common/surface/shapes.h"

bool sample_new(sample *s, const gg_simulation *g)
{
  *s = (sample){.n = (size_t)g->model.n};
  s->velocity = malloc(3 * s->n * sizeof *s->velocity);
  s->spin = malloc(3 * s->n * sizeof *s->spin);
  s->species = malloc(s->n * sizeof *s->species);
  s->position = g->model.ensemble ? NULL : malloc(3 * s->n * sizeof *s->position);
  return s->velocity && s->spin && s->species && (s->position || g->model.ensemble);
}

void sample_free(sample *s)
{
  free(s->position);
  free(s->velocity);
  free(s->spin);
  free(s->species);
  *s = (sample){0};
}

static void add_grain(sample *s, const gg_model *model, size_t i)
{
  const int kind = s->species[i];
  const double m = model->mass[kind], K = model->inertia[kind], d = model->boltzmann ? 2 : model->diameter[kind];
  const double *c = s->velocity + 3 * i, *w = s->spin + 3 * i;
  double c2 = 0, s2 = 0;
  for (int a = 0; a < 3; a++) {
    s->momentum[a] += m * c[a];
    c2 += c[a] * c[a];
    s2 += 0.25 * d * d * w[a] * w[a];
    if (s->position && !isfinite(s->position[3 * i + (size_t)a])) s->numbers = false;
  }
  s->scale += m * sqrt(c2);
  s->translation += 0.5 * m * c2;
  s->rotation += 0.5 * K * m * s2;
  s->xy += m * c[0] * c[1];
  s->yy += m * c[1] * c[1];
  if (s->position) s->height += m * s->position[3 * i + 1];
}

void sample_take(sample *s, const gg_simulation *g)
{
  const gg_grains into = {s->position, s->velocity, s->spin, s->species};
  s->numbers =
      gg_simulation_get_state(g, &s->state, NULL) == GG_OK && gg_simulation_get_grains(g, &into, NULL) == GG_OK;
  for (int a = 0; a < 3; a++) s->momentum[a] = 0;
  s->scale = s->translation = s->rotation = s->height = s->xy = s->yy = 0;
  for (size_t i = 0; i < s->n; i++) add_grain(s, &g->model, i);
  if (!isfinite(s->translation + s->rotation + s->height + s->xy + s->state.time)) s->numbers = false;
}

/* Overlap of two grains, by the nearest image. */
static double overlap_of(const sample *s, const gg_simulation *g, size_t i, size_t j)
{
  const double *L = s->state.box, *a = s->position + 3 * i, *b = s->position + 3 * j;
  double r[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]};
  if (!g->model.walled) {
    const double layers = rint(r[1] / L[1]);
    r[1] -= layers * L[1];
    r[0] -= layers * s->state.image_offset;
  }
  const double sigma = g->model.sigma[gg_pair(s->species[i], s->species[j])];
  for (int x = 2; x >= 0; x -= 2) {
    r[x] -= L[x] * rint(r[x] / L[x]);
    if (fabs(r[x]) > sigma) return 0;
  }
  return 1 - sqrt(r[0] * r[0] + r[1] * r[1] + r[2] * r[2]) / sigma;
}

/* Columns along x, as wide as the widest grain or wider, so that only nine of them can be touched from one. */
typedef struct columns {
  size_t ny, nz, *first, *grain;
} columns;

static size_t column_of(const columns *c, const sample *s, size_t i)
{
  const double *r = s->position + 3 * i, *L = s->state.box;
  const double y = floor(r[1] / L[1] * (double)c->ny), z = floor(r[2] / L[2] * (double)c->nz);
  const double top = (double)c->ny - 1, back = (double)c->nz - 1;
  return (size_t)fmin(fmax(z, 0), back) * c->ny + (size_t)fmin(fmax(y, 0), top);
}

static bool make_columns(columns *c, const sample *s, const gg_simulation *g)
{
  const double width = fmax(1.01 * gg_common_model_widest(&g->model), cbrt(g->model.volume / (double)s->n));
  c->ny = (size_t)fmax(1, fmin(floor(s->state.box[1] / width), 1000));
  c->nz = (size_t)fmax(1, fmin(floor(s->state.box[2] / width), 1000));
  if (c->ny < 3) c->ny = 1;
  if (c->nz < 3) c->nz = 1;
  c->first = calloc(c->ny * c->nz + 2, sizeof *c->first);
  c->grain = malloc(s->n * sizeof *c->grain);
  if (!c->first || !c->grain) return false;
  for (size_t i = 0; i < s->n; i++) c->first[column_of(c, s, i) + 2]++;
  for (size_t k = 2; k < c->ny * c->nz + 2; k++) c->first[k] += c->first[k - 1];
  for (size_t i = 0; i < s->n; i++) c->grain[c->first[column_of(c, s, i) + 1]++] = i;
  return true;
}

static double worst_between(const columns *c, const sample *s, const gg_simulation *g, size_t one, size_t two)
{
  double worst = 0;
  for (size_t p = c->first[one]; p < c->first[one + 1]; p++)
    for (size_t q = c->first[two]; q < c->first[two + 1]; q++)
      if (c->grain[p] < c->grain[q]) worst = fmax(worst, overlap_of(s, g, c->grain[p], c->grain[q]));
  return worst;
}

double sample_overlap(const sample *s, const gg_simulation *g)
{
  columns c;
  double worst = 0;
  if (!s->position || !s->numbers) return NAN;
  if (!make_columns(&c, s, g)) worst = NAN;
  for (size_t one = 0; one < c.ny * c.nz && !isnan(worst); one++)
    for (size_t dz = 0; dz < (c.nz > 1 ? 3 : 1); dz++)
      for (size_t dy = 0; dy < (c.ny > 1 ? 3 : 1); dy++) {
        const size_t y = (one % c.ny + c.ny + dy - (c.ny > 1)) % c.ny, z = (one / c.ny + c.nz + dz - (c.nz > 1)) % c.nz;
        const double this = worst_between(&c, s, g, one, z * c.ny + y);
        worst = fmax(worst, this);
      }
  free(c.first);
  free(c.grain);
  return worst;
}

static bool is_outside(const sample *s, const gg_simulation *g, size_t i)
{
  const double *r = s->position + 3 * i, *L = s->state.box, room = 1e-12;
  const gg_vec place = {r[0], r[1], r[2]};
  const bool open = gg_flow_of(g->model.flow)->walls && g->model.n_surfaces == 1;
  for (int a = 0; a < 3; a++)
    if (r[a] < -room * L[a] || (r[a] > L[a] * (1 + room) && !(open && a == 1))) return true;
  for (int w = 0; w < g->model.n_surfaces; w++)
    if (!(gg_surface_clearance(&g->model.surface[w], &place, 0.5 * g->model.diameter[s->species[i]]) > -1e-11))
      return true;
  return false;
}

size_t sample_escapes(const sample *s, const gg_simulation *g)
{
  size_t escapes = 0;
  for (size_t i = 0; s->position && i < s->n; i++) escapes += is_outside(s, g, i);
  return escapes;
}
