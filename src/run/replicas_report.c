/* SPDX-License-Identifier: GPL-3.0-or-later */
/* From where the replicas stand to a result. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/clock.h"
#include "base/memory.h"
#include "common/finite_size.h"
#include "run/causes.h"
#include "run/default_size.h"
#include "run/replica.h"
#include "run/replicas.h"
#include "run/series_means.h"
#include "run/time_course.h"
#include "scene/ensemble_size.h"
#include "scene/fields.h"

/* Model that the values belong to: in a transient run that after the protocol's changes so far. */
static const gg_model *gas_of(const gg_replicas *all)
{
  return &all->replica[0].model;
}

/* Why a quantity is unknown: the scene lacks it, nothing measures it, or the run is too short, which is a warning. */
static const char *why_missing(const gg_replicas *all, gg_quantity q, gg_result *result)
{
  if (q >= GG_N_QUANTITIES && all->state.averaging) return "its observable returned NaN or infinite values";
  if (!all->state.averaging) return "nothing was averaged: the run ended in its warm-up";
  if (all->replica[0].sampler.n_observables == 0) return "nothing is measured in this scene";
  gg_function f;
  if (gg_measure_sampler_find(&all->replica[0].sampler, q, &f) >= 0 && f.unknown)
    return GG_WARN(result, "%s: %s", gg_common_quantity_name(q), f.unknown), f.unknown;
  const char *reason = gg_common_quantity_missing(gas_of(all), q);
  return reason ? reason : "not measured in this scene";
}

static gg_status report_means(gg_replicas *all, double memory, gg_result *result, gg_error *err)
{
  const gg_series *s = &all->replica[0].series;
  size_t rows = gg_series_window_rows(s);
  double row_length = rows > 1 ? (s->end_time[s->n - 1] - s->end_time[s->window]) / (double)(rows - 1) : NAN;
  if (gg_run_quantity_counts_in_collisions(&all->model)) row_length = (double)s->per_row * GG_SAMPLING_INTERVAL;
  const bool followed = gg_scene_is_followed(&all->scene);
  for (int i = 0; i < result->rows.n; i++) {
    const gg_quantity q = result->rows.row[i].quantity;
    gg_estimate *e = &result->value[q];
    *e = (gg_estimate){.mean = NAN, .error = NAN, .correlation_time = NAN};
    if (!gas_of(all)->steady && !(gg_common_quantity_mask(q) & GG_KEPT_HEATING)) {
      snprintf(e->reason, sizeof e->reason,
               all->model.linear_response ? "its temperature rises and falls"
                                          : "no steady state: the gas heats up; see the history");
      continue;
    }
    gg_mean m = {.mean = NAN};
    if (followed)
      m = gg_run_time_course_end(all, q);
    else if (all->state.averaging)
      GG_TRY(gg_run_replicas_mean(all, q, memory, &m, err));
    if (!isfinite(m.mean)) {
      snprintf(e->reason, sizeof e->reason, "%s", why_missing(all, q, result));
      continue;
    }
    e->mean = m.mean, e->error = m.error;
    e->correlation_time = m.correlation_rows * row_length;
    e->samples = (followed ? 1 : rows * s->per_row) * (uint64_t)all->n; /* at the end, of each replica one */
    if (isfinite(m.error) && !followed) result->correlations.quantity[result->correlations.n++] = q;
  }
  return gg_run_replicas_correlations(all, result, err);
}

static gg_status report_history(const gg_replicas *all, gg_result *result, gg_error *err)
{
  const gg_replica *r = &all->replica[0];
  gg_history *h = &result->history;
  h->n = r->series.n;
  h->time = gg_base_array_new(h->n, sizeof *h->time, err);
  if (!h->time) return GG_FAILED;
  for (size_t i = 0; i < h->n; i++) h->time[i] = r->series.end_time[i];
  h->window[0] = r->series.window > 0 ? h->time[r->series.window - 1] : 0;
  h->window[1] = h->n ? h->time[h->n - 1] : 0;
  for (int k = 0; k < GG_N_HISTORY; k++) {
    h->value[k] = gg_base_array_new(h->n, sizeof *h->value[k], err);
    if (!h->value[k]) return GG_FAILED;
    gg_function f;
    bool there = gg_measure_sampler_find_history(&r->sampler, gg_common_quantity_of_history(k), &f);
    for (size_t i = 0; i < h->n; i++)
      h->value[k][i] =
          there ? gg_function_value(f, gg_series_row(&r->series, i) + r->sampler.offset[0], &all->model) : NAN;
  }
  return GG_OK;
}

static void report_effort(const gg_replicas *all, gg_result *result)
{
  result->engine_state = (gg_engine_state){0};
  gg_engine_state *sum = &result->engine_state;
  for (int i = 0; i < all->n; i++) {
    const gg_replica *r = &all->replica[i];
    const gg_engine_state s = gg_engine_state_of(r->engine);
    if (i == 0) { /* in units of the start, whatever the engine's velocities have been multiplied by since */
      result->window_step = r->clock.window_collisions;
      sum->time = r->clock.time, sum->time_step_bias = s.time_step_bias;
      sum->particles_bias = all->model.ensemble ? gg_common_finite_size_bias_of(&all->model) : 0;
      sum->time_step = ldexp(s.time_step, (int)r->clock.power);
    }
    sum->collisions += s.collisions, sum->events += s.events;
    sum->treated += s.treated, sum->wall_treated += s.wall_treated, sum->overflows += s.overflows;
    sum->clamped += s.clamped;
    sum->overfilled = fmax(sum->overfilled, s.overfilled);
    sum->worst_overlap = fmax(sum->worst_overlap, s.worst_overlap);
    if (all->state.averaging) {
      result->averaging.collisions += s.collisions - r->clock.window_collisions;
      result->averaging.cpu_seconds += r->clock.cpu - r->clock.window_cpu;
    }
    result->total.cpu_seconds += r->clock.cpu;
  }
  result->total.collisions = sum->collisions;
  result->total.wall_seconds = all->state.wall + gg_base_clock_wall() - all->started;
  result->averaging.wall_seconds = NAN;
}

/* Warn of few grains where the scene gives their number: a size that is chosen keeps the bias below a fraction of the
 * requested error. */
static void warn_if_few(const gg_replicas *all, gg_result *result)
{
  const double bias = result->engine_state.particles_bias, asked = all->criteria.relative_error,
               most = gg_scene_ensemble_most_bias(all->model.flow);
  if (!(asked > 0 && bias > 1.001 * most * asked)) return;
  GG_WARN(result,
          "the ensemble of %lld grains biases means by up to %.2g %% (1/N), more than %s of the requested "
          "error: give dsmc.particles %.2g or more, or auto",
          (long long)all->model.n, 100 * bias, most < 0.5 ? "a quarter" : "half",
          bias / (most * asked) * (double)all->model.n);
}

/* Below, means are those of so few grains, in either engine: T of a sheared gas of 5 is 17 % low. */
enum { FEW_GRAINS = 100 };

static void warn_if_very_few(const gg_replicas *all, gg_result *result)
{
  const gg_model *m = &all->model;
  if (m->n >= FEW_GRAINS || (m->ensemble && all->criteria.relative_error > 0)) return; /* warn_if_few has it */
  GG_WARN(result, "%lld grains are few: means may lie up to %.2g %% off those of many (1/N); give %s %d or more",
          (long long)m->n, 100 * gg_common_finite_size_bias_of(m), m->ensemble ? "dsmc.particles" : "particles",
          FEW_GRAINS);
}

/* Freezing and melting fractions of hard spheres: Hoover & Ree, J. Chem. Phys. 49 (1968) 3609. md starts from random
 * places, and crystals seldom form within a run. Shear and unlike diameters keep grains from ordering. */
#define FREEZING 0.494

static void warn_if_undercooled(gg_result *result)
{
  const gg_model *m = &result->model;
  const bool alike = gg_common_model_widest(m) == gg_common_model_narrowest(m);
  if (m->homogeneous || m->walled || gg_model_is_sheared(m) || !alike || !(m->phi > FREEZING)) return;
  GG_WARN(result,
          "phi %.3g is above freezing (%.3g), where spheres of one diameter would crystallise; the run "
          "starts from random places, and its means are those of the metastable fluid",
          m->phi, FREEZING);
}

/* Work and noise less drag, loss and growth, measured apart, cancel but for errors. The splitting of steps and kicks
 * leaves less than LEAST_IMBALANCE. */
#define MOST_ERRORS 5
#define LEAST_IMBALANCE 0.005

static void warn_if_unbalanced(gg_result *result)
{
  const gg_estimate *e = &result->value[GG_Q_ENERGY_BALANCE];
  const double off = fabs(e->mean - 1);
  if (!(off > LEAST_IMBALANCE && off > MOST_ERRORS * e->error)) return;
  GG_WARN(
      result,
      "energy is not balanced: energy_balance is %.4g +- %.2g where it must be 1, %.1f errors off; means are biased%s",
      e->mean, e->error, off / e->error,
      result->model.ensemble ? "; give dsmc.time_step a smaller value or dsmc.particles a larger one" : "");
}

/* Warn of structure that the longest waves of the box show, or normal stresses: at rest or cooling, a homogeneous gas
 * has equal normal stresses. Free cooling breaks up into vortices and clusters in a box that is large enough
 * (Goldhirsch & Zanetti 1993): then means are those of that state. */
static void warn_if_structured(gg_result *result)
{
  char what[240];
  if (gg_run_structure(result, what, sizeof what)) {
    GG_WARN(result, "%s; means are those of this state", what);
    return;
  }
  const bool at_one_instant = gg_scene_is_followed(result->scene);
  if (gg_model_is_sheared(&result->model) || gg_flow_is_walled(result->model.flow) || at_one_instant) return;
  for (gg_quantity q = gg_common_quantity_next(-1, GG_STRESS_DIFFERENCE); q < GG_N_QUANTITIES;
       q = gg_common_quantity_next(q, GG_STRESS_DIFFERENCE)) {
    const gg_estimate *e = &result->value[q];
    if (q == GG_Q_N2 && gg_common_model_is_turned(&result->model)) continue; /* z is a direction of its own */
    if (!(fabs(e->mean) > 0.02 && fabs(e->mean) > 5 * e->error)) continue;
    GG_WARN(result,
            "the gas is not homogeneous: %s = %.3g +- %.2g where it should vanish (vortices or clusters; a "
            "smaller box or shorter run stays homogeneous)",
            gg_common_quantity_name(q), e->mean, e->error);
    return;
  }
}

/* In a box so narrow a grain's second neighbours are its own images. */
#define NARROW_BOX 4.0

static void warn_if_narrow(gg_result *result)
{
  const gg_model *m = &result->model;
  double narrowest = fmin(m->box[0], fmin(m->box[1], m->box[2])), widest = gg_common_model_widest(m);
  if (m->ensemble || narrowest >= NARROW_BOX * widest) return;
  GG_WARN(result,
          "the box is %.3g diameters wide: its grains meet the same few again and again, and means are "
          "those of so small a box; give particles a larger value",
          narrowest / widest);
}

/* If every contact slides, the force along a wall is mu times the force across it, whatever the gas does: a flow that
 * loses more energy than this force supplies dies, and a faster wall does not help. */
#define ALL_SLIDE 0.97

static void warn_if_walls_slip(gg_result *result)
{
  const gg_model *m = &result->model;
  const double mu = m->n_surfaces ? m->surface[0].contact[0].mu : INFINITY,
               ratio = result->value[GG_Q_WALL_FRICTION].mean;
  if (!m->walled || !(mu > 0 && isfinite(mu)) || !(ratio > ALL_SLIDE * mu)) return;
  GG_WARN(result,
          "%s: friction is at its limit in nearly all contacts (force along over force across %.3g, walls.mu %.3g)%s",
          m->n_surfaces > 1 ? "both walls slip" : "the wall slips", ratio, mu,
          result->steadiness == GG_STEADY
              ? ""
              : "; a flow that loses more energy than walls bring in so dies: give walls.mu a larger value");
}

/* Noise of mean densities and dense layers at walls exceed the limit in a smaller fraction. */
#define MOST_OVERFILLED 0.01

static void report_warnings(const gg_replicas *all, const gg_convergence *c, gg_result *result)
{
  const gg_engine_state *s = &result->engine_state;
  if (all->model.law.e && gg_scene_is_given(&all->scene, "collision.e"))
    GG_WARN(result, "collision.e was not in force, but " GG_OWN_LAW " '%s'", all->model.law.name);
  else if (all->model.law.e)
    GG_WARN(result, "in force was " GG_OWN_LAW " '%s'", all->model.law.name);
  if (s->clamped)
    GG_WARN(result,
            "%s '%s' has no allowed value at the speeds of %llu collisions (%.2g %%), which took the "
            "nearest allowed one (NaN: the least)",
            all->model.law.e ? GG_OWN_LAW : "the formula", all->model.law.name, (unsigned long long)s->clamped,
            100 * (double)s->clamped / (double)s->collisions);
  if (!gg_run_is_steady(result->steadiness) && !gg_scene_is_followed(&all->scene))
    GG_WARN(result, "not a steady mean: %s", result->steadiness_text);
  if (gg_run_is_steady(result->steadiness) && !c->trusted)
    GG_WARN(result, "some headline errors rest on fewer than %d blocks of five correlation times", GG_MIN_BLOCKS);
  if (all->scene.fixed.contact_time != GG_AUTO)
    GG_WARN(result,
            "md.contact_time: auto is %g here, since collisions accumulate without end at %g; grains in "
            "lasting contact lose less energy: see how means change from one to the other",
            all->scene.fixed.contact_time, all->scene.fixed.contact_time / 10);
  if ((double)s->treated > 1e-4 * (double)s->collisions)
    GG_WARN(result, "%.3g %% of collisions fell under the contact-time rule (e = 1 within t_c)",
            100 * (double)s->treated / (double)s->collisions);
  if (s->wall_treated > s->collisions / 100)
    GG_WARN(result, "%.3g contacts with walls %s: grains rest on a wall", (double)s->wall_treated,
            all->model.ensemble ? "would have left a grain at rest, which bounced for 1/64 of a step instead"
                                : "fell under the contact-time rule");
  if (s->overfilled > MOST_OVERFILLED)
    GG_WARN(result,
            "%.2g %% of grains are where they would fill more than 0.63 of space: Enskog's theory has no "
            "packed beds, and Monte Carlo packs grains beyond what fits; use engine: md",
            100 * s->overfilled);
  warn_if_structured(result);
  warn_if_narrow(result);
  warn_if_walls_slip(result);
  if (s->overflows > 1e-3 * (double)s->collisions)
    GG_WARN(result, "%.3g %% of collisions exceeded the majorant of the Monte Carlo step",
            100 * (double)s->overflows / (double)s->collisions);
  if (all->criteria.relative_error > 0 && s->time_step_bias > all->criteria.relative_error / 5)
    GG_WARN(result, "the Monte Carlo time step may bias results by %.2g %%, more than a fifth of the requested error",
            100 * s->time_step_bias);
  warn_if_few(all, result);
  warn_if_very_few(all, result);
  warn_if_undercooled(result);
  warn_if_unbalanced(result);
}

#define STRONG 0.6

/* Errors allow for blocks that depend on their neighbours; where they depend strongly the allowance is a guess. */
static void warn_of_short_blocks(gg_result *result, int from, const char *name)
{
  const gg_curve *worst = NULL;
  for (int i = from; i < result->curves.n; i++) {
    const gg_curve *c = &result->curves.curve[i];
    if (c->block_correlation > STRONG && (!worst || c->block_correlation > worst->block_correlation)) worst = c;
  }
  if (worst)
    GG_WARN(result,
            "%s: blocks of samples are no longer than a correlation time (neighbours' correlation %.2f, "
            "%s): its errors are rough; average longer",
            name, worst->block_correlation, worst->name);
}

/* Folded profiles hide a dense core that stays on one side. Warn if the mean position of the centre of mass is off the
 * middle by more than the grains' fluctuations. Its square must be half of the mean square or more, which happens in
 * windows of up to four correlation times. */
#define ASIDE_OF_GAP 0.01
#define ASIDE_SHARE 0.5

static void warn_of_one_side(const gg_slow_modes *w, gg_result *result)
{
  if (!(w->aside_share > ASIDE_SHARE && fabs(w->aside) > ASIDE_OF_GAP * result->model.box[1])) return;
  for (int i = 0; i < result->curves.n; i++) {
    if (!result->curves.curve[i].folded) continue;
    GG_WARN(result,
            "profiles are means of the flow and its mirror image, but the flow kept to one side: the centre "
            "of mass was %.2g d from the middle of the gap on average, %.2g d at root mean square",
            w->aside, fabs(w->aside) / sqrt(w->aside_share));
    return;
  }
}

static gg_status report_one(const gg_replicas *all, int k, double memory, gg_result *result, gg_error *err)
{
  const gg_replica *first = &all->replica[0];
  const gg_observable *o = first->sampler.observable[k];
  GG_FREED const gg_bins **bins = gg_base_array_new((size_t)all->n, sizeof *bins, err);
  if (!bins) return GG_FAILED;
  for (int r = 0; r < all->n; r++) bins[r] = &all->replica[r].sampler.bins[k];
  int before = result->curves.n;
  gg_status status =
      gg_measure_curves_estimate(bins, (size_t)all->n, o->curves->of_bins, first->sampler.self[k], o->name,
                                 memory / fmax(first->sampler.every[k], 1), &result->curves, err);
  if (status == GG_OK && !bins[0]->whole && (size_t)all->n * bins[0]->blocks < GG_MIN_BLOCKS)
    GG_WARN(result, "%s: too short for errors: its samples make %zu blocks only, %d are needed", o->name,
            (size_t)all->n * bins[0]->blocks, GG_MIN_BLOCKS);
  warn_of_short_blocks(result, before, o->name);
  return status;
}

static void warn_of_unmeasured(void *warnings, const char *text)
{
  gg_base_string_list_add(warnings, "%s", text);
}

static gg_status report_curves(const gg_replicas *all, const gg_slow_modes *slow, gg_result *result, gg_error *err)
{
  result->curves = (gg_curves){.model = &result->model};
  GG_TRY(gg_run_unmeasured(&all->scene, &all->model, warn_of_unmeasured, &result->warnings, err));
  for (int k = 0; k < all->replica[0].sampler.n_observables; k++)
    if (all->replica[0].sampler.observable[k]->curves) GG_TRY(report_one(all, k, slow->mean_time, result, err));
  warn_of_one_side(slow, result);
  return gg_scene_is_followed(&all->scene) ? gg_run_time_course_curves(all, result, err) : GG_OK;
}

gg_status gg_run_replicas_report(gg_replicas *all, gg_result *result, gg_error *err)
{
  gg_convergence c;
  result->scene = gg_scene_copy_new(&all->scene, err);
  if (!result->scene) return GG_FAILED;
  result->model = all->model;
  result->model.stop = NULL, result->model.start = NULL; /* they end with the run */
  result->engine = all->replica[0].engine->ops->name;
  gg_run_result_label(result);
  gg_slow_modes slow;
  GG_TRY(gg_run_replicas_slow_modes(all, &slow, err));
  GG_TRY(gg_run_replicas_convergence(all, &c, err));
  GG_TRY(report_means(all, slow.time, result, err));
  GG_TRY(report_history(all, result, err));
  report_effort(all, result);
  gg_run_replicas_report_steadiness(all, &c, result);
  if (all->model.ensemble)
    gg_scene_ensemble_size_reason(&all->scene, result->ensemble_text, sizeof result->ensemble_text);
  else
    gg_run_default_size_reason(&all->scene, result->ensemble_text, sizeof result->ensemble_text);
  report_warnings(all, &c, result);
  GG_TRY(report_curves(all, &slow, result, err));
  GG_TRY(gg_measure_frame_take(all->replica[0].engine, &all->model, all->replica[0].images, &result->final, err));
  gg_run_replica_date_frame(&all->replica[0], &result->final);
  return GG_OK;
}
