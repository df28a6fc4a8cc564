/* Quantities and theories that the program which wrote a file had brought (graingas.h, "Extension"): their names and
 * units, so that what was stored of them is found again. The callbacks stayed with that program. */
#ifndef GG_STORED_EXTENSION_H
#define GG_STORED_EXTENSION_H

#include <jansson.h>

#include "common/extension.h"

/* Of the `results` of an engine's document that are no shared quantities, and the `theories` (NULL: none) of a
 * comparison's that are no shared theories. *extension is NULL if there is nothing; else to be released. */
gg_status gg_files_stored_extension(const json_t *results, const json_t *theories, gg_extension **extension,
                                    gg_error *err);

#endif
