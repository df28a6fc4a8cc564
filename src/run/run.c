/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "run/run.h"

#include <math.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/clock.h"
#include "base/memory.h"
#include "graingas.h"
#include "run/protocol_times.h"
#include "run/replicas.h"
#include "run/scheduler.h"
#include "scene/ensemble_size.h"
#include "scene/fields.h"
#include "scene/model_of_scene.h"
#include "theory/near_steady.h"

/* Automatic ensembles and time steps of dsmc follow the requested error. A run that continues keeps those of its start.
 */
static bool has_other_numerics(const gg_scene *s)
{
  return gg_common_engine_of(s->engine)->ensemble &&
         gg_scene_ensemble_requested_error(s) != gg_scene_ensemble_size_error(s) &&
         (s->dsmc.time_step == GG_AUTO || !s->dsmc.particles || gg_flow_is_walled(s->flow));
}

/* Make a result of the present state of the replicas; it may fall short of the requested errors. */
static gg_status report(gg_replicas *all, gg_result **out, gg_error *err)
{
  GG_CLEARED(gg_run_result_freed) gg_result *result = gg_base_array_new(1, sizeof *result, err);
  if (!result) return GG_FAILED;
  gg_run_replicas_level(all);
  GG_TRY(gg_run_replicas_report(all, result, err)); /* out of memory: half a result is none */
  GG_HAND_OVER(out, result);
  if (has_other_numerics(&all->scene))
    GG_WARN(*out, "continued to another relative error: the ensemble and the time step are those chosen for %.3g %%",
            100 * gg_scene_ensemble_size_error(&all->scene));
  return gg_run_replicas_check_end(all, err);
}

static gg_status run_replicas(gg_replicas *all, gg_result **out, gg_error *err)
{
  gg_status status = gg_run_replicas_run(all, err);
  const bool ended = status == GG_OK;
  if (ended) status = report(all, out, err);
  if (ended && status == GG_INTERRUPTED && gg_run_replicas_store(all, err) != GG_OK) status = GG_BAD_FILE;
  bool cut_short = status == GG_INTERRUPTED || status == GG_BAD_FILE; /* a checkpoint that cannot be written */
  if (cut_short) report(all, out, NULL);
  if (status == GG_INTERRUPTED && *out) GG_WARN(*out, "interrupted: these are the results so far");
  return status;
}

/* Models are large (50 kB), and callers' threads may have small stacks: they lie on the heap here and below. */
gg_status gg_run_scene(const gg_scene *scene, const gg_archive *resume, int threads, const gg_run_callbacks *callbacks,
                       gg_result **out, gg_error *err)
{
  gg_replicas *all = gg_base_array_new(1, sizeof *all, err);
  gg_error own;
  *out = NULL;
  if (!all) return GG_FAILED;
  if (!err) err = &own;
  const unsigned before = gg_base_memory_failures();
  gg_status status = gg_run_replicas_create(all, scene, resume, threads, callbacks, err);
  bool created = status == GG_OK;
  if (created) status = run_replicas(all, out, err);
  while (created && status == GG_FAILED && !*out && err->cause == GG_CAUSE_COLLAPSE && gg_run_replicas_can_raise(all)) {
    status = gg_run_replicas_raise(all, threads, err);
    created = status == GG_OK;
    if (created) status = run_replicas(all, out, err);
  }
  if (created) gg_run_replicas_clear(all);
  free(all);
  if (!created) return gg_base_memory_check(before, status, err);
  if (gg_base_memory_failures() == before || status != GG_OK) return status;
  gg_result_free(*out); /* it lacks a warning, or worse */
  *out = NULL;
  return gg_base_error_prefix(err, gg_base_out_of_memory(err), "%s", gg_common_engine_of(scene->engine)->name);
}

/* Evaluate a theory's curves for the observables of the scene; others would waste time. A theory without curves for
 * this gas has no warning, since most have none at all. */
static gg_status draw_curves(gg_comparison *c, int i, gg_error *err)
{
  gg_error why = {0};
  const gg_theory *theory = c->theory[i].theory;
  if (!c->theory[i].applies || theory->gap) return GG_OK;
  const unsigned before = gg_base_memory_failures();
  gg_status status = gg_theory_curves(theory, &c->model, c->scene->measure, &c->theory[i].curves, &why);
  if (status == GG_INTERRUPTED) return gg_base_fail(err, status, "%s", why.message);
  if (gg_base_memory_failures() != before)
    return gg_base_error_prefix(err, gg_base_out_of_memory(err), "%s", theory->name);
  if (status == GG_FAILED) gg_base_string_list_add(&c->warnings, "%s: no curves: %s", theory->name, why.message);
  return GG_OK;
}

/* `start`: a model whose starting temperature is set before the first user-defined theory, which may read it. */
static gg_status compare_theories(const gg_model *model, const bool *wanted, gg_model *start, gg_comparison *c,
                                  gg_error *err)
{
  const gg_theory *theory;
  bool started = c->scene->start.temperature != GG_AUTO;
  for (int i = 0; i < GG_MOST_THEORIES && (theory = gg_theory_of(model, i)); i++) {
    gg_error why = {0};
    if (wanted && !wanted[i]) continue;
    if (theory->own && !started) {
      GG_TRY(gg_theory_start_near_steady(start, err));
      started = true;
    }
    const int n = c->n_theories;
    const unsigned before = gg_base_memory_failures();
    gg_status status = theory->gap
                           ? gg_theory_evaluate_gap(theory, &c->model, c->scene->measure, &c->theory[n].answer,
                                                    &c->theory[n].curves, &why)
                           : gg_theory_evaluate(theory, theory->own ? start : model, &c->theory[n].answer, &why);
    if (gg_base_memory_failures() != before)
      return gg_base_error_prefix(err, gg_base_out_of_memory(err), "%s", theory->name);
    if (status == GG_INTERRUPTED) return gg_base_fail(err, status, "%s", why.message);
    if (theory->own && status == GG_FAILED)
      gg_base_string_list_add(&c->warnings, "%s failed: %s", theory->name, why.message);
    c->theory[n].theory = theory;
    c->theory[n].applies = status == GG_OK;
    snprintf(c->theory[n].reason, sizeof c->theory[n].reason, "%.250s", why.message);
    GG_TRY(draw_curves(c, c->n_theories++, err));
  }
  return GG_OK;
}

gg_status gg_run_compare_theories(const gg_model *model, const bool *wanted, gg_comparison *c, gg_error *err)
{
  GG_FREED gg_model *start = gg_base_array_new(1, sizeof *start, err);
  if (!start) return GG_FAILED;
  c->model = *start = *model;
  gg_run_rows_make(&c->model, &c->rows);
  c->n_theories = 0;
  gg_status status = compare_theories(model, wanted, start, c, err);
  c->model.stop = NULL; /* it ends with the call */
  return status;
}

/* One engine's part of a comparison. Callbacks are called under `lock`. */
typedef struct part {
  gg_scene scene;
  gg_engine_kind kind;
  const gg_model *model; /* NULL: the scene has none of this engine */
  const gg_run_callbacks *callbacks;
  gg_run_scheduler *scheduler; /* NULL: its own, or the workers' */
  int threads;                 /* for this engine */
  gg_comparison *comparison;
  pthread_mutex_t *lock;
  gg_archive resume;  /* this engine's part of a checkpoint; empty: from the start */
  gg_archive *latest; /* both engines' last checkpoints, by kind */
  bool *broken;       /* a checkpoint could not be stored: the comparison is over, for both engines */
  const char *next;   /* the engine that has to wait for this one; NULL: none */
  double *fraction;   /* of both engines, by kind */
  gg_status status;
  gg_error err;
} part;

static void locked_progress(void *context, const gg_progress *progress)
{
  part *p = context;
  gg_progress now = *progress;
  now.next = p->next;
  GG_LOCKED(p->lock);
  p->fraction[p->kind] = fmax(p->fraction[p->kind], now.fraction);
  now.overall = 0;
  for (int k = 0; k < GG_N_ENGINES; k++) now.overall += p->fraction[k] / GG_N_ENGINES;
  p->callbacks->progress(p->callbacks->context, &now);
}

static bool locked_interrupted(void *context)
{
  part *p = context;
  GG_LOCKED(p->lock);
  return *p->broken || (p->callbacks->interrupted && p->callbacks->interrupted(p->callbacks->context));
}

/* A comparison's checkpoint is both engines' latest ones. */
static gg_status store_both(part *p, const gg_archive *archive, gg_error *err)
{
  GG_CLEARED(gg_base_archive_clear) gg_archive both = {0};
  gg_base_archive_clear(&p->latest[p->kind]);
  GG_TRY(gg_base_archive_nest(&p->latest[p->kind], gg_common_engine_of(p->kind)->name, archive, err));
  for (int k = 0; k < GG_N_ENGINES; k++) GG_TRY(gg_base_archive_append(&both, &p->latest[k], err));
  return p->callbacks->checkpoint(p->callbacks->context, &both, err);
}

static gg_status locked_checkpoint(void *context, gg_archive *archive, gg_error *err)
{
  part *p = context;
  GG_LOCKED(p->lock);
  gg_status status = store_both(p, archive, err);
  *p->broken |= status != GG_OK;
  return status;
}

static void run_part(part *p)
{
  gg_run_callbacks callbacks = {.context = p, .model = p->model};
  if (p->callbacks && p->callbacks->progress) callbacks.progress = locked_progress;
  if (p->callbacks && (p->callbacks->interrupted || p->callbacks->checkpoint))
    callbacks.interrupted = locked_interrupted;
  if (p->callbacks && p->callbacks->checkpoint) callbacks.checkpoint = locked_checkpoint;
  if (p->callbacks) callbacks.workers = p->callbacks->workers;
  callbacks.scheduler = p->scheduler;
  p->scene.engine = p->kind;
  p->status = gg_run_scene(&p->scene, p->resume.n_items ? &p->resume : NULL, p->threads, &callbacks,
                           &p->comparison->by_engine[p->kind], &p->err);
  GG_LOCKED(p->lock);
  p->fraction[p->kind] = 1; /* also of one that cannot run the scene */
}

/* Keep the reason if the engine cannot run the scene: the comparison goes without it. Other failures end it. */
static gg_status close_part(part *p, gg_error *err)
{
  gg_comparison *c = p->comparison;
  gg_result *result = c->by_engine[p->kind];
  bool refused = p->status == GG_BAD_INPUT && p->resume.n_items == 0;
  bool so_far = p->status == GG_FAILED || p->status == GG_INTERRUPTED || p->status == GG_BAD_FILE;
  if (p->status == GG_OK || refused || (result && so_far)) {
    if (refused) snprintf(c->refusal[p->kind], sizeof c->refusal[0], "%.250s", p->err.message);
    return GG_OK;
  }
  if (err) *err = p->err;
  return p->status;
}

static void control_part(void *context)
{
  part *p = context;
  gg_run_scheduler_enter(p->scheduler);
  run_part(p);
  gg_run_scheduler_leave(p->scheduler);
}

/* Run both parts, one after the other or side by side. Side by side, tasks of both engines share one queue; this thread
 * controls md, a new thread dsmc. If it cannot be started, dsmc runs after md. */
static gg_status run_parts(part parts[GG_N_ENGINES], bool beside, int threads, gg_error *err)
{
  gg_run_controller dsmc = {.started = false};
  const gg_run_callbacks *callbacks = parts[GG_MD].callbacks;
  gg_run_scheduler *own = NULL, *scheduler = callbacks ? callbacks->scheduler : NULL;
  bool distributed =
      callbacks && callbacks->workers && !parts[GG_MD].scene.extension; /* to be scheduled with the workers */
  if (beside && !scheduler && !distributed) {
    GG_TRY(gg_run_scheduler_new(threads, false, &own, err));
    gg_run_scheduler_enter(scheduler = own);
  }
  for (int k = 0; k < GG_N_ENGINES; k++) parts[k].scheduler = scheduler;
  const bool started = beside && gg_run_controller_start(&dsmc, control_part, &parts[GG_DSMC]);
  run_part(&parts[GG_MD]);
  if (!started && !*parts[GG_MD].broken) run_part(&parts[GG_DSMC]);
  gg_run_scheduler_leave(scheduler);
  gg_run_controller_join(&dsmc);
  gg_run_scheduler_enter(scheduler);
  gg_run_scheduler_free(own);
  return GG_OK;
}

/* No engine runs the scene: one reason, or one for each. */
static gg_status refuse_all(const gg_comparison *c, gg_error *err)
{
  bool same = true;
  char text[GG_N_ENGINES * 300] = "";
  for (int k = 0; k < GG_N_ENGINES; k++) {
    const size_t at = strlen(text);
    same &= strcmp(c->refusal[k], c->refusal[0]) == 0;
    snprintf(text + at, sizeof text - at, "%s%s: %s", k ? "; " : "", gg_common_engine_of(k)->name, c->refusal[k]);
  }
  return GG_REFUSE(err, "no engine can run this scene: %s", same ? c->refusal[0] : text);
}

static gg_status close_parts(part parts[GG_N_ENGINES], gg_comparison *c, gg_error *err)
{
  for (int k = 0; k < GG_N_ENGINES; k++) GG_TRY(close_part(&parts[k], err));
  if (!gg_run_comparison_first(c)) return refuse_all(c, err);
  const gg_status short_of[] = {GG_BAD_FILE, GG_INTERRUPTED, GG_FAILED};
  for (int i = 0; i < 3; i++)
    for (int k = 0; k < GG_N_ENGINES; k++)
      if (parts[k].status == short_of[i]) return gg_base_fail(err, short_of[i], "%s", parts[k].err.message);
  return GG_OK;
}

/* The caller's, or made here. */
static gg_status make_model(const gg_scene *scene, gg_engine_kind kind, const gg_run_callbacks *callbacks,
                            gg_model *model, gg_error *err)
{
  const gg_model *made = callbacks && scene->engine == kind ? callbacks->model : NULL;
  if (!made) return gg_scene_model_make(scene, kind, model, err);
  *model = *made;
  return GG_OK;
}

/* Theories beside a gas that is followed in time describe its last state, after all changes. */
static gg_status compare_theories_at_end(const gg_scene *scene, const gg_model *start, const gg_stop *stop,
                                         gg_comparison *c, gg_error *err)
{
  GG_FREED gg_model *model = gg_base_array_new(1, sizeof *model, err);
  if (!model) return GG_FAILED;
  *model = *start;
  const bool changes = *scene->protocol[0].key || gg_scene_shear_steps(scene) > 0;
  if (changes) GG_TRY(gg_run_protocol_end_model(scene, GG_MD, model, err));
  model->stop = stop;
  return gg_run_compare_theories(model, NULL, c, err);
}

static gg_status compare_scene(const gg_scene *scene, const gg_archive *resume, int threads,
                               const gg_run_callbacks *callbacks, gg_model model[GG_N_ENGINES], gg_comparison *c,
                               gg_error *err)
{
  GG_TRY(make_model(scene, GG_MD, callbacks, &model[GG_MD], err));
  if (callbacks && callbacks->model) model[GG_MD].start = callbacks->model->start;
  const bool dsmc = make_model(scene, GG_DSMC, callbacks, &model[GG_DSMC], NULL) == GG_OK;
  const gg_stop stop = {callbacks ? callbacks->interrupted : NULL, callbacks ? callbacks->context : NULL};
  GG_TRY(compare_theories_at_end(scene, &model[GG_MD], stop.asked ? &stop : NULL, c, err));

  pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
  gg_archive latest[GG_N_ENGINES] = {0};
  part parts[GG_N_ENGINES];
  double fraction[GG_N_ENGINES] = {0};
  bool beside = threads > 1 || (callbacks && callbacks->workers), broken = false;
  gg_status status = GG_OK;
  for (int k = 0; k < GG_N_ENGINES; k++) {
    parts[k] =
        (part){.scene = *scene, .kind = (gg_engine_kind)k, .callbacks = callbacks, .comparison = c, .lock = &lock};
    parts[k].threads = beside ? (threads + 1) / 2 : 1;
    parts[k].latest = latest;
    parts[k].broken = &broken;
    parts[k].fraction = fraction;
    const gg_engine_ops *ops = gg_common_engine_of(k);
    const char *name = ops->name;
    if (k == GG_MD || dsmc) parts[k].model = &model[k];
    if (k == GG_DSMC && !beside && dsmc && ops->accepts(&model[k], NULL) == GG_OK) parts[GG_MD].next = name;
    if (resume && status == GG_OK) status = gg_base_archive_unnest(&parts[k].resume, name, resume, err);
    if (resume && status == GG_OK) status = gg_base_archive_nest(&latest[k], name, &parts[k].resume, err);
  }
  if (status == GG_OK && resume && !parts[0].resume.n_items && !parts[1].resume.n_items)
    status = GG_REFUSE(err, "the checkpoint is not one of a comparison");
  if (status == GG_OK) status = run_parts(parts, beside, threads, err);
  if (status == GG_OK) status = close_parts(parts, c, err);
  for (int k = 0; k < GG_N_ENGINES; k++) gg_base_archive_clear(&parts[k].resume), gg_base_archive_clear(&latest[k]);
  pthread_mutex_destroy(&lock);
  return status;
}

gg_status gg_run_compare_scene(const gg_scene *scene, const gg_archive *resume, int threads,
                               const gg_run_callbacks *callbacks, gg_comparison *c, gg_error *err)
{
  GG_FREED gg_model *model = gg_base_array_new(GG_N_ENGINES, sizeof *model, err);
  memset(c, 0, sizeof *c);
  c->scene = gg_scene_copy_new(scene, err);
  if (!model || !c->scene) return GG_FAILED;
  const gg_status status = compare_scene(scene, resume, threads, callbacks, model, c, err);
  gg_run_causes_find(c, &c->causes);
  return status;
}

void gg_run_comparison_clear(gg_comparison *c)
{
  for (int k = 0; k < GG_N_ENGINES; k++) gg_result_free(c->by_engine[k]);
  for (int i = 0; i < c->n_theories; i++) gg_measure_curves_clear(&c->theory[i].curves);
  gg_scene_free(c->scene);
  gg_common_extension_release(c->own);
  free(c->document);
  gg_base_string_list_clear(&c->warnings);
  memset(c, 0, sizeof *c);
}
