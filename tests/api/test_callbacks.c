/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A callback that fails with a reason ends the call that it came from, of every kind of callback; and theories look
 * often whether to stop. */
#include <stdatomic.h>
#include <stdbool.h>

#include "api_test.h"

static const char small[] = "{flow: usf, phi: 0.1, particles: 100, collision: {beta: 0}, dsmc: {particles: 200}, "
                            "run: {collisions: 4000, replicas: 2}}";

/* Index of the callback call that fails, from 0, and number of calls so far. */
static atomic_int calls;
static int bad;
static bool fails(void)
{
  if (atomic_fetch_add(&calls, 1) < bad) return false;
  gg_callback_fail("the disk of \xff fell over");
  gg_callback_fail("and more");
  return true;
}

static void sample(void *context, void *state, const gg_sample *now, double *values)
{
  (void)context, (void)state;
  values[0] = fails() ? NAN : now->velocity[0];
}

static void plain(void *context, void *state, const gg_sample *now, double *values)
{
  (void)context, (void)state, (void)now;
  values[0] = 1;
}

static void collision(void *context, void *state, const gg_collision_view *view)
{
  (void)context, (void)state, (void)view;
  fails();
}

static double law(void *context, double speed, int one, int two)
{
  (void)context, (void)speed, (void)one, (void)two;
  return fails() ? -7 : 0.9;
}

static int progress(void *context, const gg_progress *now)
{
  (void)context, (void)now;
  return fails(), 0;
}

static int stop(void *context)
{
  (void)context;
  return fails(), 0;
}

static const char *evaluate(void *context, const gg_facts *facts, double *values)
{
  (void)context, (void)facts, (void)values;
  return fails(), NULL;
}

static void arm(int from)
{
  bad = from;
  atomic_store(&calls, 0);
}

#define assert_callback_failed(call)                                                                                   \
  do {                                                                                                                 \
    memset(&err, 0, sizeof err);                                                                                       \
    assert_int_equal(call, GG_FAILED);                                                                                 \
    if (!strstr(err.message, "the disk of ? fell over") || strstr(err.message, "and more"))                            \
      fail_msg("%s", err.message);                                                                                     \
  } while (0)

/* By one thread and by two, in both engines, and then the next run as if nothing had been. */
static void assert_runs_fail(gg_scene *s, gg_run_options o, int from)
{
  gg_error err;
  gg_scene *good = scene_of("{flow: usf, phi: 0.1, particles: 100, dsmc: {particles: 200}, run: {collisions: 40}}");
  for (int k = 0; k < 4; k++) {
    gg_result *r = NULL;
    o.threads = 1 + k % 2;
    assert_ok(gg_scene_set(s, "engine", k < 2 ? "md" : "dsmc", &err));
    arm(from);
    assert_callback_failed(gg_run(s, &o, &r, &err));
    gg_result_free(r);
    r = NULL;
    assert_ok(gg_run(good, &(gg_run_options){.size = sizeof(gg_run_options), .threads = o.threads}, &r, &err));
    gg_result_free(r);
  }
  gg_scene_free(good);
}

static void a_failing_observable_ends_the_run(void **state)
{
  (void)state;
  const gg_quantity_definition q = {.name = "mine"};
  gg_error err;
  for (int k = 0; k < 2; k++) {
    gg_scene *s = scene_of(small);
    assert_ok(gg_scene_add_observable(s,
                                      &(gg_observable_definition){.name = "own",
                                                                  .n_quantities = 1,
                                                                  .quantities = &q,
                                                                  .sample = k ? plain : sample,
                                                                  .collision = k ? collision : NULL},
                                      &err));
    assert_runs_fail(s, (gg_run_options){.size = sizeof(gg_run_options)}, 20);
    gg_comparison *c = NULL;
    arm(20);
    assert_callback_failed(gg_compare(s, &(gg_run_options){.size = sizeof(gg_run_options), .threads = 2}, &c, &err));
    gg_comparison_free(c);
    gg_scene_free(s);
  }
}

static void a_failing_law_ends_the_run(void **state)
{
  (void)state;
  gg_error err;
  gg_scene *s = scene_of(small);
  arm(3);
  assert_callback_failed(gg_scene_set_restitution(s, "mine", law, NULL, &err));
  arm(1 << 20);
  assert_ok(gg_scene_set_restitution(s, "mine", law, NULL, &err));
  assert_runs_fail(s, (gg_run_options){.size = sizeof(gg_run_options)}, 1000);
  gg_scene_free(s);
}

static void a_failing_callback_of_a_run_ends_it(void **state)
{
  (void)state;
  gg_scene *s = scene_of(small);
  assert_runs_fail(s, (gg_run_options){.size = sizeof(gg_run_options), .progress = progress}, 0);
  assert_runs_fail(s, (gg_run_options){.size = sizeof(gg_run_options), .stop = stop}, 2);
  gg_scene_free(s);
}

/* The comparison of the engines remains; the failure of the theory is one of its warnings. */
static void a_failing_theory_is_a_warning(void **state)
{
  (void)state;
  const char *const quantity[] = {"temperature"};
  gg_error err;
  gg_scene *s = scene_of(small);
  gg_comparison *c = NULL;
  assert_ok(gg_scene_add_theory(
      s, &(gg_theory_definition){.name = "mine", .n_quantities = 1, .quantities = quantity, .evaluate = evaluate},
      &err));
  arm(0);
  assert_ok(gg_theories_evaluate(s, "mine", NULL, NULL, &c, &err));
  assert_string_equal(gg_comparison_warning(c, 0), "mine failed: the disk of ? fell over");
  gg_comparison_free(c);
  gg_scene_free(s);
}

static void seen(void *context, const gg_collision_event *event)
{
  (void)context, (void)event;
  fails();
}

/* The failed call does not end the simulation. */
static void a_simulation_continues_after_a_failed_callback(void **state)
{
  (void)state;
  gg_error err;
  gg_scene *s = scene_of(small);
  gg_simulation *sim = NULL;
  assert_ok(gg_simulation_new(s, NULL, &sim, &err));
  assert_ok(gg_simulation_on_collision(sim, seen, NULL, &err));
  arm(7);
  assert_callback_failed(gg_simulation_collide(sim, 100000, &err));
  arm(1 << 30);
  assert_ok(gg_simulation_collide(sim, 100, &err));
  assert_ok(gg_simulation_on_collision(sim, NULL, NULL, &err));
  assert_ok(gg_simulation_on_stop(sim, stop, NULL, &err));
  arm(0);
  assert_callback_failed(gg_simulation_advance(sim, 10, &err));
  gg_simulation_free(sim);
  gg_scene_free(s);
}

static int sweep_progress(void *context, const gg_sweep_progress *now)
{
  (void)context, (void)now;
  return fails();
}
static void note(void *context, const gg_sweep_progress *now)
{
  sweep_progress(context, now);
}

static void a_failing_callback_ends_a_sweep(void **state)
{
  (void)state;
  gg_error err;
  gg_sweep *w = NULL;
  assert_ok(gg_sweep_parse("{flow: usf, phi: 0.1, particles: 100, run: {collisions: 400}, vary: {collision.e: "
                           "[0.8, 0.9]}}",
                           "test", &w, &err));
  arm(0);
  assert_callback_failed(
      gg_sweep_run(w, "t_sweep", &(gg_sweep_options){.size = sizeof(gg_sweep_options), .progress = note}, &err));
  assert_ok(gg_sweep_run(w, "t_sweep", NULL, &err));
  gg_sweep_free(w);
}

static void line(void *context, const char *text)
{
  (void)context, (void)text;
  fails();
}

/* Callbacks for lines and files fail outside runs; the next run is not affected. */
static void a_failing_reporter_affects_no_later_run(void **state)
{
  (void)state;
  gg_error err;
  gg_scene *s = scene_of("{flow: usf, phi: 0.1, particles: 100, run: {collisions: 40}}");
  gg_sweep *w = NULL;
  gg_result *r = NULL;
  arm(0);
  assert_callback_failed(gg_scene_describe(s, "md", line, NULL, &err));
  assert_ok(gg_run(s, &(gg_run_options){.size = sizeof(gg_run_options), .output = "t_run.h5"}, &r, &err));
  assert_callback_failed(gg_export("t_run.h5", "t_run", GG_EXPORT_ALL, line, NULL, NULL, NULL, &err));
  assert_ok(gg_sweep_parse("{flow: usf, phi: 0.1, vary: {collision.e: [0.8, 0.9]}, sweep: {does: theory}}", "test", &w,
                           &err));
  assert_ok(gg_sweep_run(w, "t_theory", NULL, &err));
  assert_callback_failed(gg_sweep_collect(w, "t_theory", "t_table",
                                          &(gg_collect_options){.size = sizeof(gg_collect_options), .picture = "none"},
                                          line, NULL, &err));
  assert_ok(gg_sweep_run(w, "t_theory", NULL, &err));
  gg_result_free(r);
  gg_sweep_free(w);
  gg_scene_free(s);
}

/* Asks once, at the `bad`-th time, to stop. */
static int stops_once(void *context)
{
  (void)context;
  return atomic_fetch_add(&calls, 1) == bad;
}

/* In the solvers that take seconds: each looks often, and what it stops has no answer. */
static void theories_that_stop(void **state)
{
  (void)state;
  const struct {
    const char *scene, *theory;
    int most; /* looks before one that stops it */
  } tries[] = {
      {"flow: hcs, phi: 0.3, collision: {e: 0.7, beta: -0.5}", "enskog_hermite", 2000},
      {"flow: usf, phi: 0.3, collision: {e: 0.7}, species: [{fraction: 0.4}, {fraction: 0.3, diameter: 0.7}, "
       "{fraction: 0.3, diameter: 1.2}]",
       "enskog_hermite", 500},
      {"flow: hcs, phi: 0.3, collision: {e: 0.7}, species: [{fraction: 0.5}, {fraction: 0.5, diameter: 0.7}]",
       "enskog_hermite", 100},
      {"flow: usf, phi: 0.3, collision: {e: 0.7, beta: 0}, species: [{fraction: 0.5}, {fraction: 0.5, diameter: 0.7}]",
       "gaussian_closure", 20},
  };
  for (size_t k = 0; k < sizeof tries / sizeof *tries; k++) {
    gg_error err;
    char text[400];
    snprintf(text, sizeof text, "{%s}", tries[k].scene);
    gg_scene *s = scene_of(text);
    gg_comparison *c = NULL;
    for (int part = 0; part < 4; part++) {
      arm(part * tries[k].most / 3);
      assert_int_equal(gg_theories_evaluate(s, tries[k].theory, stops_once, NULL, &c, &err), GG_INTERRUPTED);
      assert_null(c);
      assert_int_equal(atomic_load(&calls), bad + 1); /* it ended there */
    }
    gg_scene_free(s);
  }
}

/* Theories come before the engines of a comparison, and in a sweep by themselves; the start of a run is at a theory. */
static void calls_that_stop_in_theories(void **state)
{
  (void)state;
  gg_error err;
  const char *const scene = "{flow: usf, phi: 0.3, collision: {e: 0.7}, species: [{fraction: 0.4}, {fraction: 0.3, "
                            "diameter: 0.7}, {fraction: 0.3, diameter: 1.2}], particles: 200, run: {collisions: 40}%s}";
  char text[400];
  snprintf(text, sizeof text, scene, "");
  gg_scene *s = scene_of(text);
  gg_comparison *c = NULL;
  gg_simulation *sim = NULL;
  arm(500);
  assert_int_equal(gg_compare(s, &(gg_run_options){.size = sizeof(gg_run_options), .stop = stops_once}, &c, &err),
                   GG_INTERRUPTED);
  assert_null(c);
  arm(5);
  assert_int_equal(
      gg_simulation_new(s, &(gg_start_options){.size = sizeof(gg_start_options), .stop = stops_once}, &sim, &err),
      GG_INTERRUPTED);
  assert_null(sim);
  snprintf(text, sizeof text, scene, ", vary: {collision.e: [0.8, 0.9]}, sweep: {does: theory}");
  gg_sweep *w = NULL;
  assert_ok(gg_sweep_parse(text, "test", &w, &err));
  arm(1);
  assert_int_equal(
      gg_sweep_run(w, "t_stopped", &(gg_sweep_options){.size = sizeof(gg_sweep_options), .stop = stops_once}, &err),
      GG_INTERRUPTED);
  for (size_t i = 0; i < gg_sweep_points(w); i++) {
    gg_point_state found;
    assert_ok(gg_sweep_find(w, "t_stopped", i, &found, NULL, &err));
    assert_int_equal(found, GG_POINT_MISSING);
  }
  gg_sweep_free(w);
  gg_scene_free(s);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_failing_observable_ends_the_run),
      cmocka_unit_test(a_failing_law_ends_the_run),
      cmocka_unit_test(a_failing_callback_of_a_run_ends_it),
      cmocka_unit_test(a_failing_theory_is_a_warning),
      cmocka_unit_test(a_simulation_continues_after_a_failed_callback),
      cmocka_unit_test(a_failing_callback_ends_a_sweep),
      cmocka_unit_test(a_failing_reporter_affects_no_later_run),
      cmocka_unit_test(theories_that_stop),
      cmocka_unit_test(calls_that_stop_in_theories),
  };
  cmocka_set_message_output(CM_OUTPUT_TAP);
  return cmocka_run_group_tests(tests, enter_folder, leave_folder);
}
