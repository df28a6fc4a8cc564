/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "run/series_means.h"

#include <math.h>
#include <stdlib.h>

#include "base/memory.h"

static const gg_series **series_of(const gg_replicas *all, gg_error *err)
{
  const gg_series **series = gg_base_array_new((size_t)all->n, sizeof *series, err);
  for (int r = 0; series && r < all->n; r++) series[r] = &all->replica[r].series;
  return series;
}

gg_status gg_run_replicas_mean(const gg_replicas *all, gg_quantity q, double memory, gg_mean *mean, gg_error *err)
{
  *mean = (gg_mean){.mean = NAN, .error = NAN, .correlation_rows = 0.5};
  gg_function f;
  const int k = gg_measure_sampler_find(&all->replica[0].sampler, q, &f);
  if (k < 0) return GG_OK;
  GG_FREED const gg_series **series = series_of(all, err);
  if (!series) return GG_FAILED;
  const gg_replica *first = &all->replica[0];
  gg_status status =
      gg_statistics_estimate_mean(series, (size_t)all->n, first->series.window, first->series.n,
                                  first->sampler.offset[k], first->sampler.observable[k]->rows->width(&all->model), f,
                                  &all->model, memory / (double)first->series.per_row, mean, err);
  double rows = (double)gg_series_window_rows(&first->series) * all->n;
  mean->error *= gg_statistics_rule_margin(&all->criteria, mean->correlation_rows, rows);
  return status;
}

gg_status gg_run_replicas_blocks(const gg_replicas *all, gg_quantity q, size_t length, double *blocks, gg_error *err)
{
  gg_function f;
  const int k = gg_measure_sampler_find(&all->replica[0].sampler, q, &f);
  if (k < 0) return GG_OK;
  GG_FREED const gg_series **series = series_of(all, err);
  if (!series) return GG_FAILED;
  const gg_replica *first = &all->replica[0];
  return gg_statistics_response_blocks(series, (size_t)all->n, first->series.window, first->series.n,
                                       first->sampler.offset[k], first->sampler.observable[k]->rows->width(&all->model),
                                       f, &all->model, length, blocks, err);
}

gg_status gg_run_replicas_slow_modes(const gg_replicas *all, gg_slow_modes *w, gg_error *err)
{
  *w = (gg_slow_modes){0};
  if (!all->state.averaging || gg_measure_wall_modes(&all->model) == 0) return GG_OK;
  GG_FREED const gg_series **series = series_of(all, err);
  if (!series) return GG_FAILED;
  const size_t at = all->replica[0].sampler.wall_modes_at;
  return gg_measure_slow_modes(&all->model, series, (size_t)all->n, at, w, err);
}

gg_status gg_run_replicas_error_by_square(const gg_replicas *all, int mode, double decay, gg_quantity q, double *error,
                                          gg_error *err)
{
  const gg_series *first = &all->replica[0].series;
  const size_t n = (size_t)all->n, rows = gg_measure_slow_rows(first),
               channel = all->replica[0].sampler.wall_modes_at + (size_t)mode;
  GG_FREED const gg_series **series = series_of(all, err);
  GG_FREED double *response = gg_base_array_new(gg_series_window_rows(first) / rows * n, sizeof *response, err);
  if (!series || !response) return GG_FAILED;
  GG_TRY(gg_run_replicas_blocks(all, q, rows, response, err));
  return gg_measure_error_by_square(series, n, channel, decay, response, error, err);
}
