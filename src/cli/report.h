/* What people read: the tables of run, compare and theory. */
#ifndef GG_CLI_REPORT_H
#define GG_CLI_REPORT_H

#include <graingas.h>
#include <stdbool.h>

/* On standard output; warnings go to standard error. `all`: every quantity, not just the main ones. */
void gg_cli_print_run(const gg_result *result, const char *told, bool all); /* `told`: as below */
void gg_cli_print_comparison(const gg_comparison *comparison, bool all);
void gg_cli_print_theories(const gg_comparison *theories, bool all);

/* Parts of them. */
void gg_cli_print_head(const gg_scene *scene);
void gg_cli_print_effort(const gg_result *result);
void gg_cli_print_warnings(const gg_result *result,
                           const char *told); /* but for what was told already; NULL: nothing */
/* Numbers read off the curves of one result or two; nothing if there are none. */
void gg_cli_print_numbers(const gg_result *one, const gg_result *two, bool all);

/* Each engine against Enskog's equation solved without random numbers; nothing where there is no solution. */
void gg_cli_print_verdicts(const gg_comparison *comparison);

/* A quantity that is left to --all: parts and components that few look at first. */
bool gg_cli_quantity_is_minor(const char *name);

#endif
