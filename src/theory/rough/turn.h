/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Hermite functions of coordinates y by those of z = Y^T y, with Y a rotation. */
#ifndef GG_ROUGH_TURN_H
#define GG_ROUGH_TURN_H

#include "theory/rough/functions.h"

/* Rows that belong to Ho(y), one for each function and of so many columns, become those of Ho(z). */
void gg_rough_turn(const gg_rough_functions *f, const double Y[GG_ROUGH_AXES][GG_ROUGH_AXES], double *rows,
                   int columns);

#endif
