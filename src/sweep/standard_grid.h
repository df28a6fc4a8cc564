/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The grids of `graingas validate` without a file: validation/grid/grid.yaml and grid_quick.yaml. */
#ifndef GG_STANDARD_GRID_H
#define GG_STANDARD_GRID_H

extern const char gg_sweep_standard_grid[], gg_sweep_quick_grid[];

#endif
