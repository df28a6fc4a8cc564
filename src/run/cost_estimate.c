/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "run/cost_estimate.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "measure/observable.h"
#include "run/protocol_times.h"
#include "run/replica.h"
#include "run/replicas.h"
#include "scene/model_of_scene.h"
#include "theory/effort.h"

#define PROGRAM 18e6 /* bytes: the program and its libraries */
#define BLOCKS 0.5e6 /* of the bins of an observable, in blocks */

/* Flags; all that are requested where memory is short. */
static unsigned measured(const gg_scene *scene, const gg_model *m)
{
  unsigned flags;
  return gg_run_measured(scene, m, &flags, NULL) == GG_OK ? flags : scene->measure;
}

/* Add memory of snapshots and observables, and time of observables. The time of rheology is part of the engine's. */
static void add_observables(gg_cost_estimate *f, const gg_scene *scene, const gg_model *m, gg_engine_kind engine)
{
  double vectors = 0;
  const unsigned flags = measured(scene, m);
  for (int i = 0; gg_measure_observables[i]; i++) {
    const gg_observable *o = gg_measure_observables[i];
    if (!(flags & o->flag)) continue;
    const gg_observable_cost cost = o->cost_of ? o->cost_of(m) : o->cost;
    if (o->curves)
      vectors = fmax(vectors, (m->rule != GG_SMOOTH ? 2 : 1) + (o->positions && !m->homogeneous ? 1.5 : 0));
    f->observables += cost.bytes * (double)m->n + (o->curves ? BLOCKS : 0);
    const double ns = cost.ns[engine];
    if (ns <= 0) continue;
    f->cost[f->n_costs].name = o->name;
    f->cost[f->n_costs++].percent = 100 * ns / f->ns;
  }
  f->observables += vectors * sizeof(gg_vec) * (double)m->n;
}

/* Collisions per grain until all requested errors are reached. */
static double for_error(const gg_scene *scene, const gg_model *m)
{
  double most = 0;
  for (gg_quantity q = 0; q < GG_N_QUANTITIES; q++) {
    const double error = gg_run_criteria_error_of(scene, m, q);
    if (isfinite(error)) most = fmax(most, gg_theory_effort(m, q) / (error * error));
  }
  return most / ((double)m->n * (double)scene->run.replicas);
}

static void plan_time(gg_cost_estimate *f, const gg_scene *scene, const gg_model *m)
{
  const gg_stopping_criteria p = gg_run_criteria_of(scene, m);
  double window = (double)p.most * GG_SAMPLING_INTERVAL;
  const bool followed = gg_scene_is_followed(scene);
  if (followed) window = gg_run_protocol_collisions(scene, m);
  if (p.relative_error > 0 && !followed) {
    double least = (double)p.least * GG_SAMPLING_INTERVAL, needed = for_error(scene, m);
    needed = fmax(1.5 * least, 1.15 * needed);
    window = p.most ? fmin(window, needed) : needed;
    f->to_an_error = true;
  }
  f->limit = p.time_limit;
  double added = 0;
  for (int i = 0; i < f->n_costs; i++) added += f->cost[i].percent / 100;
  f->collisions = (double)p.warmup * GG_SAMPLING_INTERVAL + window;
  f->seconds = f->collisions * (double)m->n / 2 * (double)scene->run.replicas * f->ns * (1 + added) * 1e-9;
}

/* Means, series and the document, and frames: three numbers each for positions, velocities and spins. */
static void plan_file(gg_cost_estimate *f, const gg_scene *scene, const gg_model *m)
{
  const unsigned there =
      GG_FIELDS_VELOCITY | (m->homogeneous ? 0 : GG_FIELDS_POSITION) | (m->rule == GG_SMOOTH ? 0 : GG_FIELDS_SPIN);
  const bool images = !m->homogeneous && !m->ensemble && (scene->output.fields & GG_FIELDS_IMAGE);
  const double every = scene->output.trajectory_every, item = scene->output.precision == GG_SINGLE ? 4 : 8;
  const double warmup = (double)gg_run_criteria_of(scene, m).warmup * GG_SAMPLING_INTERVAL;
  const double followed = f->collisions - (scene->output.after == GG_AFTER_WARMUP ? warmup : 0);
  const double rows = fmin(f->collisions / GG_SAMPLING_INTERVAL, GG_SERIES_ROWS);
  f->frames = 1 + (every > 0 ? floor(followed / fmax(every, GG_SAMPLING_INTERVAL)) : 0);
  f->file = 2e5 + 8 * rows * (m->rule == GG_SMOOTH ? 12 : 16) + 25 * (double)m->n +
            f->frames * (3 * item * __builtin_popcount(there & scene->output.fields) * (double)m->n + 200) +
            (images && every > 0 ? 12 * f->frames * (double)m->n : 0);
}

gg_cost_estimate gg_run_cost_estimate(const gg_scene *scene, const gg_model *m, gg_engine_kind engine)
{
  gg_cost_estimate f = {.engine = gg_common_engine_of(engine)->bytes(m),
                        .ns = gg_common_engine_of(engine)->nanoseconds(m)};
  add_observables(&f, scene, m, engine);
  plan_time(&f, scene, m);
  f.series = fmin(f.collisions / GG_SAMPLING_INTERVAL, GG_SERIES_ROWS) * 8 * (m->rule == GG_SMOOTH ? 120 : 200);
  double frame = (double)m->n * (24 + sizeof(gg_vec) * (1 + (m->rule != GG_SMOOTH) + !m->homogeneous));
  double replicas = (double)scene->run.replicas, each = f.engine + f.observables + f.series;
  f.writing = 3.5 * frame; /* the grains, the file's image as it grows, and the whole of it */
  f.bytes = PROGRAM + fmax(replicas * each + frame, f.writing + f.observables);
  plan_file(&f, scene, m);
  return f;
}

/* Below this solid fraction Monte Carlo is exact within the errors of any run. */
#define DILUTE 0.002

double gg_run_cost_dilute(const gg_scene *scene, const gg_model *md)
{
  GG_FREED gg_model *m = md->phi < DILUTE ? malloc(sizeof *m) : NULL;
  if (!m || gg_scene_model_make(scene, GG_DSMC, m, NULL) != GG_OK ||
      gg_common_engine_of(GG_DSMC)->accepts(m, NULL) != GG_OK || measured(scene, m) != scene->measure)
    return 0;
  return gg_common_engine_of(GG_MD)->nanoseconds(md) / gg_common_engine_of(GG_DSMC)->nanoseconds(m);
}

/* "1.2 GB" */
static void put_bytes(double bytes, char text[24])
{
  static const char *const units[] = {"kB", "MB", "GB", "TB", "PB"};
  int unit = 0;
  for (bytes /= 1000; bytes >= 999.5 && unit < 4; unit++) bytes /= 1000;
  snprintf(text, 24, "%.3g %s", bytes, units[unit]);
}

gg_status gg_run_cost_check_memory(const gg_cost_estimate *f, const char *engine, int64_t replicas, gg_error *err)
{
  char needed[24], there[24], one[24];
  const double available = gg_base_memory_available();
  if (!(f->bytes > available)) return GG_OK;
  put_bytes(f->bytes, needed);
  put_bytes(available, there);
  put_bytes(f->engine + f->observables + f->series, one);
  return gg_base_fail(err, GG_FAILED,
                      "%s: the run would need about %s of memory (%s a replica, of which there are %lld), and there "
                      "are %s; ask for fewer %s, replicas or observables",
                      engine, needed, one, (long long)replicas, there,
                      strcmp(engine, "dsmc") == 0 ? "dsmc.particles" : "particles");
}

/* "3 s", "12 min", "4 h", "20 days" */
static void put_time(double seconds, char text[24])
{
  const struct {
    double length;
    const char *name;
  } units[] = {{86400 * 3, "days"}, {3600 * 2, "h"}, {120, "min"}, {0, "s"}};
  const double one[] = {86400, 3600, 60, 1};
  int k = 0;
  while (seconds < units[k].length) k++;
  snprintf(text, 24, "%.2g %s", seconds / one[k], units[k].name);
  if (seconds / one[k] >= 99.5) snprintf(text, 24, "%.0f %s", seconds / one[k], units[k].name);
}

static void describe_costs(const gg_cost_estimate *f, void (*line)(void *context, const char *text), void *context)
{
  char text[600] = "observables, in per cent of the run without them:";
  if (!f->n_costs) return;
  for (int i = 0; i < f->n_costs; i++) {
    size_t used = strlen(text);
    snprintf(text + used, sizeof text - used, "%s %s %.*f", i ? "," : "", f->cost[i].name,
             f->cost[i].percent < 1 ? 1 : 0, f->cost[i].percent);
  }
  line(context, text);
}

void gg_run_cost_report(const gg_cost_estimate *f, int64_t replicas, void (*line)(void *context, const char *text),
                        void *context)
{
  char all[24], engine[24], observables[24], text[300], series[24];
  put_bytes(f->bytes, all);
  put_bytes(f->engine, engine);
  put_bytes(f->observables, observables);
  put_bytes(f->series, series);
  snprintf(text, sizeof text, "memory: about %s; a replica: engine %s, observables %s, series %s", all, engine,
           observables, series);
  line(context, text);
  put_time(f->seconds, all);
  snprintf(text, sizeof text, "time: about %s of one processor, within a factor of %s, for %.3g collisions a grain%s%s",
           all, f->to_an_error ? "three" : "two", f->collisions, replicas > 1 ? " and replica" : "",
           f->to_an_error ? " (until the requested error)" : "");
  line(context, text);
  if (f->limit > 0) {
    put_time(f->limit, all);
    snprintf(text, sizeof text, "time limit: %s of wall clock%s", all,
             f->seconds > f->limit ? ", less than one processor is expected to need" : "");
    line(context, text);
  }
  put_bytes(f->file, all);
  snprintf(text, sizeof text, "result file: about %s, with %.4g frame%s of the grains", all, f->frames,
           f->frames > 1 ? "s" : "");
  line(context, text);
  describe_costs(f, line, context);
}
