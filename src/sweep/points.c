/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The points of a sweep: their values, their scenes, and whether these can be simulated. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/checksum.h"
#include "base/memory.h"
#include "common/engine.h"
#include "common/extension.h"
#include "io/checked_json.h"
#include "run/cost_estimate.h"
#include "run/default_size.h"
#include "run/replicas.h"
#include "scene/fields.h"
#include "scene/model_of_scene.h"
#include "scene/scene_reader.h"
#include "sweep/sweep.h"

/* Identity of a point: a hash of its resolved scene, and the check that a file holds that scene. */

static bool begins(const char *key, const char *const *with)
{
  for (; *with; with++)
    if (strncmp(key, *with, strlen(*with)) == 0) return true;
  return false;
}

/* Keys that no number in the file of a point depends on. */
static bool is_left_out(const char *key, gg_does does)
{
  static const char *const never[] = {"output.checkpoint_every", "output.log", NULL};
  static const char *const of_run[] = {"engine", NULL};
  static const char *const of_simulation[] = {"run.", "md.", "dsmc.", "output.", NULL};
  return begins(key, never) || (does != GG_DOES_RUN && begins(key, of_run)) ||
         (does == GG_DOES_THEORY && begins(key, of_simulation));
}

static uint64_t add_text(uint64_t sum, const char *text)
{
  return gg_base_checksum(sum, text, strlen(text) + 1);
}

static uint64_t add_field(uint64_t sum, const gg_field *f, const gg_scene *scene)
{
  json_auto_t *value = gg_scene_field_json(f, scene, scene);
  GG_FREED char *text =
      gg_io_json_text(value, JSON_COMPACT | JSON_SORT_KEYS | JSON_ENCODE_ANY | JSON_REAL_PRECISION(17));
  /* No memory: the name of another point; the lack is recorded. */
  return add_text(add_text(sum, f->key), text ? text : "");
}

/* Add the extension of the calling program to the hash, by its names: it has no values. */
static uint64_t add_extension(uint64_t sum, const gg_scene *scene)
{
  char signature[2048] = "";
  if (!scene->extension) return sum;
  gg_common_extension_signature(scene->extension, signature, sizeof signature);
  return *signature ? add_text(sum, signature) : sum; /* theories alone leave a point the same */
}

/* Mix the sum so that each bit changes every bit of the name (the finalizer of MurmurHash3). */
static uint64_t mix(uint64_t x)
{
  x = (x ^ (x >> 33)) * UINT64_C(0xff51afd7ed558ccd);
  x = (x ^ (x >> 33)) * UINT64_C(0xc4ceb9fe1a85ec53);
  return x ^ (x >> 33);
}

const char *const gg_sweep_does_words[] = {"run", "compare", "theory"};

/* Hash of a resolved scene and of what is done there: every key that numbers depend on, in the order of the field
 * table, with its value. */
static uint64_t point_id(const gg_scene *scene, gg_does does)
{
  uint64_t sum = add_text(GG_CHECKSUM_START, gg_sweep_does_words[does]);
  for (const gg_field *f = gg_scene_fields; f->key; f++)
    if (!is_left_out(f->key, does)) sum = add_field(sum, f, scene);
  return mix(add_extension(sum, scene));
}

static const json_t *value_in(const json_t *scene, const char *key)
{
  char section[32];
  const char *dot = strchr(key, '.');
  if (!dot) return json_object_get(scene, key);
  snprintf(section, sizeof section, "%.*s", (int)(dot - key), key);
  return json_object_get(json_object_get(scene, section), dot + 1);
}

static void value_text(const json_t *value, char *text, size_t size)
{
  snprintf(text, size, "no value");
  if (value) gg_scene_flow_style_text(value, text, size);
}

gg_status gg_sweep_point_check(const gg_scene *scene, gg_does does, const json_t *stored, const char *path,
                               gg_error *err)
{
  char there[40], here[40];
  json_auto_t *whole = gg_scene_json(scene);
  if (!whole) return gg_base_out_of_memory(err);
  for (const gg_field *f = gg_scene_fields; f->key; f++) {
    const json_t *value = value_in(stored, f->key), *wanted = value_in(whole, f->key);
    if (is_left_out(f->key, does) || (value && json_equal(value, wanted))) continue;
    value_text(value, there, sizeof there);
    value_text(wanted, here, sizeof here);
    return gg_base_fail(err, GG_BAD_FILE,
                        "%s: holds another point: %s is %s there, and %s at the point of this name; remove it, and the "
                        "point is done again",
                        path, f->key, there, here);
  }
  return GG_OK;
}

/* True for keys that the seed of a point depends on. The length of a run counts only if it is varied: a run that is
 * made longer, or has other replicas by a new estimate, keeps its seed. */
static bool is_of_seed(const gg_field *f, const gg_sweep *sweep)
{
  static const char *const none_of[] = {"engine", "run.", "output.", "measure", NULL};
  return !begins(f->key, none_of) || (strncmp(f->key, "run.", 4) == 0 && gg_sweep_sets(sweep, f->key));
}

/* 48 bits: few digits, and exact as a double in any reader. */
static uint64_t point_seed(const gg_sweep *sweep, const gg_scene *scene)
{
  const uint64_t seed = scene->run.seed;
  uint64_t sum = gg_base_checksum(GG_CHECKSUM_START, &seed, sizeof seed);
  for (const gg_field *f = gg_scene_fields; f->key; f++)
    if (is_of_seed(f, sweep)) sum = add_field(sum, f, scene);
  return mix(add_extension(sum, scene)) >> 16;
}

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

const char *gg_sweep_column_key(const gg_sweep *sweep, size_t k)
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

const char *gg_sweep_column_value(const gg_sweep *sweep, size_t i, size_t k)
{
  return sweep && i < sweep->n ? value_of(sweep, i, k) : NULL;
}

/* Add the cost of one engine for a scene; GG_BAD_INPUT if it cannot run the scene. */
static gg_status cost_of(const gg_scene *scene, gg_engine_kind engine, gg_cost_estimate *cost, double *warmup,
                         gg_error *err)
{
  gg_model model;
  GG_TRY(gg_scene_model_make(scene, engine, &model, err));
  GG_TRY(gg_common_engine_of(engine)->accepts(&model, err));
  *cost = gg_run_cost_estimate(scene, &model, engine);
  *warmup = (double)gg_run_criteria_of(scene, &model).warmup * GG_SAMPLING_INTERVAL;
  return GG_OK;
}

/* Number of replicas of a run that stops at a requested error: as many as keep each below `longest`, with warm-ups,
 * which each replica has, below a fifth of the whole. Depends on the scene alone, so it is the same on every machine.
 */
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
  GG_TRY(gg_scene_model_for_theories(scene, &model, err));
  *seconds += gg_theory_seconds(&model);
  return GG_OK;
}

/* Seconds of all engines and theories of a point, and its number of replicas. */
static gg_status estimate_point(const gg_sweep *sweep, gg_scene *scene, double *seconds, gg_error *err)
{
  const gg_does does = sweep->settings.does;
  *seconds = 0;
  if (does == GG_DOES_THEORY) return add_theories(scene, seconds, err);
  int64_t replicas = 1;
  gg_status some = GG_BAD_INPUT;
  const bool chosen = gg_scene_is_given(scene, "run.replicas");
  for (int k = 0; k < GG_N_ENGINES; k++) {
    gg_cost_estimate f;
    double warmup;
    if (does == GG_DOES_RUN && scene->engine != (gg_engine_kind)k) continue;
    if (cost_of(scene, (gg_engine_kind)k, &f, &warmup, some == GG_OK ? NULL : err) != GG_OK) continue;
    some = GG_OK;
    *seconds += f.seconds;
    int64_t n = replicas_for(&f, warmup, sweep->settings.longest);
    if (n > replicas) replicas = n;
  }
  if (!chosen && replicas > scene->run.replicas) scene->run.replicas = replicas;
  if (some == GG_OK && does == GG_DOES_COMPARE) GG_TRY(add_theories(scene, seconds, err));
  return some;
}

static gg_status resolve(const gg_sweep *sweep, size_t i, gg_scene *scene, double *seconds, gg_error *err)
{
  *scene = *sweep->base;
  for (size_t k = 0; gg_sweep_column_key(sweep, k); k++)
    GG_TRY(gg_scene_override(scene, gg_sweep_column_key(sweep, k), value_of(sweep, i, k), err));
  GG_TRY(gg_run_scene_finish(scene, err));
  GG_TRY(estimate_point(sweep, scene, seconds, err));
  if (sweep->settings.seeds == GG_SEEDS_INDEPENDENT && !gg_sweep_sets(sweep, "run.seed"))
    scene->run.seed = point_seed(sweep, scene);
  return GG_OK;
}

static gg_status resolve_named(const gg_sweep *sweep, size_t i, gg_scene *scene, double *seconds, gg_error *err)
{
  char whole[400] = "", name[200];
  gg_status status = resolve(sweep, i, scene, seconds, err);
  if (status == GG_OK || !sweep->n_varied) return status;
  for (size_t k = 0; gg_sweep_column_key(sweep, k); k++) /* "collision.e 0.5, phi 0.3" */
    gg_base_text_append(whole, sizeof whole, "%s%s %s", *whole ? ", " : "", gg_sweep_column_key(sweep, k),
                        value_of(sweep, i, k));
  gg_scene_quote(whole, name, sizeof name);
  return gg_base_error_prefix(err, status, "%s: point %zu of %zu (%s)", sweep->name, i + 1, gg_sweep_count(sweep),
                              name);
}

/* The same; *id: the name of its file, NULL: not wanted. */
static gg_status resolve_whole(const gg_sweep *sweep, size_t i, gg_scene *scene, double *seconds, uint64_t *id,
                               gg_error *err)
{
  const unsigned before = gg_base_memory_failures();
  gg_status status = resolve_named(sweep, i, scene, seconds, err);
  if (status == GG_OK && id) *id = point_id(scene, sweep->settings.does);
  return gg_base_memory_failures() != before ? gg_base_error_prefix(err, gg_base_out_of_memory(err), "%s", sweep->name)
                                             : status;
}

gg_status gg_sweep_resolve(const gg_sweep *sweep, size_t i, gg_scene *scene, gg_error *err)
{
  return resolve_whole(sweep, i, scene, &(double){0}, NULL, err);
}

static gg_status refuse_number(const gg_sweep *sweep, gg_error *err)
{
  double n = 1;
  for (size_t f = 0; f < sweep->n_varied; f++) n *= (double)sweep->varied[f].n;
  return GG_REFUSE(err, "%s: the sweep would have %.0f points; allowed: up to %d", sweep->name, n, GG_MOST_POINTS);
}

gg_status gg_sweep_check_points(gg_sweep *sweep, gg_error *err)
{
  gg_scene scene;
  const size_t n = gg_sweep_count(sweep);
  if (sweep->n) return GG_OK;
  if (!n) return refuse_number(sweep, err);
  GG_FREED gg_point *point = gg_base_array_new(n, sizeof *point, err);
  if (!point) return GG_FAILED;
  for (size_t i = 0; i < n; i++) GG_TRY(resolve_whole(sweep, i, &scene, &point[i].seconds, &point[i].id, err));
  GG_HAND_OVER(&sweep->point, point);
  return sweep->n = n, GG_OK;
}
