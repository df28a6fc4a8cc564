/* Bytes of an engine that is not there yet. */
#include "dsmc/memory.h"
#include "md/memory.h"
#include "run/forecast.h"

double gg_engine_bytes(gg_engine_kind kind, const gg_model *model)
{
  return kind == GG_DSMC ? gg_dsmc_bytes(model) : gg_md_bytes(model);
}
