/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a panel of the snapshot shows: of large or crowded systems not all grains, but the layer nearest to the viewer.
 */
#ifndef GG_PLOT_LAYER_H
#define GG_PLOT_LAYER_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include "scene/scene.h"

/* The grains of one frame: n positions, three coordinates each, in diameters. */
typedef struct gg_plot_grains {
  size_t n;
  const double *position;
  const uint8_t *species;
  int n_species;
  double edge[3], top, radius[GG_MAX_SPECIES], mass[GG_MAX_SPECIES];
} gg_plot_grains;

typedef struct gg_plot_disc {
  double depth, x, y;
  uint8_t species;
} gg_plot_disc;

/* The discs from the farthest to the nearest, to be drawn in this order. */
typedef struct gg_plot_layer {
  size_t n;
  gg_plot_disc *disc; /* owned */
  double depth;       /* where it ends */
  bool whole;         /* every grain is in it */
} gg_plot_layer;

/* Bytes of the picture that a disc takes: in PNG its rim counts, in SVG every disc alike. */
typedef struct gg_disc_cost {
  double each, per_diameter;
} gg_disc_cost;

/* The view of axes `along` and y, against axis `across`. False: out of memory. */
bool gg_plot_layer_make(gg_plot_layer *layer, const gg_plot_grains *s, int along, int across, gg_disc_cost cost);
void gg_plot_layer_free(gg_plot_layer *layer);

#endif
