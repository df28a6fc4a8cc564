/* graingas run: one engine, with checkpoints and a trajectory where the scene asks for them. */
#include <stdio.h>
#include <stdlib.h>

#include "cli/checkpointing.h"
#include "cli/progress.h"
#include "cli/report.h"
#include "cli/simulate.h"
#include "io/document.h"
#include "io/h5/result_file.h"

typedef struct running {
  const gg_options *options;
  const gg_scene *scene;
  gg_model model;
  const char *output;
  gg_checkpointing checkpoint;
  gg_cli_progress progress;
  gg_result_file file;
} running;

static void show(void *context, const gg_progress *now)
{
  gg_cli_progress_show(&((running *)context)->progress, now);
}

static gg_status store_frame(void *context, const gg_frame *frame, gg_error *err)
{
  running *r = context;
  return gg_result_file_frame(&r->file, &r->model, frame, err);
}

static gg_status store_checkpoint(void *context, const gg_archive *archive, gg_error *err)
{
  return gg_checkpointing_store(&((running *)context)->checkpoint, archive, err);
}

static int finish(running *r, const gg_result *result)
{
  gg_error err;
  if (r->options->json) {
    gg_cli_print_document(gg_run_document(result));
  } else {
    gg_print_run(result, r->options->all);
  }
  bool replaced = gg_file_exists(r->output);
  if (gg_result_file_finish_run(&r->file, result, &err) != GG_OK) return gg_cli_report(&err);
  gg_tell_written(r->options, "results", r->output, replaced);
  return GG_OK;
}

static int execute(running *r, const gg_archive *resume)
{
  gg_error err;
  gg_result *result = NULL;
  if (gg_model_make(r->scene, r->scene->engine, &r->model, &err) != GG_OK) return gg_cli_report(&err);
  if (gg_result_file_open(&r->file, r->output, r->options->command_line, &err) != GG_OK) return gg_cli_report(&err);
  gg_cli_progress_start(&r->progress, r->options->quiet);
  gg_cli_catch_interrupts();
  gg_hooks hooks = {r, show, gg_cli_interrupted, store_frame, store_checkpoint};
  gg_status status = gg_run_scene(r->scene, resume, r->options->threads, &hooks, &result, &err);
  gg_cli_progress_end(&r->progress);
  int code = (int)status;
  if (result) {
    code = finish(r, result);
    if (code == GG_OK) code = (int)status;
  }
  gg_result_file_abandon(&r->file);
  if (status == GG_INTERRUPTED) gg_checkpointing_tell_interrupted(&r->checkpoint, &err);
  if (status == GG_BAD_INPUT) gg_error_prefix(&err, status, "%s", r->options->input);
  if (status != GG_OK) gg_cli_report(&err);
  gg_result_free(result);
  return code;
}

static int run(const gg_options *o, const gg_scene *scene, const char *output, const gg_archive *resume)
{
  running r = {.options = o, .scene = scene, .output = output};
  int code = gg_checkpointing_start(&r.checkpoint, o, scene, output);
  if (code == GG_CLI_GO_ON) code = execute(&r, resume);
  gg_checkpointing_end(&r.checkpoint);
  return code;
}

int gg_cli_run_main(const gg_command *command, int argc, char **argv)
{
  return gg_simulate_main(command, argc, argv, run);
}
