/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A start that takes long can be interrupted, at any of its polls, and leaves nothing behind; the callback of a start
 * is of that start alone, and does not change it. So can copies, and what is saved and loaded. */
#include <unistd.h>

#include "api_test.h"

static const char small[] = "{flow: usf, phi: 0.1, particles: 200, dsmc: {particles: 200}, collision: {e: 0.9}}";
/* Large periodic boxes have lists of pairs while grains are pushed apart, and dense ones neighbour lists later; between
 * walls cells. Elastic grains first collide for a while. Monte Carlo draws velocities. */
static const char *const large[] = {"{flow: usf, engine: md, phi: 0.5, particles: 50000, collision: {e: 0.9}}",
                                    "{flow: couette, engine: md, phi: 0.1, particles: 10000, collision: {e: 0.9}}",
                                    "{flow: hcs, engine: md, phi: 0.1, particles: 10000, collision: {e: 0.9}}",
                                    "{flow: usf, engine: dsmc, phi: 0.1, dsmc: {particles: 500000}}",
                                    "{flow: couette, engine: dsmc, phi: 0.1, dsmc: {particles: 500000}}"};

typedef struct poll_count {
  int polls, most; /* stops at this poll and later ones */
} poll_count;

static int stop(void *context)
{
  poll_count *p = context;
  return ++p->polls >= p->most;
}

static gg_start_options lasting(poll_count *p, int most)
{
  *p = (poll_count){0, most};
  return (gg_start_options){.size = sizeof(gg_start_options), .stop = stop, .context = p};
}

static int never(void *context)
{
  poll_count *p = context;
  p->polls++;
  return 0;
}

static uint64_t hash_of(gg_simulation *m)
{
  gg_error err;
  uint64_t hash = 0;
  assert_ok(gg_simulation_hash(m, &hash, &err));
  gg_simulation_free(m);
  return hash;
}

static void a_start_can_be_interrupted(void **state)
{
  (void)state;
  gg_error err;
  poll_count p;
  for (size_t i = 0; i < sizeof large / sizeof *large; i++) {
    gg_scene *s = scene_of(large[i]);
    gg_simulation *m = NULL, *other = NULL;
    gg_start_options options = lasting(&p, 0);
    options.stop = never;
    assert_ok(gg_simulation_new(s, &options, &m, &err));
    const int polls = p.polls;
    assert_true(polls > 10);
    assert_ok(gg_simulation_collide(m, 100, &err));
    assert_int_equal(p.polls, polls); /* of the start alone */
    assert_ok(gg_simulation_new(s, NULL, &other, &err));
    assert_ok(gg_simulation_collide(other, 100, &err));
    assert_true(hash_of(m) == hash_of(other));
    for (int k = 0; k < 5; k++) {
      options = lasting(&p, 1 + k * (polls - 1) / 4); /* the first poll, some between, and the last */
      m = NULL;
      assert_int_equal(gg_simulation_new(s, &options, &m, &err), GG_INTERRUPTED);
      assert_null(m);
      assert_int_equal(p.polls, p.most);
    }
    gg_scene_free(s);
  }
}

static void small_ones_are_asked_once(void **state)
{
  (void)state;
  gg_error err;
  poll_count p;
  for (int dsmc = 0; dsmc < 2; dsmc++) {
    gg_scene *s = scene_of(small);
    assert_ok(gg_scene_set(s, "engine", dsmc ? "dsmc" : "md", &err));
    gg_simulation *m = NULL;
    gg_start_options options = lasting(&p, 1);
    assert_int_equal(gg_simulation_new(s, &options, &m, &err), GG_INTERRUPTED);
    assert_null(m);
    options = lasting(&p, 2);
    assert_ok(gg_simulation_new(s, &options, &m, &err));
    gg_simulation_free(m);
    gg_scene_free(s);
  }
}

static void from_grains(void **state)
{
  (void)state;
  gg_error err;
  poll_count p;
  gg_scene *s = scene_of(large[0]);
  gg_simulation *m = NULL, *next = NULL;
  gg_simulation_state now;
  assert_ok(gg_simulation_new(s, NULL, &m, &err));
  assert_ok(gg_simulation_get_state(m, &now, &err));
  const size_t n = now.grains;
  gg_grains grains = {.position = calloc(3 * n, sizeof(double)), .velocity = calloc(3 * n, sizeof(double))};
  assert_ok(gg_simulation_get_grains(m, &grains, &err));
  for (int most = 1; most < 8; most += 3) {
    const gg_start_options options = lasting(&p, most);
    assert_int_equal(gg_simulation_from_grains(s, &grains, n, &options, &next, &err), GG_INTERRUPTED);
    assert_null(next);
    assert_int_equal(p.polls, most);
  }
  /* A change of the grains, too, by the callback for advances; then nothing has changed. */
  uint64_t before, after;
  assert_ok(gg_simulation_hash(m, &before, &err));
  p = (poll_count){0, 3};
  assert_ok(gg_simulation_on_stop(m, stop, &p, &err));
  assert_int_equal(gg_simulation_set_grains(m, &grains, n, &err), GG_INTERRUPTED);
  assert_int_equal(gg_simulation_set(m, "collision.e", "0.8", &err), GG_INTERRUPTED);
  assert_ok(gg_simulation_hash(m, &after, &err));
  assert_true(before == after);
  free(grains.position);
  free(grains.velocity);
  gg_simulation_free(m);
  gg_scene_free(s);
}

enum { COPY, SAVE, LOAD, TO_BYTES, FROM_BYTES, WAYS };

typedef struct things {
  gg_simulation *from, *made;
  void *bytes, *made_bytes;
  size_t size, made_size;
} things;

static gg_status call(things *t, int way, int (*asks)(void *context), poll_count *p)
{
  gg_error err;
  t->made = NULL, t->made_bytes = NULL;
  switch (way) {
  case COPY: return gg_simulation_copy(t->from, asks, p, &t->made, &err);
  case SAVE: return gg_simulation_save(t->from, "t_start.h5", asks, p, &err);
  case LOAD: return gg_simulation_load("t_start.h5", NULL, asks, p, &t->made, &err);
  case TO_BYTES: return gg_simulation_to_bytes(t->from, asks, p, &t->made_bytes, &t->made_size, &err);
  default: return gg_simulation_from_bytes(t->bytes, t->size, NULL, asks, p, &t->made, &err);
  }
}

/* The simulation is the same as without a callback, and the callback serves that call alone. */
static void assert_same(things *t)
{
  gg_error err;
  poll_count p = {0, 0};
  if (t->made_bytes) assert_ok(gg_simulation_from_bytes(t->made_bytes, t->made_size, NULL, NULL, NULL, &t->made, &err));
  free(t->made_bytes);
  if (!t->made) return;
  gg_simulation *other = NULL;
  assert_ok(gg_simulation_from_bytes(t->bytes, t->size, NULL, never, &p, &other, &err));
  const int polls = p.polls;
  assert_ok(gg_simulation_collide(other, 100, &err));
  assert_int_equal(p.polls, polls);
  assert_ok(gg_simulation_collide(t->made, 100, &err));
  assert_true(hash_of(t->made) == hash_of(other));
}

static void copies_and_files(void **state)
{
  (void)state;
  const int of[] = {0, 3};
  for (size_t k = 0; k < sizeof of / sizeof *of; k++) {
    gg_error err;
    poll_count p;
    things t = {0};
    gg_scene *s = scene_of(large[of[k]]);
    assert_ok(gg_simulation_new(s, NULL, &t.from, &err));
    assert_ok(gg_simulation_to_bytes(t.from, NULL, NULL, &t.bytes, &t.size, &err));
    for (int way = 0; way < WAYS; way++) {
      p = (poll_count){0, 0};
      assert_int_equal(call(&t, way, never, &p), GG_OK);
      const int polls = p.polls;
      assert_true(polls > 8);
      assert_same(&t);
      for (int i = 0; i < 5; i++) {
        p = (poll_count){0, 1 + i * (polls - 1) / 4};
        assert_int_equal(call(&t, way, stop, &p), GG_INTERRUPTED);
        assert_true(!t.made && !t.made_bytes);
        assert_int_equal(p.polls, p.most);
      }
    }
    assert_int_equal(call(&t, LOAD, NULL, NULL), GG_OK); /* the file is whole */
    assert_same(&t);
    assert_int_equal(access("t_start.h5.1", F_OK), -1); /* and the saves that were stopped did not touch it */
    assert_int_equal(access("t_start.h5.graingas-tmp", F_OK), -1);
    remove("t_start.h5");
    free(t.bytes);
    gg_simulation_free(t.from);
    gg_scene_free(s);
  }
}

static int fails(void *context)
{
  (void)context;
  gg_callback_fail("no time left");
  return 0;
}

static void a_failing_stop_gives_its_reason(void **state)
{
  (void)state;
  gg_error err;
  gg_scene *s = scene_of(small);
  gg_simulation *m = NULL;
  assert_int_equal(gg_simulation_new(s, &(gg_start_options){.size = sizeof(gg_start_options), .stop = fails}, &m, &err),
                   GG_FAILED);
  assert_non_null(strstr(err.message, "no time left"));
  assert_null(m);
  assert_ok(gg_simulation_new(s, NULL, &m, &err)); /* the reason is forgotten */
  gg_simulation_free(m);
  gg_scene_free(s);
}

static void stream_0_is_the_default(void **state)
{
  (void)state;
  gg_error err;
  gg_scene *s = scene_of(small);
  uint64_t hash[3];
  for (int k = 0; k < 3; k++) {
    gg_simulation *m = NULL;
    assert_ok(gg_simulation_new(
        s, k == 0 ? NULL : &(gg_start_options){.size = sizeof(gg_start_options), .stream = (uint64_t)k - 1}, &m, &err));
    hash[k] = hash_of(m);
  }
  assert_true(hash[0] == hash[1] && hash[1] != hash[2]);
  gg_scene_free(s);
}

int main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test(a_start_can_be_interrupted),
                                     cmocka_unit_test(small_ones_are_asked_once),
                                     cmocka_unit_test(from_grains),
                                     cmocka_unit_test(copies_and_files),
                                     cmocka_unit_test(a_failing_stop_gives_its_reason),
                                     cmocka_unit_test(stream_0_is_the_default)};
  return cmocka_run_group_tests(tests, enter_folder, leave_folder);
}
