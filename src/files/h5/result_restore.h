/* SPDX-License-Identifier: GPL-3.0-or-later */
/* From a result file that was read to the result that it was written from: means, history, curves, the last frame.
 * Members that the file does not hold (counts of events) are zero. */
#ifndef GG_RESULT_RESTORE_H
#define GG_RESULT_RESTORE_H

#include <jansson.h>

#include "common/extension.h"
#include "files/h5/result_reader.h"

gg_status gg_files_stored_scene(const gg_stored_result *stored, gg_engine_kind engine, gg_scene *scene, gg_model *model,
                                gg_error *err);
/* One engine's part; the caller frees it with gg_result_free. */
gg_status gg_files_result_restore(const gg_stored_result *stored, gg_engine_kind engine, gg_result **result,
                                  gg_error *err);
/* The whole: of a run, a comparison of one. To be cleared also after a failure. */
gg_status gg_files_comparison_restore(const gg_stored_result *stored, gg_comparison *comparison, gg_error *err);

/* Quantities and theories that the program which wrote a file had brought (graingas.h, "Extension"): their names and
 * units, so that what was stored of them is found again. The callbacks stayed with that program. */

#endif
