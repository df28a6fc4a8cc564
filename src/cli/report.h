/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What people read: the tables of run, compare and theory. */
#ifndef GG_CLI_REPORT_H
#define GG_CLI_REPORT_H

#include <graingas.h>
#include <stdbool.h>

/* On standard output; warnings go to standard error, but for those `reported` already, a line each (NULL: none).
 * `all`: every quantity, not just the main ones. */
void gg_cli_print_run(const gg_result *result, const char *reported, bool all);
void gg_cli_print_comparison(const gg_comparison *comparison, bool all);
void gg_cli_print_theories(const gg_comparison *theories, bool all);

/* report.c, for both: title; effort and steadiness of an engine, then its warnings; numbers derived from the curves of
 * one result or two, nothing if there are none. */
void gg_cli_print_head(const gg_scene *scene);
bool gg_cli_is_followed(const gg_scene *scene);         /* has it run.duration? */
const char *gg_cli_steadiness(const gg_result *result); /* before the verdict; "" of a gas that is followed in time */
void gg_cli_print_effort(const gg_result *result);
void gg_cli_print_warnings(const gg_result *result, const char *reported);
void gg_cli_print_numbers(const gg_result *one, const gg_result *two, bool all);
/* report_profiles.c: those across the gap that both results have; nothing if there are none. */
void gg_cli_print_profiles(const gg_result *md, const gg_result *dsmc, bool all);

#endif
