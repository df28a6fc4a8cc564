/* How much memory the engine takes, before it is there: the arrays of md_allocate.c, cell_grid.c and queue.c. */
#include "md/md_memory.h"

#include <math.h>

#include "md/md_state.h"

/* Grains in a cell on average; where cells overlap, a grain is in more than one. */
static double grains_per_cell(const gg_model *m, gg_md_search_kind kind, const int32_t n[3])
{
  double per_cell = (double)m->n;
  for (int a = 0; a < 3; a++) {
    const double width = m->box[a] / n[a];
    per_cell *= (gg_md_search_overlaps(kind) ? 1 + gg_md_reach(m) / width : 1) / n[a];
  }
  return per_cell;
}

/* Cells hold seven grains, and all get twice the room when one is full: five deviations above the mean somewhere. */
static double bytes_of_cells(const gg_model *m, gg_md_search_kind kind, const int32_t n[3])
{
  const double mean = grains_per_cell(m, kind, n), fullest = mean + 5 * sqrt(mean);
  double words = kind == GG_MD_NEIGHBOUR_LISTS ? 16 : 8;
  while (words - 1 < fullest) words *= 2;
  return (double)n[0] * n[1] * n[2] * words * sizeof(uint32_t);
}

double gg_md_bytes(const gg_model *m)
{
  double radius;
  int32_t n[3];
  const gg_md_search_kind kind = gg_md_search_select(m, &radius, n);
  double each = sizeof(gg_md_grain) + sizeof(gg_md_node) + sizeof(uint32_t) + sizeof(gg_md_bucket) / 4.0;
  if (m->rule != GG_SMOOTH) each += sizeof(gg_vec);
  if (m->contact_time > 0) each += sizeof(double);
  if (kind == GG_MD_NEIGHBOUR_LISTS) each += sizeof(gg_md_skin) + GG_MD_LIST * sizeof(uint32_t);
  return each * (double)m->n + bytes_of_cells(m, kind, n);
}
