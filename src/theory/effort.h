/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Length of averaging that a requested error needs. */
#ifndef GG_EFFORT_H
#define GG_EFFORT_H

#include "common/quantity.h"

/* Collisions per grain times N error^2 until the mean of a quantity has this relative error. The slowest is the stress,
 * a small quantity, or the temperature, which fluctuates by sqrt(2/3N) with its relaxation time. */
double gg_theory_effort(const gg_model *model, gg_quantity q);

#endif
