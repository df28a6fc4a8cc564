/* Sweeps: read, changed, checked and asked. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "api/api.h"
#include "base/c_locale.h"
#include "base/memory.h"
#include "common/extension.h"
#include "scene/scene_reader.h"
#include "sweep/folder.h"
#include "sweep/settings.h"
#include "sweep/sweep_document.h"
#include "sweep/values.h"

static gg_sweep *new_sweep(const char *name, gg_error *err)
{
  gg_sweep *sweep = gg_base_array_new(1, sizeof *sweep, err);
  if (!sweep) return NULL;
  sweep->base = gg_common_scene_defaults();
  sweep->settings = gg_sweep_settings_defaults();
  sweep->name = strdup(name);
  if (sweep->name) return sweep;
  gg_base_out_of_memory(err);
  return free(sweep), NULL;
}

void gg_sweep_free(gg_sweep *sweep)
{
  if (!sweep) return;
  for (size_t f = 0; f < sweep->n_varied; f++) gg_sweep_varied_clear(&sweep->varied[f]);
  gg_common_extension_release(sweep->base.extension);
  free(sweep->point);
  free(sweep->name);
  free(sweep);
}

static gg_status read_text(const char *yaml, size_t length, const char *name, gg_sweep **sweep, gg_error *err)
{
  gg_sweep *made = new_sweep(name, err);
  if (!made) return GG_FAILED;
  locale_t before = gg_base_c_locale_enter();
  gg_status status = gg_sweep_read_text(made, yaml, length, name, err);
  gg_base_c_locale_leave(before);
  if (status == GG_OK)
    *sweep = made;
  else
    gg_sweep_free(made);
  return status;
}

gg_status gg_sweep_load(const char *path, gg_sweep **sweep, gg_error *err)
{
  GG_NEED(path);
  GG_NEED(sweep);
  char *text;
  size_t length;
  GG_TRY(gg_scene_file_text(path, &text, &length, err));
  gg_status status = read_text(text, length, gg_scene_file_name(path), sweep, err);
  free(text);
  return status;
}

gg_status gg_sweep_parse(const char *yaml, const char *name, gg_sweep **sweep, gg_error *err)
{
  GG_NEED(yaml);
  GG_NEED(sweep);
  return read_text(yaml, strlen(yaml), name ? name : "sweep", sweep, err);
}

static gg_status check_open(const gg_sweep *sweep, gg_error *err)
{
  return sweep->n
             ? gg_base_fail(err, GG_BAD_INPUT, "%s: the sweep was checked, and does not change any more", sweep->name)
             : GG_OK;
}

gg_status gg_sweep_set(gg_sweep *sweep, const char *key, const char *value, gg_error *err)
{
  GG_NEED(sweep);
  GG_NEED(key);
  GG_NEED(value);
  GG_TRY(check_open(sweep, err));
  if (gg_sweep_varies(sweep, key))
    return gg_base_fail(err, GG_BAD_INPUT, "key '%.60s': is varied: every point has its own", key);
  locale_t before = gg_base_c_locale_enter();
  gg_status status = strncmp(key, "sweep.", 6) == 0 ? gg_sweep_settings_set(&sweep->settings, key, value, err)
                                                    : gg_scene_override(&sweep->base, key, value, err);
  gg_base_c_locale_leave(before);
  return status;
}

static gg_status add_key(gg_sweep *sweep, const char *key, gg_values *values, gg_error *err)
{
  gg_varied one = {
      .n_keys = 1, .n = values->n, .key = gg_base_array_new(1, sizeof *one.key, err), .value = values->text};
  if (one.key) one.key[0] = strdup(key);
  if (!one.key || !one.key[0]) {
    free(one.key);
    return gg_base_out_of_memory(err);
  }
  *values = (gg_values){0};
  return gg_sweep_add(sweep, &one, err);
}

gg_status gg_sweep_vary(gg_sweep *sweep, const char *key, const char *values, gg_error *err)
{
  GG_NEED(sweep);
  GG_NEED(key);
  GG_NEED(values);
  gg_values list = {0};
  GG_TRY(check_open(sweep, err));
  locale_t before = gg_base_c_locale_enter();
  gg_status status = gg_sweep_values_parse(&list, key, values, err);
  if (status == GG_OK && list.range)
    status =
        gg_base_fail(err, GG_BAD_INPUT,
                     "key '%.60s': LOW..HIGH is for random draws, which a sweep's file asks for; here first:last:step "
                     "or v1,v2,...",
                     key);
  if (status == GG_OK) status = add_key(sweep, key, &list, err);
  gg_sweep_values_clear(&list);
  gg_base_c_locale_leave(before);
  return status;
}

gg_status gg_sweep_check(gg_sweep *sweep, gg_error *err)
{
  GG_NEED(sweep);
  locale_t before = gg_base_c_locale_enter();
  gg_status status = gg_sweep_check_points(sweep, err);
  gg_base_c_locale_leave(before);
  return status;
}

size_t gg_sweep_points(const gg_sweep *sweep)
{
  return sweep ? sweep->n : 0;
}

const char *gg_sweep_does(const gg_sweep *sweep)
{
  const char *const words[] = {"run", "compare", "theory"};
  return sweep ? words[sweep->settings.does] : NULL;
}

static gg_status check_point(const gg_sweep *sweep, size_t i, gg_error *err)
{
  if (!sweep->n)
    return gg_base_fail(err, GG_BAD_INPUT, "%s: the sweep was not checked yet: gg_sweep_check", sweep->name);
  if (i >= sweep->n)
    return gg_base_fail(err, GG_BAD_INPUT, "%s: there is no point %zu; the sweep has %zu", sweep->name, i + 1,
                        sweep->n);
  return GG_OK;
}

static gg_status resolve(const gg_sweep *sweep, size_t i, gg_scene *scene, gg_error *err)
{
  GG_TRY(check_point(sweep, i, err));
  locale_t before = gg_base_c_locale_enter();
  gg_status status = gg_sweep_resolve(sweep, i, scene, err);
  gg_base_c_locale_leave(before);
  return status;
}

gg_status gg_sweep_at(const gg_sweep *sweep, size_t i, gg_sweep_point *point, gg_error *err)
{
  GG_NEED(sweep);
  GG_NEED(point);
  gg_scene scene;
  GG_TRY(resolve(sweep, i, &scene, err));
  *point =
      (gg_sweep_point){.cpu_seconds = sweep->point[i].seconds, .replicas = scene.run.replicas, .seed = scene.run.seed};
  gg_sweep_point_name(sweep->point[i].id, point->name);
  return GG_OK;
}

gg_status gg_sweep_scene(const gg_sweep *sweep, size_t i, gg_scene **scene, gg_error *err)
{
  GG_NEED(sweep);
  GG_NEED(scene);
  gg_scene made;
  GG_TRY(resolve(sweep, i, &made, err));
  return gg_scene_copy(&made, scene, err);
}

/* The k-th key of all, as place among the keys that change together. */
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

const char *gg_sweep_value(const gg_sweep *sweep, size_t i, size_t k)
{
  size_t f;
  const gg_varied *v = varied_of(sweep, &k, &f);
  return v && i < sweep->n ? v->value[gg_sweep_row(sweep, i, f) * v->n_keys + k] : NULL;
}

gg_status gg_sweep_find(const gg_sweep *sweep, const char *folder, size_t i, gg_point_state *state, char **file,
                        gg_error *err)
{
  GG_NEED(sweep);
  GG_NEED(folder);
  GG_NEED(state);
  GG_TRY(check_point(sweep, i, err));
  *state = gg_sweep_point_status(folder, sweep->point[i].id);
  if (!file) return GG_OK;
  *file = gg_sweep_point_path(folder, sweep->point[i].id, *state == GG_POINT_SHORT ? ".short.h5" : ".h5");
  return *file ? GG_OK : gg_base_out_of_memory(err);
}

gg_status gg_sweep_to_json(const gg_sweep *sweep, const char *folder, char **text, gg_error *err)
{
  GG_NEED(sweep);
  GG_NEED(folder);
  GG_NEED(text);
  GG_TRY(check_point(sweep, 0, err));
  locale_t before = gg_base_c_locale_enter();
  json_t *document = gg_sweep_document(sweep, folder);
  gg_base_c_locale_leave(before);
  return gg_api_text_copy(document, text, err);
}
