#include "reproduce/entry.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "reproduce/node.h"
#include "scene/fields.h"

static const char *const verdicts[] = {"agrees", "differs", "cannot be told", "open", NULL};

/* libyaml counts characters, the text has bytes. */
static size_t byte_at(const char *text, size_t index)
{
  size_t at = 0;
  while (text[at] && (index > 0 || ((unsigned char)text[at] & 0xC0) == 0x80))
    if (((unsigned char)text[at++] & 0xC0) != 0x80) index--;
  return at;
}

/* The node as it stands in the text; to be freed. */
static char *copy_of(const gg_entry_reader *r, const yaml_node_t *node, size_t lines, size_t columns)
{
  size_t from = byte_at(r->text, node->start_mark.index), length = byte_at(r->text, node->end_mark.index) - from;
  char *text = malloc(lines + columns + length + 2), *at = text;
  if (!text) return NULL;
  memset(at, '\n', lines), at += lines;
  memset(at, ' ', columns), at += columns;
  memcpy(at, r->text + from, length), at += length;
  memcpy(at, "\n", 2);
  return text;
}

/* The part of the text that is this map, as a document of its own whose lines are those of the entry. */
static char *text_of_map(const gg_entry_reader *r, const yaml_node_t *map)
{
  return copy_of(r, map, map->start_mark.line, map->start_mark.column);
}

static gg_status read_sweep(const gg_entry_reader *r, const yaml_node_t *node, const char *name, gg_figure_entry *e)
{
  if (e->n_sweeps == GG_MOST_SWEEPS)
    return gg_reproduce_entry_refuse(r, node, "sweeps", "are more than %d", GG_MOST_SWEEPS);
  gg_entry_sweep *sweep = &e->sweep[e->n_sweeps];
  *sweep = (gg_entry_sweep){.name = name};
  if (node->type == YAML_SCALAR_NODE) {
    sweep->figure = (const char *)node->data.scalar.value;
  } else if (node->type == YAML_MAPPING_NODE) {
    if (!(sweep->yaml = text_of_map(r, node))) return gg_base_out_of_memory(r->err);
  } else {
    return gg_reproduce_entry_refuse(r, node, "sweep", "is a map, a sweep file, or the name of the figure that has it");
  }
  e->n_sweeps++;
  return GG_OK;
}

static gg_status read_sweeps(const gg_entry_reader *r, const yaml_node_t *root, gg_figure_entry *e)
{
  const yaml_node_t *one = gg_reproduce_entry_get(r, root, "sweep"), *all = gg_reproduce_entry_get(r, root, "sweeps");
  if (!one == !all) return gg_reproduce_entry_refuse(r, root, "sweep", "or sweeps must be given, one of them");
  if (one) return read_sweep(r, one, "", e);
  if (all->type != YAML_MAPPING_NODE) return gg_reproduce_entry_refuse(r, all, "sweeps", "is a map of sweeps by name");
  for (yaml_node_pair_t *i = all->data.mapping.pairs.start; i < all->data.mapping.pairs.top; i++)
    GG_TRY(read_sweep(r, yaml_document_get_node(r->document, i->value),
                      (const char *)yaml_document_get_node(r->document, i->key)->data.scalar.value, e));
  return GG_OK;
}

/* A value as YAML, lists and maps included. */
static gg_status take_sets(const gg_entry_reader *r, const yaml_node_t *map, gg_set *sets, int *n)
{
  for (yaml_node_pair_t *i = map->data.mapping.pairs.start; i < map->data.mapping.pairs.top; i++) {
    const yaml_node_t *name = yaml_document_get_node(r->document, i->key);
    const yaml_node_t *value = yaml_document_get_node(r->document, i->value);
    const char *key = name->type == YAML_SCALAR_NODE ? (const char *)name->data.scalar.value : "?";
    if (strcmp(key, "vary") == 0) continue;
    if (!gg_scene_key_exists(key)) return gg_reproduce_entry_refuse(r, name, key, "is no key of a scene");
    if (*n == GG_MOST_SETS) return gg_reproduce_entry_refuse(r, name, key, "one too many");
    char *text = copy_of(r, value, 0, 0);
    if (!text) return gg_base_out_of_memory(r->err);
    sets[(*n)++] = (gg_set){key, text};
  }
  return GG_OK;
}

static gg_status read_quick(const gg_entry_reader *r, const yaml_node_t *quick, gg_figure_entry *e)
{
  if (!quick) return GG_OK;
  if (quick->type != YAML_MAPPING_NODE) return gg_reproduce_entry_refuse(r, quick, "quick", "is a map of scene keys");
  GG_TRY(take_sets(r, quick, e->quick, &e->n_quick));
  const yaml_node_t *vary = gg_reproduce_entry_get(r, quick, "vary");
  if (!vary) return GG_OK;
  if (vary->type != YAML_MAPPING_NODE) return gg_reproduce_entry_refuse(r, vary, "vary", "is a map of scene keys");
  return take_sets(r, vary, e->quick_vary, &e->n_quick_vary);
}

static gg_status read_list(const gg_entry_reader *r, const yaml_node_t *root, const char *key, int most,
                           gg_figure_entry *e)
{
  const yaml_node_t *list = gg_reproduce_entry_get(r, root, key);
  if (!list) return GG_OK;
  if (list->type != YAML_SEQUENCE_NODE) return gg_reproduce_entry_refuse(r, list, key, "is a list");
  for (yaml_node_item_t *i = list->data.sequence.items.start; i < list->data.sequence.items.top; i++) {
    const yaml_node_t *map = yaml_document_get_node(r->document, *i);
    bool panels = *key == 'p';
    if ((panels ? e->n_panels : e->n_numbers) == most)
      return gg_reproduce_entry_refuse(r, map, key, "are more than %d", most);
    if (panels)
      GG_TRY(gg_reproduce_entry_read_panel(r, map, &e->panel[e->n_panels++]));
    else
      GG_TRY(gg_reproduce_entry_read_stated(r, map, &e->number[e->n_numbers++]));
  }
  return GG_OK;
}

static bool has_sweep(const gg_figure_entry *e, const char *name)
{
  for (int i = 0; i < e->n_sweeps; i++)
    if (strcmp(e->sweep[i].name, name) == 0) return true;
  return false;
}

static gg_status check_names(const gg_entry_reader *r, const yaml_node_t *root, const gg_figure_entry *e)
{
  int known = 0;
  while (verdicts[known] && strcmp(verdicts[known], e->verdict) != 0) known++;
  if (!verdicts[known])
    return gg_reproduce_entry_refuse(r, gg_reproduce_entry_get(r, root, "verdict"), "verdict",
                                     "'%.40s' is not allowed; allowed: agrees, differs, cannot be told, open",
                                     e->verdict);
  for (int i = 0; i < e->n_panels; i++)
    for (int k = 0; k < e->panel[i].of.n; k++)
      if (!has_sweep(e, e->panel[i].of.text[k]))
        return gg_reproduce_entry_refuse(r, root, "of", "there is no sweep '%s'", e->panel[i].of.text[k]);
  for (int i = 0; i < e->n_numbers; i++)
    if (e->number[i].sweep && !has_sweep(e, e->number[i].sweep))
      return gg_reproduce_entry_refuse(r, root, "sweep", "there is no sweep '%s'", e->number[i].sweep);
  return GG_OK;
}

static gg_status read_root(const gg_entry_reader *r, gg_figure_entry *e)
{
  const yaml_node_t *root = yaml_document_get_root_node(r->document);
  GG_TRY(gg_reproduce_entry_keys(r, root, "an entry",
                                 "figure shows cannot sweep sweeps quick panels numbers verdict because"));
  GG_TRY(gg_reproduce_entry_text(r, root, "figure", &e->figure));
  GG_TRY(gg_reproduce_entry_text(r, root, "shows", &e->shows));
  GG_TRY(gg_reproduce_entry_text(r, root, "cannot", &e->cannot));
  GG_TRY(gg_reproduce_entry_text(r, root, "verdict", &e->verdict));
  GG_TRY(gg_reproduce_entry_text(r, root, "because", &e->because));
  if (!e->figure || !e->shows) return gg_reproduce_entry_refuse(r, root, "figure", "and shows must be given");
  if (e->cannot) return GG_OK;
  GG_TRY(read_sweeps(r, root, e));
  GG_TRY(read_quick(r, gg_reproduce_entry_get(r, root, "quick"), e));
  GG_TRY(read_list(r, root, "panels", GG_MOST_PANELS, e));
  GG_TRY(read_list(r, root, "numbers", GG_MOST_NUMBERS, e));
  if (!e->n_panels) return gg_reproduce_entry_refuse(r, root, "panels", "must be given: what is drawn");
  return check_names(r, root, e);
}

static gg_status load(gg_figure_entry *e, const char *yaml, gg_error *err)
{
  yaml_parser_t parser;
  gg_status status = GG_OK;
  if (!yaml_parser_initialize(&parser)) return gg_base_out_of_memory(err);
  yaml_parser_set_input_string(&parser, (const unsigned char *)yaml, strlen(yaml));
  e->read = yaml_parser_load(&parser, &e->document);
  if (!e->read)
    status = gg_base_fail(err, GG_BAD_INPUT, "%s:%zu: %s", e->file, parser.problem_mark.line + 1, parser.problem);
  else if (!yaml_document_get_root_node(&e->document))
    status = gg_base_fail(err, GG_BAD_INPUT, "%s: is empty", e->file);
  yaml_parser_delete(&parser);
  return status;
}

gg_status gg_reproduce_entry_read(gg_figure_entry *e, const char *file, const char *yaml, gg_error *err)
{
  *e = (gg_figure_entry){.file = file, .verdict = "open", .because = ""};
  gg_status status = load(e, yaml, err);
  gg_entry_reader r = {&e->document, file, yaml, err};
  if (status == GG_OK) status = read_root(&r, e);
  if (status != GG_OK) gg_reproduce_entry_clear(e);
  return status;
}

static void free_sets(gg_set *sets, int n)
{
  for (int i = 0; i < n; i++) free((char *)(uintptr_t)sets[i].value);
}

void gg_reproduce_entry_clear(gg_figure_entry *e)
{
  for (int i = 0; i < e->n_sweeps; i++) free(e->sweep[i].yaml);
  free_sets(e->quick, e->n_quick);
  free_sets(e->quick_vary, e->n_quick_vary);
  if (e->read) yaml_document_delete(&e->document);
  *e = (gg_figure_entry){0};
}
