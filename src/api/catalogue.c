/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The catalogue: rows of the library's tables of names. */
#include <stdio.h>
#include <string.h>

#include "api/api.h"
#include "base/text.h"
#include "common/engine.h"
#include "common/extension.h"
#include "common/flow.h"
#include "common/quantity.h"
#include "common/thermostat.h"
#include "measure/observable.h"
#include "run/default_size.h"
#include "run/result.h"
#include "scene/model_of_scene.h"
#include "scene/scene_reader.h"
#include "theory/theory.h"

static gg_status no_more(gg_error *err)
{
  return GG_REFUSE(err, "there are no more entries");
}

/* The i-th row of a table that ends with a NULL key; NULL after the last. */
static const gg_field *field_at(const gg_field *fields, size_t i)
{
  for (size_t k = 0; fields[k].key; k++)
    if (k == i) return &fields[k];
  return NULL;
}

/* Set the value of a key. */
static void put_value(const gg_field *f, const void *base, const gg_scene *scene, gg_entry *entry)
{
  json_auto_t *value = gg_scene_field_json(f, base, scene);
  gg_scene_flow_style_text(value, entry->value, sizeof entry->value);
}

static gg_status field_entry(const gg_field *f, gg_entry *entry, gg_error *err)
{
  if (!f) return no_more(err);
  *entry = (gg_entry){.name = f->key, .doc = f->doc, .unit = f->unit, .type = gg_scene_kinds[f->type].name};
  gg_scene_field_allowed(f, entry->allowed, sizeof entry->allowed);
  gg_scene_field_when(f, entry->when, sizeof entry->when);
  return GG_OK;
}

static gg_status key_entry(size_t i, const gg_scene *scene, gg_entry *entry, gg_error *err)
{
  const gg_field *f = field_at(gg_scene_fields, i);
  GG_TRY(field_entry(f, entry, err));
  gg_scene filled = scene ? *scene : gg_scene_defaults();
  if (scene) gg_run_scene_fill_in(&filled);
  entry->given = gg_scene_is_given(&filled, f->key);
  bool required = strcmp(f->key, "flow") == 0 || strcmp(f->key, "phi") == 0;
  if (entry->given || !required) put_value(f, &filled, &filled, entry);
  return GG_OK;
}

static gg_status species_key_entry(size_t i, gg_entry *entry, gg_error *err)
{
  const gg_scene defaults = gg_scene_defaults();
  const gg_field *f = field_at(gg_scene_species_fields, i);
  GG_TRY(field_entry(f, entry, err));
  put_value(f, &defaults.species[0], &defaults, entry);
  return GG_OK;
}

static gg_status word_entry(const char *key, size_t i, gg_entry *entry, gg_error *err)
{
  int id = gg_scene_field_find(key);
  if (id < 0 || !gg_scene_field_word(&gg_scene_fields[id], 0).name)
    return GG_REFUSE(err, "a scene has no key '%.60s' that takes words", key);
  gg_word word;
  size_t k = 0;
  while ((word = gg_scene_field_word(&gg_scene_fields[id], (int)k)).name && k < i) k++;
  if (!word.name) return no_more(err);
  return *entry = (gg_entry){.name = word.name, .doc = word.doc}, GG_OK;
}

gg_status gg_catalogue_word(const char *key, size_t i, gg_entry *entry, gg_error *err)
{
  GG_NEED(key, entry);
  return word_entry(key, i, entry, err);
}

static bool is_headline(const gg_model *model, gg_quantity q)
{
  gg_quantity headline[GG_N_QUANTITIES];
  const int n = gg_run_headline_quantities(model, headline);
  for (int i = 0; i < n; i++)
    if (headline[i] == q) return true;
  return false;
}

/* The model of a scene, or of the defaults. */
static gg_status model_of(const gg_scene *scene, gg_model *model, gg_error *err)
{
  gg_scene filled = scene ? *scene : gg_scene_defaults();
  if (filled.phi < 0) filled.phi = 0.1;
  gg_scene_fill_in(&filled);
  return gg_scene_model_make(&filled, filled.engine, model, err);
}

/* The i-th quantity. Its unit depends on the flow; without a scene it is that of uniform shear. */
static gg_status quantity_entry(size_t i, const gg_scene *scene, gg_entry *entry, gg_error *err)
{
  gg_model model;
  GG_TRY(model_of(scene, &model, err));
  if (i >= (size_t)gg_common_quantity_set_of(&model)) return no_more(err);
  gg_quantity q = gg_common_quantity_at(&model, (int)i);
  *entry = (gg_entry){.name = gg_common_quantity_name_in(&model, q),
                      .doc = gg_common_quantity_doc_in(&model, q),
                      .unit = gg_common_quantity_unit(q, &model),
                      .missing = scene ? gg_common_quantity_missing(&model, q) : NULL,
                      .headline = scene && is_headline(&model, q),
                      .type = "number"};
  if (q >= GG_N_QUANTITIES) return GG_OK;
  entry->formula = gg_common_quantity_formula(q);
  gg_common_quantity_symbol(q, entry->symbol, sizeof entry->symbol);
  gg_common_quantity_when(q, entry->when, sizeof entry->when);
  return GG_OK;
}

static void put_trait(gg_entry *entry, bool has, const char *word)
{
  if (has) gg_base_text_append(entry->traits, sizeof entry->traits, "%s%s", *entry->traits ? " " : "", word);
}

static gg_status flow_entry(size_t i, gg_entry *entry, gg_error *err)
{
  GG_TRY(word_entry("flow", i, entry, err));
  gg_flow flow = 0;
  while (strcmp(gg_flow_of(flow)->word, entry->name) != 0) flow++;
  const gg_flow_row *row = gg_flow_of(flow);
  put_trait(entry, gg_flow_is_sheared(flow), "sheared");
  put_trait(entry, gg_flow_is_walled(flow), "walls");
  put_trait(entry, gg_flow_has_moving_walls(flow), "moving_walls");
  put_trait(entry, gg_flow_cools(flow), "cools");
  put_trait(entry, row->falling == GG_ALWAYS_FALLS, "falls");
  put_trait(entry, row->falling == GG_MAY_FALL, "may_fall");
  for (int t = 0; t < GG_N_THERMOSTATS; t++)
    if (gg_flow_takes(flow, t))
      gg_base_text_append(entry->allowed, sizeof entry->allowed, "%s%s", *entry->allowed ? ", " : "",
                          gg_common_thermostats[t].word);
  return GG_OK;
}

static void put_flows(unsigned flows, gg_entry *entry)
{
  for (int f = 0; f < GG_N_FLOWS; f++)
    if (flows & GG_FLOW_BIT(f))
      gg_base_text_append(entry->when, sizeof entry->when, "%s%s", *entry->when ? ", " : "", gg_common_flows[f].word);
}

/* The i-th theory: first the theories of graingas, then user-defined ones. */
static gg_status theory_entry(size_t i, const gg_scene *scene, gg_entry *entry, gg_error *err)
{
  const gg_extension *user_defined = scene ? scene->extension : NULL;
  size_t n = 0;
  while (gg_theory_theories[n] && n < i) n++;
  const gg_theory *t = gg_theory_theories[n];
  if (!t && i - n < (size_t)gg_common_extension_theories(user_defined))
    t = gg_common_extension_face(user_defined, (int)(i - n));
  if (!t) return no_more(err);
  *entry = (gg_entry){
      .name = t->name, .doc = t->title, .citation = t->citation, .assumptions = t->assumptions, .answers = t->answers};
  put_flows(t->flows, entry);
  return GG_OK;
}

/* The i-th observable: first the words of `measure`, then user-defined ones. */
static gg_status observable_entry(size_t i, const gg_scene *scene, gg_entry *entry, gg_error *err)
{
  const gg_extension *user_defined = scene ? scene->extension : NULL;
  if (i < GG_N_OBSERVABLES) {
    const gg_observable *o = gg_measure_observables[i];
    gg_model model;
    GG_TRY(word_entry("measure", i, entry, err));
    if (!scene || !o->refuses) return GG_OK;
    GG_TRY(model_of(scene, &model, err));
    return entry->missing = o->refuses(&model), GG_OK;
  }
  i -= GG_N_OBSERVABLES;
  if (i >= (size_t)gg_common_extension_observables(user_defined)) return no_more(err);
  const gg_observable_definition *o = gg_common_extension_observable(user_defined, (int)i);
  *entry = (gg_entry){.name = o->name, .doc = o->doc};
  return GG_OK;
}

gg_status gg_catalogue_entry(gg_catalogue catalogue, size_t i, const gg_scene *scene, gg_entry *entry, gg_error *err)
{
  GG_NEED(entry);
  switch (catalogue) {
  case GG_CATALOGUE_KEYS: return key_entry(i, scene, entry, err);
  case GG_CATALOGUE_SPECIES_KEYS: return species_key_entry(i, entry, err);
  case GG_CATALOGUE_FLOWS: return flow_entry(i, entry, err);
  case GG_CATALOGUE_ENGINES: return word_entry("engine", i, entry, err);
  case GG_CATALOGUE_OBSERVABLES: return observable_entry(i, scene, entry, err);
  case GG_CATALOGUE_QUANTITIES: return quantity_entry(i, scene, entry, err);
  case GG_CATALOGUE_THEORIES: return theory_entry(i, scene, entry, err);
  }
  return GG_REFUSE(err, "gg_catalogue_entry: there is no such catalogue");
}
