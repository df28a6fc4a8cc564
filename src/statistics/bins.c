/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "statistics/bins.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "statistics/series.h"

gg_status gg_statistics_bins_init(gg_bins *b, size_t width, gg_error *err)
{
  *b = (gg_bins){.width = width, .per_block = 1};
  b->sum = gg_base_array_new((GG_BINS_BLOCKS + 1) * width, sizeof(double), err);
  return b->sum ? GG_OK : GG_FAILED;
}

void gg_statistics_bins_clear(gg_bins *b)
{
  free(b->sum);
  *b = (gg_bins){0};
}

void gg_statistics_bins_restart(gg_bins *b)
{
  if (!b->sum) return;
  b->blocks = b->pending = 0;
  b->per_block = 1;
  memset(b->sum, 0, (GG_BINS_BLOCKS + 1) * b->width * sizeof(double));
}

double *gg_statistics_bins_sample(gg_bins *b)
{
  return b->sum + b->blocks * b->width;
}

static void join_neighbours(gg_bins *b)
{
  for (size_t i = 0; i < b->blocks / 2; i++)
    for (size_t k = 0; k < b->width; k++)
      b->sum[i * b->width + k] = b->sum[2 * i * b->width + k] + b->sum[(2 * i + 1) * b->width + k];
  b->blocks /= 2;
  b->per_block *= 2;
  memset(b->sum + b->blocks * b->width, 0, (GG_BINS_BLOCKS + 1 - b->blocks) * b->width * sizeof(double));
}

void gg_statistics_bins_coarsen(gg_bins *b, size_t per_block)
{
  while (b->per_block < per_block) {
    join_neighbours(b);
    b->pending = 0;
  }
}

void gg_statistics_bins_commit(gg_bins *b)
{
  if (b->whole || ++b->pending < b->per_block) return;
  b->pending = 0;
  if (++b->blocks == GG_BINS_BLOCKS) join_neighbours(b);
}

gg_status gg_statistics_bins_save(const gg_bins *b, const char *name, gg_archive *a, gg_error *err)
{
  char item[64];
  uint64_t head[4] = {b->width, b->blocks, b->per_block, b->pending};
  snprintf(item, sizeof item, "bins/%s.head", name);
  GG_TRY(gg_base_archive_put(a, item, GG_ITEM_U64, head, 4, err));
  snprintf(item, sizeof item, "bins/%s", name);
  return gg_base_archive_put(a, item, GG_ITEM_F64, b->sum, (b->blocks + 1) * b->width, err);
}

gg_status gg_statistics_bins_restore(gg_bins *b, const char *name, const gg_archive *a, gg_error *err)
{
  char item[64];
  uint64_t head[4];
  snprintf(item, sizeof item, "bins/%s.head", name);
  GG_TRY(gg_base_archive_get(a, item, GG_ITEM_U64, head, 4, err));
  if (head[0] != b->width || head[1] >= GG_BINS_BLOCKS)
    return gg_base_fail(err, GG_BAD_FILE, "the checkpoint's %s has other bins than this scene's", name);
  if (!gg_is_decimation_factor(head[2], head[3]))
    return gg_base_fail(err, GG_BAD_FILE, "the checkpoint's bins of %s are damaged", name);
  b->blocks = head[1], b->per_block = head[2], b->pending = head[3];
  snprintf(item, sizeof item, "bins/%s", name);
  return gg_base_archive_get(a, item, GG_ITEM_F64, b->sum, (b->blocks + 1) * b->width, err);
}
