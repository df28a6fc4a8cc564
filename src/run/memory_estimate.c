/* Bytes of an engine that is not there yet. */
#include "dsmc/dsmc_memory.h"
#include "md/md_memory.h"
#include "run/cost_estimate.h"

double gg_run_engine_memory(gg_engine_kind kind, const gg_model *model)
{
  return kind == GG_DSMC ? gg_dsmc_bytes(model) : gg_md_bytes(model);
}
