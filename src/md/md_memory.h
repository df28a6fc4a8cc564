/* Bytes that an engine of this model will take. */
#ifndef GG_MD_MEMORY_H
#define GG_MD_MEMORY_H

#include "common/model.h"

double gg_md_bytes(const gg_model *model);

#endif
