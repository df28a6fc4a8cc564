#include "dsmc/block.h"

const gg_dsmc_block *gg_dsmc_blocks_in_double(const gg_dsmc_population *p, const void *blocks, size_t first, size_t n,
                                              gg_dsmc_block *room)
{
  if (!p->single) return (const gg_dsmc_block *)blocks + first;
  const float *from = (const float *)((const gg_dsmc_block_single *)blocks + first);
  double *to = (double *)room;
  for (size_t i = 0; i < n * GG_DSMC_COMPONENTS; i++) to[i] = from[i];
  return room;
}
