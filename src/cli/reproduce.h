/* The parts of graingas reproduce. */
#ifndef GG_CLI_REPRODUCE_H
#define GG_CLI_REPRODUCE_H

#include "cli/options.h"

/* reproduce_list.c: all figures, as a table or as JSON; returns the exit code. */
int gg_cli_list_figures(const gg_options *options);

#endif
