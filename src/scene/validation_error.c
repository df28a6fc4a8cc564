/* How a scene is refused: file, line, key, and what may stand there. */
#include <stdarg.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

#include "base/spelling.h"
#include "scene/yaml_node.h"

/* What a scene holds may hold line ends and the escape sequences of terminals, and be cut within a character. */
static void make_printable(char *text)
{
  size_t length = strlen(text), tail = 0;
  while (tail < 3 && tail < length && ((unsigned char)text[length - 1 - tail] & 0xC0) == 0x80) tail++;
  unsigned char lead = tail < length ? (unsigned char)text[length - 1 - tail] : 0;
  size_t wanted = lead >= 0xF0 ? 3 : lead >= 0xE0 ? 2 : lead >= 0xC0 ? 1 : 0;
  if (wanted > tail) text[length - 1 - tail] = '\0';
  for (; *text; text++)
    if ((unsigned char)*text < ' ' || *text == 0x7F) *text = '?';
}

void gg_scene_quote(const char *word, char *text, size_t size)
{
  snprintf(text, size, "%s", word);
  make_printable(text);
}

gg_status gg_scene_refuse(const gg_scene_reader *r, const yaml_node_t *node, const char *key, const char *format, ...)
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

gg_status gg_scene_refuse_text(const gg_scene_reader *r, size_t line, const char *format, ...)
{
  char text[400];
  va_list args;
  va_start(args, format);
  vsnprintf(text, sizeof text, format, args);
  va_end(args);
  if (!r->lines || !line) return gg_base_fail(r->err, GG_BAD_INPUT, "%s: %s", r->name, text);
  return gg_base_fail(r->err, GG_BAD_INPUT, "%s:%zu: %s", r->name, line, text);
}

/* Is the word one of those, separated by blanks? */
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

/* The key that was meant: one that others call so, one that ends so ("e: 0.9"), or the nearest: in its own section, of
 * the sections, anywhere. */
static const char *meant(const gg_field *fields, const char *key)
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

static void list_section(const char *section, char *text, size_t size)
{
  size_t length = strlen(section), used = 0;
  *text = '\0';
  for (const gg_field *f = gg_scene_fields; f->key && used < size; f++)
    if (strncmp(f->key, section, length) == 0 && f->key[length] == '.')
      used += (size_t)snprintf(text + used, size - used, "%s%s", used ? ", " : "", f->key + length + 1);
}

gg_status gg_scene_refuse_key(const gg_scene_reader *r, const yaml_node_t *node, const char *key)
{
  char section[32], members[256];
  for (const gg_word *former = gg_scene_former_keys; former->name; former++)
    if (strcmp(former->name, key) == 0) return gg_scene_refuse(r, node, key, "%s", former->doc);
  bool species = strncmp(key, "species.", 8) == 0;
  const char *best = meant(species ? gg_scene_species_fields : gg_scene_fields, species ? last_part(key) : key);
  if (best) return gg_scene_refuse(r, node, key, "no such key; did you mean '%s'?", best);
  if (species) return gg_scene_refuse(r, node, key, "no such key; a species has fraction, diameter, mass and inertia");
  snprintf(section, sizeof section, "%.*s", (int)strcspn(key, "."), key);
  list_section(section, members, sizeof members);
  if (*members) return gg_scene_refuse(r, node, key, "no such key; under %s there are %s", section, members);
  return gg_scene_refuse(r, node, key, "no such key; `graingas info` lists every key there is");
}
