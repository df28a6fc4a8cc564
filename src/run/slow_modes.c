/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Between walls a dense core moves to and fro, grows and shrinks, for longer than any mean over all grains remembers.
 * The long waves across the gap (measure/wall_modes.h) show for how long. Between like walls the reported quantities
 * are even under the symmetry of the flow: they follow even modes, and the squares of odd ones. A square forgets in
 * half the time. The slowest mode of all is often odd: the gas drifts along the walls with one of them. Normal
 * stresses, free paths and fourth moments follow its square closely. A core that keeps to one side is to be seen,
 * too. */
#include <math.h>
#include <stdlib.h>

#include <gsl/gsl_statistics_double.h>

#include "base/memory.h"
#include "run/series_means.h"
#include "statistics/autocorrelation.h"

/* Number of parts of the window over which modes are averaged: this removes the fast noise of sound waves and keeps the
 * slow decay. */
enum { PARTS = 512 };

/* Parts of the windows of all replicas. */
typedef struct parts {
  size_t rows, each, total; /* in one part; parts of a replica, of all */
  double samples;           /* in one part */
  double *y, *response;     /* a mode, a quantity */
} parts;

static gg_status parts_make(const gg_replicas *all, parts *p, gg_error *err)
{
  const gg_series *s = &all->replica[0].series;
  const size_t rows = gg_series_window_rows(s);
  *p = (parts){.rows = (rows + PARTS - 1) / PARTS};
  p->each = rows / p->rows, p->total = p->each * (size_t)all->n;
  p->samples = (double)p->rows * (double)s->per_row;
  p->y = gg_base_array_new(2 * p->total, sizeof *p->y, err);
  if (!p->y) return GG_FAILED;
  p->response = p->y + p->total;
  return GG_OK;
}

static void gather(const gg_replicas *all, int mode, const parts *p)
{
  for (int r = 0; r < all->n; r++)
    gg_statistics_parts(&all->replica[r].series, all->replica[r].sampler.wall_modes_at + (size_t)mode, p->each, p->rows,
                        p->y + (size_t)r * p->each);
}

gg_status gg_run_replicas_slow_modes(const gg_replicas *all, gg_slow_modes *w, gg_error *err)
{
  parts p;
  const int modes = all->state.averaging ? gg_measure_wall_modes(&all->model) : 0;
  *w = (gg_slow_modes){0};
  if (modes == 0 || gg_series_window_rows(&all->replica[0].series) < 4) return GG_OK;
  GG_TRY(parts_make(all, &p, err));
  w->modes = modes;
  for (int k = 0; k < modes; k++) {
    const bool odd = gg_measure_wall_mode_is_odd(&all->model, k);
    gather(all, k, &p);
    w->decay[k] = gg_statistics_decay_time(p.y, p.each, (size_t)all->n) * p.samples;
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

gg_status gg_run_replicas_error_by_square(const gg_replicas *all, int mode, double decay, gg_quantity q, double *error,
                                          gg_error *err)
{
  parts p;
  GG_TRY(parts_make(all, &p, err));
  gather(all, mode, &p);
  const gg_status status = gg_run_replicas_blocks(all, q, p.rows, p.response, err);
  *error = gg_statistics_scatter_by_square(p.y, p.response, p.total);
  *error *= sqrt(fmin(1, decay / (p.samples * (double)p.total)));
  free(p.y);
  return status;
}
