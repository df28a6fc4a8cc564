/* graingas compare: both engines and the theories on one scene. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/checkpointing.h"
#include "cli/progress.h"
#include "cli/report.h"
#include "cli/simulate.h"
#include "io/document.h"
#include "io/h5/result_file.h"
#include "io/plot/plot.h"

static void tell(void *context, const char *picture)
{
  gg_tell_written(context, "picture", picture, false);
}

/* A picture that cannot be drawn is no reason to call the comparison failed. */
static void draw(const gg_options *o, const char *output)
{
  gg_error err;
  if (o->picture && strcmp(o->picture, "none") == 0) return;
  char *picture = o->picture ? strdup(o->picture) : gg_with_suffix(output, ".svg");
  if (!picture) return;
  bool replaced = gg_file_exists(picture);
  bool drawn = gg_plot_result(output, picture, NULL, &err) == GG_OK;
  if (drawn) gg_tell_written(o, "picture", picture, replaced);
  drawn = drawn && gg_plot_result_curves(output, picture, NULL, tell, (void *)(uintptr_t)o, &err) == GG_OK;
  if (!drawn) fprintf(stderr, "warning: no picture: %s\n", err.message);
  free(picture);
}

static int finish(const gg_options *o, const char *output, gg_comparison *c, gg_result_file *file)
{
  gg_error err;
  if (o->json) {
    gg_cli_print_document(gg_comparison_document(c));
  } else {
    gg_print_comparison(c, o->all);
  }
  bool replaced = gg_file_exists(output);
  if (gg_result_file_finish_comparison(file, c, &err) != GG_OK) return gg_cli_report(&err);
  gg_tell_written(o, "results", output, replaced);
  draw(o, output);
  return GG_OK;
}

typedef struct comparing {
  gg_cli_progress progress;
  gg_checkpointing checkpoint;
} comparing;

static void show(void *context, const gg_progress *now)
{
  gg_cli_progress_show(&((comparing *)context)->progress, now);
}

static gg_status store_checkpoint(void *context, const gg_archive *archive, gg_error *err)
{
  return gg_checkpointing_store(&((comparing *)context)->checkpoint, archive, err);
}

static int write_results(const gg_options *o, const char *output, gg_comparison *c)
{
  gg_error err;
  gg_result_file file;
  if (gg_result_file_open(&file, output, o->command_line, &err) != GG_OK) return gg_cli_report(&err);
  return finish(o, output, c, &file);
}

static int compare(const gg_options *o, const gg_scene *scene, const char *output, const gg_archive *resume)
{
  gg_error err;
  gg_comparison c = {0};
  comparing now = {.progress = {.quiet = true}};
  if (gg_check_writable(output, &err) != GG_OK) return gg_cli_report(&err);
  if (scene->output.trajectory_every > 0) fprintf(stderr, "warning: compare keeps no trajectory; graingas run does\n");
  int code = gg_checkpointing_start(&now.checkpoint, o, scene, output);
  if (code != GG_CLI_GO_ON) return code;
  gg_cli_progress_start(&now.progress, o->quiet);
  gg_cli_catch_interrupts();
  gg_hooks hooks = {&now, show, gg_cli_interrupted, NULL, store_checkpoint};
  gg_status status = gg_compare_scene(scene, resume, o->threads, &hooks, &c, &err);
  gg_cli_progress_end(&now.progress);
  code = (int)status;
  if (status == GG_OK || (status == GG_FAILED && (c.by_engine[0] || c.by_engine[1]))) {
    int written = write_results(o, output, &c);
    if (written != GG_OK) code = written;
  }
  if (status == GG_BAD_INPUT) gg_error_prefix(&err, status, "%s", o->input);
  if (status == GG_INTERRUPTED) gg_checkpointing_tell_interrupted(&now.checkpoint, &err);
  if (status != GG_OK) gg_cli_report(&err);
  gg_checkpointing_end(&now.checkpoint);
  gg_comparison_clear(&c);
  return code;
}

int gg_cli_compare_main(const gg_command *command, int argc, char **argv)
{
  return gg_simulate_main(command, argc, argv, compare);
}
