/* Is the window long, steady and exact enough? */
#include <math.h>
#include <stdlib.h>

#include "run/campaign.h"
#include "statistics/trend.h"

/* A difference of the first and last third beyond this many errors is a drift: with five quantities looked at a few
 * times, chance alone reaches it about once in a thousand runs. */
#define DRIFT_Z 4.0
/* ... unless it is too small to matter beside the error asked for. */
#define DRIFT_NEGLIGIBLE 1e-4

static const gg_derived *find_derived(const gg_campaign *c, gg_quantity q, int *observable)
{
  for (int k = 0; k < c->replicas[0].n_observables; k++) {
    const gg_observable *o = c->replicas[0].observable[k];
    if (!o->width || o->missing(&c->model, q)) continue;
    for (const gg_derived *d = o->derived; d->of; d++)
      if (d->quantity == q) return *observable = k, d;
  }
  return NULL;
}

gg_status gg_campaign_mean(const gg_campaign *c, gg_quantity q, gg_mean *mean, gg_error *err)
{
  *mean = (gg_mean){.mean = NAN, .error = NAN, .correlation_rows = 0.5};
  int k;
  const gg_derived *d = find_derived(c, q, &k);
  if (!d) return GG_OK;
  const gg_series **series = gg_new_array((size_t)c->n, sizeof *series, err);
  if (!series) return GG_FAILED;
  for (int r = 0; r < c->n; r++) series[r] = &c->replicas[r].series;
  const gg_replica *first = &c->replicas[0];
  gg_status status = gg_estimate_mean(series, (size_t)c->n, first->series.window, first->series.n, first->offset[k],
                                      first->observable[k]->width(&c->model), d->of, &c->model, mean, err);
  free(series);
  return status;
}

/* What must not drift: everything headline, and the slow ones. */
static int watched(const gg_campaign *c, gg_quantity *list)
{
  int n = gg_headline(&c->model, list), k;
  if (c->model.small_shear) return n; /* goes round and round: nothing else stands still */
  const gg_quantity slow[] = {GG_Q_TEMPERATURE, GG_Q_TEMPERATURE_RATIO, GG_Q_SPIN_Z, GG_Q_COLLISION_RATE, GG_Q_A2};
  for (size_t i = 0; i < sizeof slow / sizeof *slow; i++) {
    bool there = !find_derived(c, slow[i], &k);
    for (int h = 0; h < n && !there; h++) there = list[h] == slow[i];
    if (!there) list[n++] = slow[i];
  }
  return n;
}

static gg_status test_drift(const gg_campaign *c, gg_quantity q, gg_drift *drift, gg_error *err)
{
  int k;
  const gg_derived *d = find_derived(c, q, &k);
  *drift = (gg_drift){.z = NAN, .relative = NAN, .correlation_rows = 0.5};
  size_t n = gg_series_window_rows(&c->replicas[0].series);
  if (!d || n < 24) return GG_OK;
  double *y = gg_new_array(n * (size_t)c->n, sizeof *y, err);
  if (!y) return GG_FAILED;
  for (int r = 0; r < c->n; r++) {
    const gg_replica *p = &c->replicas[r];
    for (size_t i = 0; i < n; i++)
      y[(size_t)r * n + i] = d->of(gg_series_row(&p->series, p->series.window + i) + p->offset[k], &c->model);
  }
  gg_status status = gg_drift_test(y, n, (size_t)c->n, drift, err);
  free(y);
  return status;
}

gg_status gg_campaign_judge(gg_campaign *c, gg_judgement *j, gg_error *err)
{
  *j = (gg_judgement){.relative_error = 0, .trusted = true};
  gg_quantity list[GG_N_QUANTITIES];
  int headline = gg_headline(&c->model, list), n = watched(c, list);
  double per_row = (double)c->replicas[0].series.per_row;
  for (int i = 0; i < n; i++) {
    gg_mean m;
    GG_TRY(gg_campaign_mean(c, list[i], &m, err));
    j->slowest = fmax(j->slowest, m.correlation_rows * per_row);
    if (i < headline) {
      double relative = m.error / fabs(m.mean);
      if (!(relative <= j->relative_error)) j->relative_error = relative, j->worst = list[i];
      if (!m.trusted) j->trusted = false;
    }
    if (c->model.small_shear) continue;
    gg_drift d;
    GG_TRY(test_drift(c, list[i], &d, err));
    if (fabs(d.z) > DRIFT_Z && fabs(d.relative) > DRIFT_NEGLIGIBLE && fabs(d.z) > fabs(j->drift_z)) {
      j->drifting = true;
      j->drifter = list[i];
      j->drift_z = d.z, j->drift_relative = d.relative;
    }
  }
  c->last = *j;
  return GG_OK;
}
