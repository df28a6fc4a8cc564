/* graingas theory: what every theory that applies says of a scene. */
#include <stdio.h>
#include <stdlib.h>

#include "cli/options.h"
#include "cli/report.h"
#include "io/document.h"

static int evaluate(const gg_options *o, const gg_scene *scene)
{
  gg_error err;
  gg_model model;
  gg_comparison *c = calloc(1, sizeof *c);
  if (!c) return gg_cli_fail(GG_FAILED, "out of memory");
  int code = gg_model_make(scene, GG_MD, &model, &err) == GG_OK ? GG_OK : gg_cli_report(&err);
  if (code == GG_OK) {
    gg_compare_theories(&model, c);
    if (o->json)
      gg_cli_print_document(gg_theory_document(scene, c));
    else
      gg_print_theories(scene, c, o->all);
  }
  free(c);
  return code;
}

int gg_cli_theory_main(const gg_command *command, int argc, char **argv)
{
  gg_options o;
  gg_error err;
  gg_scene_draft draft;
  int code = gg_options_parse(command, argc, argv, &o);
  if (code == GG_CLI_GO_ON && gg_options_scene(&o, &draft, &err) != GG_OK) code = gg_cli_report(&err);
  if (code == GG_CLI_GO_ON) code = evaluate(&o, &draft.scene);
  gg_options_clear(&o);
  return code;
}
