/* The points of a sweep: which values each takes, its scene, and whether that can be simulated. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "common/engine.h"
#include "run/cost_estimate.h"
#include "run/replicas.h"
#include "scene/scene_reader.h"
#include "sweep/sweep.h"

size_t gg_sweep_count(const gg_sweep *sweep)
{
  size_t n = 1;
  for (size_t f = 0; f < sweep->n_varied && n; f++)
    n = sweep->varied[f].n > GG_MOST_POINTS / n ? 0 : n * sweep->varied[f].n;
  return n;
}

size_t gg_sweep_row(const gg_sweep *sweep, size_t i, size_t varied)
{
  for (size_t f = sweep->n_varied - 1; f > varied; f--) i /= sweep->varied[f].n;
  return i % sweep->varied[varied].n;
}

/* The varied keys to which the k-th key of all belongs; *k is its place among them. */
static const gg_varied *varied_of(const gg_sweep *sweep, size_t *k, size_t *varied)
{
  for (*varied = 0; sweep && *varied < sweep->n_varied; ++*varied) {
    const gg_varied *v = &sweep->varied[*varied];
    if (*k < v->n_keys) return v;
    *k -= v->n_keys;
  }
  return NULL;
}

const char *gg_sweep_key(const gg_sweep *sweep, size_t k)
{
  size_t f;
  const gg_varied *v = varied_of(sweep, &k, &f);
  return v ? v->key[k] : NULL;
}

static const char *value_of(const gg_sweep *sweep, size_t i, size_t k)
{
  size_t f;
  const gg_varied *v = varied_of(sweep, &k, &f);
  return v ? v->value[gg_sweep_row(sweep, i, f) * v->n_keys + k] : NULL;
}

const char *gg_sweep_value(const gg_sweep *sweep, size_t i, size_t k)
{
  return sweep && i < sweep->n ? value_of(sweep, i, k) : NULL;
}

void gg_sweep_name_point(const gg_sweep *sweep, size_t i, char *text, size_t size)
{
  char whole[400] = "";
  for (size_t k = 0; gg_sweep_key(sweep, k); k++)
    gg_base_text_append(whole, sizeof whole, "%s%s %s", *whole ? ", " : "", gg_sweep_key(sweep, k),
                        value_of(sweep, i, k));
  gg_scene_quote(whole, text, size);
}

static gg_status set_values(const gg_sweep *sweep, size_t i, gg_scene *scene, gg_error *err)
{
  for (size_t k = 0; gg_sweep_key(sweep, k); k++)
    GG_TRY(gg_scene_override(scene, gg_sweep_key(sweep, k), value_of(sweep, i, k), err));
  return GG_OK;
}

/* What one engine needs for a scene; GG_BAD_INPUT where it cannot run it. */
static gg_status cost_of(const gg_scene *scene, gg_engine_kind engine, gg_cost_estimate *cost, double *warmup,
                         gg_error *err)
{
  gg_model model;
  GG_TRY(gg_common_model_make(scene, engine, &model, err));
  GG_TRY(gg_run_engine_ops_of(engine)->accepts(&model, err));
  *cost = gg_run_cost_estimate(scene, &model, engine);
  *warmup = (double)gg_run_criteria_of(scene, &model).warmup * GG_SAMPLING_INTERVAL;
  return GG_OK;
}

/* A run that goes on until an error is shared among replicas: as many as keep each below `longest`, and warm-ups, which
 * each of them has, below a fifth of the whole. By the scene alone: the same on every machine. */
static int64_t replicas_for(const gg_cost_estimate *f, double warmup, double longest)
{
  enum { MOST = 1000 };
  if (!f->to_an_error || !(f->seconds > longest)) return 1;
  double wanted = ceil(f->seconds / longest), worth = floor((f->collisions - warmup) / (4 * fmax(warmup, 1)));
  return (int64_t)fmax(1, fmin(fmin(wanted, worth), MOST));
}

static gg_status add_theories(const gg_scene *scene, double *seconds, gg_error *err)
{
  gg_model model;
  GG_TRY(gg_common_model_make(scene, GG_MD, &model, err));
  *seconds += gg_run_cost_of_theories(&model);
  return GG_OK;
}

/* Seconds of all engines and theories that take part, and the replicas that it is shared among. */
static gg_status estimate_point(const gg_sweep *sweep, gg_scene *scene, double *seconds, gg_error *err)
{
  const gg_does does = sweep->settings.does;
  *seconds = 0;
  if (does == GG_DOES_THEORY) return add_theories(scene, seconds, err);
  int64_t replicas = 1;
  gg_status some = GG_BAD_INPUT;
  const bool chosen = gg_scene_is_given(scene, "run.replicas");
  for (int k = 0; k < 2; k++) {
    gg_cost_estimate f;
    double warmup;
    if (does == GG_DOES_RUN && scene->engine != (gg_engine_kind)k) continue;
    if (cost_of(scene, (gg_engine_kind)k, &f, &warmup, some == GG_OK ? NULL : err) != GG_OK) continue;
    some = GG_OK;
    *seconds += f.seconds;
    int64_t n = replicas_for(&f, warmup, sweep->settings.longest);
    if (n > replicas) replicas = n;
  }
  if (!chosen) scene->run.replicas = replicas;
  if (some == GG_OK && does == GG_DOES_COMPARE) GG_TRY(add_theories(scene, seconds, err));
  return some;
}

static gg_status resolve(const gg_sweep *sweep, size_t i, gg_scene *scene, double *seconds, gg_error *err)
{
  *scene = sweep->base;
  GG_TRY(set_values(sweep, i, scene, err));
  GG_TRY(gg_scene_finish(scene, err));
  GG_TRY(estimate_point(sweep, scene, seconds, err));
  if (sweep->settings.seeds == GG_SEEDS_INDEPENDENT && !gg_sweep_sets(sweep, "run.seed"))
    scene->run.seed = gg_sweep_point_seed(sweep, scene);
  return GG_OK;
}

/* The same, with messages that name the point. */
static gg_status resolve_named(const gg_sweep *sweep, size_t i, gg_scene *scene, double *seconds, gg_error *err)
{
  char name[200];
  gg_status status = resolve(sweep, i, scene, seconds, err);
  if (status == GG_OK || !sweep->n_varied) return status;
  gg_sweep_name_point(sweep, i, name, sizeof name);
  return gg_base_error_prefix(err, status, "%s: point %zu of %zu (%s)", sweep->name, i + 1, gg_sweep_count(sweep),
                              name);
}

gg_status gg_sweep_resolve(const gg_sweep *sweep, size_t i, gg_scene *scene, gg_error *err)
{
  double seconds;
  bool before = gg_base_memory_begin();
  gg_status status = resolve_named(sweep, i, scene, &seconds, err);
  return gg_base_memory_end(before) ? gg_base_error_prefix(err, gg_base_out_of_memory(err), "%s", sweep->name) : status;
}

static void explain_number(const gg_sweep *sweep, gg_error *err)
{
  double n = 1;
  for (size_t f = 0; f < sweep->n_varied; f++) n *= (double)sweep->varied[f].n;
  gg_base_fail(err, GG_BAD_INPUT, "%s: the sweep would have %.0f points; allowed: up to %d", sweep->name, n,
               GG_MOST_POINTS);
}

gg_status gg_sweep_check_points(gg_sweep *sweep, gg_error *err)
{
  const size_t n = gg_sweep_count(sweep);
  if (sweep->n) return GG_OK;
  if (!n) return explain_number(sweep, err), GG_BAD_INPUT;
  gg_point *point = gg_base_array_new(n, sizeof *point, err);
  if (!point) return GG_FAILED;
  for (size_t i = 0; i < n; i++) {
    gg_scene scene;
    bool before = gg_base_memory_begin();
    gg_status status = resolve_named(sweep, i, &scene, &point[i].seconds, err);
    if (status == GG_OK) point[i].id = gg_sweep_point_id(&scene, sweep->settings.does);
    if (gg_base_memory_end(before)) status = gg_base_error_prefix(err, gg_base_out_of_memory(err), "%s", sweep->name);
    if (status != GG_OK) return free(point), status;
  }
  sweep->point = point;
  sweep->n = n;
  return GG_OK;
}
