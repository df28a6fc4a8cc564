#include "dsmc/parallel/partition.h"

int gg_dsmc_segments_of(size_t blocks)
{
  return blocks < 8000 ? 1 : blocks < 32000 ? 8 : 16;
}

gg_dsmc_range gg_dsmc_all_blocks(const gg_dsmc_population *p)
{
  return (gg_dsmc_range){0, (uint32_t)p->n_blocks};
}

static uint32_t beginning(const gg_dsmc_population *p, int segments, int segment)
{
  enum { LINE = 64 / sizeof *p->speed_bound };
  if (segment == segments) return (uint32_t)p->n_blocks;
  return (uint32_t)(p->n_blocks * (size_t)segment / (size_t)segments / LINE * LINE);
}

gg_dsmc_range gg_dsmc_segment(const gg_dsmc_population *p, int segments, int segment)
{
  uint32_t first = beginning(p, segments, segment);
  return (gg_dsmc_range){first, beginning(p, segments, segment + 1) - first};
}
