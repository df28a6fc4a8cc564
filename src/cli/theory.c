/* graingas theory: what every theory that applies says of a scene. */
#include <stdio.h>

#include "cli/options.h"
#include "cli/report.h"

static int evaluate(const gg_options *o, const gg_scene *scene)
{
  gg_error err;
  char *text = NULL;
  const char *warning;
  gg_comparison *c = NULL;
  gg_status status = gg_theories_evaluate(scene, NULL, &c, &err);
  for (size_t i = 0; status == GG_OK && (warning = gg_comparison_warning(c, i)); i++)
    fprintf(stderr, "warning: %s\n", warning);
  if (status == GG_OK && o->json) status = gg_comparison_to_json(c, &text, &err);
  if (status == GG_OK && o->json) gg_cli_print_text(text);
  if (status == GG_OK && !o->json) gg_cli_print_theories(c, o->all);
  gg_comparison_free(c);
  return status == GG_BAD_INPUT ? gg_cli_report_of(gg_cli_options_name(o), &err)
         : status == GG_OK      ? GG_OK
                                : gg_cli_report(&err);
}

int gg_cli_theory_main(const gg_command *command, int argc, char **argv)
{
  gg_options o;
  gg_error err;
  gg_scene *scene = NULL;
  int code = gg_cli_options_parse(command, argc, argv, &o);
  if (code == GG_CLI_GO_ON && gg_cli_options_scene(&o, &scene, &err) != GG_OK) code = gg_cli_report(&err);
  if (code == GG_CLI_GO_ON) code = evaluate(&o, scene);
  gg_scene_free(scene);
  gg_cli_options_clear(&o);
  return code;
}
