/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "common/engine_grains.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"

void gg_common_engine_grains_clear(gg_engine_grains *g)
{
  free(g->number);
  free(g->species);
}

gg_status gg_common_engine_grains_make(gg_engine_grains *g, size_t n, gg_error *err)
{
  g->number = gg_base_array_new(9 * n, sizeof *g->number, err);
  g->species = gg_base_array_new(n, sizeof *g->species, err);
  return g->number && g->species ? GG_OK : GG_FAILED;
}

/* Copying of grains, for a gg_visit; md's grains are stored at their number. */
typedef struct copying {
  double *r, *c, *s; /* NULL: not wanted */
  int *species;
  double velocity_unit, spin_unit[GG_MAX_SPECIES];
  size_t at;
} copying;

static void copy(void *context, const gg_chunk *chunk)
{
  copying *to = context;
  for (size_t i = 0; i < chunk->n; i++, to->at++) {
    const size_t place = chunk->id ? (size_t)chunk->id[i] : to->at;
    const int species = chunk->species ? chunk->species[i] : 0;
    if (to->species) to->species[place] = species;
    for (size_t a = 0; a < 3; a++) {
      if (to->r && chunk->r[a]) to->r[3 * place + a] = chunk->r[a][i];
      if (to->c) to->c[3 * place + a] = chunk->c[a][i] * to->velocity_unit;
      if (to->s) to->s[3 * place + a] = chunk->s[0] ? chunk->s[a][i] * to->spin_unit[species] : 0;
    }
  }
}

void gg_common_engine_grains_copy(gg_engine *engine, const gg_model *m, double unit, double *r, double *c, double *s,
                                  int *species)
{
  copying to = {.r = r, .c = c, .s = s, .species = species, .velocity_unit = unit};
  for (int i = 0; i < GG_MAX_SPECIES; i++) to.spin_unit[i] = unit * (m->boltzmann ? 1 : 2 / m->diameter[i]);
  engine->ops->snapshot(engine, !m->homogeneous, copy, &to);
}

void gg_common_engine_grains_read(gg_engine *engine, const gg_model *model, gg_engine_grains *g)
{
  double *r = model->homogeneous ? NULL : g->number, *c = g->number + 3 * model->n, *s = c + 3 * model->n;
  copying to = {.r = r, .c = c, .s = s, .species = g->species, .velocity_unit = 1};
  for (int i = 0; i < GG_MAX_SPECIES; i++) to.spin_unit[i] = 1;
  engine->ops->snapshot(engine, !model->homogeneous, copy, &to);
  g->grains = (gg_grain_arrays){r, c, s, g->species};
}

void gg_common_engine_grains_take(const gg_model *m, const gg_grain_arrays *g, double unit, gg_engine_grains *a)
{
  const size_t n = (size_t)m->n;
  double *r = a->number, *c = r + 3 * n, *s = c + 3 * n;
  for (size_t i = 0; g->species && i < n; i++) a->species[i] = g->species[i];
  for (size_t i = 0; i < 3 * n; i++) {
    const bool end = g->r && g->r[i] == m->box[i % 3] && !gg_common_surface_is_closed(m, (int)(i % 3));
    if (g->r) r[i] = end ? 0 : g->r[i];
    if (g->c) c[i] = g->c[i] / unit;
    if (g->s) s[i] = g->s[i] / (unit * (m->boltzmann ? 1 : 2 / m->diameter[a->species[i / 3]]));
  }
}

bool gg_common_is_same_gas(const gg_model *a, const gg_model *b)
{
  bool same = a->flow == b->flow && a->n == b->n && a->n_species == b->n_species && a->boltzmann == b->boltzmann &&
              (a->rule == GG_SMOOTH) == (b->rule == GG_SMOOTH) && a->stress_unit == b->stress_unit &&
              a->volume == b->volume;
  for (int k = 0; same && k < a->n_species; k++)
    same = a->n_of[k] == b->n_of[k] && a->mass[k] == b->mass[k] && a->diameter[k] == b->diameter[k] &&
           a->inertia[k] == b->inertia[k];
  for (int k = 0; same && k < 3; k++) same = a->box[k] == b->box[k];
  return same;
}

gg_status gg_common_engine_continue(gg_engine *engine, const gg_model *model, gg_engine **next, gg_error *err)
{
  gg_engine_grains g = {0};
  gg_status status = gg_common_engine_grains_make(&g, (size_t)model->n, err);
  if (status == GG_OK) {
    gg_common_engine_grains_read(engine, model, &g);
    status = engine->ops->create_with(model, 0, 0, &g.grains, engine, next, err);
  }
  gg_common_engine_grains_clear(&g);
  return status;
}

/* Fourth powers of larger numbers overflow. */
#define LARGEST 1e75

static gg_status check_numbers(const char *what, const double *x, size_t n, gg_error *err)
{
  for (size_t i = 0; x && i < 3 * n; i++)
    if (!(fabs(x[i]) < LARGEST))
      return gg_base_fail(err, GG_BAD_INPUT, "%s of grain %zu: %g along %c; allowed: numbers below %g", what, i / 3,
                          x[i], "xyz"[i % 3], LARGEST);
  return GG_OK;
}

static gg_status check_places(const gg_model *m, const double *r, size_t n, gg_error *err)
{
  const bool open = gg_common_surface_is_open_above(m);
  for (size_t i = 0; r && i < 3 * n; i++) {
    const size_t a = i % 3;
    if (r[i] >= 0 && (r[i] <= m->box[a] || (open && a == 1))) continue;
    return gg_base_fail(err, GG_BAD_INPUT,
                        "position of grain %zu: %.9g along %c is outside the box; allowed: 0 to %.9g", i / 3, r[i],
                        "xyz"[a], m -> box[a]);
  }
  return GG_OK;
}

static gg_status check_species(const gg_model *m, const int *species, gg_error *err)
{
  int64_t of[GG_MAX_SPECIES] = {0};
  for (int64_t i = 0; i < m->n; i++) {
    if (species[i] < 0 || species[i] >= m->n_species)
      return gg_base_fail(err, GG_BAD_INPUT, "species of grain %lld: %d; allowed: 0 to %d", (long long)i, species[i],
                          m->n_species - 1);
    of[species[i]]++;
  }
  for (int k = 0; k < m->n_species; k++)
    if (of[k] != m->n_of[k])
      return gg_base_fail(err, GG_BAD_INPUT, "species %d has %lld grains; the scene's fractions make it %lld", k,
                          (long long)of[k], (long long)m->n_of[k]);
  return GG_OK;
}

static gg_status check_spins(const gg_model *m, const double *spin, size_t n, gg_error *err)
{
  for (size_t i = 0; spin && m->rule == GG_SMOOTH && i < 3 * n; i++)
    if (spin[i] != 0)
      return gg_base_fail(err, GG_BAD_INPUT, "spin of grain %zu: %g; smooth grains do not rotate: give 0, or NULL",
                          i / 3, spin[i]);
  return GG_OK;
}

gg_status gg_common_grains_check(const gg_model *m, const gg_grain_arrays *g, size_t n, gg_error *err)
{
  if (n != (size_t)m->n)
    return gg_base_fail(err, GG_BAD_INPUT, "%zu grains; the scene has %lld (%s)", n, (long long)m->n,
                        m->homogeneous ? "dsmc.particles" : "particles");
  if (g->r && m->homogeneous)
    return gg_base_fail(err, GG_BAD_INPUT, "dsmc is spatially homogeneous: it takes no positions");
  GG_TRY(check_numbers("position", g->r, n, err));
  GG_TRY(check_numbers("velocity", g->c, n, err));
  GG_TRY(check_numbers("spin", g->s, n, err));
  GG_TRY(check_places(m, g->r, n, err));
  GG_TRY(check_spins(m, g->s, n, err));
  return g->species ? check_species(m, g->species, err) : GG_OK;
}

/* Hash of a state, to compare trajectories. Each bit of a word changes half of the bits of the hash on average: the
 * finaliser of MurmurHash3 (A. Appleby, public domain). */
static uint64_t with_word(uint64_t hash, uint64_t word)
{
  hash = (hash ^ word) + 0x9e3779b97f4a7c15u;
  hash = (hash ^ hash >> 33) * 0xff51afd7ed558ccdu;
  hash = (hash ^ hash >> 33) * 0xc4ceb9fe1a85ec53u;
  return hash ^ hash >> 33;
}

static uint64_t with_numbers(uint64_t hash, const double *x, size_t n)
{
  for (size_t i = 0; i < n; i++) {
    uint64_t bits;
    memcpy(&bits, &x[i], sizeof bits);
    hash = with_word(hash, bits);
  }
  return hash;
}

uint64_t gg_common_grains_hash(uint64_t collisions, const gg_grain_arrays *grains, size_t n)
{
  uint64_t hash = with_word(0, collisions);
  if (grains->r) hash = with_numbers(hash, grains->r, 3 * n);
  hash = with_numbers(hash, grains->c, 3 * n);
  hash = with_numbers(hash, grains->s, 3 * n);
  for (size_t i = 0; i < n; i++) hash = with_word(hash, (uint64_t)grains->species[i]);
  return hash;
}

gg_status gg_common_positions_fit(const gg_model *m, size_t n, const double edges[9], double unit, double *r,
                                  int *species, gg_error *err)
{
  int64_t count[GG_MAX_SPECIES + 1] = {0};
  const double *e = edges, *box = m->box;
  const double lean = fabs(e[1]) + fabs(e[2]) + fabs(e[3]) + fabs(e[5]) + fabs(e[6]) + fabs(e[7]);
  if (n != (size_t)m->n)
    return gg_base_fail(err, GG_BAD_INPUT, "has %zu grains, the scene %lld (particles)", n, (long long)m->n);
  for (int a = 0; a < 3 && e[0] != 0; a++)
    if (!(fabs(e[4 * a] * unit - box[a]) <= 1e-6 * box[a] && lean * unit <= 1e-9 * box[0]))
      return gg_base_fail(err, GG_BAD_INPUT,
                          "its box is %g x %g x %g%s, the scene's %g x %g x %g (phi, particles, aspect)", e[0], e[4],
                          e[8], lean > 0 ? ", and leans" : "", box[0] / unit, box[1] / unit, box[2] / unit);
  for (size_t i = 0; i < n; i++) {
    if (m->n_species == 1) species[i] = 0;
    count[species[i] >= 0 && species[i] < GG_MAX_SPECIES ? species[i] : GG_MAX_SPECIES]++;
    for (int a = 0; a < 3; a++) {
      double *x = &r[3 * i + (size_t)a];
      *x *= unit;
      if (!gg_common_surface_is_closed(m, a)) *x -= box[a] * floor(*x / box[a]);
      if (!isfinite(*x)) return gg_base_fail(err, GG_BAD_INPUT, "the position of grain %zu is not finite", i);
    }
  }
  for (int k = 0; k < m->n_species; k++)
    if (count[k] != m->n_of[k])
      return gg_base_fail(err, GG_BAD_INPUT, "has %lld grains of species %d, the scene %lld", (long long)count[k],
                          k + 1, (long long)m->n_of[k]);
  return GG_OK;
}
