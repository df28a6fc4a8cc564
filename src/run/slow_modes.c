/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Between walls a dense core moves to and fro, grows and shrinks, for longer than any mean over all grains remembers.
 * The long waves across the gap (measure/wall_modes.h) show for how long. Between like walls the reported quantities
 * are even under the symmetry of the flow: they follow even modes, and the squares of odd ones. A square forgets in
 * half the time. The slowest mode of all is often odd: the gas drifts along the walls with one of them. Normal
 * stresses, free paths and fourth moments follow its square closely. A core that keeps to one side is to be seen,
 * too. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "measure/wall_modes.h"
#include "run/replicas.h"
#include "statistics/autocorrelation.h"

/* Number of parts of the window over which modes are averaged: this removes the fast noise of sound waves and keeps the
 * slow decay. */
enum { PARTS = 512 };

/* Means of one mode over the parts of every replica's window; returns their mean. */
static double gather(const gg_replicas *all, int mode, size_t parts, size_t per_part, double *y)
{
  double mean = 0;
  size_t total = parts * (size_t)all->n;
  memset(y, 0, total * sizeof *y);
  for (size_t i = 0; i < total; i++) {
    const gg_replica *p = &all->replica[i / parts];
    size_t first = p->series.window + (i % parts) * per_part;
    for (size_t k = 0; k < per_part; k++)
      y[i] += gg_series_row(&p->series, first + k)[p->wall_modes_at + (size_t)mode] / (double)per_part;
    mean += y[i] / (double)total;
  }
  return mean;
}

static double mean_square(const double *y, size_t n)
{
  double sum = 0;
  for (size_t i = 0; i < n; i++) sum += y[i] * y[i] / (double)n;
  return sum;
}

/* Record a mode's decay time: keep the mode that needs the longest window, and the longest memory of results. */
static void note(gg_slow_modes *w, int mode, bool odd, double time)
{
  const int least = odd ? GG_LEAST_ODD_TIMES : GG_LEAST_SLOW_TIMES;
  const double remembered = odd ? time / 2 : time;
  if (least * time > w->least * w->mode_time) w->mode = mode, w->mode_time = time, w->least = least;
  w->time = fmax(w->time, remembered);
  w->mean_time += remembered;
}

gg_status gg_run_replicas_slow_modes(const gg_replicas *all, gg_slow_modes *w, gg_error *err)
{
  *w = (gg_slow_modes){.mode = -1};
  const gg_series *s = &all->replica[0].series;
  size_t rows = gg_series_window_rows(s), per_part = (rows + PARTS - 1) / PARTS;
  int modes = all->state.averaging ? gg_measure_wall_modes(&all->model) : 0;
  if (modes == 0 || rows < 4) return GG_OK;
  size_t parts = rows / per_part;
  double *y = gg_base_array_new(parts * (size_t)all->n, sizeof *y, err);
  if (!y) return GG_FAILED;
  const double part = (double)per_part * (double)s->per_row;
  for (int k = 0; k < modes; k++) {
    const bool odd = gg_measure_wall_mode_is_odd(&all->model, k);
    const double mean = gather(all, k, parts, per_part, y);
    note(w, k, odd, gg_statistics_decay_time(y, parts, (size_t)all->n) * part);
    if (!odd || k != GG_WALL_CENTRE) continue;
    const double squares = mean_square(y, parts * (size_t)all->n);
    w->aside = mean, w->aside_share = squares > 0 ? mean * mean / squares : 0;
  }
  w->mean_time /= modes;
  free(y);
  return GG_OK;
}
