/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Angle Psi between velocity and spin. */
#ifndef GG_ROUGH_ORIENTATION_H
#define GG_ROUGH_ORIENTATION_H

#include "theory/rough/rough_state.h"

/* <cos^2 Psi> = <(C.W)^2/(C^2 W^2)>, W the spin about the mean of the weight; NaN: out of memory. */
double gg_rough_cos2_psi(const gg_rough_form *form, const gg_rough_functions *f, const gg_rough_weight *weight,
                         const double *a);

#endif
