/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Handles defend themselves: what is called from their own callbacks or from a second thread is refused with a reason,
 * and the call in progress goes on as if nothing had happened. */
#include "api_test.h"

#include <pthread.h>
#include <stdatomic.h>

static const char *const scenes[] = {
    "{flow: usf, phi: 0.2, particles: 200, collision: {e: 0.9, beta: 0}}",
    "{flow: usf, phi: 0.2, engine: dsmc, dsmc: {particles: 200}, collision: {e: 0.9, beta: 0}}"};

static gg_simulation *simulation_of(const char *yaml)
{
  gg_error err;
  gg_simulation *m = NULL;
  gg_scene *s = scene_of(yaml);
  assert_ok(gg_simulation_new(s, NULL, &m, &err));
  gg_scene_free(s);
  return m;
}

static uint64_t hash_of(const gg_simulation *m)
{
  gg_error err;
  uint64_t hash;
  assert_ok(gg_simulation_hash(m, &hash, &err));
  return hash;
}

/* Every call that uses a simulation; those that read may come from several threads, but not beside one that changes. */
static void refused_everywhere(gg_simulation *m, const char *words)
{
  gg_error err;
  gg_simulation_state state;
  gg_simulation_sums sums;
  gg_species_state one;
  gg_grains none = {NULL, NULL, NULL, NULL};
  uint64_t hash;
  assert_refused(gg_simulation_advance(m, 1, &err), words);
  assert_refused(gg_simulation_collide(m, 1, &err), words);
  assert_refused(gg_simulation_get_state(m, &state, &err), words);
  assert_refused(gg_simulation_get_species(m, 0, &one, &err), words);
  assert_refused(gg_simulation_get_grains(m, &none, &err), words);
  assert_refused(gg_simulation_hash(m, &hash, &err), words);
  assert_refused(gg_simulation_take_sums(m, &sums, &err), words);
  assert_refused(gg_simulation_save(m, "t_never.h5", NULL, NULL, &err), words);
  assert_refused(gg_simulation_set(m, "collision.e", "0.5", &err), words);
  assert_refused(gg_simulation_record(m, NULL, 0, NULL, &err), words);
}

typedef struct watch {
  gg_simulation *m;
  int seen, most;
} watch;

static void use_inside(void *context, const gg_collision_event *event)
{
  (void)event;
  watch *w = context;
  if (++w->seen == 1) refused_everywhere(w->m, "called from a callback of gg_simulation_collide");
}

static void stop_watching(void *context, const gg_collision_event *event)
{
  (void)event;
  watch *w = context;
  gg_error err;
  if (++w->seen == w->most) assert_ok(gg_simulation_on_collision(w->m, NULL, NULL, &err));
}

static void used_inside(void **state)
{
  (void)state;
  for (int k = 0; k < 2; k++) {
    gg_error err;
    watch w = {.m = simulation_of(scenes[k])}, plain = {.m = simulation_of(scenes[k]), .most = 1 << 30};
    assert_ok(gg_simulation_on_collision(w.m, use_inside, &w, &err));
    assert_ok(gg_simulation_on_collision(plain.m, stop_watching, &plain, &err));
    assert_ok(gg_simulation_collide(w.m, 2000, &err));
    assert_ok(gg_simulation_collide(plain.m, 2000, &err));
    assert_true(w.seen >= 2000 && hash_of(w.m) == hash_of(plain.m));
    gg_simulation_free(w.m);
    gg_simulation_free(plain.m);
  }
}

/* A callback that removes itself after ten collisions sees ten; md's trajectory has not noticed. */
static void stops_watching(void **state)
{
  (void)state;
  for (int k = 0; k < 2; k++) {
    gg_error err;
    watch w = {.m = simulation_of(scenes[k]), .most = 10};
    gg_simulation *plain = simulation_of(scenes[k]);
    assert_ok(gg_simulation_on_collision(w.m, stop_watching, &w, &err));
    for (int i = 0; i < 3; i++) {
      assert_ok(gg_simulation_collide(w.m, 5000, &err));
      assert_int_equal(w.seen, 10);
    }
    assert_ok(gg_simulation_collide(plain, 15000, &err));
    if (k == 0) assert_true(hash_of(w.m) == hash_of(plain));
    w.most = 20;
    assert_ok(gg_simulation_on_collision(w.m, stop_watching, &w, &err));
    assert_ok(gg_simulation_collide(w.m, 5000, &err));
    assert_int_equal(w.seen, 20);
    gg_simulation_free(w.m);
    gg_simulation_free(plain);
  }
}

static void count_on(void *context, const gg_collision_event *event)
{
  (void)event;
  ++*(int *)context;
}

/* A callback hands over to another one; one to stop removes itself. */
static int next_seen;
static void hand_over(void *context, const gg_collision_event *event)
{
  (void)event;
  watch *w = context;
  gg_error err;
  if (++w->seen == w->most) assert_ok(gg_simulation_on_collision(w->m, count_on, &next_seen, &err));
}

static int stop_once(void *context)
{
  watch *w = context;
  gg_error err;
  w->seen++;
  assert_ok(gg_simulation_on_stop(w->m, NULL, NULL, &err));
  return 1;
}

static void replaced_inside(void **state)
{
  (void)state;
  for (int k = 0; k < 2; k++) {
    gg_error err;
    watch w = {.m = simulation_of(scenes[k]), .most = 10}, stops = {.m = w.m};
    gg_simulation_state now;
    next_seen = 0;
    assert_ok(gg_simulation_on_collision(w.m, hand_over, &w, &err));
    assert_ok(gg_simulation_collide(w.m, 1000, &err));
    assert_ok(gg_simulation_get_state(w.m, &now, &err));
    assert_true(w.seen == 10 && (uint64_t)next_seen == now.collisions - 10);
    assert_ok(gg_simulation_on_stop(w.m, stop_once, &stops, &err));
    assert_int_equal(gg_simulation_collide(w.m, 1000, &err), GG_INTERRUPTED);
    assert_ok(gg_simulation_collide(w.m, 1000, &err));
    assert_int_equal(stops.seen, 1);
    gg_simulation_free(w.m);
  }
}

static void free_inside(void *context, const gg_collision_event *event)
{
  (void)event;
  watch *w = context;
  if (++w->seen == w->most) gg_simulation_free(w->m);
}

/* Freed within its own callback it is not shown anything more, and the call ends. */
static void freed_inside(void **state)
{
  (void)state;
  for (int k = 0; k < 2; k++) {
    gg_error err;
    watch w = {.m = simulation_of(scenes[k]), .most = 10};
    assert_ok(gg_simulation_on_collision(w.m, free_inside, &w, &err));
    assert_int_equal(gg_simulation_collide(w.m, 1u << 30, &err), GG_INTERRUPTED);
    assert_int_equal(w.seen, 10);
  }
}

typedef struct meeting { /* of two threads, within a call */
  gg_simulation *m;
  atomic_int inside, tried;
} meeting;

static int wait_inside(void *context)
{
  meeting *t = context;
  atomic_store(&t->inside, 1);
  while (!atomic_load(&t->tried)) usleep(1000);
  return 0;
}

static void *collide_there(void *context)
{
  meeting *t = context;
  gg_error err = {0};
  gg_status status = gg_simulation_collide(t->m, 20000, &err);
  return status == GG_OK ? NULL : t;
}

static void two_threads(void **state)
{
  (void)state;
  for (int k = 0; k < 2; k++) {
    gg_error err;
    meeting t = {.m = simulation_of(scenes[k])};
    gg_simulation *plain = simulation_of(scenes[k]);
    pthread_t thread;
    void *failed;
    assert_ok(gg_simulation_on_stop(t.m, wait_inside, &t, &err));
    assert_int_equal(pthread_create(&thread, NULL, collide_there, &t), 0);
    while (!atomic_load(&t.inside)) usleep(1000);
    refused_everywhere(t.m, "another thread uses this simulation");
    assert_refused(gg_simulation_on_collision(t.m, NULL, NULL, &err), "another thread");
    assert_refused(gg_simulation_on_stop(t.m, NULL, NULL, &err), "another thread");
    atomic_store(&t.tried, 1);
    pthread_join(thread, &failed);
    assert_null(failed);
    assert_ok(gg_simulation_collide(plain, 20000, &err));
    assert_true(hash_of(t.m) == hash_of(plain));
    gg_simulation_free(t.m);
    gg_simulation_free(plain);
  }
}

/* Any number of threads may read at a time. */
static void *hash_there(void *context)
{
  uint64_t *hashes = calloc(200, sizeof *hashes);
  for (int i = 0; hashes && i < 200; i++)
    if (gg_simulation_hash(context, &hashes[i], NULL) != GG_OK) hashes[i] = 0;
  return hashes;
}

static void many_readers(void **state)
{
  (void)state;
  gg_simulation *m = simulation_of(scenes[0]);
  const uint64_t hash = hash_of(m);
  pthread_t thread[3];
  for (int k = 0; k < 3; k++) assert_int_equal(pthread_create(&thread[k], NULL, hash_there, m), 0);
  for (int k = 0; k < 3; k++) {
    void *found;
    pthread_join(thread[k], &found);
    assert_non_null(found);
    for (int i = 0; i < 200; i++) assert_true(((uint64_t *)found)[i] == hash);
    free(found);
  }
  gg_simulation_free(m);
}

static void *set_and_free(void *context)
{
  meeting *t = context;
  while (!atomic_load(&t->inside)) usleep(1000);
  gg_simulation_free(t->m);
  atomic_store(&t->tried, 1);
  return NULL;
}

/* Freed by another thread, it lives until the call returns, which is soon. */
static void freed_elsewhere(void **state)
{
  (void)state;
  gg_error err;
  meeting t = {.m = simulation_of(scenes[0])};
  pthread_t thread;
  assert_ok(gg_simulation_on_stop(t.m, wait_inside, &t, &err));
  assert_int_equal(pthread_create(&thread, NULL, set_and_free, &t), 0);
  assert_int_equal(gg_simulation_collide(t.m, 1u << 30, &err), GG_INTERRUPTED);
  pthread_join(thread, NULL);
}

/* Callback of a session's observable. */
static gg_session *session;
static int refusals;
static void use_session(void *context, void *own, const gg_sample *sample, double *values)
{
  (void)context, (void)own, (void)sample;
  gg_error err = {0};
  gg_result *result = NULL;
  int over;
  values[0] = 1;
  if (!session) return; /* it is being made */
  refusals += gg_session_advance(session, 1, &over, &err) == GG_BAD_INPUT &&
              gg_session_result(session, &result, &err) == GG_BAD_INPUT &&
              strstr(err.message, "gg_session_advance, which uses this session") != NULL;
}

static void misused_sessions_return_errors(void **state)
{
  (void)state;
  gg_error err;
  gg_scene *s = scene_of(scenes[0]);
  const gg_quantity_definition one = {"one", NULL, NULL};
  const gg_observable_definition user = {.name = "user", .n_quantities = 1, .quantities = &one, .sample = use_session};
  gg_result *result = NULL;
  assert_ok(gg_scene_add_observable(s, &user, &err));
  assert_ok(gg_session_new(s, &session, &err));
  gg_scene_free(s);
  assert_ok(gg_session_advance(session, 0.05, NULL, &err));
  assert_true(refusals > 0);
  assert_ok(gg_session_result(session, &result, &err));
  gg_result_free(result);
  gg_session_free(session);
  session = NULL;
}

/* A running sweep can be read, not changed; freed, it lives until the call returns. Its two points end in any order. */
static int points_ended;
static void point_ended(void *context, size_t i, gg_status status, const char *file, const char *message)
{
  (void)status, (void)file, (void)message;
  gg_sweep *sweep = context;
  gg_error err;
  gg_sweep_point point;
  assert_ok(gg_sweep_at(sweep, i, &point, &err));
  assert_refused(gg_sweep_set(sweep, "phi", "0.1", &err), "a call in progress reads this sweep");
  if (++points_ended == 2) gg_sweep_free(sweep);
}

static void misused_sweeps_return_errors(void **state)
{
  (void)state;
  gg_error err;
  gg_sweep *sweep = NULL;
  assert_ok(gg_sweep_parse("{flow: usf, phi: 0.2, vary: {collision.e: [0.8, 0.9]}, sweep: {does: theory}}", NULL,
                           &sweep, &err));
  const gg_sweep_options options = {.size = sizeof options, .context = sweep, .ended = point_ended};
  assert_ok(gg_sweep_run(sweep, "t_sweep", &options, &err));
  assert_int_equal(points_ended, 2);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(used_inside),
      cmocka_unit_test(stops_watching),
      cmocka_unit_test(replaced_inside),
      cmocka_unit_test(freed_inside),
      cmocka_unit_test(two_threads),
      cmocka_unit_test(many_readers),
      cmocka_unit_test(freed_elsewhere),
      cmocka_unit_test(misused_sessions_return_errors),
      cmocka_unit_test(misused_sweeps_return_errors),
  };
  return cmocka_run_group_tests(tests, enter_folder, leave_folder);
}
