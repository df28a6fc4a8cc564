/* SPDX-License-Identifier: GPL-3.0-or-later */
/* graingas init: template of a scene. */
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "cli/options.h"
#include "cli/outputs.h"
#include "cli/print.h"

static int write_scene(const gg_options *o, const char *path, const char *text)
{
  const bool device = gg_cli_file_is_device(path);
  FILE *out = fopen(path, device ? "w" : "wx");
  if (!out && errno == EEXIST) return gg_cli_fail(GG_BAD_FILE, "%s: is there already; --output names another", path);
  if (!out) return gg_cli_fail(GG_BAD_FILE, "%s: cannot be written: %s", path, strerror(errno));
  const bool whole = fputs(text, out) >= 0;
  if (fclose(out) == 0 && whole) return gg_cli_report_written(o, "scene", path, false), GG_OK;
  const int why = errno;
  if (!device) unlink(path);
  return gg_cli_fail(GG_BAD_FILE, "%s: cannot be written: %s", path, strerror(why));
}

int gg_cli_init_main(const gg_options *o)
{
  gg_error err;
  char path[256];
  GG_CLI_FREED char *text = NULL;
  const char *flow = o->input ? o->input : "usf";
  if (gg_scene_begin(flow, &text, &err) != GG_OK) return gg_cli_report(&err);
  snprintf(path, sizeof path, "%s.yaml", flow);
  return write_scene(o, o->output ? o->output : path, text);
}
