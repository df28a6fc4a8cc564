#include "scene/yaml_node.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/spelling.h"

static const char *scalar(const yaml_node_t *node)
{
  return node->type == YAML_SCALAR_NODE ? (const char *)node->data.scalar.value : NULL;
}

/* The node as a message shows it. */
static void show(const yaml_node_t *node, char *text, size_t size)
{
  if (node->type == YAML_SEQUENCE_NODE)
    snprintf(text, size, "a list");
  else if (node->type == YAML_MAPPING_NODE)
    snprintf(text, size, "a map");
  else if (node->data.scalar.length == 0)
    snprintf(text, size, "nothing");
  else {
    char word[41];
    gg_scene_quote((const char *)node->data.scalar.value, word, sizeof word);
    snprintf(text, size, "%s '%s'", node->data.scalar.style == YAML_PLAIN_SCALAR_STYLE ? "value" : "text", word);
  }
}

/* The nearest of the words, or the first that is described by the one that was typed ("cooling": hcs). */
static const char *likely_word(const gg_field *f, const char *typed)
{
  gg_nearest nearest = {.word = typed};
  gg_word w;
  if (!typed) return NULL;
  for (int i = 0; (w = gg_scene_field_word(f, i)).name; i++) gg_base_spelling_try(&nearest, w.name);
  for (int i = 0; !nearest.best && strlen(typed) > 3 && (w = gg_scene_field_word(f, i)).name; i++)
    if (strcasestr(w.doc, typed)) nearest.best = w.name;
  return nearest.best;
}

static bool has_decimal_comma(const char *text)
{
  return text && *text && !text[strspn(text, "0123456789+-eE,")] && strchr(text, ',') == strrchr(text, ',') &&
         strchr(text, ',');
}

static gg_status refuse_value(const gg_scene_reader *r, const gg_field *field, const char *key, const yaml_node_t *node)
{
  char shown[64], allowed[256], hint[64] = "";
  const char *likely = likely_word(field, scalar(node));
  show(node, shown, sizeof shown);
  gg_scene_field_allowed(field, allowed, sizeof allowed);
  if (has_decimal_comma(scalar(node))) likely = "a decimal point";
  if (likely) snprintf(hint, sizeof hint, " (did you mean %s?)", likely);
  return gg_scene_refuse(r, node, key, "%s is not allowed%s; allowed: %s", shown, hint, allowed);
}

static bool parse_number(const char *text, double *value)
{
  static const char *const infinities[] = {"inf", ".inf", "+.inf", "+inf", ".Inf", NULL};
  for (int i = 0; infinities[i]; i++)
    if (strcmp(text, infinities[i]) == 0) return *value = INFINITY, true;
  char *end;
  if (!*text || text[strspn(text, "0123456789+-.eE")]) return false;
  *value = strtod(text, &end);
  return *end == '\0' && isfinite(*value);
}

gg_status gg_scene_read_number(const gg_scene_reader *r, const gg_field *f, const char *key, const yaml_node_t *node,
                               double *value)
{
  const char *text = scalar(node);
  if (text && f->special && strcmp(text, f->special) == 0) return *value = f->special_value, GG_OK;
  bool quoted = text && node->data.scalar.style != YAML_PLAIN_SCALAR_STYLE && strcmp(text, "inf") != 0;
  double x;
  if (!text || quoted || !parse_number(text, &x)) return refuse_value(r, f, key, node);
  if (x < f->min || x > f->max || (f->above_min && x == f->min)) return refuse_value(r, f, key, node);
  *value = x;
  return GG_OK;
}

static gg_status read_integer(const gg_scene_reader *r, const gg_field *f, const char *key, const yaml_node_t *node,
                              int64_t *value)
{
  double x;
  GG_TRY(gg_scene_read_number(r, f, key, node, &x));
  if (x != floor(x)) return refuse_value(r, f, key, node);
  char *end;
  errno = 0;
  long long exact = strtoll(scalar(node), &end, 10); /* a seed has more digits than a double */
  const bool whole = *end == '\0'; /* else written as 1e6 or 5.0; the largest that are allowed round up to 2^63 */
  if (whole ? errno != 0 : x >= 0x1p63) return refuse_value(r, f, key, node);
  *value = whole ? exact : (int64_t)x;
  return GG_OK;
}

static gg_word find_word(const gg_field *f, const yaml_node_t *node)
{
  const char *text = scalar(node);
  return text ? gg_scene_field_find_word(f, text) : (gg_word){0};
}

static gg_status read_choice(const gg_scene_reader *r, const gg_field *f, const char *key, const yaml_node_t *node,
                             void *value)
{
  const gg_word word = find_word(f, node);
  if (!word.name) return refuse_value(r, f, key, node);
  memcpy(value, &word.value, sizeof word.value);
  return GG_OK;
}

static gg_status read_set(const gg_scene_reader *r, const gg_field *f, const char *key, const yaml_node_t *node,
                          unsigned *value)
{
  const gg_word alone = find_word(f, node);
  if (alone.name) return gg_scene_refuse(r, node, key, "is a list, also of one: %s: [%s]", f->key, alone.name);
  if (node->type != YAML_SEQUENCE_NODE) return refuse_value(r, f, key, node);
  unsigned set = 0;
  for (yaml_node_item_t *i = node->data.sequence.items.start; i < node->data.sequence.items.top; i++) {
    const yaml_node_t *item = yaml_document_get_node(r->document, *i);
    const gg_word word = find_word(f, item);
    if (!word.name) return refuse_value(r, f, key, item);
    set |= (unsigned)word.value;
  }
  *value = set;
  return GG_OK;
}

static gg_status read_vector(const gg_scene_reader *r, const gg_field *f, const char *key, const yaml_node_t *node,
                             double *value)
{
  if (node->type != YAML_SEQUENCE_NODE || node->data.sequence.items.top - node->data.sequence.items.start != 3)
    return refuse_value(r, f, key, node);
  for (int a = 0; a < 3; a++) {
    const yaml_node_t *item = yaml_document_get_node(r->document, node->data.sequence.items.start[a]);
    GG_TRY(gg_scene_read_number(r, f, key, item, &value[a]));
  }
  return GG_OK;
}

/* How many species the document itself lists; 0: it does not say, as what overrides a single key. */
static int listed_species(const gg_scene_reader *r)
{
  const yaml_node_t *root = yaml_document_get_root_node(r->document);
  if (!root || root->type != YAML_MAPPING_NODE) return 0;
  for (yaml_node_pair_t *i = root->data.mapping.pairs.start; i < root->data.mapping.pairs.top; i++) {
    const yaml_node_t *name = yaml_document_get_node(r->document, i->key);
    const yaml_node_t *list = yaml_document_get_node(r->document, i->value);
    if (scalar(name) && strcmp(scalar(name), "species") == 0 && list->type == YAML_SEQUENCE_NODE)
      return (int)(list->data.sequence.items.top - list->data.sequence.items.start);
  }
  return 0;
}

/* A forgotten pair would silently have the default. */
static gg_status check_pairs(const gg_scene_reader *r, const char *key, const yaml_node_t *node, const bool *given)
{
  int n = listed_species(r);
  char name[GG_PAIR_NAME];
  for (int p = 0; n <= GG_MAX_SPECIES && p < gg_pairs_of(n); p++)
    if (!given[p])
      return gg_scene_refuse(r, node, key, "lacks the pair %s: name every pair of the %d species, or give `other`",
                             gg_common_pair_name(p, name), n);
  return GG_OK;
}

/* Pairs that a map leaves out take `other`; where a single key is overridden, they stay what they are. */
static gg_status read_pairs(const gg_scene_reader *r, const gg_field *f, const char *key, const yaml_node_t *node,
                            double *value)
{
  double other;
  if (node->type != YAML_MAPPING_NODE) {
    GG_TRY(gg_scene_read_number(r, f, key, node, &other));
    for (int p = 0; p < GG_PAIRS; p++) value[p] = other;
    return GG_OK;
  }
  bool given[GG_PAIRS] = {false}, others = false;
  for (yaml_node_pair_t *i = node->data.mapping.pairs.start; i < node->data.mapping.pairs.top; i++) {
    const yaml_node_t *name = yaml_document_get_node(r->document, i->key);
    bool rest = scalar(name) && strcmp(scalar(name), "other") == 0;
    int p = scalar(name) && !rest ? gg_common_pair_find(scalar(name)) : -1;
    if ((!rest && p < 0) || (rest ? others : given[p]))
      return gg_scene_refuse(r, name, key,
                             "a map by pairs of species has keys like 11, 12 or 1-10, or other, each pair once");
    *(rest ? &others : &given[p]) = true;
    GG_TRY(gg_scene_read_number(r, f, key, yaml_document_get_node(r->document, i->value), rest ? &other : &value[p]));
  }
  if (!others) return check_pairs(r, key, node, given);
  for (int p = 0; p < GG_PAIRS; p++)
    if (!given[p]) value[p] = other;
  return GG_OK;
}

static gg_status read_one_species(const gg_scene_reader *r, const char *key, const yaml_node_t *node, gg_species *one)
{
  if (node->type != YAML_MAPPING_NODE)
    return gg_scene_refuse(r, node, key, "a species is a map with fraction, diameter, mass and inertia");
  unsigned given = 0;
  for (yaml_node_pair_t *i = node->data.mapping.pairs.start; i < node->data.mapping.pairs.top; i++) {
    const yaml_node_t *name = yaml_document_get_node(r->document, i->key);
    const yaml_node_t *value = yaml_document_get_node(r->document, i->value);
    const char *word = scalar(name) ? scalar(name) : "?";
    int k = 0;
    while (gg_scene_species_fields[k].key && strcmp(gg_scene_species_fields[k].key, word) != 0) k++;
    char full[96];
    snprintf(full, sizeof full, "%s.%.60s", key, word);
    if (!gg_scene_species_fields[k].key) return gg_scene_refuse_key(r, name, full);
    if (given & 1u << k) return gg_scene_refuse(r, name, full, "is given twice");
    given |= 1u << k;
    GG_TRY(gg_scene_read_value(r, &gg_scene_species_fields[k], full, value, one));
  }
  return GG_OK;
}

static gg_status read_species(const gg_scene_reader *r, const gg_field *f, const char *key, const yaml_node_t *node)
{
  if (node->type != YAML_SEQUENCE_NODE) return refuse_value(r, f, key, node);
  ptrdiff_t n = node->data.sequence.items.top - node->data.sequence.items.start;
  if (n < 1 || n > GG_MAX_SPECIES)
    return gg_scene_refuse(r, node, key, "%td species are given; allowed: 1 to %d", n, GG_MAX_SPECIES);
  gg_scene *scene = r->scene;
  double total = 0;
  for (int i = 0; i < n; i++) {
    gg_species one = {1.0 / (double)n, 1, 1, 0.4};
    GG_TRY(read_one_species(r, key, yaml_document_get_node(r->document, node->data.sequence.items.start[i]), &one));
    scene->species[i] = one;
    total += one.fraction;
  }
  if (fabs(total - 1) > 1e-9)
    return gg_scene_refuse(r, node, key, "the fractions sum to %.10g; they must sum to 1 (within 1e-9)", total);
  scene->n_species = (int)n;
  return GG_OK;
}

gg_status gg_scene_read_value(const gg_scene_reader *r, const gg_field *f, const char *key, const yaml_node_t *node,
                              void *base)
{
  void *value = (char *)base + f->offset;
  switch (f->type) {
  case GG_FIELD_NUMBER: return gg_scene_read_number(r, f, key, node, value);
  case GG_FIELD_INTEGER: return read_integer(r, f, key, node, value);
  case GG_FIELD_CHOICE: return read_choice(r, f, key, node, value);
  case GG_FIELD_SET: return read_set(r, f, key, node, value);
  case GG_FIELD_PAIRS: return read_pairs(r, f, key, node, value);
  case GG_FIELD_VECTOR: return read_vector(r, f, key, node, value);
  case GG_FIELD_SPECIES: return read_species(r, f, key, node);
  }
  return GG_OK;
}
