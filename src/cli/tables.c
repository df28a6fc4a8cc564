/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The tables of commands, options and names as one JSON document, of which scripts/reference-pages makes the manual
 * page and the pages of docs/reference. */
#include <jansson.h>
#include <stdio.h>
#include <string.h>

#include "cli/options.h"

static json_t *words_of(const char *key)
{
  json_t *words = json_array();
  gg_entry w;
  for (size_t i = 0; gg_catalogue_word(key, i, &w, NULL) == GG_OK; i++)
    json_array_append_new(words, json_pack("{s:s, s:s}", "name", w.name, "doc", w.doc));
  return words;
}

static json_t *entries(gg_catalogue list, const gg_scene *scene)
{
  json_t *all = json_array();
  gg_entry e;
  for (size_t i = 0; gg_catalogue_entry(list, i, scene, &e, NULL) == GG_OK; i++) {
    json_t *one =
        json_pack("{s:s, s:s?, s:s?, s:s?, s:s?, s:s?, s:s, s:s, s:s?, s:s?, s:s}", "name", e.name, "doc", e.doc,
                  "unit", e.unit, "citation", e.citation, "assumptions", e.assumptions, "type", e.type, "allowed",
                  e.allowed, "value", e.value, "formula", e.formula, "answers", e.answers, "when", e.when);
    if (list == GG_CATALOGUE_KEYS) json_object_set_new(one, "words", words_of(e.name));
    json_array_append_new(all, one);
  }
  return all;
}

static json_t *entries_in(gg_catalogue list, const char *yaml)
{
  gg_scene *scene = NULL;
  gg_scene_parse(yaml, NULL, &scene, NULL);
  json_t *all = entries(list, scene);
  gg_scene_free(scene);
  return all;
}

/* Observables that a scene cannot have, with the reasons; "scene": why the scene itself is rejected. */
static json_t *missing_in(const char *yaml)
{
  json_t *all = json_object();
  gg_scene *scene = NULL;
  gg_error why;
  gg_entry o;
  if (gg_scene_parse(yaml, NULL, &scene, &why) != GG_OK || gg_scene_check(scene, &why) != GG_OK)
    json_object_set_new(all, "scene", json_string(why.message));
  else
    for (size_t i = 0; gg_catalogue_entry(GG_CATALOGUE_OBSERVABLES, i, scene, &o, NULL) == GG_OK; i++)
      if (o.missing) json_object_set_new(all, o.name, json_string(o.missing));
  gg_scene_free(scene);
  return all;
}

/* The same of a scene with these keys, or with a wave at its start, which one observable needs. */
static json_t *missing_with(const char *keys)
{
  char yaml[300];
  const char *name;
  json_t *reason, *all, *with_wave;
  void *next;
  snprintf(yaml, sizeof yaml, "{%s}", keys);
  all = missing_in(yaml);
  snprintf(yaml, sizeof yaml, "{%s, start: {wave: 0.1}, run: {duration: 1}}", keys);
  with_wave = missing_in(yaml);
  json_object_foreach_safe(all, next, name, reason) if (!json_object_get(with_wave, "scene") &&
                                                        !json_object_get(with_wave, name)) json_object_del(all, name);
  json_decref(with_wave);
  return all;
}

json_t *gg_cli_support(void)
{
  static const char *const grains[][2] = {{"smooth", "collision: {}"},
                                          {"rough", "collision: {beta: 1}"},
                                          {"frictional", "collision: {beta: 0, mu: 0.3}"},
                                          {"mixture", "species: [{fraction: 0.5}, {fraction: 0.5, mass: 2}]"}};
  json_t *all = json_array();
  gg_entry flow, engine;
  char yaml[200];
  for (size_t f = 0; gg_catalogue_entry(GG_CATALOGUE_FLOWS, f, NULL, &flow, NULL) == GG_OK; f++)
    for (size_t e = 0; gg_catalogue_entry(GG_CATALOGUE_ENGINES, e, NULL, &engine, NULL) == GG_OK; e++)
      for (size_t g = 0; g < sizeof grains / sizeof *grains; g++) {
        snprintf(yaml, sizeof yaml, "flow: %s, phi: 0.1, engine: %s, %s", flow.name, engine.name, grains[g][1]);
        json_array_append_new(all, json_pack("{s:s, s:s, s:s, s:o}", "flow", flow.name, "engine", engine.name, "grains",
                                             grains[g][0], "missing", missing_with(yaml)));
      }
  return all;
}

static json_t *commands_with(const gg_option *o)
{
  json_t *names = json_array();
  for (const gg_command *c = gg_cli_commands; c->name; c++)
    if (gg_cli_option_is_of(o, c)) json_array_append_new(names, json_string(c->name));
  return names;
}

/* The options of a command; NULL: all. */
static json_t *options_of(const gg_command *c)
{
  json_t *all = json_array();
  for (const gg_option *o = gg_cli_options_table; o->name; o++)
    if (!c || gg_cli_option_is_of(o, c))
      json_array_append_new(all, json_pack("{s:s, s:s?, s:s, s:o}", "name", o->name, "argument", o->argument, "doc",
                                           o->doc, "commands", commands_with(o)));
  return all;
}

static json_t *commands(void)
{
  json_t *all = json_array();
  for (const gg_command *c = gg_cli_commands; c->name; c++)
    json_array_append_new(all, json_pack("{s:s, s:s, s:s, s:s?, s:o}", "name", c->name, "arguments", c->arguments,
                                         "summary", c->summary, "help", c->help, "options", options_of(c)));
  return all;
}

void gg_cli_print_tables(void)
{
  json_t *all = json_pack("{s:s, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o}", "version", gg_version(),
                          "commands", commands(), "options", options_of(NULL), "keys", entries(GG_CATALOGUE_KEYS, NULL),
                          "species_keys", entries(GG_CATALOGUE_SPECIES_KEYS, NULL), "quantities",
                          entries_in(GG_CATALOGUE_QUANTITIES, "{flow: usf, phi: 0.1}"), "quantities_without_shear",
                          entries_in(GG_CATALOGUE_QUANTITIES, "{flow: hss, phi: 0.1}"), "theories",
                          entries(GG_CATALOGUE_THEORIES, NULL), "flows", entries(GG_CATALOGUE_FLOWS, NULL),
                          "observables", entries(GG_CATALOGUE_OBSERVABLES, NULL), "support", gg_cli_support());
  json_dumpf(all, stdout, JSON_INDENT(1));
  putchar('\n');
  json_decref(all);
}
