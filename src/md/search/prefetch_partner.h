/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Prefetching for searches whose cells hold a grain once: the partner of the event that is due. */
#ifndef GG_MD_SEARCH_PREFETCH_PARTNER_H
#define GG_MD_SEARCH_PREFETCH_PARTNER_H

#include "md/search/neighbour_search.h"

GG_INLINE void gg_md_prefetch_due(const gg_md *e, uint32_t i, uint32_t partner)
{
  (void)i;
  if (GG_MD_NO_GRAIN(partner)) return;
  __builtin_prefetch(&e->grain[partner]);
  __builtin_prefetch(&e->node[partner]);
}

GG_INLINE void gg_md_prefetch_cached(const gg_md *e, uint32_t i)
{
  (void)e;
  (void)i;
}

#endif
