/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What `sweep` and `validate` share: a sweep is read, its points are listed and run. */
#ifndef GG_SWEEP_COMMAND_H
#define GG_SWEEP_COMMAND_H

#include "cli/options.h"
#include "cli/progress.h"

typedef struct gg_sweep_command {
  const gg_options *options;
  gg_sweep *sweep; /* checked */
  char *folder;
  gg_cli_line line;
  bool over;   /* the last line was shown */
  bool tables; /* the command then makes tables of the points */
} gg_sweep_command;

/* The input, or without one the YAML `text` that is called `name`; varied, overridden and checked. */
gg_status gg_cli_sweep_read(const gg_options *options, const char *text, const char *name, gg_sweep **sweep,
                            gg_error *err);
/* The results folder: --output, or by the input's name, or `name` without an input. */
gg_status gg_cli_sweep_find_folder(gg_sweep_command *command, const char *name, gg_error *err);
int gg_cli_sweep_list(const gg_sweep_command *command);
/* Run what is missing, or the one of --point; an exit code, whose message was printed. */
int gg_cli_sweep_work(gg_sweep_command *command);
/* The tables PREFIX.csv and PREFIX.h5, and a picture unless that is "none". */
int gg_cli_sweep_collect(gg_sweep_command *command, const char *picture);

/* Callbacks whose context is the command. */
void gg_cli_sweep_warn(void *context, const char *message);
void gg_cli_sweep_print_file(void *context, const char *file);

#endif
