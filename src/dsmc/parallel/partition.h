/* The partition of a large ensemble into segments of blocks, so that threads can share it. */
#ifndef GG_DSMC_PARTITION_H
#define GG_DSMC_PARTITION_H

#include "dsmc/kernel/pass.h"

enum { GG_DSMC_MAX_SEGMENTS = 16 };

/* How many segments for so many blocks: 1 below 8000, else 8 or 16. */
int gg_dsmc_segments_of(size_t blocks);

gg_dsmc_range gg_dsmc_all_blocks(const gg_dsmc_population *p);
/* Blocks of a segment; segments begin on cache lines of the speed bounds. */
gg_dsmc_range gg_dsmc_segment(const gg_dsmc_population *p, int segments, int segment);

#endif
