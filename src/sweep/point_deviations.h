/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Deviations of the rows of a point from their reference: Enskog's noise-free solution, else dsmc. */
#ifndef GG_POINT_DEVIATIONS_H
#define GG_POINT_DEVIATIONS_H

#include "sweep/sweep_table.h"

/* Deviations of the rows from `first` on; `scene` is the YAML beside the document. NaN and NULL without a reference. */
gg_status gg_sweep_point_deviations(gg_point_table *table, size_t first, json_t *document, char *scene, gg_error *err);

#endif
