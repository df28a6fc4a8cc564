/* SPDX-License-Identifier: GPL-3.0-or-later */
/* graingas run: one engine, with the checkpoints and the trajectory of the scene. */
#include "cli/report.h"
#include "cli/run_command.h"

static void print(const gg_cli_run_options *r, const gg_result *result)
{
  char *text = NULL;
  if (!r->options->json)
    gg_cli_print_run(result, r->reported, r->options->all);
  else if (gg_result_to_json(result, &text, NULL) == GG_OK)
    gg_cli_print_text(text);
}

int gg_cli_run_main(const gg_options *o)
{
  gg_cli_run_options r;
  gg_result *result = NULL;
  int code = gg_cli_run_begin(&r, o);
  if (code != GG_CLI_GO_ON) return code;
  r.status = gg_run(r.scene, &r.run, &result, &r.err);
  if (gg_cli_run_has_output(&r, result, NULL)) print(&r, result);
  gg_result_free(result);
  return gg_cli_run_end(&r);
}
