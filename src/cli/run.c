/* graingas run: one engine, with checkpoints and a trajectory where the scene asks for them. */
#include "cli/report.h"
#include "cli/simulate.h"

static void print(const gg_simulating *s, const gg_result *result)
{
  char *text = NULL;
  if (!s->options->json)
    gg_cli_print_run(result, s->told, s->options->all);
  else if (gg_result_to_json(result, &text, NULL) == GG_OK)
    gg_cli_print_text(text);
}

static int run(gg_simulating *s)
{
  gg_error err;
  gg_result *result = NULL;
  gg_status status = gg_run(s->scene, &s->run, &result, &err);
  if (gg_cli_simulation_has_output(s, status, result, NULL)) {
    print(s, result);
    gg_cli_simulation_report(s, status);
  }
  gg_result_free(result);
  return gg_cli_simulation_finish(s, status, &err);
}

int gg_cli_run_main(const gg_command *command, int argc, char **argv)
{
  return gg_cli_simulate_main(command, argc, argv, run);
}
