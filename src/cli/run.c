/* SPDX-License-Identifier: GPL-3.0-or-later */
/* graingas run: one engine, with the checkpoints and the trajectory of the scene. graingas compare: both engines and
 * the theories. */
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/outputs.h"
#include "cli/print.h"
#include "cli/processes.h"
#include "cli/progress.h"
#include "cli/report.h"

typedef struct run_command {
  const gg_options *options;
  bool comparison; /* of both engines */
  gg_scene *scene;
  gg_run_options run;                  /* ready for gg_run or gg_compare */
  char *output, *checkpoint, *picture; /* picture: NULL if none is drawn */
  bool keeps_checkpoints;              /* output.checkpoint_every is above 0 */
  bool stored;                         /* a checkpoint was written in this run */
  bool out_of_time;                    /* the time limit ended the run */
  bool replaced, redrawn;              /* the output, the picture replaces an older file */
  char *reported;                      /* warnings printed before the run, a line each; NULL: none */
  gg_cli_progress progress;
  gg_status status; /* status of gg_run or gg_compare; err has its message */
  gg_error err;
  bool has_output;
} run_command;

/* usf.h5 -> usf.checkpoint.h5; for a device by the scene's name, as without --output. */
static char *checkpoint_path(const run_command *r)
{
  if (gg_cli_file_is_device(r->output))
    return gg_cli_options_beside(r->options, r->comparison ? ".compare.checkpoint.h5" : ".checkpoint.h5");
  return gg_cli_path_of_checkpoint(r->output);
}

/* File of a comparison's picture; NULL if no picture is drawn, or there is no result file. */
static char *picture_path(const run_command *r)
{
  const char *chosen = r->options->picture;
  if (!r->comparison || (chosen && strcmp(chosen, "none") == 0)) return NULL;
  if (chosen) return strdup(chosen);
  return gg_cli_file_is_device(r->output) ? NULL : gg_cli_path_with_suffix(r->output, ".svg");
}

static int show_progress(void *context, const gg_progress *progress)
{
  gg_cli_progress_show(&((run_command *)context)->progress, progress);
  return 0;
}

static void note_checkpoint(void *context, const char *checkpoint)
{
  (void)checkpoint;
  ((run_command *)context)->stored = true;
}

static void warn(void *context, const char *message)
{
  run_command *r = context;
  char *reported = NULL;
  fprintf(stderr, "warning: %s\n", message);
  if (asprintf(&reported, "%s%s\n", r->reported ? r->reported : "", message) < 0) return;
  free(r->reported);
  r->reported = reported;
}

static void add_effort(const gg_result *result, gg_result_info *sum)
{
  gg_result_info info;
  if (!result || gg_result_get_info(result, &info, NULL) != GG_OK) return;
  if (isfinite(info.total_cpu_seconds)) sum->total_cpu_seconds += info.total_cpu_seconds;
  sum->date = info.date;
}

/* Warn before the run, so that a command repeated by mistake can be stopped. */
static void warn_of_replacing(const char *output)
{
  enum { WORTH_IT = 60 /* s of processor time */ };
  char time[24];
  gg_result_info sum = {0};
  gg_result *run = NULL;
  gg_comparison *both = NULL;
  if (gg_result_read(output, &run, NULL) != GG_OK) gg_comparison_read(output, &both, NULL);
  add_effort(run, &sum);
  if (both) add_effort(gg_comparison_result(both, "md"), &sum), add_effort(gg_comparison_result(both, "dsmc"), &sum);
  gg_cli_format_duration(sum.total_cpu_seconds, time, sizeof time);
  if (sum.total_cpu_seconds > WORTH_IT) {
    gg_cli_print_name(stderr, "warning: ", output, " holds ");
    fprintf(stderr, "a %s of %s of processor time from %s, and will be replaced\n", run ? "run" : "comparison", time,
            sum.date ? sum.date : "an unknown date");
  }
  gg_result_free(run);
  gg_comparison_free(both);
}

static gg_status choose_files(run_command *r)
{
  char every[40] = "0", state[16] = "";
  gg_scene_get(r->scene, "output.checkpoint_every", every, sizeof every, NULL);
  gg_scene_get(r->scene, "output.state", state, sizeof state, NULL);
  r->keeps_checkpoints = strtod(every, NULL) > 0 || strcmp(state, "kept") == 0;
  r->output = gg_cli_options_output(r->options, r->comparison ? ".compare.h5" : ".h5", &r->err);
  if (!r->output) return r->err.status;
  r->checkpoint = checkpoint_path(r);
  if (!r->checkpoint) return gg_cli_refuse(&r->err, GG_FAILED, "out of memory");
  r->picture = picture_path(r);
  r->replaced = gg_cli_file_exists(r->output) && !gg_cli_file_is_device(r->output);
  if (r->replaced) warn_of_replacing(r->output);
  return GG_OK;
}

static void clear(run_command *r)
{
  free(r->output);
  free(r->checkpoint);
  free(r->picture);
  free(r->reported);
  gg_scene_free(r->scene);
}

/* GG_CLI_GO_ON, or the exit code. */
static int begin(run_command *r, const gg_options *o)
{
  *r = (run_command){.options = o, .comparison = strcmp(o->command->name, "compare") == 0};
  if (gg_cli_options_scene(o, &r->scene, &r->err) != GG_OK || choose_files(r) != GG_OK) {
    clear(r);
    return gg_cli_report(&r->err);
  }
  r->run = (gg_run_options){.size = sizeof(gg_run_options),
                            .threads = o->threads,
                            .workers = gg_cli_workers(o->threads),
                            .input = o->extend ? NULL : o->input,
                            .picture = r->picture,
                            .picture_width = r->options->width,
                            .output = r->output,
                            .checkpoint = r->keeps_checkpoints ? r->checkpoint : NULL,
                            .resume = o->resume,
                            .accept_version = o->accept_version,
                            .command = o->command_line,
                            .context = r,
                            .progress = show_progress,
                            .stop = gg_cli_interrupted,
                            .stored = note_checkpoint,
                            .warn = warn};
  gg_cli_progress_start(&r->progress, o->quiet);
  gg_cli_catch_interrupts();
  return GG_CLI_GO_ON;
}

static bool has_means(const gg_result *result)
{
  gg_measurement m;
  for (size_t i = 0; gg_result_at(result, i, &m, NULL) == GG_OK; i++)
    if (isfinite(m.mean)) return true;
  return false;
}

static double time_limit(const run_command *r)
{
  char text[40] = "0"; /* also if the limit is "none" */
  gg_scene_get(r->scene, "run.time_limit", text, sizeof text, NULL);
  return strtod(text, NULL);
}

static bool is_out_of_time(const run_command *r, const gg_result *result)
{
  gg_result_info info;
  const double limit = time_limit(r);
  return limit > 0 && result && gg_result_get_info(result, &info, NULL) == GG_OK && info.wall_seconds >= limit;
}

/* Whether there is a result to print; of an interrupted run, whether it has means. Either result may be NULL. */
static bool has_output(run_command *r, const gg_result *md, const gg_result *dsmc)
{
  const bool interrupted = r->status == GG_INTERRUPTED;
  gg_cli_progress_end(&r->progress);
  r->out_of_time = is_out_of_time(r, md) || is_out_of_time(r, dsmc);
  r->has_output = interrupted ? has_means(md) || has_means(dsmc) : md || dsmc;
  if (interrupted && r->has_output && !r->options->json) puts("\ninterrupted: the results so far");
  return r->has_output;
}

/* The command that resumes the run, with twice the time limit if the limit ended it. NULL: out of memory. */
static char *command_to_resume(const run_command *r)
{
  const char *given = r->options->resume;
  const bool named = given && strcmp(given, r->checkpoint) == 0;
  char limit[64] = "";
  GG_CLI_FREED char *file = gg_cli_shell_quote(r->checkpoint), *added = NULL;
  if (r->out_of_time) snprintf(limit, sizeof limit, " --set run.time_limit=%g", 2 * time_limit(r));
  if (file && asprintf(&added, "%s%s%s", named ? "" : " --resume ", named ? "" : file, limit) < 0) added = NULL;
  return added ? gg_cli_command_line_quote(program_invocation_name, &r->options->words, added) : NULL;
}

/* Report each picture: pages of curves are beside the requested one. */
static void report_picture(void *context, const char *picture)
{
  const run_command *r = context;
  gg_cli_report_written(r->options, "picture", picture, r->redrawn && strcmp(picture, r->picture) == 0);
}

/* Draw the picture. If it was not requested, a failure (e.g. no gnuplot) is only a warning, unless a file cannot be
 * written. */
static gg_status draw(run_command *r, gg_error *err)
{
  if (!r->picture) return GG_OK;
  r->redrawn = gg_cli_file_exists(r->picture);
  gg_status status =
      gg_plot(r->output, r->picture, NULL, r->options->width, report_picture, gg_cli_interrupted, r, err);
  if (status != GG_FAILED || r->options->picture) return status;
  fprintf(stderr, "warning: no picture: %s\n", err->message);
  return GG_OK;
}

/* Report the files, draw the picture, report unmet stopping criteria; returns the exit code. */
static int end(run_command *r)
{
  gg_error why;
  gg_status drawn = GG_OK;
  if (r->has_output && r->status != GG_BAD_FILE && r->status != GG_INTERRUPTED) {
    gg_cli_report_written(r->options, "results", r->output, r->replaced);
    drawn = draw(r, &why);
  }
  if (r->status == GG_INTERRUPTED)
    snprintf(r->err.message, sizeof r->err.message, "interrupted; %s%s",
             r->stored ? "a checkpoint is stored" : "nothing was stored",
             r->stored || r->keeps_checkpoints ? "" : " (output.checkpoint_every above 0 keeps a checkpoint)");
  const int code = gg_cli_report_scene(r->options, r->status, &r->err);
  if (drawn != GG_OK) gg_cli_report(&why);
  if (r->stored && (r->status == GG_INTERRUPTED || (r->status == GG_FAILED && r->out_of_time))) {
    GG_CLI_FREED char *again = command_to_resume(r);
    fprintf(stderr, "continue with: %s\n", again ? again : "the same command and --resume");
  }
  clear(r);
  return code != GG_OK ? code : (int)drawn;
}

static void print(const run_command *r, const gg_result *result, const gg_comparison *c)
{
  char *text = NULL;
  const bool all = r->options->all;
  if (!r->options->json)
    r->comparison ? gg_cli_print_comparison(c, all) : gg_cli_print_run(result, r->reported, all);
  else if ((r->comparison ? gg_comparison_to_json(c, &text, NULL) : gg_result_to_json(result, &text, NULL)) == GG_OK)
    gg_cli_print_text(text);
}

int gg_cli_run_main(const gg_options *o)
{
  run_command r;
  gg_result *run = NULL;
  gg_comparison *c = NULL;
  int code = begin(&r, o);
  if (code != GG_CLI_GO_ON) return code;
  r.status = r.comparison ? gg_compare(r.scene, &r.run, &c, &r.err) : gg_run(r.scene, &r.run, &run, &r.err);
  const gg_result *md = r.comparison ? gg_comparison_result(c, "md") : run;
  if (has_output(&r, md, gg_comparison_result(c, "dsmc"))) print(&r, run, c);
  gg_result_free(run);
  gg_comparison_free(c);
  return end(&r);
}
