/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "statistics/series.h"

#include <stdlib.h>
#include <string.h>

#include "base/memory.h"

gg_status gg_statistics_series_init(gg_series *s, size_t width, gg_error *err)
{
  *s = (gg_series){.width = width, .per_row = 1};
  s->rows = gg_base_array_new(GG_SERIES_ROWS * width, sizeof(double), err);
  s->end_time = gg_base_array_new(GG_SERIES_ROWS, sizeof(double), err);
  s->partial = gg_base_array_new(width, sizeof(double), err);
  if (s->rows && s->end_time && s->partial) return GG_OK;
  gg_statistics_series_clear(s);
  return GG_FAILED;
}

void gg_statistics_series_clear(gg_series *s)
{
  free(s->rows);
  free(s->end_time);
  free(s->partial);
  *s = (gg_series){0};
}

/* Average rows 2i and 2i+1 into row i. A window that began at an odd row now begins one row later: no row mixes both
 * sides. */
static void halve(gg_series *s)
{
  for (size_t i = 0; i < s->n / 2; i++) {
    const double *a = gg_series_row(s, 2 * i), *b = gg_series_row(s, 2 * i + 1);
    double *to = s->rows + i * s->width;
    for (size_t k = 0; k < s->width; k++) to[k] = 0.5 * (a[k] + b[k]);
    s->end_time[i] = s->end_time[2 * i + 1];
  }
  s->n /= 2;
  s->window = (s->window + 1) / 2;
  s->per_row *= 2;
}

void gg_statistics_series_add(gg_series *s, double time, const double *sample)
{
  for (size_t k = 0; k < s->width; k++) s->partial[k] += sample[k];
  if (++s->pending < s->per_row) return;
  double *row = s->rows + s->n * s->width, share = 1 / (double)s->per_row;
  for (size_t k = 0; k < s->width; k++) row[k] = s->partial[k] * share;
  s->end_time[s->n++] = time;
  s->pending = 0;
  memset(s->partial, 0, s->width * sizeof(double));
  if (s->n == GG_SERIES_ROWS) halve(s);
}

void gg_statistics_series_coarsen(gg_series *s, size_t per_row)
{
  while (s->per_row < per_row) halve(s);
}

void gg_statistics_series_open_window(gg_series *s)
{
  s->pending = 0;
  memset(s->partial, 0, s->width * sizeof(double));
  s->window = s->n;
}

gg_status gg_statistics_series_save(const gg_series *s, gg_archive *a, gg_error *err)
{
  uint64_t head[5] = {s->width, s->n, s->per_row, s->pending, s->window};
  GG_TRY(gg_base_archive_put(a, "series/head", GG_ITEM_U64, head, 5, err));
  GG_TRY(gg_base_archive_put(a, "series/rows", GG_ITEM_F64, s->rows, s->n * s->width, err));
  GG_TRY(gg_base_archive_put(a, "series/end_time", GG_ITEM_F64, s->end_time, s->n, err));
  return gg_base_archive_put(a, "series/partial", GG_ITEM_F64, s->partial, s->width, err);
}

gg_status gg_statistics_series_restore(gg_series *s, const gg_archive *a, gg_error *err)
{
  uint64_t head[5];
  GG_TRY(gg_base_archive_get(a, "series/head", GG_ITEM_U64, head, 5, err));
  if (head[0] != s->width || head[1] >= GG_SERIES_ROWS)
    return gg_base_fail(err, GG_BAD_FILE, "the checkpoint's series has another width than this scene's");
  if (!gg_is_decimation_factor(head[2], head[3]) || head[4] > head[1] + 1)
    return gg_base_fail(err, GG_BAD_FILE, "the checkpoint's series is damaged");
  s->n = head[1], s->per_row = head[2], s->pending = head[3], s->window = head[4];
  GG_TRY(gg_base_archive_get(a, "series/rows", GG_ITEM_F64, s->rows, s->n * s->width, err));
  GG_TRY(gg_base_archive_get(a, "series/end_time", GG_ITEM_F64, s->end_time, s->n, err));
  return gg_base_archive_get(a, "series/partial", GG_ITEM_F64, s->partial, s->width, err);
}
