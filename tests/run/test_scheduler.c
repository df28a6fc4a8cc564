/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Proves, with tasks on replicas of a real engine: the scheduler takes the task of the largest priority first, and of
 * equal ones the first; no more are under way at a time than it has threads, and 70 of them are; a stop ends those that
 * run and those that wait; a controller that waits works, so that one thread needs no other. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>
#include <math.h>
#include <string.h>
#include <unistd.h>

#include "base/clock.h"
#include "run/scheduler.h"
#include "scene/model_of_scene.h"
#include "scene/scene_reader.h"

enum { MOST = 70 };

typedef struct run { /* whose tasks are seen as they ask whether to stop */
  gg_scene scene;
  gg_model model;
  gg_stop stop;
  gg_replica replica[MOST];
  gg_run_tasks tasks;
  struct seen *seen;
  char name;
} run;

typedef struct seen {
  pthread_mutex_t lock;
  char order[8]; /* names of runs, as they began */
  int inside, most, wanted;
  bool open; /* nobody waits for `wanted` to be inside */
} seen;

/* Each task waits for the others that are wanted, some seconds at most. */
static bool meet(void *context)
{
  run *r = context;
  seen *s = r->seen;
  double until = gg_base_clock_wall() + 20;
  pthread_mutex_lock(&s->lock);
  if (!memchr(s->order, r->name, sizeof s->order)) s->order[strlen(s->order)] = r->name;
  s->inside++;
  if (s->inside > s->most) s->most = s->inside;
  s->open = s->open || s->inside >= s->wanted;
  while (!s->open && gg_base_clock_wall() < until) {
    pthread_mutex_unlock(&s->lock);
    usleep(200);
    pthread_mutex_lock(&s->lock);
  }
  s->inside--;
  pthread_mutex_unlock(&s->lock);
  return atomic_load(&r->tasks.stopping);
}

static void open_run(run *r, gg_run_scheduler *scheduler, int n, char name, seen *s)
{
  const char *yaml = "{flow: hcs, engine: dsmc, phi: 0, dsmc: {particles: 64}}";
  gg_error err = {0};
  *r = (run){.scene = gg_scene_defaults(), .seen = s, .name = name, .stop = {meet, r}};
  if (gg_scene_read(&r->scene, yaml, strlen(yaml), "test", &err) != GG_OK || gg_scene_finish(&r->scene, &err) != GG_OK)
    fail_msg("%s", err.message);
  assert_int_equal(gg_scene_model_make(&r->scene, GG_DSMC, &r->model, &err), GG_OK);
  for (int i = 0; i < n; i++)
    assert_int_equal(gg_run_replica_create(&r->replica[i], &r->scene, &r->model, i, &err), GG_OK);
  for (int i = 0; i < n; i++) r->replica[i].model.stop = &r->stop;
  r->tasks = (gg_run_tasks){.scene = &r->scene, .model = &r->model};
  assert_int_equal(gg_run_tasks_open(&r->tasks, scheduler, r->replica, n, 1, &err), GG_OK);
}

static void close_run(run *r)
{
  const int n = r->tasks.n;
  gg_run_tasks_close(&r->tasks);
  for (int i = 0; i < n; i++) gg_run_replica_clear(&r->replica[i]);
}

static void wait_for(run *r)
{
  while (!gg_run_wait(&r->tasks)) {
  }
}

static void assert_samples(const run *r, uint64_t samples)
{
  for (int i = 0; i < r->tasks.n; i++) {
    assert_int_equal(r->tasks.task[i].status, GG_OK);
    assert_int_equal(r->replica[i].clock.samples, samples);
    assert_int_equal(gg_run_task_get_status(&r->tasks.task[i]).samples, samples);
  }
}

/* The only thread is at A, until all the others wait. */
static void largest_priority_first(void **state)
{
  (void)state;
  static run r[5];
  gg_error err;
  seen s = {.lock = PTHREAD_MUTEX_INITIALIZER, .wanted = 2};
  gg_run_scheduler *scheduler;
  const double priority[] = {0.1, 0.2, 0.5, INFINITY, 0.5};
  assert_int_equal(gg_run_scheduler_new(1, true, &scheduler, &err), GG_OK);
  for (int k = 0; k < 5; k++) open_run(&r[k], scheduler, 1, (char)('A' + k), &s);
  for (int k = 0; k < 5; k++) {
    gg_run_submit(&r[k].tasks, 3, true, priority[k]);
    for (bool began = k > 0; !began; usleep(200)) {
      pthread_mutex_lock(&s.lock);
      began = s.inside > 0;
      pthread_mutex_unlock(&s.lock);
    }
  }
  pthread_mutex_lock(&s.lock);
  s.open = true;
  pthread_mutex_unlock(&s.lock);
  for (int k = 0; k < 5; k++) wait_for(&r[k]);
  assert_string_equal(s.order, "ADCEB");
  assert_int_equal(s.most, 1);
  for (int k = 0; k < 5; k++) assert_samples(&r[k], 3), close_run(&r[k]);
  gg_run_scheduler_free(scheduler);
}

static void as_many_as_threads(void **state)
{
  (void)state;
  static run r;
  gg_error err;
  const int threads[] = {1, 2, 3, MOST};
  for (int distributed = 0; distributed < 2; distributed++)
    for (int k = 0; k < 4; k++) {
      seen s = {.lock = PTHREAD_MUTEX_INITIALIZER, .wanted = threads[k]};
      gg_run_scheduler *scheduler;
      assert_int_equal(gg_run_scheduler_new(threads[k], distributed, &scheduler, &err), GG_OK);
      open_run(&r, scheduler, MOST, 'A', &s);
      if (!distributed) gg_run_scheduler_enter(scheduler);
      for (uint64_t due = 2; due <= 4; due += 2) {
        gg_run_submit(&r.tasks, due, true, 1);
        wait_for(&r);
        assert_samples(&r, due);
      }
      assert_int_equal(s.most, threads[k]);
      close_run(&r);
      gg_run_scheduler_free(scheduler);
    }
}

static void a_stopped_run_continues_when_submitted_again(void **state)
{
  (void)state;
  static run r;
  gg_error err;
  seen s = {.lock = PTHREAD_MUTEX_INITIALIZER, .wanted = 2};
  gg_run_scheduler *scheduler;
  assert_int_equal(gg_run_scheduler_new(2, true, &scheduler, &err), GG_OK);
  open_run(&r, scheduler, 5, 'A', &s);
  gg_run_submit(&r.tasks, 1000000000, true, 1);
  while (gg_run_task_get_status(&r.tasks.task[0]).samples == 0 && !gg_run_wait(&r.tasks)) {
  }
  gg_run_stop(&r.tasks);
  wait_for(&r);
  for (int i = 0; i < 5; i++) assert_int_equal(r.tasks.task[i].status, GG_INTERRUPTED);
  assert_true(r.replica[0].clock.samples > 0 && r.replica[4].clock.samples == 0);
  const uint64_t at = r.replica[0].clock.samples + 2; /* and they go on from there */
  gg_run_submit(&r.tasks, at, true, 1);
  wait_for(&r);
  assert_int_equal(r.tasks.task[0].status, GG_OK);
  assert_int_equal(r.replica[4].clock.samples, at);
  close_run(&r);
  gg_run_scheduler_free(scheduler);
}

/* Two controllers on one thread: while one of them counts as busy, the other's tasks wait. */
static void controllers_count(void **state)
{
  (void)state;
  static run r[2];
  gg_error err;
  seen s = {.lock = PTHREAD_MUTEX_INITIALIZER, .wanted = 1};
  gg_run_scheduler *scheduler;
  assert_int_equal(gg_run_scheduler_new(1, false, &scheduler, &err), GG_OK);
  for (int k = 0; k < 2; k++) open_run(&r[k], scheduler, 3, (char)('A' + k), &s);
  gg_run_scheduler_enter(scheduler);
  gg_run_submit(&r[1].tasks, 2, true, 2);
  gg_run_submit(&r[0].tasks, 2, true, 1);
  usleep(20000);
  assert_int_equal(s.most, 0);
  gg_run_scheduler_leave(scheduler);
  gg_run_scheduler_enter(scheduler);
  wait_for(&r[1]);
  wait_for(&r[0]);
  gg_run_scheduler_leave(scheduler);
  assert_string_equal(s.order, "BA");
  assert_int_equal(s.most, 1);
  for (int k = 0; k < 2; k++) assert_samples(&r[k], 2), close_run(&r[k]);
  gg_run_scheduler_free(scheduler);
  gg_run_scheduler_free(NULL);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(largest_priority_first),
      cmocka_unit_test(as_many_as_threads),
      cmocka_unit_test(a_stopped_run_continues_when_submitted_again),
      cmocka_unit_test(controllers_count),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
