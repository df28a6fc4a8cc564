/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Choice of the neighbour search and its cells. */
#include <math.h>

#include "common/portable_math.h"
#include "common/surface/shapes.h"
#include "md/row_motion.h"
#include "md/select_search.h"

/* Limits of the fastest search, measured with elastic grains: solid fractions phi, ratios of diameters, grains per
 * cell. */
#define OVERLAPPING_BELOW 0.05          /* phi below: overlapping cells */
#define GRAINS_PER_OVERLAPPING_CELL 6.0 /* in them */
#define LISTED_FROM 0.4                 /* phi from: neighbour lists */
#define LISTED_UNEQUAL_FROM 0.45        /* the same for unequal diameters */
#define NEARLY_EQUAL 1.3                /* ratio up to which diameters are not unequal */
#define MOST_UNEQUAL_LISTED 2.0         /* ratio up to which grains have lists */
#define NARROW_FROM 0.25                /* phi from: plain cells of one contact distance */
#define GRAINS_PER_CELL 0.7             /* in plain cells below: fewer crossings against more candidates */
enum {
  FEWEST_OVERLAPPING = 6, /* cells along an edge */
  FEWEST_IN_SMALL =
      30000 /* grains from which cells of one contact distance are small; else the cache holds larger ones */
};

double gg_md_reach(const gg_model *m)
{
  return gg_common_model_widest(m) * (1 + 1e-9);
}

static double mean_diameter(const gg_model *m)
{
  double sum = 0;
  for (int i = 0; i < m->n_species; i++) sum += (double)m->n_of[i] * m->diameter[i];
  return sum / (double)m->n;
}

/* True if cells must not overlap. A ridge is searched in one cell; above an open top a cell holds any number of grains.
 */
static bool needs_plain_cells(const gg_model *m)
{
  for (int w = 0; w < m->n_surfaces; w++)
    if (m->surface[w].shape != GG_SHAPE_plane) return true;
  return gg_common_surface_is_open_above(m);
}

/* True if moving walls, or gravity along walls, drive a flow. It would carry grains out of skins at rest. */
static bool flows_along_walls(const gg_model *m)
{
  for (int w = 0; w < m->n_surfaces; w++)
    if (m->surface[w].velocity.x != 0) return true;
  return m->gravity[0] != 0 || m->gravity[2] != 0;
}

/* Radius of the skins; 0: no lists. Grains leave wide skins seldom, but wide skins make long lists. Lists of grains of
 * very unequal size would be too long, and the largest grains would determine the width of cells. */
static double skin_radius(const gg_model *m)
{
  double ratio = gg_common_model_widest(m) / gg_common_model_narrowest(m);
  double from = ratio > NEARLY_EQUAL ? LISTED_UNEQUAL_FROM : LISTED_FROM;
  if (needs_plain_cells(m) || flows_along_walls(m) || m->phi < from || ratio > MOST_UNEQUAL_LISTED) return 0;
  return mean_diameter(m) * fmin(0.34, 0.3 + 0.8 * (0.5 - m->phi));
}

static void count_cells(const gg_model *m, double width, int32_t n[3])
{
  gg_md_cells_count(&(gg_md_box){.edge = {m->box[0], m->box[1], m->box[2]}}, width, n);
}

bool gg_md_fit_lists(const gg_model *m, double radius, int32_t n[3])
{
  double reach = gg_md_reach(m) + 2 * radius;
  count_cells(m, reach, n);
  for (int a = 0; a < 3; a++)
    if (n[a] < 3 || m->box[a] < 2 * reach + 4 * radius) return false;
  return true;
}

/* Count overlapping cells. Returns false if the box is so small that a pair in a cell could have two minimum images,
 * or if gravity could collect so many grains in the lowest cells that these overflow. */
static bool fit_overlapping(const gg_model *m, int32_t n[3])
{
  if (needs_plain_cells(m) || m->gravity[1] != 0 || m->phi >= OVERLAPPING_BELOW) return false;
  double narrowest = 3 * gg_md_reach(m);
  count_cells(m, fmax(narrowest, gg_root(GRAINS_PER_OVERLAPPING_CELL * m->volume / (double)m->n, 3)), n);
  for (int a = 0; a < 3; a++) {
    if (n[a] < FEWEST_OVERLAPPING) n[a] = FEWEST_OVERLAPPING;
    if (m->box[a] < narrowest * n[a]) return false;
  }
  return true;
}

static void fit_cells(const gg_model *m, int32_t n[3])
{
  double width = gg_md_reach(m);
  if (m->phi < NARROW_FROM) width = fmax(width, gg_root(GRAINS_PER_CELL * m->volume / (double)m->n, 3));
  count_cells(m, width, n);
}

gg_md_search_kind gg_md_search_select(const gg_model *m, double *radius, int32_t n[3])
{
  *radius = skin_radius(m);
  if (*radius > 0 && gg_md_fit_lists(m, *radius, n)) return GG_MD_NEIGHBOUR_LISTS;
  *radius = 0;
  if (fit_overlapping(m, n)) return gg_model_is_sheared(m) ? GG_MD_OVERLAPPING_ROWS : GG_MD_OVERLAPPING_CELLS;
  fit_cells(m, n);
  bool comoving = gg_model_is_sheared(m) && n[0] >= GG_MD_FEWEST_COMOVING && n[1] >= 4 && n[2] >= 4;
  return comoving ? GG_MD_COMOVING_ROWS : GG_MD_PLAIN_CELLS;
}

bool gg_md_has_small_cells(const gg_model *m, gg_md_search_kind kind)
{
  if (kind != GG_MD_PLAIN_CELLS && kind != GG_MD_COMOVING_ROWS) return false;
  const bool unequal = gg_common_model_widest(m) > NEARLY_EQUAL * gg_common_model_narrowest(m);
  return m->n >= FEWEST_IN_SMALL && m->phi >= NARROW_FROM && !m->walled && !unequal;
}

double gg_md_crossings_per_collision(const gg_model *m)
{
  double radius, rate = 0, T = m->temperature0;
  int32_t n[3];
  if (gg_md_search_select(m, &radius, n) == GG_MD_NEIGHBOUR_LISTS) return 0;
  for (int i = 0; i < m->n_species; i++)
    for (int a = 0; a < 3; a++) /* <|v_a|> over the width of a cell */
      rate += (double)m->n_of[i] / (double)m->n * sqrt(2 * T / (M_PI * m->mass[i])) * n[a] / m->box[a];
  return 2 * rate / gg_common_model_collision_rate(m, T); /* a collision has two grains */
}
