/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Table of the instances of the event loop (instance.c, meson.build), and the choice for a scene. */
#include "md/event_loops.h"

#include <assert.h>

#include "md/resolution.h"

/* Names, searches and boundaries of the instances, as in meson.build. Each has a version for one species and one for
 * mixtures; between walls, and in sets compiled quickly (GG_MD_ENTRY_...), the latter serves both. */
#define EACH_INSTANCE(X, BOTH, set)                                                                                    \
  X(cells_periodic, GG_MD_PLAIN_CELLS, GG_MD_PERIODIC, set)                                                            \
  BOTH(cells_walled, GG_MD_PLAIN_CELLS, GG_MD_WALLED, set)                                                             \
  BOTH(cells_falling, GG_MD_PLAIN_CELLS, GG_MD_FALLING, set)                                                           \
  X(rows_sheared, GG_MD_COMOVING_ROWS, GG_MD_SHEARED, set)                                                             \
  X(overlapping_periodic, GG_MD_OVERLAPPING_CELLS, GG_MD_PERIODIC, set)                                                \
  X(overlapping_sheared, GG_MD_OVERLAPPING_ROWS, GG_MD_SHEARED, set)                                                   \
  BOTH(overlapping_walled, GG_MD_OVERLAPPING_CELLS, GG_MD_WALLED, set)                                                 \
  BOTH(overlapping_falling, GG_MD_OVERLAPPING_CELLS, GG_MD_FALLING, set)                                               \
  X(lists_periodic, GG_MD_NEIGHBOUR_LISTS, GG_MD_PERIODIC, set)                                                        \
  X(lists_sheared, GG_MD_NEIGHBOUR_LISTS, GG_MD_SHEARED, set)                                                          \
  BOTH(lists_walled, GG_MD_NEIGHBOUR_LISTS, GG_MD_WALLED, set)                                                         \
  BOTH(lists_falling, GG_MD_NEIGHBOUR_LISTS, GG_MD_FALLING, set)

#define DECLARE_BOTH(name, kind, boundary, set) extern const gg_md_kernel gg_md_kernel_##name##_mixture_##set;
#define DECLARE(name, kind, boundary, set)                                                                             \
  extern const gg_md_kernel gg_md_kernel_##name##_##set;                                                               \
  DECLARE_BOTH(name, kind, boundary, set)
#define ENTRY(name, kind, boundary, set)                                                                               \
  [kind][boundary] = {&gg_md_kernel_##name##_##set, &gg_md_kernel_##name##_mixture_##set},
#define ENTRY_BOTH(name, kind, boundary, set)                                                                          \
  [kind][boundary] = {&gg_md_kernel_##name##_mixture_##set, &gg_md_kernel_##name##_mixture_##set},

#define DECLARE_SET(id, set) EACH_INSTANCE(DECLARE, DECLARE_BOTH, set)
#define TABLE(id, set) [id] = {EACH_INSTANCE(GG_MD_ENTRY_##set, ENTRY_BOTH, set)},

GG_EACH_COMPILED_SET(DECLARE_SET)
extern const gg_md_kernel gg_md_kernel_plain_cells, gg_md_kernel_plain_rows;

static const gg_md_kernel *const simd[GG_INSTRUCTION_SETS][GG_MD_SEARCH_KINDS][GG_MD_FALLING + 1][2] = {
    GG_EACH_COMPILED_SET(TABLE)};

const gg_md_kernel *gg_md_simd_kernel(gg_instructions set, gg_md_search_kind kind, enum gg_md_boundary boundary,
                                      bool mixture)
{
  return simd[set][kind][boundary][mixture];
}

static enum gg_md_boundary boundary_of(const gg_md *e)
{
  if (gg_model_is_sheared(&e->model)) return GG_MD_SHEARED;
  if (e->falls) return GG_MD_FALLING;
  return e->model.walled ? GG_MD_WALLED : GG_MD_PERIODIC;
}

/* True if there are four cells along each axis. Then the nearest image of every grain in the cells around is the image
 * tried.
 */
static bool is_wide_enough(const gg_md *e)
{
  return e->cells.n[0] >= 4 && e->cells.n[1] >= 4 && e->cells.n[2] >= 4;
}

/* True if this engine uses the reference path, one pair at a time: for tests, and for boxes of a few cells. */
static bool uses_plain_path(const gg_md *e, gg_md_search_kind kind)
{
  if (kind == GG_MD_NEIGHBOUR_LISTS || gg_md_search_overlaps(kind)) return false;
  return e->plain || (kind == GG_MD_PLAIN_CELLS && (gg_model_is_sheared(&e->model) || !is_wide_enough(e)));
}

void gg_md_select(gg_md *e)
{
  const gg_md_search_kind kind = e->search.kind;
  if (uses_plain_path(e, kind))
    e->kernel = kind == GG_MD_COMOVING_ROWS ? &gg_md_kernel_plain_rows : &gg_md_kernel_plain_cells;
  else
    e->kernel = gg_md_simd_kernel(gg_simd_instructions_best(), kind, boundary_of(e), e->model.n_species > 1);
  assert(e->kernel);
  gg_md_select_resolution(e);
}
