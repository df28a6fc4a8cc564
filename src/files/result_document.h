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

/* Of the writers of these: null for what is not finite; the warnings that begin a document's list. */
json_t *gg_files_json_number(double x);
json_t *gg_files_warnings_json(const gg_text_list *texts);

/* Is there anything to say about this quantity: a mean, or a reason why there is none? */
bool gg_files_quantity_is_measured(const gg_estimate *estimate);

/* Add "who: quantity is null: reason" to the warnings; quantities with the same reason share a line. */
void gg_files_reason_add(json_t *warnings, const char *who, const char *quantity, const char *reason);

#endif
