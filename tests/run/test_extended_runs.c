/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Runs of extended scenes go on from checkpoints, and do not see each other. */
#include <math.h>
#include <pthread.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "extended.h"
#include "graingas.h"

typedef struct stopping {
  gg_archive last;
  int left;
} stopping;

static bool interrupted(void *context)
{
  return ((stopping *)context)->left-- <= 0;
}

static gg_status keep(void *context, gg_archive *archive, gg_error *err)
{
  stopping *s = context;
  gg_base_archive_clear(&s->last);
  return gg_base_archive_append(&s->last, archive, err);
}

/* A run under a law and with an observable of its own goes on bit for bit, if both are registered again, and says so if
 * they are not. */
static void test_resume(void **state)
{
  (void)state;
  gg_error err;
  const char yaml[] = "{flow: hcs, phi: 0.1, particles: 300, run: {collisions: 120, warmup: 10}, output: "
                      "{checkpoint_every: 1000}}";
  gg_scene *scene = scene_of(yaml), *bare = scene_of(yaml);
  set_law(scene, "falling", falling, NULL);
  add(scene, &thermometer);
  gg_result *whole = NULL, *resumed = NULL;
  gg_run_scene(scene, NULL, 1, NULL, &whole, &err); /* its state is not steady: e rises as it cools */
  stopping s = {.left = 40};
  gg_run_callbacks callbacks = {.context = &s, .interrupted = interrupted, .checkpoint = keep};
  gg_result *cut = NULL;
  assert_int_equal(gg_run_scene(scene, NULL, 1, &callbacks, &cut, &err), GG_INTERRUPTED);
  gg_result_free(cut);
  cut = NULL;
  refused(gg_run_scene(bare, &s.last, 1, NULL, &cut, &err), &err, "law falling; observable thermometer");
  assert_null(cut);
  gg_run_scene(scene, &s.last, 1, NULL, &resumed, &err);
  assert_non_null(whole);
  assert_non_null(resumed);
  assert_memory_equal(whole->final.velocity, resumed->final.velocity, 3 * whole->final.n * sizeof(double));
  int q = gg_common_quantity_find_in(&whole->model, "my_temperature");
  assert_true(whole->value[q].mean == resumed->value[q].mean);
  gg_base_archive_clear(&s.last);
  gg_result_free(whole), gg_result_free(resumed);
  gg_scene_free(scene), gg_scene_free(bare);
}

static void *run_in_thread(void *scene)
{
  return run(scene, 1);
}

/* Two scenes in two threads, each with its own additions, do not see each other. */
static void test_two_threads(void **state)
{
  (void)state;
  double e[] = {0.9, 0.7};
  gg_scene *scene[2];
  gg_result *alone[2], *beside[2];
  pthread_t thread[2];
  for (int k = 0; k < 2; k++) {
    scene[k] = scene_of(sheared);
    set_law(scene[k], "constant", constant, &e[k]);
    add(scene[k], k ? &counter : &thermometer);
    alone[k] = run(scene[k], 1);
  }
  for (int k = 0; k < 2; k++) assert_int_equal(pthread_create(&thread[k], NULL, run_in_thread, scene[k]), 0);
  for (int k = 0; k < 2; k++) {
    void *result;
    pthread_join(thread[k], &result);
    beside[k] = result;
    int q = gg_common_quantity_find_in(&beside[k]->model, k ? "my_rate" : "my_temperature");
    assert_true(q < GG_MOST_QUANTITIES);
    assert_true(alone[k]->value[q].mean == beside[k]->value[q].mean);
    gg_result_free(alone[k]), gg_result_free(beside[k]);
    gg_scene_free(scene[k]);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_resume),
      cmocka_unit_test(test_two_threads),
  };
  return cmocka_run_group_tests_name("extended_runs", tests, NULL, NULL);
}
