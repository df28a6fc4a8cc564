/* The documents of `compare` and `theory`. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/build.h"
#include "base/checked_json.h"
#include "files/curve_table.h"
#include "files/result_document.h"
#include "run/z_scores.h"
#include "scene/fields.h"

/* What the theories say: {"lun1991": {"temperature": {"mean":, "unit":}}}, with "error" where a theory
 * is solved numerically and tells it; those that do not apply are warnings. */
static json_t *theories_json(const gg_comparison *c, json_t *warnings)
{
  json_t *all = json_object();
  for (int i = 0; i < c->n_theories; i++) {
    const char *name = c->theory[i].theory->name;
    if (!c->theory[i].applies) {
      json_array_append_new(warnings, json_sprintf("%s does not apply: %s", name, c->theory[i].reason));
      continue;
    }
    json_t *one = json_object();
    for (int k = 0; k < c->rows.n; k++) {
      const gg_quantity_row *row = &c->rows.row[k];
      double value = c->theory[i].answer.value[row->quantity], error = c->theory[i].answer.error[row->quantity];
      if (!isfinite(value)) continue;
      json_t *answer = json_pack("{s:f, s:s}", "mean", value, "unit", row->unit);
      if (isfinite(error)) json_object_set_new(answer, "error", json_real(error));
      json_object_set_new(one, row->name, answer);
    }
    json_object_set_new(all, name, one);
  }
  return all;
}

/* {"lun1991": {"title", "citation", "assumptions", "beyond": why this scene is out of its range, or null, "reason": why
 * it does not apply, or null}}. */
static json_t *about_json(const gg_comparison *c)
{
  json_t *all = json_object();
  for (int i = 0; i < c->n_theories; i++) {
    const gg_theory *t = c->theory[i].theory;
    bool applies = c->theory[i].applies;
    const char *beyond = applies ? gg_theory_beyond(t, &c->model) : NULL,
               *reason = applies ? NULL : c->theory[i].reason;
    json_object_set_new(all, t->name,
                        json_pack("{s:s, s:s, s:s, s:s?, s:s?}", "title", t->title, "citation", t->citation,
                                  "assumptions", t->assumptions, "beyond", beyond, "reason", reason));
  }
  return all;
}

/* {"enskog_hermite": {"velocity_distribution_Cx": a curve as those of a run}}; left out where no theory has any. */
static void put_theory_curves(json_t *document, const gg_comparison *c)
{
  json_t *all = json_object();
  for (int i = 0; i < c->n_theories; i++)
    if (c->theory[i].curves.n)
      json_object_set_new(all, c->theory[i].theory->name, gg_files_curves_json(&c->theory[i].curves));
  if (json_object_size(all)) json_object_set(document, GG_THEORY_CURVES, all);
  json_decref(all);
}

json_t *gg_files_theory_document(const gg_scene *scene, const gg_comparison *c)
{
  const unsigned before = gg_base_memory_failures();
  json_t *warnings = gg_files_warnings_json(&c->warnings), *theory = theories_json(c, warnings);
  json_t *document =
      json_pack("{s:s, s:s, s:o, s:o, s:o, s:o}", "graingas", gg_base_build_version, "build", gg_base_build_identity,
                "scene", gg_scene_json(scene), "theory", theory, "theories", about_json(c), "warnings", warnings);
  put_theory_curves(document, c);
  return gg_base_json_end(before, document);
}

/* theory/engine - 1 of every theory with an answer; left out where the engine has no mean. */
static void put_deviations(json_t *json, const gg_comparison *c, int k, const gg_quantity_row *row, json_t *warnings)
{
  const gg_result *engine = c->by_engine[k];
  json_t *all = json_object();
  char key[64];
  bool small = false;
  for (int i = 0; i < c->n_theories; i++) {
    double value = c->theory[i].answer.value[row->quantity];
    if (!c->theory[i].applies || !isfinite(value)) continue;
    double deviation = gg_run_deviation(&engine->value[row->quantity], value);
    small |= isnan(deviation);
    json_object_set_new(all, c->theory[i].theory->name, isnan(deviation) ? json_null() : json_real(deviation));
  }
  if (small)
    gg_files_reason_add(warnings, engine->engine, row->name,
                        "the relative deviation of theories, since the mean is within three standard errors of zero");
  snprintf(key, sizeof key, "%s_theory_deviation", engine->engine);
  json_object_set_new(json, key, all);
}

/* Of an engine against Enskog's equation solved without random numbers; keys are left out where there is none. */
static void put_departure(json_t *json, gg_engine_kind kind, const gg_departure *d)
{
  char key[64];
  const struct {
    const char *word;
    double value;
  } numbers[] = {{"z", d->z},
                 {"difference", d->difference},
                 {"error", d->error},
                 {"deviation", d->deviation},
                 {"deviation_error", d->deviation_error}};
  for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++) {
    snprintf(key, sizeof key, "%s_enskog_%s", gg_run_engine_ops_of(kind)->name, numbers[i].word);
    if (isfinite(numbers[i].value)) json_object_set_new(json, key, json_real(numbers[i].value));
  }
}

/* NULL: neither engine has a mean. */
static json_t *row_json(const gg_comparison *c, const gg_quantity_row *named, json_t *warnings)
{
  gg_comparison_row row;
  gg_run_comparison_row(c, named, &row);
  if (!isfinite(row.mean[GG_MD]) && !isfinite(row.mean[GG_DSMC])) return NULL;
  json_t *json = json_pack("{s:s, s:s, s:o, s:b}", "quantity", row.name, "unit", row.unit, "md_dsmc_z",
                           gg_files_json_number(row.z), "beyond_expected", row.beyond);
  if (!isfinite(row.z))
    gg_files_reason_add(warnings, "md_dsmc_z", row.name, "the mean or error of an engine is not known");
  for (int k = 0; k < 2; k++)
    if (isfinite(row.mean[k])) put_deviations(json, c, k, named, warnings);
  for (int k = 0; k < 2; k++) put_departure(json, (gg_engine_kind)k, &row.departure[k]);
  return json;
}

static json_t *engine_json(const gg_comparison *c, gg_engine_kind kind, json_t *warnings)
{
  const gg_result *r = c->by_engine[kind];
  if (r) return gg_files_run_document(r);
  json_array_append_new(warnings, json_sprintf("%s is null: %s", gg_run_engine_ops_of(kind)->name, c->refusal[kind]));
  return json_null();
}

/* Where md differs beyond what is expected, the causes that apply; theories that are further off than expected. */
static void warn_deviations(const gg_comparison *c, json_t *warnings)
{
  const char *cause[8];
  gg_theory_remark r[GG_MOST_THEORIES];
  const int n_causes = gg_run_disagreement_causes(c, cause, 8), n = gg_run_theory_remarks(c, r);
  for (int i = 0; i < n_causes; i++)
    json_array_append_new(warnings,
                          json_sprintf("md differs from Enskog's equation beyond what is expected: %s", cause[i]));
  for (int i = 0; i < n; i++)
    json_array_append_new(warnings,
                          json_sprintf("%s is off by %+.1f %% in %s: %s", r[i].theory->name, 100 * r[i].deviation,
                                       gg_run_rows_at(&c->rows, r[i].quantity)->name, r[i].cause));
}

static json_t *comparison_document(const gg_comparison *c)
{
  if (c->document) return gg_base_json_read(c->document, NULL); /* as it was stored */
  json_t *warnings = gg_files_warnings_json(&c->warnings), *rows = json_array();
  json_t *md = engine_json(c, GG_MD, warnings), *dsmc = engine_json(c, GG_DSMC, warnings);
  json_t *theory = theories_json(c, warnings);
  for (int i = 0; i < c->rows.n; i++) {
    json_t *row = row_json(c, &c->rows.row[i], warnings);
    if (row) json_array_append_new(rows, row);
  }
  warn_deviations(c, warnings);
  json_t *document =
      json_pack("{s:s, s:s, s:o, s:o, s:o, s:o, s:o, s:o, s:o}", "graingas", gg_base_build_version, "build",
                gg_base_build_identity, "scene", gg_scene_json(&c->scene), "md", md, "dsmc", dsmc, "theory", theory,
                "theories", about_json(c), "comparison", rows, "warnings", warnings);
  put_theory_curves(document, c);
  return document;
}

json_t *gg_files_comparison_document(const gg_comparison *c)
{
  const unsigned before = gg_base_memory_failures();
  return gg_base_json_end(before, comparison_document(c));
}
