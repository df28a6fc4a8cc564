/* SPDX-License-Identifier: GPL-3.0-or-later */
/* State of a search for the next event of a grain. */
#ifndef GG_MD_SEARCH_SEARCH_H
#define GG_MD_SEARCH_SEARCH_H

#include "md/images.h"
#include "md/predict.h"
#include "md/search/features.h"

typedef struct gg_md_search {
  uint32_t grain;
  const gg_md_grain *self; /* its record at the present time */
  double collision;        /* earliest so far, with `partner` */
  uint32_t partner;
  double valid;                       /* the search of moving rows is complete until then */
  bool regular;                       /* co-moving rows: no candidate is across the sheared boundary */
  bool inside;                        /* candidates and grain are in the same image of the box */
  uint32_t n_candidates, *candidates; /* SIMD: grains to test */
} gg_md_search;

/* Synchronise a grain: bring its record to the present time. */
GG_INLINE gg_md_grain *gg_md_synchronise(gg_md *e, uint32_t i)
{
  gg_md_grain *g = &e->grain[i];
  g->r = gg_md_position(e, HAS_GRAVITY, g, e->k.now);
  g->v = gg_md_velocity(e, HAS_GRAVITY, g, e->k.now);
  g->t = e->k.now;
  return g;
}

/* Set only the members that are read before they are written; `candidates` is unchanged. */
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

/* Take a contact if it is earlier than the earliest so far; of equal times the smaller partner counts. */
GG_INLINE void gg_md_take_contact(gg_md_search *s, double t, int64_t partner)
{
  if (t < s->collision || (t == s->collision && t < INFINITY && partner < s->partner)) {
    s->collision = t;
    s->partner = (uint32_t)partner;
  }
}

#endif
