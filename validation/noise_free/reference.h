/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Uniform shear of smooth grains from Enskog's equation without random numbers, with polynomials up to any degree. */
#ifndef GG_VALIDATION_REFERENCE_H
#define GG_VALIDATION_REFERENCE_H

#include "common/model.h"
#include "common/quantity.h"

enum { GG_REFERENCE_NUMBERS = 4 };
/* T, P_xy, N1 and N2, in the units of results. */
extern const gg_quantity gg_reference_quantity[GG_REFERENCE_NUMBERS];

/* Solve at even degrees 4, 6, ... up to `last_degree`, each from the one before. False: no convergence. */
bool gg_reference_shear(const gg_model *model, int last_degree, double number[GG_REFERENCE_NUMBERS]);

#endif
