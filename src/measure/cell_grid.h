/* The box cut into equal cells of about eight grains each, at least three along an edge: for local means. */
#ifndef GG_CELL_GRID_H
#define GG_CELL_GRID_H

#include "measure/grain_snapshot.h"

typedef struct gg_cell_grid {
  int n[3];
  double box[3];
} gg_cell_grid;

gg_cell_grid gg_measure_cell_grid_of(const gg_model *model);
size_t gg_measure_cell_grid_cells(const gg_cell_grid *grid);
/* The cell of grain i; x runs fastest. */
size_t gg_measure_cell_grid_cell(const gg_cell_grid *grid, const gg_snapshot *s, size_t i);

#endif
