/* SPDX-License-Identifier: GPL-3.0-or-later */
/* graingas theory: values of all theories that apply to a scene. graingas cite: references, as BibTeX. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/options.h"
#include "cli/print.h"
#include "cli/report.h"

static gg_status print(const gg_options *o, const gg_comparison *c, gg_error *err)
{
  char *text = NULL;
  const char *warning;
  gg_status status = GG_OK;
  for (size_t i = 0; (warning = gg_comparison_warning(c, i)); i++) fprintf(stderr, "warning: %s\n", warning);
  if (!o->json)
    gg_cli_print_theories(c, o->all);
  else if ((status = gg_comparison_to_json(c, &text, err)) == GG_OK)
    gg_cli_print_text(text);
  return status;
}

int gg_cli_theory_main(const gg_options *o)
{
  gg_error err;
  gg_scene *scene;
  gg_comparison *c = NULL;
  if (gg_cli_options_scene(o, &scene, &err) != GG_OK) return gg_cli_report(&err);
  gg_status status = gg_theories_evaluate(scene, o->theories, NULL, NULL, &c, &err);
  if (status == GG_OK) status = print(o, c, &err);
  gg_comparison_free(c);
  gg_scene_free(scene);
  return gg_cli_report_scene(o, status, &err);
}

/* Names of the engines and theories of a result. */
static void list_methods(const gg_comparison *c, char *text, size_t size)
{
  gg_theory_info t;
  for (int k = 0; k < GG_CLI_ENGINES; k++)
    if (gg_comparison_result(c, gg_cli_engines[k])) gg_cli_append(text, size, "%s ", gg_cli_engines[k]);
  for (size_t i = 0; gg_comparison_theory(c, i, &t, NULL) == GG_OK; i++)
    if (!t.reason) gg_cli_append(text, size, "%s ", t.name);
}

static int print_references(const char *words, bool is_word)
{
  gg_error err;
  size_t n;
  char *text;
  if (gg_cite(words, &n, &text, &err) != GG_OK) return gg_cli_report(&err);
  if (n || !is_word) return gg_cli_print_text(text), GG_OK;
  free(text);
  return gg_cli_fail(GG_BAD_INPUT, "'%s': no reference; a result file, md, dsmc or a theory is expected", words);
}

int gg_cli_cite_main(const gg_options *o)
{
  gg_error err;
  gg_comparison *c;
  char words[4000] = "";
  const char *dot = o->input ? strrchr(o->input, '.') : NULL;
  if (!dot) return print_references(o->input ? o->input : "", o->input != NULL);
  if (gg_comparison_read(o->input, &c, &err) != GG_OK) return gg_cli_report(&err);
  list_methods(c, words, sizeof words);
  gg_comparison_free(c);
  return print_references(words, false);
}
