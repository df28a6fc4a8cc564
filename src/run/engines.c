#include "common/engine.h"
#include "dsmc/memory.h"
#include "md/memory.h"
#include "run/forecast.h"

/* The engines there are; a new one is a line here and there. */
const gg_engine_ops *gg_engine_ops_of(gg_engine_kind kind)
{
  return kind == GG_DSMC ? &gg_dsmc_ops : &gg_md_ops;
}

double gg_engine_bytes(gg_engine_kind kind, const gg_model *model)
{
  return kind == GG_DSMC ? gg_dsmc_bytes(model) : gg_md_bytes(model);
}
