/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How long to warm up and average: from the stopping criteria and how slowly the slowest quantity relaxes. */
#include <math.h>

#include "common/linear_response.h"
#include "common/relaxation_times.h"
#include "run/protocol_times.h"
#include "run/replicas.h"
#include "scene/ensemble_size.h"

/* Relaxation times of the slowest mode: before averaging, and at least while averaging. A start within a few tens of
 * per cent of the steady state leaves less than 0.1 % of it after the first. */
enum { WARMUP_TIMES = 6, WINDOW_TIMES = 50 };
/* Between walls: relaxation times of the gap. A start that is symmetric has no part of the slowest wave, and relaxes
 * faster; how long averaging takes is seen from the waves themselves (measure/slow_modes.c). */
enum { WARMUP_GAP_TIMES = 3, WINDOW_GAP_TIMES = 10 };
/* Linear response: at least so many sweeps of the reduced shear rate. */
enum { LEAST_SWEEPS = 4 };
/* An error that this many of the shortest windows have not brought down is out of reach: a clustered or collapsing gas.
 */
enum { MOST_WINDOWS = 500 };

static uint64_t samples_for(double collisions)
{
  return (uint64_t)ceil(collisions / GG_SAMPLING_INTERVAL);
}

static void plan_linear_response(gg_stopping_criteria *p, const gg_scene *scene, const gg_model *m)
{
  double length = gg_common_linear_response_length(m);
  if (scene->run.warmup == GG_AUTO) p->warmup = samples_for(gg_common_linear_response_of(m).cools ? 10 : 40);
  p->least = samples_for(LEAST_SWEEPS * length);
  p->least_steady = p->least;
  p->longest = p->least * MOST_WINDOWS;
}

/* Collisions a grain: no shorter window is called steady. */
enum { SHORTEST_STEADY = 300 };
static bool asks_for_quantities(const gg_scene *scene)
{
  for (int q = 0; q < GG_N_QUANTITIES; q++)
    if (scene->run.until[q] > 0) return true;
  return false;
}

double gg_run_criteria_error_of(const gg_scene *scene, const gg_model *model, gg_quantity q)
{
  gg_quantity headline[GG_N_QUANTITIES];
  const int n = gg_run_headline_quantities(model, headline);
  if (scene->run.until[q] > 0) return scene->run.until[q];
  if (scene->run.relative_error == GG_AUTO && asks_for_quantities(scene)) return INFINITY;
  for (int i = 0; i < n; i++)
    if (headline[i] == q)
      return scene->run.relative_error != GG_AUTO ? scene->run.relative_error
                                                  : gg_scene_ensemble_requested_error(scene);
  return INFINITY;
}

gg_stopping_criteria gg_run_criteria_of(const gg_scene *scene, const gg_model *model)
{
  gg_stopping_criteria p = {.find_steady = scene->run.warmup == GG_AUTO && model->steady};
  double slowest = gg_common_model_relaxation(model), gap = gg_common_model_gap_relaxation(model);
  double warmup = fmax(fmax(40, WARMUP_TIMES * slowest), WARMUP_GAP_TIMES * gap);
  p.warmup = samples_for(scene->run.warmup == GG_AUTO ? warmup : scene->run.warmup);
  double relaxed = fmax(WINDOW_TIMES * slowest, WINDOW_GAP_TIMES * gap);
  /* No shorter window ends by its error. An ensemble collides so fast that it can afford to know its errors better:
   * where windows were as short as those of md, deviations were a fifth larger than the errors claimed. */
  p.least = samples_for(fmax(model->homogeneous ? 1000 : 300, relaxed));
  p.least_steady = samples_for(fmax(SHORTEST_STEADY, relaxed));
  p.longest = p.least * MOST_WINDOWS;
  if (scene->run.collisions != GG_AUTO) p.most = samples_for(scene->run.collisions);
  p.relative_error = gg_scene_ensemble_requested_error(scene);
  if (scene->run.time_limit != GG_AUTO) p.time_limit = scene->run.time_limit;
  if (gg_scene_is_followed(scene)) {
    p.warmup = 0, p.relative_error = 0, p.find_steady = false;
    p.least = p.most = gg_run_protocol_samples(scene);
  } else if (model->linear_response) {
    plan_linear_response(&p, scene, model);
  } else if (!model->steady || (model->law.name && gg_flow_cools(model->flow))) {
    /* never the same: nothing to wait for; follow it for as long as requested, or for a while */
    p.relative_error = 0;
    if (!p.most) p.most = samples_for(model->steady ? GG_COLLISIONS_FOLLOWED : 1000);
  } else if (gg_run_headline_quantities(model, (gg_quantity[GG_N_QUANTITIES]){0}) == 0 &&
             !asks_for_quantities(scene)) { /* nothing with a requested error: the shortest window */
    p.relative_error = 0;
    if (!p.most) p.most = p.least;
  }
  return p;
}
