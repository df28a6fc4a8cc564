/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Hermite functions of coordinates y by those of z = Y^T y, with Y a rotation, which is done as rotations of planes. */
#ifndef GG_ROUGH_TURN_H
#define GG_ROUGH_TURN_H

#include "theory/rough/functions.h"

enum { GG_ROUGH_PLANES = GG_ROUGH_AXES * (GG_ROUGH_AXES - 1) / 2, GG_ROUGH_MOST_TURNED = GG_ROUGH_MOST_DEGREE + 1 };

typedef struct gg_rough_turn {
  const gg_rough_functions *f;
  int planes;
  double (*turn)[GG_ROUGH_MOST_TURNED][GG_ROUGH_MOST_TURNED]; /* matrices by plane and quanta in it */
  int *group, end[GG_ROUGH_PLANES]; /* rows that a plane mixes: t, and t + 1 rows; the end of those of each plane */
} gg_rough_turn;

gg_status gg_rough_turn_make(gg_rough_turn *x, const gg_rough_functions *f, gg_error *err);
void gg_rough_turn_clear(gg_rough_turn *x);
void gg_rough_turn_set(gg_rough_turn *x, const double Y[GG_ROUGH_AXES][GG_ROUGH_AXES]);

/* Rows that belong to Ho(y), one for each function and of so many columns, become those of Ho(z). */
void gg_rough_turn_rows(const gg_rough_turn *x, double *rows, int columns);

#endif
