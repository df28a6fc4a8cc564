/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Proves, with the real engines: how a run ends whose requested error cannot be known, and which times it reports. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>
#include <math.h>
#include <string.h>

#include "graingas.h"
#include "run/cost_estimate.h"
#include "run/replicas.h"
#include "run/run.h"
#include "scene/model_of_scene.h"
#include "scene/scene_reader.h"

static gg_result *run(const char *yaml, gg_status expected, gg_error *err)
{
  gg_scene s = gg_scene_defaults();
  gg_result *r = NULL;
  *err = (gg_error){0};
  if (gg_scene_read(&s, yaml, strlen(yaml), "test", err) != GG_OK || gg_scene_finish(&s, err) != GG_OK)
    fail_msg("%s", err->message);
  gg_status status = gg_run_scene(&s, NULL, 1, NULL, &r, err);
  if (status != expected) fail_msg("%s: %d, %s", yaml, (int)status, err->message);
  assert_non_null(r);
  return r;
}

/* An error that seems small in a window too short to know it was not reached, whatever ended the run. */
static void a_short_window_reaches_no_error(void **state)
{
  (void)state;
  gg_error err;
  gg_result *r = run("{flow: usf, phi: 0.1, particles: 50, run: {collisions: 20, relative_error: 1}}", GG_FAILED, &err);
  if (!strstr(err.message, "run.collisions ended the run")) fail_msg("%s", err.message);
  gg_result_free(r);
}

static void stand_still(const gg_engine *engine, gg_engine_state *state)
{
  (void)engine;
  *state = (gg_engine_state){.collisions = 1000};
}

/* Nor where its blocks are long enough by chance. */
static void shorter_than_the_shortest_window(void **state)
{
  (void)state;
  gg_error err;
  gg_engine_ops ops = {.name = "md", .state = stand_still};
  gg_engine engine = {.ops = &ops};
  gg_replica replica = {.engine = &engine, .sampler = {.n_observables = 1}, .model = {.n = 100}};
  gg_replicas all = {.n = 1, .replica = &replica, .model = {.n = 100}};
  all.criteria = (gg_stopping_criteria){.least = 100, .most = 90, .relative_error = 0.1};
  all.state.averaging = 1, all.state.window_at = 10, all.state.due = 109;
  all.last = (gg_convergence){.relative_error = 0.05, .trusted = true};
  assert_int_equal(gg_run_replicas_check_end(&all, &err), GG_FAILED);
  if (!strstr(err.message, "too few to know")) fail_msg("%s", err.message);
  all.state.due = 110;
  assert_int_equal(gg_run_replicas_check_end(&all, &err), GG_OK);
}

static void an_error_of_nothing_fails(void **state)
{
  (void)state;
  gg_error err;
  gg_result *r = run("{flow: usf, phi: 0.1, particles: 50, measure: [], run: {collisions: 20, relative_error: 0.1}}",
                     GG_FAILED, &err);
  if (!strstr(err.message, "nothing is measured")) fail_msg("%s", err.message);
  gg_result_free(r);
}

/* A gas that cools by a law of restitution has no scaling state: the run does not wait for a requested error. */
static void cools_by_a_law(void **state)
{
  (void)state;
  gg_error err;
  gg_result *r = run("{flow: hcs, engine: dsmc, phi: 0.1, collision: {law: viscoelastic}, dsmc: {particles: 500}, "
                     "run: {relative_error: 0.001}}",
                     GG_OK, &err);
  const double per_grain = 2 * (double)r->averaging.collisions / 500;
  assert_true(fabs(per_grain - 400) < 40);
  gg_result_free(r);
}

/* The engine rescales the velocities of a cooling gas by 16; reported times stay in units of the start. */
static void time_of_the_start(void **state)
{
  (void)state;
  gg_error err;
  gg_result *r = run("{flow: hcs, engine: dsmc, phi: 0.1, collision: {e: 0.8}, dsmc: {particles: 1000}, "
                     "run: {collisions: 100, warmup: 0}}",
                     GG_OK, &err);
  const double last = r->history.time[r->history.n - 1];
  assert_true(last > 1000);
  if (!(fabs(r->engine_state.time / last - 1) < 1e-9)) fail_msg("%g, not %g", r->engine_state.time, last);
  assert_true(r->engine_state.time_step > 100);
  gg_result_free(r);
}

/* A viscosity that is a slope over the reduced shear rate needs a whole sweep of it. */
static void less_than_a_sweep(void **state)
{
  (void)state;
  gg_error err;
  gg_result *r =
      run("{flow: small_shear, engine: dsmc, phi: 0.1, dsmc: {particles: 300}, run: {collisions: 40}}", GG_OK, &err);
  assert_true(isnan(r->value[GG_Q_VISCOSITY_REDUCED].mean));
  assert_non_null(strstr(r->value[GG_Q_VISCOSITY_REDUCED].reason, "sweep"));
  gg_result_free(r);
}

/* Friction too weak to bring spins down with velocities: no mean of theta/T, and the run says so; without its limit
 * there is one. */
static void spins_run_away(void **state)
{
  (void)state;
  gg_error err;
  static const char *const text[] = {
      "{flow: hcs, engine: dsmc, phi: 0.1, dsmc: {particles: 300}, collision: {e: 0.9, beta: 0.5, mu: 0.3}, "
      "run: {collisions: 2000}}",
      "{flow: hcs, engine: dsmc, phi: 0.1, dsmc: {particles: 300}, collision: {e: 0.9, beta: 0.5}, "
      "run: {collisions: 2000}}"};
  for (int k = 0; k < 2; k++) {
    gg_result *r = run(text[k], GG_OK, &err);
    print_message("# %s\n", r->steadiness_text);
    assert_int_equal(r->steadiness, k ? GG_STEADY : GG_NOT_STEADY);
    assert_int_equal(strstr(r->steadiness_text, "theta/T grows without end") != NULL, !k);
    gg_result_free(r);
  }
}

/* Free cooling with friction: the mean of a window without escapes is metastable, with the rate of escape of the
 * theory; a run that cannot reach its error before grains escape ends with that reason, long before theta/T overflows.
 */
static void metastable_cooling(void **state)
{
  (void)state;
  gg_error err;
  gg_result *r =
      run("{flow: hcs, engine: dsmc, phi: 0, dsmc: {particles: 1000}, collision: {e: 0.9, beta: 0, mu: 0.5}, "
          "run: {collisions: 400}}",
          GG_OK, &err);
  print_message("# %s\n", r->steadiness_text);
  assert_int_equal(r->steadiness, GG_METASTABLE);
  assert_true(gg_result_is_steady(r));
  assert_true(r->escape_rate > 3e-8 && r->escape_rate < 3e-7);
  assert_non_null(strstr(r->steadiness_text, "one of 1000 about every 2e+04 collisions a grain"));
  gg_result_free(r);
  r = run("{flow: hcs, engine: dsmc, phi: 0, dsmc: {particles: 1000}, collision: {e: 0.9, beta: 0, mu: 5}, "
          "run: {collisions: 400}}",
          GG_OK, &err);
  assert_int_equal(r->steadiness, GG_STEADY); /* no grain ever escapes */
  assert_true(r->escape_rate < 1e-15);
  gg_result_free(r);
  r = run("{flow: hcs, engine: dsmc, phi: 0, dsmc: {particles: 5000}, collision: {e: 0.8, beta: 0, mu: 0.5}, "
          "run: {relative_error: 0.001}}",
          GG_FAILED, &err);
  print_message("# %s\n", err.message);
  assert_int_equal(r->steadiness, GG_NOT_STEADY);
  assert_non_null(strstr(err.message, "have escaped friction"));
  assert_true(r->value[GG_Q_TEMPERATURE_RATIO].mean > 1e20 && isfinite(r->value[GG_Q_TEMPERATURE_RATIO].mean));
  gg_result_free(r);
}

/* For a gas so dilute that Monte Carlo is exact, the run states how much less time dsmc takes; not if dsmc cannot
 * measure what is requested, nor for denser gases. */
static void dilute_gases_state_the_gain_of_dsmc(void **state)
{
  (void)state;
  static const struct {
    double phi;
    const char *measure;
    double least, most;
  } cases[] = {
      {0.0019, "rheology", 150, 300}, {0.0021, "rheology", 0, 0}, {0.0001, "rheology, pair_correlation", 0, 0}};
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    char yaml[200];
    gg_error err;
    gg_scene s = gg_scene_defaults();
    gg_model m;
    snprintf(yaml, sizeof yaml, "{flow: usf, phi: %g, particles: 1000, collision: {e: 0.9}, measure: [%s]}",
             cases[i].phi, cases[i].measure);
    assert_int_equal(gg_scene_read(&s, yaml, strlen(yaml), "test", &err), GG_OK);
    assert_int_equal(gg_scene_finish(&s, &err), GG_OK);
    assert_int_equal(gg_scene_model_make(&s, GG_MD, &m, &err), GG_OK);
    const double ratio = gg_run_cost_dilute(&s, &m);
    assert_in_range((unsigned)ratio, (unsigned)cases[i].least, (unsigned)cases[i].most);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test(dilute_gases_state_the_gain_of_dsmc),
                                     cmocka_unit_test(a_short_window_reaches_no_error),
                                     cmocka_unit_test(shorter_than_the_shortest_window),
                                     cmocka_unit_test(an_error_of_nothing_fails),
                                     cmocka_unit_test(cools_by_a_law),
                                     cmocka_unit_test(time_of_the_start),
                                     cmocka_unit_test(less_than_a_sweep),
                                     cmocka_unit_test(spins_run_away),
                                     cmocka_unit_test(metastable_cooling)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
