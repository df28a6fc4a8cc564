/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How the means of a run vary together. */
#include <math.h>
#include <stdlib.h>

#include "base/memory.h"
#include "run/replicas.h"
#include "run/series_means.h"
#include "statistics/covariance.h"

/* Rows of all replicas are averaged into so many: estimates of all pairs cost little, and blocks of ten correlation
 * times are longer still. */
enum { ROWS = 256 };
typedef struct varyings {
  size_t n, n_rows, n_runs; /* n_rows: of each run */
  double *rows, *sum;       /* n n_rows n_runs; scratch for one */
  gg_varying *of;
} varyings;

static gg_status fill(const gg_replicas *replicas, size_t length, varyings *all, gg_result *r, gg_error *err)
{
  gg_correlations *c = &r->correlations;
  for (size_t i = 0; i < c->n; i++) {
    double *row = all->rows + i * all->n_rows * all->n_runs;
    GG_TRY(gg_run_replicas_blocks(replicas, c->quantity[i], length, row, err));
    const gg_estimate *e = &r->value[c->quantity[i]];
    GG_TRY(gg_statistics_varying_make(&all->of[i], e->mean, e->error, row, all->n_rows, all->n_runs, err));
    c->coefficient[i * c->n + i] = 1;
    for (size_t j = 0; j < i; j++) {
      GG_TRY(gg_statistics_correlation_coefficient(&all->of[i], &all->of[j], all->n_rows, all->n_runs, all->sum,
                                                   &c->coefficient[i * c->n + j], err));
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
