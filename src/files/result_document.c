#include "files/result_document.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/checked_json.h"
#include "files/curve_table.h"
#include "scene/fields.h"

static json_t *real(double x)
{
  return isfinite(x) ? json_real(x) : json_null();
}

bool gg_files_quantity_is_measured(const gg_estimate *e)
{
  return !isnan(e->mean) || e->reason[0];
}

/* A line "who: a, b: reason" per reason; `who` and the reason decide which line a quantity joins. */
void gg_files_reason_add(json_t *warnings, const char *who, const char *quantity, const char *reason)
{
  size_t i;
  json_t *line;
  char *head, *tail;
  if (asprintf(&tail, " null: %s", reason) < 0) {
    gg_base_json_put(-1);
    return;
  }
  if (asprintf(&head, "%s%s", who, *who ? ": " : "") < 0) {
    gg_base_json_put(-1);
    free(tail);
    return;
  }
  char *text = NULL;
  int made = 0;
  bool joined = false;
  json_array_foreach(warnings, i, line)
  {
    const char *old = json_string_value(line);
    size_t length = strlen(old), end = strlen(tail);
    if (strncmp(old, head, strlen(head)) != 0 || length < end || strcmp(old + length - end, tail) != 0) continue;
    int keep = (int)(length - end) - 3; /* less "is", "are" and the blank before */
    while (keep > 0 && old[keep] != ' ') keep--;
    made = asprintf(&text, "%.*s, %s are%s", keep, old, quantity, tail);
    joined = true;
    if (made >= 0) json_string_set(line, text);
    break;
  }
  if (!joined) made = asprintf(&text, "%s%s is%s", head, quantity, tail);
  if (!joined && made >= 0) json_array_append_new(warnings, json_string(text));
  gg_base_json_put(made < 0);
  if (made >= 0) free(text);
  free(head);
  free(tail);
}

static json_t *estimate_json(const gg_result *r, gg_quantity q, json_t *warnings)
{
  const gg_estimate *e = &r->value[q];
  const char *name = gg_common_quantity_name_in(&r->model, q);
  if (isnan(e->mean))
    gg_files_reason_add(warnings, "", name, e->reason);
  else if (isnan(e->error))
    gg_files_reason_add(warnings, "stderr", name, e->reason[0] ? e->reason : "too few samples");
  json_t *json = json_pack("{s:o, s:o, s:s, s:I, s:o, s:s}", "mean", real(e->mean), "stderr", real(e->error), "unit",
                           gg_common_quantity_unit(q, &r->model), "samples", (json_int_t)e->samples, "correlation_time",
                           real(e->correlation_time), "correlation_time_unit", gg_run_correlation_time_unit(&r->model));
  if (isnan(e->mean)) json_object_set_new(json, "reason", json_string(e->reason));
  if (q >= GG_N_QUANTITIES) json_object_set_new(json, "doc", json_string(gg_common_quantity_doc_in(&r->model, q)));
  return json;
}

static json_t *effort_json(const gg_effort *effort)
{
  return json_pack("{s:I, s:o, s:o}", "collisions", (json_int_t)effort->collisions, "cpu_seconds",
                   real(effort->cpu_seconds), "wall_seconds", real(effort->wall_seconds));
}

static json_t *engine_state_json(const gg_result *r)
{
  const gg_engine_state *s = &r->engine_state;
  json_t *state = json_pack("{s:o, s:I}", "time", real(s->time), "events", (json_int_t)s->events);
  if (strcmp(r->engine, "md") == 0) {
    json_object_set_new(state, "contact_time_collisions", json_integer((json_int_t)s->treated));
    json_object_set_new(state, "worst_overlap", real(s->worst_overlap));
  } else {
    json_object_set_new(state, "majorant_overflows", json_integer((json_int_t)s->overflows));
    json_object_set_new(state, "time_step", real(s->time_step));
    json_object_set_new(state, "time_step_bias", real(s->time_step_bias));
  }
  return state;
}

static json_t *run_document(const gg_result *r)
{
  if (r->origin.document) return gg_base_json_read(r->origin.document, NULL); /* as it was stored */
  json_t *results = json_object(), *warnings = json_array();
  for (size_t i = 0; i < r->warnings.n; i++) json_array_append_new(warnings, json_string(r->warnings.text[i]));
  for (int i = 0; i < gg_common_quantity_set_of(&r->model); i++) {
    gg_quantity q = gg_common_quantity_at(&r->model, i);
    if (gg_files_quantity_is_measured(&r->value[q]))
      json_object_set_new(results, gg_common_quantity_name_in(&r->model, q), estimate_json(r, q, warnings));
  }
  json_t *document =
      json_pack("{s:s, s:o, s:s, s:b, s:s, s:I, s:I, s:o, s:o, s:o, s:o, s:o}", "graingas", GG_VERSION, "scene",
                gg_scene_json(&r->scene), "engine", r->engine, "steady", r->steadiness == GG_STEADY, "verdict",
                r->steadiness_text, "particles", (json_int_t)r->model.n, "collisions",
                (json_int_t)r->averaging.collisions, "cpu_seconds", real(r->averaging.cpu_seconds), "total",
                effort_json(&r->total), "engine_state", engine_state_json(r), "results", results, "warnings", warnings);
  if (*r->ensemble_text) json_object_set_new(document, "particles_chosen", json_string(r->ensemble_text));
  if (r->curves.n) json_object_set_new(document, "curves", gg_files_curves_json(&r->curves));
  return document;
}

json_t *gg_files_run_document(const gg_result *r)
{
  bool before = gg_base_memory_begin();
  return gg_base_json_end(before, run_document(r));
}

char *gg_files_document_text(const json_t *document)
{
  return gg_base_json_text(document, JSON_INDENT(1) | JSON_REAL_PRECISION(17));
}
