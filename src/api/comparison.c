/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Comparisons: theories without simulation; rows and remarks; files and documents. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "api/api.h"
#include "base/memory.h"
#include "base/spelling.h"
#include "base/text.h"
#include "common/extension.h"
#include "files/h5/result_restore.h"
#include "files/result_document.h"
#include "run/protocol_times.h"
#include "run/z_scores.h"
#include "scene/fields.h"
#include "scene/model_of_scene.h"
#include "theory/haff1983.h"

void gg_comparison_free(gg_comparison *c)
{
  if (c) gg_run_comparison_clear(c);
  free(c);
}

void gg_api_comparison_freed(gg_comparison **comparison)
{
  gg_comparison_free(*comparison);
}

static gg_status choose_theories(const gg_model *model, const char *names, bool wanted[GG_MOST_THEORIES], gg_error *err)
{
  for (const char *at = names; at; at = strchr(at, ',') ? strchr(at, ',') + 1 : NULL) {
    at += strspn(at, " ");
    char name[64];
    snprintf(name, sizeof name, "%.*s", (int)strcspn(at, ", "), at);
    const gg_theory *theory;
    gg_nearest nearest = {.word = name};
    int i = 0;
    while (i < GG_MOST_THEORIES && (theory = gg_theory_of(model, i)) && strcmp(theory->name, name) != 0)
      gg_base_spelling_try(&nearest, theory->name), i++;
    if (i == GG_MOST_THEORIES || !theory)
      return GG_REFUSE(err, "there is no theory called '%s'%s%s%s", name, nearest.best ? "; did you mean '" : "",
                       nearest.best ? nearest.best : "", nearest.best ? "'?" : "");
    wanted[i] = true;
  }
  return GG_OK;
}

static gg_status evaluate(gg_comparison *c, const gg_scene *scene, const char *theory, const gg_stop *stop,
                          gg_model *model, gg_error *err)
{
  gg_scene finished, end;
  GG_TRY(gg_api_scene_finish(scene, &finished, err));
  if (!(c->scene = gg_scene_copy_new(&finished, err))) return GG_FAILED;
  GG_TRY(gg_run_protocol_end_scene(&finished, &end, err));
  GG_TRY(gg_scene_model_for_theories(&end, model, err));
  model->stop = stop;
  bool wanted[GG_MOST_THEORIES] = {false};
  if (theory) GG_TRY(choose_theories(model, theory, wanted, err));
  GG_TRY(gg_run_compare_theories(model, theory ? wanted : NULL, c, err));
  gg_scene_ineffective_keys(&finished, GG_USE_THEORY, &c->warnings);
  return GG_OK;
}

gg_status gg_theories_evaluate(const gg_scene *scene, const char *theory, int (*stop)(void *context), void *context,
                               gg_comparison **comparison, gg_error *err)
{
  GG_NEED(scene, comparison);
  const unsigned before = gg_base_memory_failures();
  GG_CLEARED(gg_api_comparison_freed) gg_comparison *c = gg_base_array_new(1, sizeof *c, err);
  GG_FREED gg_model *model = c ? gg_base_array_new(1, sizeof *model, err) : NULL;
  gg_status status = model ? evaluate(c, scene, theory, &GG_STOP_OF(stop, context), model, err) : GG_FAILED;
  GG_TRY(gg_base_memory_check(before, gg_base_callback_settle(status, err), err));
  return GG_HAND_OVER(comparison, c), GG_OK;
}

gg_status gg_theory_local_fluxes(const gg_scene *scene, const char *theory, size_t n, const gg_local_state *state,
                                 gg_local_fluxes *fluxes, gg_error *err)
{
  GG_NEED(scene, theory, state, fluxes);
  GG_CLEARED(gg_api_comparison_freed) gg_comparison *c = NULL;
  GG_TRY(gg_theories_evaluate(scene, theory, NULL, NULL, &c, err));
  return gg_theory_fluxes(c->theory[0].theory, &c->model, n, state, fluxes, err);
}

/* Whether the scenes differ only in the engine and in keys that may change on resume. */
static bool same_scene(const gg_scene *one, gg_scene other)
{
  GG_CLEARED(gg_base_archive_clear) gg_archive keys = {0};
  other.engine = one->engine;
  return gg_scene_resumption_put(&other, &keys, NULL) == GG_OK && gg_scene_resumption_check(one, &keys, NULL) == GG_OK;
}

gg_status gg_comparison_take(gg_comparison *comparison, gg_result *result, gg_error *err)
{
  GG_NEED(comparison, result);
  gg_engine_kind kind;
  GG_TRY(gg_api_engine_find(result->engine, &kind, err));
  if (comparison->document)
    return GG_REFUSE(err, "gg_comparison_take: a comparison read from a file cannot be changed");
  if (!same_scene(comparison->scene, *result->scene))
    return GG_REFUSE(err, "gg_comparison_take: the result belongs to another scene than the comparison");
  gg_result_free(comparison->by_engine[kind]);
  comparison->by_engine[kind] = result;
  return GG_OK;
}

const gg_result *gg_comparison_result(const gg_comparison *comparison, const char *engine)
{
  gg_engine_kind kind;
  if (!comparison || !engine || gg_api_engine_find(engine, &kind, NULL) != GG_OK) return NULL;
  return comparison->by_engine[kind];
}

const char *gg_comparison_refusal(const gg_comparison *comparison, const char *engine)
{
  gg_engine_kind kind;
  if (!comparison || !engine || gg_api_engine_find(engine, &kind, NULL) != GG_OK) return NULL;
  return comparison->refusal[kind][0] ? comparison->refusal[kind] : NULL;
}

const char *gg_comparison_warning(const gg_comparison *comparison, size_t i)
{
  return comparison ? gg_base_string_list_at(&comparison->warnings, i) : NULL;
}

const gg_scene *gg_comparison_scene(const gg_comparison *comparison)
{
  return comparison ? comparison->scene : NULL;
}

static gg_status find(const gg_comparison *c, const char *name, gg_quantity *q, gg_error *err)
{
  const gg_quantity_row *row;
  GG_TRY(gg_api_row_find(&c->rows, name, &row, err));
  return *q = row->quantity, GG_OK;
}

gg_status gg_comparison_at(const gg_comparison *comparison, size_t i, gg_comparison_row *row, gg_error *err)
{
  GG_NEED(comparison, row);
  const gg_quantity_rows *rows = &comparison->rows;
  if (i >= (size_t)rows->n) return GG_REFUSE(err, "gg_comparison_at: there are %d quantities", rows->n);
  gg_run_comparison_row(comparison, &rows->row[i], row);
  return GG_OK;
}

static bool has(const gg_result *r, gg_quantity q)
{
  return r && !isnan(r->value[q].mean);
}

gg_status gg_comparison_agreement(const gg_comparison *comparison, const char *quantity, double *z, int *beyond,
                                  gg_error *err)
{
  GG_NEED(comparison, quantity);
  gg_quantity q;
  GG_TRY(find(comparison, quantity, &q, err));
  const gg_result *md = comparison->by_engine[GG_MD], *dsmc = comparison->by_engine[GG_DSMC];
  if (z) *z = has(md, q) && has(dsmc, q) ? gg_run_z_score(&md->value[q], &dsmc->value[q]) : NAN;
  if (beyond) *beyond = gg_run_results_disagree(comparison, q);
  return GG_OK;
}

gg_status gg_comparison_departure(const gg_comparison *comparison, const char *engine, const char *quantity,
                                  gg_departure *departure, gg_error *err)
{
  GG_NEED(comparison, engine, quantity, departure);
  gg_quantity q;
  gg_engine_kind kind;
  GG_TRY(gg_api_engine_find(engine, &kind, err));
  GG_TRY(find(comparison, quantity, &q, err));
  if (!gg_run_enskog_deviation(comparison, kind, q, departure)) *departure = (gg_departure){NAN, NAN, NAN, NAN, NAN, 0};
  return GG_OK;
}

gg_status gg_comparison_theory(const gg_comparison *comparison, size_t i, gg_theory_info *theory, gg_error *err)
{
  GG_NEED(comparison, theory);
  const gg_comparison *c = comparison;
  if (i >= (size_t)c->n_theories) return GG_REFUSE(err, "this comparison has %d theories", c->n_theories);
  const gg_theory *t = c->theory[i].theory;
  const bool applies = c->theory[i].applies;
  const char *remark = c->theory[i].answer.remark;
  *theory = (gg_theory_info){.name = t->name,
                             .title = t->title,
                             .citation = t->citation,
                             .assumptions = t->assumptions,
                             .reason = applies ? NULL : c->theory[i].reason,
                             .beyond = applies && *remark ? remark : NULL};
  return GG_OK;
}

static gg_status find_theory(const gg_comparison *c, const char *theory, int *i, gg_error *err)
{
  for (*i = 0; *i < c->n_theories; ++*i)
    if (strcmp(c->theory[*i].theory->name, theory) == 0) return GG_OK;
  return GG_REFUSE(err, "there is no theory called '%.60s' here", theory);
}

static gg_status find_answer(const gg_comparison *c, const char *theory, const char *quantity, int *i, gg_quantity *q,
                             gg_error *err)
{
  GG_TRY(find(c, quantity, q, err));
  return find_theory(c, theory, i, err);
}

gg_status gg_comparison_theory_value(const gg_comparison *comparison, const char *theory, const char *quantity,
                                     double *value, double *deviation, gg_error *err)
{
  GG_NEED(comparison, theory, quantity);
  const gg_comparison *c = comparison;
  gg_quantity q;
  int i;
  GG_TRY(find_answer(c, theory, quantity, &i, &q, err));
  const gg_result *md = c->by_engine[GG_MD], *dsmc = c->by_engine[GG_DSMC];
  const gg_result *against = has(md, q) ? md : has(dsmc, q) ? dsmc : NULL;
  double answer = c->theory[i].applies ? c->theory[i].answer.value[q] : NAN;
  if (value) *value = isfinite(answer) ? answer : NAN;
  const bool comparable = against && isfinite(answer) && gg_run_has_theories(c, q);
  if (deviation) *deviation = comparable ? gg_run_deviation(&against->value[q], answer) : NAN;
  return GG_OK;
}

gg_status gg_comparison_theory_cooling(const gg_comparison *comparison, const char *theory, double time,
                                       double *temperature, gg_error *err)
{
  GG_NEED(comparison, theory, temperature);
  const gg_model *m = &comparison->model;
  int i;
  GG_TRY(find_theory(comparison, theory, &i, err));
  const double rate = comparison->theory[i].answer.value[GG_Q_COOLING_RATE];
  if (!gg_flow_cools(m->flow) || m->rule != GG_SMOOTH || m->n_species > 1 || m->law.name)
    return GG_REFUSE(err, "Haff's law holds for equal smooth grains that cool freely with a constant e");
  if (!comparison->theory[i].applies || !isfinite(rate))
    return GG_REFUSE(err, "%s gives no cooling rate for this scene", theory);
  if (!(time >= 0)) return GG_REFUSE(err, "%s: the time %g is before the start", theory, time);
  const double T0 = m->temperature0;
  *temperature = gg_theory_haff_temperature(T0, rate * gg_common_model_nu0(m, T0), time);
  return GG_OK;
}

gg_status gg_comparison_theory_error(const gg_comparison *comparison, const char *theory, const char *quantity,
                                     double *error, gg_error *err)
{
  GG_NEED(comparison, theory, quantity, error);
  gg_quantity q;
  int i;
  GG_TRY(find_answer(comparison, theory, quantity, &i, &q, err));
  *error = comparison->theory[i].applies ? comparison->theory[i].answer.error[q] : NAN;
  return GG_OK;
}

static gg_status find_curve(const gg_comparison *c, const char *theory, size_t i, const gg_curve **curve, gg_error *err)
{
  int k;
  GG_TRY(find_theory(c, theory, &k, err));
  const gg_curves *curves = &c->theory[k].curves;
  if (i >= (size_t)curves->n) return GG_REFUSE(err, "%s has %d curves here", theory, curves->n);
  return *curve = &curves->curve[i], GG_OK;
}

gg_status gg_comparison_theory_curve(const gg_comparison *comparison, const char *theory, size_t i,
                                     gg_curve_data *curve, gg_error *err)
{
  GG_NEED(comparison, theory, curve);
  const gg_curve *found;
  GG_TRY(find_curve(comparison, theory, i, &found, err));
  *curve = gg_api_curve_view(found);
  return GG_OK;
}

gg_status gg_comparison_theory_curve_number(const gg_comparison *comparison, const char *theory, size_t i, size_t k,
                                            gg_measurement *number, gg_error *err)
{
  GG_NEED(comparison, theory, number);
  const gg_curve *found;
  GG_TRY(find_curve(comparison, theory, i, &found, err));
  return gg_api_curve_number(found, k, "", number, err);
}

gg_status gg_comparison_remark(const gg_comparison *comparison, size_t i, gg_remark *remark, gg_error *err)
{
  GG_NEED(comparison, remark);
  gg_run_theory_remark theories[GG_MOST_THEORIES];
  const size_t causes = (size_t)comparison->causes.n;
  const size_t n = causes + (size_t)gg_run_theory_remarks(comparison, theories);
  if (i >= n) return GG_REFUSE(err, "this comparison has %zu remarks", n);
  if (i < causes) {
    *remark = (gg_remark){.deviation = NAN, .cause = comparison->causes.text[i]};
  } else {
    const gg_run_theory_remark *r = &theories[i - causes];
    const gg_quantity_row *row = gg_run_rows_at(&comparison->rows, r->quantity);
    *remark = (gg_remark){r->theory->name, row->name, r->deviation, r->cause};
  }
  return GG_OK;
}

gg_status gg_comparison_to_json(const gg_comparison *comparison, char **text, gg_error *err)
{
  GG_NEED(comparison, text);
  bool simulated = comparison->document || gg_run_comparison_first(comparison);
  return gg_api_text_copy(simulated ? gg_files_comparison_document(comparison)
                                    : gg_files_theory_document(comparison->scene, comparison),
                          text, err);
}

/* The result that gives the file its command, version and date. */
static gg_status first_of(const gg_comparison *c, const char *path, const gg_result **run, gg_error *err)
{
  *run = gg_run_comparison_first(c);
  return *run ? GG_OK : GG_REFUSE(err, "%s: not written: nothing was simulated", path);
}

gg_status gg_comparison_write(const gg_comparison *comparison, const char *path, int (*stop)(void *context),
                              void *context, gg_error *err)
{
  GG_NEED(comparison, path);
  const gg_result *run;
  GG_TRY(first_of(comparison, path, &run, err));
  return gg_api_file_write(run, comparison->of_one ? NULL : comparison, __func__, path, &GG_STOP_OF(stop, context),
                           err);
}

gg_status gg_comparison_to_bytes(const gg_comparison *comparison, void **bytes, size_t *size, gg_error *err)
{
  GG_NEED(comparison, bytes, size);
  const gg_result *run;
  GG_TRY(first_of(comparison, "the comparison", &run, err));
  return gg_api_file_to_bytes(run, comparison->of_one ? NULL : comparison, __func__, bytes, size, err);
}

static gg_status restore(gg_stored_result *stored, gg_comparison **comparison, gg_error *err)
{
  GG_CLEARED(gg_api_comparison_freed) gg_comparison *c = gg_base_array_new(1, sizeof *c, err);
  if (!c) return GG_FAILED;
  GG_TRY(gg_files_comparison_restore(stored, c, err));
  return GG_HAND_OVER(comparison, c), GG_OK;
}

gg_status gg_comparison_read(const char *path, gg_comparison **comparison, gg_error *err)
{
  GG_NEED(path, comparison);
  GG_CLEARED(gg_files_stored_result_clear) gg_stored_result stored = {0};
  GG_TRY(gg_files_stored_result_read(&stored, path, err));
  return restore(&stored, comparison, err);
}

gg_status gg_comparison_from_bytes(const void *bytes, size_t size, gg_comparison **comparison, gg_error *err)
{
  GG_NEED(bytes, comparison);
  GG_CLEARED(gg_files_stored_result_clear) gg_stored_result stored = {0};
  GG_TRY(gg_files_stored_result_from_bytes(&stored, bytes, size, err));
  return restore(&stored, comparison, err);
}
