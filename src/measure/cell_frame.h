/* Velocities and spins about the means of cells of about eight grains (cell_grid.h), as they are: what a mean over few
 * grains takes out of a variance is not put back. */
#ifndef GG_CELL_FRAME_H
#define GG_CELL_FRAME_H

#include "measure/cell_grid.h"

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
