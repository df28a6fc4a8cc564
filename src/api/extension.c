/* SPDX-License-Identifier: GPL-3.0-or-later */
/* User-defined observables, theories and restitution laws: the only place where they are checked. */
#include "common/extension.h"

#include <math.h>
#include <string.h>
#include <strings.h>

#include "base/text.h"
#include "graingas.h"
#include "scene/fields.h"
#include "scene/scene.h"
#include "theory/theory.h"

enum { MOST_LETTERS = 40, MOST_TEXT = 500 };

/* `what` is "observable", "quantity", "theory" or "restitution law". */
static gg_status check_name(const char *what, const char *name, gg_error *err)
{
  if (!name || !*name) return GG_REFUSE(err, "%s: a name is missing", what);
  if (gg_base_text_is_name(name, MOST_LETTERS)) return GG_OK;
  return GG_REFUSE(err, "%s: '%.60s' is not a valid name: use a letter, then letters, digits and _, at most %d", what,
                   name, MOST_LETTERS);
}

/* Check an optional text for files, documents and tables: one short line of UTF-8. */
static gg_status check_text(const char *name, const char *text, size_t most, gg_error *err)
{
  if (!text || (strlen(text) <= most && gg_base_text_is_printable(text))) return GG_OK;
  return GG_REFUSE(err, "%s: a text must be one line of UTF-8 of at most %zu bytes", name, most);
}

static bool is_shared(const char *quantity)
{
  return gg_common_quantity_find(quantity) != GG_N_QUANTITIES;
}

static bool is_user_defined(const gg_extension *x, const char *quantity)
{
  for (int k = 0; k < gg_common_extension_quantities(x); k++)
    if (strcmp(gg_common_extension_quantity(x, k)->name, quantity) == 0) return true;
  return false;
}

/* Whether a name ends with _error, as columns of standard errors do in tables. */
static bool is_error(const char *name)
{
  const size_t length = strlen(name);
  return length >= 6 && strcasecmp(name + length - 6, "_error") == 0;
}

static gg_status check_quantity(const gg_extension *x, const gg_observable_definition *o, int index, gg_error *err)
{
  const gg_quantity_definition *q = &o->quantities[index];
  GG_TRY(check_name("quantity", q->name, err));
  if (is_error(q->name))
    return GG_REFUSE(err, "quantity: the name '%s' is reserved: tables call errors ..._error", q->name);
  GG_TRY(check_text(q->name, q->unit, MOST_LETTERS, err));
  GG_TRY(check_text(q->name, q->doc, MOST_TEXT, err));
  bool taken = is_shared(q->name) || is_user_defined(x, q->name);
  for (int k = 0; k < index; k++) taken |= strcmp(o->quantities[k].name, q->name) == 0;
  return taken ? GG_REFUSE(err, "quantity: the name '%s' is taken", q->name) : GG_OK;
}

static gg_status check_observable(const gg_extension *x, const gg_observable_definition *o, gg_error *err)
{
  if (!o) return GG_REFUSE(err, "observable: the definition is missing");
  GG_TRY(check_name("observable", o->name, err));
  GG_TRY(check_text(o->name, o->doc, MOST_TEXT, err));
  bool taken = gg_scene_field_find_word(&gg_scene_fields[gg_scene_field_find("measure")], o->name).name != NULL;
  for (int k = 0; k < gg_common_extension_observables(x); k++)
    taken |= strcmp(gg_common_extension_observable(x, k)->name, o->name) == 0;
  if (taken) return GG_REFUSE(err, "observable: the name '%s' is taken", o->name);
  if (!o->sample) return GG_REFUSE(err, "%s: the callback `sample` is missing", o->name);
  if (!o->quantities || o->n_quantities < 1)
    return GG_REFUSE(err, "%s: an observable needs at least one quantity", o->name);
  if (o->n_quantities > GG_MOST_OWN_QUANTITIES - gg_common_extension_quantities(x))
    return GG_REFUSE(err, "%s: a scene can have at most %d user-defined quantities", o->name, GG_MOST_OWN_QUANTITIES);
  if (o->state_size > 1u << 24) return GG_REFUSE(err, "%s: state_size is above 16 MiB", o->name);
  for (int k = 0; k < o->n_quantities; k++) GG_TRY(check_quantity(x, o, k, err));
  return GG_OK;
}

/* Give the scene its extended copy; NULL: out of memory. */
static gg_status replace(gg_scene *scene, gg_extension *x)
{
  if (!x) return GG_FAILED;
  scene->extension = x;
  return GG_OK;
}

gg_status gg_scene_add_observable(gg_scene *scene, const gg_observable_definition *o, gg_error *err)
{
  if (!scene) return GG_REFUSE(err, "observable: the scene is missing");
  GG_TRY(check_observable(scene->extension, o, err));
  return replace(scene, gg_common_extension_with_observable(scene->extension, o, err));
}

/* Whether tables have a column of this name: md, md_error, NAME_error, z and so on. */
static bool is_column(const char *name)
{
  static const char *const words[] = {"quantity",       "unit", "md", "dsmc", "z", "correlation_time_unit",
                                      "beyond_expected"};
  bool found = strncasecmp(name, "md_", 3) == 0 || strncasecmp(name, "dsmc_", 5) == 0 || is_error(name);
  for (size_t i = 0; i < sizeof words / sizeof *words; i++) found |= strcasecmp(words[i], name) == 0;
  return found;
}

static gg_status check_theory(const gg_extension *x, const gg_theory_definition *t, gg_error *err)
{
  if (!t) return GG_REFUSE(err, "theory: the definition is missing");
  GG_TRY(check_name("theory", t->name, err));
  const char *const texts[] = {t->title, t->citation, t->assumptions};
  for (int k = 0; k < 3; k++) GG_TRY(check_text(t->name, texts[k], MOST_TEXT, err));
  if (is_column(t->name))
    return GG_REFUSE(err,
                     "theory: the name '%s' is reserved for columns of tables; not allowed: quantity, unit, md, dsmc, "
                     "z, correlation_time_unit, beyond_expected, md_..., dsmc_..., ..._error",
                     t->name);
  bool taken = gg_theory_find(t->name) != NULL;
  for (int k = 0; k < gg_common_extension_theories(x); k++)
    taken |= strcmp(gg_common_extension_theory(x, k)->name, t->name) == 0;
  if (taken) return GG_REFUSE(err, "theory: the name '%s' is taken", t->name);
  if (gg_common_extension_theories(x) == GG_MOST_OWN_THEORIES)
    return GG_REFUSE(err, "%s: a scene can have at most %d user-defined theories", t->name, GG_MOST_OWN_THEORIES);
  if (!t->evaluate) return GG_REFUSE(err, "%s: the callback `evaluate` is missing", t->name);
  if (!t->quantities || t->n_quantities < 1 || t->n_quantities > GG_MOST_QUANTITIES)
    return GG_REFUSE(err, "%s: a theory needs at least one quantity", t->name);
  for (int k = 0; k < t->n_quantities; k++) {
    const char *q = t->quantities[k];
    if (!q || !(is_shared(q) || is_user_defined(x, q)))
      return GG_REFUSE(err, "%s: there is no quantity called '%.60s'", t->name, q ? q : "");
    for (int j = 0; j < k; j++)
      if (strcmp(t->quantities[j], q) == 0) return GG_REFUSE(err, "%s: the quantity '%s' is given twice", t->name, q);
  }
  return GG_OK;
}

gg_status gg_scene_add_theory(gg_scene *scene, const gg_theory_definition *t, gg_error *err)
{
  if (!scene) return GG_REFUSE(err, "theory: the scene is missing");
  GG_TRY(check_theory(scene->extension, t, err));
  return gg_theory_user_theory_add(&scene->extension, t, err);
}

gg_status gg_scene_set_restitution(gg_scene *scene, const char *name, gg_restitution *e, void *context, gg_error *err)
{
  const gg_restitution_law law = {.name = e ? name : "", .e = e, .context = context};
  if (!scene) return GG_REFUSE(err, "restitution law: the scene is missing");
  if (e) {
    GG_TRY(check_name("restitution law", name, err));
    GG_TRY(gg_common_law_check(&law, scene->n_species, err));
  }
  return replace(scene, gg_common_extension_with_law(scene->extension, &law, NULL, err));
}

gg_status gg_scene_set_restitution_table(gg_scene *scene, const char *name, size_t n, const double *speed,
                                         const double *e, gg_error *err)
{
  if (!scene) return GG_REFUSE(err, "restitution law: the scene is missing");
  GG_TRY(check_name("restitution law", name, err));
  if (n < 1 || n > 1u << 20 || !speed || !e)
    return GG_REFUSE(err, "restitution law '%s': a table has 1 to %u speeds, and as many e", name, 1u << 20);
  for (size_t k = 0; k < n; k++) {
    if (!(speed[k] >= 0 && isfinite(speed[k])) || (k && !(speed[k] > speed[k - 1])))
      return GG_REFUSE(err, "restitution law '%s': speed %zu of the table is %g; speeds must ascend from 0 on", name,
                       k + 1, speed[k]);
    if (!(e[k] >= 0 && e[k] <= 1))
      return GG_REFUSE(err, "restitution law '%s': e %zu of the table is %g; it must be from 0 to 1", name, k + 1,
                       e[k]);
  }
  const gg_restitution_law law = {.name = name};
  const gg_law_table table = {n, speed, e};
  return replace(scene, gg_common_extension_with_law(scene->extension, &law, &table, err));
}
