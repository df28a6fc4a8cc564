/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "common/engine_grains.h"

#include <stdlib.h>

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

/* For a gg_visit. */
typedef struct reading {
  gg_engine_grains *to;
  size_t n, at;
} reading;

static void read_chunk(void *context, const gg_chunk *chunk)
{
  reading *w = context;
  double *r = w->to->number, *c = r + 3 * w->n, *s = c + 3 * w->n;
  for (size_t i = 0; i < chunk->n; i++, w->at++) {
    const size_t place = chunk->id ? (size_t)chunk->id[i] : w->at;
    w->to->species[place] = chunk->species ? chunk->species[i] : 0;
    for (size_t a = 0; a < 3; a++) {
      if (chunk->r[a]) r[3 * place + a] = chunk->r[a][i];
      c[3 * place + a] = chunk->c[a][i];
      if (chunk->s[0]) s[3 * place + a] = chunk->s[a][i];
    }
  }
}

void gg_common_engine_grains_read(gg_engine *engine, const gg_model *model, gg_engine_grains *g)
{
  const size_t n = (size_t)model->n;
  engine->ops->snapshot(engine, !model->homogeneous, read_chunk, &(reading){.to = g, .n = n});
  g->grains = (gg_grain_arrays){.r = model->homogeneous ? NULL : g->number,
                                .c = g->number + 3 * n,
                                .s = g->number + 6 * n,
                                .species = g->species};
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
  if (status == GG_OK) (*next)->ops->keep_sums(*next, true);
  return status;
}
