/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The convergence monitor: how exact the means over the averaging window are, and whether a quantity has a trend. */
#include <math.h>
#include <stdlib.h>

#include "base/memory.h"
#include "run/replicas.h"
#include "run/series_means.h"
#include "statistics/trend.h"

/* A difference between earlier and later beyond this many errors is a trend: with five quantities tested a few times,
 * chance alone reaches it in a few of a thousand runs. */
#define TREND_Z 4.0
/* ... unless it is too small to matter beside the requested error. */
#define TREND_NEGLIGIBLE 1e-4

/* At the end of the list, unless it is there, or not measured. */
static int append(const gg_replicas *all, gg_quantity q, gg_quantity *list, int n)
{
  gg_function f;
  for (int i = 0; i < n; i++)
    if (list[i] == q) return n;
  if (gg_measure_sampler_find(&all->replica[0].sampler, q, &f) >= 0) list[n++] = q;
  return n;
}

/* List the quantities that must not have a trend: the headline quantities and others with a requested error first
 * (*asked of them), then those that relax slowly. Returns how many. */
static int monitored(const gg_replicas *all, gg_quantity *list, int *asked)
{
  int n = gg_run_headline_quantities(&all->model, list);
  for (gg_quantity q = 0; q < GG_N_QUANTITIES; q++)
    if (all->scene.run.until[q] > 0) n = append(all, q, list, n);
  *asked = n;
  if (all->model.linear_response) return n; /* the shear rate goes up and down: nothing else is steady */
  for (gg_quantity q = gg_common_quantity_next(-1, GG_MONITORED); q < GG_N_QUANTITIES;
       q = gg_common_quantity_next(q, GG_MONITORED))
    n = append(all, q, list, n);
  return n;
}

static void note_error(const gg_replicas *all, gg_quantity q, const gg_mean *m, gg_convergence *c)
{
  const double per_row = (double)all->replica[0].series.per_row, row = m->correlation_rows * per_row / all->n;
  const double asked = gg_run_criteria_error_of(&all->scene, &all->model, q);
  const double in_proportion = all->criteria.relative_error > 0 ? all->criteria.relative_error / asked : 1;
  if (isinf(asked)) return;
  const double relative = m->error / fabs(m->mean) * in_proportion;
  if (!(relative <= c->relative_error)) c->relative_error = relative, c->worst = q;
  c->sure_at = fmax(c->sure_at, 10 * GG_MAX_BLOCKS * row);
  if (!m->trusted) c->trusted = false, c->untrusted = fmax(c->untrusted, row);
}

static gg_status test_trend(const gg_replicas *all, gg_quantity q, gg_trend *trend, gg_error *err)
{
  gg_function f;
  const int k = gg_measure_sampler_find(&all->replica[0].sampler, q, &f);
  *trend = (gg_trend){.z = NAN, .relative = NAN, .correlation_rows = 0.5};
  size_t n = gg_series_window_rows(&all->replica[0].series);
  if (k < 0 || n < 24) return GG_OK;
  GG_FREED double *y = gg_base_array_new(n * (size_t)all->n, sizeof *y, err);
  if (!y) return GG_FAILED;
  for (int r = 0; r < all->n; r++) {
    const gg_replica *p = &all->replica[r];
    for (size_t i = 0; i < n; i++)
      y[(size_t)r * n + i] =
          gg_function_value(f, gg_series_row(&p->series, p->series.window + i) + p->sampler.offset[k], &all->model);
  }
  return gg_statistics_trend_test(y, n, (size_t)all->n, trend, err);
}

/* Largest part of a requested error that the square of an odd mode may make in a short window. */
#define UNFELT (1 / 3.0)

/* True if the square of an odd mode makes more of a requested error, or if its part is unknown. */
static gg_status is_felt(const gg_replicas *all, const gg_slow_modes *w, int mode, const gg_quantity *list, int asked,
                         bool *felt, gg_error *err)
{
  double most = -1;
  for (int i = 0; i < asked; i++) {
    gg_mean m;
    double error = 0;
    GG_TRY(gg_run_replicas_mean(all, list[i], w->time, &m, err));
    if (!isfinite(m.mean)) continue;
    GG_TRY(gg_run_replicas_error_by_square(all, mode, w->decay[mode], list[i], &error, err));
    most = fmax(most, error / fabs(m.mean) / gg_run_criteria_error_of(&all->scene, &all->model, list[i]));
  }
  *felt = most < 0 || most > UNFELT;
  return GG_OK;
}

/* Find the mode that needs the longest window. */
static gg_status test_wandering(const gg_replicas *all, const gg_slow_modes *w, const gg_quantity *list, int asked,
                                gg_convergence *c, gg_error *err)
{
  const double sampled = (double)(all->state.due - all->state.window_at) * all->n;
  for (int k = 0; k < w->modes; k++) {
    const bool odd = gg_measure_wall_mode_is_odd(&all->model, k);
    int least = odd ? GG_LEAST_ODD_TIMES : GG_LEAST_SLOW_TIMES;
    bool felt = true;
    if (odd && sampled < least * w->decay[k]) GG_TRY(is_felt(all, w, k, list, asked, &felt, err));
    if (!felt) least = GG_LEAST_UNFELT_TIMES;
    if (least * w->decay[k] > c->slow_mode_least * c->slow_mode_time)
      c->slow_mode = k, c->slow_mode_time = w->decay[k], c->slow_mode_least = least;
  }
  if (sampled < c->slow_mode_least * c->slow_mode_time) c->trusted = false;
  return GG_OK;
}

gg_status gg_run_replicas_convergence(gg_replicas *all, gg_convergence *c, gg_error *err)
{
  *c = (gg_convergence){.relative_error = 0, .trusted = true, .slow_mode = -1};
  gg_quantity list[GG_N_QUANTITIES];
  int asked, n = monitored(all, list, &asked);
  double per_row = (double)all->replica[0].series.per_row;
  gg_slow_modes slow;
  GG_TRY(gg_run_replicas_slow_modes(all, &slow, err));
  for (int i = 0; i < n; i++) {
    gg_mean m;
    GG_TRY(gg_run_replicas_mean(all, list[i], slow.time, &m, err));
    c->slowest = fmax(c->slowest, m.correlation_rows * per_row);
    if (i < asked) note_error(all, list[i], &m, c);
    if (all->model.linear_response) continue;
    gg_trend t;
    GG_TRY(test_trend(all, list[i], &t, err));
    if (fabs(t.z) > TREND_Z && fabs(t.relative) > TREND_NEGLIGIBLE && fabs(t.z) > fabs(c->trend_z)) {
      c->trending = true;
      c->trending_quantity = list[i];
      c->trend_z = t.z, c->trend_relative = t.relative, c->trend_share = t.share;
    }
  }
  GG_TRY(test_wandering(all, &slow, list, asked, c, err));
  all->last = *c;
  return GG_OK;
}
