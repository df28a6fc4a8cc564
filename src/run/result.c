/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "run/result.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "scene/scene.h"

void gg_run_result_warn(gg_result *result, const char *format, ...)
{
  char *text = NULL;
  va_list args;
  va_start(args, format);
  if (vasprintf(&text, format, args) < 0) text = NULL;
  va_end(args);
  gg_base_string_list_take(&result->warnings, text);
}

bool gg_run_quantity_counts_in_collisions(const gg_model *m)
{
  return !gg_model_keeps_temperature(m);
}

int gg_run_headline_quantities(const gg_model *m, gg_quantity list[GG_N_QUANTITIES])
{
  const gg_flow_row *flow = gg_flow_of(m->flow);
  int n = 0;
  for (const int *q = (m->bath.on || gg_model_is_injected(m)) && flow->headline_in_bath ? flow->headline_in_bath
                                                                                        : flow->headline;
       *q != GG_N_QUANTITIES; q++)
    if (!gg_common_quantity_missing(m, (gg_quantity)*q)) list[n++] = (gg_quantity)*q;
  return n;
}

void gg_run_rows_make(const gg_model *m, gg_quantity_rows *rows)
{
  rows->n = gg_common_quantity_set_of(m);
  for (int i = 0; i < rows->n; i++) {
    const gg_quantity q = gg_common_quantity_at(m, i);
    gg_quantity_row *r = &rows->row[i];
    *r = (gg_quantity_row){q, gg_common_quantity_name_in(m, q), gg_common_quantity_unit(q, m),
                           gg_common_quantity_doc_in(m, q), ""};
    if (q < GG_N_QUANTITIES) gg_common_quantity_symbol(q, r->symbol, sizeof r->symbol);
  }
}

const gg_quantity_row *gg_run_rows_find(const gg_quantity_rows *rows, const char *name)
{
  for (int i = 0; i < rows->n; i++)
    if (strcmp(rows->row[i].name, name) == 0) return &rows->row[i];
  return NULL;
}

const gg_quantity_row *gg_run_rows_at(const gg_quantity_rows *rows, gg_quantity q)
{
  for (int i = 0; i < rows->n; i++)
    if (rows->row[i].quantity == q) return &rows->row[i];
  return NULL;
}

void gg_run_result_label(gg_result *r)
{
  gg_run_rows_make(&r->model, &r->rows);
  r->correlation_time_unit =
      gg_run_quantity_counts_in_collisions(&r->model) ? "collisions a grain" : gg_measure_curve_unit(&r->model, "time");
}

void gg_run_result_free(gg_result *result)
{
  if (!result) return;
  free(result->correlations.coefficient);
  free(result->history.time);
  for (int k = 0; k < GG_N_HISTORY; k++) free(result->history.value[k]);
  gg_measure_curves_clear(&result->curves);
  gg_run_frame_free(&result->final);
  gg_base_string_list_clear(&result->warnings);
  gg_scene_release(result->scene);
  gg_common_extension_release(result->own);
  char *const texts[] = {result->origin.version, result->origin.command, result->origin.machine, result->origin.date,
                         result->origin.document};
  for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) free(texts[i]);
  free(result);
}

typedef struct filling {
  gg_frame *frame;
  size_t at;
  double spin_unit[GG_MAX_SPECIES]; /* omega over (d/2) omega */
  double turns;                     /* edges by which the image above has moved beside frame->tilt */
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
      if (frame->image) frame->image[3 * f->at + (size_t)a] = chunk->image[a][i];
      if (chunk->s[0]) frame->spin[3 * f->at + (size_t)a] = chunk->s[a][i] * f->spin_unit[species];
    }
    if (frame->image) frame->image[3 * f->at] += frame->image[3 * f->at + 1] * f->turns;
    if (frame->species) frame->species[f->at] = (uint8_t)species;
    frame->id[f->at] = chunk->id ? chunk->id[i] : (int64_t)f->at;
  }
}

gg_status gg_run_frame_take(gg_engine *engine, const gg_model *model, bool images, gg_frame *frame, gg_error *err)
{
  size_t n = (size_t)model->n;
  const gg_engine_state state = gg_engine_state_of(engine);
  const double tilt = remainder(state.offset, model->box[0]);
  *frame = (gg_frame){.time = state.time, .step = state.collisions, .n = n, .tilt = model->homogeneous ? 0 : tilt};
  bool positions = !model->homogeneous, spins = model->rule != GG_SMOOTH, species = model->n_species > 1;
  if (positions) frame->position = gg_base_array_new(3 * n, sizeof(double), err);
  if (images) frame->image = gg_base_array_new(3 * n, sizeof(double), err);
  if (spins) frame->spin = gg_base_array_new(3 * n, sizeof(double), err);
  if (species) frame->species = gg_base_array_new(n, 1, err);
  frame->velocity = gg_base_array_new(3 * n, sizeof(double), err);
  frame->id = gg_base_array_new(n, sizeof(int64_t), err);
  if (!frame->velocity || !frame->id || (positions && !frame->position) || (images && !frame->image) ||
      (spins && !frame->spin) || (species && !frame->species)) {
    gg_run_frame_free(frame);
    return GG_FAILED;
  }
  filling f = {.frame = frame, .turns = state.turns + round((state.offset - tilt) / model->box[0])};
  for (int i = 0; i < GG_MAX_SPECIES; i++) f.spin_unit[i] = model->boltzmann ? 1 : 2 / model->diameter[i];
  engine->ops->snapshot(engine, positions, fill, &f);
  return GG_OK;
}

void gg_run_frame_free(gg_frame *frame)
{
  free(frame->position);
  free(frame->velocity);
  free(frame->spin);
  free(frame->image);
  free(frame->species);
  free(frame->id);
  *frame = (gg_frame){0};
}

gg_status gg_run_frame_check(const gg_frame *frame, const gg_model *m, gg_error *err)
{
  bool fits = frame->n == (size_t)m->n && frame->velocity && !frame->position == m->homogeneous &&
              !frame->spin == (m->rule == GG_SMOOTH) && !frame->species == (m->n_species == 1);
  for (size_t i = 0; fits && frame->species && i < frame->n; i++) fits = frame->species[i] < m->n_species;
  return fits ? GG_OK : gg_base_fail(err, GG_BAD_FILE, "a frame of the trajectory is not one of this scene");
}

size_t *gg_run_frame_order(const gg_frame *frame, gg_error *err)
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
