#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/checked_json.h"
#include "files/curve_table.h"
#include "files/result_document.h"
#include "run/z_scores.h"
#include "scene/fields.h"

static json_t *warnings_json(const gg_comparison *c)
{
  json_t *warnings = json_array();
  for (size_t i = 0; i < c->warnings.n; i++) json_array_append_new(warnings, json_string(c->warnings.text[i]));
  return warnings;
}

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
    for (int k = 0; k < gg_common_quantity_set_of(&c->model); k++) {
      const gg_quantity q = gg_common_quantity_at(&c->model, k);
      double value = c->theory[i].answer.value[q];
      if (!isfinite(value)) continue;
      double error = c->theory[i].answer.error[q];
      json_t *said = json_pack("{s:f, s:s}", "mean", value, "unit", gg_common_quantity_unit(q, &c->model));
      if (isfinite(error)) json_object_set_new(said, "error", json_real(error));
      json_object_set_new(one, gg_common_quantity_name_in(&c->model, q), said);
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
  bool before = gg_base_memory_begin();
  json_t *warnings = warnings_json(c), *theory = theories_json(c, warnings);
  json_t *document = json_pack("{s:s, s:o, s:o, s:o, s:o}", "graingas", GG_VERSION, "scene", gg_scene_json(scene),
                               "theory", theory, "theories", about_json(c), "warnings", warnings);
  put_theory_curves(document, c);
  return gg_base_json_end(before, document);
}

static json_t *deviations_json(const gg_comparison *c, const gg_result *engine, gg_quantity q, json_t *warnings)
{
  json_t *all = json_object();
  bool small = false;
  for (int i = 0; i < c->n_theories; i++) {
    double value = c->theory[i].answer.value[q];
    if (!c->theory[i].applies || !isfinite(value)) continue;
    double deviation = gg_run_deviation(&engine->value[q], value);
    small |= isnan(deviation);
    json_object_set_new(all, c->theory[i].theory->name, isnan(deviation) ? json_null() : json_real(deviation));
  }
  if (small)
    gg_files_reason_add(warnings, engine->engine, gg_common_quantity_name_in(&c->model, q),
                        "the relative deviation of theories, since the mean is within three standard errors of zero");
  return all;
}

static bool has(const gg_result *r, gg_quantity q)
{
  return r && isfinite(r->value[q].mean);
}

/* Of an engine against Enskog's equation solved without random numbers; keys are left out where there is none. */
static void put_departure(json_t *row, const gg_comparison *c, gg_engine_kind kind, gg_quantity q)
{
  gg_departure d;
  char key[64];
  if (!gg_run_enskog_deviation(c, kind, q, &d)) return;
  const struct {
    const char *word;
    double value;
  } told[] = {{"z", d.z},
              {"difference", d.difference},
              {"error", d.error},
              {"deviation", d.deviation},
              {"deviation_error", d.deviation_error}};
  for (size_t i = 0; i < sizeof told / sizeof *told; i++) {
    snprintf(key, sizeof key, "%s_enskog_%s", gg_run_engine_ops_of(kind)->name, told[i].word);
    if (isfinite(told[i].value)) json_object_set_new(row, key, json_real(told[i].value));
  }
}

static json_t *row_json(const gg_comparison *c, gg_quantity q, json_t *warnings)
{
  const gg_result *md = c->by_engine[GG_MD], *dsmc = c->by_engine[GG_DSMC];
  json_t *row = json_pack("{s:s, s:s}", "quantity", gg_common_quantity_name_in(&c->model, q), "unit",
                          gg_common_quantity_unit(q, &c->model));
  double z = md && dsmc ? gg_run_z_score(&md->value[q], &dsmc->value[q]) : NAN;
  json_object_set_new(row, "md_dsmc_z", isfinite(z) ? json_real(z) : json_null());
  if (!isfinite(z))
    gg_files_reason_add(warnings, "md_dsmc_z", gg_common_quantity_name_in(&c->model, q),
                        "the mean or error of an engine is not known");
  json_object_set_new(row, "beyond_expected", json_boolean(gg_run_results_disagree(c, q)));
  if (has(md, q)) json_object_set_new(row, "md_theory_deviation", deviations_json(c, md, q, warnings));
  if (has(dsmc, q)) json_object_set_new(row, "dsmc_theory_deviation", deviations_json(c, dsmc, q, warnings));
  put_departure(row, c, GG_MD, q);
  put_departure(row, c, GG_DSMC, q);
  return row;
}

static json_t *engine_json(const gg_comparison *c, gg_engine_kind kind, json_t *warnings)
{
  const gg_result *r = c->by_engine[kind];
  if (r) return gg_files_run_document(r);
  json_array_append_new(warnings, json_sprintf("%s is null: %s", gg_run_engine_ops_of(kind)->name, c->refusal[kind]));
  return json_null();
}

/* Where md differs beyond what is expected: which causes apply. */
static void warn_causes(const gg_comparison *c, json_t *warnings)
{
  const char *cause[8];
  int marked = 0;
  for (int i = 0; i < gg_common_quantity_set_of(&c->model); i++)
    marked += gg_run_results_disagree(c, gg_common_quantity_at(&c->model, i));
  int n = marked ? gg_run_disagreement_causes(c, cause, 8) : 0;
  for (int i = 0; i < n; i++)
    json_array_append_new(warnings,
                          json_sprintf("md differs from Enskog's equation beyond what is expected: %s", cause[i]));
}

static void warn_remarks(const gg_comparison *c, json_t *warnings)
{
  gg_theory_remark r[GG_MOST_THEORIES];
  int n = gg_run_theory_remarks(c, r);
  for (int i = 0; i < n; i++)
    json_array_append_new(warnings,
                          json_sprintf("%s is off by %+.1f %% in %s: %s", r[i].theory->name, 100 * r[i].deviation,
                                       gg_common_quantity_name_in(&c->model, r[i].quantity), r[i].cause));
}

static json_t *comparison_document(const gg_comparison *c)
{
  if (c->document) return gg_base_json_read(c->document, NULL); /* as it was stored */
  json_t *warnings = warnings_json(c), *rows = json_array();
  json_t *md = engine_json(c, GG_MD, warnings), *dsmc = engine_json(c, GG_DSMC, warnings);
  json_t *theory = theories_json(c, warnings);
  for (int i = 0; i < gg_common_quantity_set_of(&c->model); i++) {
    gg_quantity q = gg_common_quantity_at(&c->model, i);
    if (has(c->by_engine[GG_MD], q) || has(c->by_engine[GG_DSMC], q))
      json_array_append_new(rows, row_json(c, q, warnings));
  }
  warn_causes(c, warnings);
  warn_remarks(c, warnings);
  json_t *document = json_pack("{s:s, s:o, s:o, s:o, s:o, s:o, s:o, s:o}", "graingas", GG_VERSION, "scene",
                               gg_scene_json(&c->scene), "md", md, "dsmc", dsmc, "theory", theory, "theories",
                               about_json(c), "comparison", rows, "warnings", warnings);
  put_theory_curves(document, c);
  return document;
}

json_t *gg_files_comparison_document(const gg_comparison *c)
{
  bool before = gg_base_memory_begin();
  return gg_base_json_end(before, comparison_document(c));
}
