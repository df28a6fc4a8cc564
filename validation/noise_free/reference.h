/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Uniform shear of smooth grains by Enskog's equation without random numbers, at a degree of one's own choice. */
#ifndef GG_VALIDATION_REFERENCE_H
#define GG_VALIDATION_REFERENCE_H

#include "common/model.h"
#include "common/quantity.h"

enum { GG_REFERENCE_NUMBERS = 4 };
/* T, P_xy, N1 and N2, in the units of results. */
extern const gg_quantity gg_reference_quantity[GG_REFERENCE_NUMBERS];

/* false: it does not converge. */
bool gg_reference_shear(const gg_model *model, int degree, double number[GG_REFERENCE_NUMBERS]);

#endif
