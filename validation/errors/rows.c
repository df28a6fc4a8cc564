/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Long series of a simulation, for coverage: rows FOLDER PREFIX SCENE.yaml [--rows N] [--set KEY=VALUE ...] warms the
 * scene up as a run does, then stores N (100000) successive samples of T, theta, P_xy, N1 and a2, those that the scene
 * has, as PREFIX_T and so on. The truth is the mean over all of them, the correlation time theirs. Exit code 0; 1: the
 * simulation failed; 2: the command line or the scene is wrong; 3: a file could not be written. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "graingas.h"
#include "run/replicas.h"
#include "run/run.h"
#include "scene/scene_reader.h"
#include "statistics/autocorrelation.h"
#include "stored.h"

enum { SERIES = 5, STRETCH = 8192 };

static const struct {
  gg_quantity quantity;
  const char *name;
} wanted[SERIES] = {{GG_Q_TEMPERATURE, "T"},
                    {GG_Q_ROTATIONAL_TEMPERATURE, "theta"},
                    {GG_Q_P_XY, "P_xy"},
                    {GG_Q_N1, "N1"},
                    {GG_Q_A2, "a2"}};

/* Value of a quantity in every row of the replica's series, appended to y. */
static bool append(const gg_replica *r, gg_quantity q, double *y)
{
  gg_function f;
  if (gg_common_quantity_missing(&r->model, q) ||
      !gg_measure_derived_find(r->sampler.observable[0]->rows->derived, q, &f))
    return false;
  for (size_t i = 0; i < r->series.n; i++)
    y[i] = gg_function_value(f, gg_series_row(&r->series, i) + r->sampler.offset[0], &r->model);
  return true;
}

static bool store(const char *folder, const char *prefix, const char *name, double *y, size_t n)
{
  char whole[200];
  double mean = 0;
  gg_correlation c;
  snprintf(whole, sizeof whole, "%.100s_%s", prefix, name);
  for (size_t i = 0; i < n; i++) mean += y[i] / (double)n;
  for (size_t i = 0; i < n; i++) y[i] -= mean;
  if (gg_statistics_correlation_of(y, n, 1, 0, &c, NULL) != GG_OK) return false;
  double time = c.time;
  gg_statistics_correlation_clear(&c);
  printf("%-24s mean %.6g, correlation time %.2f rows\n", whole, mean, time);
  return stored_write(folder, whole, y, n, time, 0);
}

static gg_status simulate(const gg_scene *scene, size_t n, double *y[SERIES], bool there[SERIES], gg_error *err)
{
  gg_model model;
  gg_replica r;
  GG_TRY(gg_run_start_make(scene, NULL, NULL, &model, err));
  gg_stopping_criteria plan = gg_run_criteria_of(scene, &model);
  GG_TRY(gg_run_replica_create(&r, scene, &model, 0, err));
  gg_status status = gg_run_replica_advance(&r, plan.warmup, true, NULL, err);
  for (size_t had = 0; status == GG_OK && had < n; had += STRETCH) {
    r.series.n = 0;
    status = gg_run_replica_advance(&r, plan.warmup + had + STRETCH, false, NULL, err);
    for (int k = 0; k < SERIES; k++) there[k] = append(&r, wanted[k].quantity, y[k] + had);
  }
  gg_run_replica_clear(&r);
  return status;
}

int main(int argc, char **argv)
{
  gg_scene scene, *given;
  gg_error err = {0};
  size_t n = 100000;
  bool good = argc >= 4 && argc % 2 == 0 && gg_scene_load(argv[3], &given, &err) == GG_OK;
  if (good) scene = *given;
  for (int i = 4; good && i < argc; i += 2) {
    char *value = strchr(argv[i + 1], '=');
    if (strcmp(argv[i], "--rows") == 0) {
      n = strtoul(argv[i + 1], NULL, 10);
    } else if (value && strcmp(argv[i], "--set") == 0) {
      *value = '\0';
      good = gg_scene_override(&scene, argv[i + 1], value + 1, &err) == GG_OK;
    } else {
      good = false;
    }
  }
  if (!good || gg_scene_finish(&scene, &err) != GG_OK) {
    fprintf(stderr, "%s\nrows FOLDER PREFIX SCENE.yaml [--rows N] [--set KEY=VALUE ...]\n", err.message);
    return 2;
  }
  n = (n + STRETCH - 1) / STRETCH * STRETCH;
  double *y[SERIES];
  bool there[SERIES] = {false};
  for (int k = 0; k < SERIES; k++)
    if (!(y[k] = malloc(n * sizeof **y))) return 1;
  if (simulate(&scene, n, y, there, &err) != GG_OK) return fprintf(stderr, "%s\n", err.message), 1;
  for (int k = 0; k < SERIES; k++) {
    if (there[k]) good &= store(argv[1], argv[2], wanted[k].name, y[k], n);
    free(y[k]);
  }
  return good ? 0 : 3;
}
