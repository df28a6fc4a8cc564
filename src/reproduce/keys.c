/* Values of scene keys, as numbers, words and conditions. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "reproduce/points.h"
#include "scene/scene_reader.h"

static double number_of(const json_t *value)
{
  const char *text = json_string_value(value);
  if (text && strcmp(text, "inf") == 0) return INFINITY;
  return json_is_number(value) ? json_number_value(value) : NAN;
}

double gg_reproduce_key_number(const gg_scene *scene, const char *key)
{
  json_t *value = gg_scene_key_json(scene, key);
  double number = number_of(value);
  json_decref(value);
  return number;
}

void gg_reproduce_key_text(const gg_scene *scene, const char *key, char *text, size_t size)
{
  json_t *value = gg_scene_key_json(scene, key);
  text[0] = '\0';
  if (value) gg_scene_flow_style_text(value, text, size);
  json_decref(value);
}

/* As numbers if both are, else by what the scene would hold if the text were given. */
static bool is(const gg_scene *scene, const char *key, const char *text)
{
  char *end;
  double here = gg_reproduce_key_number(scene, key), asked = strtod(text, &end);
  if (!isnan(here) && *text && !*end) return here == asked || fabs(here - asked) <= 1e-9 * fabs(asked);
  gg_scene other = *scene;
  if (gg_scene_override(&other, key, text, NULL) != GG_OK) return false;
  json_t *a = gg_scene_key_json(scene, key), *b = gg_scene_key_json(&other, key);
  bool same = json_equal(a, b);
  json_decref(a);
  json_decref(b);
  return same;
}

bool gg_reproduce_scene_meets(const gg_scene *scene, const gg_conditions *conditions)
{
  for (int i = 0; i < conditions->n; i++) {
    const gg_condition_of *one = &conditions->of[i];
    bool any = false;
    for (int k = 0; k < one->values.n && !any; k++) any = is(scene, one->key, one->values.text[k]);
    if (!any) return false;
  }
  return true;
}

bool gg_reproduce_figure_point_of(const gg_figure_point *point, const gg_texts *sweeps)
{
  for (int i = 0; i < sweeps->n; i++)
    if (strcmp(sweeps->text[i], point->sweep) == 0) return true;
  return sweeps->n == 0;
}
