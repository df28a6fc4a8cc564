/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Fuzz target: the text of a scene, parsed, checked and described as by `info`. An accepted scene is written as YAML
 * and as JSON; both must be accepted again, and the YAML must give the same scene. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fuzz.h"
#include "graingas.h"
#include "text.h"

static void ignore(void *context, const char *text)
{
  *(size_t *)context += strlen(text);
}

static void fail(const char *what, const char *one, const char *other)
{
  fprintf(stderr, "%s\n---\n%s\n---\n%s\n", what, one, other);
  abort();
}

/* Write the scene, read it and write it again: the text must be the same. */
static void go_round(const gg_scene *scene)
{
  char *yaml = NULL, *again = NULL, *json = NULL;
  gg_scene *second = NULL, *third = NULL;
  gg_error err = {.message = ""};
  if (gg_scene_to_yaml(scene, &yaml, &err) != GG_OK) fail("cannot be written", err.message, "");
  if (gg_scene_parse(yaml, "again", &second, &err) != GG_OK) fail("what was written is refused", yaml, err.message);
  if (gg_scene_to_yaml(second, &again, &err) != GG_OK) fail("cannot be written again", err.message, "");
  if (strcmp(yaml, again) != 0) fail("what was written is read as another scene", yaml, again);
  if (gg_scene_to_json(scene, &json, &err) != GG_OK) fail("cannot be written as JSON", err.message, "");
  if (gg_scene_parse(json, "json", &third, &err) != GG_OK) fail("its JSON is refused", json, err.message);
  gg_scene_free(second);
  gg_scene_free(third);
  free(yaml);
  free(again);
  free(json);
}

static void inform(const gg_scene *scene)
{
  static const char *const uses[] = {"md", "dsmc", "compare", "theory"};
  size_t length = 0;
  char title[200];
  gg_entry key;
  for (size_t i = 0; i < 4; i++) gg_scene_warnings(scene, uses[i], ignore, &length, NULL);
  for (size_t i = 0; i < 2; i++) gg_scene_describe(scene, uses[i], ignore, &length, NULL);
  for (size_t i = 0; gg_catalogue_entry(GG_CATALOGUE_KEYS, i, scene, &key, NULL) == GG_OK; i++)
    length += strlen(key.value);
  gg_scene_title(scene, title, sizeof title, NULL);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
  gg_scene *scene = NULL;
  gg_error err;
  char *text = fuzz_text(data, size);
  if (text && gg_scene_parse(text, "scene.yaml", &scene, &err) == GG_OK) {
    if (gg_scene_check(scene, &err) == GG_OK) {
      go_round(scene);
      inform(scene);
    }
  }
  gg_scene_free(scene);
  free(text);
  return 0;
}
