/* SPDX-License-Identifier: GPL-3.0-or-later */
/* graingas info WORD: what a scene key, a quantity, a theory or an observable is, in five lines; --all: in full. */
#include "cli/definition.h"

#include <errno.h>
#include <jansson.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/print.h"

/* Order of the search for a word; the last two tables are words of the keys `measure` and `flow`. */
static const gg_catalogue lists[] = {GG_CATALOGUE_QUANTITIES, GG_CATALOGUE_KEYS,  GG_CATALOGUE_SPECIES_KEYS,
                                     GG_CATALOGUE_THEORIES,   GG_CATALOGUE_FLOWS, GG_CATALOGUE_ENGINES,
                                     GG_CATALOGUE_OBSERVABLES};
enum { LISTS = sizeof lists / sizeof *lists };

/* Number of bytes of a text that fit into `rows` rows of `room` columns, wrapped at words. If the text does not fit,
 * `reserve` columns of the last row stay free. */
static size_t fit(const char *text, size_t room, int rows, size_t reserve)
{
  size_t end = 0, used = 0, start = 0;
  while (text[start]) {
    const size_t word = strcspn(text + start, " ");
    const bool wraps = used && used + 1 + word > room;
    if (wraps && --rows == 0) return end;
    used = wraps || !used ? word : used + 1 + word;
    start += word;
    if (rows > 1 || used + reserve <= room) end = start;
    start += strspn(text + start, " ");
  }
  return start;
}

static void print_rows(const char *lead, const char *text, int rows)
{
  static const char more[] = " ... (--all)";
  const size_t room = (size_t)gg_cli_terminal_width() - strlen(lead), bytes = fit(text, room, rows, strlen(more));
  gg_cli_print_paragraph(stdout, (int)strlen(lead), "%s%.*s%s", lead, (int)bytes, text, text[bytes] ? more : "");
}

static void line(const char *head, const char *text, int rows)
{
  char lead[24];
  snprintf(lead, sizeof lead, "  %-12s ", head);
  if (text && *text) print_rows(lead, text, rows);
}

bool gg_cli_quantity_is_minor(const char *name)
{
  static const char *const minor[] = {"_kinetic", "_collisional", "P_yx",       "kurtosis",
                                      "skewness", "knudsen",      "dissipation"};
  bool is = false;
  for (size_t i = 0; i < sizeof minor / sizeof *minor; i++) is |= strstr(name, minor[i]) != NULL;
  return is && strcmp(name, "viscosity_reduced_kinetic") != 0;
}

/* The theories that may give a quantity. */
static void list_theories(const char *quantity, char *text, size_t size)
{
  gg_entry theory;
  *text = '\0';
  for (size_t i = 0; gg_catalogue_entry(GG_CATALOGUE_THEORIES, i, NULL, &theory, NULL) == GG_OK; i++)
    if (gg_cli_has_word(theory.answers, quantity)) gg_cli_append(text, size, "%s%s", *text ? ", " : "", theory.name);
}

/* Quantities of a theory, without those that only --all prints. */
static void list_answers(const gg_entry *theory, char *text, size_t size)
{
  gg_entry q;
  *text = '\0';
  for (size_t i = 0; gg_catalogue_entry(GG_CATALOGUE_QUANTITIES, i, NULL, &q, NULL) == GG_OK; i++)
    if (!gg_cli_quantity_is_minor(q.name) && gg_cli_has_word(theory->answers, q.name))
      gg_cli_append(text, size, "%s%s", *text ? ", " : "", q.name);
}

/* `most`: rows of a text. The text that defines the word may have two. */
static int twice(int most)
{
  return most == 1 ? 2 : most;
}

static void define_quantity(const gg_entry *q, int most)
{
  char text[1000];
  snprintf(text, sizeof text, "%s: a quantity; symbol %s, unit %s%s", q->name, q->symbol, q->unit,
           strcmp(q->unit, "1") == 0 ? " (a pure number)" : " under shear");
  print_rows("", text, most);
  line("definition", q->doc, twice(most));
  line("measured in", q->when, most);
  list_theories(q->name, text, sizeof text);
  line("theories", *text ? text : "none", most);
}

static void define_key(const gg_entry *f, bool of_species, int most)
{
  char text[5000];
  snprintf(text, sizeof text, "%s: a key of %s; default: %s", f->name, of_species ? "a species" : "a scene",
           f->value[0] ? f->value : "none (required)");
  print_rows("", text, most);
  snprintf(text, sizeof text, "%s%s%s%s", f->doc, f->unit ? " (unit: " : "", f->unit ? f->unit : "",
           f->unit ? ")" : "");
  line("meaning", text, twice(most));
  line("takes", f->allowed, most);
  line("effect if", f->when[0] ? f->when : "always", most);
}

static void define_theory(const gg_entry *t, int most)
{
  char text[1000];
  snprintf(text, sizeof text, "%s: %s; flows: %s", t->name, t->doc, t->when);
  print_rows("", text, most);
  line("source", t->citation, most);
  list_answers(t, text, sizeof text);
  line("answers", text, most);
  line("range", t->assumptions, twice(most));
}

static void define_word(const gg_entry *w, const char *of, int most)
{
  printf("%s: %s\n", w->name, of);
  line("meaning", w->doc, twice(most));
  line("thermostats", w->allowed, most);
}

/* An observable: the flows in which each engine has it, of any grains. */
static void define_observable(const gg_entry *o, int most)
{
  json_t *all = gg_cli_support(), *one;
  char md[400] = "", dsmc[400] = "";
  size_t i;
  json_array_foreach(all, i, one)
  {
    const char *flow, *engine;
    json_t *missing;
    json_unpack(one, "{s:s, s:s, s:o}", "flow", &flow, "engine", &engine, "missing", &missing);
    char *text = strcmp(engine, "md") == 0 ? md : dsmc;
    const char *last = strrchr(text, ' ');
    if (json_object_get(missing, "scene") || json_object_get(missing, o->name)) continue;
    if (strcmp(last ? last + 1 : text, flow) != 0) gg_cli_append(text, sizeof md, "%s%s", *text ? ", " : "", flow);
  }
  json_decref(all);
  define_word(o, "an observable (measure: [...])", most);
  line("md", *md ? md : "none", most);
  line("dsmc", *dsmc ? dsmc : "none", most);
  line("more", "docs/reference/support.md, observables.md", most);
}

static void define(gg_catalogue list, const gg_entry *entry, int most)
{
  switch (list) {
  case GG_CATALOGUE_QUANTITIES: define_quantity(entry, most); return;
  case GG_CATALOGUE_KEYS: define_key(entry, false, most); return;
  case GG_CATALOGUE_SPECIES_KEYS: define_key(entry, true, most); return;
  case GG_CATALOGUE_THEORIES: define_theory(entry, most); return;
  case GG_CATALOGUE_FLOWS: define_word(entry, "a flow (flow: ...)", most); return;
  case GG_CATALOGUE_ENGINES: define_word(entry, "an engine (engine: ...)", most); return;
  case GG_CATALOGUE_OBSERVABLES: define_observable(entry, most); return;
  }
}

static bool find(const char *word, gg_catalogue *list, gg_entry *entry)
{
  const char *member = strncmp(word, "species.", 8) == 0 ? word + 8 : word; /* "species.torque" */
  for (int k = 0; k < LISTS; k++)
    for (size_t i = 0; gg_catalogue_entry(lists[k], i, NULL, entry, NULL) == GG_OK; i++)
      if (strcmp(entry->name, lists[k] == GG_CATALOGUE_SPECIES_KEYS ? member : word) == 0)
        return *list = lists[k], true;
  return false;
}

/* A scene key by its last part: "relative_error". */
static bool find_member(const char *word, gg_entry *key)
{
  for (size_t i = 0; gg_catalogue_entry(GG_CATALOGUE_KEYS, i, NULL, key, NULL) == GG_OK; i++) {
    const char *dot = strrchr(key->name, '.');
    if (dot && strcmp(dot + 1, word) == 0) return true;
  }
  return false;
}

/* Spelling suggestion from all tables, and from the last parts of dotted keys; a static string. */
static const char *nearest_to(const char *word)
{
  enum { MOST = 400 };
  const char *known[MOST + 1] = {NULL};
  gg_entry entry;
  int n = 0;
  for (int k = 0; k < LISTS; k++)
    for (size_t i = 0; n < MOST && gg_catalogue_entry(lists[k], i, NULL, &entry, NULL) == GG_OK; i++) {
      const char *dot = strrchr(entry.name, '.');
      known[n++] = entry.name;
      if (dot && n < MOST) known[n++] = dot + 1;
    }
  return gg_nearest_word(word, known);
}

/* Words of the field, and the entries that explain them. */
static const char *entry_of(const char *word)
{
  static const char *const words[][2] = {{"friction", "collision.mu"},
                                         {"roughness", "collision.beta"},
                                         {"restitution", "collision.e"},
                                         {"inelasticity", "collision.e"},
                                         {"volume_fraction", "phi"},
                                         {"density", "phi"},
                                         {"N", "particles"},
                                         {"T", "temperature"},
                                         {"p", "pressure"},
                                         {"eta", "shear_viscosity"},
                                         {"Lambda", "cos2_psi"},
                                         {"Haff", "haff1983"},
                                         {"Lun", "lun1991"},
                                         {"Lees-Edwards", "shear_rate"},
                                         {"shear", "shear_rate"},
                                         {"dt", "dsmc.time_step"},
                                         {"timestep", "dsmc.time_step"},
                                         {"msd", "diffusion"}};
  for (size_t i = 0; i < sizeof words / sizeof *words; i++)
    if (strcasecmp(word, words[i][0]) == 0) return words[i][1];
  return word;
}

bool gg_cli_is_word(const char *input)
{
  static const char *const endings[] = {".yaml", ".yml", ".h5", ".json", ".1"};
  if (entry_of(input) != input) return true;
  if (!*input || strspn(input, "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_.") < strlen(input))
    return false;
  for (size_t i = 0; i < sizeof endings / sizeof *endings; i++)
    if (gg_cli_has_ending(input, endings[i])) return false;
  return true;
}

int gg_cli_define(const char *word, bool all)
{
  const int most = all ? INT_MAX : 1;
  gg_catalogue list;
  gg_entry entry;
  if (find(word, &list, &entry) || find(entry_of(word), &list, &entry)) return define(list, &entry, most), GG_OK;
  if (find_member(word, &entry)) return define(GG_CATALOGUE_KEYS, &entry, most), GG_OK;
  const char *nearest = nearest_to(word);
  if (nearest)
    return gg_cli_fail(GG_BAD_INPUT, "'%s' is no file, scene key, quantity, theory or observable; did you mean '%s'?",
                       word, nearest);
  return gg_cli_fail(GG_BAD_INPUT, "'%s' is no file, scene key, quantity, theory or observable; see %s info", word,
                     program_invocation_name);
}

void gg_cli_print_headline(const gg_scene *scene)
{
  gg_entry q;
  char names[400] = "";
  for (size_t i = 0; gg_catalogue_entry(GG_CATALOGUE_QUANTITIES, i, scene, &q, NULL) == GG_OK; i++)
    if (q.headline) gg_cli_append(names, sizeof names, "%s%s", *names ? ", " : "", q.name);
  gg_cli_print_paragraph(stdout, 2, "headline quantities (run.relative_error applies to these): %s",
                         *names ? names : "none in this scene");
}
