/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Memory of an engine: its life, and an estimate of its size. */
#ifndef GG_MD_MD_ALLOCATE_H
#define GG_MD_MD_ALLOCATE_H

#include "md/md_state.h"

/* An engine with empty arrays for this model. The caller sets base.ops. */
gg_status gg_md_allocate(const gg_model *model, gg_md **engine, gg_error *err);
/* Arrays of the neighbour lists and skins; sets search.kind. */
gg_status gg_md_allocate_lists(gg_md *e, gg_error *err);
/* Times of last collisions, -INFINITY: none yet. */
gg_status gg_md_allocate_last(gg_md *e, gg_error *err);
void gg_md_free(gg_md *e);

/* Estimated memory of an engine for this model, in bytes, cells and event queue included. */
double gg_md_bytes(const gg_model *model);

#endif
