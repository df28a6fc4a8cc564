/* Where rows of cells that drift with the flow stand (rows.h). Row j begins at
 *
 *   common + (j - J) lean + s_j w,  J = floor(n_y/2),
 *
 * where lean, at present in [0, w), is how far each row is ahead of the one below it beyond whole cells, and s_j whole
 * numbers: s_j+1 - s_j = turn inside the box and `seam` from its uppermost row to the image of the lowest one. All rows
 * slip past each other at the same speed, shear_rate h for layers of height h: so lean is the same for all of them, and
 * all whole numbers grow by one at the same time. With the image above at offset D, D = n_y lean + m w.
 *
 * Rows of cells that overlap (shared_rows.h) need not know of each other: row j begins at (j + 1/2 - n_y/2) lean, where
 * lean, in [0, 2 L_x), is how far rows have moved past each other. e->k.lean is what it was, or would have been, at the
 * epoch's start. */
#include <math.h>

#include "md/rows.h"

static double slip_speed(const gg_md *e)
{
  return e->model.shear_rate * e->cells.width[1];
}

/* m above, from 0 to n_x - 1. */
static int64_t whole_offset(const gg_md *e)
{
  return (e->k.seam + (int64_t)(e->cells.n[1] - 1) * e->k.turn) % e->cells.n[0];
}

/* Rows of cells that do not overlap. */
static void place_linked_rows(gg_md *e)
{
  const int32_t *n = e->cells.n;
  const gg_md_counts *k = &e->k;
  for (int32_t j = 0; j < n[1]; j++) {
    int64_t place = j - n[1] / 2, whole = place * k->turn % n[0];
    double origin = k->common + (double)place * k->lean + (double)whole * e->cells.width[0];
    e->row[j] = (gg_row){.origin = gg_wrap(origin, e->box.edge[0], e->box.inverse[0]),
                         .speed = slip_speed(e) * (j + 0.5 - 0.5 * n[1]),
                         .above = j == n[1] - 1 ? k->seam : k->turn,
                         .below = j == 0 ? k->seam : k->turn};
  }
  e->slip = (e->cells.width[0] - k->lean) / slip_speed(e);
}

/* Rows of cells that overlap stand anywhere, those across the sheared boundary as its images do. */
static void place_free_rows(gg_md *e)
{
  int32_t n = e->cells.n[1];
  for (int32_t j = 0; j < n; j++) {
    double place = j + 0.5 - 0.5 * n;
    e->row[j].origin = gg_wrap(place * e->k.lean, e->box.edge[0], e->box.inverse[0]);
    e->row[j].speed = place * slip_speed(e);
  }
  e->row[-1] = (gg_row){e->row[n - 1].origin - e->box.offset0, e->row[n - 1].speed - e->box.slide, 0, 0};
  for (int k = 0; k < 2; k++)
    e->row[n + k] = (gg_row){e->row[k].origin + e->box.offset0, e->row[k].speed + e->box.slide, 0, 0};
  e->slip = INFINITY;
}

static void place_rows(gg_md *e)
{
  if (e->shared)
    place_free_rows(e);
  else
    place_linked_rows(e);
}

gg_status gg_md_make_rows(gg_md *e, gg_error *err)
{
  gg_row *row = gg_new_array((size_t)e->cells.n[1] + 3, sizeof *row, err);
  if (!row) return GG_FAILED;
  e->row = row + 1;
  place_rows(e);
  return GG_OK;
}

/* D = n_y lean + m w, for m = seam. */
static void link_to_images(gg_md *e)
{
  double offset = gg_offset(&e->box, 0);
  int32_t whole = (int32_t)(offset * e->cells.inverse[0]);
  e->k.seam = whole % e->cells.n[0];
  e->k.lean = fmax(offset - whole * e->cells.width[0], 0) / e->cells.n[1];
}

void gg_md_align_rows(gg_md *e)
{
  e->k.lean = e->k.common = 0;
  e->k.turn = e->k.seam = 0;
  if (!e->shared) link_to_images(e);
  place_rows(e);
}

/* Rounding must not part the rows from the images: lean follows the offset. */
static void move_linked_rows(gg_md *e, double span)
{
  int32_t n = e->cells.n[1];
  double both = 0.5 - 0.5 * n + n / 2; /* what all rows share of their speeds, in units of slip_speed */
  e->k.common = gg_wrap(e->k.common + both * slip_speed(e) * span, e->box.edge[0], e->box.inverse[0]);
  e->k.lean += slip_speed(e) * span;
  double ahead = e->box.offset0 - (double)whole_offset(e) * e->cells.width[0] - n * e->k.lean;
  e->k.lean += (ahead - e->box.edge[0] * gg_nearest(ahead * e->box.inverse[0])) / n;
}

void gg_md_move_rows(gg_md *e, double span)
{
  double twice = 2 * e->box.edge[0]; /* of which half a row's share is a whole box */
  if (e->shared)
    e->k.lean = gg_wrap(e->k.lean + slip_speed(e) * span, twice, 1 / twice);
  else
    move_linked_rows(e, span);
  place_rows(e);
}

void gg_md_slip_rows(gg_md *e)
{
  e->k.turn = (e->k.turn + 1) % e->cells.n[0];
  e->k.seam = (e->k.seam + 1) % e->cells.n[0];
  e->k.lean -= e->cells.width[0];
  place_rows(e);
}

int32_t gg_md_drifting_cell(const gg_md *e, int32_t y, double x)
{
  double depth = gg_wrap(x - gg_row_begins(e, y), e->box.edge[0], e->box.inverse[0]);
  int32_t cell = (int32_t)(depth * e->cells.inverse[0]);
  return cell < e->cells.n[0] ? cell : e->cells.n[0] - 1;
}
