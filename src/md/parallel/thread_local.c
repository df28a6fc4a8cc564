/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Copy of the engine for a thread beside others. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "md/aligned_memory.h"
#include "md/parallel/parallel.h"

gg_md *gg_md_local_new(void)
{
  gg_md *local = gg_md_new_lines(1, sizeof *local, NULL);
  if (!local) return NULL;
  local->candidates = gg_md_new_pages(2 * GG_MD_CANDIDATES_APART, sizeof *local->candidates, NULL);
  local->queue.bucket = gg_md_new_lines(2, sizeof *local->queue.bucket, NULL);
  if (local->candidates && local->queue.bucket) return local;
  gg_md_local_free(local);
  return NULL;
}

/* The queue of the copy has NaN as inverse width: the bucket of any time is behind the last one. */
void gg_md_local_renew(gg_md *local, const gg_md *engine)
{
  uint32_t *const candidates = local->candidates;
  gg_md_bucket *const bucket = local->queue.bucket;
  *local = *engine;
  local->candidates = candidates;
  local->queue = (gg_md_queue){.inverse_width = NAN, .n_buckets = 1, .bucket = bucket};
  gg_md_queue_no_pending(&local->queue);
  local->is_thread_local = local->cells.fixed = true;
}

void gg_md_local_free(gg_md *local)
{
  if (!local) return;
  free(local->candidates);
  free(local->queue.bucket);
  free(local);
}
