/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Large periodic boxes: grains are pushed apart (place.c) along lists of pairs, which hold over several sweeps, and
 * only where something overlaps or has just moved. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "common/portable_math.h"
#include "md/start/place.h"

/* From so many grains on: places of smaller systems are in stored results. */
enum { LARGE = 50000, FEWEST_CELLS = 3 };
enum { BETWEEN_LOOKS = 1 << 14 }; /* grains: some milliseconds */
/* Pairs are moved further than to where they leave each other alone: fewer sweeps. Lists are used for so many sweeps at
 * least, while too much moves for them to be complete. */
#define BEYOND 1.5
enum { LISTED_SWEEPS = 4 };
#define SKIN 0.25 /* of the widest */

typedef struct lists {
  gg_md_packing *p;
  double margin, skin;
  int32_t n[3];
  double inverse[3]; /* of a cell's width */
  uint32_t *begin, *by_cell, *cell;
  size_t *from, room; /* of i: neighbour[from[i]] to neighbour[from[i + 1]] */
  uint32_t *neighbour;
  gg_vec *listed; /* where grains were when the lists were made */
  /* Sweeps up to which a grain is tried, and up to which those in its margin are pushed away. */
  uint16_t *tried_to, *pushed_to;
  bool all; /* not only those, as lists that were incomplete have been made anew */
  uint64_t overlaps;
  double farthest2; /* from `listed` */
} lists;

bool gg_md_place_has_lists(const gg_md_packing *p)
{
  const double widest = gg_common_model_widest(p->model), least = FEWEST_CELLS * widest * (1.02 + SKIN);
  for (int a = 0; a < 3; a++)
    if (p->box.inverse[a] == 0 || p->box.edge[a] < least) return false;
  return p->n >= LARGE && p->box.offset0 == 0 && p->model->n_surfaces == 0;
}

static size_t cells_of(const lists *l)
{
  return (size_t)l->n[0] * (size_t)l->n[1] * (size_t)l->n[2];
}

static gg_status allocate(lists *l, gg_error *err)
{
  const size_t n = l->p->n;
  l->room = 6 * n;
  l->begin = gg_base_array_new(cells_of(l) + 1, sizeof *l->begin, err);
  l->by_cell = gg_base_array_new(n, sizeof *l->by_cell, err);
  l->cell = gg_base_array_new(n, sizeof *l->cell, err);
  l->from = gg_base_array_new(n + 1, sizeof *l->from, err);
  l->neighbour = gg_base_array_new(l->room, sizeof *l->neighbour, err);
  l->listed = gg_base_array_new(n, sizeof *l->listed, err);
  l->tried_to = gg_base_array_new(n, sizeof *l->tried_to, err);
  l->pushed_to = gg_base_array_new(n, sizeof *l->pushed_to, err);
  const bool all =
      l->begin && l->by_cell && l->cell && l->from && l->neighbour && l->listed && l->tried_to && l->pushed_to;
  return all ? GG_OK : GG_FAILED;
}

static void clear(lists *l)
{
  free(l->begin);
  free(l->by_cell);
  free(l->cell);
  free(l->from);
  free(l->neighbour);
  free(l->listed);
  free(l->tried_to);
  free(l->pushed_to);
}

/* Into the box and its cells, and counted there. */
static void enter_cells(lists *l)
{
  gg_md_packing *p = l->p;
  const size_t cells = cells_of(l);
  memset(l->begin, 0, (cells + 1) * sizeof *l->begin);
  for (uint32_t i = 0; i < p->n; i++) {
    uint32_t cell = 0;
    gg_md_place_into_box(p, i);
    for (int a = 2; a >= 0; a--) {
      const int32_t k = (int32_t)(gg_along(&p->r[i], a) * l->inverse[a]);
      cell = cell * (uint32_t)l->n[a] + (uint32_t)gg_md_within(k, l->n[a]);
    }
    l->listed[i] = p->r[i];
    l->cell[i] = cell;
    l->begin[cell + 1]++;
  }
  for (size_t c = 0; c < cells; c++) l->begin[c + 1] += l->begin[c];
  for (uint32_t i = p->n; i-- > 0;) l->by_cell[--l->begin[l->cell[i] + 1]] = i;
  memmove(l->begin, l->begin + 1, cells * sizeof *l->begin);
  l->begin[cells] = p->n;
}

/* Those of a cell that come after grain i, or all. */
static bool list_cell(lists *l, uint32_t i, uint32_t cell, bool own, size_t *n)
{
  const gg_md_packing *p = l->p;
  const uint32_t count = l->begin[cell + 1] - l->begin[cell];
  if (*n + count > l->room) {
    uint32_t *more = realloc(l->neighbour, 2 * (l->room + count) * sizeof *more);
    if (!more) return false;
    l->neighbour = more;
    l->room = 2 * (l->room + count);
  }
  for (uint32_t k = l->begin[cell]; k < l->begin[cell + 1]; k++) {
    const uint32_t j = l->by_cell[k];
    gg_vec dr = gg_sub(p->r[j], p->r[i]), unused = {0, 0, 0};
    gg_md_minimum_image(&p->box, false, 0, &dr, &unused);
    const double reach = 0.5 * (p->diameter[i] + p->diameter[j]) * (1 + l->margin) + l->skin;
    l->neighbour[*n] = j;
    *n += (gg_dot(dr, dr) < reach * reach) & (!own | (j > i));
  }
  return true;
}

/* Asked at every grain, it looks at some. */
static gg_status check_stop(const lists *l, uint32_t i, gg_error *err)
{
  if (i == 0 || i % BETWEEN_LOOKS != 0 || !gg_stop_asked(l->p->stop)) return GG_OK;
  return gg_base_fail(err, GG_INTERRUPTED, "md: interrupted while grains were placed");
}

/* All pairs, each once: with the own cell and the thirteen behind it. */
static gg_status make_lists(lists *l, gg_error *err)
{
  enter_cells(l);
  size_t n = 0;
  for (uint32_t i = 0; i < l->p->n; i++) {
    GG_TRY(check_stop(l, i, err));
    const int32_t c = (int32_t)l->cell[i], at[3] = {c % l->n[0], c / l->n[0] % l->n[1], c / (l->n[0] * l->n[1])};
    l->from[i] = n;
    for (int q = 13; q < 27; q++) {
      uint32_t cell = 0;
      for (int a = 2, step[3] = {q % 3 - 1, q / 3 % 3 - 1, q / 9 - 1}; a >= 0; a--) {
        const int32_t k = at[a] + step[a];
        cell = cell * (uint32_t)l->n[a] + (uint32_t)(k < 0 ? k + l->n[a] : k >= l->n[a] ? k - l->n[a] : k);
      }
      if (!list_cell(l, i, cell, q == 13, &n))
        return gg_base_out_of_memory_for(err, "the lists of grains that overlap");
    }
  }
  l->from[l->p->n] = n;
  l->farthest2 = 0;
  return GG_OK;
}

GG_INLINE void move(lists *l, uint32_t i, double by, gg_vec dr, uint16_t sweep, bool overlaps)
{
  gg_vec *r = &l->p->r[i];
  *r = gg_axpy(by, dr, *r);
  l->tried_to[i] = (uint16_t)(sweep + 1);
  if (overlaps) l->pushed_to[i] = (uint16_t)(sweep + 2);
  const gg_vec way = gg_sub(*r, l->listed[i]);
  const double far2 = gg_dot(way, way);
  if (far2 > l->farthest2) l->farthest2 = far2;
}

GG_INLINE void push_pair(lists *l, uint32_t i, uint32_t j, uint16_t sweep, bool pushing)
{
  gg_md_packing *p = l->p;
  gg_vec dr = gg_sub(p->r[j], p->r[i]), unused = {0, 0, 0};
  gg_md_minimum_image(&p->box, false, 0, &dr, &unused);
  const double sigma = 0.5 * (p->diameter[i] + p->diameter[j]), wanted = sigma * (1 + l->margin), r2 = gg_dot(dr, dr);
  if (r2 >= wanted * wanted) return;
  double distance = sqrt(r2);
  const bool overlaps = distance < sigma * (1 + GG_MD_TOUCHING);
  l->overlaps += overlaps;
  if (!pushing || !(overlaps || l->pushed_to[i] >= sweep || l->pushed_to[j] >= sweep)) return;
  if (distance == 0) dr = (gg_vec){1e-3, 0, 0}, distance = 1e-3;
  const double push = 0.5 * BEYOND * (wanted - distance) / distance;
  move(l, i, -push, dr, sweep, overlaps);
  move(l, j, push, dr, sweep, overlaps);
}

/* Those that may have changed; not pushing: all. */
static gg_status sweep_lists(lists *l, uint16_t sweep, bool pushing, gg_error *err)
{
  const gg_md_packing *p = l->p;
  l->overlaps = 0;
  for (uint32_t i = 0; i < p->n; i++) {
    GG_TRY(check_stop(l, i, err));
    const bool tried = l->all || !pushing || l->tried_to[i] >= sweep;
    for (size_t k = l->from[i]; k < l->from[i + 1]; k++) {
      const uint32_t j = l->neighbour[k];
      if (tried || l->tried_to[j] >= sweep) push_pair(l, i, j, sweep, pushing);
    }
  }
  return GG_OK;
}

/* Lists in which nobody has moved so far that pairs may be missing. */
static bool are_complete(const lists *l)
{
  return l->farthest2 <= 0.25 * l->skin * l->skin;
}

static gg_status relax(lists *l, int most_sweeps, bool *free, gg_error *err)
{
  GG_TRY(allocate(l, err));
  l->farthest2 = INFINITY;
  for (int k = 0, age = 0; k < most_sweeps && !*free; k++, age++) {
    l->all = !are_complete(l) && (k == 0 || age >= LISTED_SWEEPS || l->overlaps == 0);
    if (l->all) {
      GG_TRY(make_lists(l, err));
      age = 0;
    }
    GG_TRY(sweep_lists(l, (uint16_t)k, true, err));
    if (l->overlaps || !are_complete(l)) continue;
    GG_TRY(sweep_lists(l, (uint16_t)k, false, err));
    *free = l->overlaps == 0;
  }
  return GG_OK;
}

gg_status gg_md_place_relax_lists(gg_md_packing *p, double margin, int most_sweeps, bool *free, gg_error *err)
{
  const double widest = gg_common_model_widest(p->model);
  lists l = {.p = p, .margin = margin, .skin = SKIN * widest};
  const double reach = fmax(widest * (1 + margin) + l.skin, gg_root(p->model->volume / p->n, 3));
  gg_md_cells_count(&p->box, reach, l.n);
  for (int a = 0; a < 3; a++) l.inverse[a] = l.n[a] / p->box.edge[a];
  *free = false;
  gg_status status = relax(&l, most_sweeps, free, err);
  for (uint32_t i = 0; i < p->n; i++) gg_md_place_into_box(p, i);
  clear(&l);
  return status;
}
