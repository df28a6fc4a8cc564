/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Velocities and spins about the means of cells of about eight grains (gg_cell_grid), without a correction for the
 * variance that a mean over few grains takes away. */
#ifndef GG_CELL_FRAME_H
#define GG_CELL_FRAME_H

#include "measure/grain_snapshot.h"

/* The box divided into equal cells of about eight grains each, at least three along an edge: for local means. */
typedef struct gg_cell_grid {
  int n[3];
  double box[3];
} gg_cell_grid;

gg_cell_grid gg_measure_cell_grid_of(const gg_model *model);
/* The cells or slabs of the scene's frame; the cells above if the frame is the imposed flow. */
gg_cell_grid gg_measure_frame_grid_of(const gg_model *model);
size_t gg_measure_cell_grid_cells(const gg_cell_grid *grid);
/* The cell of grain i; x runs fastest. */
size_t gg_measure_cell_grid_cell(const gg_cell_grid *grid, const gg_snapshot *s, size_t i);

typedef struct gg_cell_frame {
  gg_cell_grid grid;
  struct gg_cell_mean *mean;
  uint32_t *at; /* the cell of each grain */
} gg_cell_frame;

gg_status gg_measure_cell_frame_init(gg_cell_frame *f, const gg_model *model, gg_cell_grid grid, gg_error *err);
void gg_measure_cell_frame_clear(gg_cell_frame *f);

/* Compute the means of a snapshot, weighted by mass and moment of inertia. */
void gg_measure_cell_frame_take(gg_cell_frame *f, const gg_snapshot *s);
/* Velocity of grain i of that snapshot about its cell's mean. Spins only if the snapshot has them. */
gg_vec gg_measure_cell_frame_velocity(const gg_cell_frame *f, const gg_snapshot *s, size_t i);
gg_vec gg_measure_cell_frame_spin(const gg_cell_frame *f, const gg_snapshot *s, size_t i);

/* The scene's frame, if it is made of cells or slabs: snapshots with velocities about the means of cells, spins about
 * those plus the mean of the box. With `frame: cells` or `slabs` the fraction m_i/M_c of the variance that a mean takes
 * away is restored, so that uncorrelated grains have the temperatures that they have about the imposed flow, grains
 * alone in their cell included. With `cells_laboratory` or `slabs_laboratory` it is not restored, and the flow across
 * the cell remains. */
typedef struct gg_framed {
  gg_cell_frame cells;
  double *c[3], *s[3];
  gg_snapshot snapshot; /* the framed snapshot; all but c and s is borrowed from the last one taken */
} gg_framed;

gg_status gg_measure_framed_init(gg_framed *f, const gg_model *model, gg_error *err);
void gg_measure_framed_clear(gg_framed *f);
/* `whole` has positions, and outlives f->snapshot. */
void gg_measure_framed_take(gg_framed *f, const gg_snapshot *whole);
/* Visit the grains of the framed snapshot in chunks. */
void gg_measure_framed_visit(const gg_framed *f, gg_visit *visit, void *context);

#endif
