/* The parts of graingas sweep. */
#ifndef GG_CLI_SWEEP_H
#define GG_CLI_SWEEP_H

#include "cli/options.h"
#include "cli/progress.h"

typedef struct gg_sweep_command {
  const gg_options *options;
  gg_sweep *sweep; /* checked */
  char *folder;
  gg_cli_line line;
  bool over; /* the last line was shown */
} gg_sweep_command;

/* sweep_list.c: the points as a table; returns the exit code. */
int gg_cli_sweep_list(const gg_sweep_command *command);
/* sweep_slurm.c: the array script. */
int gg_cli_sweep_print_slurm(const gg_sweep_command *command);
/* sweep_progress.c: for gg_sweep_options.progress, with the command as its context. */
void gg_cli_sweep_show_progress(void *command, const gg_sweep_progress *progress);

#endif
