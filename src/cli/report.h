/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The printed reports of run, compare and theory. */
#ifndef GG_CLI_REPORT_H
#define GG_CLI_REPORT_H

#include <graingas.h>
#include <stdbool.h>

/* Print a report on standard output, and warnings on standard error, except those in `reported` (a line each; may be
 * NULL). `all`: every quantity, not only the main ones. */
void gg_cli_print_run(const gg_result *result, const char *reported, bool all);
void gg_cli_print_comparison(const gg_comparison *comparison, bool all);
void gg_cli_print_theories(const gg_comparison *theories, bool all);

/* report.c, shared: title; effort and steadiness of an engine, then its warnings. */
void gg_cli_print_head(const gg_scene *scene);
bool gg_cli_is_followed(const gg_scene *scene);         /* whether the scene has run.duration */
const char *gg_cli_steadiness(const gg_result *result); /* printed before the verdict; "" for transient runs */
void gg_cli_print_effort(const gg_result *result);
void gg_cli_print_warnings(const gg_result *result, const char *reported);
/* report_curves.c: the answer of a theory in a table, beside a simulation with its deviation (NaN: none). */
void gg_cli_format_answer(double value, double deviation, bool beside, char *cell);
/* Numbers derived from the curves of a run, or of engines and theories; profiles of the latter. */
void gg_cli_print_curves(const gg_result *run, const gg_comparison *comparison, bool all);

#endif
