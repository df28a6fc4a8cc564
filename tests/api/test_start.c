/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A start that takes long can be interrupted, at any of its polls, and leaves nothing behind; the callback of a start
 * is of that start alone, and does not change it. */
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
  return (gg_start_options){.stop = stop, .context = p};
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

static void interrupted(void **state)
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

/* Theories, which look by themselves, have no part in a start from a given temperature. */
static void small_ones_are_asked_once(void **state)
{
  (void)state;
  gg_error err;
  poll_count p;
  for (int dsmc = 0; dsmc < 2; dsmc++) {
    gg_scene *s = scene_of(small);
    assert_ok(gg_scene_set(s, "engine", dsmc ? "dsmc" : "md", &err));
    assert_ok(gg_scene_set(s, "temperature", "1", &err));
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

static int fails(void *context)
{
  (void)context;
  gg_callback_fail("no time left");
  return 0;
}

static void reason(void **state)
{
  (void)state;
  gg_error err;
  gg_scene *s = scene_of(small);
  gg_simulation *m = NULL;
  assert_int_equal(gg_simulation_new(s, &(gg_start_options){.stop = fails}, &m, &err), GG_FAILED);
  assert_non_null(strstr(err.message, "no time left"));
  assert_null(m);
  assert_ok(gg_simulation_new(s, NULL, &m, &err)); /* the reason is forgotten */
  gg_simulation_free(m);
  gg_scene_free(s);
}

static void streams(void **state)
{
  (void)state;
  gg_error err;
  gg_scene *s = scene_of(small);
  uint64_t hash[3];
  for (int k = 0; k < 3; k++) {
    gg_simulation *m = NULL;
    assert_ok(gg_simulation_new(s, k == 0 ? NULL : &(gg_start_options){.stream = (uint64_t)k - 1}, &m, &err));
    hash[k] = hash_of(m);
  }
  assert_true(hash[0] == hash[1] && hash[1] != hash[2]);
  gg_scene_free(s);
}

int main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test(interrupted), cmocka_unit_test(small_ones_are_asked_once),
                                     cmocka_unit_test(from_grains), cmocka_unit_test(reason),
                                     cmocka_unit_test(streams)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
