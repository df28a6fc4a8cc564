/* Result files as tables and trajectories that other programs read. */
#ifndef GG_EXPORT_H
#define GG_EXPORT_H

#include "files/h5/result_reader.h"

/* The files that the result of this path comes to, all of them or none: PREFIX.csv, one of each curve,
 * PREFIX_numbers.csv and PREFIX.xyz; `parts` (GG_EXPORT_...) says which. GG_FAILED if the result has nothing of what
 * was asked for. `written` (may be NULL) is called with the name of each. */
gg_status gg_export_result(const gg_stored_result *stored, const char *path, const char *prefix, unsigned parts,
                           void (*written)(void *context, const char *file), void *context, gg_error *err);

#endif
