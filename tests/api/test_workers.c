/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Replicas shared by several processes: the bits are those of one process, whoever works, whoever is lost on the way,
 * wherever a run is stopped and resumed, and for any number of threads and ranks. Here the processes are threads with a
 * mailbox of their own. */
#include "mailbox.h"

static const char *const scenes[] = {
    ("{flow: usf, phi: 0.1, particles: 100, measure: [rheology, velocity_distributions, diffusion], "
     "run: {collisions: 100, replicas: 3}}"),
    "{flow: hcs, engine: dsmc, phi: 0.1, dsmc: {particles: 500}, run: {collisions: 400, replicas: 3}}",
    "{flow: chute, phi: 0.2, particles: 100, gravity: [0.5, -1, 0], run: {collisions: 200, replicas: 2}}",
    "{flow: usf, engine: dsmc, phi: 0, dsmc: {particles: 300}, run: {relative_error: 0.03, replicas: 5}}",
};

static gg_status run(mailbox *p, int ranks, int threads, const gg_scene *scene, gg_run_options options,
                     gg_result **result)
{
  gg_error err = {0};
  mailbox_open(p, ranks);
  assert_ok(gg_workers_new(&p->end[0], threads, &options.workers, &err));
  gg_status status = gg_run(scene, &options, result, &err);
  gg_workers_free(options.workers);
  mailbox_close(p, ranks);
  return status;
}

static bool same_number(double a, double b)
{
  return a == b || (isnan(a) && isnan(b));
}

static void assert_same(const gg_result *a, const gg_result *b)
{
  gg_measurement m, other;
  gg_curve_data c, d;
  size_t i = 0, n = 0;
  gg_error err;
  for (; gg_result_at(a, i, &m, NULL) == GG_OK; i++) {
    assert_ok(gg_result_at(b, i, &other, &err));
    if (!same_number(m.mean, other.mean) || !same_number(m.error, other.error) || m.samples != other.samples)
      fail_msg("%s: %.17g(%.17g) of %lu, %.17g(%.17g) of %lu", m.name, m.mean, m.error, (unsigned long)m.samples,
               other.mean, other.error, (unsigned long)other.samples);
    n += isfinite(m.mean);
  }
  assert_true(n > 3);
  for (i = 0; gg_result_curve(a, i, &c, NULL) == GG_OK; i++) {
    assert_ok(gg_result_curve(b, i, &d, &err));
    for (size_t k = 0; k < c.n; k++)
      assert_true(same_number(c.value[k], d.value[k]) && same_number(c.error[k], d.error[k]));
  }
}

static gg_result *alone(const gg_scene *scene)
{
  gg_error err;
  gg_result *result = NULL;
  gg_status status = gg_run(scene, NULL, &result, &err);
  if (status != GG_OK && status != GG_FAILED) fail_msg("%s", err.message);
  return result;
}

static void any_number_of_ranks_gives_the_same_bits(void **state)
{
  (void)state;
  for (size_t i = 0; i < sizeof scenes / sizeof *scenes; i++) {
    gg_scene *scene = scene_of(scenes[i]);
    gg_result *one = alone(scene);
    for (int ranks = 2; ranks <= 4; ranks += 2) {
      mailbox p = {0};
      gg_result *several = NULL;
      gg_status status =
          run(&p, ranks, ranks == 2 ? 2 : 1, scene, (gg_run_options){.size = sizeof(gg_run_options)}, &several);
      assert_true(status == GG_OK || status == GG_FAILED);
      assert_same(one, several);
      for (int k = 1; k < ranks && k < 2; k++) assert_true(p.sent[k] > 3); /* they did work */
      gg_result_free(several);
    }
    gg_result_free(one);
    gg_scene_free(scene);
  }
}

/* 80 replicas, by so many threads or ranks. */
static void any_number(void **state)
{
  (void)state;
  gg_error err;
  const int numbers[] = {2, MOST_RANKS};
  gg_scene *scene = scene_of("{flow: hcs, engine: dsmc, phi: 0.1, dsmc: {particles: 100}, "
                             "run: {collisions: 60, replicas: 80}}");
  gg_result *one = alone(scene);
  for (int k = 0; k < 2; k++) {
    mailbox p = {0};
    gg_result *threads = NULL, *ranks = NULL;
    gg_status status =
        gg_run(scene, &(gg_run_options){.size = sizeof(gg_run_options), .threads = numbers[k]}, &threads, &err);
    assert_true(status == GG_OK || status == GG_FAILED);
    assert_same(one, threads);
    assert_int_equal(run(&p, numbers[k], 1, scene, (gg_run_options){.size = sizeof(gg_run_options)}, &ranks), status);
    assert_same(one, ranks);
    for (int i = 1; i < numbers[k]; i++) assert_true(p.sent[i] > 1); /* each had a replica */
    gg_result_free(threads);
    gg_result_free(ranks);
  }
  gg_result_free(one);
  gg_scene_free(scene);
}

/* Rank 1 is lost when it registers, when it returns a replica that it created, at the end of the warm-up, and later. */
static void the_work_of_a_lost_rank_is_repeated(void **state)
{
  (void)state;
  gg_scene *scene = scene_of(scenes[0]);
  gg_result *one = alone(scene);
  for (int die_at = 1; die_at < 5; die_at++) {
    mailbox p = {.die_at = die_at};
    gg_result *several = NULL;
    assert_int_equal(run(&p, 3, 1, scene, (gg_run_options){.size = sizeof(gg_run_options)}, &several), GG_OK);
    assert_same(one, several);
    assert_true(p.lost[1] && p.warned == 1 && strstr(p.warning, "process 1 of 3 is gone"));
    gg_result_free(several);
  }
  gg_result_free(one);
  gg_scene_free(scene);
}

typedef struct loss { /* rank 1 is lost as the time is up */
  mailbox *mailbox;
  uint64_t collisions; /* as the run reported them at its end */
} loss;

static int lose_at_the_end(void *context)
{
  loss *l = context;
  pthread_mutex_lock(&l->mailbox->lock);
  if (l->mailbox->die_when == 0) l->mailbox->die_when = mailbox_seconds() + 0.98;
  pthread_mutex_unlock(&l->mailbox->lock);
  return 0;
}

static int note_collisions(void *context, const gg_progress *now)
{
  ((loss *)context)->collisions = now->collisions;
  return 0;
}

/* A rank lost after the stop contributes the replicas that it had returned. */
static void lost_after_the_stop(void **state)
{
  (void)state;
  gg_error err;
  mailbox p = {0};
  loss l = {.mailbox = &p};
  gg_result *result = NULL;
  gg_result_info info;
  gg_scene *scene = scene_of("{flow: usf, phi: 0.1, particles: 100, run: {collisions: 100, warmup: 1.0e9, replicas: 2, "
                             "time_limit: 1}}");
  gg_run_options options = {
      .size = sizeof options, .context = &l, .progress = note_collisions, .stop = lose_at_the_end};
  assert_int_equal(run(&p, 2, 1, scene, options, &result), GG_FAILED);
  assert_true(p.lost[1] && p.warned == 1 && p.sent[1] > 2); /* one of which says how far it is */
  assert_ok(gg_result_get_info(result, &info, &err));
  assert_true(llabs((long long)(info.total_collisions - l.collisions)) < 2);
  gg_result_free(result);
  gg_scene_free(scene);
}

static int beyond(void *context, const gg_progress *now)
{
  return now->phase[0] == 'a' && now->fraction > *(double *)context;
}

/* A checkpoint is independent of the number of ranks: three begin, two continue, one ends. */
static void a_checkpoint_resumes_on_any_number_of_ranks(void **state)
{
  (void)state;
  gg_error err;
  gg_scene *scene = scene_of(scenes[0]);
  gg_result *one, *part = NULL, *rest = NULL;
  assert_ok(gg_scene_set(scene, "run.collisions", "1500", &err));
  one = alone(scene);
  const int ranks[] = {3, 2};
  for (int k = 0; k < 2; k++) {
    mailbox p = {0};
    double until[] = {0.2, 0.5};
    gg_run_options options = {
        .size = sizeof options, .checkpoint = "t_workers.h5", .resume = k ? "t_workers.h5" : NULL};
    options.progress = beyond, options.context = &until[k];
    assert_int_equal(run(&p, ranks[k], 1, scene, options, &part), GG_INTERRUPTED);
    gg_result_free(part), part = NULL;
  }
  assert_ok(gg_run(scene, &(gg_run_options){.size = sizeof(gg_run_options), .resume = "t_workers.h5"}, &rest, &err));
  assert_same(one, rest);
  gg_result_free(one);
  gg_result_free(rest);
  gg_scene_free(scene);
}

static int times_stored;
static void count_stored(void *context, const char *checkpoint)
{
  (void)context, (void)checkpoint;
  times_stored++;
}

/* Checkpoints are due all the time: all stop for them, and go on. */
static void checkpoints_on_the_way(void **state)
{
  (void)state;
  gg_error err;
  mailbox p = {0};
  gg_scene *scene = scene_of(scenes[0]);
  gg_result *one, *several = NULL;
  assert_ok(gg_scene_set(scene, "run.collisions", "2000", &err));
  one = alone(scene);
  assert_ok(gg_scene_set(scene, "output.checkpoint_every", "0.01", &err));
  assert_ok(gg_scene_set(scene, "output.trajectory_every", "160", &err)); /* the first replica stays here for it */
  gg_run_options options = {
      .size = sizeof options, .checkpoint = "t_often.h5", .output = "t_often_out.h5", .stored = count_stored};
  assert_int_equal(run(&p, 3, 1, scene, options, &several), GG_OK);
  assert_same(one, several);
  gg_result_info info;
  gg_result *read = NULL;
  assert_ok(gg_result_read("t_often_out.h5", &read, &err));
  assert_ok(gg_result_get_info(read, &info, &err));
  assert_true(info.frames > 5 && times_stored > 0);
  gg_result_free(one);
  gg_result_free(several);
  gg_result_free(read);
  gg_scene_free(scene);
}

/* One falls due while replicas are being made: it waits until they are all there. */
static void checkpoint_due_at_the_start(void **state)
{
  (void)state;
  mailbox p = {0};
  gg_scene *scene = scene_of("{flow: usf, phi: 0.5, particles: 8000, run: {collisions: 1, warmup: 1, replicas: 2}, "
                             "output: {checkpoint_every: 1.0e-3}}");
  gg_result *several = NULL;
  gg_run_options options = {.size = sizeof options, .checkpoint = "t_start.h5"};
  assert_int_equal(run(&p, 2, 1, scene, options, &several), GG_OK);
  gg_result_free(several);
  gg_scene_free(scene);
}

typedef struct watcher {
  bool warming;
  int stored, stop_at; /* in the warm-up; after so many */
  atomic_bool inside;  /* the progress hook */
  atomic_int overlaps, asked;
} watcher;

static int watch(void *context, const gg_progress *now)
{
  watcher *w = context;
  w->warming = now->phase[0] == 'w';
  atomic_store(&w->inside, true);
  nanosleep(&(struct timespec){0, 20000000}, NULL);
  atomic_store(&w->inside, false);
  return 0;
}

static void note_stored(void *context, const char *checkpoint)
{
  (void)checkpoint;
  watcher *w = context;
  w->stored += w->warming;
}

static int ask(void *context)
{
  watcher *w = context;
  w->asked++;
  w->overlaps += atomic_load(&w->inside);
  return w->stop_at && w->stored >= w->stop_at;
}

/* Processes leave replicas on different ways. Who goes on with them alone stores and tells all along, as ever; and with
 * them or alone, hooks are called one at a time. */
static void goes_on_alone(void **state)
{
  (void)state;
  gg_error err;
  gg_scene *scene = scene_of("{flow: usf, phi: 0.1, particles: 100, run: {collisions: 100, warmup: 4000, replicas: 4}, "
                             "output: {checkpoint_every: 0.05}}");
  mailbox p = {0};
  watcher shared = {.stop_at = 3}, alone = {0};
  gg_result *part = NULL, *rest = NULL;
  gg_run_options options = {
      .size = sizeof options, .checkpoint = "t_alone.h5", .progress = watch, .stop = ask, .stored = note_stored};
  options.context = &shared;
  assert_int_equal(run(&p, 2, 1, scene, options, &part), GG_INTERRUPTED);
  options.context = &alone, options.resume = "t_alone.h5";
  assert_ok(gg_run(scene, &options, &rest, &err));
  assert_true(alone.stored > 2 && shared.asked > 2 * shared.stored); /* the stop is polled between checkpoints, too */
  assert_int_equal(shared.overlaps + alone.overlaps, 0);
  gg_result_free(part);
  gg_result_free(rest);
  gg_scene_free(scene);
}

/* Both engines use the same ranks at once. */
static void both_engines_share_the_ranks(void **state)
{
  (void)state;
  gg_error err;
  mailbox p = {0};
  gg_scene *scene = scene_of("{flow: usf, phi: 0.1, particles: 100, collision: {beta: 0}, dsmc: {particles: 500}, "
                             "run: {collisions: 60, replicas: 2}}");
  gg_comparison *one = NULL, *several = NULL;
  gg_run_options options = {.size = sizeof options};
  assert_ok(gg_compare(scene, NULL, &one, &err));
  mailbox_open(&p, 3);
  assert_ok(gg_workers_new(&p.end[0], 1, &options.workers, &err));
  assert_ok(gg_compare(scene, &options, &several, &err));
  gg_workers_free(options.workers);
  mailbox_close(&p, 3);
  assert_same(gg_comparison_result(one, "md"), gg_comparison_result(several, "md"));
  assert_same(gg_comparison_result(one, "dsmc"), gg_comparison_result(several, "dsmc"));
  gg_comparison_free(one);
  gg_comparison_free(several);
  gg_scene_free(scene);
}

static void other_builds_do_not_work(void **state)
{
  (void)state;
  mailbox p = {.forges = true};
  gg_scene *scene = scene_of(scenes[1]);
  gg_result *one = alone(scene), *several = NULL;
  assert_int_equal(run(&p, 3, 1, scene, (gg_run_options){.size = sizeof(gg_run_options)}, &several), GG_OK);
  assert_same(one, several);
  assert_true(p.warned == 1 && strstr(p.warning, "another build") && p.sent[1] == 1);
  gg_result_free(one);
  gg_result_free(several);
  gg_scene_free(scene);
}

/* A replica that fails elsewhere fails the run, in the same words. */
static void failures_come_home(void **state)
{
  (void)state;
  mailbox p = {0};
  gg_error err, other;
  gg_result *r = NULL;
  gg_scene *scene = scene_of("{flow: hcs, phi: 0.3, particles: 60, collision: {e: 0.1}, md: {contact_time: 0}, "
                             "run: {collisions: 1e5, replicas: 2}}");
  gg_status status = gg_run(scene, NULL, &r, &err);
  gg_result_free(r), r = NULL;
  gg_run_options options = {.size = sizeof options};
  mailbox_open(&p, 2);
  assert_ok(gg_workers_new(&p.end[0], 1, &options.workers, &other));
  assert_int_equal(gg_run(scene, &options, &r, &other), status);
  gg_workers_free(options.workers);
  mailbox_close(&p, 2);
  assert_int_equal(status, GG_FAILED);
  assert_non_null(strstr(other.message, "collapse"));
  assert_int_equal(other.cause, GG_CAUSE_COLLAPSE);
  gg_result_free(r);
  gg_scene_free(scene);
}

static double always(void *context, double speed, int one, int two)
{
  (void)context, (void)speed, (void)one, (void)two;
  return 0.9;
}

/* Callbacks live in this process alone: nothing is handed out. */
static void own_laws_stay(void **state)
{
  (void)state;
  mailbox p = {0};
  gg_error err;
  gg_scene *scene = scene_of("{flow: usf, engine: dsmc, phi: 0, dsmc: {particles: 300}, "
                             "run: {collisions: 100, replicas: 2}}");
  assert_ok(gg_scene_set_restitution(scene, "always", always, NULL, &err));
  gg_result *one = alone(scene), *several = NULL;
  assert_int_equal(run(&p, 2, 1, scene, (gg_run_options){.size = sizeof(gg_run_options)}, &several), GG_OK);
  assert_same(one, several);
  assert_int_equal(p.sent[1], 1);
  gg_result_free(one);
  gg_result_free(several);
  gg_scene_free(scene);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(any_number_of_ranks_gives_the_same_bits),
      cmocka_unit_test(any_number),
      cmocka_unit_test(the_work_of_a_lost_rank_is_repeated),
      cmocka_unit_test(lost_after_the_stop),
      cmocka_unit_test(a_checkpoint_resumes_on_any_number_of_ranks),
      cmocka_unit_test(checkpoints_on_the_way),
      cmocka_unit_test(checkpoint_due_at_the_start),
      cmocka_unit_test(goes_on_alone),
      cmocka_unit_test(both_engines_share_the_ranks),
      cmocka_unit_test(other_builds_do_not_work),
      cmocka_unit_test(failures_come_home),
      cmocka_unit_test(own_laws_stay),
  };
  return cmocka_run_group_tests(tests, enter_folder, leave_folder);
}
