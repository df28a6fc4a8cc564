/* What run and compare have in common: options, scene, output, progress, checkpoints, and how a run ends. */
#ifndef GG_CLI_SIMULATE_H
#define GG_CLI_SIMULATE_H

#include "cli/options.h"
#include "cli/progress.h"

typedef struct gg_simulating {
  const gg_options *options;
  gg_scene *scene;
  char *output, *checkpoint, *picture; /* picture: NULL if none is drawn */
  bool draws;                          /* the command draws pictures */
  bool keeps_checkpoints;              /* the scene asks for them */
  bool stored;                         /* at least one in this run */
  bool replaced;                       /* the output takes the place of an older file */
  char *told;                          /* warnings given before the run, a line each; NULL: none */
  gg_cli_progress progress;
  gg_run_options run; /* ready for gg_run or gg_compare */
} gg_simulating;

/* Run, print, and tell what was written; returns the exit code. */
typedef int gg_simulate(gg_simulating *simulating);

/* The whole of a simulating subcommand around its `simulate`. */
int gg_cli_simulate_main(const gg_command *command, int argc, char **argv, gg_simulate *simulate);

/* After the run: is there a result to show? Of an interrupted one, if anything was averaged; either may be NULL. */
bool gg_cli_simulation_has_output(gg_simulating *simulating, gg_status status, const gg_result *one,
                                  const gg_result *other);
/* After it was shown: tell where it was written. False if it was not. */
bool gg_cli_simulation_report(const gg_simulating *simulating, gg_status status);
/* Report what the run fell short of; returns the exit code. */
int gg_cli_simulation_finish(const gg_simulating *simulating, gg_status status, gg_error *err);

#endif
