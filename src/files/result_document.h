/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The JSON documents of `run`, `compare` and `theory`. A number that cannot be had is null, with the reason among the
 * warnings. The caller owns every returned reference; NULL only if out of memory. */
#ifndef GG_DOCUMENT_H
#define GG_DOCUMENT_H

#include <jansson.h>

#include "run/run.h"

json_t *gg_files_run_document(const gg_result *result);
json_t *gg_files_comparison_document(const gg_comparison *comparison);
json_t *gg_files_theory_document(const gg_scene *scene, const gg_comparison *theories);

/* Indented text, 17 digits; to be freed. */
char *gg_files_document_text(const json_t *document);

/* A stored document, which may be anybody's. Names in it are as when they were registered, so that files can be named
 * by them, and texts are printable. NULL with the reason in *why. */
json_t *gg_files_document_read(const char *text, const char **why);

/* True if the quantity has a mean, or a reason why it has none. */
bool gg_files_quantity_is_measured(const gg_estimate *estimate);

#endif
