/* The instances of the event loop (instance.c, meson.build), and which of them a scene needs. */
#include "md/event_loops.h"

#include <assert.h>

/* Both of a row: one species, and two. */
#define DECLARE(name, set) extern const gg_md_kernel gg_md_kernel_##name##_##set, gg_md_kernel_##name##_mixture_##set;
#define BOTH(name, set)                                                                                                \
  {                                                                                                                    \
    &gg_md_kernel_##name##_##set, &gg_md_kernel_##name##_mixture_##set                                                 \
  }

#define DECLARE_SET(id, set)                                                                                           \
  DECLARE(cells_periodic, set)                                                                                         \
  DECLARE(cells_walled, set)                                                                                           \
  DECLARE(cells_falling, set)                                                                                          \
  DECLARE(rows_sheared, set)                                                                                           \
  DECLARE(overlapping_periodic, set)                                                                                   \
  DECLARE(overlapping_sheared, set)                                                                                    \
  DECLARE(lists_periodic, set)                                                                                         \
  DECLARE(lists_sheared, set)

#define TABLE(id, set)                                                                                                 \
  [id] = {                                                                                                             \
      [GG_MD_PLAIN_CELLS] = {[GG_MD_PERIODIC] = BOTH(cells_periodic, set),                                             \
                             [GG_MD_WALLED] = BOTH(cells_walled, set),                                                 \
                             [GG_MD_FALLING] = BOTH(cells_falling, set)},                                              \
      [GG_MD_COMOVING_ROWS] = {[GG_MD_SHEARED] = BOTH(rows_sheared, set)},                                             \
      [GG_MD_OVERLAPPING_CELLS] =                                                                                      \
          {[GG_MD_PERIODIC] = BOTH(overlapping_periodic, set), [GG_MD_SHEARED] = BOTH(overlapping_sheared, set)},      \
      [GG_MD_NEIGHBOUR_LISTS] =                                                                                        \
          {[GG_MD_PERIODIC] = BOTH(lists_periodic, set), [GG_MD_SHEARED] = BOTH(lists_sheared, set)},                  \
  },

GG_EACH_COMPILED_SET(DECLARE_SET)
extern const gg_md_kernel gg_md_kernel_plain_cells, gg_md_kernel_plain_rows;

static const gg_md_kernel *const simd[GG_INSTRUCTION_SETS][GG_MD_COMOVING_ROWS + 1][GG_MD_FALLING + 1][2] = {
    GG_EACH_COMPILED_SET(TABLE)};

const gg_md_kernel *gg_md_simd_kernel(gg_instructions set, enum gg_md_search_way where, enum gg_md_boundary boundary,
                                      bool mixture)
{
  return simd[set][where][boundary][mixture];
}

static enum gg_md_boundary boundary_of(const gg_md *e)
{
  if (e->model.shear_rate != 0) return GG_MD_SHEARED;
  if (e->falls) return GG_MD_FALLING;
  return e->model.walled ? GG_MD_WALLED : GG_MD_PERIODIC;
}

/* The nearest image of all that the cells around hold must be the one tried: four cells along each axis. */
static bool is_wide_enough(const gg_md *e)
{
  return e->cells.n[0] >= 4 && e->cells.n[1] >= 4 && e->cells.n[2] >= 4;
}

/* The reference path, one pair at a time: for tests, and for boxes of a few cells. */
static bool takes_plain_path(const gg_md *e, enum gg_md_search_way where)
{
  if (where == GG_MD_NEIGHBOUR_LISTS || where == GG_MD_OVERLAPPING_CELLS) return false;
  return e->plain || (where == GG_MD_PLAIN_CELLS && (e->model.shear_rate != 0 || !is_wide_enough(e)));
}

void gg_md_select(gg_md *e)
{
  enum gg_md_search_way where = e->skin          ? GG_MD_NEIGHBOUR_LISTS
                                : e->overlapping ? GG_MD_OVERLAPPING_CELLS
                                : e->row         ? GG_MD_COMOVING_ROWS
                                                 : GG_MD_PLAIN_CELLS;
  if (takes_plain_path(e, where))
    e->kernel = e->row ? &gg_md_kernel_plain_rows : &gg_md_kernel_plain_cells;
  else
    e->kernel = gg_md_simd_kernel(gg_simd_instructions_best(), where, boundary_of(e), e->model.n_species > 1);
  assert(e->kernel);
  gg_md_select_resolution(e);
}
