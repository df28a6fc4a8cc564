/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "plot/snapshot_slice.h"

#include <math.h>
#include <stdlib.h>

/* Both panels and the frames around them stay below half a megabyte. */
static const double most_bytes = 215e3;

static int nearest_first(const void *a, const void *b)
{
  double x = ((const gg_plot_disc *)a)->depth, y = ((const gg_plot_disc *)b)->depth;
  return (x > y) - (x < y);
}

static void reverse(gg_plot_disc *disc, size_t n)
{
  for (size_t i = 0; i < n / 2; i++) {
    gg_plot_disc d = disc[i];
    disc[i] = disc[n - 1 - i], disc[n - 1 - i] = d;
  }
}

/* As many as cover the panel once, if that is not too much to draw. */
static size_t count_shown(const gg_plot_layer *layer, const gg_plot_grains *s, double area, gg_disc_cost cost)
{
  double bytes = 0;
  for (size_t i = 0; i < s->n; i++) {
    double r = s->radius[layer->disc[i].species];
    area -= M_PI * r * r;
    bytes += cost.each + cost.per_diameter * 2 * r;
    if (area < 0 || bytes > most_bytes) return i;
  }
  return s->n;
}

bool gg_plot_layer_make(gg_plot_layer *layer, const gg_plot_grains *s, int along, int across, gg_disc_cost cost)
{
  *layer = (gg_plot_layer){.disc = malloc((s->n + !s->n) * sizeof *layer->disc)};
  if (!layer->disc) return false;
  for (size_t i = 0; i < s->n; i++) {
    const double *r = s->position + 3 * i;
    layer->disc[i] = (gg_plot_disc){r[across], r[along], r[1], s->species[i]};
  }
  qsort(layer->disc, s->n, sizeof *layer->disc, nearest_first);
  layer->n = count_shown(layer, s, s->edge[along] * s->top, cost);
  layer->whole = layer->n == s->n;
  layer->depth = layer->whole ? s->edge[across] : layer->disc[layer->n].depth;
  reverse(layer->disc, layer->n);
  return true;
}

void gg_plot_layer_free(gg_plot_layer *layer)
{
  free(layer->disc);
  *layer = (gg_plot_layer){0};
}
