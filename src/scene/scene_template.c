/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A scene to begin with: what has to be said, and every other key of the flow as a comment with its default. */
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "base/text.h"
#include "common/flow.h"
#include "scene/fields.h"

/* Keys that are no comments. */
static bool is_said(const char *key)
{
  return strcmp(key, "flow") == 0 || strcmp(key, "phi") == 0 || strcmp(key, "collision.e") == 0;
}

static void print_key(FILE *out, const gg_field *f, const gg_scene *scene)
{
  char value[400], line[512];
  const char *dot = strrchr(f->key, '.');
  json_t *usual = gg_scene_field_json(f, scene, scene);
  gg_scene_flow_style_text(usual, value, sizeof value);
  json_decref(usual);
  snprintf(line, sizeof line, "%s%s%s: %s", dot ? "  " : "", is_said(f->key) ? "" : "# ", dot ? dot + 1 : f->key,
           value);
  fprintf(out, "%-40s # %s%s%s%s\n", line, f->doc, f->unit ? " (" : "", f->unit ? f->unit : "", f->unit ? ")" : "");
}

/* A section without a value is none: its line is a comment, too. */
static void print_section(FILE *out, const gg_field *f, const char *section)
{
  const size_t length = strlen(section);
  bool any = false;
  for (const gg_field *k = f; k->key && strncmp(k->key, section, length) == 0; k++) any |= is_said(k->key);
  fprintf(out, "%s%.*s:\n", any ? "" : "# ", (int)length - 1, section);
}

static void print(FILE *out, const gg_scene *scene)
{
  char section[32] = "";
  const char *word = gg_common_flows[scene->flow].word;
  fprintf(
      out,
      "# %s: %s\n# graingas compare %s.yaml. Lines that begin with # are defaults; remove the # of a section, too, to\n"
      "# change one of its keys. graingas info KEY says more.\n",
      word, gg_common_flows[scene->flow].doc, word);
  for (const gg_field *f = gg_scene_fields; f->key; f++) {
    const char *dot = strchr(f->key, '.');
    if (!gg_scene_field_is_of(f, scene->flow)) continue;
    if (dot && strncmp(section, f->key, (size_t)(dot - f->key + 1)) != 0) {
      snprintf(section, sizeof section, "%.*s", (int)(dot - f->key + 1), f->key);
      print_section(out, f, section);
    }
    print_key(out, f, scene);
  }
}

char *gg_scene_template(gg_flow flow)
{
  char *text = NULL;
  FILE *out = gg_base_memory_stream_open(&text);
  if (!out) return NULL;
  gg_scene scene = gg_scene_defaults();
  scene.flow = flow;
  scene.phi = 0.2;
  gg_scene_fill_in(&scene);
  print(out, &scene);
  return gg_base_memory_stream_close(out, &text) ? text : NULL;
}
