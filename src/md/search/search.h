/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A search for a grain's next event, and what it has found so far. */
#ifndef GG_MD_SEARCH_SEARCH_H
#define GG_MD_SEARCH_SEARCH_H

#include "md/predict.h"
#include "md/search/features.h"

typedef struct gg_md_search {
  uint32_t grain;
  const gg_md_grain *self; /* at the present time */
  double collision;        /* earliest so far, and with whom */
  uint32_t partner;
  double valid;                       /* until then the moving rows have been searched */
  bool regular;                       /* no image of those to try has moved: of co-moving rows */
  bool inside;                        /* they and the grain are in the same image of the box */
  uint32_t n_candidates, *candidates; /* SIMD: whom to try */
} gg_md_search;

/* Synchronise: bring a grain's record to the present time. */
GG_INLINE gg_md_grain *gg_md_synchronise(gg_md *e, uint32_t i)
{
  gg_md_grain *g = &e->grain[i];
  g->r = gg_md_position(e, HAS_GRAVITY, g, e->k.now);
  g->v = gg_md_velocity(e, HAS_GRAVITY, g, e->k.now);
  g->t = e->k.now;
  return g;
}

/* Only what is read before it is written: `candidates` stays as it is. */
GG_INLINE void gg_md_begin_search(gg_md_search *s, uint32_t i, const gg_md_grain *self, double collision,
                                  uint32_t partner)
{
  s->grain = i;
  s->self = self;
  s->collision = collision;
  s->partner = partner;
  s->n_candidates = 0;
  s->regular = s->inside = false;
}

/* A contact against the earliest known. */
GG_INLINE void gg_md_take_contact(gg_md_search *s, double t, int64_t partner)
{
  if (t < s->collision || (t == s->collision && t < INFINITY && partner < s->partner)) {
    s->collision = t;
    s->partner = (uint32_t)partner;
  }
}

#endif
