/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The verdict on a grid of comparisons, in words, counts and tables (Markdown). */
#ifndef GG_VERDICT_H
#define GG_VERDICT_H

#include "sweep/agreement.h"

/* `repeat` is the command that repeats a point, to which its number is added; NULL: none is named. */
gg_status gg_sweep_verdict_print(const gg_grid_view *view, const gg_agreement *agreement, const char *repeat, FILE *out,
                                 gg_error *err);

/* The same as a JSON document. A new reference; NULL: out of memory. */
json_t *gg_sweep_verdict_document(const gg_grid_view *view, const gg_agreement *agreement, const char *repeat);

/* Largest deviations that are counted. */
enum { GG_THRESHOLDS = 3 };
extern const double gg_sweep_thresholds[GG_THRESHOLDS]; /* 0.01, 0.05, 0.2 */

/* True of a quantity whose deviation is a difference, not a ratio. */
bool gg_sweep_is_difference(const char *quantity);
/* Deviation from the reference, of stress differences the difference itself; NaN where there is none. */
double gg_sweep_deviation_of(const gg_point_row *row);
double gg_sweep_deviation_error_of(const gg_point_row *row);

/* Counts of the deviations of one method from its reference, for a quantity. */
typedef struct gg_off_counts {
  size_t n, off[GG_THRESHOLDS];
  double largest;
  const gg_point_row *where;
} gg_off_counts;
gg_off_counts gg_sweep_count_off(const gg_grid_view *view, const char *method, const char *quantity);

/* The ten largest |z|, of each point the largest; of a single point all. Returns how many; room for the table's rows.
 */
size_t gg_sweep_find_worst(const gg_grid_view *view, const gg_point_row **found);

/* The engine that has this trouble at a point; NULL: none. */
typedef const char *gg_point_trouble(const gg_grid_view *view, size_t point);
gg_point_trouble gg_sweep_not_steady, gg_sweep_not_homogeneous, gg_sweep_no_reference;

#endif
