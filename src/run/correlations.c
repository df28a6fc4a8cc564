/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How the means of a run vary together. */
#include <math.h>
#include <stdlib.h>

#include "base/memory.h"
#include "run/replicas.h"
#include "run/series_means.h"

/* Rows of all replicas are averaged into so many: estimates of all pairs cost little, and blocks of ten correlation
 * times are longer still. */
enum { ROWS = 256 };
/* A mean is measured in itself, since most combinations are ratios and products; nearer to zero in its error. */
#define NEAR_ZERO 10

typedef struct varying {
  const double *row; /* linear response */
  double unit;
  double variance; /* of the mean, in that unit squared: its error as reported */
  double enlarged; /* this over the estimate from these rows */
  double memory;   /* correlation time in rows */
} varying;

typedef struct varyings {
  size_t n, n_rows, n_runs; /* n_rows: of each run */
  double *rows, *sum;       /* n n_rows n_runs; scratch for one */
  varying *of;
} varyings;

static gg_status prepare(varying *v, const varyings *all, const gg_estimate *e, const double *row, gg_error *err)
{
  gg_mean m;
  GG_TRY(gg_statistics_estimate_scalar(row, all->n_rows, all->n_runs, &m, err));
  *v = (varying){.row = row, .unit = fabs(e->mean) > NEAR_ZERO * e->error ? e->mean : e->error};
  v->variance = pow(e->error / v->unit, 2);
  v->enlarged = pow(e->error / m.error, 2);
  v->memory = m.correlation_rows;
  return GG_OK;
}

/* Variance of the mean of a + sign b, enlarged as the errors of both are. */
static gg_status variance_of_sum(const varyings *all, const varying *a, const varying *b, int sign, double *variance,
                                 gg_error *err)
{
  gg_mean m;
  const size_t total = all->n_rows * all->n_runs;
  for (size_t i = 0; i < total; i++) all->sum[i] = a->row[i] / a->unit + sign * b->row[i] / b->unit;
  GG_TRY(gg_statistics_estimate_made_of(all->sum, all->n_rows, all->n_runs, fmax(a->memory, b->memory), &m, err));
  *variance = m.error * m.error * sqrt(a->enlarged * b->enlarged);
  return GG_OK;
}

/* True if the two means rise and fall together. */
static bool go_together(const varyings *all, const varying *a, const varying *b)
{
  double sum = 0;
  for (size_t i = 0; i < all->n_rows * all->n_runs; i++) sum += a->row[i] / a->unit * (b->row[i] / b->unit);
  return sum > 0;
}

/* Correlation coefficient of two means. If they vary together, their difference has a small variance, which would be
 * lost in the inaccuracy of both errors. So the covariance is chosen such that the difference has the variance of its
 * own series of blocks. For means that vary oppositely, the sum is used. */
static gg_status coefficient_of(const varyings *all, const varying *a, const varying *b, double *coefficient,
                                gg_error *err)
{
  double variance;
  *coefficient = 0;
  if (!(a->variance > 0 && b->variance > 0)) return GG_OK; /* a constant */
  const int sign = go_together(all, a, b) ? -1 : 1;
  GG_TRY(variance_of_sum(all, a, b, sign, &variance, err));
  if (!isfinite(variance)) return GG_OK;
  const double covariance = sign * (variance - a->variance - b->variance) / 2 * (a->unit * b->unit < 0 ? -1 : 1);
  *coefficient = fmax(-1, fmin(covariance / sqrt(a->variance * b->variance), 1));
  return GG_OK;
}

static gg_status fill(const gg_replicas *replicas, size_t length, varyings *all, gg_result *r, gg_error *err)
{
  gg_correlations *c = &r->correlations;
  for (size_t i = 0; i < c->n; i++) {
    double *row = all->rows + i * all->n_rows * all->n_runs;
    GG_TRY(gg_run_replicas_blocks(replicas, c->quantity[i], length, row, err));
    GG_TRY(prepare(&all->of[i], all, &r->value[c->quantity[i]], row, err));
    c->coefficient[i * c->n + i] = 1;
    for (size_t j = 0; j < i; j++) {
      GG_TRY(coefficient_of(all, &all->of[i], &all->of[j], &c->coefficient[i * c->n + j], err));
      c->coefficient[j * c->n + i] = c->coefficient[i * c->n + j];
    }
  }
  return GG_OK;
}

gg_status gg_run_replicas_correlations(const gg_replicas *replicas, gg_result *result, gg_error *err)
{
  gg_correlations *c = &result->correlations;
  const size_t rows = gg_series_window_rows(&replicas->replica[0].series), n_runs = (size_t)replicas->n,
               length = (rows * n_runs + ROWS - 1) / ROWS;
  if (!c->n) return GG_OK;
  varyings all = {.n = c->n, .n_rows = rows / length, .n_runs = n_runs};
  all.rows = gg_base_array_new((c->n + 1) * all.n_rows * n_runs, sizeof *all.rows, err);
  all.of = gg_base_array_new(c->n, sizeof *all.of, err);
  c->coefficient = gg_base_array_new(c->n * c->n, sizeof *c->coefficient, err);
  if (all.rows) all.sum = all.rows + c->n * all.n_rows * n_runs;
  gg_status status = all.rows && all.of && c->coefficient ? fill(replicas, length, &all, result, err) : GG_FAILED;
  free(all.rows);
  free(all.of);
  return status;
}

double gg_run_result_covariance(const gg_result *r, gg_quantity one, gg_quantity other, const char **why)
{
  const gg_quantity both[] = {one, other};
  const gg_correlations *c = &r->correlations;
  size_t place[2];
  *why = NULL;
  for (int k = 0; k < 2 && !*why; k++) {
    const gg_estimate *e = &r->value[both[k]];
    for (place[k] = 0; place[k] < c->n && c->quantity[place[k]] != both[k];) place[k]++;
    if (isnan(e->mean))
      *why = *e->reason ? e->reason : "not measured";
    else if (isnan(e->error))
      *why = "the run is too short to know its error";
    else if (one != other && place[k] == c->n)
      *why = c->n ? "not known" : "the file was written before graingas stored covariances";
  }
  if (*why) return NAN;
  const double errors = r->value[one].error * r->value[other].error;
  return one == other ? errors : c->coefficient[place[0] * c->n + place[1]] * errors;
}
