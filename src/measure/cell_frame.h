/* SPDX-License-Identifier: GPL-3.0-or-later */
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
/* The cells of the scene's frame; those above where it is the imposed flow. */
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

/* Take the means of a snapshot; weighted by mass and moment of inertia. */
void gg_measure_cell_frame_take(gg_cell_frame *f, const gg_snapshot *s);
/* Of grain i of that snapshot, about its cell's mean. Spins only where the snapshot has them. */
gg_vec gg_measure_cell_frame_velocity(const gg_cell_frame *f, const gg_snapshot *s, size_t i);
gg_vec gg_measure_cell_frame_spin(const gg_cell_frame *f, const gg_snapshot *s, size_t i);

/* The scene's frame where it is cells: snapshots with velocities about the means of cells, spins about those plus the
 * mean of the box. With `frame: cells` the share m_i/M_c that a mean takes out of a variance is put back, such that
 * grains without correlations have the temperatures that they have about the imposed flow, grains alone in their cell
 * included; with `cells_laboratory` it is not, and the flow across the cell stays in. */
typedef struct gg_framed {
  gg_cell_frame cells;
  double *c[3], *s[3];
  gg_snapshot snapshot; /* of the last one taken; all but these is borrowed from that */
} gg_framed;

gg_status gg_measure_framed_init(gg_framed *f, const gg_model *model, gg_error *err);
void gg_measure_framed_clear(gg_framed *f);
/* `whole` has positions, and outlives f->snapshot. */
void gg_measure_framed_take(gg_framed *f, const gg_snapshot *whole);
/* Show its grains in chunks. */
void gg_measure_framed_visit(const gg_framed *f, gg_visit *visit, void *context);

#endif
