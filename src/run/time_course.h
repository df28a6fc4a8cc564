/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Curves in time of a transient run (run.duration): means over replicas at each time. */
#ifndef GG_RUN_TIME_COURSE_H
#define GG_RUN_TIME_COURSE_H

#include "run/replicas.h"

gg_mean gg_run_time_course_end(const gg_replicas *all, gg_quantity q);
/* Curves of all quantities with a history, beside the Gaussian closure's if it has an answer. */
gg_status gg_run_time_course_curves(const gg_replicas *all, gg_result *result, gg_error *err);

#endif
