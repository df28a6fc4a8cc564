/* Points out of the map `vary`: every combination, rows, or draws. */
#include "sweep/parameter_grid.h"

#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include "base/checksum.h"
#include "base/memory.h"
#include "sweep/value_lists.h"

static gg_status new_varied(gg_varied *v, const gg_columns *c, size_t first, size_t n_keys, size_t n, gg_error *err)
{
  *v = (gg_varied){.n_keys = n_keys, .n = n};
  v->key = gg_base_array_new(n_keys, sizeof *v->key, err);
  v->value = gg_base_array_new(n_keys * n, sizeof *v->value, err);
  bool good = v->key && v->value;
  for (size_t k = 0; good && k < n_keys; k++) good = (v->key[k] = strdup(c->key[first + k]));
  if (good) return GG_OK;
  gg_sweep_varied_clear(v);
  return gg_base_out_of_memory(err);
}

/* Keys of the map from `first` on, row by row. */
static gg_status add_rows(gg_sweep *sweep, gg_columns *c, size_t first, size_t n_keys, gg_error *err)
{
  gg_varied v;
  size_t n = c->values[first].n;
  GG_TRY(new_varied(&v, c, first, n_keys, n, err));
  for (size_t k = 0; k < n_keys; k++)
    for (size_t i = 0; i < n; i++) {
      v.value[i * n_keys + k] = c->values[first + k].text[i];
      c->values[first + k].text[i] = NULL;
    }
  return gg_sweep_add(sweep, &v, err);
}

static gg_status refuse_range(gg_scene_reader *r, const gg_columns *c)
{
  for (size_t k = 0; k < c->n; k++)
    if (c->values[k].range)
      return gg_scene_refuse(r, c->node[k], c->key[k],
                             "LOW..HIGH is for random draws: say how many, vary: {random: {points: 100}, ...}; a grid "
                             "has first:last:step or a list");
  return GG_OK;
}

/* The same length for all, as they go together. */
static gg_status add_zipped(gg_scene_reader *r, gg_sweep *sweep, gg_columns *c)
{
  GG_TRY(refuse_range(r, c));
  for (size_t k = 1; k < c->n; k++)
    if (c->values[k].n != c->values[0].n)
      return gg_scene_refuse(r, c->node[k], c->key[k],
                             "has %zu values, and %s, which goes with it, has %zu; keys of one map in a list change "
                             "together",
                             c->values[k].n, c->key[0], c->values[0].n);
  return c->n ? gg_sweep_place(r, c->node[0], add_rows(sweep, c, 0, c->n, r->err)) : GG_OK;
}

static gg_status add_grid(gg_scene_reader *r, gg_sweep *sweep, gg_columns *c)
{
  GG_TRY(refuse_range(r, c));
  for (size_t k = 0; k < c->n; k++) GG_TRY(gg_sweep_place(r, c->node[k], add_rows(sweep, c, k, 1, r->err)));
  return GG_OK;
}

typedef struct draws {
  int64_t points, seed;
} draws;
static const gg_field draws_fields[] = {
    {"points", GG_FIELD_INTEGER, offsetof(draws, points), 1, GG_MOST_POINTS, .doc = "how many"},
    {"seed", GG_FIELD_INTEGER, offsetof(draws, seed), 0, 9223372036854775807.0, .doc = "of the draws"}};

static gg_status read_draws(gg_scene_reader *r, const yaml_node_t *map, draws *d)
{
  *d = (draws){.seed = 1};
  for (yaml_node_pair_t *i = map->type == YAML_MAPPING_NODE ? map->data.mapping.pairs.start : NULL;
       i && i < map->data.mapping.pairs.top; i++) {
    const yaml_node_t *name = yaml_document_get_node(r->document, i->key);
    const yaml_node_t *value = yaml_document_get_node(r->document, i->value);
    const char *word = name->type == YAML_SCALAR_NODE ? (const char *)name->data.scalar.value : "?";
    int k = 0;
    char key[96];
    snprintf(key, sizeof key, "vary.random.%.60s", word);
    while (k < 2 && strcmp(draws_fields[k].key, word) != 0) k++;
    if (k == 2) return gg_scene_refuse(r, name, key, "no such key; under random there are points and seed");
    GG_TRY(gg_scene_read_value(r, &draws_fields[k], key, value, d));
  }
  if (d->points) return GG_OK;
  return gg_scene_refuse(r, map, "vary.random", "say how many points are to be drawn: random: {points: 100, seed: 1}");
}

/* A stream for each key: more points or more keys leave the draws that there were. */
static gg_status add_random(gg_scene_reader *r, gg_sweep *sweep, gg_columns *c)
{
  draws d;
  gg_varied v;
  size_t characters = 0;
  GG_TRY(read_draws(r, c->random, &d));
  if (!c->n) return gg_scene_refuse(r, c->random, "vary", "no key is drawn");
  GG_TRY(new_varied(&v, c, 0, c->n, (size_t)d.points, r->err));
  for (size_t k = 0; k < c->n; k++) {
    gg_rng rng =
        gg_common_rng_seed((uint64_t)d.seed, gg_base_checksum(GG_CHECKSUM_START, c->key[k], strlen(c->key[k])));
    for (size_t i = 0; i < v.n; i++)
      if (!(v.value[i * c->n + k] = gg_sweep_values_draw(&c->values[k], c->key[k], &rng))) {
        gg_sweep_varied_clear(&v);
        return gg_base_out_of_memory(r->err);
      } else if ((characters += strlen(v.value[i * c->n + k])) > GG_MOST_DRAWN_CHARACTERS) {
        gg_sweep_varied_clear(&v);
        return gg_scene_refuse(r, c->random, "vary.random", "the values drawn have more than %d characters together",
                               GG_MOST_DRAWN_CHARACTERS);
      }
  }
  return gg_sweep_place(r, c->random, gg_sweep_add(sweep, &v, r->err));
}

static gg_status read_one(gg_scene_reader *r, gg_sweep *sweep, const yaml_node_t *map, bool zipped)
{
  gg_columns c = {0};
  gg_status status = gg_sweep_value_lists_read(r, map, &c);
  if (status == GG_OK)
    status = c.random ? add_random(r, sweep, &c) : zipped ? add_zipped(r, sweep, &c) : add_grid(r, sweep, &c);
  gg_sweep_value_lists_clear(&c);
  return status;
}

gg_status gg_sweep_read_vary(gg_scene_reader *r, gg_sweep *sweep, const yaml_node_t *node)
{
  size_t before = sweep->n_varied;
  if (node->type != YAML_SEQUENCE_NODE) GG_TRY(read_one(r, sweep, node, false));
  for (yaml_node_item_t *i = node->type == YAML_SEQUENCE_NODE ? node->data.sequence.items.start : NULL;
       i && i < node->data.sequence.items.top; i++)
    GG_TRY(read_one(r, sweep, yaml_document_get_node(r->document, *i), true));
  return sweep->n_varied > before ? GG_OK
                                  : gg_scene_refuse(r, node, "vary", "no key is varied, e.g. vary: {phi: [0.1, 0.2]}");
}
