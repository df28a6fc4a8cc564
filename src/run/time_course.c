/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "run/time_course.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/memory.h"
#include "common/engine_grains.h"
#include "run/oscillation.h"
#include "run/protocol_times.h"
#include "run/series_means.h"
#include "scene/fields.h"
#include "theory/relaxation.h"

static double itself(const double *value, const gg_model *m)
{
  (void)m;
  return *value;
}

/* A function of the history has its quantity from a logarithm, of which the mean would be a geometric one. */
static bool is_of_one_row(const gg_observable *o, const gg_function *f)
{
  for (const gg_derived *d = o->rows->history; d && d->quantity != GG_MOST_QUANTITIES; d++)
    if (f->of ? d->of == f->of : d->each == f->each) return true;
  return false;
}

/* Factor of a value that was computed with this model: of the followed quantities only the viscosity depends on a key
 * that may change. The stress of a sample has the shear rate up to that time. */
static double factor_of(const gg_replicas *all, const gg_model *m, gg_quantity q, size_t row)
{
  if (q != GG_Q_SHEAR_VISCOSITY) return 1;
  gg_scene now;
  const int changes = row > 0 ? gg_run_protocol_changes(&all->scene, row - 1) : 0;
  if (!gg_run_protocol_is_forward(&all->scene)) return NAN;
  if (changes == 0) return m->shear_rate / all->model.shear_rate;
  if (gg_scene_protocol_apply(&all->scene, changes, &now, NULL) != GG_OK) return NAN;
  return m->shear_rate / (all->model.shear_rate * now.shear.rate / all->scene.shear.rate);
}

/* Mean of a function of the channels of observable k over the sample `row` of all replicas, with their present
 * model. NaN where memory fails, which run.c reports. */
static gg_mean over_replicas(const gg_replicas *all, const gg_function *f, int k, size_t row, gg_quantity q)
{
  const size_t n = (size_t)all->n;
  const gg_replica *first = all->replica;
  const bool one = is_of_one_row(first->sampler.observable[k], f);
  const size_t channels = one ? 1 : first->sampler.observable[k]->rows->width(&first->model);
  gg_mean m = {.mean = NAN, .error = NAN, .correlation_rows = NAN};
  GG_FREED double *value = gg_base_array_new(n + 2 * channels, sizeof *value, NULL);
  GG_FREED const double **of = gg_base_array_new(n, sizeof *of, NULL);
  for (size_t i = 0; value && of && i < n; i++) {
    const gg_replica *r = &all->replica[i];
    of[i] = gg_series_row(&r->series, row) + r->sampler.offset[k];
    if (one) value[i] = gg_function_value(*f, of[i], &r->model), of[i] = &value[i];
  }
  if (value && of)
    m = gg_statistics_estimate_over_runs(of, n, channels, one ? (gg_function){.of = itself} : *f, &first->model,
                                         value + n);
  const double factor = factor_of(all, &first->model, q, row);
  m.mean *= factor, m.error *= factor;
  return m;
}

gg_mean gg_run_time_course_end(const gg_replicas *all, gg_quantity q)
{
  gg_function f;
  const gg_replica *r = &all->replica[0];
  const int k = gg_measure_sampler_find(&r->sampler, q, &f);
  if (k < 0 || r->series.n < 2) return (gg_mean){.mean = NAN, .error = NAN, .correlation_rows = NAN};
  return over_replicas(all, &f, k, r->series.n - 1, q);
}

#define LITTLE 0.05 /* seconds of processor time, so that an interrupted run reports its result soon */

/* Kinetic theory at each of the times, from the temperatures of the start; NaN after a change to a gas that no theory
 * describes, and after an interruption. */
static gg_status integrate(const gg_replicas *all, gg_relaxing *at, gg_error *err)
{
  const gg_scene *s = &all->scene;
  const gg_run_callbacks *of = all->callbacks;
  const gg_stop stop = {of ? of->interrupted : NULL, of ? of->context : NULL}; /* no time limit */
  const bool interrupted = stop.asked && gg_stop_asked(&stop);
  gg_relaxing x = gg_theory_relaxation_start(&all->model);
  if (interrupted) x.work = LITTLE;
  x.stop = stop.asked && !interrupted ? &stop : NULL;
  int changes = 0;
  gg_status status = GG_OK;
  GG_FREED gg_model *model = gg_base_array_new(2, sizeof *model, err);
  if (!model) return GG_FAILED;
  gg_model *start = model + 1;
  *start = all->model;
  start->stop = stop.asked ? &stop : NULL;
  for (size_t k = 0; status == GG_OK && k < all->replica[0].series.n; k++) {
    if (k > 0 && gg_scene_shear_steps(s) > 0) model->shear_rate = gg_run_protocol_shear_rate(s, k - 1);
    if (k > 0) gg_theory_relax(model, gg_run_protocol_time(s, k) - gg_run_protocol_time(s, k - 1), &x);
    if (x.stop) status = gg_stop_check(x.stop, err);
    at[k] = x;
    if (k > 0 && gg_scene_shear_steps(s) > 0 && x.work >= 0) { /* at the end of a step the rate is between two */
      model->shear_rate = (gg_run_protocol_shear_rate(s, k - 1) + gg_run_protocol_shear_rate(s, k)) / 2;
      gg_theory_relaxation_stress(model, &at[k]);
    }
    if (status != GG_OK || (k > 0 && changes == gg_run_protocol_changes(s, k))) continue;
    changes = gg_run_protocol_changes(s, k);
    status = gg_run_protocol_model(s, start, changes, model, err);
    if (status == GG_INTERRUPTED && interrupted)
      status = GG_OK, x = gg_theory_relaxation_lost();
    else if (status == GG_OK && !gg_theory_relaxation_name(model))
      x = gg_theory_relaxation_lost();
  }
  return status;
}

static bool is_stress(gg_quantity q)
{
  static const gg_quantity stresses[] = {GG_Q_PRESSURE, GG_Q_P_XX, GG_Q_P_YY, GG_Q_P_ZZ,
                                         GG_Q_P_XY,     GG_Q_N1,   GG_Q_N2,   GG_Q_SHEAR_VISCOSITY};
  for (size_t k = 0; k < sizeof stresses / sizeof *stresses; k++)
    if (q == stresses[k]) return true;
  return false;
}

static bool is_shown(const gg_model *m, gg_quantity q)
{
  if (gg_model_is_sheared(m) && (is_stress(q) || q == GG_Q_SPIN_Z || q == GG_Q_COS2_PSI)) return true;
  return q == GG_Q_TEMPERATURE || q == GG_Q_ROTATIONAL_TEMPERATURE || q == GG_Q_TEMPERATURE_RATIO || q == GG_Q_A2 ||
         (q >= GG_Q_PARTIAL_TEMPERATURE && q < GG_Q_PARTIAL_TEMPERATURE + GG_MAX_SPECIES);
}

/* From sample `first` on; `theory`: at every time; NULL: there is none. */
static void add_curve(const gg_replicas *all, const gg_quantity_row *row, const gg_function *f,
                      const gg_relaxing *theory, size_t first, gg_curves *list)
{
  const gg_replica *r = &all->replica[0];
  char name[64], symbol[32], panel[64];
  gg_common_quantity_enhanced(row->quantity, symbol, sizeof symbol);
  snprintf(name, sizeof name, first ? "%.36s_after_changes" : "%.36s_in_time", row->name);
  snprintf(panel, sizeof panel, first ? "%s after the last change" : "%s", symbol);
  gg_curve *c = gg_measure_curve_add(list, r->series.n - first, name, panel, "measured");
  gg_measure_curve_axes(c, "t", gg_measure_curve_unit(&all->model, "time"), symbol, row->unit);
  c->samples = (uint64_t)all->n;
  const bool beside = theory && !isnan(gg_theory_relaxation_value(&all->model, theory, row->quantity));
  if (beside) gg_measure_curve_beside(c, gg_theory_relaxation_name(&all->model), gg_measure_curve_level, &(double){0});
  for (size_t i = 0; beside && c->reference && i < c->n; i++)
    c->reference[i] = factor_of(all, &all->model, row->quantity, first + i) *
                      gg_theory_relaxation_value(&all->model, &theory[first + i], row->quantity);
  double least = INFINITY, most = -INFINITY;
  for (size_t i = 0; i < c->n; i++) {
    const gg_mean m = over_replicas(all, f, 0, first + i, row->quantity);
    const bool unknown = first + i == 0 && is_stress(row->quantity); /* the start has no collisions */
    least = fmin(least, m.mean), most = fmax(most, m.mean);
    c->x[i] = gg_run_protocol_time(&all->scene, first + i);
    c->value[i] = unknown ? NAN : m.mean, c->error[i] = unknown ? NAN : m.error;
  }
  const bool begins_at_0 = row->quantity == GG_Q_N1 || row->quantity == GG_Q_SHEAR_VISCOSITY;
  c->log_y = least > 0 && most > 30 * least && !begins_at_0;
}

/* The sample at which the last change was made; 0: there was none. */
static size_t last_change(const gg_replicas *all)
{
  const gg_scene *s = &all->scene;
  const int n = gg_scene_protocol_count(s, INFINITY);
  size_t k = 0;
  while (n > 0 && k + 1 < all->replica[0].series.n && gg_run_protocol_changes(s, k) < n) k++;
  return k;
}

gg_status gg_run_time_course_curves(const gg_replicas *all, gg_result *result, gg_error *err)
{
  gg_curves *list = &result->curves;
  const bool known = gg_theory_relaxation_name(&all->model) != NULL;
  GG_FREED gg_relaxing *theory = gg_base_array_new(all->replica[0].series.n + 1, sizeof *theory, err);
  if (!theory) return GG_FAILED;
  const size_t changed = last_change(all);
  if (gg_flow_is_sheared(all->scene.flow) && (gg_scene_shear_steps(&all->scene) > 0 || all->scene.shear.rate <= 0))
    GG_WARN(result, "gamma in the units of results is the largest absolute shear rate%s, %g",
            all->scene.shear.rate < 0 ? " at the start" : "", gg_scene_unit_rate(&all->scene));
  gg_status status = known ? integrate(all, theory, err) : GG_OK;
  list->group = "relaxation";
  for (int i = 0; i < result->rows.n; i++) {
    gg_function f;
    const gg_quantity_row *row = &result->rows.row[i];
    if (row->quantity == GG_Q_SHEAR_VISCOSITY && !gg_run_protocol_is_forward(&all->scene)) continue;
    if (is_shown(&all->model, row->quantity) &&
        gg_measure_sampler_find_history(&all->replica[0].sampler, row->quantity, &f))
      add_curve(all, row, &f, known ? theory : NULL, 0, list);
    /* Changes after the last step of the protocol may be small beside those before it: add a separate curve. */
    if (row->quantity == GG_Q_TEMPERATURE && changed > 0 && changed + 1 < all->replica[0].series.n &&
        gg_measure_sampler_find_history(&all->replica[0].sampler, row->quantity, &f))
      add_curve(all, row, &f, known ? theory : NULL, changed, list);
  }
  list->group = NULL;
  if (status == GG_OK && all->scene.shear.period != GG_AUTO && gg_scene_shear_steps(&all->scene) > 0)
    status = gg_run_oscillation_curves(all, known ? theory : NULL, list, err);
  GG_TRY(status);
  return list->failed ? gg_base_out_of_memory_for(err, "the curves in time") : GG_OK;
}
