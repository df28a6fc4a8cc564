/* What makes a point the one that it is: a hash of its resolved scene; and whether a file holds that scene. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/checked_json.h"
#include "base/checksum.h"
#include "base/memory.h"
#include "common/extension.h"
#include "scene/fields.h"
#include "sweep/sweep.h"

static bool begins(const char *key, const char *const *with)
{
  for (; *with; with++)
    if (strncmp(key, *with, strlen(*with)) == 0) return true;
  return false;
}

/* Keys that no number in the file of a point depends on. */
static bool is_left_out(const char *key, gg_does does)
{
  static const char *const never[] = {"output.checkpoint_every", NULL};
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
  json_t *value = gg_scene_field_json(f, scene, scene);
  char *text = gg_base_json_text(value, JSON_COMPACT | JSON_SORT_KEYS | JSON_ENCODE_ANY | JSON_REAL_PRECISION(17));
  sum = add_text(add_text(sum, f->key),
                 text ? text : ""); /* no memory: the name of another point; the lack is recorded */
  free(text);
  json_decref(value);
  return sum;
}

/* What the calling program added has no values: its names enter. */
static uint64_t add_extension(uint64_t sum, const gg_scene *scene)
{
  char signature[2048] = "";
  if (!scene->extension) return sum;
  gg_common_extension_signature(scene->extension, signature, sizeof signature);
  return add_text(sum, signature);
}

/* Every bit of the sum goes into every bit of the name (the finalizer of MurmurHash3). */
static uint64_t mix(uint64_t x)
{
  x = (x ^ (x >> 33)) * UINT64_C(0xff51afd7ed558ccd);
  x = (x ^ (x >> 33)) * UINT64_C(0xc4ceb9fe1a85ec53);
  return x ^ (x >> 33);
}

const char *const gg_does_words[] = {"run", "compare", "theory"};

uint64_t gg_sweep_point_id(const gg_scene *scene, gg_does does)
{
  uint64_t sum = add_text(GG_CHECKSUM_START, gg_does_words[does]);
  for (const gg_field *f = gg_scene_fields; f->key; f++)
    if (!is_left_out(f->key, does)) sum = add_field(sum, f, scene);
  return mix(add_extension(sum, scene));
}

/* Of a scene as JSON. */
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
  gg_status status = GG_OK;
  json_t *whole = gg_scene_json(scene);
  if (!whole) return gg_base_out_of_memory(err);
  for (const gg_field *f = gg_scene_fields; f->key && status == GG_OK; f++) {
    const json_t *value = value_in(stored, f->key), *wanted = value_in(whole, f->key);
    if (is_left_out(f->key, does) || (value && json_equal(value, wanted))) continue;
    value_text(value, there, sizeof there);
    value_text(wanted, here, sizeof here);
    status = gg_base_fail(err, GG_BAD_FILE,
                          "%s: holds another point: %s is %s there, and %s at the point of this name; "
                          "remove it, and the point is done again",
                          path, f->key, there, here);
  }
  json_decref(whole);
  return status;
}

/* A length that is varied distinguishes points; one that is not, and the replicas that follow from estimates, may be
 * changed, and the same run is longer. */
static bool is_of_seed(const gg_field *f, const gg_sweep *sweep)
{
  static const char *const none_of[] = {"engine", "run.", "output.", "measure", NULL};
  return !begins(f->key, none_of) || (strncmp(f->key, "run.", 4) == 0 && gg_sweep_sets(sweep, f->key));
}

/* 48 bits: a number of few digits, and whole in any reader's arithmetic. */
uint64_t gg_sweep_point_seed(const gg_sweep *sweep, const gg_scene *scene)
{
  const uint64_t seed = scene->run.seed;
  uint64_t sum = gg_base_checksum(GG_CHECKSUM_START, &seed, sizeof seed);
  for (const gg_field *f = gg_scene_fields; f->key; f++)
    if (is_of_seed(f, sweep)) sum = add_field(sum, f, scene);
  return mix(add_extension(sum, scene)) >> 16;
}
