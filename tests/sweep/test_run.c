/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Runs of sweeps: numbers do not depend on threads or on the number of points in progress, and equal those of the same
 * scenes run alone. Points that fail or end short are reported, and the others continue. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "graingas.h"

static char folder[] = "/tmp/gg-sweep-XXXXXX";

static int enter(void **state)
{
  (void)state;
  return mkdtemp(folder) && chdir(folder) == 0 ? 0 : -1;
}

static int leave(void **state)
{
  (void)state;
  char command[100];
  snprintf(command, sizeof command, "rm -rf %s", folder);
  return chdir("/") || system(command);
}

static gg_sweep *sweep_of(const char *yaml)
{
  gg_error err = {0};
  gg_sweep *sweep = NULL;
  if (gg_sweep_parse(yaml, "s.yaml", &sweep, &err) != GG_OK || gg_sweep_check(sweep, &err) != GG_OK)
    fail_msg("%s", err.message);
  return sweep;
}

static gg_comparison *read_point(const gg_sweep *sweep, const char *where, size_t i, gg_point_state expected)
{
  gg_error err;
  char *file = NULL;
  gg_point_state state;
  gg_comparison *c = NULL;
  assert_int_equal(gg_sweep_find(sweep, where, i, &state, &file, NULL), GG_OK);
  assert_int_equal(state, expected);
  if (gg_comparison_read(file, &c, &err) != GG_OK) fail_msg("%s", err.message);
  free(file);
  return c;
}

static bool same(double a, double b)
{
  return a == b || (isnan(a) && isnan(b));
}

static void check_same(const gg_result *a, const gg_result *b)
{
  gg_measurement m, other;
  size_t i = 0;
  assert_true(!a == !b);
  for (; a && gg_result_at(a, i, &m, NULL) == GG_OK; i++) {
    assert_int_equal(gg_result_find(b, m.name, &other, NULL), GG_OK);
    assert_true(same(m.mean, other.mean) && same(m.error, other.error) && m.samples == other.samples);
  }
  assert_true(!a || i > 5);
}

static void run_in(gg_sweep *sweep, const char *where, int threads)
{
  gg_error err;
  const gg_sweep_options options = {.size = sizeof options, .threads = threads};
  if (gg_sweep_run(sweep, where, &options, &err) != GG_OK) fail_msg("%s", err.message);
}

static void same_bits(void **state)
{
  (void)state;
  gg_error err;
  gg_sweep *sweep = sweep_of("flow: usf\nphi: 0.1\nparticles: 60\nrun: {collisions: 40, warmup: 10, replicas: 3}\n"
                             "vary: {collision.e: [0.7, 0.9], engine: [md, dsmc]}\ndsmc: {particles: 200}");
  run_in(sweep, "one", 1);
  run_in(sweep, "three", 3);
  for (size_t i = 0; i < 4; i++) {
    gg_scene *scene = NULL;
    gg_result *alone = NULL;
    gg_comparison *one = read_point(sweep, "one", i, GG_POINT_DONE),
                  *three = read_point(sweep, "three", i, GG_POINT_DONE);
    assert_int_equal(gg_sweep_scene(sweep, i, &scene, &err), GG_OK);
    assert_int_equal(gg_run(scene, NULL, &alone, &err), GG_OK);
    const char *engine = gg_sweep_value(sweep, i, 1);
    check_same(gg_comparison_result(one, engine), gg_comparison_result(three, engine));
    check_same(gg_comparison_result(one, engine), alone);
    gg_comparison_free(one);
    gg_comparison_free(three);
    gg_result_free(alone);
    gg_scene_free(scene);
  }
  gg_sweep_free(sweep);
}

typedef struct told {
  int ended[8];
  char message[8][400];
  gg_sweep_progress last;
} told;

static void hear_end(void *context, size_t i, gg_status status, const char *file, const char *message)
{
  told *t = context;
  t->ended[i] = status == GG_OK ? 1 : file ? 2 : 3;
  snprintf(t->message[i], sizeof t->message[i], "%s", message);
}

static void hear_progress(void *context, const gg_sweep_progress *progress)
{
  ((told *)context)->last = *progress;
}

/* One of three points does not reach its error in time, one collapses; finished points are not run again. */
static void rest_goes_on(void **state)
{
  (void)state;
  gg_error err;
  told t = {0};
  gg_sweep *sweep = sweep_of("flow: hcs\nphi: 0.3\nparticles: 100\nmd: {contact_time: 0}\n"
                             "vary: [{collision.e: [0.9, 0.9, 0.1], run.time_limit: [none, 0.2, none], "
                             "run.collisions: [20, 1e9, 1e6]}]");
  const gg_sweep_options options = {
      .size = sizeof options, .threads = 2, .context = &t, .ended = hear_end, .progress = hear_progress};
  assert_int_equal(gg_sweep_run(sweep, "rest", &options, &err), GG_FAILED);
  if (!strstr(err.message, "of 3 points 1 failed, and 1 did not reach")) fail_msg("%s", err.message);
  assert_int_equal(t.ended[0], 1);
  assert_int_equal(t.ended[1], 2);
  assert_int_equal(t.ended[2], 3);
  if (!strstr(t.message[2], "collapse")) fail_msg("%s", t.message[2]);
  assert_true(t.last.points == 3 && t.last.done == 2 && t.last.failed == 1 && t.last.fell_short == 1);
  gg_comparison_free(read_point(sweep, "rest", 1, GG_POINT_SHORT));
  t = (told){0};
  assert_int_equal(gg_sweep_run(sweep, "rest", &options, &err), GG_FAILED);
  assert_true(!t.ended[0] && !t.ended[1] && t.ended[2] == 3);
  gg_sweep_free(sweep);
}

/* A point of theories: a comparison without engines. */
static void points_of_theories_run_without_engines(void **state)
{
  (void)state;
  double value;
  gg_sweep *sweep = sweep_of("flow: usf\nphi: 0.1\nvary: {collision.e: [0.9, 0.95]}\nsweep: {does: theory}");
  run_in(sweep, "theory", 2);
  gg_comparison *c = read_point(sweep, "theory", 1, GG_POINT_DONE);
  assert_int_equal(gg_comparison_theory_value(c, "lun1991", "temperature", &value, NULL, NULL), GG_OK);
  assert_true(value > 0);
  gg_comparison_free(c);
  gg_sweep_free(sweep);
}

static int at_once(void *context)
{
  (void)context;
  return 1;
}

static void a_stopped_sweep_leaves_no_file(void **state)
{
  (void)state;
  gg_error err;
  gg_point_state there;
  gg_sweep *sweep = sweep_of("flow: usf\nphi: 0.1\nrun: {collisions: 1e9}\nvary: {collision.e: [0.7, 0.8, 0.9]}");
  const gg_sweep_options options = {.size = sizeof options, .threads = 2, .stop = at_once};
  assert_int_equal(gg_sweep_run(sweep, "stopped", &options, &err), GG_INTERRUPTED);
  for (size_t i = 0; i < 3; i++) {
    assert_int_equal(gg_sweep_find(sweep, "stopped", i, &there, NULL, NULL), GG_OK);
    assert_int_equal(there, GG_POINT_MISSING);
  }
  assert_int_equal(remove("stopped/sweep.yaml"), 0);
  assert_int_equal(rmdir("stopped"), 0); /* fails if another file is left */
  gg_sweep_free(sweep);
}

int main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test(same_bits), cmocka_unit_test(rest_goes_on),
                                     cmocka_unit_test(points_of_theories_run_without_engines),
                                     cmocka_unit_test(a_stopped_sweep_leaves_no_file)};
  return cmocka_run_group_tests(tests, enter, leave);
}
