/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the commands on a scene have in common: options and scene at the beginning, errors at the end; and around a run
 * or a comparison its files, progress, interruption and checkpoints. */
#ifndef GG_CLI_RUN_COMMAND_H
#define GG_CLI_RUN_COMMAND_H

#include "cli/options.h"
#include "cli/progress.h"

/* Options and scene: GG_CLI_GO_ON, or the exit code with which to leave at once. */
int gg_cli_scene_begin(const gg_command *command, int argc, char **argv, gg_options *options, gg_scene **scene);
/* Report the error unless the status is GG_OK, and free both; returns the exit code. */
int gg_cli_scene_end(gg_options *options, gg_scene *scene, gg_status status, const gg_error *err);

typedef struct gg_run_command {
  gg_options options;
  gg_scene *scene;
  gg_run_options run;                  /* ready for gg_run or gg_compare */
  char *output, *checkpoint, *picture; /* picture: NULL if none is drawn */
  bool keeps_checkpoints;              /* the scene asks for them */
  bool stored;                         /* at least one in this run */
  bool out_of_time;                    /* its time limit ended it */
  bool replaced;                       /* the output takes the place of an older file */
  char *reported;                      /* warnings given before the run, a line each; NULL: none */
  gg_cli_progress progress;
  gg_status status; /* of gg_run or gg_compare, and its message */
  gg_error err;
  bool has_output;
} gg_run_command;

/* GG_CLI_GO_ON, or the exit code with which to leave at once. */
int gg_cli_run_begin(gg_run_command *r, const gg_command *command, int argc, char **argv);
/* After the run: is there a result to print? Of an interrupted one, if anything was averaged; either may be NULL. */
bool gg_cli_run_has_output(gg_run_command *r, const gg_result *md, const gg_result *dsmc);
/* Say what was written, draw the picture, report what the run fell short of; returns the exit code. */
int gg_cli_run_end(gg_run_command *r);

#endif
