/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The options of every subcommand, from one table: parsing, --help and the manual page. */
#ifndef GG_CLI_OPTIONS_H
#define GG_CLI_OPTIONS_H

#include "cli/cli.h"

typedef struct gg_option {
  const char *commands;        /* those that take it, separated by blanks; NULL: all */
  const char *name, *argument; /* argument: NULL if it takes none */
  size_t at;                   /* place of its text or truth in gg_options; beyond: options.c converts its value */
  const char *doc;
} gg_option;
extern const gg_option gg_cli_options_table[]; /* ends with a NULL name */
bool gg_cli_option_is_of(const gg_option *option, const gg_command *command);

/* The command line as given, for the record and to print it with additions. */
typedef struct gg_command_line {
  int n;
  char **word;     /* the subcommand first; borrowed from main; NULL: not to be printed */
  int options_end; /* index of the word "--"; n without it */
} gg_command_line;

enum { GG_MAX_OVERRIDES = 64, GG_MORE_INPUTS = 2 };

typedef struct gg_options {
  const gg_command *command;
  const char *input;                /* the argument: a scene or a result; NULL if optional and missing */
  const char *more[GG_MORE_INPUTS]; /* further arguments */
  const char *surplus;              /* first argument too many; NULL: none */
  const char *output, *resume, *extend, *format, *picture, *width, *only;
  const char *does;              /* command of a sweep's points; NULL: as in its file */
  const char *over, *show;       /* picture of a sweep: key along x, quantities; NULL: automatic */
  char *theories;                /* separated by commas, owned; NULL: all */
  const char *log, *relative_to; /* logarithmic axes of the picture; method that deviations are relative to */
  const char *mapped;            /* theories in maps and in the picture of a sweep; NULL: automatic */
  const char *page;              /* validate: page to write; NULL: none. page: page to copy; NULL: the installed one */
  const char *point;             /* point of a sweep to run; NULL: all */
  bool json, quiet, all, quick, accept_version, schema;
  bool list, collect, slurm; /* other actions of sweep */
  uint64_t collisions;       /* 0: not given */
  int threads;
  double limit; /* in per cent; negative: none */
  int n_overrides;
  const char *override[GG_MAX_OVERRIDES]; /* "key=value" */
  char *owned[GG_MAX_OVERRIDES];          /* overrides that other options stand for, owned; otherwise NULL */
  int n_vary;
  const char *vary[GG_MAX_OVERRIDES]; /* "key=values" */
  char *state;                        /* the checkpoint of `extend`, owned; otherwise NULL */
  char *command_line;                 /* for the record */
  gg_command_line words;
} gg_options;

enum { GG_CLI_GO_ON = -1 };
/* Parse the options. GG_CLI_GO_ON, or the exit code after --help or an error. */
int gg_cli_options_parse(const gg_command *command, int argc, char **argv, gg_options *options);
void gg_cli_options_clear(gg_options *options);

const char *gg_cli_options_name(const gg_options *options);

/* Read the scene of the input and apply the overrides; NULL on failure. */
gg_status gg_cli_options_scene(const gg_options *options, gg_scene **scene, gg_error *err);
/* Report the error of work on the scene unless the status is GG_OK; returns the exit code. */
int gg_cli_report_scene(const gg_options *options, gg_status status, const gg_error *err);

/* Apply --vary and the overrides to a sweep, or the overrides to a scene (sweep: NULL). */
gg_status gg_cli_options_apply(const gg_options *options, gg_scene *scene, gg_sweep *sweep, gg_error *err);

/* Scripts for the completion of shells, made by scripts/shell-completion of the tables that this program prints. */
extern const char gg_cli_completion_bash[], gg_cli_completion_zsh[], gg_cli_completion_fish[];

void gg_cli_command_print_help(const gg_command *command);

#endif
