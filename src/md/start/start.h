/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The start of a run: an initial state, and everything that the event loop needs to run from it. */
#ifndef GG_MD_START_START_H
#define GG_MD_START_START_H

#include "md/md_state.h"

/* start.c: set positions, velocities and spins of a fresh initial state. Arrays of `given` (NULL: none) are taken as
 * they are. */
gg_status gg_md_start(gg_md *e, uint64_t seed, uint64_t stream, const gg_grain_arrays *given, gg_error *err);

/* begin.c: make an engine with positions, velocities and spins ready to run. A grid that exists is kept. T: temperature
 * of the gas, as an estimate of rates. */
gg_status gg_md_begin_at(gg_md *e, double T, gg_error *err);
/* The same at the initial temperature of the model. */
gg_status gg_md_begin(gg_md *e, gg_error *err);

/* Predict all events anew, in the grid that there is. */
gg_status gg_md_predict_anew(gg_md *e, gg_error *err);

/* equilibrium.c: true if a run of this model begins at positions of a fluid in equilibrium. */
bool gg_md_starts_in_equilibrium(const gg_model *model);
/* Create an engine at such positions by the operations `md`. `motion`: velocities and spins; NULL: fresh ones. */
gg_status gg_md_create_in_equilibrium(const gg_engine_ops *md, const gg_model *model, uint64_t seed, uint64_t stream,
                                      const gg_grain_arrays *motion, gg_engine **engine, gg_error *err);

#endif
