/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Shared by sweep and validate: reading a sweep, listing and running its points. */
#ifndef GG_SWEEP_COMMAND_H
#define GG_SWEEP_COMMAND_H

#include "cli/options.h"
#include "cli/progress.h"

typedef struct gg_cli_sweep_options {
  const gg_options *options;
  gg_sweep *sweep; /* checked */
  char *folder;
  gg_cli_line line;
  bool over;   /* the final progress was shown */
  bool tables; /* tables of the points follow */
} gg_cli_sweep_options;

/* Read the input, or without one the YAML `text` called `name`; apply --vary and overrides, and check it. */
gg_status gg_cli_sweep_read(const gg_options *options, const char *text, const char *name, gg_sweep **sweep,
                            gg_error *err);
/* Set the results folder: --output, by default the input's name, without an input `name`. */
gg_status gg_cli_sweep_find_folder(gg_cli_sweep_options *command, const char *name, gg_error *err);
int gg_cli_sweep_list(const gg_cli_sweep_options *command);
/* Run the missing points, or that of --point. Prints errors and returns the exit code. */
int gg_cli_sweep_work(gg_cli_sweep_options *command);
/* Write the tables PREFIX.csv and PREFIX.h5, and a picture unless `picture` is "none". */
int gg_cli_sweep_collect(gg_cli_sweep_options *command, const char *picture);

/* Callbacks whose context is the command. */
void gg_cli_sweep_warn(void *context, const char *message);
void gg_cli_sweep_print_file(void *context, const char *file);

#endif
