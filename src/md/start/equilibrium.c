/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Start at positions of a fluid in equilibrium. Grains that were pushed apart (place.c) are close to each other, and
 * collide several times as often as Enskog's rate for about half a collision a grain. If a run measures curves in time,
 * elastic spheres of the same diameters and of one mass first collide at these positions; then their positions are
 * taken over, and velocities are drawn. */
#include <math.h>
#include <stdlib.h>

#include "base/memory.h"
#include "common/rng.h"
#include "md/start/start.h"

enum {
  DIAMETERS = 20, /* longest time in diameters at thermal speed: dilute grains that far apart do not meet again */
  MOST_COLLISIONS = 1000 /* a grain */
};

/* Collisions a grain after which the collision rate is Enskog's within 3 %: 12 are enough at phi = 0.3, 50 at 0.45, 100
 * at 0.49; a glass needs several hundred. */
static double collisions_needed(double phi)
{
  const double room = 1 - phi / 0.6;
  return fmin(5 / (room * room), MOST_COLLISIONS);
}

bool gg_md_starts_in_equilibrium(const gg_model *m)
{
  const gg_flow_frame frame = gg_flow_of(m->flow)->frame;
  if (m->lattice || m->start) return false; /* positions are given */
  return frame == GG_CENTRE_OF_MASS || frame == GG_COOLING_FRAME;
}

static void make_elastic(gg_model *m)
{
  m->flow = GG_EQUILIBRIUM;
  m->thermostat = GG_NO_THERMOSTAT;
  m->bath = (gg_bath){0}, m->turns = false;
  m->law = (gg_restitution_law){0};
  m->by_speed = (gg_speed_laws){0};
  m->extension = NULL;
  m->rule = GG_SMOOTH;
  m->elastic = m->elastic_grains = true;
  m->wave = 0;
  m->contact_time = 0;
  m->temperature0 = 0.5;
  for (int i = 0; i < m->n_species; i++) m->mass[i] = 1;
  for (int i = 0; i < m->n_species; i++)
    for (int j = 0; j < m->n_species; j++) {
      m->contact[i][j] = gg_common_contact_make((gg_partner){1, 1}, (gg_partner){1, 1}, 1, -1, INFINITY);
      m->e[gg_pair(i, j)] = 1, m->beta[gg_pair(i, j)] = -1, m->mu[gg_pair(i, j)] = INFINITY;
    }
}

typedef struct places {
  double *r;
  int *species;
} places;

static void take(void *context, const gg_chunk *chunk)
{
  const places *p = context;
  for (size_t k = 0; k < chunk->n; k++) {
    p->species[chunk->id[k]] = chunk->species ? chunk->species[k] : 0;
    for (int a = 0; a < 3; a++) p->r[3 * chunk->id[k] + a] = chunk->r[a][k];
  }
}

static gg_status melt(const gg_engine_ops *md, const gg_model *elastic, uint64_t seed, uint64_t stream, places *p,
                      gg_error *err)
{
  gg_engine *engine;
  double elapsed;
  GG_TRY(md->create(elastic, seed, stream, &engine, err));
  md->threads(engine, elastic->threads);
  const double time = DIAMETERS * gg_common_model_widest(elastic) / sqrt(elastic->temperature0);
  const uint64_t collisions = (uint64_t)ceil(collisions_needed(elastic->phi) * (double)elastic->n / 2);
  gg_status status = md->advance(engine, time, collisions, &elapsed, err);
  /* Separate the two grains that collided last. */
  const double apart = 1e-3 / gg_common_model_collision_rate(elastic, elastic->temperature0);
  if (status == GG_OK) status = md->advance(engine, apart, UINT64_MAX, &elapsed, err);
  if (status == GG_OK) md->snapshot(engine, true, take, p);
  md->destroy(engine);
  return status;
}

gg_status gg_md_create_in_equilibrium(const gg_engine_ops *md, const gg_model *model, uint64_t seed, uint64_t stream,
                                      const gg_grain_arrays *motion, gg_engine **engine, gg_error *err)
{
  gg_grain_arrays start = motion ? *motion : (gg_grain_arrays){0};
  gg_model *elastic = gg_base_array_new(1, sizeof *elastic, err);
  places p = {gg_base_array_new(3 * (size_t)model->n, sizeof *p.r, err),
              gg_base_array_new((size_t)model->n, sizeof *p.species, err)};
  gg_status status = elastic && p.r && p.species ? GG_OK : GG_FAILED;
  if (status == GG_OK) {
    *elastic = *model;
    make_elastic(elastic);
    status = melt(md, elastic, seed, stream + GG_STREAM_PLACES, &p, err);
  }
  start.r = p.r, start.species = p.species;
  if (status == GG_OK) status = md->create_with(model, seed, stream, &start, NULL, engine, err);
  free(p.r);
  free(p.species);
  free(elastic);
  return status;
}
