/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Is there a bias in the Monte Carlo engine's means? Six scenes of smooth grains, whose answer is known without random
 * numbers. Each cause of a bias is made large: few grains (1/N), long steps (the step's square), runs that are so short
 * that the asked error ends them at once (stopping); and single precision, and ensembles of so many grains that they
 * are partitioned. monte_carlo_bias [--seconds S] [--scene K] takes S seconds of processor time a scene (400), and
 * prints a line a run: mean, error, and how far off the solution that is; then what follows for N without end. Exit
 * code 0; 1 where a run or a solution failed; 2: the command line is wrong. */
#include <gsl/gsl_fit.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "graingas.h"
#include "reference.h"
#include "theory/theory_list.h"
#include "scene/model_of_scene.h"

enum { QUANTITIES = 3, SIZES = 6, STOPPED_N = 1000, STEPPED_N = 3000 };

typedef struct scene {
  const char *yaml;
  double phi, e;
  gg_flow flow;
  const char *quantity[QUANTITIES];
} scene;
static const scene scenes[] = {
    {"{flow: usf, phi: 0.3, collision: {e: 0.7}}", 0.3, 0.7, GG_USF, {"temperature", "P_xy", "N1"}},
    {"{flow: usf, phi: 0.1, collision: {e: 0.8}}", 0.1, 0.8, GG_USF, {"temperature", "P_xy", "N1"}},
    {"{flow: usf, phi: 0.01, collision: {e: 0.9}}", 0.01, 0.9, GG_USF, {"temperature", "P_xy", "N1"}},
    {"{flow: usf, phi: 0, collision: {e: 0.9}}", 0, 0.9, GG_USF, {"temperature", "P_xy", "N1"}},
    {"{flow: hcs, phi: 0, collision: {e: 0.8}}", 0, 0.8, GG_HCS, {"cooling_rate", "a2", "kurtosis_Cx"}},
    {"{flow: hss, phi: 0.3, collision: {e: 0.8}}", 0.3, 0.8, GG_HSS, {"cooling_rate", "a2", "collision_rate"}},
};
enum { N_SCENES = sizeof scenes / sizeof *scenes };

typedef struct answer {
  double mean[QUANTITIES], error[QUANTITIES];
} answer;

static gg_status reference_of(const scene *c, answer *a, gg_error *err)
{
  gg_scene s = gg_scene_defaults();
  gg_model m;
  gg_theory_answer t;
  s.flow = c->flow, s.phi = c->phi, s.collision.e[0] = c->e;
  GG_TRY(gg_scene_model_make(&s, GG_DSMC, &m, err));
  double last[GG_REFERENCE_NUMBERS], other[GG_REFERENCE_NUMBERS];
  if (c->flow == GG_USF) {
    if (!gg_reference_shear(&m, 16, last) || !gg_reference_shear(&m, 14, other))
      return gg_base_fail(err, GG_FAILED, "%s: no solution", c->yaml);
    for (int q = 0; q < QUANTITIES; q++) a->mean[q] = last[q], a->error[q] = fabs(last[q] - other[q]);
    return GG_OK;
  }
  GG_TRY(gg_theory_evaluate(&gg_theory_enskog_hermite, &m, &t, err));
  for (int i = 0; i < QUANTITIES; i++) {
    const gg_quantity q = gg_common_quantity_find(c->quantity[i]);
    a->mean[i] = t.value[q], a->error[i] = t.error[q];
  }
  return GG_OK;
}

static gg_status set(gg_scene *s, const char *key, double value, gg_error *err)
{
  char text[32];
  snprintf(text, sizeof text, "%.10g", value);
  return gg_scene_set(s, key, text, err);
}

static gg_status prepare(const scene *c, double n, gg_scene **s, gg_error *err)
{
  GG_TRY(gg_scene_parse(c->yaml, "scene", s, err));
  GG_TRY(gg_scene_set(*s, "engine", "dsmc", err));
  return set(*s, "dsmc.particles", n, err);
}

static gg_status run(const scene *c, const gg_scene *s, answer *a, gg_result_info *info, gg_error *err)
{
  gg_result *r = NULL;
  gg_status status = gg_run(s, NULL, &r, err);
  for (int q = 0; q < QUANTITIES && status == GG_OK; q++)
    status = gg_result_get(r, c->quantity[q], &a->mean[q], &a->error[q], err);
  if (status == GG_OK) status = gg_result_get_info(r, info, err);
  gg_result_free(r);
  return status;
}

static void print(const scene *c, const char *variant, double collisions, double cpu, const answer *a,
                  const answer *exact)
{
  for (int q = 0; q < QUANTITIES; q++) {
    double off = a->mean[q] - exact->mean[q], error = hypot(a->error[q], exact->error[q]);
    printf("%s | %-14s | %-16s | %.2g %5.0f s | %.7g +- %.1e | %+.2e +- %.1e of it | z %+.1f\n", c->yaml,
           c->quantity[q], variant, collisions, cpu, a->mean[q], a->error[q], off / fabs(exact->mean[q]),
           error / fabs(exact->mean[q]), off / error);
  }
  fflush(stdout);
}

/* A run of fixed length, with a long warm-up, so that nothing is chosen by what is seen. The last run's pace tells how
 * many collisions fill the time. */
static gg_status fixed(const scene *c, gg_scene *s, double n, double seconds, const char *variant, const answer *exact,
                       answer *a, gg_error *err)
{
  gg_result_info info;
  GG_TRY(set(s, "run.warmup", 300, err));
  GG_TRY(set(s, "run.collisions", 400 + 2e6 / n, err));
  GG_TRY(run(c, s, a, &info, err));
  double a_grain = 2 * (double)info.total_collisions / n / info.total_cpu_seconds;
  GG_TRY(set(s, "run.collisions", fmax(400, floor(seconds * a_grain - 300)), err));
  GG_TRY(set(s, "run.seed", 2, err));
  GG_TRY(run(c, s, a, &info, err));
  print(c, variant, (double)info.collisions, info.total_cpu_seconds, a, exact);
  return GG_OK;
}

/* value(N) = limit + b/N over the ensembles that collide by blocks, each point with its error: smaller ones collide one
 * by one, and have a b of their own. */
static void extrapolate(const scene *c, const double *n, const answer *a, const answer *exact)
{
  enum { FIRST = 2 };
  double x[SIZES], y[SIZES], w[SIZES], limit, b, cov00, cov01, cov11, chi2;
  for (int q = 0; q < QUANTITIES; q++) {
    double scale = fabs(exact->mean[q]);
    for (int i = FIRST; i < SIZES; i++) {
      x[i] = 1 / n[i], y[i] = (a[i].mean[q] - exact->mean[q]) / scale;
      w[i] = pow(scale / a[i].error[q], 2);
    }
    gsl_fit_wlinear(x + FIRST, 1, w + FIRST, 1, y + FIRST, 1, SIZES - FIRST, &limit, &b, &cov00, &cov01, &cov11, &chi2);
    printf("# %s %s: N without end %+.2e +- %.1e, 1/N %+.3f +- %.3f, chi^2 %.1f of %d; N %.0f: %+.3f +- %.3f\n",
           c->yaml, c->quantity[q], limit, hypot(sqrt(cov00), exact->error[q] / scale), b, sqrt(cov11), chi2,
           SIZES - FIRST - 2, n[0], n[0] * (a[0].mean[q] - exact->mean[q]) / scale, n[0] * a[0].error[q] / scale);
  }
}

static gg_status by_size(const scene *c, double seconds, const answer *exact, gg_error *err)
{
  static const double n[SIZES] = {100, 320, 1000, 3000, 10000, 100000};
  static const double share[SIZES] = {0.6, 1, 1, 1, 1, 1.4};
  answer a[SIZES];
  for (int i = 0; i < SIZES; i++) {
    gg_scene *s = NULL;
    char variant[32];
    snprintf(variant, sizeof variant, "N %.0f", n[i]);
    GG_TRY(prepare(c, n[i], &s, err));
    gg_status status = fixed(c, s, n[i], seconds * share[i] / 6, variant, exact, &a[i], err);
    gg_scene_free(s);
    GG_TRY(status);
  }
  extrapolate(c, n, a, exact);
  return GG_OK;
}

static gg_status by_step(const scene *c, double seconds, const answer *exact, gg_error *err)
{
  static const double step[] = {0.35, 0.5, 0.7, 1};
  for (int i = 0; i < 4 && c->flow != GG_HCS; i++) {
    gg_scene *s = NULL;
    answer a;
    char variant[32];
    snprintf(variant, sizeof variant, "N %d step %g", STEPPED_N, step[i]);
    GG_TRY(prepare(c, STEPPED_N, &s, err));
    gg_status status = set(s, "dsmc.time_step", step[i], err);
    if (status == GG_OK) status = fixed(c, s, STEPPED_N, seconds / 4, variant, exact, &a, err);
    gg_scene_free(s);
    GG_TRY(status);
  }
  return GG_OK;
}

static gg_status in_single(const scene *c, double seconds, const answer *exact, gg_error *err)
{
  gg_scene *s = NULL;
  answer a;
  GG_TRY(prepare(c, STEPPED_N, &s, err));
  gg_status status = gg_scene_set(s, "dsmc.precision", "single", err);
  if (status == GG_OK) status = fixed(c, s, STEPPED_N, seconds, "N 3000 single", exact, &a, err);
  gg_scene_free(s);
  return status;
}

/* Many runs until an error of 1 %: their mean with the error of its scatter, and the mean square of (run - mean)/error,
 * which is 1 if the claimed errors are true. */
static gg_status stopped(const scene *c, double seconds, const answer *exact, gg_error *err)
{
  double sum[QUANTITIES] = {0}, square[QUANTITIES] = {0}, claimed[QUANTITIES] = {0}, cpu = 0, collisions = 0;
  int runs = 0;
  gg_scene *s = NULL;
  GG_TRY(prepare(c, STOPPED_N, &s, err));
  gg_status status = set(s, "run.relative_error", 0.01, err);
  for (; cpu < seconds && status == GG_OK; runs++) {
    gg_result_info info;
    answer a;
    status = set(s, "run.seed", 1000 + runs, err);
    if (status == GG_OK) status = run(c, s, &a, &info, err);
    if (status != GG_OK) break;
    cpu += info.total_cpu_seconds, collisions += (double)info.collisions;
    for (int q = 0; q < QUANTITIES; q++)
      sum[q] += a.mean[q], square[q] += a.mean[q] * a.mean[q], claimed[q] += a.error[q] * a.error[q];
  }
  gg_scene_free(s);
  GG_TRY(status);
  answer all;
  for (int q = 0; q < QUANTITIES; q++) {
    all.mean[q] = sum[q] / runs;
    double variance = (square[q] / runs - all.mean[q] * all.mean[q]) * runs / (runs - 1);
    all.error[q] = sqrt(variance / runs);
    printf("# %s %s: %d stopped runs, scatter over claimed error %.3f\n", c->yaml, c->quantity[q], runs,
           sqrt(variance * runs / claimed[q]));
  }
  print(c, "N 1000 stopped", collisions, cpu, &all, exact);
  return GG_OK;
}

static gg_status study(const scene *c, double seconds, gg_error *err)
{
  answer exact;
  GG_TRY(reference_of(c, &exact, err));
  GG_TRY(by_size(c, 0.55 * seconds, &exact, err));
  GG_TRY(by_step(c, 0.25 * seconds, &exact, err));
  GG_TRY(in_single(c, 0.1 * seconds, &exact, err));
  return stopped(c, 0.1 * seconds, &exact, err);
}

int main(int argc, char **argv)
{
  double seconds = 400;
  int only = -1;
  for (int i = 1; i < argc; i += 2) {
    bool value = i + 1 < argc;
    if (value && strcmp(argv[i], "--seconds") == 0)
      seconds = atof(argv[i + 1]);
    else if (value && strcmp(argv[i], "--scene") == 0)
      only = atoi(argv[i + 1]);
    else
      only = N_SCENES;
  }
  if (!(seconds > 0) || only >= N_SCENES) {
    fprintf(stderr, "monte_carlo_bias [--seconds S] [--scene 0..%d]\n", N_SCENES - 1);
    return 2;
  }
  for (int i = 0; i < N_SCENES; i++) {
    gg_error err;
    if ((only >= 0 && i != only) || study(&scenes[i], seconds, &err) == GG_OK) continue;
    fprintf(stderr, "%s\n", err.message);
    return 1;
  }
  return 0;
}
