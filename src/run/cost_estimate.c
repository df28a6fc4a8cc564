/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "run/cost_estimate.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "common/linear_response.h"
#include "common/relaxation_times.h"
#include "common/thermostat.h"
#include "measure/observable.h"
#include "run/protocol_times.h"
#include "run/replica.h"
#include "run/replicas.h"
#include "scene/model_of_scene.h"
#include "theory/theory_list.h"

#define PROGRAM 18e6 /* bytes: the program and its libraries */
#define BLOCKS 0.5e6 /* of the bins of an observable, in blocks */

/* Flags; all that are requested where memory is short. */
static unsigned measured(const gg_scene *scene, const gg_model *m)
{
  unsigned flags;
  return gg_run_measured(scene, m, &flags, NULL) == GG_OK ? flags : scene->measure;
}

/* Cells are as wide as the largest grain: how many more grains there are in one than of equal ones. */
static double crowding(const gg_model *m)
{
  double cubes = 0;
  for (int i = 0; i < m->n_species; i++) cubes += pow(m->diameter[i], 3) * (double)m->n_of[i] / (double)m->n;
  return pow(gg_common_model_widest(m), 3) / cubes;
}

/* A kick is nearly a collision's work, in a thin gas less, and there are more the more energy is lost (md/kicks.h). */
static double cost_of_kicks(const gg_model *m)
{
  const double slots = m->shear_rate != 0 ? 25 : 5, rate = gg_common_model_collision_rate(m, m->temperature0);
  double mass = 0;
  for (int i = 0; i < m->n_species; i++) mass += m->mass[i] * (double)m->n_of[i] / (double)m->n;
  const double loss = mass * gg_common_thermostat_noise(m) / m->temperature0 / rate;
  if (m->bath.drag[0] != 0) return 1 + fmax(fmin(8 * loss, 1), 0.4 * slots * fabs(m->bath.drag[0]) / rate);
  return gg_common_thermostats[m->thermostat].heat == GG_HEAT_KICKS ? 1 + fmin(7 * loss, 1.1) : 1;
}

/* Nanoseconds a collision. The thinner the gas the more cells are crossed between two; out of cache beyond some
 * thousand grains; walls are met, too, and parabolas cost more than straight lines. */
static double pace_of_md(const gg_model *m)
{
  const double cells = 180 + 115 / sqrt(fmax(m->phi, 1e-12)), cache = 1 + 0.2 * fmax(0, log((double)m->n / 2000));
  return cells * cache * crowding(m) * cost_of_kicks(m) * (m->walled ? 1.2 : 1);
}

/* Nanoseconds a collision of two species: one by one where either has too few grains for blocks of eight
 * (gg_dsmc_choose_path), or where a law of restitution is the user's. */
static double pace_of_pair(const gg_model *m, int i, int j)
{
  enum { FEWEST_IN_BLOCKS = 793 }; /* a hundred blocks */
  const bool blocks = m->n_of[i] >= FEWEST_IN_BLOCKS && m->n_of[j] >= FEWEST_IN_BLOCKS && !m->law.e &&
                      !gg_model_friction_by_speed(m, gg_pair(i, j));
  return blocks ? (m->rule == GG_SMOOTH ? 12 : 18) * (1 + 0.5 * exp(-(double)m->n / 1000)) : 330;
}

/* Between walls grains fly, too. Each pair of species is a sweep of its own, with its share of the collisions; noise is
 * drawn. */
static double pace_of_dsmc(const gg_model *m)
{
  double sum = 0, rates = 0;
  if (m->walled) return m->rule == GG_SMOOTH ? 150 : 200;
  for (int i = 0; i < m->n_species; i++)
    for (int j = 0; j < m->n_species; j++) {
      const int q = gg_pair(i, j);
      const double rate = m->fraction[i] * m->fraction[j] * m->sigma[q] * m->sigma[q] * m->chi[q] *
                          sqrt(1 / m->mass[i] + 1 / m->mass[j]);
      sum += rate * pace_of_pair(m, i, j), rates += rate;
    }
  const double pairs = 0.5 + 0.5 * m->n_species;
  return sum / rates * pairs + (m->bath.on || gg_common_heat_of(m) == GG_HEAT_KICKS ? 30 : 0);
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

/* Collisions per grain that the stress needs, times N error^2, measured in runs of 1000 to 4000 grains: some fifty
 * times the variance of one grain. eta* of a linear response is a slope over a*, fitted beside that of a*^3; half of
 * each sweep of a gas that cools is its beginning. */
static double for_stress(const gg_model *m)
{
  if (m->linear_response) {
    const gg_linear_response range = gg_common_linear_response_of(m);
    return (range.cools ? 60 : 30) / (range.high * range.high);
  }
  if (gg_common_thermostats[m->thermostat].heat == GG_HEAT_KICKS && m->shear_rate != 0)
    return 650;              /* the stress is small beside the pressure */
  if (m->walled) return 400; /* fluctuates along with the slow waves across the gap */
  return m->shear_rate != 0 ? 130 : 5;
}

/* Collisions per grain times N error^2 for N1, N2 and a2, which may be small: their absolute scatter is sqrt(12) and
 * sqrt(2.5), whatever the mean. The mean is estimated by a theory. 0: another quantity, or no theory. */
static double for_small(const gg_model *m, gg_quantity q)
{
  const bool difference = gg_common_quantity_mask(q) & GG_STRESS_DIFFERENCE;
  const gg_theory *theory = difference ? &gg_theory_gaussian_closure : &gg_theory_garzo_dufty1999;
  gg_theory_answer answer;
  if (!difference && q != GG_Q_A2) return 0;
  if (gg_theory_evaluate(theory, m, &answer, NULL) != GG_OK || !isfinite(answer.value[q])) return 0;
  return (difference ? 12 : 2.5) / (answer.value[q] * answer.value[q]);
}

/* Collisions per grain until all requested errors are reached. The slowest is the stress, a small quantity, or the
 * temperature, which fluctuates by sqrt(2/3N) with its relaxation time. */
static double for_error(const gg_scene *scene, const gg_model *m)
{
  const double usual = fmax(for_stress(m), 2 * gg_common_model_relaxation(m) * 2 / 3.0);
  double most = 0;
  for (gg_quantity q = 0; q < GG_N_QUANTITIES; q++) {
    const double error = gg_run_criteria_error_of(scene, m, q);
    if (isfinite(error)) most = fmax(most, fmax(usual, for_small(m, q)) / (error * error));
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

/* Enskog's equation solved without random numbers: quadratures over pairs of species, of which shear has the more; the
 * viscosity of mixtures up to six species. All others are formulas, or small equations. */
double gg_run_cost_of_theories(const gg_model *m)
{
  enum { MOST_SHEARED = 8, MOST_VISCOUS = 6 };
  const double formulas = 0.02, n = m->n_species;
  const bool sheared = m->flow == GG_USF || m->flow == GG_HEATED_SHEAR;
  if (!(gg_theory_enskog_hermite.flows & GG_FLOW_BIT(m->flow)) || m->law.name) return formulas;
  if (m->rule == GG_ROUGH && n == 1) return 0.9;
  if (m->rule != GG_SMOOTH || (sheared && n > MOST_SHEARED)) return formulas;
  if (sheared) return 1.5 * pow(n, 1.5);
  return n > MOST_VISCOUS ? 1 : 0.5 + 0.4 * n * n;
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
                        .ns = engine == GG_MD ? pace_of_md(m) : pace_of_dsmc(m)};
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
  double ratio = 0;
  gg_model *m = md->phi < DILUTE ? malloc(sizeof *m) : NULL;
  if (m && gg_scene_model_make(scene, GG_DSMC, m, NULL) == GG_OK &&
      gg_common_engine_of(GG_DSMC)->accepts(m, NULL) == GG_OK && measured(scene, m) == scene->measure)
    ratio = pace_of_md(md) / pace_of_dsmc(m);
  free(m);
  return ratio;
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
  return gg_base_fail(
      err, GG_FAILED,
      "%s: the run would need about %s of memory (%s a replica, of which there are %lld), and there are %s; "
      "ask for fewer %s, replicas or observables",
      engine, needed, one, (long long)replicas, there, strcmp(engine, "dsmc") == 0 ? "dsmc.particles" : "particles");
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
