/* Bytes that an engine of this model will take. */
#ifndef GG_DSMC_MEMORY_H
#define GG_DSMC_MEMORY_H

#include "common/model.h"

double gg_dsmc_bytes(const gg_model *model);

#endif
