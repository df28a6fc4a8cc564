/* SPDX-License-Identifier: GPL-3.0-or-later */
/* graingas theory: values of all theories that apply to a scene. */
#include <stdio.h>

#include "cli/report.h"
#include "cli/run_command.h"

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
