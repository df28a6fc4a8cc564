/* A sweep from YAML: the scene's keys, and beside them `vary` and `sweep`. */
#include <stdlib.h>
#include <string.h>

#include "io/scene/reader.h"
#include "sweep/settings.h"
#include "sweep/vary.h"

void gg_varied_clear(gg_varied *v)
{
  for (size_t k = 0; v->key && k < v->n_keys; k++) free(v->key[k]);
  for (size_t i = 0; v->value && i < v->n * v->n_keys; i++) free(v->value[i]);
  free(v->key);
  free(v->value);
  *v = (gg_varied){0};
}

bool gg_sweep_varies(const gg_sweep *sweep, const char *key)
{
  for (size_t f = 0; f < sweep->n_varied; f++)
    for (size_t k = 0; k < sweep->varied[f].n_keys; k++)
      if (strcmp(sweep->varied[f].key[k], key) == 0) return true;
  return false;
}

static gg_status check_new(const gg_sweep *sweep, const gg_varied *v, gg_error *err)
{
  if (sweep->n_varied == GG_MOST_VARIED)
    return gg_fail(err, GG_BAD_INPUT, "more than %d keys are varied", GG_MOST_VARIED);
  for (size_t k = 0; k < v->n_keys; k++) {
    if (gg_sweep_varies(sweep, v->key[k])) return gg_fail(err, GG_BAD_INPUT, "key '%.60s': is varied twice", v->key[k]);
    for (size_t j = 0; j < k; j++)
      if (strcmp(v->key[j], v->key[k]) == 0)
        return gg_fail(err, GG_BAD_INPUT, "key '%.60s': is varied twice", v->key[k]);
  }
  return GG_OK;
}

gg_status gg_sweep_add(gg_sweep *sweep, gg_varied *v, gg_error *err)
{
  gg_status status = check_new(sweep, v, err);
  if (status == GG_OK) {
    sweep->varied[sweep->n_varied++] = *v;
    *v = (gg_varied){0};
  }
  gg_varied_clear(v);
  return status;
}

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
