/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Scenes, and the library's tables. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "exports.h"

gg_error page_why;

void *page_fail(const char *message)
{
  page_why.status = GG_FAILED;
  snprintf(page_why.message, sizeof page_why.message, "%s", message);
  return NULL;
}

PAGE const char *page_error(void)
{
  return page_why.message;
}
PAGE int page_status(void)
{
  return page_why.status;
}

PAGE gg_scene *page_scene(const char *yaml)
{
  gg_scene *scene = NULL;
  return gg_scene_parse(yaml, "scene", &scene, &page_why) == GG_OK ? scene : NULL;
}
PAGE int page_scene_set(gg_scene *scene, const char *key, const char *value)
{
  return gg_scene_set(scene, key, value, &page_why) == GG_OK;
}
PAGE int page_scene_check(const gg_scene *scene)
{
  return gg_scene_check(scene, &page_why) == GG_OK;
}
PAGE char *page_scene_yaml(const gg_scene *scene)
{
  char *text = NULL;
  return gg_scene_to_yaml(scene, &text, &page_why) == GG_OK ? text : NULL;
}
PAGE char *page_scene_json(const gg_scene *scene)
{
  char *text = NULL;
  return gg_scene_to_json(scene, &text, &page_why) == GG_OK ? text : NULL;
}
PAGE char *page_scene_title(const gg_scene *scene)
{
  char text[256], *copy;
  if (gg_scene_title(scene, text, sizeof text, &page_why) != GG_OK) return NULL;
  return (copy = strdup(text)) ? copy : page_fail("out of memory");
}

/* Bytes and seconds of a processor of a run by this engine. */
PAGE const double *page_scene_needs(const gg_scene *scene, const char *engine)
{
  static double numbers[2];
  gg_scene_needs needs;
  if (gg_scene_get_needs(scene, engine, &needs, &page_why) != GG_OK) return NULL;
  numbers[0] = needs.memory, numbers[1] = needs.cpu_seconds;
  return numbers;
}

typedef struct lines {
  char *text;
  size_t size;
  FILE *out;
} lines;

static void add_line(void *context, const char *text)
{
  fprintf(((lines *)context)->out, "%s\n", text);
}

/* Keys without effect, a line each. */
PAGE char *page_scene_warnings(const gg_scene *scene, const char *use)
{
  lines all = {0};
  all.out = open_memstream(&all.text, &all.size);
  if (!all.out) return page_fail("out of memory");
  gg_status status = gg_scene_warnings(scene, use, add_line, &all, &page_why);
  int whole = fclose(all.out) == 0 && all.text;
  if (status == GG_OK && whole) return all.text;
  free(all.text);
  return status == GG_OK ? page_fail("out of memory") : NULL;
}

/* ---- Tables ---- */

/* The i-th entry of a list (gg_catalogue) as name, doc, unit, type, allowed and value, a line each; NULL after the
 * last. */
PAGE char *page_entry(int list, int i, const gg_scene *scene)
{
  gg_entry e;
  char *text = NULL;
  if (gg_catalogue_entry((gg_catalogue)list, (size_t)i, scene, &e, &page_why) != GG_OK) return NULL;
  const char *const part[] = {e.name, e.doc, e.unit, e.type, e.allowed, e.value};
#define LINE(k) part[k] ? part[k] : ""
  int length = asprintf(&text, "%s\n%s\n%s\n%s\n%s\n%s", LINE(0), LINE(1), LINE(2), LINE(3), LINE(4), LINE(5));
#undef LINE
  return length < 0 ? page_fail("out of memory") : text;
}
