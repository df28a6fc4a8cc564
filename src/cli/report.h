/* What people read: the tables of run, compare and theory. */
#ifndef GG_CLI_REPORT_H
#define GG_CLI_REPORT_H

#include <jansson.h>

#include "run/run.h"

/* A JSON document on standard output; takes the reference. */
void gg_cli_print_document(json_t *document);

/* On standard output; warnings go to standard error. `all`: every quantity, not just the main ones. */
void gg_print_run(const gg_result *result, bool all);
/* Numbers read off the curves of one result or two; nothing if there are none. */
void gg_print_numbers(const gg_result *one, const gg_result *two, bool all);
void gg_print_comparison(const gg_comparison *comparison, bool all);
void gg_print_theories(const gg_scene *scene, const gg_comparison *theories, bool all);

#endif
