/* What run and compare have in common: options, scene, checkpoint to go on from, output. */
#ifndef GG_CLI_SIMULATE_H
#define GG_CLI_SIMULATE_H

#include "cli/options.h"
#include "common/archive.h"

/* Simulate the scene into `output`; resume: NULL, or where to go on from. Returns the exit code. */
typedef int gg_simulate(const gg_options *options, const gg_scene *scene, const char *output, const gg_archive *resume);

/* The whole of a simulating subcommand around its `simulate`. */
int gg_simulate_main(const gg_command *command, int argc, char **argv, gg_simulate *simulate);

#endif
