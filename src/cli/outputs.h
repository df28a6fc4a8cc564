/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Names of output files, existing files, reports of written files. */
#ifndef GG_CLI_OUTPUTS_H
#define GG_CLI_OUTPUTS_H

#include "cli/options.h"

/* --output, or by default the input's base name with `suffix`, in the current folder; to be freed. NULL with the
 * message if that is the input. */
char *gg_cli_options_output(const gg_options *options, const char *suffix, gg_error *err);
/* The input's base name with `suffix`, in the current folder; to be freed. */
char *gg_cli_options_beside(const gg_options *options, const char *suffix);
/* Print "results: usf.h5", and whether an older file was replaced. */
void gg_cli_report_written(const gg_options *options, const char *what, const char *path, bool replaced);
bool gg_cli_file_exists(const char *path);
bool gg_cli_file_is_same(const char *a, const char *b);
/* Whether the path is a device or a pipe: no file is made there, or beside it. */
bool gg_cli_file_is_device(const char *path);
/* usf.h5 -> usf.checkpoint.h5; to be freed. */
char *gg_cli_path_of_checkpoint(const char *output);
/* `path` with this suffix in place of its ending, if it has one; to be freed. */
char *gg_cli_path_with_suffix(const char *path, const char *suffix);

/* The command line, shell-quoted, with `added` (already quoted; "": none) after the options. `program`: "graingas" for
 * the record, program_invocation_name to print a command that works. To be freed; NULL: out of memory. */
char *gg_cli_command_line_quote(const char *program, const gg_command_line *line, const char *added);
/* An argument, shell-quoted; to be freed. */
char *gg_cli_shell_quote(const char *text);

#endif
