/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Operations of the engine that are not in md_engine.c. */
#ifndef GG_MD_ENGINE_H
#define GG_MD_ENGINE_H

#include "md/md_state.h"

gg_status gg_md_accepts(const gg_model *model, gg_error *err);
double gg_md_bytes(const gg_model *model);
void gg_md_describe(const gg_model *model, void (*line)(void *context, const char *text), void *context);

/* start/equilibrium.c: does a run of this model begin at places of a fluid in equilibrium; an engine that does,
 * with these velocities and spins (NULL: its own). */
bool gg_md_starts_in_equilibrium(const gg_model *model);
gg_status gg_md_create_in_equilibrium(const gg_model *model, uint64_t seed, uint64_t stream,
                                      const gg_grain_arrays *motion, gg_engine **engine, gg_error *err);

void gg_md_snapshot(gg_engine *engine, bool positions, gg_visit *visit, void *context);
gg_status gg_md_save(const gg_engine *engine, gg_archive *archive, gg_error *err);
gg_status gg_md_restore(const gg_model *model, const gg_archive *archive, gg_engine **engine, gg_error *err);

#endif
