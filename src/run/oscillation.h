/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Oscillatory shear (shear_period): one period of stress and temperature, and their harmonics. */
#ifndef GG_RUN_OSCILLATION_H
#define GG_RUN_OSCILLATION_H

#include "run/replicas.h"
#include "theory/relaxation.h"

/* Curves over the later half of the periods, with numbers derived from them. `theory`: at every sample; NULL: none. */
gg_status gg_run_oscillation_curves(const gg_replicas *all, const gg_relaxing *theory, gg_curves *list, gg_error *err);

#endif
