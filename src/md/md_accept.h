#ifndef GG_MD_ACCEPT_H
#define GG_MD_ACCEPT_H

#include "common/model.h"

gg_status gg_md_accepts(const gg_model *model, gg_error *err);
void gg_md_describe(const gg_model *model, void (*line)(void *context, const char *text), void *context);

#endif
