/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The value of one key from a YAML node, and validation errors: file, line, key, and what is allowed there. */
#include <errno.h>
#include <float.h>
#include <limits.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "base/memory.h"
#include "base/spelling.h"
#include "common/expression.h"
#include "common/quantity.h"
#include "scene/scene_reader.h"

const char *gg_scene_scalar(const yaml_node_t *node)
{
  return node->type == YAML_SCALAR_NODE ? (const char *)node->data.scalar.value : NULL;
}

/* Quote a word of the scene for a message: it may have line ends and escape sequences of terminals, and be cut within a
 * character. */
void gg_scene_quote(const char *word, char *text, size_t size)
{
  snprintf(text, size, "%s", word);
  size_t length = strlen(text), tail = 0;
  while (tail < 3 && tail < length && ((unsigned char)text[length - 1 - tail] & 0xC0) == 0x80) tail++;
  unsigned char lead = tail < length ? (unsigned char)text[length - 1 - tail] : 0;
  size_t wanted = lead >= 0xF0 ? 3 : lead >= 0xE0 ? 2 : lead >= 0xC0 ? 1 : 0;
  if (wanted > tail) text[length - 1 - tail] = '\0';
  gg_base_text_make_printable(text);
}

gg_status gg_scene_reject(const gg_scene_reader *r, const yaml_node_t *node, const char *key, const char *format, ...)
{
  char text[900], word[61];
  va_list args;
  va_start(args, format);
  vsnprintf(text, sizeof text, format, args);
  va_end(args);
  gg_scene_quote(key, word, sizeof word);
  if (!r->lines) return gg_base_fail(r->err, GG_BAD_INPUT, "%s: %s", r->name, text);
  return gg_base_fail(r->err, GG_BAD_INPUT, "%s:%zu: key '%s': %s", r->name, node->start_mark.line + 1, word, text);
}

gg_status gg_scene_reject_text(const gg_scene_reader *r, size_t line, const char *format, ...)
{
  char text[400];
  va_list args;
  va_start(args, format);
  vsnprintf(text, sizeof text, format, args);
  va_end(args);
  if (!r->lines || !line) return gg_base_fail(r->err, GG_BAD_INPUT, "%s: %s", r->name, text);
  return gg_base_fail(r->err, GG_BAD_INPUT, "%s:%zu: %s", r->name, line, text);
}

bool gg_scene_entry_next(const gg_scene_reader *r, const yaml_node_t *map, gg_scene_entry *e)
{
  e->pair = e->pair ? e->pair + 1 : map->data.mapping.pairs.start;
  if (e->pair >= map->data.mapping.pairs.top) return false;
  e->name = yaml_document_get_node(r->document, e->pair->key);
  e->value = yaml_document_get_node(r->document, e->pair->value);
  e->word = gg_scene_scalar(e->name);
  return true;
}

gg_status gg_scene_entry_key(const gg_scene_reader *r, const gg_scene_entry *e, const char *section, const char *of,
                             char key[GG_SCENE_KEY])
{
  if (!e->word) return gg_scene_reject(r, e->name, of, "a key must be a word");
  snprintf(key, GG_SCENE_KEY, "%.30s%s%.60s", section, *section ? "." : "", e->word);
  return GG_OK;
}

/* True if the word is one of those, separated by blanks. */
static bool is_among(const char *words, const char *word)
{
  size_t length = strlen(word);
  for (const char *at = words; at && *at; at += strcspn(at, " "), at += strspn(at, " "))
    if (strcspn(at, " ") == length && strncasecmp(at, word, length) == 0) return true;
  return false;
}

static const char *last_part(const char *key)
{
  const char *dot = strrchr(key, '.');
  return dot ? dot + 1 : key;
}

/* Keys of one section, or of none, by their last part. */
static void try_section(gg_nearest *nearest, const gg_field *fields, const char *section, size_t length)
{
  for (const gg_field *f = fields; f->key; f++) {
    const char *part = last_part(f->key), *before = nearest->best;
    size_t its = part == f->key ? 0 : (size_t)(part - f->key) - 1;
    if (section && (its != length || strncmp(f->key, section, length) != 0)) continue;
    gg_base_spelling_try(nearest, part);
    if (nearest->best != before) nearest->best = f->key;
  }
}

/* The likely key: one that others call so, one that ends so ("e: 0.9"), or the nearest: in its own section, of the
 * sections, anywhere. */
static const char *likely_key(const gg_field *fields, const char *key)
{
  const char *word = last_part(key);
  for (const gg_field *f = fields; f->key; f++)
    if (strcasecmp(last_part(f->key), word) == 0 || is_among(f->also, word)) return f->key;
  gg_nearest nearest = {.word = word};
  size_t length = word == key ? 0 : (size_t)(word - key) - 1;
  try_section(&nearest, fields, key, length);
  for (int i = 0; fields == gg_scene_fields && !length && gg_scene_sections[i]; i++)
    gg_base_spelling_try(&nearest, gg_scene_sections[i]);
  if (!nearest.best) try_section(&nearest, fields, NULL, 0);
  if (nearest.best) return nearest.best;
  gg_nearest full = {.word = key}; /* the section, too, may be mistyped */
  char section[32];
  snprintf(section, sizeof section, "%.*s", (int)length, key);
  for (const gg_field *f = fields; f->key && length && !gg_scene_is_section(section); f++)
    gg_base_spelling_try(&full, f->key);
  return full.best;
}

gg_status gg_scene_reject_key(const gg_scene_reader *r, const yaml_node_t *node, const char *key)
{
  char section[32], members[256] = "";
  for (const gg_word *former = gg_scene_former_keys; former->name; former++)
    if (strcmp(former->name, key) == 0) return gg_scene_reject(r, node, key, "%s", former->doc);
  bool species = strncmp(key, "species.", 8) == 0;
  const char *best = likely_key(species ? gg_scene_species_fields : gg_scene_fields, species ? last_part(key) : key);
  if (best) return gg_scene_reject(r, node, key, "no such key; did you mean '%s'?", best);
  if (species) return gg_scene_reject(r, node, key, "no such key; a species has fraction, diameter, mass and inertia");
  snprintf(section, sizeof section, "%.*s", (int)strcspn(key, "."), key);
  const size_t length = strlen(section);
  for (const gg_field *f = gg_scene_fields; f->key; f++)
    if (strncmp(f->key, section, length) == 0 && f->key[length] == '.')
      gg_base_text_append(members, sizeof members, "%s%s", *members ? ", " : "", f->key + length + 1);
  if (*members) return gg_scene_reject(r, node, key, "no such key; under %s there are %s", section, members);
  return gg_scene_reject(r, node, key, "no such key; `graingas info` lists every key there is");
}

/* One value to read: its row, the key in messages, the node. */
typedef struct input {
  const gg_scene_reader *r;
  const gg_field *f;
  const char *key;
  const yaml_node_t *node;
} input;

#define REJECT(at, ...) gg_scene_reject(in->r, at, in->key, __VA_ARGS__)

static input at(const input *in, const yaml_node_t *node)
{
  return (input){in->r, in->f, in->key, node};
}

static const yaml_node_t *item_of(const input *in, yaml_node_item_t item)
{
  return yaml_document_get_node(in->r->document, item);
}

/* Nodes of a list; 0 where it is none. */
static ptrdiff_t length_of(const yaml_node_t *node)
{
  return node->type == YAML_SEQUENCE_NODE ? node->data.sequence.items.top - node->data.sequence.items.start : 0;
}

static void show(const yaml_node_t *node, char *text, size_t size)
{
  char word[41];
  if (node->type != YAML_SCALAR_NODE || node->data.scalar.length == 0) {
    snprintf(text, size, "%s",
             node->type == YAML_SEQUENCE_NODE  ? "a list"
             : node->type == YAML_MAPPING_NODE ? "a map"
                                               : "nothing");
    return;
  }
  gg_scene_quote(gg_scene_scalar(node), word, sizeof word);
  snprintf(text, size, "%s '%s'", node->data.scalar.style == YAML_PLAIN_SCALAR_STYLE ? "value" : "text", word);
}

/* The nearest of the words, or the first whose description holds the one that was typed ("cooling": hcs). */
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

/* A number that is too small for a double: "1e-400". */
static bool underflows(const char *text)
{
  return text && !text[strspn(text, "0123456789+-.eE")] && fabs(strtod(text, NULL)) < DBL_MIN &&
         strcspn(text, "123456789") < strcspn(text, "eE");
}

static gg_status reject_value(const input *in)
{
  char shown[64], allowed[256], hint[64] = "";
  const char *text = gg_scene_scalar(in->node);
  const char *likely = in->f->type == GG_FIELD_FILE ? NULL : likely_word(in->f, text);
  show(in->node, shown, sizeof shown);
  gg_scene_field_allowed(in->f, allowed, sizeof allowed);
  if (has_decimal_comma(text)) likely = "a decimal point";
  if (underflows(text) && in->f->min <= 0 && !in->f->above_min) likely = "0";
  if (likely) snprintf(hint, sizeof hint, " (did you mean %s?)", likely);
  return REJECT(in->node, "%s is not allowed%s; allowed: %s", shown, hint, allowed);
}

static bool parse_number(const char *text, double *value)
{
  static const char *const infinities[] = {"inf", ".inf", "+.inf", "+inf", ".Inf", NULL};
  for (int i = 0; infinities[i]; i++)
    if (strcmp(text, infinities[i]) == 0) return *value = INFINITY, true;
  char *end;
  if (!*text || text[strspn(text, "0123456789+-.eE")]) return false;
  errno = 0;                         /* too large or too small for a double: neither infinity nor 0 was meant */
  *value = strtod(text, &end) + 0.0; /* -0 is 0 */
  return *end == '\0' && errno == 0;
}

static gg_status read_number(const input *in, double *value)
{
  const gg_field *f = in->f;
  const char *text = gg_scene_scalar(in->node);
  if (text && f->special && strcmp(text, f->special) == 0) return *value = f->special_value, GG_OK;
  bool quoted = text && in->node->data.scalar.style != YAML_PLAIN_SCALAR_STYLE && strcmp(text, "inf") != 0;
  double x;
  if (!text || quoted || !parse_number(text, &x)) return reject_value(in);
  if (x < f->min || x > f->max || (f->above_min && x == f->min)) return reject_value(in);
  return *value = x, GG_OK;
}

/* A number, or a formula of t behind it. */
static gg_status read_rate(const input *in, double *value)
{
  const char *text = gg_scene_scalar(in->node);
  char *formula = (char *)(value + 1);
  gg_expression e;
  gg_error why;
  double x;
  if (!text || has_decimal_comma(text) || parse_number(text, &x) || !text[strspn(text, "0123456789+-.eE ")]) {
    GG_TRY(read_number(in, &x));
    if (x != 0 && fabs(x) < 1 / in->f->max) return reject_value(in);
    return *value = x, *formula = '\0', GG_OK;
  }
  if (gg_common_expression_parse(&e, text, (const char *const[]){"t", NULL}, &why) != GG_OK)
    return REJECT(in->node, "neither a number nor a formula of t: %s", why.message);
  if (strlen(text) >= GG_FORMULA_TEXT)
    return REJECT(in->node, "a formula has at most %d characters", GG_FORMULA_TEXT - 1);
  return strcpy(formula, text), GG_OK;
}

static gg_status read_integer(const input *in, int64_t *value)
{
  double x;
  GG_TRY(read_number(in, &x));
  if (x != floor(x)) return reject_value(in);
  char *end;
  errno = 0;
  long long exact = strtoll(gg_scene_scalar(in->node), &end, 10); /* a seed has more digits than a double */
  const bool whole = *end == '\0'; /* else written as 1e6 or 5.0; the largest that are allowed round up to 2^63 */
  if (whole ? errno != 0 : x >= 0x1p63) return reject_value(in);
  return *value = whole ? exact : (int64_t)x, GG_OK;
}

static gg_word find_word(const input *in)
{
  const char *text = gg_scene_scalar(in->node);
  return text ? gg_scene_field_find_word(in->f, text) : (gg_word){0};
}

static gg_status read_choice(const input *in, void *value)
{
  const gg_word word = find_word(in);
  if (!word.name) return reject_value(in);
  return memcpy(value, &word.value, sizeof word.value), GG_OK;
}

static gg_status read_set(const input *in, unsigned *value)
{
  const gg_word alone = find_word(in);
  if (alone.name) return REJECT(in->node, "is a list, also of one: %s: [%s]", in->f->key, alone.name);
  if (in->node->type != YAML_SEQUENCE_NODE) return reject_value(in);
  unsigned set = 0;
  for (ptrdiff_t i = 0; i < length_of(in->node); i++) {
    const input item = at(in, item_of(in, in->node->data.sequence.items.start[i]));
    const gg_word word = find_word(&item);
    if (!word.name) return reject_value(&item);
    set |= (unsigned)word.value;
  }
  return *value = set, GG_OK;
}

static gg_status reject_quantity(const input *in, const gg_scene_entry *e)
{
  char word[61];
  gg_nearest nearest = {.word = e->word ? e->word : ""};
  for (gg_quantity q = 0; q < GG_N_QUANTITIES; q++) gg_base_spelling_try(&nearest, gg_common_quantity_name(q));
  gg_scene_quote(nearest.word, word, sizeof word);
  if (nearest.best) return REJECT(e->name, "no quantity '%s'; did you mean '%s'?", word, nearest.best);
  return REJECT(e->name, "no quantity '%s'; `graingas info SCENE.yaml` lists them", word);
}

/* Quantities that are not in the map have no requested error. */
static gg_status read_errors(const input *in, double *value)
{
  const char *text = gg_scene_scalar(in->node);
  double asked[GG_MAX_UNTIL] = {0};
  gg_field number = *in->f;
  number.type = GG_FIELD_NUMBER, number.special = NULL;
  const bool none = text && strcmp(text, in->f->special) == 0;
  if (!none && in->node->type != YAML_MAPPING_NODE) return reject_value(in);
  for (gg_scene_entry e = {0}; !none && gg_scene_entry_next(in->r, in->node, &e);) {
    const gg_quantity q = e.word ? gg_common_quantity_find(e.word) : GG_N_QUANTITIES;
    if (q >= GG_N_QUANTITIES) return reject_quantity(in, &e);
    if (asked[q] > 0) return REJECT(e.name, "names %s twice", e.word);
    GG_TRY(read_number(&(input){in->r, &number, in->key, e.value}, &asked[q]));
  }
  memcpy(value, asked, sizeof asked);
  return GG_OK;
}

/* The whole path of a file to read: a relative one is relative to the scene's file, for overrides to the current
 * folder. */
static gg_status find_file(const input *in, const char *text, char *value)
{
  const char *slash = in->r->lines ? strrchr(in->r->name, '/') : NULL;
  char folder[PATH_MAX], whole[PATH_MAX];
  const int length = slash ? (int)(slash - in->r->name) + 1 : 1;
  snprintf(folder, sizeof folder, "%.*s", length, slash ? in->r->name : ".");
  const bool found = *text != '/' && realpath(folder, whole);
  if (snprintf(value, GG_FILE_NAME, "%s%s%s", found ? whole : "", found ? "/" : "", text) < GG_FILE_NAME) return GG_OK;
  *value = '\0';
  return REJECT(in->node, "a path of more than %d characters", GG_FILE_NAME - 1);
}

static gg_status read_file_name(const input *in, char *value)
{
  const char *text = gg_scene_scalar(in->node), *ending = text ? strrchr(text, '.') : NULL;
  char printable[GG_FILE_NAME];
  if (text && strcmp(text, in->f->special) == 0) return *value = '\0', GG_OK;
  snprintf(printable, sizeof printable, "%s", text ? text : "");
  gg_base_text_make_printable(printable);
  if (text && in->f->reads && gg_scene_field_find_word(in->f, text).name && *text != '.')
    return snprintf(value, GG_FILE_NAME, "%s", text), GG_OK;
  if (!ending || ending == text || !gg_scene_field_find_word(in->f, ending).name || strcmp(printable, text) != 0)
    return reject_value(in);
  return in->f->reads ? find_file(in, text, value) : (snprintf(value, GG_FILE_NAME, "%s", text), GG_OK);
}

/* A special word is not among the numbers. */
static gg_status read_numbers(const input *in, double *value, ptrdiff_t least, ptrdiff_t most)
{
  gg_field number = *in->f;
  number.special = NULL;
  const ptrdiff_t n = length_of(in->node);
  if (n < least || n > most) return reject_value(in);
  for (ptrdiff_t i = 0; i < n; i++) {
    const input item = {in->r, &number, in->key, item_of(in, in->node->data.sequence.items.start[i])};
    GG_TRY(read_number(&item, &value[i]));
  }
  return GG_OK;
}

/* A special word is for both. */
static gg_status read_ends(const input *in, double *value)
{
  if (in->node->type == YAML_SEQUENCE_NODE) return read_numbers(in, value, 2, 2);
  GG_TRY(read_number(in, &value[0]));
  return value[1] = value[0], GG_OK;
}

static gg_status read_list(const input *in, double *value)
{
  const char *word = gg_scene_scalar(in->node);
  double x[GG_LOCAL_DENSITIES] = {0};
  if (!word || strcmp(word, in->f->special) != 0) GG_TRY(read_numbers(in, x, 1, GG_LOCAL_DENSITIES));
  for (int i = 0; i < GG_LOCAL_DENSITIES; i++)
    for (int j = 0; j < i; j++)
      if (x[i] > 0 && fabs(x[i] - x[j]) < 1e-8)
        return REJECT(in->node, "has %g twice; allowed: different numbers", x[i]);
  return memcpy(value, x, sizeof x), GG_OK;
}

/* As the program writes the value: 2.0 and 2 are one to whatever compares scenes. */
static gg_status keep_change(const char *key, const gg_field *member, const gg_scene *scene, gg_change *change,
                             gg_error *err)
{
  json_auto_t *value = gg_scene_field_json(member, scene, scene);
  snprintf(change->key, sizeof change->key, "%s", key);
  gg_scene_flow_style_text(value, change->value, sizeof change->value);
  return value ? GG_OK : gg_base_out_of_memory(err);
}

static gg_status read_change(const input *in, const gg_scene_entry *e, gg_change *change)
{
  gg_field member;
  gg_scene *tried = in->r->scene;
  const char *value = gg_scene_scalar(e->value);
  if (!e->word || gg_scene_key_find(e->word, GG_MAX_SPECIES, &member) < 0 || !member.on_the_way) {
    char word[61];
    gg_scene_quote(e->word ? e->word : "", word, sizeof word);
    return REJECT(e->name, "'%s' cannot change on the way; allowed: at, " GG_PROTOCOL_KEYS, word);
  }
  if (!value || strlen(value) >= GG_CHANGE_TEXT || strlen(e->word) >= GG_CHANGE_TEXT)
    return gg_scene_reject(in->r, e->value, e->word, "on the way it takes one number or word");
  const gg_scene before = *tried;
  gg_status status = gg_scene_read_value(in->r, &member, e->word, e->value, tried);
  if (status == GG_OK) status = keep_change(e->word, &member, tried, change, in->r->err);
  *tried = before;
  return status;
}

/* The changes of one map, from `change` on; *n grows by their number. */
static gg_status read_changes_at(const input *in, gg_change *change, int *n)
{
  static const gg_field at_field = {.key = "at", .type = GG_FIELD_NUMBER, .max = 1e30, .above_min = true};
  const int first = *n;
  double at = 0;
  if (in->node->type != YAML_MAPPING_NODE) return reject_value(in);
  for (gg_scene_entry e = {0}; gg_scene_entry_next(in->r, in->node, &e);) {
    if (e.word && strcmp(e.word, "at") == 0) {
      if (at > 0) return REJECT(e.name, "at is given twice in one change");
      GG_TRY(read_number(&(input){in->r, &at_field, "at", e.value}, &at));
    } else {
      if (*n == GG_MAX_CHANGES) return REJECT(e.name, "takes at most %d changes", GG_MAX_CHANGES);
      GG_TRY(read_change(in, &e, &change[(*n)++]));
    }
  }
  if (at == 0 || *n == first) return REJECT(in->node, "a change needs a time and a key: {at: 5, bath.temperature: 2}");
  if (first > 0 && at < change[first - 1].at)
    return REJECT(in->node, "at: %g comes after at: %g; give changes in the order of times", at, change[first - 1].at);
  for (int k = first; k < *n; k++) {
    change[k].at = at;
    for (int j = 0; j < k; j++)
      if (change[j].at == at && strcmp(change[j].key, change[k].key) == 0)
        return REJECT(in->node, "changes %s twice at: %g", change[k].key, at);
  }
  return GG_OK;
}

static gg_status read_changes(const input *in, gg_change *value)
{
  gg_change change[GG_MAX_CHANGES] = {0};
  int n = 0;
  if (in->node->type != YAML_SEQUENCE_NODE) return reject_value(in);
  for (ptrdiff_t i = 0; i < length_of(in->node); i++) {
    const input item = at(in, item_of(in, in->node->data.sequence.items.start[i]));
    GG_TRY(read_changes_at(&item, change, &n));
  }
  memcpy(value, change, sizeof change);
  return GG_OK;
}

/* How many species the document itself lists; 0: it lists none, as what overrides a single key. */
static int listed_species(const gg_scene_reader *r)
{
  const yaml_node_t *root = yaml_document_get_root_node(r->document);
  if (!root || root->type != YAML_MAPPING_NODE) return 0;
  for (gg_scene_entry e = {0}; gg_scene_entry_next(r, root, &e);)
    if (e.word && strcmp(e.word, "species") == 0 && e.value->type == YAML_SEQUENCE_NODE) return (int)length_of(e.value);
  return 0;
}

/* Without an error a forgotten pair would have the default. */
static gg_status check_pairs(const input *in, const bool *given)
{
  int n = listed_species(in->r);
  char name[GG_PAIR_NAME];
  for (int p = 0; n <= GG_MAX_SPECIES && p < gg_pairs_of(n); p++)
    if (!given[p])
      return REJECT(in->node, "lacks the pair %s: name every pair of the %d species, or give `other`",
                    gg_common_pair_name(p, name), n);
  return GG_OK;
}

/* A number, or the text of a formula or a table of the speed and its value at the speed 1. */
typedef struct coefficient {
  double x;
  char law[GG_LAWS_TEXT]; /* "": a number */
} coefficient;

/* The value of {table: ...}; NULL: the node is none. */
static const yaml_node_t *table_of(const input *in)
{
  gg_scene_entry e = {0};
  if (in->node->type != YAML_MAPPING_NODE || !gg_scene_entry_next(in->r, in->node, &e)) return NULL;
  return e.word && strcmp(e.word, "table") == 0 ? e.value : NULL;
}

/* A file, or rows: [[0, 0.9], [2, 0.8]]. */
static gg_status read_table(const input *in, const yaml_node_t *table, char law[GG_LAWS_TEXT])
{
  gg_error why;
  const char *file = gg_scene_scalar(table);
  if (file && gg_scene_speed_table_read(file, in->r->lines ? in->r->name : NULL, law, &why) != GG_OK)
    return REJECT(table, "%.600s", why.message);
  for (ptrdiff_t i = 0; !file && i < length_of(table); i++) {
    static const gg_field number = {.type = GG_FIELD_NUMBER, .min = -1e30, .max = 1e30};
    const yaml_node_t *row = item_of(in, table->data.sequence.items.start[i]);
    double at[2];
    if (length_of(row) != 2) return REJECT(row, "a row of a table is [speed, value]");
    for (int k = 0; k < 2; k++)
      GG_TRY(read_number(&(input){in->r, &number, in->key, item_of(in, row->data.sequence.items.start[k])}, &at[k]));
    if (gg_scene_speed_table_add(at[0], at[1], law, &why) != GG_OK) return REJECT(row, "%s", why.message);
  }
  return *law ? GG_OK : REJECT(table, "a table is a file, or rows [[speed, value], ...]");
}

/* A law that is the same at all speeds is a number, within its limits. */
static gg_status take_law(const input *in, coefficient *c)
{
  gg_error why;
  gg_speed_law law;
  bool above = false, below = false;
  gg_status status = gg_common_speed_law_parse(&law, (gg_contact_coefficient)(in->f->by_speed - 1), c->law, &why);
  if (status == GG_OK) status = gg_common_speed_law_check(&law, &above, &below, &why);
  if (status != GG_OK) return REJECT(in->node, "%.600s", why.message);
  c->x = fmin(gg_common_speed_law_value(&law, 1, NULL), in->f->max);
  if (!gg_common_speed_law_is_constant(&law)) return GG_OK;
  uint64_t branch;
  const double exact = law.formula.n ? gg_common_expression_branch(&law.formula, &c->x, &branch) : law.value[0];
  gg_common_speed_law_value(&law, 1, &branch);
  if (branch & 1 || exact > in->f->max) return reject_value(in);
  c->x = exact, *c->law = '\0';
  return GG_OK;
}

/* A plain word is a formula if it has the letter v: others are mistyped numbers. */
static gg_status read_coefficient(const input *in, coefficient *c)
{
  const char *text = gg_scene_scalar(in->node);
  const yaml_node_t *table = in->f->by_speed ? table_of(in) : NULL;
  *c->law = '\0';
  const bool quoted = text && *text && in->node->data.scalar.style != YAML_PLAIN_SCALAR_STYLE;
  const bool formula = in->f->by_speed && text && (quoted || (strchr(text, 'v') && text[strspn(text, "v0123456789")]));
  if (!table && !formula) return read_number(in, &c->x);
  if (table) GG_TRY(read_table(in, table, c->law));
  if (formula && snprintf(c->law, GG_LAWS_TEXT, "%s", text) >= GG_LAWS_TEXT)
    return REJECT(in->node, "the formula has more than %d characters", GG_LAWS_TEXT);
  return take_law(in, c);
}

/* Put a coefficient in place of number `p` of a field, whose first number is `value`. */
static gg_status put(const input *in, const coefficient *c, double *value, int p)
{
  gg_error why;
  value[p] = c->x;
  if (!in->f->by_speed) return GG_OK;
  gg_speed_laws *laws = &in->r->scene->collision.by_speed;
  if (gg_common_speed_laws_set(laws, (gg_contact_coefficient)(in->f->by_speed - 1), gg_scene_field_pair(in->f) + p,
                               *c->law ? c->law : NULL, &why) != GG_OK)
    return REJECT(in->node, "%s", why.message);
  return GG_OK;
}

/* Pairs that a map leaves out take `other`; where a single key is overridden, they stay what they are. */
static gg_status read_pairs(const input *in, double *value)
{
  coefficient c, other;
  bool given[GG_PAIRS] = {false}, others = in->node->type != YAML_MAPPING_NODE || (in->f->by_speed && table_of(in));
  const bool all = others;
  if (all) GG_TRY(read_coefficient(in, &other));
  for (gg_scene_entry e = {0}; !all && gg_scene_entry_next(in->r, in->node, &e);) {
    bool rest = e.word && strcmp(e.word, "other") == 0;
    int p = e.word && !rest ? gg_common_pair_find(e.word) : -1;
    if ((!rest && p < 0) || (rest ? others : given[p]))
      return REJECT(e.name, "a map by pairs of species has keys like 11, 12 or 1-10, or other, each pair once");
    const input one = at(in, e.value);
    *(rest ? &others : &given[p]) = true;
    GG_TRY(read_coefficient(&one, rest ? &other : &c));
    if (!rest) GG_TRY(put(&one, &c, value, p));
  }
  if (!others) return check_pairs(in, given);
  for (int p = 0; p < GG_PAIRS; p++)
    if (!given[p]) GG_TRY(put(in, &other, value, p));
  return GG_OK;
}

static gg_status read_one(const input *in, double *value)
{
  coefficient c;
  GG_TRY(read_coefficient(in, &c));
  return put(in, &c, value, 0);
}

gg_status gg_scene_read_map(const gg_scene_reader *r, const char *section, const yaml_node_t *map,
                            const gg_field *fields, const char *unknown, void *base)
{
  char key[GG_SCENE_KEY];
  uint64_t given = 0;
  for (gg_scene_entry e = {0}; gg_scene_entry_next(r, map, &e);) {
    int k = 0;
    GG_TRY(gg_scene_entry_key(r, &e, section, section, key));
    while (fields[k].key && strcmp(last_part(fields[k].key), e.word) != 0) k++;
    if (!fields[k].key)
      return unknown ? gg_scene_reject(r, e.name, key, "%s", unknown) : gg_scene_reject_key(r, e.name, key);
    if (given & (uint64_t)1 << k) return gg_scene_reject(r, e.name, key, "is given twice");
    given |= (uint64_t)1 << k;
    GG_TRY(gg_scene_read_value(r, &fields[k], key, e.value, base));
  }
  return GG_OK;
}

static gg_status read_species(const input *in)
{
  if (in->node->type != YAML_SEQUENCE_NODE) return reject_value(in);
  const ptrdiff_t n = length_of(in->node);
  gg_scene *scene = in->r->scene;
  if (n < 1 || n > GG_MAX_SPECIES)
    return REJECT(in->node, "%td species are given; allowed: 1 to %d", n, GG_MAX_SPECIES);
  for (int i = 0; i < n; i++) {
    const yaml_node_t *map = item_of(in, in->node->data.sequence.items.start[i]);
    gg_species one = {1.0 / (double)n, 1, 1, 0.4, 1, 0};
    if (map->type != YAML_MAPPING_NODE)
      return REJECT(map, "a species is a map with fraction, diameter, mass, inertia, drag and torque");
    GG_TRY(gg_scene_read_map(in->r, in->key, map, gg_scene_species_fields, NULL, &one));
    scene->species[i] = one;
  }
  scene->n_species = (int)n;
  return GG_OK;
}

gg_status gg_scene_read_value(const gg_scene_reader *r, const gg_field *f, const char *key, const yaml_node_t *node,
                              void *base)
{
  const input in = {r, f, key, node};
  void *value = (char *)base + f->offset;
  switch (f->type) {
  case GG_FIELD_NUMBER: GG_TRY(f->by_speed ? read_one(&in, value) : read_number(&in, value)); break;
  case GG_FIELD_INTEGER: return read_integer(&in, value);
  case GG_FIELD_CHOICE: return read_choice(&in, value);
  case GG_FIELD_SET: return read_set(&in, value);
  case GG_FIELD_PAIRS: GG_TRY(read_pairs(&in, value)); break;
  case GG_FIELD_ERRORS: return read_errors(&in, value);
  case GG_FIELD_VECTOR: return read_numbers(&in, value, 3, 3);
  case GG_FIELD_LIST: return read_list(&in, value);
  case GG_FIELD_RATE: return read_rate(&in, value);
  case GG_FIELD_FILE: return read_file_name(&in, value);
  case GG_FIELD_ENDS: return read_ends(&in, value);
  case GG_FIELD_CHANGES: return read_changes(&in, value);
  case GG_FIELD_SPECIES: return read_species(&in);
  }
  if (f->by_speed) gg_common_speed_laws_classify(&r->scene->collision.by_speed);
  return GG_OK;
}
