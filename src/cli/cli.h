/* The graingas command: one file a subcommand, a line in the table of commands.c each. A subcommand returns its exit
 * code. */
#ifndef GG_CLI_H
#define GG_CLI_H

#include "common/error.h"

typedef struct gg_command {
  const char *name;
  const char *arguments; /* "SCENE.yaml" */
  const char *summary;   /* one line */
  const char *help;      /* paragraphs for --help; NULL: none */
  unsigned options;      /* GG_OPT_... that it takes */
  int (*run)(const struct gg_command *command, int argc, char **argv);
} gg_command;

extern const gg_command gg_commands[]; /* ends with a NULL name */

int gg_cli_compare_main(const gg_command *command, int argc, char **argv);
int gg_cli_run_main(const gg_command *command, int argc, char **argv);
int gg_cli_theory_main(const gg_command *command, int argc, char **argv);
int gg_cli_plot_main(const gg_command *command, int argc, char **argv);
int gg_cli_info_main(const gg_command *command, int argc, char **argv);
int gg_cli_bench_main(const gg_command *command, int argc, char **argv);

/* "graingas: MESSAGE" on standard error; returns the exit code that goes with the error. */
int gg_cli_report(const gg_error *err);
/* The same for a message of the command line's own. */
int gg_cli_fail(gg_status status, const char *format, ...) GG_PRINTF(2, 3);

/* The manual page, from the tables of commands, options, scene keys and quantities. */
void gg_cli_print_manual(void);
/* The page of scene keys, docs/scene.md. */
void gg_cli_print_scene_page(void);

#endif
