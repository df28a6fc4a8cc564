/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sample of the grains at one time, and checks that must hold at any time: all numbers are finite, no grains overlap,
 * no grain is outside the box. */
#ifndef STRESS_SAMPLE_H
#define STRESS_SAMPLE_H

#include "api/simulation.h"

typedef struct sample {
  gg_simulation_state state;
  size_t n;
  double *position, *velocity, *spin; /* three per grain; position NULL if the engine has none */
  int *species;
  double momentum[3], scale;    /* sum m C; sum m |C| */
  double translation, rotation; /* energies */
  double height;                /* sum m y */
  double xy, yy;                /* sum m C_x C_y, sum m C_y^2 */
  bool numbers;
} sample;

/* false: out of memory. */
bool sample_new(sample *s, const gg_simulation *g);
void sample_free(sample *s);
void sample_take(sample *s, const gg_simulation *g);

/* Largest overlap of two grains, in their contact distance (0: none), and how many stand outside the box or in a
 * wall. */
double sample_overlap(const sample *s, const gg_simulation *g);
size_t sample_escapes(const sample *s, const gg_simulation *g);

#endif
