/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Validation of a grid of comparisons: verdict, maps and page of the results in its folder. */
#ifndef GG_SWEEP_VALIDATION_H
#define GG_SWEEP_VALIDATION_H

#include "sweep/sweep_table.h"

typedef struct gg_validate_options gg_validate_options; /* of the public header */

/* Verdict as Markdown in *text, to be freed, also with GG_FAILED where dsmc and the noise-free solution disagree, and
 * where no value of dsmc has a noise-free solution beside it. */
gg_status gg_sweep_validate_table(const gg_point_table *table, const gg_sweep *sweep,
                                  const gg_validate_options *options, void (*written)(void *context, const char *file),
                                  void *context, const gg_stop *stop, char **text, gg_error *err);

/* The grids of `graingas validate` without a file: validation/grid/grid.yaml and grid_quick.yaml. */
extern const char gg_sweep_standard_grid[], gg_sweep_quick_grid[];

#endif
