#include "cli/simulate.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/outputs.h"
#include "cli/processes.h"
/* usf.h5 -> usf.checkpoint.h5; beside a device there is no place for it: then by the scene's name, as without --output.
 */
static char *checkpoint_path(const gg_options *o, const char *output)
{
  char *path = NULL;
  if (gg_cli_file_is_device(output)) return gg_cli_options_beside(o, ".checkpoint.h5");
  size_t length = strlen(output);
  if (length > 3 && strcmp(output + length - 3, ".h5") == 0) length -= 3;
  return asprintf(&path, "%.*s.checkpoint.h5", (int)length, output) < 0 ? NULL : path;
}

static int show(void *context, const gg_progress *progress)
{
  gg_cli_progress_show(&((gg_simulating *)context)->progress, progress);
  return 0;
}

static int is_interrupted(void *context)
{
  (void)context;
  return gg_cli_interrupted();
}

static void note_checkpoint(void *context, const char *checkpoint)
{
  (void)checkpoint;
  ((gg_simulating *)context)->stored = true;
}

static void warn(void *context, const char *message)
{
  gg_simulating *s = context;
  char *told = NULL;
  fprintf(stderr, "warning: %s\n", message);
  if (asprintf(&told, "%s%s\n", s->told ? s->told : "", message) < 0) return;
  free(s->told);
  s->told = told;
}

/* Of a command that draws one: where. NULL: it does not, or there is no file to draw it from. */
static char *picture_path(const gg_simulating *s)
{
  const gg_options *o = s->options;
  if (!s->draws || (o->picture && strcmp(o->picture, "none") == 0)) return NULL;
  if (o->picture) return strdup(o->picture);
  return gg_cli_file_is_device(s->output) ? NULL : gg_cli_path_with_suffix(s->output, ".svg");
}

static int simulate_scene(gg_simulating *s, gg_simulate *simulate)
{
  const gg_options *o = s->options;
  gg_error err;
  char every[40] = "0";
  gg_scene_get(s->scene, "output.checkpoint_every", every, sizeof every, NULL);
  s->keeps_checkpoints = strtod(every, NULL) > 0;
  s->output = gg_cli_options_output(o, ".h5", &err);
  if (!s->output) return gg_cli_report(&err);
  s->checkpoint = checkpoint_path(o, s->output);
  if (!s->checkpoint) return gg_cli_fail(GG_FAILED, "out of memory");
  s->picture = picture_path(s);
  s->replaced = gg_cli_file_exists(s->output) && !gg_cli_file_is_device(s->output);
  s->run = (gg_run_options){.threads = o->threads,
                            .workers = gg_cli_workers(o->threads),
                            .input = o->input,
                            .picture = s->picture,
                            .output = s->output,
                            .checkpoint = s->keeps_checkpoints ? s->checkpoint : NULL,
                            .resume = o->resume,
                            .command = o->command_line,
                            .context = s,
                            .progress = show,
                            .stop = is_interrupted,
                            .stored = note_checkpoint,
                            .warn = warn};
  gg_cli_progress_start(&s->progress, o->quiet);
  gg_cli_catch_interrupts();
  return simulate(s);
}

int gg_cli_simulate_main(const gg_command *command, int argc, char **argv, gg_simulate *simulate)
{
  gg_options o;
  gg_error err;
  gg_simulating s = {.options = &o, .draws = command->options & GG_OPT_PICTURE};
  int code = gg_cli_options_parse(command, argc, argv, &o);
  if (code == GG_CLI_GO_ON && gg_cli_options_scene(&o, &s.scene, &err) != GG_OK) code = gg_cli_report(&err);
  if (code == GG_CLI_GO_ON) code = simulate_scene(&s, simulate);
  free(s.output);
  free(s.checkpoint);
  free(s.picture);
  free(s.told);
  gg_scene_free(s.scene);
  gg_cli_options_clear(&o);
  return code;
}

/* How to go on: with a command that can be typed as it stands, if there is room for it. */
static void tell_stored(const gg_simulating *s, gg_error *err)
{
  const size_t size = sizeof err->message;
  char *file = gg_cli_shell_quote(s->checkpoint), *resume = NULL, *again = NULL;
  if (file && asprintf(&resume, " --resume %s", file) < 0) resume = NULL;
  if (resume && !s->options->resume) again = gg_cli_command_line_quote(&s->options->typed, resume);
  if (!again || snprintf(err->message, size, "interrupted; go on with: %s", again) >= (int)size)
    snprintf(err->message, size, "interrupted; go on with the same command and%s", resume ? resume : " --resume");
  free(file);
  free(resume);
  free(again);
}

static void tell_interrupted(const gg_simulating *s, gg_error *err)
{
  const char *hint = s->keeps_checkpoints ? "" : " (output.checkpoint_every above 0 keeps a checkpoint)";
  if (s->stored)
    tell_stored(s, err);
  else
    snprintf(err->message, sizeof err->message, "interrupted; nothing was stored%s", hint);
}

/* Was anything averaged? */
static bool has_means(const gg_result *result)
{
  gg_measurement m;
  for (size_t i = 0; gg_result_at(result, i, &m, NULL) == GG_OK; i++)
    if (isfinite(m.mean)) return true;
  return false;
}

bool gg_cli_simulation_has_output(gg_simulating *s, gg_status status, const gg_result *one, const gg_result *other)
{
  gg_cli_progress_end(&s->progress);
  if (status != GG_INTERRUPTED) return one || other;
  bool some = has_means(one) || has_means(other);
  if (some && !s->options->json) puts("\ninterrupted: the results so far");
  return some;
}

bool gg_cli_simulation_report(const gg_simulating *s, gg_status status)
{
  if (status == GG_BAD_FILE || status == GG_INTERRUPTED) return false;
  gg_cli_report_written(s->options, "results", s->output, s->replaced);
  return true;
}

int gg_cli_simulation_finish(const gg_simulating *s, gg_status status, gg_error *err)
{
  if (status == GG_OK) return GG_OK;
  if (status == GG_INTERRUPTED) tell_interrupted(s, err);
  return status == GG_BAD_INPUT ? gg_cli_report_of(gg_cli_options_name(s->options), err) : gg_cli_report(err);
}
