/* docs/reference/scene.md: the page of scene keys, in Markdown, from the one table of them. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/options.h"

/* Text with what Markdown would read as its own escaped. */
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

/* A heading's name in links leaves out its dots. */
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

static void print_keys(gg_catalogue catalogue, bool with_default)
{
  gg_entry f;
  printf("| key | takes | %sunit | meaning |\n| --- | --- | %s--- | --- |\n", with_default ? "default | " : "",
         with_default ? "--- | " : "");
  for (size_t i = 0; gg_catalogue_entry(catalogue, i, NULL, &f, NULL) == GG_OK; i++) {
    printf("| `%s` | ", f.name);
    put_range(&f);
    printf(" | ");
    if (with_default && f.value[0]) printf("`%s`", f.value);
    if (with_default) printf(" | ");
    put(f.unit ? f.unit : "");
    printf(" | ");
    put(f.doc);
    printf(" |\n");
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
  printf(
      "# Scene keys\n\n"
      "Written by `graingas --scene-page` from the table that reads scenes; a test keeps this page up to date.\n\n"
      "A scene is a YAML file. Only `flow` and `phi` must be given. A key with a dot stands in a section: "
      "`collision.e` is\n`e` under `collision:`; on the command line it is `--set collision.e=0.8`. Lengths, masses "
      "and times of a scene are in\nunits of the user's choice, the same throughout; where no unit stands, the number "
      "is pure. `graingas info SCENE.yaml`\nprints every key with its value and what the scene switches on.\n\n");
  print_keys(GG_CATALOGUE_KEYS, true);
  printf("\n## Members of a species\n\nUnder `species`, a list of maps. Lengths and masses of results are in those of "
         "the first. A pair of species is\ncalled by both numbers: `12`; with two digits `1-10`. A map by pair names "
         "every pair, or gives `other` for\nthose it leaves out; with `--set` they keep what they have.\n\n");
  print_keys(GG_CATALOGUE_SPECIES_KEYS, false);
  printf("\n## Words\n");
  gg_entry f;
  for (size_t i = 0; gg_catalogue_entry(GG_CATALOGUE_KEYS, i, NULL, &f, NULL) == GG_OK; i++)
    if (takes_words(&f)) print_words(f.name);
}
