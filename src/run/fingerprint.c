#include "run/fingerprint.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "common/extension.h"
#include "scene/fields.h"

/* Every key that fixes the trajectory or what is averaged; stop rules and output may change between parts of a run. */
typedef struct gg_fingerprint {
  char name[24];
  double value;
} gg_fingerprint;

enum { MOST_FINGERPRINT = 32 + 3 * GG_PAIRS + 4 * GG_MAX_SPECIES };

static GG_PRINTF(4, 5) int put(gg_fingerprint *f, int n, double value, const char *format, ...)
{
  va_list arguments;
  va_start(arguments, format);
  vsnprintf(f[n].name, sizeof f[n].name, format, arguments);
  va_end(arguments);
  f[n].value = value;
  return n + 1;
}

static int fingerprint(const gg_scene *s, gg_fingerprint *f)
{
  const gg_fingerprint fixed[] = {{"flow", s->flow},
                                  {"engine", s->engine},
                                  {"thermostat", s->thermostat},
                                  {"contact_value", s->contact_value},
                                  {"phi", s->phi},
                                  {"particles", (double)s->particles},
                                  {"shear_rate", s->shear_rate},
                                  {"temperature", s->temperature},
                                  {"small_shear", s->small_shear},
                                  {"aspect", s->aspect[0]},
                                  {"aspect", s->aspect[1]},
                                  {"aspect", s->aspect[2]},
                                  {"species", s->n_species},
                                  {"walls.e", s->walls.e},
                                  {"walls.beta", s->walls.beta},
                                  {"walls.mu", s->walls.mu},
                                  {"walls.speed", s->walls.speed},
                                  {"walls.top", s->walls.top},
                                  {"gravity", s->gravity[0]},
                                  {"gravity", s->gravity[1]},
                                  {"gravity", s->gravity[2]},
                                  {"run.warmup", s->run.warmup},
                                  {"run.replicas", (double)s->run.replicas},
                                  {"md.contact_time", s->md.contact_time},
                                  {"dsmc.time_step", s->dsmc.time_step},
                                  {"dsmc.particles", (double)s->dsmc.particles},
                                  {"dsmc.precision", s->dsmc.precision},
                                  {"measure", s->measure}};
  int n = sizeof fixed / sizeof *fixed;
  memcpy(f, fixed, sizeof fixed);
  for (int p = 0; p < GG_PAIRS; p++) {
    char name[GG_PAIR_NAME] = "";
    const char *const dot = s->n_species > 1 ? "." : "";
    if (s->n_species > 1) gg_pair_name(p, name);
    n = put(f, n, s->collision.e[p], "collision.e%s%s", dot, name);
    n = put(f, n, s->collision.beta[p], "collision.beta%s%s", dot, name);
    n = put(f, n, s->collision.mu[p], "collision.mu%s%s", dot, name);
  }
  for (int i = 0; i < GG_MAX_SPECIES; i++) {
    n = put(f, n, s->species[i].fraction, "species.%d.fraction", i + 1);
    n = put(f, n, s->species[i].diameter, "species.%d.diameter", i + 1);
    n = put(f, n, s->species[i].mass, "species.%d.mass", i + 1);
    n = put(f, n, s->species[i].inertia, "species.%d.inertia", i + 1);
  }
  return n;
}

static const char seed_item[] = "campaign/seed", extension_item[] = "campaign/extension";
enum { SIGNATURE = 2048 };

/* Callbacks cannot be kept: what a run was extended by has to be registered again before it goes on. */
static gg_status same_extension(const gg_scene *scene, const gg_archive *a, gg_error *err)
{
  char here[SIGNATURE], there[SIGNATURE];
  gg_extension_signature(scene->extension, here, sizeof here);
  GG_TRY(gg_archive_get(a, extension_item, GG_ITEM_U8, there, sizeof there, err));
  there[SIGNATURE - 1] = 0;
  if (strcmp(here, there) == 0) return GG_OK;
  return gg_fail(err, GG_BAD_INPUT,
                 "the run was extended by a program (%s), and this scene has %s: register the same law and observables "
                 "with the scene before it is resumed",
                 *there ? there : "nothing of its own", *here ? here : "nothing of its own");
}

static const char another[] = "the checkpoint is of another run: %s differs (there %s, here %s); only stop rules and "
                              "output may change";

/* Seeds are whole numbers that a double cannot tell apart. */
static gg_status same_seed(const gg_scene *scene, const gg_archive *a, gg_error *err)
{
  int64_t here = (int64_t)scene->run.seed, there;
  char one[24], two[24];
  GG_TRY(gg_archive_get(a, seed_item, GG_ITEM_I64, &there, 1, err));
  if (here == there) return GG_OK;
  snprintf(one, sizeof one, "%lld", (long long)there);
  snprintf(two, sizeof two, "%lld", (long long)here);
  return gg_fail(err, GG_BAD_INPUT, another, "run.seed", one, two);
}

gg_status gg_fingerprint_put(const gg_scene *scene, gg_archive *a, gg_error *err)
{
  gg_fingerprint f[MOST_FINGERPRINT];
  double values[MOST_FINGERPRINT];
  int n = fingerprint(scene, f);
  for (int i = 0; i < n; i++) values[i] = f[i].value;
  char signature[SIGNATURE] = "";
  gg_extension_signature(scene->extension, signature, sizeof signature);
  GG_TRY(gg_archive_put(a, extension_item, GG_ITEM_U8, signature, sizeof signature, err));
  const int64_t seed = (int64_t)scene->run.seed;
  GG_TRY(gg_archive_put(a, seed_item, GG_ITEM_I64, &seed, 1, err));
  return gg_archive_put(a, "campaign/fingerprint", GG_ITEM_F64, values, (size_t)n, err);
}

/* The value as it stands in scenes: "md", "rheology, cells", "auto", 0.9. */
static void show(const char *key, double value, char *text, size_t size)
{
  int id = gg_scene_field_find(key);
  const gg_field *f = id < 0 ? NULL : &gg_scene_fields[id];
  size_t used = 0;
  snprintf(text, size, "%.15g", value);
  if (f && f->special && value == f->special_value) snprintf(text, size, "%s", f->special);
  for (const gg_word *w = f ? f->words : NULL; w && w->name && used < size; w++)
    if (f->type == GG_FIELD_SET ? ((unsigned)value & (unsigned)w->value) != 0 : value == w->value)
      used += (size_t)snprintf(text + used, size - used, "%s%s", used ? ", " : "", w->name);
}

gg_status gg_fingerprint_check(const gg_scene *scene, const gg_archive *a, gg_error *err)
{
  GG_TRY(same_extension(scene, a, err));
  GG_TRY(same_seed(scene, a, err));
  gg_fingerprint here[MOST_FINGERPRINT];
  double there[MOST_FINGERPRINT];
  int n = fingerprint(scene, here);
  GG_TRY(gg_archive_get(a, "campaign/fingerprint", GG_ITEM_F64, there, (size_t)n, err));
  for (int i = 0; i < n; i++)
    if (memcmp(&here[i].value, &there[i], sizeof there[i]) != 0) {
      char one[256], two[256];
      show(here[i].name, there[i], one, sizeof one);
      show(here[i].name, here[i].value, two, sizeof two);
      return gg_fail(err, GG_BAD_INPUT, another, here[i].name, one, two);
    }
  return GG_OK;
}
