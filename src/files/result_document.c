/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "files/result_document.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/build.h"
#include "base/memory.h"
#include "base/text.h"
#include "files/curve_table.h"
#include "io/checked_json.h"
#include "run/z_scores.h"
#include "scene/fields.h"

static json_t *array(const double *x, size_t n)
{
  json_t *list = json_array();
  for (size_t i = 0; i < n; i++) json_array_append_new(list, gg_io_json_finite(x[i]));
  return list;
}

static json_t *numbers_json(const gg_curve *c)
{
  json_t *numbers = json_object();
  for (int i = 0; i < c->n_numbers; i++) {
    const gg_curve_number *p = &c->number[i];
    json_object_set_new(numbers, p->name,
                        json_pack("{s:o, s:o, s:s}", "mean", gg_io_json_finite(p->value), "stderr",
                                  gg_io_json_finite(p->error), "unit", p->unit));
  }
  return numbers;
}

static json_t *curve_json(const gg_curve *c)
{
  json_t *o = json_pack("{s:s, s:s, s:s, s:s, s:s, s:s, s:s, s:b, s:b, s:I}", "group", c->group, "panel", c->panel,
                        "label", c->label, "x_name", c->x_name, "x_unit", c->x_unit, "y_name", c->y_name, "unit",
                        c->unit, "log_x", c->log_x, "log_y", c->log_y, "samples", (json_int_t)c->samples);
  if (c->folded) json_object_set_new(o, "folded", json_true());
  json_object_set_new(o, "x", array(c->x, c->n));
  json_object_set_new(o, "value", array(c->value, c->n));
  json_object_set_new(o, "stderr", array(c->error, c->n));
  json_object_set_new(o, "numbers", numbers_json(c));
  if (c->reference)
    json_object_set_new(o, "reference",
                        json_pack("{s:s, s:o}", "label", c->reference_label, "value", array(c->reference, c->n)));
  return o;
}

json_t *gg_files_curves_json(const gg_curves *curves)
{
  json_t *all = json_object();
  for (int k = 0; k < curves->n; k++) json_object_set_new(all, curves->curve[k].name, curve_json(&curves->curve[k]));
  return all;
}

static void fill(double *to, size_t n, const json_t *list)
{
  for (size_t i = 0; i < n; i++) {
    const json_t *value = json_array_get(list, i);
    to[i] = json_is_number(value) ? json_number_value(value) : NAN;
  }
}

static void restore_numbers(gg_curve *c, const json_t *numbers)
{
  const char *name;
  json_t *one;
  json_object_foreach((json_t *)(uintptr_t)numbers, name, one)
  {
    int n = c->n_numbers;
    gg_measure_curve_put_number(c, name, gg_io_json_number(one, "mean"), gg_io_json_string(one, "unit"));
    if (c->n_numbers > n) c->number[n].error = gg_io_json_number(one, "stderr");
    if (c->n_numbers > n) c->number[n].setting = c->number[n].error == 0;
  }
}

static gg_status restore(gg_curves *list, const char *name, const json_t *stored, gg_error *err)
{
  const json_t *law = json_object_get(stored, "reference");
  list->group = gg_io_json_string(stored, "group");
  list->samples = (uint64_t)json_integer_value(json_object_get(stored, "samples"));
  gg_curve *c = gg_measure_curve_add(list, json_array_size(json_object_get(stored, "x")), name,
                                     gg_io_json_string(stored, "panel"), gg_io_json_string(stored, "label"));
  list->group = NULL; /* every curve has its own copy */
  if (list->failed) return gg_base_out_of_memory_for(err, "the curve %s", name);
  gg_measure_curve_axes(c, gg_io_json_string(stored, "x_name"), gg_io_json_string(stored, "x_unit"),
                        gg_io_json_string(stored, "y_name"), gg_io_json_string(stored, "unit"));
  c->folded = json_is_true(json_object_get(stored, "folded"));
  c->log_x = json_is_true(json_object_get(stored, "log_x"));
  c->log_y = json_is_true(json_object_get(stored, "log_y"));
  fill(c->x, c->n, json_object_get(stored, "x"));
  fill(c->value, c->n, json_object_get(stored, "value"));
  fill(c->error, c->n, json_object_get(stored, "stderr"));
  restore_numbers(c, json_object_get(stored, "numbers"));
  if (!law) return GG_OK;
  gg_measure_curve_beside(c, gg_io_json_string(law, "label"), gg_measure_curve_level, &(double){0});
  if (c->law_lost) return gg_base_out_of_memory_for(err, "the curve %s", name);
  if (c->reference) fill(c->reference, c->n, json_object_get(law, "value"));
  return GG_OK;
}

gg_status gg_files_curves_from_json(gg_curves *list, const json_t *curves, gg_error *err)
{
  const char *name;
  json_t *stored;
  json_object_foreach((json_t *)(uintptr_t)curves, name, stored) GG_TRY(restore(list, name, stored, err));
  return GG_OK;
}

static json_t *warnings_json(const gg_string_list *texts)
{
  json_t *warnings = json_array();
  for (size_t i = 0; i < texts->n; i++) json_array_append_new(warnings, json_string(texts->text[i]));
  return warnings;
}

bool gg_files_quantity_is_measured(const gg_estimate *e)
{
  return !isnan(e->mean) || e->reason[0];
}

/* Position at which the names end in "who: a, b are null: reason", before "is" or "are"; 0 for any other line. */
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

/* Add "who: quantity is null: reason" to the warnings; quantities with the same reason share a line. */
static void add_reason(json_t *warnings, const char *who, const char *quantity, const char *reason)
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
    add_reason(warnings, "", row->name, e->reason);
  else if (isnan(e->error))
    add_reason(warnings, "stderr", row->name, e->reason[0] ? e->reason : "too few samples");
  json_t *json =
      json_pack("{s:o, s:o, s:s, s:I, s:o, s:s}", "mean", gg_io_json_finite(e->mean), "stderr",
                gg_io_json_finite(e->error), "unit", row->unit, "samples", (json_int_t)e->samples, "correlation_time",
                gg_io_json_finite(e->correlation_time), "correlation_time_unit", r->correlation_time_unit);
  if (isnan(e->mean)) json_object_set_new(json, "reason", json_string(e->reason));
  if (row->quantity >= GG_N_QUANTITIES) json_object_set_new(json, "doc", json_string(row->doc));
  return json;
}

static json_t *engine_state_json(const gg_result *r)
{
  const gg_engine_state *s = &r->engine_state;
  json_t *state = json_pack("{s:o, s:I}", "time", gg_io_json_finite(s->time), "events", (json_int_t)s->events);
  if (strcmp(r->engine, "md") == 0) {
    json_object_set_new(state, "contact_time_collisions", json_integer((json_int_t)s->treated));
    if (r->scene->fixed.contact_time != GG_AUTO)
      json_object_set_new(state, "contact_time", gg_io_json_finite(r->scene->fixed.contact_time));
    json_object_set_new(state, "worst_overlap", gg_io_json_finite(s->worst_overlap));
  } else {
    json_object_set_new(state, "majorant_overflows", json_integer((json_int_t)s->overflows));
    json_object_set_new(state, "time_step", gg_io_json_finite(s->time_step));
    json_object_set_new(state, "time_step_bias", gg_io_json_finite(s->time_step_bias));
    json_object_set_new(state, "particles_bias", gg_io_json_finite(s->particles_bias));
  }
  if (r->model.law.e || gg_speed_laws_any(&r->model.by_speed, gg_pairs_of(r->model.n_species)))
    json_object_set_new(state, "law_clamped", json_integer((json_int_t)s->clamped));
  return state;
}

static json_t *run_document(const gg_result *r)
{
  if (r->origin.document) return gg_io_json_read(r->origin.document, NULL); /* as it was stored */
  json_t *results = json_object(), *warnings = warnings_json(&r->warnings);
  for (int i = 0; i < r->rows.n; i++) {
    const gg_quantity_row *row = &r->rows.row[i];
    if (gg_files_quantity_is_measured(&r->value[row->quantity]))
      json_object_set_new(results, row->name, estimate_json(r, row, warnings));
  }
  json_t *document = json_pack(
      "{s:s, s:s, s:o, s:s, s:b, s:s, s:I, s:I, s:o, s:{s:I, s:o, s:o}, s:o, s:o, s:o}", "graingas",
      gg_base_build_version, "build", gg_base_build_identity, "scene", gg_scene_json(r->scene), "engine", r->engine,
      "steady", gg_run_is_steady(r->steadiness), "verdict", r->steadiness_text, "particles", (json_int_t)r->model.n,
      "collisions", (json_int_t)r->averaging.collisions, "cpu_seconds", gg_io_json_finite(r->averaging.cpu_seconds),
      "total", "collisions", (json_int_t)r->total.collisions, "cpu_seconds", gg_io_json_finite(r->total.cpu_seconds),
      "wall_seconds", gg_io_json_finite(r->total.wall_seconds), "engine_state", engine_state_json(r), "results",
      results, "warnings", warnings);
  if (r->steadiness == GG_METASTABLE) json_object_set_new(document, "metastable", json_true());
  if (isfinite(r->escape_rate)) json_object_set_new(document, "escape_rate", gg_io_json_finite(r->escape_rate));
  if (*r->ensemble_text) json_object_set_new(document, "particles_chosen", json_string(r->ensemble_text));
  if (r->curves.n) json_object_set_new(document, "curves", gg_files_curves_json(&r->curves));
  return document;
}

json_t *gg_files_run_document(const gg_result *r)
{
  const unsigned before = gg_base_memory_failures();
  return gg_io_json_end(before, run_document(r));
}

char *gg_files_document_text(const json_t *document)
{
  return gg_io_json_text(document, JSON_INDENT(1) | JSON_REAL_PRECISION(17));
}

/* The documents of `compare` and `theory`. */

/* Answers of the theories: {"lun1991": {"temperature": {"mean":, "unit":}}}, with "error" where a theory is solved
 * numerically and tells it; those that do not apply are warnings. */
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
    const char *remark = c->theory[i].answer.remark, *beyond = applies && *remark ? remark : NULL,
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
  json_t *warnings = warnings_json(&c->warnings), *theory = theories_json(c, warnings);
  json_t *document =
      json_pack("{s:s, s:s, s:o, s:o, s:o, s:o}", "graingas", gg_base_build_version, "build", gg_base_build_identity,
                "scene", gg_scene_json(scene), "theory", theory, "theories", about_json(c), "warnings", warnings);
  put_theory_curves(document, c);
  return gg_io_json_end(before, document);
}

/* theory/engine - 1 of every theory with an answer; left out where the engine has no mean, and
 * where the engine's value is that of a gas at one time. */
static void put_deviations(json_t *json, const gg_comparison *c, int k, const gg_quantity_row *row, json_t *warnings)
{
  const gg_result *engine = c->by_engine[k];
  json_t *all = json_object();
  char key[64];
  bool small = false;
  for (int i = 0; i < c->n_theories && gg_run_has_theories(c, row->quantity); i++) {
    double value = c->theory[i].answer.value[row->quantity];
    if (!c->theory[i].applies || !isfinite(value)) continue;
    double deviation = gg_run_deviation(&engine->value[row->quantity], value);
    small |= isnan(deviation);
    json_object_set_new(all, c->theory[i].theory->name, isnan(deviation) ? json_null() : json_real(deviation));
  }
  if (small)
    add_reason(warnings, engine->engine, row->name,
               "the relative deviation of theories, since the mean is within three standard errors of zero");
  snprintf(key, sizeof key, "%s_theory_deviation", engine->engine);
  json_object_set_new(json, key, all);
}

/* Deviation of an engine from Enskog's equation solved without random numbers; no key where there is none. */
static void put_enskog_deviation(json_t *json, gg_engine_kind kind, const gg_departure *d)
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
    snprintf(key, sizeof key, "%s_enskog_%s", gg_common_engine_of(kind)->name, numbers[i].word);
    if (isfinite(numbers[i].value)) json_object_set_new(json, key, json_real(numbers[i].value));
  }
}

/* NULL: neither engine has a mean. */
static json_t *row_json(const gg_comparison *c, const gg_quantity_row *named, json_t *warnings)
{
  gg_comparison_row row;
  gg_run_comparison_row(c, named, &row);
  bool some = false;
  for (int k = 0; k < GG_N_ENGINES; k++) some |= isfinite(row.mean[k]);
  if (!some) return NULL;
  json_t *json = json_pack("{s:s, s:s, s:o, s:b}", "quantity", row.name, "unit", row.unit, "md_dsmc_z",
                           gg_io_json_finite(row.z), "beyond_expected", row.beyond);
  if (!isfinite(row.z)) add_reason(warnings, "md_dsmc_z", row.name, "the mean or error of an engine is unknown");
  for (int k = 0; k < GG_N_ENGINES; k++)
    if (isfinite(row.mean[k])) put_deviations(json, c, k, named, warnings);
  for (int k = 0; k < GG_N_ENGINES; k++) put_enskog_deviation(json, (gg_engine_kind)k, &row.departure[k]);
  return json;
}

static json_t *engine_json(const gg_comparison *c, gg_engine_kind kind, json_t *warnings)
{
  const gg_result *r = c->by_engine[kind];
  if (r) return gg_files_run_document(r);
  json_array_append_new(warnings, json_sprintf("%s is null: %s", gg_common_engine_of(kind)->name, c->refusal[kind]));
  return json_null();
}

/* Warn where md, or a theory, deviates by more than is expected, with causes. */
static void warn_deviations(const gg_comparison *c, json_t *warnings)
{
  gg_causes causes;
  gg_run_theory_remark r[GG_MOST_THEORIES];
  const int n = gg_run_theory_remarks(c, r);
  gg_run_causes_find(c, &causes);
  for (int i = 0; i < causes.n; i++)
    json_array_append_new(warnings,
                          json_sprintf("md deviates from Enskog's equation more than expected: %s", causes.text[i]));
  for (int i = 0; i < n; i++)
    json_array_append_new(warnings,
                          json_sprintf("%s deviates by %+.1f %% in %s: %s", r[i].theory->name, 100 * r[i].deviation,
                                       gg_run_rows_at(&c->rows, r[i].quantity)->name, r[i].cause));
}

static json_t *comparison_document(const gg_comparison *c)
{
  if (c->document) return gg_io_json_read(c->document, NULL); /* as it was stored */
  json_t *warnings = warnings_json(&c->warnings), *rows = json_array();
  json_t *document = json_pack("{s:s, s:s, s:o}", "graingas", gg_base_build_version, "build", gg_base_build_identity,
                               "scene", gg_scene_json(c->scene));
  for (int k = 0; k < GG_N_ENGINES; k++)
    json_object_set_new(document, gg_common_engine_of(k)->name, engine_json(c, (gg_engine_kind)k, warnings));
  json_object_set_new(document, "theory", theories_json(c, warnings));
  for (int i = 0; i < c->rows.n; i++) {
    json_t *row = row_json(c, &c->rows.row[i], warnings);
    if (row) json_array_append_new(rows, row);
  }
  warn_deviations(c, warnings);
  json_object_set_new(document, "theories", about_json(c));
  json_object_set_new(document, "comparison", rows);
  json_object_set_new(document, "warnings", warnings);
  put_theory_curves(document, c);
  return document;
}

json_t *gg_files_comparison_document(const gg_comparison *c)
{
  const unsigned before = gg_base_memory_failures();
  return gg_io_json_end(before, comparison_document(c));
}

enum { LONGEST_NAME = 63 };

/* Keys of scenes, numbers of curves and the like: "gamma_2_4.5", "1-10". */
static bool is_word(const char *key)
{
  static const char plain[] = ".-ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_";
  return *key && *key != '.' && *key != '-' && !key[strspn(key, plain)];
}

/* True for names that are registered: quantities, theories, curves; some curves end with a number:
 * local_distribution_Cx_0.5. */
static bool is_allowed(const char *key, const char *name)
{
  static const char *const registered[] = {"results", "theory", "theories"};
  for (size_t i = 0; i < sizeof registered / sizeof *registered; i++)
    if (strcmp(registered[i], key) == 0) return gg_base_text_is_name(name, LONGEST_NAME);
  bool curves = strcmp(key, "curves") == 0 || strcmp(key, GG_THEORY_CURVES) == 0;
  return is_word(name) && (!curves || strlen(name) <= LONGEST_NAME);
}

static bool make_text_printable(json_t *value)
{
  if (gg_base_text_is_printable(json_string_value(value))) return true;
  GG_FREED char *copy = strdup(json_string_value(value));
  if (copy) gg_base_text_make_printable(copy);
  const bool good = copy && json_string_set(value, copy) == 0;
  if (!good) gg_base_memory_lacked();
  return good;
}

/* Error in the value of a key, or within it; NULL: none. */
static const char *check_value(const char *key, json_t *value)
{
  const char *name, *wrong = NULL;
  json_t *one;
  size_t i;
  if (json_is_string(value) && !make_text_printable(value)) return "out of memory";
  if (json_is_string(value) && strcmp(key, "group") == 0 &&
      !gg_base_text_is_name(json_string_value(value), LONGEST_NAME))
    return "the observable of a curve in it has a name that is not allowed";
  json_array_foreach(value, i, one) if (!wrong) wrong = check_value("", one);
  json_object_foreach(value, name, one)
  {
    const bool good = is_allowed(key, name);
    if (!wrong)
      wrong = good ? check_value(name, one) : "a quantity, curve or theory in it has a name that is not allowed";
  }
  return wrong;
}

json_t *gg_files_document_read(const char *text, const char **why)
{
  json_t *document = gg_io_json_read(text, why);
  const char *wrong = document ? check_value("", document) : NULL;
  if (!wrong) return document;
  *why = wrong;
  json_decref(document);
  return NULL;
}
