/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tests of one pair at a time: the reference path. */
#ifndef GG_MD_SEARCH_PAIR_H
#define GG_MD_SEARCH_PAIR_H

#include "md/search/search.h"

/* Test the contact with grain j at the separation dr and the relative velocity dv. */
GG_INLINE void gg_md_try_separated(const gg_md *e, gg_md_search *s, uint32_t j, gg_vec dr, gg_vec dv)
{
  double sigma = e->model.sigma[IS_MIXTURE ? gg_pair(gg_md_species_of(s->self), gg_md_species_of(&e->grain[j])) : 0];
  double t = e->k.now + gg_md_contact_delay(dr, dv, sigma * sigma);
  gg_md_take_contact(s, t, j);
}

/* Test the contact with an image of grain j, shifted by `shift` and moving at `image_velocity`. */
GG_INLINE void gg_md_try_pair(const gg_md *e, gg_md_search *s, uint32_t j, gg_vec shift, double image_velocity)
{
  const gg_md_grain *one = s->self, *two = &e->grain[j];
  gg_vec dr = gg_add(gg_sub(gg_md_position(e, HAS_GRAVITY, two, e->k.now), one->r), shift);
  gg_vec dv = gg_sub(gg_md_velocity(e, HAS_GRAVITY, two, e->k.now), one->v);
  if (IS_SHEARED) dv.x += image_velocity;
  gg_md_try_separated(e, s, j, dr, dv);
}

GG_INLINE void gg_md_try_nearest(const gg_md *e, gg_md_search *s, uint32_t j)
{
  const gg_md_grain *one = s->self, *two = &e->grain[j];
  gg_vec dr = gg_sub(gg_md_position(e, HAS_GRAVITY, two, e->k.now), one->r);
  gg_vec dv = gg_sub(gg_md_velocity(e, HAS_GRAVITY, two, e->k.now), one->v);
  gg_md_minimum_image(&e->box, IS_SHEARED, e->k.now, &dr, &dv);
  gg_md_try_separated(e, s, j, dr, dv);
}

#endif
