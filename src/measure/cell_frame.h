/* Velocities and spins about the means of cells of about eight grains (gg_cell_grid), as they are: what a mean over few
 * grains takes out of a variance is not put back. */
#ifndef GG_CELL_FRAME_H
#define GG_CELL_FRAME_H

#include "measure/grain_snapshot.h"

/* The box cut into equal cells of about eight grains each, at least three along an edge: for local means. */
typedef struct gg_cell_grid {
  int n[3];
  double box[3];
} gg_cell_grid;

gg_cell_grid gg_measure_cell_grid_of(const gg_model *model);
size_t gg_measure_cell_grid_cells(const gg_cell_grid *grid);
/* The cell of grain i; x runs fastest. */
size_t gg_measure_cell_grid_cell(const gg_cell_grid *grid, const gg_snapshot *s, size_t i);

typedef struct gg_cell_frame {
  gg_cell_grid grid;
  struct gg_cell_mean *mean;
  uint32_t *at; /* the cell of each grain */
} gg_cell_frame;

gg_status gg_measure_cell_frame_init(gg_cell_frame *f, const gg_model *model, gg_error *err);
void gg_measure_cell_frame_clear(gg_cell_frame *f);

/* Take the means of a snapshot; weighted by mass and moment of inertia. */
void gg_measure_cell_frame_take(gg_cell_frame *f, const gg_snapshot *s);
/* Of grain i of that snapshot, about its cell's mean. Spins only where the snapshot has them. */
gg_vec gg_measure_cell_frame_velocity(const gg_cell_frame *f, const gg_snapshot *s, size_t i);
gg_vec gg_measure_cell_frame_spin(const gg_cell_frame *f, const gg_snapshot *s, size_t i);

#endif
