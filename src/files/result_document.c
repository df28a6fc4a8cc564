#include "files/result_document.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/build.h"
#include "base/checked_json.h"
#include "files/curve_table.h"
#include "scene/fields.h"

json_t *gg_files_json_number(double x)
{
  return isfinite(x) ? json_real(x) : json_null();
}

json_t *gg_files_warnings_json(const gg_text_list *texts)
{
  json_t *warnings = json_array();
  for (size_t i = 0; i < texts->n; i++) json_array_append_new(warnings, json_string(texts->text[i]));
  return warnings;
}

bool gg_files_quantity_is_measured(const gg_estimate *e)
{
  return !isnan(e->mean) || e->reason[0];
}

/* Where the names end in "who: a, b are null: reason", less "is" or "are"; 0 where a line says something else. */
static int end_of_names(const char *line, const char *who, const char *reason)
{
  static const char null[] = " null: ";
  size_t head = strlen(who), length = strlen(line), tail = strlen(reason) + sizeof null - 1;
  if (strncmp(line, who, head) != 0 || (head && strncmp(line + head, ": ", 2) != 0) || length < tail) return 0;
  const char *end = line + length - tail;
  if (strncmp(end, null, sizeof null - 1) != 0 || strcmp(end + sizeof null - 1, reason) != 0) return 0;
  for (end--; end > line && *end != ' ';) end--;
  return (int)(end - line);
}

void gg_files_reason_add(json_t *warnings, const char *who, const char *quantity, const char *reason)
{
  size_t i;
  json_t *line;
  json_array_foreach(warnings, i, line)
  {
    const char *old = json_string_value(line);
    int names = end_of_names(old, who, reason);
    if (!names) continue;
    json_array_set_new(warnings, i, json_sprintf("%.*s, %s are null: %s", names, old, quantity, reason));
    return;
  }
  json_array_append_new(warnings, json_sprintf("%s%s%s is null: %s", who, *who ? ": " : "", quantity, reason));
}

static json_t *estimate_json(const gg_result *r, const gg_quantity_row *row, json_t *warnings)
{
  const gg_estimate *e = &r->value[row->quantity];
  if (isnan(e->mean))
    gg_files_reason_add(warnings, "", row->name, e->reason);
  else if (isnan(e->error))
    gg_files_reason_add(warnings, "stderr", row->name, e->reason[0] ? e->reason : "too few samples");
  json_t *json = json_pack("{s:o, s:o, s:s, s:I, s:o, s:s}", "mean", gg_files_json_number(e->mean), "stderr",
                           gg_files_json_number(e->error), "unit", row->unit, "samples", (json_int_t)e->samples,
                           "correlation_time", gg_files_json_number(e->correlation_time), "correlation_time_unit",
                           r->correlation_time_unit);
  if (isnan(e->mean)) json_object_set_new(json, "reason", json_string(e->reason));
  if (row->quantity >= GG_N_QUANTITIES) json_object_set_new(json, "doc", json_string(row->doc));
  return json;
}

static json_t *effort_json(const gg_effort *effort)
{
  return json_pack("{s:I, s:o, s:o}", "collisions", (json_int_t)effort->collisions, "cpu_seconds",
                   gg_files_json_number(effort->cpu_seconds), "wall_seconds",
                   gg_files_json_number(effort->wall_seconds));
}

static json_t *engine_state_json(const gg_result *r)
{
  const gg_engine_state *s = &r->engine_state;
  json_t *state = json_pack("{s:o, s:I}", "time", gg_files_json_number(s->time), "events", (json_int_t)s->events);
  if (strcmp(r->engine, "md") == 0) {
    json_object_set_new(state, "contact_time_collisions", json_integer((json_int_t)s->treated));
    json_object_set_new(state, "worst_overlap", gg_files_json_number(s->worst_overlap));
  } else {
    json_object_set_new(state, "majorant_overflows", json_integer((json_int_t)s->overflows));
    json_object_set_new(state, "time_step", gg_files_json_number(s->time_step));
    json_object_set_new(state, "time_step_bias", gg_files_json_number(s->time_step_bias));
  }
  return state;
}

static json_t *run_document(const gg_result *r)
{
  if (r->origin.document) return gg_base_json_read(r->origin.document, NULL); /* as it was stored */
  json_t *results = json_object(), *warnings = gg_files_warnings_json(&r->warnings);
  for (int i = 0; i < r->rows.n; i++) {
    const gg_quantity_row *row = &r->rows.row[i];
    if (gg_files_quantity_is_measured(&r->value[row->quantity]))
      json_object_set_new(results, row->name, estimate_json(r, row, warnings));
  }
  json_t *document = json_pack(
      "{s:s, s:s, s:o, s:s, s:b, s:s, s:I, s:I, s:o, s:o, s:o, s:o, s:o}", "graingas", gg_base_build_version, "build",
      gg_base_build_identity, "scene", gg_scene_json(&r->scene), "engine", r->engine, "steady",
      r->steadiness == GG_STEADY, "verdict", r->steadiness_text, "particles", (json_int_t)r->model.n, "collisions",
      (json_int_t)r->averaging.collisions, "cpu_seconds", gg_files_json_number(r->averaging.cpu_seconds), "total",
      effort_json(&r->total), "engine_state", engine_state_json(r), "results", results, "warnings", warnings);
  if (*r->ensemble_text) json_object_set_new(document, "particles_chosen", json_string(r->ensemble_text));
  if (r->curves.n) json_object_set_new(document, "curves", gg_files_curves_json(&r->curves));
  return document;
}

json_t *gg_files_run_document(const gg_result *r)
{
  const unsigned before = gg_base_memory_failures();
  return gg_base_json_end(before, run_document(r));
}

char *gg_files_document_text(const json_t *document)
{
  return gg_base_json_text(document, JSON_INDENT(1) | JSON_REAL_PRECISION(17));
}
