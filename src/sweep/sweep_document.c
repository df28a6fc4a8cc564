#include "sweep/sweep_document.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/checked_json.h"
#include "common/engine.h"
#include "sweep/folder.h"

/* Digits alone, beyond the whole numbers that a double holds: seeds. */
static bool is_whole(const char *text, long long *n)
{
  char *end;
  errno = 0;
  *n = strtoll(text, &end, 10);
  return end != text && !*end && errno == 0;
}

json_t *gg_sweep_point_value(const gg_sweep *sweep, size_t i, size_t varied, size_t k)
{
  const gg_varied *v = &sweep->varied[varied];
  const char *text = v->value[gg_sweep_row(sweep, i, varied) * v->n_keys + k];
  long long n;
  if (is_whole(text, &n)) return json_integer(n);
  char *end;
  double x = strtod(text, &end);
  if (*end || end == text || !isfinite(x)) return json_string(text);
  return x == floor(x) && fabs(x) < 1e15 ? json_integer((json_int_t)x) : json_real(x);
}

static json_t *point_json(const gg_sweep *sweep, const char *folder, size_t i)
{
  static const char *const states[] = {
      [GG_POINT_MISSING] = "missing", [GG_POINT_DONE] = "done", [GG_POINT_SHORT] = "short"};
  char name[GG_POINT_NAME];
  gg_scene scene;
  json_t *keys = json_object();
  gg_sweep_point_name(sweep->point[i].id, name);
  if (gg_sweep_resolve(sweep, i, &scene, NULL) != GG_OK) { /* it was checked: there is no memory */
    json_decref(keys);
    return gg_base_json_made(NULL);
  }
  for (size_t f = 0; f < sweep->n_varied; f++)
    for (size_t k = 0; k < sweep->varied[f].n_keys; k++)
      json_object_set_new(keys, sweep->varied[f].key[k], gg_sweep_point_value(sweep, i, f, k));
  return json_pack("{s:I, s:o, s:s, s:s, s:f, s:I, s:I}", "point", (json_int_t)i + 1, "keys", keys, "name", name,
                   "state", states[gg_sweep_point_status(folder, sweep->point[i].id)], "cpu_seconds",
                   sweep->point[i].seconds, "replicas", (json_int_t)scene.run.replicas, "seed",
                   (json_int_t)scene.run.seed);
}

/* A name of bytes that are no text loses them; that it is none is no lack of memory, and not noted as such. */
static json_t *name_as_text(const char *name)
{
  json_t *text = (json_string)(name);
  if (text) return text;
  char *plain = strdup(name);
  for (char *c = plain; c && *c; c++)
    if (*c & 0x80) *c = '?';
  text = plain ? json_string(plain) : gg_base_json_made(NULL);
  free(plain);
  return text;
}

json_t *gg_sweep_document(const gg_sweep *sweep, const char *folder)
{
  static const char *const words[] = {"run", "compare", "theory"};
  bool before = gg_base_memory_begin();
  json_t *points = json_array();
  for (size_t i = 0; i < sweep->n; i++) json_array_append_new(points, point_json(sweep, folder, i));
  return gg_base_json_end(before,
                          json_pack("{s:s, s:s, s:o, s:o}", "graingas", GG_VERSION, "does", words[sweep->settings.does],
                                    "folder", name_as_text(folder), "points", points));
}
