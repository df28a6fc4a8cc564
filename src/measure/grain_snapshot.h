/* SPDX-License-Identifier: GPL-3.0-or-later */
/* All grains at one instant, gathered from an engine's chunks: the input of observables of distributions, pairs and
 * fields. */
#ifndef GG_SNAPSHOT_H
#define GG_SNAPSHOT_H

#include "common/engine.h"

struct gg_local_frame;

typedef struct gg_snapshot {
  const gg_model *model;
  const struct gg_local_frame *frame; /* between walls: the frame of the flow (local_frame.h); else NULL */
  const struct gg_snapshot *whole;    /* if c and s are relative to cell means: the original snapshot; else NULL */
  size_t n;
  double *r[3], *c[3],
      *s[3];              /* positions in the box (NULL where not requested), peculiar velocities, spins (or NULL) */
  uint8_t *species;       /* NULL for one species */
  int64_t *id;            /* with positions; else NULL: the order itself is constant */
  double offset;          /* present displacement along x of the image of the box above (sheared flows) */
  double time;            /* the engine's, since its creation */
  double elapsed;         /* since the previous snapshot of the replica */
  uint64_t collisions;    /* of the engine, since its creation */
  double velocity_factor; /* factor on all velocities since the previous snapshot (1, but in free cooling) */
} gg_snapshot;

gg_status gg_measure_snapshot_init(gg_snapshot *s, const gg_model *model, bool positions, gg_error *err);
void gg_measure_snapshot_clear(gg_snapshot *s);
/* Fill it with the engine's present state. */
void gg_measure_snapshot_take(gg_snapshot *s, gg_engine *engine);

static inline int gg_snapshot_species(const gg_snapshot *s, size_t i)
{
  return s->species ? s->species[i] : 0;
}
/* Component a of omega of a grain, where s[a] is the surface velocity; and I = K m d^2/4 of a species. Means over
 * grains of several sizes use these: at one omega the surfaces of larger grains are faster. */
static inline double gg_snapshot_omega(const gg_snapshot *s, int a, size_t i)
{
  return s->s[a][i] * 2 / s->model->diameter[gg_snapshot_species(s, i)];
}
static inline double gg_moment_of_inertia(const gg_model *m, int species)
{
  return m->inertia[species] * m->mass[species] * m->diameter[species] * m->diameter[species] / 4;
}

/* Scratch for sorting the grains of a chunk by species, so that observables are written for one species only. */
typedef struct gg_species_scratch {
  double c[3][GG_CHUNK], s[3][GG_CHUNK];
} gg_species_scratch;

/* The grains of one species in the chunk: pointers into the chunk itself (one species) or into scratch. */
typedef struct gg_species_view {
  size_t n;
  const double *c[3], *s[3]; /* s[0] NULL without spins */
} gg_species_view;

gg_species_view gg_measure_species_chunk(const gg_chunk *chunk, int species, gg_species_scratch *scratch);

#endif
