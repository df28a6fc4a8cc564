/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Where outputs go: names of files, what is there already, and telling of what was written. */
#ifndef GG_CLI_OUTPUTS_H
#define GG_CLI_OUTPUTS_H

#include "cli/options.h"

/* --output, or the input's base name with `suffix` in the current folder; to be freed. NULL with the message when that
 * is the input itself. */
char *gg_cli_options_output(const gg_options *options, const char *suffix, gg_error *err);
/* The input's base name with that ending, in the current folder; to be freed. */
char *gg_cli_options_beside(const gg_options *options, const char *suffix);
/* "results: usf.h5", and whether an older one was there. */
void gg_cli_report_written(const gg_options *options, const char *what, const char *path, bool replaced);
bool gg_cli_file_exists(const char *path);
/* Both are there, under whatever names. */
bool gg_cli_file_is_same(const char *a, const char *b);
/* A device or a pipe: no file results, and none beside it. */
bool gg_cli_file_is_device(const char *path);
/* `path` with another ending, or with one where it had none; to be freed. */
char *gg_cli_path_with_suffix(const char *path, const char *suffix);

/* As a shell reads it back: the program and all words, with `added`, which is quoted already ("": none), where options
 * end. The program: "graingas" for the record, program_invocation_name to be typed again. To be freed; NULL: out of
 * memory. */
char *gg_cli_command_line_quote(const char *program, const gg_command_line *line, const char *added);
/* One argument as a shell reads it back; to be freed. */
char *gg_cli_shell_quote(const char *text);

#endif
