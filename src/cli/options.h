/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The options of every subcommand, from one table: parsing, --help and the manual page. */
#ifndef GG_CLI_OPTIONS_H
#define GG_CLI_OPTIONS_H

#include "cli/cli.h"

enum {
  GG_OPT_SET = 1u << 0,
  GG_OPT_OUTPUT = 1u << 1,
  GG_OPT_JSON = 1u << 2,
  GG_OPT_SEED = 1u << 3,
  GG_OPT_THREADS = 1u << 4,
  GG_OPT_QUIET = 1u << 5,
  GG_OPT_RESUME = 1u << 6,
  GG_OPT_ENGINE = 1u << 7,
  GG_OPT_ALL = 1u << 8,
  GG_OPT_FORMAT = 1u << 9,
  GG_OPT_PICTURE = 1u << 10,
  GG_OPT_QUICK = 1u << 11,
  GG_OPT_PREFIX = 1u << 12,
  GG_OPT_ONLY = 1u << 13,
  GG_OPT_SWEEP = 1u << 14, /* all that only sweeps have */
  GG_OPT_PAGE = 1u << 15,
  GG_OPT_COLLISIONS = 1u << 16,
  GG_OPT_ACCEPT = 1u << 17,
  GG_OPT_THEORY = 1u << 18,
  GG_OPT_VALIDATE = 1u << 19, /* all that only validate has */
  GG_OPT_LIMIT = 1u << 20,
  GG_OPT_SCHEMA = 1u << 22,
  GG_OPT_MORE = 1u << 21, /* no option: GG_MORE_INPUTS arguments may follow the first */
};

typedef struct gg_option {
  unsigned flag;
  const char *name, *argument, *doc; /* argument: NULL if it takes none */
} gg_option;
extern const gg_option gg_cli_options_table[]; /* ends with flag 0 */

/* The command line as it was given, to be recorded, and to be given again with something else in it. */
typedef struct gg_command_line {
  int n;
  char **word;     /* the subcommand first; borrowed from main; NULL: one that is not to be typed again */
  int options_end; /* the word "--"; n where there is none */
} gg_command_line;

enum { GG_MAX_OVERRIDES = 64, GG_MORE_INPUTS = 2 };

typedef struct gg_options {
  const char *input; /* the one argument: a scene or a result; NULL where it may be left out ([...]) and was */
  const char *more[GG_MORE_INPUTS]; /* those that follow, of commands that have them */
  const char *surplus;              /* one too many */
  const char *output, *resume, *format, *picture, *width, *only;
  const char *does;              /* what a sweep does at its points; NULL: what its file says */
  const char *over, *show;       /* of the picture of a sweep: key along x, quantities; NULL: chosen */
  char *theories;                /* with commas, owned; NULL: all */
  const char *log, *relative_to; /* axes of that picture, and the method that it has deviations from */
  const char *mapped;            /* theories in maps and in that picture; NULL: chosen */
  const char *page;              /* validate: to be written; NULL: none. page: to be copied; NULL: the installed one */
  const char *point;             /* the one of a sweep to do; NULL: all */
  bool json, quiet, all, quick, accept_version, schema;
  bool list, collect, slurm; /* what else to do with a sweep */
  uint64_t collisions;       /* 0: not said */
  int threads;
  double limit; /* in per cent; negative: none */
  int n_overrides;
  const char *override[GG_MAX_OVERRIDES]; /* "key=value" */
  char *owned[GG_MAX_OVERRIDES];          /* those that options stand for; else NULL */
  int n_vary;
  const char *vary[GG_MAX_OVERRIDES]; /* "key=values" */
  char *command_line;                 /* for the record */
  gg_command_line words;
} gg_options;

enum { GG_CLI_GO_ON = -1 };
/* GG_CLI_GO_ON, or the exit code to leave with (--help printed, or a mistake reported). */
int gg_cli_options_parse(const gg_command *command, int argc, char **argv, gg_options *options);
void gg_cli_options_clear(gg_options *options);

/* The input as messages name it. */
const char *gg_cli_options_name(const gg_options *options);

/* The scene of the input, overridden; to be freed. */
gg_status gg_cli_options_scene(const gg_options *options, gg_scene **scene, gg_error *err);

/* Set what was typed after --OPTION, KEY=VALUE; `example` is one. */
typedef gg_status gg_options_setter(void *target, const char *key, const char *value, gg_error *err);
gg_status gg_cli_options_set(const char *option, const char *typed, const char *example, gg_options_setter *set,
                             void *target, gg_error *err);

/* completion.c: for bash, zsh or fish; the exit code. */
int gg_cli_print_completion(const char *shell);
void gg_cli_command_print_help(const gg_command *command);

#endif
