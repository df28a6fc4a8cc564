/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "measure/frame.h"

#include <stdlib.h>

#include "base/memory.h"

typedef struct filling {
  gg_frame *frame;
  size_t at;
  double spin_unit[GG_MAX_SPECIES]; /* omega over (d/2) omega */
} filling;

static void fill(void *context, const gg_chunk *chunk)
{
  filling *f = context;
  gg_frame *frame = f->frame;
  for (size_t i = 0; i < chunk->n; i++, f->at++) {
    int species = chunk->species ? chunk->species[i] : 0;
    for (int a = 0; a < 3; a++) {
      if (chunk->r[0]) frame->position[3 * f->at + (size_t)a] = chunk->r[a][i];
      frame->velocity[3 * f->at + (size_t)a] = chunk->c[a][i];
      if (chunk->s[0]) frame->spin[3 * f->at + (size_t)a] = chunk->s[a][i] * f->spin_unit[species];
    }
    if (frame->species) frame->species[f->at] = (uint8_t)species;
    frame->id[f->at] = chunk->id ? chunk->id[i] : (int64_t)f->at;
  }
}

gg_status gg_measure_frame_take(gg_engine *engine, const gg_model *model, gg_frame *frame, gg_error *err)
{
  size_t n = (size_t)model->n;
  const gg_engine_state state = gg_engine_state_of(engine);
  *frame = (gg_frame){.time = state.time, .step = state.collisions, .n = n};
  bool positions = !model->homogeneous, spins = model->rule != GG_SMOOTH, species = model->n_species > 1;
  if (positions) frame->position = gg_base_array_new(3 * n, sizeof(double), err);
  if (spins) frame->spin = gg_base_array_new(3 * n, sizeof(double), err);
  if (species) frame->species = gg_base_array_new(n, 1, err);
  frame->velocity = gg_base_array_new(3 * n, sizeof(double), err);
  frame->id = gg_base_array_new(n, sizeof(int64_t), err);
  if (!frame->velocity || !frame->id || (positions && !frame->position) || (spins && !frame->spin) ||
      (species && !frame->species)) {
    gg_measure_frame_free(frame);
    return GG_FAILED;
  }
  filling f = {.frame = frame};
  for (int i = 0; i < GG_MAX_SPECIES; i++) f.spin_unit[i] = model->boltzmann ? 1 : 2 / model->diameter[i];
  engine->ops->snapshot(engine, positions, fill, &f);
  return GG_OK;
}

void gg_measure_frame_free(gg_frame *frame)
{
  free(frame->position);
  free(frame->velocity);
  free(frame->spin);
  free(frame->species);
  free(frame->id);
  *frame = (gg_frame){0};
}

size_t *gg_measure_frame_order(const gg_frame *frame, gg_error *err)
{
  size_t *order = gg_base_array_new(frame->n, sizeof *order, err);
  for (size_t i = 0; order && i < frame->n; i++) {
    int64_t id = frame->id ? frame->id[i] : (int64_t)i;
    if (id < 0 || (size_t)id >= frame->n) {
      gg_base_fail(err, GG_FAILED, "the grains of a frame are not numbered from 0 to n-1");
      free(order);
      return NULL;
    }
    order[id] = i;
  }
  return order;
}

void gg_measure_frame_visit(const gg_frame *f, const gg_model *model, gg_visit *visit, void *context)
{
  double c[3][GG_CHUNK], s[3][GG_CHUNK];
  for (size_t from = 0; from < f->n; from += GG_CHUNK) {
    gg_chunk chunk = {.n = f->n - from < GG_CHUNK ? f->n - from : GG_CHUNK, .c = {c[0], c[1], c[2]}};
    if (f->species) chunk.species = f->species + from;
    for (size_t i = 0; i < chunk.n; i++)
      for (size_t a = 0; a < 3; a++) {
        const double radius = model->diameter[f->species ? f->species[from + i] : 0] / 2;
        c[a][i] = f->velocity[3 * (from + i) + a];
        if (f->spin) s[a][i] = radius * f->spin[3 * (from + i) + a];
      }
    for (int a = 0; a < 3 && f->spin; a++) chunk.s[a] = s[a];
    visit(context, &chunk);
  }
}

void gg_measure_frame_copy(const gg_frame *f, double *position, double *velocity, double *spin, int *species)
{
  for (size_t i = 0; i < f->n; i++) {
    const size_t place = f->id ? (size_t)f->id[i] : i;
    if (species) species[place] = f->species ? f->species[i] : 0;
    for (size_t a = 0; a < 3; a++) {
      if (position) position[3 * place + a] = f->position[3 * i + a];
      if (velocity) velocity[3 * place + a] = f->velocity[3 * i + a];
      if (spin) spin[3 * place + a] = f->spin ? f->spin[3 * i + a] : 0;
    }
  }
}
