/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "md/start/pair_lists.h"

#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "base/thread_pool.h"
#include "common/portable_math.h"

enum { PARTS = GG_MD_PLACE_PARTS };

static size_t cells_of(const gg_md_pair_lists *l)
{
  return (size_t)l->n[0] * (size_t)l->n[1] * (size_t)l->n[2];
}

static gg_status make_part(gg_md_pair_part *part, uint64_t n, uint64_t k, gg_error *err)
{
  part->first = (uint32_t)(n * k / PARTS);
  part->end = (uint32_t)(n * (k + 1) / PARTS);
  const size_t grains = part->end - part->first;
  part->room = 6 * grains;
  part->room_across = grains;
  part->from = gg_base_array_new(grains + 1, sizeof *part->from, err);
  part->neighbour = gg_base_array_new(part->room, sizeof *part->neighbour, err);
  part->across = gg_base_array_new(part->room_across, sizeof *part->across, err);
  return part->from && part->neighbour && part->across ? GG_OK : GG_FAILED;
}

gg_status gg_md_pair_lists_make(gg_md_pair_lists *l, gg_md_packing *p, double margin, double skin, gg_error *err)
{
  const size_t n = p->n;
  *l = (gg_md_pair_lists){.p = p, .margin = margin, .skin = skin};
  const double reach = gg_common_model_widest(p->model) * (1 + margin) + skin;
  gg_md_cells_count(&p->box, fmax(reach, gg_root(p->model->volume / p->n, 3)), l->n);
  for (int a = 0; a < 3; a++) l->inverse[a] = l->n[a] / p->box.edge[a];
  l->begin = gg_base_array_new(cells_of(l) + 1, sizeof *l->begin, err);
  l->cell = gg_base_array_new(n, sizeof *l->cell, err);
  l->before = gg_base_array_new(n, sizeof *l->before, err);
  l->rank = gg_base_array_new(n, sizeof *l->rank, err);
  l->grain = gg_base_array_new(n, sizeof *l->grain, err);
  l->listed = gg_base_array_new(n, sizeof *l->listed, err);
  if (!l->begin || !l->cell || !l->rank || !l->before || !l->grain || !l->listed) return GG_FAILED;
  for (uint64_t k = 0; k < PARTS; k++) GG_TRY(make_part(&l->part[k], n, k, err));
  return GG_OK;
}

void gg_md_pair_lists_free(gg_md_pair_lists *l)
{
  for (int k = 0; k < PARTS; k++) {
    free(l->part[k].from);
    free(l->part[k].neighbour);
    free(l->part[k].across);
  }
  free(l->begin);
  free(l->cell);
  free(l->rank);
  free(l->before);
  free(l->grain);
  free(l->listed);
}

static void enter_cells(void *context, int k)
{
  gg_md_pair_lists *l = context;
  gg_md_packing *p = l->p;
  for (uint32_t i = l->part[k].first; i < l->part[k].end; i++) {
    uint32_t cell = 0;
    gg_md_place_into_box(p, i);
    l->before[i] = p->r[i];
    for (int a = 2; a >= 0; a--) {
      const int32_t at = (int32_t)(gg_along(&p->r[i], a) * l->inverse[a]);
      cell = cell * (uint32_t)l->n[a] + (uint32_t)gg_md_within(at, l->n[a]);
    }
    l->cell[i] = cell;
  }
}

/* Count grains by cell, and number them within it. */
static void count_cells(gg_md_pair_lists *l)
{
  const size_t cells = cells_of(l);
  memset(l->begin, 0, (cells + 1) * sizeof *l->begin);
  for (uint32_t i = 0; i < l->p->n; i++) l->rank[i] = l->begin[l->cell[i] + 1]++;
  for (size_t c = 0; c < cells; c++) l->begin[c + 1] += l->begin[c];
}

static void order(void *context, int k)
{
  gg_md_pair_lists *l = context;
  const gg_md_packing *p = l->p;
  for (uint32_t i = l->part[k].first; i < l->part[k].end; i++) {
    const uint32_t rank = l->rank[i] += l->begin[l->cell[i]];
    l->grain[rank] = i;
    l->listed[rank] = (gg_md_listed){p->r[i], 0.5 * (p->diameter[i] * (1 + l->margin) + l->skin)};
  }
}

static bool grow(void **items, size_t *room, size_t least, size_t size)
{
  if (least <= *room) return true;
  void *more = realloc(*items, 2 * least * size);
  if (!more) return false;
  *items = more, *room = 2 * least;
  return true;
}

/* Find the grains from `rank` to `end`, displaced by `image`, that are within reach of `self`. Returns their number. */
static size_t scan(const gg_md_pair_lists *l, gg_md_listed self, gg_vec image, uint32_t rank, uint32_t end,
                   uint32_t *found)
{
  size_t n = 0;
  const gg_vec r = gg_sub(self.r, image);
  for (; rank < end; rank++) {
    const gg_vec dr = gg_sub(l->listed[rank].r, r);
    const double reach = self.reach + l->listed[rank].reach;
    found[n] = l->grain[rank];
    n += gg_dot(dr, dr) < reach * reach;
  }
  return n;
}

/* A run of cells along x, from -1 to n_x, of one row. */
typedef struct run {
  int32_t from, to;
  uint32_t row; /* index of its cell 0 */
  gg_vec image;
} run;

/* Scan a run, in up to three pieces by images; the first piece begins at `rank` if that is not 0. False: out of memory.
 */
static bool scan_run(const gg_md_pair_lists *l, gg_md_pair_part *part, size_t *n, gg_md_listed self, run x,
                     uint32_t rank)
{
  const double edge = l->p->box.edge[0];
  for (int32_t at = x.from, to; at <= x.to; at = to + 1) {
    const int32_t layer = at < 0 ? -1 : at >= l->n[0];
    to = layer || x.to < l->n[0] ? (layer ? at : x.to) : l->n[0] - 1;
    const uint32_t cell = x.row + (uint32_t)(at - layer * l->n[0]), last = cell + (uint32_t)(to - at);
    const uint32_t begin = rank ? rank : l->begin[cell], end = l->begin[last + 1];
    const gg_vec image = {x.image.x + layer * edge, x.image.y, x.image.z};
    if (!grow((void **)&part->neighbour, &part->room, *n + (end - begin), sizeof *part->neighbour)) return false;
    *n += scan(l, self, image, begin, end, part->neighbour + *n);
    rank = 0;
  }
  return true;
}

static run run_of(const gg_md_pair_lists *l, const int32_t at[3], int dy, int dz)
{
  int32_t to[3] = {0, at[1] + dy, at[2] + dz};
  double image[3] = {0, 0, 0};
  for (int a = 1; a < 3; a++) {
    const int32_t layer = to[a] < 0 ? -1 : to[a] >= l->n[a];
    to[a] -= layer * l->n[a];
    image[a] = layer * l->p->box.edge[a];
  }
  return (run){at[0] - 1, at[0] + 1, (uint32_t)((to[2] * l->n[1] + to[1]) * l->n[0]), {0, image[1], image[2]}};
}

/* Separate the neighbours of grain i: those of its own part stay, in their order; the others go to `across`. */
static bool split(gg_md_pair_part *part, uint32_t i, size_t from, size_t *end)
{
  size_t n = from;
  if (!grow((void **)&part->across, &part->room_across, part->n_across + (*end - from), sizeof *part->across))
    return false;
  for (size_t k = from; k < *end; k++) {
    const uint32_t j = part->neighbour[k];
    if (j - part->first < part->end - part->first) {
      part->neighbour[n++] = j;
    } else {
      part->across[part->n_across][0] = i;
      part->across[part->n_across++][1] = j;
    }
  }
  *end = n;
  return true;
}

/* Offsets, along y and z, of the rows behind the row of a cell. */
static const int behind[4][2] = {{1, 0}, {-1, 1}, {0, 1}, {1, 1}};

/* List the pairs of a part: each grain with the rest of its own cell and the thirteen cells behind it. */
static bool fill_part(const gg_md_pair_lists *l, gg_md_pair_part *part)
{
  size_t n = 0;
  part->n_across = 0;
  for (uint32_t i = part->first; i < part->end; i++) {
    if (i % GG_MD_PLACE_PER_POLL == 0 && gg_md_place_is_stopped(l->p)) return true;
    const size_t from = part->from[i - part->first] = n;
    const int32_t c = (int32_t)l->cell[i], at[3] = {c % l->n[0], c / l->n[0] % l->n[1], c / (l->n[0] * l->n[1])};
    const gg_md_listed self = l->listed[l->rank[i]];
    run own = run_of(l, at, 0, 0);
    own.from = at[0];
    if (!scan_run(l, part, &n, self, own, l->rank[i] + 1)) return false;
    for (int q = 0; q < 4; q++)
      if (!scan_run(l, part, &n, self, run_of(l, at, behind[q][0], behind[q][1]), 0)) return false;
    if (!split(part, i, from, &n)) return false;
  }
  part->from[part->end - part->first] = n;
  return true;
}

static void fill(void *context, int k)
{
  gg_md_pair_lists *l = context;
  l->part[k].failed = !fill_part(l, &l->part[k]);
}

gg_status gg_md_pair_lists_fill(gg_md_pair_lists *l, gg_error *err)
{
  gg_base_thread_pool_for(l->p->pool, PARTS, enter_cells, l);
  count_cells(l);
  gg_base_thread_pool_for(l->p->pool, PARTS, order, l);
  gg_base_thread_pool_for(l->p->pool, PARTS, fill, l);
  if (l->p->stopped) return gg_md_place_interrupted(err);
  for (int k = 0; k < PARTS; k++)
    if (l->part[k].failed) return gg_base_out_of_memory_for(err, "the lists of grains that overlap");
  return GG_OK;
}
