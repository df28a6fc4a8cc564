#include "scene/resumption.h"

#include <inttypes.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "common/ensemble_size.h"
#include "scene/fields.h"

/* How the value of a key stands in memory, and so in an archive. */
static const struct {
  gg_item_type type;
  size_t count;
} kept[] = {
    [GG_FIELD_NUMBER] = {GG_ITEM_F64, 1},
    [GG_FIELD_INTEGER] = {GG_ITEM_I64, 1},
    [GG_FIELD_CHOICE] = {GG_ITEM_U8, sizeof(int)},
    [GG_FIELD_SET] = {GG_ITEM_U8, sizeof(unsigned)},
    [GG_FIELD_PAIRS] = {GG_ITEM_F64, GG_PAIRS},
    [GG_FIELD_VECTOR] = {GG_ITEM_F64, 3},
    [GG_FIELD_SPECIES] = {GG_ITEM_F64, GG_MAX_SPECIES *(sizeof(gg_species) / sizeof(double))},
};

static const char number_of_species[] = "scene/species.n", extension_item[] = "scene/extension";
static const char ensemble_item[] = "scene/chosen_for";
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
      GG_TRY(gg_base_archive_put(a, item_of(f, name), kept[f->type].type, at, kept[f->type].count, err));
  }
  GG_TRY(gg_base_archive_put(a, number_of_species, GG_ITEM_I64, &n, 1, err));
  const double chosen_for = gg_common_ensemble_size_error(scene);
  GG_TRY(gg_base_archive_put(a, ensemble_item, GG_ITEM_F64, &chosen_for, 1, err));
  gg_common_extension_signature(scene->extension, signature, sizeof signature);
  return gg_base_archive_put(a, extension_item, GG_ITEM_U8, signature, sizeof signature, err);
}

static GG_PRINTF(3, 4) void append(char *text, size_t size, const char *format, ...)
{
  size_t used = strlen(text);
  va_list arguments;
  va_start(arguments, format);
  if (used < size) vsnprintf(text + used, size - used, format, arguments);
  va_end(arguments);
}

static void append_number(const gg_field *f, double value, char *text, size_t size)
{
  char number[40];
  gg_scene_number_format(value, number, sizeof number);
  append(text, size, "%s", f->special && value == f->special_value ? f->special : number);
}

/* A value as it stands in scenes: "md", "rheology, cells", "auto", 0.9, "1, 1, 2". */
static void show(const gg_field *f, const void *at, char *text, size_t size)
{
  int64_t whole;
  unsigned word;
  gg_word w;
  *text = '\0';
  switch (f->type) {
  case GG_FIELD_INTEGER:
    memcpy(&whole, at, sizeof whole);
    if (f->special && (double)whole == f->special_value)
      append(text, size, "%s", f->special);
    else
      append(text, size, "%" PRId64, whole);
    return;
  case GG_FIELD_CHOICE:
  case GG_FIELD_SET:
    memcpy(&word, at, sizeof word);
    for (int i = 0; (w = gg_scene_field_word(f, i)).name; i++)
      if (f->type == GG_FIELD_SET ? (word & (unsigned)w.value) != 0 : word == (unsigned)w.value)
        append(text, size, "%s%s", *text ? ", " : "", w.name);
    return;
  default:
    for (size_t i = 0; i < (f->type == GG_FIELD_VECTOR ? 3 : 1); i++) {
      if (i) append(text, size, ", ");
      append_number(f, ((const double *)at)[i], text, size);
    }
  }
}

static void list_changeable(char *text, size_t size)
{
  *text = '\0';
  for (const gg_field *f = gg_scene_fields; f->key; f++)
    if (f->may_change) append(text, size, "%s%s", *text ? ", " : "", f->key);
}

static gg_status refuse(const gg_field *f, const char *key, const void *there, const void *here, gg_error *err)
{
  char one[256], two[256], changeable[256];
  show(f, there, one, sizeof one);
  show(f, here, two, sizeof two);
  list_changeable(changeable, sizeof changeable);
  return gg_base_fail(err, GG_BAD_INPUT,
                      "the checkpoint is of another run: %s differs (there %s, here %s); only %s may change", key, one,
                      two, changeable);
}

static gg_status refuse_pair(const gg_field *f, const double *there, const double *here, bool mixture, gg_error *err)
{
  char key[48], pair[GG_PAIR_NAME];
  int p = 0;
  while (p < GG_PAIRS && memcmp(&there[p], &here[p], sizeof *there) == 0) p++;
  if (p == GG_PAIRS) return GG_OK;
  gg_common_pair_name(p, pair);
  snprintf(key, sizeof key, "%s%s%s", f->key, mixture ? "." : "", mixture ? pair : "");
  return refuse(f, key, &there[p], &here[p], err);
}

static gg_status refuse_species(const gg_scene *there, const gg_scene *here, gg_error *err)
{
  char key[48];
  const gg_field number = {.type = GG_FIELD_NUMBER};
  const double n[] = {there->n_species, here->n_species};
  if (n[0] != n[1]) return refuse(&number, "the number of species", &n[0], &n[1], err);
  for (int i = 0; i < GG_MAX_SPECIES; i++)
    for (const gg_field *f = gg_scene_species_fields; f->key; f++) {
      const char *one = (const char *)&there->species[i] + f->offset,
                 *two = (const char *)&here->species[i] + f->offset;
      snprintf(key, sizeof key, "species.%d.%s", i + 1, f->key);
      if (memcmp(one, two, sizeof(double)) != 0) return refuse(f, key, one, two, err);
    }
  return GG_OK;
}

static gg_status same_value(const gg_field *f, const gg_scene *there, const gg_scene *here, gg_error *err)
{
  const void *one = (const char *)there + f->offset, *two = (const char *)here + f->offset;
  if (f->type == GG_FIELD_SPECIES) return refuse_species(there, here, err);
  if (f->type == GG_FIELD_PAIRS) return refuse_pair(f, one, two, here->n_species > 1, err);
  bool same = memcmp(one, two, kept[f->type].count * gg_base_archive_item_size(kept[f->type].type)) == 0;
  return same ? GG_OK : refuse(f, f->key, one, two, err);
}

/* Callbacks cannot be kept: what a run was extended by has to be registered again before it goes on. */
static gg_status same_extension(const gg_scene *scene, const gg_archive *a, gg_error *err)
{
  char here[SIGNATURE], there[SIGNATURE];
  gg_common_extension_signature(scene->extension, here, sizeof here);
  GG_TRY(gg_base_archive_get(a, extension_item, GG_ITEM_U8, there, sizeof there, err));
  there[SIGNATURE - 1] = 0;
  if (strcmp(here, there) == 0) return GG_OK;
  return gg_base_fail(
      err, GG_BAD_INPUT,
      "the run was extended by a program (%s), and this scene has %s: register the same law and observables "
      "with the scene before it is resumed",
      *there ? there : "nothing of its own", *here ? here : "nothing of its own");
}

gg_status gg_scene_resumption_settle(gg_scene *scene, const gg_archive *a, gg_error *err)
{
  if (!gg_base_archive_find(a, ensemble_item))
    return GG_OK; /* no archive of a run: gg_scene_resumption_check says so */
  return gg_base_archive_get(a, ensemble_item, GG_ITEM_F64, &scene->dsmc.chosen_for, 1, err);
}

gg_status gg_scene_resumption_check(const gg_scene *scene, const gg_archive *a, gg_error *err)
{
  char name[64];
  int64_t n;
  gg_scene there = *scene; /* what may change is left as it is here */
  GG_TRY(same_extension(scene, a, err));
  GG_TRY(gg_base_archive_get(a, number_of_species, GG_ITEM_I64, &n, 1, err));
  there.n_species = (int)n;
  for (const gg_field *f = gg_scene_fields; f->key; f++) {
    char *at = (char *)&there + f->offset;
    if (f->may_change) continue;
    GG_TRY(gg_base_archive_get(a, item_of(f, name), kept[f->type].type, at, kept[f->type].count, err));
    GG_TRY(same_value(f, &there, scene, err));
  }
  return GG_OK;
}
