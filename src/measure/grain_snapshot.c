/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "measure/grain_snapshot.h"

#include <stdlib.h>
#include <string.h>

#include "base/memory.h"

gg_status gg_measure_snapshot_init(gg_snapshot *s, const gg_model *model, bool positions, gg_error *err)
{
  size_t n = (size_t)model->n;
  *s = (gg_snapshot){.model = model, .n = n, .velocity_factor = 1};
  double **vectors[] = {s->c, model->rule != GG_SMOOTH ? s->s : NULL, positions ? s->r : NULL};
  for (int k = 0; k < 3; k++)
    for (int a = 0; vectors[k] && a < 3; a++)
      if (!(vectors[k][a] = gg_base_array_new(n, sizeof(double), err))) goto failed;
  if (model->n_species > 1 && !(s->species = gg_base_array_new(n, 1, err))) goto failed;
  if (positions && !(s->id = gg_base_array_new(n, sizeof *s->id, err))) goto failed;
  return GG_OK;
failed:
  gg_measure_snapshot_clear(s);
  return GG_FAILED;
}

void gg_measure_snapshot_clear(gg_snapshot *s)
{
  for (int a = 0; a < 3; a++) {
    free(s->r[a]);
    free(s->c[a]);
    free(s->s[a]);
  }
  free(s->species);
  free(s->id);
  *s = (gg_snapshot){0};
}

typedef struct gathering {
  gg_snapshot *to;
  size_t at;
} gathering;

static void gather(void *context, const gg_chunk *chunk)
{
  gathering *g = context;
  gg_snapshot *s = g->to;
  size_t bytes = chunk->n * sizeof(double);
  for (int a = 0; a < 3; a++) {
    memcpy(s->c[a] + g->at, chunk->c[a], bytes);
    if (s->s[a] && chunk->s[a]) memcpy(s->s[a] + g->at, chunk->s[a], bytes);
    if (s->r[a] && chunk->r[a]) memcpy(s->r[a] + g->at, chunk->r[a], bytes);
  }
  if (s->species && chunk->species) memcpy(s->species + g->at, chunk->species, chunk->n);
  if (s->id && chunk->id) memcpy(s->id + g->at, chunk->id, chunk->n * sizeof *s->id);
  g->at += chunk->n;
}

void gg_measure_snapshot_take(gg_snapshot *s, gg_engine *engine)
{
  gathering g = {s, 0};
  engine->ops->snapshot(engine, s->r[0] != NULL, gather, &g);
  const gg_engine_state state = gg_engine_state_of(engine);
  s->offset = state.offset;
  s->time = state.time;
  s->collisions = state.collisions;
}

gg_species_view gg_measure_species_chunk(const gg_chunk *chunk, int species, gg_species_scratch *scratch)
{
  gg_species_view v = {0};
  if (!chunk->species) {
    v.n = species == 0 ? chunk->n : 0;
    for (int a = 0; a < 3; a++) v.c[a] = chunk->c[a], v.s[a] = chunk->s[a];
    return v;
  }
  for (size_t i = 0; i < chunk->n; i++) {
    if (chunk->species[i] != species) continue;
    for (int a = 0; a < 3; a++) {
      scratch->c[a][v.n] = chunk->c[a][i];
      if (chunk->s[0]) scratch->s[a][v.n] = chunk->s[a][i];
    }
    v.n++;
  }
  for (int a = 0; a < 3; a++) {
    v.c[a] = scratch->c[a];
    v.s[a] = chunk->s[0] ? scratch->s[a] : NULL;
  }
  return v;
}
