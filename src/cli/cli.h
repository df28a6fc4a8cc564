/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The graingas command, a program on graingas.h. Each subcommand is a row of commands.c, and returns its exit code.
 * Only `bench` uses more of the library, and main() prepares the process (files/process.h). */
#ifndef GG_CLI_H
#define GG_CLI_H

#include <graingas.h>
#include <stdbool.h>

#define GG_CLI_PRINTF(fmt, args) __attribute__((format(printf, fmt, args)))

/* Declaration: a pointer from malloc (at first NULL) is freed at the end of its block. */
#define GG_CLI_FREED __attribute__((cleanup(gg_cli_freed)))
void gg_cli_freed(void *place);

struct gg_options;
/* The work of a subcommand; returns the exit code. main() parses its options before and frees them afterwards. */
typedef int gg_command_main(const struct gg_options *options);

typedef struct gg_command {
  const char *name;
  const char *arguments; /* "SCENE.yaml"; with a blank: up to GG_MORE_INPUTS further ones */
  const char *summary;   /* one line */
  const char *help;      /* paragraphs for --help; NULL: none */
  gg_command_main *run;
} gg_command;

extern const gg_command gg_cli_commands[]; /* ends with a NULL name */
/* Spelling suggestion: a command, --help or --version; NULL if none is near. */
const char *gg_cli_nearest_command(const char *word);

gg_command_main gg_cli_run_main, gg_cli_theory_main, gg_cli_sweep_main, gg_cli_validate_main, gg_cli_plot_main,
    gg_cli_export_main, gg_cli_info_main, gg_cli_cite_main, gg_cli_fingerprint_main, gg_cli_init_main, gg_cli_page_main,
    gg_cli_bench_main;

/* print.c: print "graingas: MESSAGE" on standard error; returns the exit code of the error. */
int gg_cli_report(const gg_error *err);
/* gg_cli_report with "PREFIX: " before the message. */
int gg_cli_report_of(const char *prefix, const gg_error *err);
/* gg_cli_report for a message from a format. */
int gg_cli_fail(gg_status status, const char *format, ...) GG_CLI_PRINTF(2, 3);

/* Set a message of the command line, to be printed later; returns `status`. */
gg_status gg_cli_refuse(gg_error *err, gg_status status, const char *format, ...) GG_CLI_PRINTF(3, 4);

/* Append to a text in a buffer of `size` bytes, cut to it. */
void gg_cli_append(char *text, size_t size, const char *format, ...) GG_CLI_PRINTF(3, 4);
/* Whether a word is among those of a text, separated by blanks. */
bool gg_cli_has_word(const char *words, const char *word);
/* Whether a text ends like this, after something else. */
bool gg_cli_has_ending(const char *text, const char *ending);

/* Warn on standard error about an unusual result file (gg_result_file_notice). */
void gg_cli_print_notice(const char *result_file);

/* Print a text from the library on standard output and free it. */
void gg_cli_print_text(char *text);

/* The tables of commands, options, scene keys, quantities and theories, as JSON. */
void gg_cli_print_tables(void);
/* Observables that each flow, engine and kind of grains cannot have, with the reasons. */
struct json_t *gg_cli_support(void);

#endif
