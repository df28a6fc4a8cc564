/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "md/cell_grid.h"

#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "md/aligned_memory.h"

enum {
  FEWEST_WORDS = 8, /* of a cell that is not small */
  MOST_BEHIND = 16  /* words that may be read behind the last cell */
};

void gg_md_cells_count(const gg_md_box *box, double width, int32_t n[3])
{
  for (int a = 0; a < 3; a++) {
    double fit = gg_floor(box->edge[a] / width);
    n[a] = fit < 1 ? 1 : fit > 65535 ? 65535 : (int32_t)fit;
  }
}

static gg_status make(gg_md_cells *c, const gg_md_box *box, const int32_t n[3], gg_error *err)
{
  size_t total = 1;
  for (int a = 0; a < 3; a++) {
    c->n[a] = n[a];
    c->width[a] = box->edge[a] / n[a];
    c->inverse[a] = n[a] / box->edge[a];
    total *= (size_t)n[a];
  }
  for (int a = 0, each = 1; a < 3; each *= n[a], a++) {
    uint32_t *part = gg_base_array_new((size_t)n[a] + 4, sizeof *part, err);
    if (!part) return GG_FAILED;
    for (int32_t k = -2; k <= n[a] + 1; k++) part[k + 2] = (uint32_t)((k + 2 * n[a]) % n[a] * each);
    c->part[a] = part + 2;
  }
  c->cell = gg_md_new_lines(total * c->stride + MOST_BEHIND, sizeof *c->cell, err);
  return c->cell ? GG_OK : GG_FAILED;
}

gg_status gg_md_cells_make(gg_md_cells *c, const gg_md_box *box, const int32_t n[3], double reach, gg_error *err)
{
  *c = (gg_md_cells){.reach = reach, .stride = FEWEST_WORDS};
  return make(c, box, n, err);
}

gg_status gg_md_cells_make_small(gg_md_cells *c, const gg_md_box *box, const int32_t n[3], double reach,
                                 uint32_t grains, gg_error *err)
{
  *c = (gg_md_cells){.reach = reach, .stride = GG_MD_SMALL_CELL};
  c->next = gg_md_new_lines(grains, sizeof *c->next, err);
  return c->next ? make(c, box, n, err) : GG_FAILED;
}

static size_t total_of(const gg_md_cells *c)
{
  return (size_t)c->n[0] * (size_t)c->n[1] * (size_t)c->n[2];
}

void gg_md_cells_clear(gg_md_cells *c)
{
  size_t total = total_of(c);
  for (size_t k = 0; k < total; k++) c->cell[k * c->stride] = 0;
}

/* Small cells with their overflow lists hold as many grains as cells of eight words, so they grow to sixteen. */
bool gg_md_cells_grow(gg_md_cells *c)
{
  if (c->fixed) return false;
  size_t total = total_of(c), stride = 2 * (c->next ? FEWEST_WORDS : c->stride);
  uint32_t *cell = gg_md_new_lines(total * stride + MOST_BEHIND, sizeof *cell, NULL), found[GG_MD_MOST_IN_SMALL];
  if (!cell) return false;
  for (size_t k = 0; k < total; k++) {
    const uint32_t *old = c->cell + k * c->stride;
    cell[k * stride] = old[0];
    memcpy(cell + k * stride + 1, gg_md_cell_members(c, old, found), old[0] * sizeof *cell);
  }
  free(c->cell);
  free(c->next);
  c->next = NULL;
  c->cell = cell;
  c->stride = (uint32_t)stride;
  return true;
}

void gg_md_cells_free(gg_md_cells *c)
{
  free(c->cell);
  free(c->next);
  for (int a = 0; a < 3; a++)
    if (c->part[a]) free(c->part[a] - 2);
  *c = (gg_md_cells){0};
}

void gg_md_cell_of(const gg_md_cells *c, gg_vec r, int32_t cell[3])
{
  for (int a = 0; a < 3; a++) {
    int32_t k = (int32_t)(gg_along(&r, a) * c->inverse[a]);
    cell[a] = gg_md_within(k, c->n[a]);
  }
}
