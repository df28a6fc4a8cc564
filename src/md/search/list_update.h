/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Update of neighbour lists: the grains within reach of a new skin, and the lists that change. */
#ifndef GG_MD_SEARCH_LIST_UPDATE_H
#define GG_MD_SEARCH_LIST_UPDATE_H

#include "md/predict.h"
#include "md/search/candidates.h"
#include "simd/axes.h"

GG_INLINE uint32_t *gg_md_list(const gg_md *e, uint32_t i)
{
  return e->search.lists.neighbour + (size_t)i * GG_MD_LIST;
}

/* Collect the grains of all cells that can hold centres within rho of the centre of skin i, under shear. Without room
 * for all of them n_candidates is GG_MD_MOST_CANDIDATES. */
GG_INLINE void gg_md_collect_sheared(const gg_md *e, uint32_t i, gg_md_search *s)
{
  const gg_md_cells *c = &e->cells;
  const int32_t *at = e->node[i].cell;
  gg_vec centre = e->search.lists.skin[i].centre;
  double rho = c->reach, strain = e->model.shear_rate * e->k.now;
  s->n_candidates = 0;
  for (int32_t z = at[2] - 1; z <= at[2] + 1; z++) {
    if (z * c->width[2] > centre.z + rho || (z + 1) * c->width[2] < centre.z - rho) continue;
    for (int32_t y = at[1] - 1; y <= at[1] + 1; y++) {
      gg_vec shift = {0, 0, 0};
      int32_t iy = gg_md_image_cell(e, 1, y, &shift.y), iz = gg_md_image_cell(e, 2, z, &shift.z);
      shift.x = shift.y > 0 ? e->box.offset0 : shift.y < 0 ? -e->box.offset0 : 0;
      double below = y * c->width[1] - centre.y, above = (y + 1) * c->width[1] - centre.y;
      if (below > rho || above < -rho) continue;
      if (below < -rho) below = -rho;
      if (above > rho) above = rho;
      const double most = strain < 0 ? strain * below : strain * above,
                   least = strain < 0 ? strain * above : strain * below;
      int32_t from = (int32_t)gg_floor((centre.x - rho - most - shift.x) * c->inverse[0]);
      int32_t to = (int32_t)gg_floor((centre.x + rho - least - shift.x) * c->inverse[0]);
      if (to - from >= c->n[0]) to = from + c->n[0] - 1;
      const uint32_t *row = gg_md_cell_at(c, (int32_t[3]){0, iy, iz});
      for (int32_t k = from; k <= to; k++) {
        int32_t x = k;
        while (x < 0) x += c->n[0];
        while (x >= c->n[0]) x -= c->n[0];
        if (!gg_md_take_cell(s, row + (size_t)x * c->stride)) s->n_candidates = GG_MD_MOST_CANDIDATES;
      }
    }
  }
}

/* Indices of the 27 cells around a grain, and a bit for each cell that a sphere of radius rho about its skin's centre
 * reaches. */
typedef struct gg_md_nearby {
  uint32_t index[28], which; /* x fastest */
} gg_md_nearby;

GG_INLINE void gg_md_cells_nearby(const gg_md *e, uint32_t i, gg_md_nearby *nearby)
{
  typedef uint32_t words __attribute__((vector_size(16)));
  typedef uint32_t words_there __attribute__((vector_size(16), may_alias, aligned(4)));
  const gg_md_cells *c = &e->cells;
  const int32_t *at = e->node[i].cell;
  const uint32_t *y = c->part[1] + at[1], *z = c->part[2] + at[2];
  words x = *(const words_there *)(c->part[0] + at[0] - 1);
  double below[3], above[3]; /* squared distances to the cells below and above along each axis */
  for (int a = 0; a < 3; a++) {
    double depth = gg_along(&e->search.lists.skin[i].centre, a) - at[a] * c->width[a], rest = c->width[a] - depth;
    below[a] = depth * depth;
    above[a] = rest * rest;
  }
  if (IS_WALLED && at[1] == 0) below[1] = INFINITY;
  if (IS_WALLED && at[1] == c->n[1] - 1) above[1] = INFINITY;
  gg_axes far = {below[0], 0, above[0], INFINITY};
  double far_y[3] = {below[1], 0, above[1]}, far_z[3] = {below[2], 0, above[2]}, rho2 = c->reach * c->reach;
  nearby->which = 0;
  for (int m = 0; m < 3; m++)
    for (int l = 0; l < 3; l++) {
      int row = 3 * (3 * m + l);
      *(words_there *)(nearby->index + row) = x + (z[m - 1] + y[l - 1]);
      nearby->which |= gg_axes_bits(far < rho2 - far_z[m] - far_y[l]) << row;
    }
}

/* Collect the grains of all cells that can hold centres within rho, without shear. */
GG_INLINE void gg_md_collect_near(const gg_md *e, uint32_t i, gg_md_search *s)
{
  gg_md_nearby nearby;
  gg_md_cells_nearby(e, i, &nearby);
  bool room = gg_md_has_room(e, 27);
  const uint32_t *cells = e->cells.cell;
  size_t stride = e->cells.stride;
  uint32_t n = 0;
  for (uint32_t which = nearby.which; which; which &= which - 1) {
    const uint32_t *cell = cells + nearby.index[__builtin_ctz(which)] * stride;
    if (room || n + cell[0] <= GG_MD_MOST_CANDIDATES)
      n = gg_md_append_cell(s->candidates, n, cell);
    else
      n = GG_MD_MOST_CANDIDATES;
  }
  s->n_candidates = n;
}

/* Load the centres of a batch of skins as columns. */
GG_INLINE void gg_md_gather_centres(const gg_md_skin *skin, const uint32_t *index, gg_vd *x, gg_vd *y, gg_vd *z)
{
  const gg_row *row[GG_WIDTH];
  gg_vd column[4];
  for (int l = 0; l < GG_WIDTH; l++) row[l] = &skin[index[l]].centre.x;
  gg_batch_columns(row, column);
  *x = column[0], *y = column[1], *z = column[2];
}

/* Room for a full list, and for a batch of entries that are written before they are counted. */
enum { GG_MD_FOUND = GG_MD_LIST + 1 + GG_WIDTH };

/* Search for the grains whose skin centres are within rho of that of skin i, into found[GG_MD_FOUND]. Returns their
 * number; more than GG_MD_LIST: too many. */
GG_INLINE uint32_t gg_md_search_skin(const gg_md *e, uint32_t i, uint32_t *found)
{
  gg_md_search s = {.candidates = e->candidates};
  if (IS_SHEARED)
    gg_md_collect_sheared(e, i, &s);
  else
    gg_md_collect_near(e, i, &s);
  uint32_t *candidates = s.candidates, n = s.n_candidates, count = 0;
  const gg_vec centre = e->search.lists.skin[i].centre;
  const double *L = e->box.edge, *inverse = e->box.inverse;
  double strain = IS_SHEARED ? e->model.shear_rate * e->k.now : 0;
  const double *reaches =
      e->search.lists.reach + (IS_MIXTURE ? gg_md_pair(&e->contacts, gg_md_species_of(&e->grain[i]), 0) : 0);
  for (int l = 0; l < GG_WIDTH; l++) candidates[n + (uint32_t)l] = e->n;
  for (uint32_t k = 0; k < n && count <= GG_MD_LIST; k += GG_WIDTH) {
    gg_vd x, y, z, reach = gg_all(reaches[0]);
    gg_md_gather_centres(e->search.lists.skin, candidates + k, &x, &y, &z);
    for (int l = 0; IS_MIXTURE && l < GG_WIDTH; l++)
      reach[l] = reaches[gg_md_species_of(&e->grain[candidates[k + (uint32_t)l]])];
    x -= centre.x, y -= centre.y, z -= centre.z;
    gg_vd layers = gg_batch_nearest(y * inverse[1]);
    y -= L[1] * layers;
    if (IS_SHEARED) x += strain * y - layers * e->box.offset0;
    x -= L[0] * gg_batch_nearest(x * inverse[0]);
    z -= L[2] * gg_batch_nearest(z * inverse[2]);
    count += gg_batch_pick(found + count, candidates + k, i, gg_less(x * x + y * y + z * z, reach * reach));
  }
  return n == GG_MD_MOST_CANDIDATES ? GG_MD_LIST + 1 : count;
}

/* Replace a grain by its image in the box at the time `now`. Returns the centre of a new skin around it. */
GG_INLINE gg_vec gg_md_into_box(const gg_md *e, double now, gg_md_grain *g)
{
  double layers = gg_floor(g->r.y * e->box.inverse[1]);
  g->r.y -= layers * e->box.edge[1];
  if (IS_SHEARED && layers != 0) {
    g->r.x -= layers * gg_md_offset(&e->box, now);
    g->v.x -= layers * e->box.image_velocity;
  }
  g->r.x = gg_wrap(g->r.x, e->box.edge[0], e->box.inverse[0]);
  g->r.z = gg_wrap(g->r.z, e->box.edge[2], e->box.inverse[2]);
  gg_vec centre = g->r;
  if (IS_SHEARED) {
    centre.x -= e->model.shear_rate * (centre.y - 0.5 * e->box.edge[1]) * now;
    centre.x = gg_wrap(centre.x, e->box.edge[0], e->box.inverse[0]);
  }
  return centre;
}

/* Renew the skin of grain i around its present position: image in the box, centre, cell. It does not enter the cell
 * yet. */
GG_INLINE void gg_md_new_skin(gg_md *e, uint32_t i)
{
  gg_md_node *node = &e->node[i];
  gg_md_grain *g = gg_md_synchronise(e, i);
  const gg_vec was = g->r, centre = gg_md_into_box(e, e->k.now, g);
  if (e->image) gg_md_count_image(e, i, was);
  e->search.lists.skin[i] = (gg_md_skin){centre};
  node->skin_time = e->k.now;
  gg_md_cell_of(&e->cells, centre, node->cell);
}

GG_INLINE void gg_md_list_clear(gg_md *e, uint32_t i)
{
  uint32_t *list = gg_md_list(e, i);
  for (int k = 0; k < GG_MD_LIST; k++) list[k] = e->n;
  e->node[i].neighbours = 0;
}

/* Append j to the list of i. False: the list is full. Behind its last entry a list holds the grain at position NaN. */
GG_INLINE bool gg_md_list_add(gg_md *e, uint32_t i, uint32_t j)
{
  if (e->node[i].neighbours == GG_MD_LIST) return false;
  gg_md_list(e, i)[e->node[i].neighbours++] = j;
  return true;
}

/* Places of a grain in a list of GG_MD_LIST, a bit each. */
GG_INLINE uint32_t gg_md_list_places(const uint32_t *list, uint32_t j)
{
  return gg_words_equal16(list, j) | gg_words_equal8(list + 16, j) << 16;
}

GG_INLINE void gg_md_list_remove(gg_md *e, uint32_t i, uint32_t j)
{
  uint32_t *list = gg_md_list(e, i), last = --e->node[i].neighbours;
  list[__builtin_ctz(gg_md_list_places(list, j))] = list[last];
  list[last] = e->n;
}

/* Replace the list of i by found[], and update the lists of the grains that are removed from it or new in it. False: a
 * list is full. */
GG_INLINE bool gg_md_update_lists(gg_md *e, uint32_t i, const uint32_t *found, uint32_t count)
{
  uint32_t old[GG_MD_LIST], *list = gg_md_list(e, i), n_old = e->node[i].neighbours, still = 0, fresh = 0;
  if (count > GG_MD_LIST) return false;
  for (int k = 0; k < GG_MD_LIST; k++) old[k] = list[k], list[k] = (uint32_t)k < count ? found[k] : e->n;
  e->node[i].neighbours = count;
  for (uint32_t k = 0; k < count; k++) {
    uint32_t places = gg_md_list_places(old, found[k]);
    still |= places;
    fresh |= (uint32_t)(places == 0) << k;
  }
  for (uint32_t gone = gg_lowest_bits(n_old) & ~still; gone; gone &= gone - 1)
    gg_md_list_remove(e, old[__builtin_ctz(gone)], i);
  for (; fresh; fresh &= fresh - 1)
    if (!gg_md_list_add(e, found[__builtin_ctz(fresh)], i)) return false;
  return true;
}

#endif
