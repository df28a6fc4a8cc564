/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Time courses of a gas that is followed from its start: means over replicas at each time. */
#ifndef GG_RUN_TIME_COURSE_H
#define GG_RUN_TIME_COURSE_H

#include "run/replicas.h"

/* Mean at the end. */
gg_mean gg_run_time_course_end(const gg_replicas *all, gg_quantity q);
/* Curves of all followed quantities, with that of the Gaussian closure where it answers. */
gg_status gg_run_time_course_curves(const gg_replicas *all, gg_result *result, gg_error *err);

#endif
