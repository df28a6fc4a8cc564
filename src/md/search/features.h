/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Features of this instance of the event loop, as constants. The loop and its searches are compiled once for every row
 * of the table in meson.build, each into an object of its own, with GG_SEARCH (the header of its neighbour search),
 * GG_BOUNDARY, GG_MIXTURE and GG_SIMD defined. So an instance has no test of what a scene has.
 *
 * The reference path is compiled once for all boundaries and mixtures, without these definitions: there the features
 * are read from the model. */
#ifndef GG_MD_SEARCH_FEATURES_H
#define GG_MD_SEARCH_FEATURES_H

#include "md/event_loops.h"

#ifdef GG_BOUNDARY
enum {
  IS_SHEARED = GG_BOUNDARY == GG_MD_SHEARED,
  IS_WALLED = GG_BOUNDARY == GG_MD_WALLED || GG_BOUNDARY == GG_MD_FALLING,
  HAS_GRAVITY = GG_BOUNDARY == GG_MD_FALLING,
  IS_MIXTURE = GG_MIXTURE,
  IS_SIMD = GG_SIMD, /* a batch of pairs at a time */
};
#else
#define IS_SHEARED gg_model_is_sheared(&e->model)
#define IS_WALLED (e->model.walled)
#define HAS_GRAVITY (e->falls)
#define IS_MIXTURE (e->model.n_species > 1)
enum { IS_SIMD = false };
#endif

#endif
