/* graingas run: one engine, with checkpoints and a trajectory where the scene asks for them. */
#include <stdio.h>
#include <stdlib.h>

#include "cli/options.h"
#include "cli/progress.h"
#include "cli/report.h"
#include "io/checkpoint_file.h"
#include "io/document.h"
#include "io/result_file.h"

typedef struct running {
  const gg_options *options;
  const gg_scene *scene;
  gg_model model;
  char *output, *checkpoint;
  bool checkpointed;
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
  running *r = context;
  GG_TRY(gg_checkpoint_write(r->checkpoint, archive, r->scene, err));
  r->checkpointed = true;
  return GG_OK;
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

static void tell_interrupted(const running *r, gg_error *err)
{
  if (r->checkpointed)
    gg_fail(err, GG_INTERRUPTED, "interrupted; go on with: graingas run %s --resume %s", r->options->input,
            r->checkpoint);
  else
    gg_fail(err, GG_INTERRUPTED, "interrupted; nothing was written%s",
            r->scene->output.checkpoint_every > 0 ? "" : " (output.checkpoint_every above 0 keeps a checkpoint)");
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
  if (status == GG_INTERRUPTED) tell_interrupted(r, &err);
  if (status == GG_BAD_INPUT) gg_error_prefix(&err, status, "%s", r->options->input);
  if (status != GG_OK) gg_cli_report(&err);
  gg_result_free(result);
  return code;
}

static int read_checkpoint(const gg_options *o, gg_archive *archive)
{
  gg_error err;
  bool older;
  if (gg_checkpoint_read(o->resume, archive, &older, &err) != GG_OK) return gg_cli_report(&err);
  if (older) fprintf(stderr, "warning: %s cannot be read; going on from the one before, %s.1\n", o->resume, o->resume);
  return GG_CLI_GO_ON;
}

int gg_cli_run_main(const gg_command *command, int argc, char **argv)
{
  gg_options o;
  gg_error err;
  gg_scene_draft draft;
  gg_archive archive = {0};
  int code = gg_options_parse(command, argc, argv, &o);
  if (code == GG_CLI_GO_ON && gg_options_scene(&o, &draft, &err) != GG_OK) code = gg_cli_report(&err);
  if (code == GG_CLI_GO_ON && o.resume) code = read_checkpoint(&o, &archive);
  if (code == GG_CLI_GO_ON) {
    running r = {.options = &o, .scene = &draft.scene, .output = gg_options_output(&o, ".h5", &err)};
    r.checkpoint = r.output ? gg_checkpoint_path(r.output) : NULL;
    if (r.output && !r.checkpoint) gg_fail(&err, GG_FAILED, "out of memory");
    code = r.checkpoint ? execute(&r, o.resume ? &archive : NULL) : gg_cli_report(&err);
    free(r.output);
    free(r.checkpoint);
  }
  gg_archive_clear(&archive);
  gg_options_clear(&o);
  return code;
}
