/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "files/h5/result_restore.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "files/curve_table.h"
#include "files/result_document.h"
#include "graingas.h"
#include "io/checked_json.h"
#include "scene/model_of_scene.h"
#include "scene/scene_reader.h"
#include "theory/theory.h"

static void sample_nothing(void *context, void *state, const gg_sample *sample, double *values)
{
  (void)context, (void)state, (void)sample, (void)values;
}

static const char *evaluate_nothing(void *context, const gg_facts *facts, double *values)
{
  (void)context, (void)facts, (void)values;
  return "is defined by the program that wrote the file";
}

static gg_status add_quantities(const json_t *results, gg_extension **x, gg_error *err)
{
  gg_quantity_definition own[GG_MOST_OWN_QUANTITIES];
  int n = 0;
  const char *name;
  json_t *stored;
  json_object_foreach((json_t *)(uintptr_t)results, name, stored)
  {
    if (gg_common_quantity_find(name) != GG_N_QUANTITIES || n == GG_MOST_OWN_QUANTITIES) continue;
    own[n++] = (gg_quantity_definition){.name = name,
                                        .unit = json_string_value(json_object_get(stored, "unit")),
                                        .doc = json_string_value(json_object_get(stored, "doc"))};
  }
  if (n == 0) return GG_OK;
  const gg_observable_definition all = {
      .name = "stored", .n_quantities = n, .quantities = own, .sample = sample_nothing};
  gg_extension *with = gg_common_extension_with_observable(*x, &all, err);
  if (!with) return GG_FAILED;
  *x = with;
  return GG_OK;
}

static gg_status add_theory(const char *name, const json_t *about, gg_extension **x, gg_error *err)
{
  static const char *const some[] = {"temperature"}; /* what it answers stands in the file */
  const gg_theory_definition t = {.name = name,
                                  .title = json_string_value(json_object_get(about, "title")),
                                  .citation = json_string_value(json_object_get(about, "citation")),
                                  .assumptions = json_string_value(json_object_get(about, "assumptions")),
                                  .n_quantities = 1,
                                  .quantities = some,
                                  .evaluate = evaluate_nothing};
  return gg_theory_user_theory_add(x, &t, err);
}

/* User-defined quantities in the `results` of an engine's document, and user-defined theories in the `theories` (NULL:
 * none) of a comparison. *extension is NULL if there are none; else to be released. */
static gg_status read_extension(const json_t *results, const json_t *theories, gg_extension **extension, gg_error *err)
{
  gg_extension *x = NULL;
  gg_status status = add_quantities(results, &x, err);
  const char *name;
  json_t *about;
  json_object_foreach((json_t *)(uintptr_t)theories, name, about)
  {
    if (status != GG_OK || gg_theory_find(name) || gg_common_extension_theories(x) == GG_MOST_OWN_THEORIES) continue;
    status = add_theory(name, about, &x, err);
  }
  if (status == GG_OK)
    *extension = x;
  else
    gg_common_extension_release(x);
  return status;
}

static uint64_t count(const json_t *object, const char *key)
{
  return (uint64_t)json_integer_value(json_object_get(object, key));
}

static void restore_means(gg_result *r, const json_t *document)
{
  const json_t *results = json_object_get(document, "results");
  for (int i = 0; i < r->rows.n; i++) {
    gg_estimate *e = &r->value[r->rows.row[i].quantity];
    const json_t *stored = json_object_get(results, r->rows.row[i].name);
    *e = (gg_estimate){.mean = gg_io_json_number(stored, "mean"),
                       .error = gg_io_json_number(stored, "stderr"),
                       .correlation_time = gg_io_json_number(stored, "correlation_time"),
                       .samples = count(stored, "samples")};
    const char *reason = gg_io_json_string(stored, "reason");
    if (stored && isnan(e->mean)) snprintf(e->reason, sizeof e->reason, "%s", reason);
  }
}

/* Find the quantities of a result among the stored names; returns the number of names. */
static size_t find_correlated(const gg_result *r, const char *names, gg_correlations *c, size_t *place)
{
  size_t at = 0;
  for (char name[64]; *names; at++) {
    size_t length = strcspn(names, "\n");
    snprintf(name, sizeof name, "%.*s", (int)length, names);
    names += length + (names[length] == '\n');
    const gg_quantity_row *row = gg_run_rows_find(&r->rows, name);
    if (!row || c->n == GG_MOST_QUANTITIES || isnan(r->value[row->quantity].error)) continue;
    place[c->n] = at, c->quantity[c->n++] = row->quantity;
  }
  return at;
}

static gg_status restore_correlations(gg_result *r, const gg_stored_engine *e, gg_error *err)
{
  gg_correlations *c = &r->correlations;
  size_t place[GG_MOST_QUANTITIES];
  if (!e->correlated) return GG_OK;
  const size_t n = find_correlated(r, e->correlated, c, place);
  if (!e->coefficients || n * n != e->n_coefficients)
    return gg_base_fail(err, GG_BAD_FILE, "the stored correlations are not those of %zu quantities", n);
  c->coefficient = gg_base_array_new(c->n * c->n, sizeof *c->coefficient, err);
  if (!c->coefficient) return GG_FAILED;
  for (size_t i = 0; i < c->n; i++)
    for (size_t j = 0; j < c->n; j++) {
      const double stored = e->coefficients[place[i] * n + place[j]];
      if (!(fabs(stored) <= 1))
        return gg_base_fail(err, GG_BAD_FILE, "a stored correlation coefficient is not from -1 to 1");
      c->coefficient[i * c->n + j] = stored;
    }
  return GG_OK;
}

static double *copy_of(const double *from, size_t n, gg_error *err)
{
  double *to = gg_base_array_new(n, sizeof *to, err);
  if (to) memcpy(to, from, n * sizeof *to);
  return to;
}

static gg_status restore_history(gg_result *r, const gg_stored_engine *e, gg_error *err)
{
  gg_history *h = &r->history;
  memcpy(h->window, e->window, sizeof h->window);
  if (!e->n_series) return GG_OK;
  h->n = e->series[0].n;
  if (!(h->time = copy_of(e->series[0].time, h->n, err))) return GG_FAILED;
  for (int k = 0; k < GG_N_HISTORY; k++) {
    const gg_stored_series *s =
        gg_files_stored_series_find(e, gg_common_quantity_name(gg_common_quantity_of_history(k)));
    h->value[k] = s && s->n == h->n ? copy_of(s->value, h->n, err) : gg_base_array_new(h->n, sizeof(double), err);
    if (!h->value[k]) return GG_FAILED;
    for (size_t i = 0; (!s || s->n != h->n) && i < h->n; i++) h->value[k][i] = NAN;
  }
  return GG_OK;
}

/* The file's frame is that of the run, or of a comparison's md where there was one. */
static gg_status restore_frame(gg_result *r, const gg_stored_result *s, gg_error *err)
{
  const gg_frame *from = &s->last;
  bool its_own = !s->comparison || strcmp(r->engine, gg_common_engine_of(gg_files_stored_first(s))->name) == 0;
  if (!its_own || !from->velocity || from->n != (size_t)r->model.n) return GG_OK;
  gg_frame *to = &r->final;
  *to = (gg_frame){.time = from->time, .step = from->step, .n = from->n};
  if (!(to->velocity = copy_of(from->velocity, 3 * to->n, err))) return GG_FAILED;
  if (from->position && !(to->position = copy_of(from->position, 3 * to->n, err))) return GG_FAILED;
  if (from->spin && !(to->spin = copy_of(from->spin, 3 * to->n, err))) return GG_FAILED;
  if (from->species && !(to->species = gg_base_array_new(to->n, 1, err))) return GG_FAILED;
  if (from->species) memcpy(to->species, from->species, to->n);
  return GG_OK;
}

static void restore_effort(gg_result *r, const json_t *document)
{
  const json_t *total = json_object_get(document, "total"), *state = json_object_get(document, "engine_state");
  r->averaging = (gg_effort){count(document, "collisions"), gg_io_json_number(document, "cpu_seconds"), NAN};
  r->total = (gg_effort){count(total, "collisions"), gg_io_json_number(total, "cpu_seconds"),
                         gg_io_json_number(total, "wall_seconds")};
  r->engine_state = (gg_engine_state){.time = gg_io_json_number(state, "time"),
                                      .collisions = r->total.collisions,
                                      .events = count(state, "events"),
                                      .treated = count(state, "contact_time_collisions"),
                                      .overflows = count(state, "majorant_overflows"),
                                      .clamped = count(state, "law_clamped")};
  if (json_object_get(state, "contact_time"))
    r->scene->fixed.contact_time = r->model.contact_time = gg_io_json_number(state, "contact_time");
  if (json_object_get(state, "worst_overlap"))
    r->engine_state.worst_overlap = gg_io_json_number(state, "worst_overlap");
  if (json_object_get(state, "time_step")) r->engine_state.time_step = gg_io_json_number(state, "time_step");
  if (json_object_get(state, "time_step_bias"))
    r->engine_state.time_step_bias = gg_io_json_number(state, "time_step_bias");
  if (json_object_get(state, "particles_bias"))
    r->engine_state.particles_bias = gg_io_json_number(state, "particles_bias");
}

static gg_status restore_origin(gg_result *r, const gg_stored_result *s, const json_t *document, gg_error *err)
{
  char **const to[] = {&r->origin.version, &r->origin.command, &r->origin.machine, &r->origin.date};
  const char *const from[] = {s->version, s->command, s->machine, s->date};
  for (int i = 0; i < 4; i++)
    if (!(*to[i] = strdup(from[i] ? from[i] : ""))) return gg_base_out_of_memory(err);
  r->origin.document = gg_files_document_text(document);
  r->origin.frames = s->n_frames;
  return r->origin.document ? GG_OK : gg_base_out_of_memory(err);
}

gg_status gg_files_stored_scene(const gg_stored_result *s, gg_engine_kind engine, gg_scene *scene, gg_model *model,
                                gg_error *err)
{
  *scene = gg_scene_defaults();
  GG_TRY(gg_scene_read(scene, s->scene, strlen(s->scene), "the stored scene", err));
  return gg_scene_model_make(scene, engine, model, err);
}

static gg_status restore_all(gg_result *r, const gg_stored_result *s, gg_engine_kind engine, gg_error *err)
{
  const gg_stored_engine *e = &s->engine[engine];
  gg_scene scene;
  GG_TRY(gg_files_stored_scene(s, engine, &scene, &r->model, err));
  scene.engine = engine;
  if (!(r->scene = gg_scene_copy_new(&scene, err))) return GG_FAILED;
  GG_TRY(read_extension(json_object_get(e->document, "results"), NULL, &r->own, err));
  r->model.extension = r->own;
  gg_run_result_label(r);
  r->engine = gg_common_engine_of(engine)->name;
  bool steady = json_is_true(json_object_get(e->document, "steady"));
  r->escape_rate = gg_io_json_number(e->document, "escape_rate");
  r->steadiness = json_is_true(json_object_get(e->document, "metastable")) ? GG_METASTABLE
                  : steady                                                 ? GG_STEADY
                  : r->model.steady || r->model.linear_response            ? GG_NOT_STEADY
                                                                           : GG_HEATING;
  snprintf(r->steadiness_text, sizeof r->steadiness_text, "%s", gg_io_json_string(e->document, "verdict"));
  snprintf(r->ensemble_text, sizeof r->ensemble_text, "%s", gg_io_json_string(e->document, "particles_chosen"));
  size_t i;
  json_t *line;
  json_array_foreach(json_object_get(e->document, "warnings"), i, line) if (json_is_string(line))
      GG_WARN(r, "%s", json_string_value(line));
  restore_means(r, e->document);
  GG_TRY(restore_correlations(r, e, err));
  restore_effort(r, e->document);
  GG_TRY(restore_history(r, e, err));
  r->curves.model = &r->model;
  GG_TRY(gg_files_curves_from_json(&r->curves, json_object_get(e->document, "curves"), err));
  GG_TRY(restore_frame(r, s, err));
  return restore_origin(r, s, e->document, err);
}

gg_status gg_files_result_restore(const gg_stored_result *s, gg_engine_kind engine, gg_result **result, gg_error *err)
{
  GG_CLEARED(gg_run_result_freed) gg_result *r = gg_base_array_new(1, sizeof *r, err);
  if (!r) return GG_FAILED;
  const unsigned before = gg_base_memory_failures(); /* for a warning that is lost */
  GG_TRY(gg_base_memory_check(before, restore_all(r, s, engine, err), err));
  return GG_HAND_OVER(result, r), GG_OK;
}

/* Restore the answers of theories as stored. They are not computed anew: theories may have changed, and a user's
 * restitution law is not in the stored scene. */
static gg_status restore_theories(gg_comparison *c, const json_t *document, gg_error *err)
{
  const json_t *all = json_object_get(document, "theory");
  const gg_theory *theory;
  if (!json_is_object(all)) { /* a run's file: no theory was asked */
    return gg_run_compare_theories(&c->model, NULL, c, err);
  }
  const json_t *curves = json_object_get(document, GG_THEORY_CURVES);
  c->n_theories = 0;
  for (int i = 0; i < GG_MOST_THEORIES && (theory = gg_theory_of(&c->model, i)); i++, c->n_theories++) {
    const json_t *said = json_object_get(all, theory->name);
    const json_t *about = json_object_get(json_object_get(document, "theories"), theory->name);
    gg_theory_answer *answer = &c->theory[i].answer;
    c->theory[i].theory = theory;
    c->theory[i].applies = said != NULL;
    const char *reason = gg_io_json_string(about, "reason");
    if (!said)
      snprintf(c->theory[i].reason, sizeof c->theory[i].reason, "%s", *reason ? reason : "it is not in the file");
    for (int q = 0; q < GG_MOST_QUANTITIES; q++) answer->value[q] = answer->error[q] = NAN;
    snprintf(answer->remark, sizeof answer->remark, "%s", gg_io_json_string(about, "beyond"));
    for (int k = 0; said && k < c->rows.n; k++) {
      const gg_quantity_row *row = &c->rows.row[k];
      const json_t *one = json_object_get(said, row->name);
      answer->value[row->quantity] = gg_io_json_number(one, "mean");
      answer->error[row->quantity] = gg_io_json_number(one, "error");
    }
  }
  for (int i = 0; i < c->n_theories; i++) {
    c->theory[i].curves.model = &c->model;
    GG_TRY(gg_files_curves_from_json(&c->theory[i].curves, json_object_get(curves, c->theory[i].theory->name), err));
  }
  return GG_OK;
}

/* The engines' own quantities are the same. */
static gg_status restore_own(gg_comparison *c, const json_t *document, gg_error *err)
{
  const json_t *md = json_object_get(document, "md"),
               *part = json_is_object(md) ? md : json_object_get(document, "dsmc");
  GG_TRY(read_extension(json_object_get(part, "results"), json_object_get(document, "theories"), &c->own, err));
  c->model.extension = c->own;
  gg_run_rows_make(&c->model, &c->rows);
  return GG_OK;
}

/* "md is null: reason" */
static void restore_refusals(gg_comparison *c, const json_t *document)
{
  size_t i;
  json_t *line;
  json_array_foreach(json_object_get(document, "warnings"), i, line) for (int k = 0; k < GG_N_ENGINES; k++)
  {
    char head[24];
    int length = snprintf(head, sizeof head, "%s is null: ", gg_common_engine_of(k)->name);
    const char *said = json_string_value(line);
    if (said && strncmp(said, head, (size_t)length) == 0)
      snprintf(c->refusal[k], sizeof c->refusal[k], "%.250s", said + length);
  }
}

static gg_status restore_comparison(const gg_stored_result *s, gg_comparison *c, gg_error *err)
{
  gg_scene scene;
  GG_TRY(gg_files_stored_scene(s, GG_MD, &scene, &c->model, err));
  if (!(c->scene = gg_scene_copy_new(&scene, err))) return GG_FAILED;
  for (int k = 0; k < GG_N_ENGINES; k++)
    if (s->engine[k].name)
      GG_TRY(gg_files_result_restore(s, (gg_engine_kind)k, &c->by_engine[k], err));
    else if (!s->comparison)
      snprintf(c->refusal[k], sizeof c->refusal[k], "it was not run");
  if (s->comparison) {
    GG_TRY(restore_own(c, s->document, err));
    GG_TRY(restore_theories(c, s->document, err));
  } else {
    const gg_result *one = gg_run_comparison_first(c);
    c->model.extension = one ? one->model.extension : NULL;
    gg_run_rows_make(&c->model, &c->rows);
  }
  restore_refusals(c, s->document);
  if (s->comparison) gg_scene_ineffective_keys(c->scene, GG_USE_MD | GG_USE_DSMC | GG_USE_THEORY, &c->warnings);
  c->of_one = !s->comparison;
  gg_run_causes_find(c, &c->causes);
  c->document = gg_files_document_text(s->document);
  return c->document ? GG_OK : gg_base_out_of_memory(err);
}

gg_status gg_files_comparison_restore(const gg_stored_result *s, gg_comparison *c, gg_error *err)
{
  *c = (gg_comparison){0};
  const unsigned before = gg_base_memory_failures();
  return gg_base_memory_check(before, restore_comparison(s, c, err), err);
}
