/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Where a run starts: close to the steady state that theory expects, so that the warm-up is short. Only the start
 * depends on it. */
#ifndef GG_NEAR_STEADY_H
#define GG_NEAR_STEADY_H

#include "common/model.h"

/* Set temperature0 and ratio0. */
gg_status gg_theory_start_near_steady(gg_model *model, gg_error *err);

#endif
