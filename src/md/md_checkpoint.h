#ifndef GG_MD_CHECKPOINT_H
#define GG_MD_CHECKPOINT_H

#include "md/md_state.h"

void gg_md_snapshot(gg_engine *engine, bool positions, gg_visit *visit, void *context);
gg_status gg_md_save(const gg_engine *engine, gg_archive *archive, gg_error *err);
gg_status gg_md_restore(const gg_model *model, const gg_archive *archive, gg_engine **engine, gg_error *err);

#endif
