/* graingas run: one engine, with checkpoints and a trajectory where the scene asks for them. */
#include "cli/report.h"
#include "cli/simulate.h"

static void print(const gg_simulating *s, const gg_result *result)
{
  char *text = NULL;
  if (!s->options->json)
    gg_print_run(result, s->told, s->options->all);
  else if (gg_result_to_json(result, &text, NULL) == GG_OK)
    gg_cli_print_text(text);
}

static int run(gg_simulating *s)
{
  gg_error err;
  gg_result *result = NULL;
  gg_status status = gg_run(s->scene, &s->run, &result, &err);
  if (gg_simulating_shows(s, status, result, NULL)) {
    print(s, result);
    gg_simulating_tell(s, status);
  }
  gg_result_free(result);
  return gg_simulating_end(s, status, &err);
}

int gg_cli_run_main(const gg_command *command, int argc, char **argv)
{
  return gg_simulate_main(command, argc, argv, run);
}
