/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Between walls a dense core moves to and fro, grows and shrinks, for longer than any mean over all grains remembers.
 * The long waves across the gap (measure/wall_modes.h) show for how long. Between like walls the reported quantities
 * are even under the symmetry of the flow: they follow even modes, and the squares of odd ones. A square forgets in
 * half the time. The slowest mode of all is often odd: the gas drifts along the walls with one of them. Normal
 * stresses, free paths and fourth moments follow its square closely. The mode of the centre of mass also shows whether
 * a core stays on one side. */
#include "measure/slow_modes.h"

#include <math.h>
#include <stdlib.h>

#include <gsl/gsl_statistics_double.h>

#include "base/memory.h"
#include "statistics/autocorrelation.h"
#include "statistics/estimator.h"

/* Number of parts of the window over which modes are averaged: this removes the fast noise of sound waves and keeps the
 * slow decay. */
enum { PARTS = 512 };

/* Parts of the windows of all series. */
typedef struct parts {
  size_t rows, each, total; /* in one part; parts of a series, of all */
  double samples;           /* in one part */
  double *y;                /* a mode */
} parts;

size_t gg_measure_slow_rows(const gg_series *s)
{
  return (gg_series_window_rows(s) + PARTS - 1) / PARTS;
}

static gg_status parts_make(const gg_series *const *series, size_t n, parts *p, gg_error *err)
{
  *p = (parts){.rows = gg_measure_slow_rows(series[0])};
  p->each = gg_series_window_rows(series[0]) / p->rows, p->total = p->each * n;
  p->samples = (double)p->rows * (double)series[0]->per_row;
  p->y = gg_base_array_new(p->total, sizeof *p->y, err);
  return p->y ? GG_OK : GG_FAILED;
}

static void gather(const gg_series *const *series, size_t n, size_t channel, const parts *p)
{
  for (size_t r = 0; r < n; r++) gg_statistics_parts(series[r], channel, p->each, p->rows, p->y + r * p->each);
}

gg_status gg_measure_slow_modes(const gg_model *model, const gg_series *const *series, size_t n, size_t channel,
                                gg_slow_modes *w, gg_error *err)
{
  parts p;
  const int modes = gg_measure_wall_modes(model);
  *w = (gg_slow_modes){0};
  if (modes == 0 || gg_series_window_rows(series[0]) < 4) return GG_OK;
  GG_TRY(parts_make(series, n, &p, err));
  w->modes = modes;
  for (int k = 0; k < modes; k++) {
    const bool odd = gg_measure_wall_mode_is_odd(model, k);
    gather(series, n, channel + (size_t)k, &p);
    w->decay[k] = gg_statistics_decay_time(p.y, p.each, n) * p.samples;
    const double remembered = odd ? w->decay[k] / 2 : w->decay[k];
    w->time = fmax(w->time, remembered), w->mean_time += remembered / modes;
    if (!odd || k != GG_WALL_CENTRE) continue;
    const double mean = gg_statistics_mean(p.y, p.total),
                 squares = gsl_stats_tss_m(p.y, 1, p.total, 0) / (double)p.total;
    w->aside = mean, w->aside_share = squares > 0 ? mean * mean / squares : 0;
  }
  free(p.y);
  return GG_OK;
}

gg_status gg_measure_error_by_square(const gg_series *const *series, size_t n, size_t channel, double decay,
                                     const double *response, double *error, gg_error *err)
{
  parts p;
  GG_TRY(parts_make(series, n, &p, err));
  gather(series, n, channel, &p);
  *error = gg_statistics_scatter_by_square(p.y, response, p.total);
  *error *= sqrt(fmin(1, decay / (p.samples * (double)p.total)));
  free(p.y);
  return GG_OK;
}
