/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The graingas command, a program on graingas.h. Each subcommand is a file and a row of commands.c, and returns its
 * exit code. Only `bench` uses more of the library, and main() prepares the process (files/process.h). */
#ifndef GG_CLI_H
#define GG_CLI_H

#include <graingas.h>
#include <stdbool.h>

#define GG_CLI_PRINTF(fmt, args) __attribute__((format(printf, fmt, args)))

struct gg_options;
/* The work of a subcommand; returns the exit code. main() parses its options before and frees them afterwards. */
typedef int gg_command_main(const struct gg_options *options);

typedef struct gg_command {
  const char *name;
  const char *arguments; /* "SCENE.yaml" */
  const char *summary;   /* one line */
  const char *help;      /* paragraphs for --help; NULL: none */
  unsigned options;      /* sum of the GG_OPT_... that the command takes */
  gg_command_main *run;
} gg_command;

extern const gg_command gg_cli_commands[]; /* ends with a NULL name */
/* Spelling suggestion: a command, --help or --version; NULL if none is near. */
const char *gg_cli_nearest_command(const char *word);

gg_command_main gg_cli_compare_main, gg_cli_run_main, gg_cli_theory_main, gg_cli_sweep_main, gg_cli_validate_main,
    gg_cli_plot_main, gg_cli_export_main, gg_cli_info_main, gg_cli_cite_main, gg_cli_fingerprint_main, gg_cli_init_main,
    gg_cli_page_main, gg_cli_bench_main;

/* print.c: print "graingas: MESSAGE" on standard error; returns the exit code of the error. */
int gg_cli_report(const gg_error *err);
/* gg_cli_report with "PREFIX: " before the message. */
int gg_cli_report_of(const char *prefix, const gg_error *err);
/* gg_cli_report for a message from a format. */
int gg_cli_fail(gg_status status, const char *format, ...) GG_CLI_PRINTF(2, 3);

/* Set a message of the command line, to be printed later; returns `status`. */
gg_status gg_cli_refuse(gg_error *err, gg_status status, const char *format, ...) GG_CLI_PRINTF(3, 4);

/* Warn on standard error about an unusual result file (gg_result_file_notice). */
void gg_cli_print_notice(const char *result_file);

/* Print a text from the library on standard output and free it. */
void gg_cli_print_text(char *text);

/* The tables of commands, options, scene keys, quantities and theories, as JSON. */
void gg_cli_print_tables(void);
/* Observables that each flow, engine and kind of grains cannot have, with the reasons. */
struct json_t *gg_cli_support(void);

#endif
