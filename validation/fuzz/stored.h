/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The JSON document of a result as a result file's reader leaves it, without the file. */
#ifndef GG_FUZZ_STORED_H
#define GG_FUZZ_STORED_H

#include <stdint.h>

#include "files/h5/result_reader.h"

/* The first byte chooses the scene beside it, the rest is its text. False: it is no JSON; to be cleared all the same
 * (gg_files_stored_result_clear). */
bool fuzz_stored(gg_stored_result *stored, const uint8_t *data, size_t size);

#endif
