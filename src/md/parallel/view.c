/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The engine as a thread beside others knows it. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "md/aligned_memory.h"
#include "md/parallel/parallel.h"

gg_md *gg_md_view_new(void)
{
  gg_md *view = gg_md_new_lines(1, sizeof *view, NULL);
  if (!view) return NULL;
  view->candidates = gg_md_new_pages(2 * GG_MD_CANDIDATES_APART, sizeof *view->candidates, NULL);
  if (view->candidates) return view;
  free(view);
  return NULL;
}

/* Its queue's bucket of any time is beyond the last. */
void gg_md_view_renew(gg_md *view, const gg_md *engine)
{
  uint32_t *const candidates = view->candidates;
  *view = *engine;
  view->candidates = candidates;
  view->queue = (gg_md_queue){.inverse_width = NAN, .n_buckets = 1};
  view->is_view = view->cells.fixed = true;
}

void gg_md_view_free(gg_md *view)
{
  if (view) free(view->candidates);
  free(view);
}
