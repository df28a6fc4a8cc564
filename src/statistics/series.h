/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A series of samples with many channels: all means of a run come from it. When it is full, neighbouring rows are
 * averaged in pairs. So a run of any length needs bounded memory and keeps its whole history. */
#ifndef GG_SERIES_H
#define GG_SERIES_H

#include "base/archive.h"

#include <stdbool.h>
#include <stdint.h>

enum { GG_SERIES_ROWS = 1 << 14 };

typedef struct gg_series {
  size_t width;     /* channels */
  size_t n;         /* complete rows */
  size_t per_row;   /* samples averaged into each row: a power of two */
  size_t pending;   /* samples in the row being filled */
  size_t window;    /* first row of the averaging window */
  double *rows;     /* GG_SERIES_ROWS x width */
  double *end_time; /* of each row */
  double *partial;  /* the row being filled */
} gg_series;

gg_status gg_statistics_series_init(gg_series *s, size_t width, gg_error *err);
void gg_statistics_series_clear(gg_series *s);

/* Append one sample of `width` numbers. */
void gg_statistics_series_add(gg_series *s, double time, const double *sample);

/* Average neighbouring rows until each has `per_row` samples (a power of two); a single remaining row is dropped. */
void gg_statistics_series_coarsen(gg_series *s, size_t per_row);

/* Start the averaging window at the next sample (drops a half-filled row) or at a row. */
void gg_statistics_series_open_window(gg_series *s);

static inline const double *gg_series_row(const gg_series *s, size_t i)
{
  return s->rows + i * s->width;
}
static inline size_t gg_series_window_rows(const gg_series *s)
{
  return s->n > s->window ? s->n - s->window : 0;
}

gg_status gg_statistics_series_save(const gg_series *s, gg_archive *archive, gg_error *err);
gg_status gg_statistics_series_restore(gg_series *s, const gg_archive *archive, gg_error *err);

/* Decimation factors: they double from 1 whenever a store of fixed size is full. */

/* True if a number from a file is a valid factor, with so many samples of the next entry pending, and far from
 * overflow. */
static inline bool gg_is_decimation_factor(uint64_t per, uint64_t pending)
{
  return per > 0 && per < UINT64_C(1) << 48 && (per & (per - 1)) == 0 && pending < per;
}

#endif
