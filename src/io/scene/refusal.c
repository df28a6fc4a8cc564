/* How a scene is refused: file, line, key, and what may stand there. */
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "io/nearest.h"
#include "io/scene/node.h"

gg_status gg_scene_refuse(const gg_scene_reader *r, const yaml_node_t *node, const char *key, const char *format, ...)
{
  char text[900];
  va_list args;
  va_start(args, format);
  vsnprintf(text, sizeof text, format, args);
  va_end(args);
  if (!r->lines) return gg_fail(r->err, GG_BAD_INPUT, "%s: %s", r->name, text);
  return gg_fail(r->err, GG_BAD_INPUT, "%s:%zu: key '%.60s': %s", r->name, node->start_mark.line + 1, key, text);
}

/* What may stand where `key` stands, and, for a key in the wrong section ("e: 0.9"), the full key that ends so. */
gg_status gg_scene_refuse_key(const gg_scene_reader *r, const yaml_node_t *node, const char *key)
{
  const char *dot = strrchr(key, '.');
  const char *word = dot ? dot + 1 : key;
  bool species = strncmp(key, "species.", 8) == 0;
  const gg_field *fields = species ? gg_species_fields : gg_scene_fields;
  for (const gg_field *f = fields; f->key && !species; f++) {
    const char *last = strrchr(f->key, '.');
    if (last && strcmp(last + 1, word) == 0)
      return gg_scene_refuse(r, node, key, "no such key; did you mean '%s'?", f->key);
  }
  gg_nearest full = {.word = key}, part = {.word = word};
  for (const gg_field *f = fields; f->key; f++) {
    const char *last = strrchr(f->key, '.');
    gg_nearest_try(&full, f->key);
    gg_nearest_try(&part, last ? last + 1 : f->key);
    if (!last) continue;
    static const char *const sections[] = {"collision", "walls", "run", "md", "dsmc", "output"};
    for (size_t i = 0; i < sizeof sections / sizeof *sections; i++) gg_nearest_try(&full, sections[i]);
  }
  const gg_nearest *best = part.best && (!full.best || part.distance < full.distance) ? &part : &full;
  if (best->best) return gg_scene_refuse(r, node, key, "no such key; did you mean '%s'?", best->best);
  return gg_scene_refuse(r, node, key, "no such key; `graingas info SCENE.yaml` lists every key there is");
}
