/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Maps of deviations over two keys of a grid: a picture a quantity; rows: dsmc, md and theories against Enskog's
 * equation, md against dsmc; a column for each combination of the other keys. */
#ifndef GG_DEVIATION_MAPS_H
#define GG_DEVIATION_MAPS_H

#include "sweep/grid_view.h"

typedef struct gg_map_choice { /* NULL: chosen */
  const char *show;            /* quantities, with commas */
  const char *theories;        /* theories, with commas; default: lun1991 and the sweep's own */
  const char *picture;         /* "grid.svg": grid_temperature.svg and on */
  const char *width;
  const gg_stop *stop; /* polled before each picture */
} gg_map_choice;

/* Draw the maps, and call `drawn` with the name of each picture and its quantity. GG_BAD_INPUT: more cells than a page
 * has room for. */
gg_status gg_sweep_deviation_maps_draw(const gg_grid_view *view, const gg_map_choice *choice,
                                       void (*drawn)(void *context, const char *picture, const char *quantity),
                                       void *context, gg_error *err);

#endif
