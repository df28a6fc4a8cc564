/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Positions to start a run from: start.positions of a scene. */
#ifndef GG_POSITIONS_H
#define GG_POSITIONS_H

#include "common/engine.h"

typedef struct gg_scene gg_scene;

typedef struct gg_positions {
  double *r;
  int *species;
  size_t n;               /* grains in the file */
  gg_grain_arrays grains; /* they borrow the arrays */
} gg_positions;

/* Read the file that the scene names: extended XYZ (first frame), lengths in the unit of the scene; or a result (last
 * frame), in that of results. GG_BAD_INPUT if number, species or box
 * are not those of md's `model`. To be freed; nothing if the scene names no file. */
gg_status gg_files_positions_read(const gg_scene *scene, const gg_model *model, gg_positions *positions, gg_error *err);
void gg_files_positions_free(gg_positions *positions);
/* The name of a species, from 0, in extended XYZ. */
const char *gg_files_xyz_element(int species);
/* True if a run of the scene with md reads a file. */
bool gg_files_positions_are_read(const gg_scene *scene);

#endif
