/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Termination status of a run: whether it met the request, or why not. */
#include <math.h>

#include "run/protocol_times.h"
#include "run/replicas.h"

/* Collisions a grain and replica: of all the run, or of the averaging. */
static double collisions_a_grain(const gg_replicas *all, bool averaging)
{
  double sum = 0;
  for (int i = 0; i < all->n; i++) {
    const gg_replica *r = &all->replica[i];
    sum += gg_run_replica_collisions_per_grain(r);
    if (averaging) sum -= 2 * (double)r->clock.window_collisions / (double)all->model.n;
  }
  return sum / all->n;
}

static uint64_t window_of(const gg_replicas *all)
{
  return all->state.averaging ? all->state.due - all->state.window_at : 0;
}

static bool out_of_time(const gg_replicas *all)
{
  return atomic_load(&all->stopped) == GG_OUT_OF_TIME;
}

/* The requested error counts for means over a window long enough to know it. */
static gg_status check_error(const gg_replicas *all, const char *engine, gg_error *err)
{
  const gg_convergence *c = &all->last;
  const gg_stopping_criteria *criteria = &all->criteria;
  const uint64_t window = window_of(all);
  if (all->replica[0].sampler.n_observables == 0)
    return gg_base_fail(err, GG_FAILED,
                        "%s: nothing is measured: it is unknown whether the requested relative error %g is reached",
                        engine, criteria->relative_error);
  const bool cut = out_of_time(all) || (criteria->most && window >= criteria->most);
  if (cut && (window < criteria->least || !c->trusted))
    return gg_base_fail(err, GG_FAILED,
                        "%s: %s after %.0f collisions a grain of averaging, too few to know whether the requested "
                        "relative error %g is reached",
                        engine, out_of_time(all) ? "time limit reached" : "run.collisions ended the run",
                        collisions_a_grain(all, true), criteria->relative_error);
  if (c->relative_error <= criteria->relative_error) return GG_OK;
  const char *why = out_of_time(all) ? "time limit reached; " : "";
  if (isnan(c->relative_error))
    return gg_base_fail(err, GG_FAILED, "%s: %stoo short a run to know the error of %s", engine, why,
                        gg_common_quantity_name(c->worst));
  const double asked = gg_run_criteria_error_of(&all->scene, &all->model, c->worst);
  return gg_base_fail(err, GG_FAILED, "%s: %sthe requested relative error %g was not reached: %s has %.3g", engine, why,
                      asked, gg_common_quantity_name(c->worst), c->relative_error * asked / criteria->relative_error);
}

/* A requested error counts even where run.collisions ended the run first. */
static gg_status check_goal(const gg_replicas *all, const char *engine, gg_error *err)
{
  const gg_stopping_criteria *criteria = &all->criteria;
  const bool by_error = criteria->relative_error > 0;
  if (gg_scene_is_followed(&all->scene) && all->state.due < criteria->most)
    return gg_base_fail(err, GG_FAILED, "%s: time limit reached at time %.3g, short of run.duration", engine,
                        gg_run_protocol_time(&all->scene, all->state.due));
  if (!all->state.averaging || (!by_error && criteria->most && window_of(all) < criteria->most))
    return gg_base_fail(err, GG_FAILED, "%s: time limit reached after %.0f collisions a grain%s", engine,
                        collisions_a_grain(all, false),
                        all->state.averaging ? " and short of run.collisions" : ", in the warm-up");
  return by_error ? check_error(all, engine, err) : GG_OK;
}

gg_status gg_run_replicas_check_end(const gg_replicas *all, gg_error *err)
{
  const char *engine = all->replica[0].engine->ops->name;
  if (all->state.arrest_share > 0)
    return gg_base_fail(err, GG_FAILED,
                        "%s: stopped, as the grains have come to rest or nearly so: %.0f %% of collisions are contacts "
                        "that last, and fall under the contact-time rule; hard spheres need a flow",
                        engine, 100 * all->state.arrest_share);
  if (all->state.runaway > 0)
    return gg_base_fail(err, GG_FAILED,
                        "%s: stopped, as theta/T has come to %.1g: grains that spin fast have escaped friction, and "
                        "the metastable state is over; average over fewer collisions (run.collisions) of more grains",
                        engine, all->state.runaway);
  gg_status status = check_goal(all, engine, err);
  if (status == GG_OK || !out_of_time(all) || !(all->state.wall > all->criteria.time_limit)) return status;
  return gg_base_fail(err, GG_FAILED,
                      "%s: the time limit of %g s was over before: it counts from the run's first start; to continue, "
                      "set a larger run.time_limit",
                      engine, all->criteria.time_limit);
}
