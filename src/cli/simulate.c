#include "cli/simulate.h"

#include <stdlib.h>

#include "cli/checkpointing.h"

int gg_simulate_main(const gg_command *command, int argc, char **argv, gg_simulate *simulate)
{
  gg_options o;
  gg_error err;
  gg_scene_draft draft;
  gg_archive archive = {0};
  int code = gg_options_parse(command, argc, argv, &o);
  if (code == GG_CLI_GO_ON && gg_options_scene(&o, &draft, &err) != GG_OK) code = gg_cli_report(&err);
  if (code == GG_CLI_GO_ON) code = gg_checkpointing_read(&o, &archive);
  char *output = code == GG_CLI_GO_ON ? gg_options_output(&o, ".h5", &err) : NULL;
  if (code == GG_CLI_GO_ON)
    code = output ? simulate(&o, &draft.scene, output, o.resume ? &archive : NULL) : gg_cli_report(&err);
  free(output);
  gg_archive_clear(&archive);
  gg_options_clear(&o);
  return code;
}
