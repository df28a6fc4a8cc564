/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Means of quantities over the series of all replicas. */
#ifndef GG_RUN_SERIES_MEANS_H
#define GG_RUN_SERIES_MEANS_H

#include "run/replicas.h"

/* Mean over the window of all replicas; NaN if no observable here has the quantity. Its error allows for a memory of so
 * many samples, as slow modes between walls have it (gg_slow_modes.time); 0: what the series itself shows. */
gg_status gg_run_replicas_mean(const gg_replicas *all, gg_quantity q, double memory, gg_mean *mean, gg_error *err);

/* Means of the linear response of a quantity that has a mean, over blocks of so many rows (statistics/estimator.h). */
gg_status gg_run_replicas_blocks(const gg_replicas *all, gg_quantity q, size_t length, double *blocks, gg_error *err);

#endif
