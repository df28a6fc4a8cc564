/* Cells: a grid over the box, no edge below the largest contact distance, so that a grain can only touch grains of its
 * own and the 26 cells around. Grains of a cell hang on a chain through their records. A grain's cell is a matter of
 * its crossings, not of its rounded coordinates: it changes only by crossing events. */
#ifndef GG_MD_CELLS_H
#define GG_MD_CELLS_H

#include "common/error.h"
#include "md/box.h"

#define GG_NONE UINT32_MAX

typedef struct gg_cells {
  int32_t n[3];
  double width[3], inverse[3];
  double reach;   /* largest contact distance */
  uint32_t *head; /* by cell: x fastest */
} gg_cells;

/* A grid of n[] cells on the box. */
gg_status gg_cells_make(gg_cells *cells, const gg_box *box, const int32_t n[3], double reach, gg_error *err);
void gg_cells_free(gg_cells *cells);
/* As many cells as fit with edges of at least `width`. */
void gg_cells_count(const gg_box *box, double width, int32_t n[3]);

GG_INLINE uint32_t gg_cell_index(const gg_cells *c, const int32_t at[3])
{
  return ((uint32_t)at[2] * (uint32_t)c->n[1] + (uint32_t)at[1]) * (uint32_t)c->n[0] + (uint32_t)at[0];
}

#endif
