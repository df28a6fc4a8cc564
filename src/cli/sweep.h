/* The parts of graingas sweep. */
#ifndef GG_CLI_SWEEP_H
#define GG_CLI_SWEEP_H

#include "cli/options.h"

typedef struct gg_sweep_command {
  const gg_options *options;
  gg_sweep *sweep; /* checked */
  char *folder;
} gg_sweep_command;

/* sweep_list.c: the points as a table; returns the exit code. */
int gg_sweep_list(const gg_sweep_command *command);

#endif
