/* What a grid of comparisons came to, in words, counts and tables (Markdown). */
#ifndef GG_VERDICT_H
#define GG_VERDICT_H

#include "sweep/agreement.h"

/* `repeat` is the command that repeats a point, to which its number is added; NULL: none is named. */
gg_status gg_sweep_verdict_print(const gg_grid_view *view, const gg_agreement *agreement, const char *repeat, FILE *out,
                                 gg_error *err);

/* Largest deviations that are counted. */
enum { GG_THRESHOLDS = 3 };
extern const double gg_sweep_thresholds[GG_THRESHOLDS]; /* 0.01, 0.05, 0.2 */

/* Deviation from the reference, of stress differences the difference itself; NaN where there is none. */
double gg_sweep_deviation_of(const gg_cli_table_row *row);
double gg_sweep_deviation_error_of(const gg_cli_table_row *row);

#endif
