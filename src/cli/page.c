/* SPDX-License-Identifier: GPL-3.0-or-later */
/* graingas page: the teaching page with a user's scene. */
#include <stdlib.h>
#include <string.h>

#include "cli/options.h"
#include "cli/outputs.h"

static int write_page(const gg_options *o, const gg_scene *scene)
{
  gg_error err;
  GG_CLI_FREED char *output =
      o->input ? gg_cli_options_output(o, ".html", &err) : strdup(o->output ? o->output : "page.html");
  if (!output && o->input) return gg_cli_report(&err);
  if (!output) return gg_cli_fail(GG_FAILED, "out of memory");
  const bool replaced = gg_cli_file_exists(output) && !gg_cli_file_is_device(output);
  gg_status status = gg_page_write(o->page, scene, output, &err);
  if (status == GG_OK) gg_cli_report_written(o, "page", output, replaced);
  if (status == GG_OK) return GG_OK;
  return status == GG_BAD_INPUT && o->input ? gg_cli_report_of(gg_cli_options_name(o), &err) : gg_cli_report(&err);
}

int gg_cli_page_main(const gg_options *o)
{
  gg_error err;
  gg_scene *scene = NULL;
  if (!o->input && o->n_overrides > 0)
    return gg_cli_fail(GG_BAD_INPUT, "--set and --seed are for a scene: graingas page SCENE.yaml");
  if (o->input && gg_cli_options_scene(o, &scene, &err) != GG_OK) return gg_cli_report(&err);
  const int code = write_page(o, scene);
  gg_scene_free(scene);
  return code;
}
