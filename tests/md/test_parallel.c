/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Proves: the state after so many collisions and the collision sums have the same bits with one, two, three and four
 * threads; with every kind of search, each rule, kicks and torques, one species and two, near collapse; however the run
 * is cut, and resumed with another number of threads. These runs do defer events and roll some back. Daily each case
 * has one of the numbers of threads beside one. */
#include <stdlib.h>
#include <string.h>

#include "md/md_operations.h"
#include "md/parallel/slab.h"
#include "md_test.h"
#include "scene/scene.h"

enum { MOST_THREADS = 4 };

static const struct {
  md_case scene;
  double contact_time;
  int species;
} cases[] = {
    {{GG_EQUILIBRIUM, 6000, 0.3, 1, -1, INFINITY, {1, 1, 4}}, 0, 1},
    {{GG_EQUILIBRIUM, 5000, 0.1, 1, 1, INFINITY, {1, 1, 4}}, 0, 2},
    {{GG_HCS, 6000, 0.3, 0.5, -1, INFINITY, {1, 1, 4}}, 0, 1},
    {{GG_HCS, 6000, 0.2, 0.8, 0.5, 0.3, {1, 1, 4}}, 1e-3, 1},
    {{GG_USF, 6000, 0.3, 0.9, 0, INFINITY, {1, 1, 4}}, 0, 1},
    {{GG_USF, 6000, 0.38, 0.5, -1, INFINITY, {1, 1, 4}}, 1e-5, 1},
    {{GG_USF, 5000, 0.15, 0.8, 0, INFINITY, {1, 1.2, 4}}, 0, 2},
    {{GG_EQUILIBRIUM, 8000, 0.5, 1, -1, INFINITY, {1, 1, 4}}, 0, 1},
    {{GG_HCS, 8000, 0.45, 0.5, 0, INFINITY, {1, 1, 4}}, 1e-5, 2},
    {{GG_USF, 8000, 0.5, 0.9, 0, INFINITY, {1, 1, 4}}, 0, 1},
    {{GG_USF, 8000, 0.5, 0.5, -1, 0.1, {1, 1, 4}}, 1e-4, 1},
    {{GG_EQUILIBRIUM, 9000, 0.02, 1, 0, INFINITY, {1, 1, 4}}, 0, 1},
    {{GG_HCS, 9000, 0.03, 0.6, 0, INFINITY, {1, 1, 4}}, 1e-4, 2},
    {{GG_USF, 9000, 0.02, 0.8, 0.5, 0.3, {1, 1, 4}}, 0, 1},
    {{GG_USF, 7000, 0.48, 0.7, 0.3, INFINITY, {1, 0.8, 5}}, 1e-4, 2},
    {{GG_HSS, 6000, 0.3, 0.9, 0, INFINITY, {1, 1, 4}}, 1e-4, 1},
    {{GG_USF, 6000, 0.2, 0.8, 0.3, 0.4, {1, 1, 4}}, 0, 2},
    {{GG_HSS, 6000, 0.1, 0.8, -1, INFINITY, {1, 1, 4}}, 1e-4, 2},
};
enum { CASES = sizeof cases / sizeof *cases };
/* Kicks, torques and mean spins of the last cases. */
static const struct {
  double normal_kick, tangential_kick, torque, spin;
} injected[CASES] = {[CASES - 3] = {0, 0, 0.3, 2}, [CASES - 2] = {0, 0.1, -0.2, 0}, [CASES - 1] = {0.3, 0, 0, 0}};

static gg_model model_of(int k)
{
  gg_scene s = md_scene(cases[k].scene);
  s.md.contact_time = cases[k].contact_time;
  if (cases[k].scene.flow == GG_HSS) s.thermostat = GG_INJECTION;
  s.start.spin = injected[k].spin;
  for (int p = 0; p < GG_PAIRS; p++)
    s.collision.kick[GG_NORMAL_KICK][p] = injected[k].normal_kick,
    s.collision.kick[GG_TANGENTIAL_KICK][p] = injected[k].tangential_kick;
  if (cases[k].species > 1) {
    s.n_species = 2;
    s.species[0].fraction = s.species[1].fraction = 0.5;
    s.species[1].diameter = 0.9;
  }
  for (int i = 0; i < s.n_species; i++) s.species[i].torque = injected[k].torque / (1 + i);
  return md_model_of(&s);
}

static gg_md *create(const gg_model *m, int threads)
{
  gg_md *e = md_create(m, 7);
  gg_md_use_threads(e, threads, false);
  assert_int_equal(threads > 1, e->parallel != NULL);
  return e;
}

static uint64_t run(const gg_model *m, int threads, uint64_t collisions, gg_md_window_counts *counts)
{
  gg_md *e = create(m, threads);
  md_collide(e, collisions);
  const uint64_t h = md_hash_all(e);
  if (threads > 1) *counts = e->parallel->counts;
  md_destroy(e);
  return h;
}

/* The number of collisions, which the environment variable COLLISIONS sets. */
static uint64_t collisions_asked(void)
{
  const char *asked = getenv("COLLISIONS");
  return asked ? strtoull(asked, NULL, 10) : 60000;
}

static void threads_leave_the_same_bits(void **state)
{
  (void)state;
  const uint64_t collisions = collisions_asked();
  uint64_t deferred_twice = 0, rolled_back = 0;
  for (int k = 0; k < CASES; k++) {
    gg_model m = model_of(k);
    gg_md_window_counts c = {0};
    const uint64_t serial = run(&m, 1, collisions, &c);
    const bool nightly = getenv("NIGHTLY") != NULL;
    for (int threads = nightly ? 2 : 2 + k % 3; threads <= MOST_THREADS; threads += nightly ? 1 : 3) {
      if (run(&m, threads, collisions, &c) != serial) fail_msg("case %d, %d threads", k, threads);
      if (c.events < collisions || !c.deferred[0]) fail_msg("case %d, %d threads: hardly shared", k, threads);
      deferred_twice += c.deferred[1];
      rolled_back += c.rolled_back;
    }
  }
  assert_true(deferred_twice > 0 && rolled_back > 0);
}

/* Advances by times and by numbers of collisions, and takes the sums after each. Returns the hash. */
static uint64_t run_in_parts(gg_md *e)
{
  uint64_t h = 0;
  for (int k = 0; k < 8; k++) {
    double elapsed;
    gg_error err = {0};
    const uint64_t most = k % 2 ? 3001 : UINT64_MAX;
    if (gg_md_ops.advance(&e->base, k % 2 ? INFINITY : 0.05, most, &elapsed, &err) != GG_OK)
      fail_msg("%s", err.message);
    const uint64_t part[3] = {h, md_hash_all(e), e->queue.current};
    h = md_mix(md_mix(0, part, sizeof part), &elapsed, sizeof elapsed);
  }
  return h;
}

static gg_md *restored(gg_md *e, const gg_model *m, int threads)
{
  gg_archive archive = {0};
  gg_error err = {0};
  gg_engine *back = NULL;
  if (gg_md_save(&e->base, &archive, &err) != GG_OK) fail_msg("%s", err.message);
  if (gg_md_restore(m, &archive, &back, &err) != GG_OK) fail_msg("%s", err.message);
  gg_base_archive_clear(&archive);
  gg_md_use_threads((gg_md *)back, threads, false);
  return (gg_md *)back;
}

static void cut_and_resumed_runs_leave_the_same_bits(void **state)
{
  (void)state;
  uint64_t cancelled = 0;
  for (int k = 0; k < CASES; k += 3) {
    gg_model m = model_of(k);
    gg_md *serial = create(&m, 1), *shared = create(&m, 3);
    assert_int_equal(run_in_parts(serial), run_in_parts(shared));
    cancelled += shared->parallel->counts.cancelled;
    gg_md *two = restored(shared, &m, 2), *one = restored(shared, &m, 1);
    md_destroy(shared);
    md_collide(serial, 20000);
    md_collide(two, 20000);
    md_collide(one, 20000);
    const uint64_t h = md_hash_all(serial);
    if (md_hash_all(two) != h || md_hash_all(one) != h) fail_msg("case %d", k);
    md_destroy(serial);
    md_destroy(two);
    md_destroy(one);
  }
  assert_true(cancelled > 0); /* windows in which an advance ends */
}

/* The allocations that still succeed, of those by which the lists of a window grow; -1: all. */
static int allocations_left = -1;

void *aligned_alloc(size_t alignment, size_t size)
{
  void *block = NULL;
  if (allocations_left == 0) return NULL;
  if (allocations_left > 0) allocations_left--;
  return posix_memalign(&block, alignment, size) == 0 ? block : NULL;
}

/* Whichever allocation fails, the run ends with an error. */
static void a_run_without_memory_ends_with_an_error(void **state)
{
  (void)state;
  int failed = 0;
  for (int k = 0; k < 120; k += 5) {
    gg_model m = model_of(k % CASES);
    gg_md *e = create(&m, 3);
    double elapsed;
    gg_error err = {0};
    allocations_left = k;
    const gg_status status = gg_md_ops.advance(&e->base, INFINITY, 20000, &elapsed, &err);
    allocations_left = -1;
    if (status != GG_OK) assert_non_null(strstr(err.message, "out of memory"));
    failed += status != GG_OK;
    md_destroy(e);
  }
  assert_true(failed > 10);
}

/* An engine that decides by measured times tries one thread and several; the bits are the same. */
static void measured_times_change_no_bits(void **state)
{
  (void)state;
  gg_model m = model_of(0);
  gg_md *serial = create(&m, 1), *shared = create(&m, 1);
  gg_md_use_threads(shared, 2, true);
  md_collide(serial, 40000);
  md_collide(shared, 40000);
  assert_int_equal(md_hash_all(serial), md_hash_all(shared));
  const gg_md_trial *t = &shared->parallel->trial;
  /* Under contention parallel events are not timed. */
  assert_true(t->cost[1] > 0 && shared->parallel->counts.events > 0);
  md_destroy(serial);
  md_destroy(shared);
}

/* A scene that threads cannot share says why. */
static void a_scene_says_why_it_is_not_shared(void **state)
{
  (void)state;
  gg_model walls = md_model((md_case){GG_COUETTE, 6000, 0.3, 0.9, 0, INFINITY, {0}}),
           heated = md_model((md_case){GG_HSS, 6000, 0.3, 0.9, 0, INFINITY, {0}}),
           small = md_model((md_case){GG_USF, 500, 0.3, 0.9, 0, INFINITY, {0}}), shared = model_of(0);
  assert_string_equal(gg_md_serial_because(&walls), "walls");
  assert_non_null(strstr(gg_md_serial_because(&heated), "thermostat"));
  assert_string_equal(gg_md_serial_because(&small), "a small box");
  assert_null(gg_md_serial_because(&shared));
  gg_md *e = md_create(&small, 1);
  gg_md_use_threads(e, 4, false);
  assert_null(e->parallel);
  md_destroy(e);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(threads_leave_the_same_bits), cmocka_unit_test(cut_and_resumed_runs_leave_the_same_bits),
      cmocka_unit_test(a_run_without_memory_ends_with_an_error), cmocka_unit_test(measured_times_change_no_bits),
      cmocka_unit_test(a_scene_says_why_it_is_not_shared)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
