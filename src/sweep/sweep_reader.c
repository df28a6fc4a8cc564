/* A sweep from YAML: the scene's keys, and beside them `vary` and `sweep`. */
#include <string.h>

#include "scene/scene_reader.h"
#include "sweep/parameter_grid.h"
#include "sweep/settings.h"

/* A reader with what its use needs besides. */
typedef struct sweep_reader {
  gg_scene_reader reader;
  gg_sweep *sweep;
} sweep_reader;

static gg_status use_sweep(gg_scene_reader *r, const char *key, const yaml_node_t *root)
{
  gg_sweep *sweep = ((sweep_reader *)(void *)r)->sweep;
  const yaml_node_t *vary = NULL, *settings = NULL;
  GG_TRY(gg_scene_read_root(r, key, root));
  for (yaml_node_pair_t *i = root->data.mapping.pairs.start; i < root->data.mapping.pairs.top; i++) {
    const yaml_node_t *name = yaml_document_get_node(r->document, i->key);
    const char *word = (const char *)name->data.scalar.value;
    const yaml_node_t **which = strcmp(word, "vary") == 0 ? &vary : strcmp(word, "sweep") == 0 ? &settings : NULL;
    if (which && *which) return gg_scene_refuse(r, name, word, "is given twice");
    if (which) *which = yaml_document_get_node(r->document, i->value);
  }
  if (settings) GG_TRY(gg_sweep_settings_read(r, settings, &sweep->settings));
  return vary ? gg_sweep_read_vary(r, sweep, vary) : GG_OK;
}

gg_status gg_sweep_read_text(gg_sweep *sweep, const char *yaml, size_t length, const char *name, gg_error *err)
{
  static const char *const others[] = {"vary", "sweep", NULL};
  sweep_reader s = {{.name = name, .lines = true, .scene = &sweep->base, .others = others, .err = err}, sweep};
  return gg_scene_with_document(&s.reader, yaml, length, "", use_sweep);
}
