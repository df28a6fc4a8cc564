/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Stored result made from a JSON document alone, as the reader of result files makes it. */
#ifndef GG_FUZZ_STORED_H
#define GG_FUZZ_STORED_H

#include <stdint.h>

#include "files/h5/result_reader.h"

/* Fill the result: the first byte selects its scene, the others are the text of its document. Returns false if that is
 * not JSON; call gg_files_stored_result_clear in either case. */
bool fuzz_stored(gg_stored_result *stored, const uint8_t *data, size_t size);

#endif
