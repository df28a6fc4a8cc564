/* docs/scene.md: the page of scene keys, in Markdown, from the one table of them. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/options.h"
#include "io/scene/json.h"

/* Text with what Markdown would read as its own escaped. */
static void put(const char *text)
{
  for (; *text; text++) {
    if (strchr("<|*_", *text)) putchar('\\');
    putchar(*text);
  }
}

static bool takes_words(const gg_field *f)
{
  return f->type == GG_FIELD_CHOICE || f->type == GG_FIELD_SET;
}

/* A heading's name in links leaves out its dots. */
static void put_anchor(const char *key)
{
  for (; *key; key++)
    if (*key != '.') putchar(*key);
}

static void put_range(const gg_field *f)
{
  char allowed[256];
  if (takes_words(f)) {
    printf("%s [below](#", f->type == GG_FIELD_SET ? "a list of words" : "a word");
    put_anchor(f->key);
    putchar(')');
    return;
  }
  gg_field_allowed(f, allowed, sizeof allowed);
  put(allowed);
}

static void put_default(const gg_field *f)
{
  gg_scene defaults = gg_scene_defaults();
  if (strcmp(f->key, "flow") == 0 || strcmp(f->key, "phi") == 0) return; /* must be given */
  json_t *value = gg_field_json(f, &defaults, &defaults);
  putchar('`');
  gg_print_flow_style(stdout, value);
  putchar('`');
  json_decref(value);
}

static void print_fields(const gg_field *fields, bool with_default)
{
  printf("| key | takes | %sunit | meaning |\n| --- | --- | %s--- | --- |\n", with_default ? "default | " : "",
         with_default ? "--- | " : "");
  for (const gg_field *f = fields; f->key; f++) {
    printf("| `%s` | ", f->key);
    put_range(f);
    printf(" | ");
    if (with_default) {
      put_default(f);
      printf(" | ");
    }
    put(f->unit ? f->unit : "");
    printf(" | ");
    put(f->doc);
    printf(" |\n");
  }
}

static void print_words(const gg_field *f)
{
  printf("\n### `%s`\n\n", f->key);
  for (const gg_word *w = f->words; w->name; w++) {
    printf("- `%s`%s", w->name, *w->doc ? ": " : "");
    put(w->doc);
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
  print_fields(gg_scene_fields, true);
  printf("\n## Members of a species\n\nUnder `species`, a list of maps. Lengths and masses of results are in those of "
         "the first.\n\n");
  print_fields(gg_species_fields, false);
  printf("\n## Words\n");
  for (const gg_field *f = gg_scene_fields; f->key; f++)
    if (takes_words(f)) print_words(f);
}
