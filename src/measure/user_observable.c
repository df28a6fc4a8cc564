/* SPDX-License-Identifier: GPL-3.0-or-later */
/* User-defined observables: every quantity is a channel, and its mean the channel's. Grains are arranged as whole
 * arrays, in the units of results, corrected for rescaled velocities. */
#include "measure/observable.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "graingas.h"

typedef double triple[3];

/* Data that one sample leaves for the next; the observables' states follow. */
typedef struct memory {
  double scale; /* engine's velocities over those of the start; for repeated sweeps of slow shear, of the start of the
                   sweep */
  double time;
} memory;

typedef struct own {
  const gg_model *model;
  memory *memory;
  size_t memory_bytes;
  triple *position, *velocity, *spin; /* NULL if there are none */
  uint8_t *species;
  size_t n; /* grains arranged so far */
} own;

static const gg_observable_definition *definition(const own *o, int k)
{
  return gg_common_extension_observable(o->model->extension, k);
}

/* Round up to an alignment for any type. */
static size_t rounded(size_t bytes)
{
  return (bytes + 15) / 16 * 16;
}

static void *state_of(const own *o, int index)
{
  char *at = (char *)o->memory + rounded(sizeof *o->memory);
  for (int k = 0; k < index; k++) at += rounded(definition(o, k)->state_size);
  return at;
}

static void destroy(void *self)
{
  own *o = self;
  if (!o) return;
  free(o->memory);
  free(o->position);
  free(o->velocity);
  free(o->spin);
  free(o->species);
  free(o);
}

static void *create(const gg_model *model, gg_error *err)
{
  own *o = gg_base_array_new(1, sizeof *o, err);
  if (!o) return NULL;
  o->model = model;
  size_t n = (size_t)model->n, bytes = rounded(sizeof *o->memory);
  for (int k = 0; k < gg_common_extension_observables(model->extension); k++)
    bytes += rounded(definition(o, k)->state_size);
  o->memory_bytes = bytes;
  o->memory = gg_base_array_new(bytes, 1, err);
  o->velocity = gg_base_array_new(n, sizeof *o->velocity, err);
  o->species = gg_base_array_new(n, 1, err);
  if (!model->homogeneous) o->position = gg_base_array_new(n, sizeof *o->position, err);
  if (model->rule != GG_SMOOTH) o->spin = gg_base_array_new(n, sizeof *o->spin, err);
  bool all = o->memory && o->velocity && o->species && (o->position || model->homogeneous) &&
             (o->spin || model->rule == GG_SMOOTH);
  if (!all) {
    destroy(o);
    return NULL;
  }
  o->memory->scale = 1;
  return o;
}

static void *memory_of(void *self, size_t *bytes)
{
  own *o = self;
  *bytes = o->memory_bytes;
  return o->memory;
}

static size_t width(const gg_model *m)
{
  return (size_t)gg_common_extension_quantities(m->extension);
}

static void begin(void *self)
{
  ((own *)self)->n = 0;
}

static void add_chunk(void *self, const gg_chunk *chunk)
{
  own *o = self;
  const double *const *spin = chunk->whole_s[0] ? chunk->whole_s : chunk->s;
  for (size_t i = 0; i < chunk->n && o->n < (size_t)o->model->n; i++) {
    size_t at = chunk->id ? (size_t)chunk->id[i] : o->n;
    o->n++;
    o->species[at] = chunk->species ? chunk->species[i] : 0;
    for (int a = 0; a < 3; a++) {
      o->velocity[at][a] = chunk->c[a][i];
      if (o->position && chunk->r[a]) o->position[at][a] = chunk->r[a][i];
      if (o->spin) o->spin[at][a] = spin[a][i];
    }
  }
}

/* From the engine's units to those of results: spins are surface velocities, and velocities may have been rescaled. */
static void convert(own *o)
{
  double v = 1 / o->memory->scale;
  for (size_t i = 0; i < o->n; i++) {
    double spin = v * (o->model->boltzmann ? 1 : 2 / o->model->diameter[o->species[i]]);
    for (int a = 0; a < 3; a++) {
      o->velocity[i][a] *= v;
      if (o->spin) o->spin[i][a] *= spin;
    }
  }
}

static gg_sample sample_of(const own *o, const gg_interval *in)
{
  const gg_model *m = o->model;
  double v = 1 / o->memory->scale, elapsed = in->elapsed * o->memory->scale;
  double unit = m->stress_unit / (m->volume * elapsed);
  gg_sample s = {.time = o->memory->time,
                 .elapsed = elapsed,
                 .n = o->n,
                 .n_species = m->n_species,
                 .position = (const double *)o->position,
                 .velocity = (const double *)o->velocity,
                 .spin = (const double *)o->spin,
                 .species = o->species,
                 .mass = m->mass,
                 .diameter = m->diameter,
                 .inertia = m->inertia,
                 .box = {m->box[0], m->box[1], m->box[2]},
                 .volume = m->volume};
  for (int p = 0; p < gg_pairs_of(m->n_species); p++) {
    s.collisions += in->transfer->collisions[p];
    s.dissipation += in->transfer->loss[p] * v * v * unit;
    for (int a = 0; a < 3; a++)
      for (int b = 0; b < 3; b++) s.stress[a][b] += in->transfer->stress[p][a][b] * v * unit;
  }
  return s;
}

static void finish(void *self, const gg_interval *in, double *row)
{
  own *o = self;
  o->memory->time += in->elapsed * o->memory->scale;
  if (!(in->elapsed > 0)) return; /* the very first sample makes no row */
  convert(o);
  const gg_sample sample = sample_of(o, in);
  for (int k = 0; k < gg_common_extension_observables(o->model->extension); k++) {
    const gg_observable_definition *d = definition(o, k);
    for (int i = 0; i < d->n_quantities; i++) row[i] = NAN;
    d->sample(d->context, state_of(o, k), &sample, row);
    row += d->n_quantities;
  }
}

static void rescaled(void *self, double factor)
{
  own *o = self;
  if (!o->model->linear_response) o->memory->scale *= factor;
}

static void put(double to[3], gg_vec v, double scale)
{
  to[0] = scale * v.x, to[1] = scale * v.y, to[2] = scale * v.z;
}

static void add_collision(void *self, const gg_collision_record *collision)
{
  own *o = self;
  double scale = o->memory->scale;
  gg_collision_view view = {.species = {collision->species[0], collision->species[1]},
                            .height = {collision->height[0], collision->height[1]},
                            .time_since_contact = {collision->since[0] * scale, collision->since[1] * scale}};
  put(view.normal, collision->k, 1);
  put(view.relative_velocity, collision->c12, 1 / scale);
  for (int i = 0; i < 2; i++) put(view.velocity[i], collision->c[i], 1 / scale);
  for (int k = 0; k < gg_common_extension_observables(o->model->extension); k++) {
    const gg_observable_definition *d = definition(o, k);
    if (d->collision) d->collision(d->context, state_of(o, k), &view);
  }
}

/* All quantities are one family, whose means are those of the channels. */
static double channel(const double *mean, const gg_model *model, int k)
{
  (void)model;
  return mean[k];
}

static const gg_derived derived[] = {{GG_N_QUANTITIES, .each = channel}, GG_DERIVED_END};

static const gg_observable_rows rows = {
    .width = width, .begin = begin, .add_chunk = add_chunk, .finish = finish, .derived = derived};

#define COMMON                                                                                                         \
  .name = "own", .create = create, .destroy = destroy, .memory = memory_of, .positions = true, .rescaled = rescaled,   \
  .rows = &rows
static const gg_observable quiet = {COMMON},
                           with_collisions = {COMMON,
                                              .collisions = &(const gg_observable_collisions){.add = add_collision}};

const gg_observable *gg_measure_user_observables(const gg_model *model)
{
  int n = gg_common_extension_observables(model->extension);
  for (int k = 0; k < n; k++)
    if (gg_common_extension_observable(model->extension, k)->collision) return &with_collisions;
  return n ? &quiet : NULL;
}
