/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Pages of docs/reference in Markdown from the program's tables: scene keys, quantities, commands. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/definition.h"
#include "cli/options.h"
#include "cli/pages.h"

/* Print text with Markdown's special characters escaped. */
static void put(const char *text)
{
  for (; *text; text++) {
    if (strchr("<|*_", *text)) putchar('\\');
    putchar(*text);
  }
}

static bool takes_words(const gg_entry *f)
{
  return strcmp(f->type, "choice") == 0 || strcmp(f->type, "set") == 0;
}

/* Print the link target of a heading: its text without dots. */
static void put_anchor(const char *key)
{
  for (; *key; key++)
    if (*key != '.') putchar(*key);
}

static void put_range(const gg_entry *f)
{
  if (takes_words(f)) {
    printf("%s [below](#", strcmp(f->type, "set") == 0 ? "a list of words" : "a word");
    put_anchor(f->name);
    putchar(')');
    return;
  }
  put(f->allowed);
}

/* Print a table of keys; `whole`: with defaults and conditions. */
static void print_keys(gg_catalogue catalogue, bool whole)
{
  gg_entry f;
  printf("| key | meaning | unit | takes |%s\n| --- | --- | --- | --- |%s\n", whole ? " default | has effect if |" : "",
         whole ? " --- | --- |" : "");
  for (size_t i = 0; gg_catalogue_entry(catalogue, i, NULL, &f, NULL) == GG_OK; i++) {
    printf("| `%s` | ", f.name);
    put(f.doc);
    printf(" | ");
    put(f.unit ? f.unit : "");
    printf(" | ");
    put_range(&f);
    printf(" |");
    if (whole) printf(f.value[0] ? " `%s` | " : "%s | ", f.value);
    if (whole) put(f.when);
    printf(whole ? " |\n" : "\n");
  }
}

static void print_words(const char *key)
{
  gg_entry w;
  printf("\n### `%s`\n\n", key);
  for (size_t i = 0; gg_catalogue_word(key, i, &w, NULL) == GG_OK; i++) {
    printf("- `%s`%s", w.name, *w.doc ? ": " : "");
    put(w.doc);
    printf("\n");
  }
}

void gg_cli_print_scene_page(void)
{
  fputs(gg_cli_page_scene, stdout);
  print_keys(GG_CATALOGUE_KEYS, true);
  fputs(gg_cli_page_scene_notes, stdout);
  print_keys(GG_CATALOGUE_SPECIES_KEYS, false);
  printf("\n## Words\n");
  gg_entry f;
  for (size_t i = 0; gg_catalogue_entry(GG_CATALOGUE_KEYS, i, NULL, &f, NULL) == GG_OK; i++)
    if (takes_words(&f)) print_words(f.name);
}

static const char *unit_of(size_t i, const gg_scene *scene)
{
  gg_entry q;
  return gg_catalogue_entry(GG_CATALOGUE_QUANTITIES, i, scene, &q, NULL) == GG_OK ? q.unit : "";
}

void gg_cli_print_quantities_page(void)
{
  static const char *const scales[] = {"{flow: usf, phi: 0.1}", "{flow: hss, phi: 0.1}"};
  gg_scene *scene[2] = {NULL, NULL};
  gg_entry q;
  fputs(gg_cli_page_quantities, stdout);
  for (int k = 0; k < 2; k++) gg_scene_parse(scales[k], NULL, &scene[k], NULL);
  printf("| name | meaning | definition | unit with shear | unit without | measured in | theories |\n"
         "| --- | --- | --- | --- | --- | --- | --- |\n");
  for (size_t i = 0; gg_catalogue_entry(GG_CATALOGUE_QUANTITIES, i, NULL, &q, NULL) == GG_OK; i++) {
    char theories[1000];
    gg_cli_theories_of(q.name, theories, sizeof theories);
    printf("| `%s` | ", q.name);
    const char *colon = strstr(q.doc, ": "); /* after the plain formula: "(P_xx - P_yy)/p: first normal stress ..." */
    put(colon ? colon + 2 : q.doc);
    printf(" | $%s$ | ", q.formula);
    put(unit_of(i, scene[0]));
    printf(" | ");
    put(unit_of(i, scene[1]));
    printf(" | ");
    put(q.when);
    printf(" | ");
    put(theories);
    printf(" |\n");
  }
  fputs(gg_cli_page_quantities_notes, stdout);
  for (int k = 0; k < 2; k++) gg_scene_free(scene[k]);
}

static void print_options(const gg_command *c)
{
  printf("\n| option | what it does |\n| --- | --- |\n");
  for (const gg_option *o = gg_cli_options_table; o->flag; o++) {
    if (!(c->options & o->flag)) continue;
    printf("| <code>--%s%s", o->name, o->argument ? " " : "");
    put(o->argument ? o->argument : ""); /* not a span of code: the bar of "md|dsmc" would end the cell */
    printf("</code> | ");
    put(o->doc);
    printf(" |\n");
  }
}

void gg_cli_print_commands_page(void)
{
  printf(
      "# Commands\n\n"
      "`graingas --commands-page` prints this page from the table behind `--help`; a test keeps both equal.\n\n"
      "`graingas COMMAND [OPTION...]`. Options may stand anywhere after the command. `-` reads a scene from standard "
      "input. `--help` works with every command; `graingas --version` prints the version.\n\n"
      "| exit code | meaning |\n| --- | --- |\n"
      "| %d | done |\n| %d | the run failed or did not reach its stopping criteria |\n"
      "| %d | the command line or the scene is invalid |\n| %d | a file could not be read or written |\n"
      "| %d | interrupted |\n",
      GG_OK, GG_FAILED, GG_BAD_INPUT, GG_BAD_FILE, GG_INTERRUPTED);
  for (const gg_command *c = gg_cli_commands; c->name; c++) {
    printf("\n## graingas %s\n `graingas %s %s`\n\n", c->name, c->name, c->arguments);
    put(c->summary);
    printf(".\n");
    for (const char *s = c->help; s && *s; s += strcspn(s, "\n"), s += *s == '\n') {
      char paragraph[1200];
      snprintf(paragraph, sizeof paragraph, "%.*s", (int)strcspn(s, "\n"), s);
      printf("\n");
      put(paragraph);
      printf("\n");
    }
    print_options(c);
  }
}
