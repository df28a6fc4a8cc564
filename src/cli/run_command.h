/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Shared by the commands on a scene: options, scene and errors; for runs and comparisons also files, progress,
 * interrupts and checkpoints. */
#ifndef GG_CLI_RUN_COMMAND_H
#define GG_CLI_RUN_COMMAND_H

#include "cli/options.h"
#include "cli/progress.h"

/* Report the error of work on the scene unless the status is GG_OK; returns the exit code. */
int gg_cli_report_scene(const gg_options *options, gg_status status, const gg_error *err);

typedef struct gg_cli_run_options {
  const gg_options *options;
  gg_scene *scene;
  gg_run_options run;                  /* ready for gg_run or gg_compare */
  char *output, *checkpoint, *picture; /* picture: NULL if none is drawn */
  bool keeps_checkpoints;              /* output.checkpoint_every is above 0 */
  bool stored;                         /* a checkpoint was written in this run */
  bool out_of_time;                    /* the time limit ended the run */
  bool replaced;                       /* the output replaces an older file */
  char *reported;                      /* warnings printed before the run, a line each; NULL: none */
  gg_cli_progress progress;
  gg_status status; /* status of gg_run or gg_compare; err has its message */
  gg_error err;
  bool has_output;
} gg_cli_run_options;

/* Prepare a run. GG_CLI_GO_ON, or the exit code. */
int gg_cli_run_begin(gg_cli_run_options *r, const gg_options *options);
/* After the run: whether there is a result to print; of an interrupted run, whether it has means. Either may be NULL.
 */
bool gg_cli_run_has_output(gg_cli_run_options *r, const gg_result *md, const gg_result *dsmc);
/* Report the files, draw the picture, report unmet stopping criteria; returns the exit code. */
int gg_cli_run_end(gg_cli_run_options *r);

#endif
