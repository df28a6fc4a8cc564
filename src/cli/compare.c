/* SPDX-License-Identifier: GPL-3.0-or-later */
/* graingas compare: both engines and the theories on one scene. */
#include "cli/report.h"
#include "cli/run_command.h"

static void print(const gg_options *o, const gg_comparison *c)
{
  char *text = NULL;
  if (!o->json)
    gg_cli_print_comparison(c, o->all);
  else if (gg_comparison_to_json(c, &text, NULL) == GG_OK)
    gg_cli_print_text(text);
}

int gg_cli_compare_main(const gg_options *o)
{
  gg_cli_run_options r;
  gg_comparison *c = NULL;
  int code = gg_cli_run_begin(&r, o);
  if (code != GG_CLI_GO_ON) return code;
  r.status = gg_compare(r.scene, &r.run, &c, &r.err);
  if (gg_cli_run_has_output(&r, gg_comparison_result(c, "md"), gg_comparison_result(c, "dsmc"))) print(o, c);
  gg_comparison_free(c);
  return gg_cli_run_end(&r);
}
