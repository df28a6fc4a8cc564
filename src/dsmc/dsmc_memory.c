/* How much memory the engine takes, before it is there: the blocks of ensemble.c. */
#include "dsmc/dsmc_memory.h"

#include "dsmc/dsmc.h"

double gg_dsmc_bytes(const gg_model *m)
{
  const double block = m->single ? sizeof(gg_dsmc_block_single) : sizeof(gg_dsmc_block);
  const double vectors = m->rule != GG_SMOOTH ? 2 : 1;
  return (double)m->n / GG_DSMC_LANES * (vectors * block + sizeof(float));
}
