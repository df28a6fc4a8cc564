/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "run/protocol_times.h"

#include <math.h>
#include <stdlib.h>

#include "base/memory.h"
#include "common/engine_grains.h"
#include "run/run.h"
#include "scene/fields.h"
#include "scene/model_of_scene.h"
#include "theory/relaxation.h"

enum { INTERVALS = 100 };

/* At the ends of steps of the shear rate, where these are. */
static int intervals_of(const gg_scene *s)
{
  const int64_t steps = gg_scene_shear_steps(s);
  return steps > 0 ? (int)steps : INTERVALS;
}

/* The k-th of the evenly spaced times and the times of changes, each once; INFINITY beyond the last. User's units. */
static double user_time(const gg_scene *s, uint64_t k)
{
  const int intervals = intervals_of(s);
  double time = 0;
  if (!*s->protocol[0].key) return k > (uint64_t)intervals ? INFINITY : s->run.duration * (double)k / intervals;
  for (int even = 1, next = 0; k > 0; k--) {
    const double at = next < gg_scene_protocol_count(s, INFINITY) ? s->protocol[next].at : INFINITY;
    if (even > intervals) return INFINITY;
    time = fmin(at, s->run.duration * even / intervals);
    even += time == s->run.duration * even / intervals;
    next = gg_scene_protocol_count(s, time);
  }
  return time;
}

uint64_t gg_run_protocol_samples(const gg_scene *s)
{
  uint64_t k = (uint64_t)intervals_of(s);
  while (user_time(s, k + 1) < INFINITY) k++;
  return k;
}

double gg_run_protocol_time(const gg_scene *s, uint64_t k)
{
  return user_time(s, k) * gg_scene_clock_rate(s);
}

double gg_run_protocol_shear_rate(const gg_scene *s, uint64_t k)
{
  const int64_t n = gg_scene_shear_steps(s), step = (int64_t)(user_time(s, k) / s->run.duration * (double)n + 1e-6);
  return gg_scene_shear_rate(s, step < n ? step : n - 1) / gg_scene_clock_rate(s);
}

bool gg_run_protocol_is_forward(const gg_scene *s)
{
  bool forward = gg_scene_shear_steps(s) == 0 && s->shear.rate > 0;
  for (int n = 1; forward && n <= gg_scene_protocol_count(s, INFINITY); n++) {
    gg_scene then;
    forward = gg_scene_protocol_apply(s, n, &then, NULL) != GG_OK || then.shear.rate > 0;
  }
  return forward;
}

static gg_status make_model(const gg_scene *scene, const gg_model *model, int changes, gg_model *changed, gg_error *err)
{
  gg_scene then;
  GG_TRY(gg_scene_protocol_apply(scene, changes, &then, err));
  then.fixed.contact_time = scene->fixed.contact_time;
  GG_TRY(gg_run_start_make(&then, NULL, model->stop, changed, err));
  GG_TRY(gg_common_engine_of(scene->engine)->accepts(changed, err));
  return gg_common_is_same_gas(model, changed)
             ? GG_OK
             : GG_REFUSE(err, "key 'protocol': at %g: this value of %s needs other grains or units",
                         scene->protocol[changes - 1].at, scene->protocol[changes - 1].key);
}

int gg_run_protocol_changes(const gg_scene *scene, uint64_t k)
{
  return gg_scene_protocol_count(scene, user_time(scene, k));
}

gg_status gg_run_protocol_model(const gg_scene *scene, const gg_model *model, int changes, gg_model *changed,
                                gg_error *err)
{
  return changes ? make_model(scene, model, changes, changed, err) : (*changed = *model, GG_OK);
}

gg_status gg_run_protocol_end_scene(const gg_scene *scene, gg_scene *end, gg_error *err)
{
  GG_TRY(gg_scene_protocol_apply(scene, gg_scene_protocol_count(scene, INFINITY), end, err));
  if (gg_scene_shear_steps(scene) > 0) end->shear.rate = 0, *end->shear.formula = '\0'; /* no steady shear */
  return GG_OK;
}

gg_status gg_run_protocol_end_model(const gg_scene *scene, gg_engine_kind engine, gg_model *model, gg_error *err)
{
  gg_scene end;
  GG_TRY(gg_run_protocol_end_scene(scene, &end, err));
  return gg_scene_model_make(&end, engine, model, err);
}

gg_status gg_run_protocol_check(const gg_scene *scene, const gg_model *model, gg_error *err)
{
  GG_FREED gg_model *changed = gg_base_array_new(1, sizeof *changed, err);
  if (!changed) return GG_FAILED;
  for (int n = 1; n <= gg_scene_protocol_count(scene, INFINITY); n++) GG_TRY(make_model(scene, model, n, changed, err));
  return GG_OK;
}

/* Estimate of the temperature that the gas tends to; `last` where it tends to none. */
static double steady_temperature(const gg_scene *scene, const gg_model *m, double last)
{
  gg_scene start = *scene;
  gg_model steady;
  start.fixed.clock_rate = gg_scene_clock_rate(scene);
  start.start.temperature = GG_AUTO;
  const bool known = m->steady && !gg_flow_cools(m->flow);
  return known && gg_scene_model_make(&start, scene->engine, &steady, NULL) == GG_OK ? steady.temperature0 : last;
}

double gg_run_protocol_collisions(const gg_scene *scene, const gg_model *model)
{
  const uint64_t n = gg_run_protocol_samples(scene);
  gg_relaxing x = gg_theory_relaxation_start(model);
  x.work /= 2; /* every run begins with this */
  x.stop = model->stop;
  x.stride = 1.5;
  double sum = 0, T = x.T;
  int made = 0;
  GG_FREED gg_model *now = malloc(sizeof *now);
  if (now) *now = *model;
  for (uint64_t k = 0; now && k < n; k++) {
    const double dt = gg_run_protocol_time(scene, k + 1) - gg_run_protocol_time(scene, k);
    const int changes = gg_scene_protocol_count(scene, user_time(scene, k));
    gg_scene then;
    if (gg_scene_protocol_apply(scene, changes, &then, NULL) != GG_OK ||
        (changes != made && gg_scene_model_make(&then, scene->engine, now, NULL) != GG_OK))
      break;
    const bool begins = k == 0 || changes != made;
    made = changes;
    if (gg_scene_shear_steps(scene) > 0) now->shear_rate = gg_run_protocol_shear_rate(scene, k);
    const double before = x.collisions;
    if (gg_theory_relaxation_name(now))
      gg_theory_relax(now, dt, &x);
    else
      x = gg_theory_relaxation_lost();
    T = !isnan(x.T) ? x.T : begins ? steady_temperature(&then, now, T) : T;
    sum += isnan(x.T) ? dt * gg_common_model_collision_rate(now, T) : x.collisions - before;
  }
  return sum;
}
