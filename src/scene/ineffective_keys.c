#include "scene/ineffective_keys.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "scene/scene_json.h"

/* Keys that one reason leaves without effect: more than there are keys and members of species. */
enum { MOST_INERT = GG_MAX_FIELDS + 4 * GG_MAX_SPECIES };
typedef struct inert_keys {
  int n;
  struct {
    char key[48];
    char otherwise[160]; /* empty: told already */
  } of[MOST_INERT];
} inert_keys;

static void note(inert_keys *all, const char *otherwise, const char *key)
{
  if (all->n == MOST_INERT) return;
  snprintf(all->of[all->n].key, sizeof all->of[0].key, "%s", key);
  snprintf(all->of[all->n].otherwise, sizeof all->of[0].otherwise, "%s", otherwise);
  all->n++;
}

/* Does `base` hold another value than `default_base`, of the scenes? */
static bool differs(const gg_field *f, const void *base, const gg_scene *scene, const void *default_base,
                    const gg_scene *defaults)
{
  json_t *value = gg_scene_field_json(f, base, scene), *usual = gg_scene_field_json(f, default_base, defaults);
  bool yes = !json_equal(value, usual);
  json_decref(value);
  json_decref(usual);
  return yes;
}

/* The words for it in `text`, if the key has no effect. */
static bool is_inert(const gg_field *f, const gg_scene *scene, unsigned uses, char *text, size_t size)
{
  for (int i = 0; i < GG_MOST_CONDITIONS && f->when[i]; i++)
    if (!gg_scene_condition_holds(f->when[i], scene, uses))
      return gg_scene_condition_otherwise(f->when[i], text, size), true;
  return false;
}

/* Pairs of species that there are not: values given to them alone, unlike those of the rest. */
static void note_pairs(inert_keys *all, const gg_field *f, const gg_scene *scene)
{
  const double *value = (const double *)(const void *)((const char *)scene + f->offset);
  char key[48];
  char name[GG_PAIR_NAME];
  for (int p = gg_pairs_of(scene->n_species); p < GG_PAIRS; p++) {
    if (value[p] == value[GG_11] || value[p] == value[GG_PAIRS - 1]) continue;
    snprintf(key, sizeof key, "%s.%s", f->key, gg_common_pair_name(p, name));
    note(all, scene->n_species == 1 ? "with one species" : "with so few species", key);
  }
}

static void note_species(inert_keys *all, const gg_scene *scene, unsigned uses)
{
  const gg_scene defaults = gg_common_scene_defaults();
  for (int i = 0; i < scene->n_species; i++)
    for (const gg_field *f = gg_scene_species_fields; f->key; f++) {
      char why[160], key[48];
      bool inert = is_inert(f, scene, uses, why, sizeof why);
      snprintf(key, sizeof key, "species.%d.%s", i + 1, f->key);
      if (inert && differs(f, &scene->species[i], scene, &defaults.species[0], &defaults)) note(all, why, key);
    }
}

static void note_all(inert_keys *all, const gg_scene *scene, unsigned uses)
{
  const gg_scene defaults = gg_common_scene_defaults();
  for (const gg_field *f = gg_scene_fields; f->key; f++) {
    if (!gg_scene_is_given(scene, f->key)) continue;
    char why[160];
    bool inert = is_inert(f, scene, uses, why, sizeof why);
    if (f->type == GG_FIELD_SPECIES)
      note_species(all, scene, uses);
    else if (inert && differs(f, scene, scene, &defaults, &defaults))
      note(all, why, f->key);
    else if (f->type == GG_FIELD_PAIRS)
      note_pairs(all, f, scene);
  }
}

void gg_scene_inert(const gg_scene *scene, unsigned uses, gg_text_list *lines)
{
  inert_keys all = {0};
  note_all(&all, scene, uses);
  for (int i = 0; i < all.n; i++) {
    char why[160], keys[600] = "";
    int used = 0, n = 0;
    snprintf(why, sizeof why, "%s", all.of[i].otherwise);
    for (int k = i; *why && k < all.n && used < (int)sizeof keys; k++) {
      if (strcmp(all.of[k].otherwise, why) != 0) continue;
      used += snprintf(keys + used, sizeof keys - (size_t)used, "%s%s", n++ ? ", " : "", all.of[k].key);
      *all.of[k].otherwise = '\0';
    }
    if (n) gg_base_string_list_add(lines, "%s %s no effect %s", keys, n > 1 ? "have" : "has", why);
  }
}
