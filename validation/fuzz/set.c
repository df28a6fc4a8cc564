/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Fuzz target: arguments of --set and --vary. Every line KEY=VALUE of the input is set in a scene and in a sweep; up to
 * two short ones are also varied in the sweep. */
#include <stdbool.h>
#include <stdio.h>

#include "fuzz.h"
#include "graingas.h"
#include "sweep/sweep.h"
#include "text.h"

enum { MOST_POINTS = 12 }; /* larger sweeps are not checked, to save time */

static const char base[] = "{flow: usf, phi: 0.1, species: [{fraction: 0.5}, {fraction: 0.5}]}";

static void ignore(void *context, const char *text)
{
  (void)context, (void)text;
}

static void set_and_ask(gg_scene *scene, const char *key, const char *value)
{
  char text[80], small[4];
  gg_error err;
  gg_scene_set(scene, key, value, &err);
  gg_scene_get(scene, key, text, sizeof text, &err);
  gg_scene_get(scene, key, small, sizeof small, &err);
}

static void use(gg_scene *scene, gg_sweep *sweep)
{
  gg_scene *point = NULL;
  char *json = NULL;
  if (gg_scene_check(scene, NULL) == GG_OK) gg_scene_describe(scene, "md", ignore, NULL, NULL);
  const size_t n = gg_sweep_count(sweep);
  if (n == 0 || n > MOST_POINTS || gg_sweep_check(sweep, NULL) != GG_OK) return;
  if (gg_sweep_scene(sweep, gg_sweep_points(sweep) - 1, &point, NULL) == GG_OK) gg_scene_free(point);
  if (gg_sweep_to_json(sweep, NULL, &json, NULL) == GG_OK) free(json);
}

/* True for a value with many ranges: each may have a hundred thousand values, which takes milliseconds. */
static bool is_long(const char *value)
{
  size_t marks = 0;
  for (; *value; value++) marks += *value == ',' || *value == ':';
  return marks > 5;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
  static gg_scene *first;
  gg_scene *scene = NULL;
  gg_sweep *sweep = NULL;
  char *text = fuzz_text(data, size), *rest = text, *line;
  int varied = 0;
  if (!first && gg_scene_parse(base, "base", &first, NULL) != GG_OK) abort();
  if (text && gg_scene_copy(first, &scene, NULL) == GG_OK && gg_sweep_parse(base, "base", &sweep, NULL) == GG_OK)
    while ((line = fuzz_line(&rest))) {
      char *equals = strchr(line, '=');
      if (!equals) continue;
      *equals = '\0';
      set_and_ask(scene, line, equals + 1);
      gg_sweep_set(sweep, line, equals + 1, NULL);
      if (varied < 2 && !is_long(equals + 1)) varied += gg_sweep_vary(sweep, line, equals + 1, NULL) == GG_OK;
    }
  if (scene && sweep) use(scene, sweep);
  gg_sweep_free(sweep);
  gg_scene_free(scene);
  free(text);
  return 0;
}
