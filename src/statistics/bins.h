/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sums over samples of an array of bins, kept in blocks of equal numbers of samples. All means and errors of curves
 * follow from these blocks. There are 16 to 32 blocks at any length of the window: at 32, neighbours are joined. */
#ifndef GG_BINS_H
#define GG_BINS_H

#include <stdbool.h>

#include "base/archive.h"

enum { GG_BINS_BLOCKS = 32 };

typedef struct gg_bins {
  size_t width;
  size_t blocks;    /* complete */
  size_t per_block; /* samples in each: a power of two */
  size_t pending;   /* samples in the block being filled */
  bool whole;       /* a transient: all samples are one block, and errors come from several runs */
  double *sum;      /* (GG_BINS_BLOCKS + 1) x width: the complete blocks, then the one being filled */
} gg_bins;

gg_status gg_statistics_bins_init(gg_bins *b, size_t width, gg_error *err);
void gg_statistics_bins_clear(gg_bins *b);
/* Delete all sums: averaging starts again. */
void gg_statistics_bins_restart(gg_bins *b);

/* The row of bins to which the present sample is added; then count the sample. */
double *gg_statistics_bins_sample(gg_bins *b);
void gg_statistics_bins_commit(gg_bins *b);

/* Join neighbouring blocks until each has `per_block` samples (a power of two); a single remaining block is dropped. */
void gg_statistics_bins_coarsen(gg_bins *b, size_t per_block);

static inline size_t gg_bins_blocks(const gg_bins *b)
{
  return b->whole ? 1 : b->blocks;
}
static inline const double *gg_bins_block(const gg_bins *b, size_t i)
{
  return b->sum + i * b->width;
}

gg_status gg_statistics_bins_save(const gg_bins *b, const char *name, gg_archive *archive, gg_error *err);
gg_status gg_statistics_bins_restore(gg_bins *b, const char *name, const gg_archive *archive, gg_error *err);

#endif
