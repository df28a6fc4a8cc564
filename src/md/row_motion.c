/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Positions of the rows of cells that move with the flow (search/comoving_rows.h). Row j begins at
 *
 *   common + (j - J) f + s_j w,  J = floor(n_y/2),
 *
 * where f, the fractional shift in [0, w), is the distance of each row from the row below it beyond whole cells, and
 * the s_j are whole numbers: s_j+1 - s_j = `row_shift` inside the box and `image_shift` from its uppermost row to the
 * image of the lowest row. All rows shift past each other at the same speed, shear_rate h for layers of height h: so f
 * is the same for all rows, and all whole numbers change by one at the same time. If the image above has the offset D,
 * D = n_y f + m w.
 *
 * Rows of overlapping cells (overlapping_members.h) are independent of each other: row j begins at (j + 1/2 - n_y/2) f,
 * where f, in [0, 2 L_x), is the distance that rows have moved past each other. e->k.fractional_shift is f at the start
 * of the epoch. */
#include "md/row_motion.h"

#include <math.h>

#include "base/memory.h"

static double shift_speed(const gg_md *e)
{
  return e->model.shear_rate * e->cells.width[1];
}

/* The number m above, from 0 to n_x - 1. */
static int64_t whole_offset(const gg_md *e)
{
  return (e->k.image_shift + (int64_t)(e->cells.n[1] - 1) * e->k.row_shift) % e->cells.n[0];
}

/* Place rows of cells that do not overlap. */
static void place_linked_rows(gg_md *e)
{
  const int32_t *n = e->cells.n;
  const gg_md_counts *k = &e->k;
  for (int32_t j = 0; j < n[1]; j++) {
    int64_t place = j - n[1] / 2, whole = place * k->row_shift % n[0];
    double origin = k->common_shift + (double)place * k->fractional_shift + (double)whole * e->cells.width[0];
    e->search.rows.row[j] = (gg_md_row){.origin = gg_wrap(origin, e->box.edge[0], e->box.inverse[0]),
                                        .speed = shift_speed(e) * (j + 0.5 - 0.5 * n[1]),
                                        .above = j == n[1] - 1 ? k->image_shift : k->row_shift,
                                        .below = j == 0 ? k->image_shift : k->row_shift};
  }
  const double speed = shift_speed(e), behind = k->fractional_shift, ahead = e->cells.width[0] - behind;
  e->search.rows.next_shift = speed == 0 ? INFINITY : speed > 0 ? ahead / speed : behind / -speed;
}

/* Place rows of overlapping cells; the rows across the sheared boundary have the offset of the images. */
static void place_free_rows(gg_md *e)
{
  int32_t n = e->cells.n[1];
  for (int32_t j = 0; j < n; j++) {
    double place = j + 0.5 - 0.5 * n;
    e->search.rows.row[j].origin = gg_wrap(place * e->k.fractional_shift, e->box.edge[0], e->box.inverse[0]);
    e->search.rows.row[j].speed = place * shift_speed(e);
  }
  e->search.rows.row[-1] = (gg_md_row){e->search.rows.row[n - 1].origin - e->box.offset0,
                                       e->search.rows.row[n - 1].speed - e->box.image_velocity, 0, 0};
  for (int k = 0; k < 2; k++)
    e->search.rows.row[n + k] = (gg_md_row){e->search.rows.row[k].origin + e->box.offset0,
                                            e->search.rows.row[k].speed + e->box.image_velocity, 0, 0};
  e->search.rows.next_shift = INFINITY;
}

static void place_rows(gg_md *e)
{
  if (e->search.kind == GG_MD_OVERLAPPING_ROWS)
    place_free_rows(e);
  else
    place_linked_rows(e);
}

gg_status gg_md_make_rows(gg_md *e, gg_error *err)
{
  gg_md_row *row = gg_base_array_new((size_t)e->cells.n[1] + 3, sizeof *row, err);
  if (!row) return GG_FAILED;
  e->search.rows.row = row + 1;
  place_rows(e);
  return GG_OK;
}

/* Set f and image_shift = m by D = n_y f + m w. */
static void link_to_images(gg_md *e)
{
  double offset = gg_md_offset(&e->box, 0);
  int32_t whole = (int32_t)(offset * e->cells.inverse[0]);
  e->k.image_shift = whole % e->cells.n[0];
  e->k.fractional_shift = fmax(offset - whole * e->cells.width[0], 0) / e->cells.n[1];
}

void gg_md_align_rows(gg_md *e)
{
  e->k.fractional_shift = e->k.common_shift = 0;
  e->k.row_shift = e->k.image_shift = 0;
  if (e->search.kind == GG_MD_COMOVING_ROWS) link_to_images(e);
  place_rows(e);
}

void gg_md_separate_rows(gg_md *e)
{
  const double golden = 0.381966011250105; /* no multiple is near a whole number */
  if (e->search.kind != GG_MD_OVERLAPPING_ROWS) return;
  e->k.fractional_shift = golden * e->cells.width[0];
  place_rows(e);
}

/* Move rows by an epoch. The fractional shift follows the offset, so that rounding cannot separate rows from images. */
static void move_linked_rows(gg_md *e, double span)
{
  int32_t n = e->cells.n[1];
  double both = 0.5 - 0.5 * n + n / 2; /* common part of the speeds of all rows, in units of shift_speed */
  e->k.common_shift = gg_wrap(e->k.common_shift + both * shift_speed(e) * span, e->box.edge[0], e->box.inverse[0]);
  e->k.fractional_shift += shift_speed(e) * span;
  double ahead = e->box.offset0 - (double)whole_offset(e) * e->cells.width[0] - n * e->k.fractional_shift;
  e->k.fractional_shift += (ahead - e->box.edge[0] * gg_nearest(ahead * e->box.inverse[0])) / n;
}

void gg_md_move_rows(gg_md *e, double span)
{
  double twice = 2 * e->box.edge[0]; /* half of this period moves a row by a whole box */
  if (e->search.kind == GG_MD_OVERLAPPING_ROWS)
    e->k.fractional_shift = gg_wrap(e->k.fractional_shift + shift_speed(e) * span, twice, 1 / twice);
  else
    move_linked_rows(e, span);
  place_rows(e);
}

void gg_md_shift_rows_by_a_cell(gg_md *e, int step)
{
  const int32_t n = e->cells.n[0];
  e->k.row_shift = (e->k.row_shift + n + step) % n;
  e->k.image_shift = (e->k.image_shift + n + step) % n;
  e->k.fractional_shift -= step * e->cells.width[0];
  place_rows(e);
}

int32_t gg_md_cell_in_row(const gg_md *e, int32_t y, double x)
{
  double depth = gg_wrap(x - gg_md_row_begins(e, y), e->box.edge[0], e->box.inverse[0]);
  int32_t cell = (int32_t)(depth * e->cells.inverse[0]);
  return gg_md_within(cell, e->cells.n[0]);
}
