/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Between walls a dense core slow_mode to and fro, grows and shrinks, for longer than any mean over all grains
 * remembers. The long waves across the gap (measure/wall_modes.h) show for how long. Where the walls are alike, what is
 * reported is even under the symmetry of the flow: modes that are odd do not shift it, but a core that keeps to one
 * side is to be seen. */
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "measure/wall_modes.h"
#include "run/replicas.h"
#include "statistics/autocorrelation.h"

/* Sound makes fast noise of most modes. Means over this many parts of the window have little of it left, and all that
 * is slow enough to matter. */
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
  int even = 0;
  for (int k = 0; k < modes; k++) {
    double mean = gather(all, k, parts, per_part, y);
    if (!gg_measure_wall_mode_is_odd(&all->model, k)) {
      double time = gg_statistics_decay_time(y, parts, (size_t)all->n) * (double)per_part * (double)s->per_row;
      if (time > w->time) w->mode = k, w->time = time;
      w->mean_time += (time - w->mean_time) / ++even;
    } else if (k == GG_WALL_CENTRE) {
      double squares = mean_square(y, parts * (size_t)all->n);
      w->aside = mean, w->aside_share = squares > 0 ? mean * mean / squares : 0;
    }
  }
  free(y);
  return GG_OK;
}
