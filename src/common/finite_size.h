/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Bias of means by a finite number of grains. */
#ifndef GG_FINITE_SIZE_H
#define GG_FINITE_SIZE_H

#include "common/model.h"

/* Relative bias times the number of grains of the scarcest species, at most. */
double gg_common_finite_size_bias(gg_flow flow, double phi);
/* Relative bias of the means of this model, at most. */
double gg_common_finite_size_bias_of(const gg_model *model);

#endif
