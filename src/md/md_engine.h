/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Operations of the engine that are not in md_engine.c. */
#ifndef GG_MD_ENGINE_H
#define GG_MD_ENGINE_H

#include "md/md_state.h"

gg_status gg_md_accepts(const gg_model *model, gg_error *err);
double gg_md_bytes(const gg_model *model);
void gg_md_describe(const gg_model *model, void (*line)(void *context, const char *text), void *context);

void gg_md_snapshot(gg_engine *engine, bool positions, gg_visit *visit, void *context);
gg_status gg_md_save(const gg_engine *engine, gg_archive *archive, gg_error *err);
gg_status gg_md_restore(const gg_model *model, const gg_archive *archive, gg_engine **engine, gg_error *err);

#endif
