/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "run/result.h"

#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "graingas.h"
#include "scene/scene.h"

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

void gg_run_result_freed(gg_result **result)
{
  gg_result_free(*result);
}

void gg_result_free(gg_result *result)
{
  if (!result) return;
  free(result->correlations.coefficient);
  free(result->history.time);
  for (int k = 0; k < GG_N_HISTORY; k++) free(result->history.value[k]);
  gg_measure_curves_clear(&result->curves);
  gg_measure_frame_free(&result->final);
  gg_base_string_list_clear(&result->warnings);
  gg_scene_free(result->scene);
  gg_common_extension_release(result->own);
  char *const texts[] = {result->origin.version, result->origin.command, result->origin.machine, result->origin.date,
                         result->origin.document};
  for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) free(texts[i]);
  free(result);
}

gg_status gg_run_frame_check(const gg_frame *frame, const gg_model *m, gg_error *err)
{
  bool fits = frame->n == (size_t)m->n && frame->velocity && !frame->position == m->homogeneous &&
              !frame->spin == (m->rule == GG_SMOOTH) && !frame->species == (m->n_species == 1);
  for (size_t i = 0; fits && frame->species && i < frame->n; i++) fits = frame->species[i] < m->n_species;
  return fits ? GG_OK : gg_base_fail(err, GG_BAD_FILE, "a frame of the trajectory is not one of this scene");
}
