/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Proves: the modes across a gap are what they are called; a planted mode that moves slowly is found, with how long it
 * remembers, also in windows of a few such times, and one that results follow by its square, too; a window that is too
 * short for it is not called steady, nor is one whose dense core keeps to one side overlooked. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "common/rng.h"
#include "measure/wall_modes.h"
#include "run/replicas.h"
#include "scene/model_of_scene.h"
#include "statistics/autocorrelation.h"

enum { ROWS = 4096, SPREAD = 1, MOMENTUM = 2 };

static gg_model couette(void)
{
  gg_model m;
  gg_scene s = gg_scene_defaults();
  s.flow = GG_COUETTE, s.phi = 0.3;
  assert_int_equal(gg_scene_model_make(&s, GG_MD, &m, NULL), GG_OK);
  return m;
}

static double autoregressive(gg_rng *r, double tau, double *at)
{
  double rho = exp(-1 / tau);
  return *at = rho * *at + sqrt(1 - rho * rho) * gg_common_rng_normal(r);
}

/* Windows of 10 and of 40 decay times, noise of as much variance on top: on average within a quarter of what was
 * planted, where an integral of the correlation function has less than half at 10. White noise has none, a run that
 * stays where it is all. Replicas count as what they are together. */
static void decay_times(void **state)
{
  (void)state;
  enum { REPEATS = 200 };
  static const int windows[] = {10, 40}, runs[] = {1, 4};
  gg_rng r = gg_common_rng_seed(33, 0);
  double y[512];
  for (int w = 0; w < 2; w++)
    for (int k = 0; k < 2; k++) {
      size_t n = 512 / (size_t)runs[k];
      double tau = 512.0 / windows[w] / (k ? 2 : 1), sum = 0, squares = 0;
      for (int repeat = 0; repeat < REPEATS; repeat++) {
        double at = gg_common_rng_normal(&r);
        for (size_t i = 0; i < 512; i++) {
          if (i % n == 0) at = gg_common_rng_normal(&r);
          y[i] = autoregressive(&r, tau, &at) + gg_common_rng_normal(&r);
        }
        double time = gg_statistics_decay_time(y, n, (size_t)runs[k]) / tau;
        sum += time / REPEATS, squares += time * time / REPEATS;
      }
      double four = 4 * sqrt((squares - sum * sum) / REPEATS);
      print_message("# %d runs of %.0f decay times: %.3f +- %.3f of it\n", runs[k], (double)n / tau, sum, four / 4);
      assert_true(fabs(sum - 1) < 0.25 + four);
    }
  for (size_t i = 0; i < 512; i++) y[i] = i < 256 ? 1 : -1;
  assert_true(gg_statistics_decay_time(y, 512, 1) > 100);
  for (size_t i = 0; i < 512; i++) y[i] = gg_common_rng_normal(&r);
  assert_true(gg_statistics_decay_time(y, 512, 1) < 3);
}

static void begin(gg_replicas *all, gg_replica *replica)
{
  *all = (gg_replicas){.n = 1, .model = couette(), .replica = replica, .state.averaging = 1, .state.due = ROWS};
  *replica = (gg_replica){.model = all->model};
  replica->sampler.model = &replica->model;
  assert_int_equal(gg_statistics_series_init(&replica->series, (size_t)gg_measure_wall_modes(&all->model) + 1, NULL),
                   GG_OK);
}

/* A window in which one mode is autoregressive over `tau` rows, the others are white, the centre of mass about `aside`.
 * A temperature of 1, where the series has room for it, follows the square of that mode. */
static void plant(gg_rng *r, int mode, double tau, double aside, double by_square, gg_replica *p)
{
  const int modes = gg_measure_wall_modes(&p->model);
  double at = gg_common_rng_normal(r), row[GG_MOST_WALL_MODES + 1];
  for (int t = 0; t < ROWS; t++) {
    for (int k = 0; k < modes; k++) row[k] = gg_common_rng_normal(r);
    row[mode] += autoregressive(r, tau, &at);
    row[GG_WALL_CENTRE] += aside;
    row[modes] = 1 + by_square * (row[mode] * row[mode] - 2);
    gg_statistics_series_add(&p->series, t, row);
  }
}

/* Five correlation times are too few, and the reason names the mode; 200 will do, and 40 of one that results follow by
 * its square: they remember it for half as long. */
static void short_window(void **state)
{
  (void)state;
  static const struct {
    int mode;
    double times, remembered;
    bool steady;
  } windows[] = {{SPREAD, 200, 1, true}, {SPREAD, 5, 1, false}, {MOMENTUM, 80, 0.5, true}, {MOMENTUM, 5, 0.5, false}};
  gg_rng r = gg_common_rng_seed(32, 0);
  for (int k = 0; k < 4; k++) {
    gg_replicas all;
    gg_replica replica;
    gg_convergence c;
    gg_slow_modes w;
    const double tau = ROWS / windows[k].times, aside = windows[k].steady ? 2 : 0;
    begin(&all, &replica);
    plant(&r, windows[k].mode, tau, aside, 0, &replica);
    assert_int_equal(gg_run_replicas_slow_modes(&all, &w, NULL), GG_OK);
    assert_int_equal(gg_run_replicas_convergence(&all, &c, NULL), GG_OK);
    print_message("# time %.2f of it, remembered for %.2f\n", c.slow_mode_time / tau, w.time / tau);
    assert_int_equal(c.slow_mode, windows[k].mode);
    assert_true(c.slow_mode_time > 0.25 * tau && c.slow_mode_time < 3 * tau);
    assert_true(fabs(w.time - windows[k].remembered * c.slow_mode_time) < 1e-9 * tau);
    if (aside == 0) assert_true(w.aside_share < 0.5);
    if (aside > 0) assert_true(w.aside_share > 0.9 && fabs(w.aside - aside) < 0.1);
    gg_result *result = calloc(1, sizeof *result);
    gg_run_replicas_report_steadiness(&all, &c, result);
    print_message("# %s\n", result->steadiness_text);
    assert_int_equal(result->steadiness, windows[k].steady ? GG_STEADY : GG_NOT_STEADY);
    if (!windows[k].steady)
      assert_non_null(strstr(result->steadiness_text, gg_measure_wall_mode_name(windows[k].mode)));
    free(result);
    gg_statistics_series_clear(&replica.series);
  }
}

static double first_channel(const double *mean, const gg_model *model)
{
  (void)model;
  return mean[0];
}
static size_t one_channel(const gg_model *model)
{
  (void)model;
  return 1;
}

/* A temperature of 1 follows the square of a drift. Over 5 decay times of a drift of variance 1 the square makes
 * sqrt(2/5) of that share in the error, against a requested 1 per cent of which a third is felt. Too short is a window
 * of 5 decay times where it is felt; where it is not, only if the decay time comes out far too long. */
static void short_windows_where_a_drift_is_not_felt(void **state)
{
  (void)state;
  enum { REPEATS = 40 };
  static const gg_derived derived[] = {{GG_Q_TEMPERATURE, .of = first_channel}, GG_DERIVED_END};
  static const gg_observable_rows rows = {.width = one_channel, .derived = derived};
  static const gg_observable observable = {.rows = &rows};
  static const double by_square[] = {0.1, 0.003};
  gg_rng r = gg_common_rng_seed(34, 0);
  for (int k = 0; k < 2; k++) {
    int felt = 0;
    double sum = 0;
    for (int repeat = 0; repeat < REPEATS; repeat++) {
      gg_replicas all;
      gg_replica replica;
      gg_convergence c;
      double error;
      begin(&all, &replica);
      all.scene = gg_scene_defaults();
      replica.sampler.n_observables = 1, replica.sampler.observable[0] = &observable;
      replica.sampler.offset[0] = (size_t)gg_measure_wall_modes(&all.model);
      plant(&r, MOMENTUM, ROWS / 5.0, 0, by_square[k], &replica);
      assert_int_equal(gg_run_replicas_error_by_square(&all, MOMENTUM, ROWS / 5.0, GG_Q_TEMPERATURE, &error, NULL),
                       GG_OK);
      assert_int_equal(gg_run_replicas_convergence(&all, &c, NULL), GG_OK);
      felt += c.slow_mode == MOMENTUM && ROWS < c.slow_mode_least * c.slow_mode_time;
      sum += error / REPEATS;
      gg_statistics_series_clear(&replica.series);
    }
    print_message("# %g of the square: error %.4f, too short in %d of %d\n", by_square[k], sum, felt, REPEATS);
    assert_true(sum > 0.5 * by_square[k] * sqrt(2 / 5.) && sum < 1.2 * by_square[k] * sqrt(2 / 5.));
    assert_true(k == 0 ? felt > 0.5 * REPEATS : felt < 0.25 * REPEATS);
  }
}

/* Three slabs of known grains. */
static void what_they_are(void **state)
{
  (void)state;
  gg_model m = couette();
  const double grains[] = {3, 2, 5}, u[] = {-2, 0.5, 3}, T[] = {4, 1, 2}, first[] = {1, 0, 3};
  gg_slabs slabs = {.n = 3};
  for (int k = 0; k < 3; k++)
    slabs.slab[k] = (gg_slab){.grains = grains[k],
                              .first = first[k],
                              .velocity = {grains[k] * u[k], 0, 0},
                              .square = grains[k] * u[k] * u[k] + 3 * (grains[k] - 1) * T[k]};
  double row[GG_MOST_WALL_MODES], w1 = cos(M_PI / 6), w2 = 0.5, H = m.box[1]; /* cos(pi y), cos(2 pi y) of slab 1 */
  m.n_species = 2;
  gg_measure_wall_modes_take(&m, &slabs, row);
  const double expected[] = {(5 - 3) * H / 3 / 10,         (8 * w2 - 2) / 10,  (-6 + 1 + 15) / 10.0,
                             (-6 - 15) * w1 / 10,          (9 * w2 - 1) / 10,  (12 - 10) * w1 / 10,
                             (12 * w2 - 2 + 10 * w2) / 10, (1 - 3) * w1 / 4.0, 4 * w2 / 4};
  for (int k = 0; k < GG_MOST_WALL_MODES; k++) assert_true(fabs(row[k] - expected[k]) < 1e-12);
}

/* Even modes across the gap are those that the symmetry of the flow leaves unchanged. Homogeneous scenes and the Monte
 * Carlo ensemble have no modes and no rows. */
static void modes_have_the_symmetry_of_the_flow(void **state)
{
  (void)state;
  gg_model m;
  gg_scene s = gg_scene_defaults();
  s.phi = 0.1;
  assert_int_equal(gg_scene_model_make(&s, GG_MD, &m, NULL), GG_OK);
  assert_int_equal(gg_measure_wall_modes(&m), 0);
  static const bool turned[] = {true, false, true, false, true, true, false, true, false};
  static const bool mirrored[] = {true, false, false, true, false, true, false, true, false};
  s.flow = GG_COUETTE;
  assert_int_equal(gg_scene_model_make(&s, GG_MD, &m, NULL), GG_OK);
  for (int k = 0; k < GG_MOST_WALL_MODES; k++) assert_int_equal(gg_measure_wall_mode_is_odd(&m, k), turned[k]);
  m.gravity[0] = 1;
  for (int k = 0; k < GG_MOST_WALL_MODES; k++) assert_false(gg_measure_wall_mode_is_odd(&m, k));
  m.surface[0].velocity.x = m.surface[1].velocity.x = 0;
  for (int k = 0; k < GG_MOST_WALL_MODES; k++) assert_int_equal(gg_measure_wall_mode_is_odd(&m, k), mirrored[k]);
  m.gravity[1] = -1;
  for (int k = 0; k < GG_MOST_WALL_MODES; k++) assert_false(gg_measure_wall_mode_is_odd(&m, k));
}

int main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test(decay_times), cmocka_unit_test(short_window),
                                     cmocka_unit_test(short_windows_where_a_drift_is_not_felt),
                                     cmocka_unit_test(what_they_are),
                                     cmocka_unit_test(modes_have_the_symmetry_of_the_flow)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
