/* The points of a sweep as a JSON document. */
#ifndef GG_SWEEP_DOCUMENT_H
#define GG_SWEEP_DOCUMENT_H

#include <jansson.h>

#include "sweep/sweep.h"

/* The value that a varied key has at a point, as a number where it is one, else as its YAML. A new reference. */
json_t *gg_sweep_point_value(const gg_sweep *sweep, size_t i, size_t varied, size_t k);
/* The sweep was checked. A new reference; NULL: out of memory. */
json_t *gg_sweep_document(const gg_sweep *sweep, const char *folder);

#endif
