/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Operations of the engine table gg_md_ops, by the file that defines them. */
#ifndef GG_MD_MD_OPERATIONS_H
#define GG_MD_MD_OPERATIONS_H

#include "md/md_state.h"

/* md_accept.c */
gg_status gg_md_accepts(const gg_model *model, gg_error *err);

/* md_describe.c */
void gg_md_describe(const gg_model *model, void (*line)(void *context, const char *text), void *context);

/* md_time.c: estimated nanoseconds a collision. */
double gg_md_nanoseconds(const gg_model *model);

/* md_snapshot.c */
void gg_md_snapshot(gg_engine *engine, bool positions, gg_visit *visit, void *context);

/* md_checkpoint.c. The caller of gg_md_restore sets base.ops. */
gg_status gg_md_save(const gg_engine *engine, gg_archive *archive, gg_error *err);
gg_status gg_md_restore(const gg_model *model, const gg_archive *archive, gg_engine **engine, gg_error *err);

#endif
