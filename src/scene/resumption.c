/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The scene in a checkpoint: another scene is rejected when the run is resumed. */
#include <stdio.h>
#include <string.h>

#include "scene/ensemble_size.h"
#include "scene/fields.h"

static const char number_of_species[] = "scene/species.n", extension_item[] = "scene/extension";
static const char ensemble_item[] = "scene/chosen_for", raised_item[] = "scene/contact_time_raised",
                  clock_item[] = "scene/clock_rate", laws_item[] = "scene/by_speed";
enum { SIGNATURE = 2048 };

static const char *item_of(const gg_field *f, char name[64])
{
  snprintf(name, 64, "scene/%s", f->key);
  return name;
}

gg_status gg_scene_resumption_put(const gg_scene *scene, gg_archive *a, gg_error *err)
{
  char name[64], signature[SIGNATURE] = "";
  const int64_t n = scene->n_species;
  for (const gg_field *f = gg_scene_fields; f->key; f++) {
    const char *at = (const char *)scene + f->offset;
    if (!f->may_change)
      GG_TRY(gg_base_archive_put(a, item_of(f, name), gg_scene_kinds[f->type].item, at, gg_scene_kinds[f->type].count,
                                 err));
  }
  GG_TRY(gg_base_archive_put(a, number_of_species, GG_ITEM_I64, &n, 1, err));
  const double chosen_for = gg_scene_ensemble_size_error(scene);
  GG_TRY(gg_base_archive_put(a, ensemble_item, GG_ITEM_F64, &chosen_for, 1, err));
  if (scene->fixed.contact_time != GG_AUTO)
    GG_TRY(gg_base_archive_put(a, raised_item, GG_ITEM_F64, &scene->fixed.contact_time, 1, err));
  if (scene->fixed.clock_rate != GG_AUTO)
    GG_TRY(gg_base_archive_put(a, clock_item, GG_ITEM_F64, &scene->fixed.clock_rate, 1, err));
  const gg_speed_laws *laws = &scene->collision.by_speed;
  if (gg_speed_laws_any(laws, GG_PAIRS)) GG_TRY(gg_base_archive_put(a, laws_item, GG_ITEM_U8, laws, sizeof *laws, err));
  gg_common_extension_signature(scene->extension, signature, sizeof signature);
  return gg_base_archive_put(a, extension_item, GG_ITEM_U8, signature, sizeof signature, err);
}

/* A value as it stands in scenes, lists without brackets: "md", "rheology, cells", "auto", 0.9, "1, 1, 2". */
static void show(const gg_field *f, const gg_scene *scene, char *text, size_t size)
{
  json_auto_t *value = gg_scene_field_json(f, scene, scene);
  gg_scene_flow_style_text(value, text, size);
  const size_t length = strlen(text);
  if (json_is_array(value) && text[length - 1] == ']') {
    memmove(text, text + 1, length);
    text[length - 2] = '\0';
  }
}

static gg_status reject(const char *key, const char *there, const char *here, gg_error *err)
{
  char changeable[320] = "";
  for (const gg_field *f = gg_scene_fields; f->key; f++)
    if (f->may_change) gg_base_text_append(changeable, sizeof changeable, "%s%s", *changeable ? ", " : "", f->key);
  return GG_REFUSE(err, "the checkpoint is of another run: %s differs (there %s, here %s); only %s may change", key,
                   there, here, changeable);
}

/* Whether the values of a field are the same in memory; of files that are read, which may have moved, the names. */
static bool is_same(const gg_field *f, const char *there, const char *here)
{
  if (!f->reads)
    return memcmp(there, here,
                  gg_scene_kinds[f->type].count * gg_base_archive_item_size(gg_scene_kinds[f->type].item)) == 0;
  const char *one = strrchr(there, '/'), *two = strrchr(here, '/');
  return strcmp(one ? one + 1 : there, two ? two + 1 : here) == 0;
}

/* The value of one key, or one member of it; `name` is what a message calls it. */
static gg_status same(const char *key, const char *name, const gg_scene *there, const gg_scene *here, gg_error *err)
{
  gg_field f;
  char one[256] = "", two[256] = "";
  if (gg_scene_key_find(key, GG_MAX_SPECIES, &f) < 0) return GG_OK;
  const char *law = gg_scene_field_law(&f, there, 0), *law_here = gg_scene_field_law(&f, here, 0);
  const bool laws_differ = law && law_here ? strcmp(law, law_here) != 0 : law != law_here;
  if (!laws_differ && is_same(&f, (const char *)there + f.offset, (const char *)here + f.offset)) return GG_OK;
  show(&f, there, one, sizeof one);
  show(&f, here, two, sizeof two);
  return reject(name, one, two, err);
}

static gg_status same_species(const gg_scene *there, const gg_scene *here, gg_error *err)
{
  char key[48], n[2][16];
  for (int k = 0; k < 2; k++) snprintf(n[k], sizeof n[k], "%d", (k ? here : there)->n_species);
  if (there->n_species != here->n_species) return reject("the number of species", n[0], n[1], err);
  for (int i = 0; i < GG_MAX_SPECIES; i++)
    for (const gg_field *f = gg_scene_species_fields; f->key; f++) {
      snprintf(key, sizeof key, "species.%d.%s", i + 1, f->key);
      GG_TRY(same(key, key, there, here, err));
    }
  return GG_OK;
}

static gg_status same_value(const gg_field *f, const gg_scene *there, const gg_scene *here, gg_error *err)
{
  char key[48], pair[GG_PAIR_NAME];
  if (f->type == GG_FIELD_SPECIES) return same_species(there, here, err);
  if (f->type != GG_FIELD_PAIRS) return same(f->key, f->key, there, here, err);
  for (int p = 0; p < GG_PAIRS; p++) {
    snprintf(key, sizeof key, "%s.%s", f->key, gg_common_pair_name(p, pair));
    GG_TRY(same(key, here->n_species > 1 ? key : f->key, there, here, err));
  }
  return GG_OK;
}

/* Callbacks cannot be kept: the program has to register its law and observables again before the run continues. */
static gg_status same_extension(const gg_scene *scene, const gg_archive *a, gg_error *err)
{
  char here[SIGNATURE], there[SIGNATURE];
  gg_common_extension_signature(scene->extension, here, sizeof here);
  GG_TRY(gg_base_archive_get(a, extension_item, GG_ITEM_U8, there, sizeof there, err));
  there[SIGNATURE - 1] = 0;
  if (strcmp(here, there) == 0) return GG_OK;
  return GG_REFUSE(err,
                   "the run was extended by a program (%s), and this scene has %s: register the same law and "
                   "observables with the scene before it is resumed",
                   *there ? there : "nothing of its own", *here ? here : "nothing of its own");
}

gg_status gg_scene_resumption_settle(gg_scene *scene, const gg_archive *a, gg_error *err)
{
  if (gg_base_archive_find(a, raised_item))
    GG_TRY(gg_base_archive_get(a, raised_item, GG_ITEM_F64, &scene->fixed.contact_time, 1, err));
  if (scene->fixed.contact_time != GG_AUTO && !(scene->fixed.contact_time > 0 && scene->fixed.contact_time < 0.01))
    return gg_base_fail(err, GG_BAD_FILE, "a contact time of %g, which no run has", scene->fixed.contact_time);
  if (gg_base_archive_find(a, clock_item))
    GG_TRY(gg_base_archive_get(a, clock_item, GG_ITEM_F64, &scene->fixed.clock_rate, 1, err));
  if (scene->fixed.clock_rate != GG_AUTO && !(scene->fixed.clock_rate > 0 && scene->fixed.clock_rate < INFINITY))
    return gg_base_fail(err, GG_BAD_FILE, "a unit of time of 1/%g", scene->fixed.clock_rate);
  if (!gg_base_archive_find(a, ensemble_item))
    return GG_OK; /* no archive of a run: gg_scene_resumption_check rejects it */
  return gg_base_archive_get(a, ensemble_item, GG_ITEM_F64, &scene->fixed.ensemble_error, 1, err);
}

gg_status gg_scene_resumption_check(const gg_scene *scene, const gg_archive *a, gg_error *err)
{
  char name[64];
  int64_t n;
  gg_scene there = *scene; /* what may change is left as it is here */
  GG_TRY(same_extension(scene, a, err));
  GG_TRY(gg_base_archive_get(a, number_of_species, GG_ITEM_I64, &n, 1, err));
  there.n_species = (int)n;
  memset(&there.collision.by_speed, 0, sizeof there.collision.by_speed);
  if (gg_base_archive_find(a, laws_item))
    GG_TRY(gg_base_archive_get(a, laws_item, GG_ITEM_U8, &there.collision.by_speed, sizeof(gg_speed_laws), err));
  for (const gg_field *f = gg_scene_fields; f->key; f++) {
    char *at = (char *)&there + f->offset;
    if (f->may_change) continue;
    if (f->reads && !gg_base_archive_find(a, item_of(f, name))) continue; /* of an earlier build */
    GG_TRY(
        gg_base_archive_get(a, item_of(f, name), gg_scene_kinds[f->type].item, at, gg_scene_kinds[f->type].count, err));
    if (f->reads) at[GG_FILE_NAME - 1] = '\0';
    GG_TRY(same_value(f, &there, scene, err));
  }
  return GG_OK;
}
