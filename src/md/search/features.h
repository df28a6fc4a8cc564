/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What this instance of the event loop is for. The loop and its searches are compiled once for every row of the table
 * in meson.build, each into an object of its own, which defines GG_SEARCH (the header of its kind of search),
 * GG_BOUNDARY, GG_MIXTURE and GG_SIMD. So all of this is constant, and nothing in an instance asks what a scene has.
 *
 * The reference path is compiled once for all boundaries and mixtures, without those: there the model decides.
 */
#ifndef GG_MD_SEARCH_FEATURES_H
#define GG_MD_SEARCH_FEATURES_H

#include "md/event_loops.h"

#ifdef GG_BOUNDARY
enum {
  IS_SHEARED = GG_BOUNDARY == GG_MD_SHEARED,
  IS_WALLED = GG_BOUNDARY == GG_MD_WALLED || GG_BOUNDARY == GG_MD_FALLING,
  HAS_GRAVITY = GG_BOUNDARY == GG_MD_FALLING,
  IS_MIXTURE = GG_MIXTURE,
  IS_SIMD = GG_SIMD, /* eight pairs at a time */
};
#else
#define IS_SHEARED (e->model.shear_rate != 0)
#define IS_WALLED (e->model.walled)
#define HAS_GRAVITY (e->falls)
#define IS_MIXTURE (e->model.n_species > 1)
enum { IS_SIMD = false };
#endif

#endif
