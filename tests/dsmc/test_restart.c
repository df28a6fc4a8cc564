/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A restored engine continues bit for bit; so does one whose velocities were multiplied by a power of two. */
#include "common/rng.h"
#include "dsmc/dsmc.h"
#include "lab.h"

static void restart(gg_flow flow, double phi, double beta, int64_t n, int species, gg_precision precision)
{
  gg_scene s = lab_scene(flow, phi, 0.8, beta, n);
  s.n_species = species;
  for (int i = 0; i < species; i++) s.species[i] = (gg_species){1.0 / species, 1 - 0.1 * i, 1 + 0.3 * i, 0.4, 1, 0};
  s.dsmc.precision = precision;
  gg_model m = lab_model(&s);
  gg_engine *straight = lab_engine(&m, 11), *resumed = NULL;
  gg_error err = {0};
  lab_advance(straight, INFINITY, 3 * (uint64_t)n);
  gg_archive archive = {0};
  assert_int_equal(gg_dsmc_ops.save(straight, &archive, &err), GG_OK);
  assert_int_equal(gg_dsmc_ops.restore(&m, &archive, &resumed, &err), GG_OK);
  lab_advance(straight, INFINITY, 3 * (uint64_t)n);
  lab_advance(resumed, INFINITY, 3 * (uint64_t)n);
  lab_same_archive(straight, resumed);
  gg_dsmc_ops.destroy(straight);
  gg_dsmc_ops.destroy(resumed);

  /* A checkpoint of another size is rejected with a message. */
  s.dsmc.particles = n + 8 * species;
  m = lab_model(&s);
  assert_int_equal(gg_dsmc_ops.restore(&m, &archive, &resumed, &err), GG_BAD_FILE);
  assert_non_null(strstr(err.message, "dsmc/velocity_1"));
  gg_base_archive_clear(&archive);
}

static void restarts_bit_for_bit(void **state)
{
  (void)state;
  for (int p = GG_DOUBLE; p <= GG_SINGLE; p++) {
    restart(GG_USF, 0.3, 0.2, 5000, 1, (gg_precision)p);
    restart(GG_USF, 0.3, 0.2, 5000, 3, (gg_precision)p);
    restart(GG_HCS, 0, -1, 8000, 10, (gg_precision)p);
    restart(GG_USF, 0, -1, 11, 1, (gg_precision)p);
    restart(GG_HCS, 0.1, -1, 3000, 1, (gg_precision)p);
  }
}

/* A sheared gas that begins cold warms up; its majorants, which were found at lower speeds, are restored, too. */
static void restarts_while_it_warms(void **state)
{
  (void)state;
  gg_scene s = lab_scene(GG_USF, 0.3, 1, -1, 100);
  s.start.temperature = 1e-6;
  gg_model m = lab_model(&s);
  gg_engine *e = lab_engine(&m, 11);
  gg_error err = {0};
  for (int k = 0; k < 200; k++) {
    gg_engine *resumed = NULL;
    gg_archive archive = {0};
    lab_advance(e, INFINITY, 10);
    assert_int_equal(gg_dsmc_ops.save(e, &archive, &err), GG_OK);
    assert_int_equal(gg_dsmc_ops.restore(&m, &archive, &resumed, &err), GG_OK);
    gg_base_archive_clear(&archive);
    gg_dsmc_ops.destroy(e);
    e = resumed;
  }
  gg_dsmc_ops.destroy(e);
}

static void count(void *context, const gg_collision_record *collision)
{
  *(uint64_t *)context += collision->c12.x == collision->c12.x;
}

/* Once its collision callback is removed, an engine returns to its block kernels. Saved then, it continues bit for bit,
 * and its temperature is that of a run that never had a callback. */
static void restarts_without_its_callback(void **state)
{
  (void)state;
  gg_scene s = lab_scene(GG_HCS, 0.1, 0.8, -1, 3000);
  gg_model m = lab_model(&s);
  gg_engine *straight = lab_engine(&m, 12), *resumed = NULL;
  gg_error err = {0};
  gg_archive archive = {0};
  gg_engine_state then;
  uint64_t told = 0;
  assert_int_equal(gg_dsmc_ops.set_callback(straight, count, &told, &err), GG_OK);
  lab_advance(straight, INFINITY, 1000);
  gg_dsmc_ops.state(straight, &then);
  assert_int_equal(told, then.collisions);
  assert_int_equal(gg_dsmc_ops.set_callback(straight, NULL, NULL, &err), GG_OK);
  assert_int_equal(gg_dsmc_ops.save(straight, &archive, &err), GG_OK);
  assert_int_equal(gg_dsmc_ops.restore(&m, &archive, &resumed, &err), GG_OK);
  lab_advance(straight, INFINITY, 3000);
  lab_advance(resumed, INFINITY, 3000);
  lab_same_archive(straight, resumed);
  assert_int_equal(told, then.collisions);
  gg_base_archive_clear(&archive);
  gg_dsmc_ops.destroy(straight);
  gg_dsmc_ops.destroy(resumed);
}

/* A gas that has cooled below the smallest number in the units of its start is saved and restored like any other. */
static void restarts_far_below(void **state)
{
  (void)state;
  gg_scene s = lab_scene(GG_HCS, 0.1, 0.1, -1, 50);
  gg_model m = lab_model(&s);
  gg_engine *e = lab_engine(&m, 12), *resumed = NULL;
  gg_archive archive = {0};
  gg_error err = {0};
  for (int rescaled = 0; rescaled < 600; rescaled++) { /* T down by 4^600 */
    while (((gg_dsmc *)e)->now.temperature > m.temperature0 / 4) lab_advance(e, INFINITY, 25);
    assert_int_equal(gg_dsmc_ops.rescale(e, 1, &err), GG_OK);
  }
  assert_int_equal(gg_dsmc_ops.save(e, &archive, &err), GG_OK);
  assert_int_equal(gg_dsmc_ops.restore(&m, &archive, &resumed, &err), GG_OK);
  gg_base_archive_clear(&archive);
  gg_dsmc_ops.destroy(e);
  gg_dsmc_ops.destroy(resumed);
}

/* Rescaling changes exponents only, on which rounding does not depend: it changes no other bit of a cooling run. */
static void rescale_in(gg_precision precision)
{
  gg_scene s = lab_scene(GG_HCS, 0.1, 0.6, 0.5, 1001);
  s.dsmc.precision = precision;
  const int power = precision == GG_SINGLE ? 5 : 7; /* temperatures up to 2^60 */
  gg_model m = lab_model(&s);
  gg_engine *plain = lab_engine(&m, 13), *scaled = lab_engine(&m, 13);
  gg_error err = {0};
  for (int i = 0; i < 5; i++) {
    double long_ago = lab_advance(plain, INFINITY, 2000);
    assert_int_equal(gg_dsmc_ops.rescale(scaled, power, &err), GG_OK);
    assert_true(lab_advance(scaled, INFINITY, 2000) == ldexp(long_ago, -power * (i + 1)));
  }
  assert_int_equal(gg_dsmc_ops.rescale(scaled, -5 * power, &err), GG_OK);
  lab_view a = lab_snapshot(plain), b = lab_snapshot(scaled);
  assert_memory_equal(&a, &b, sizeof a);
  gg_dsmc_ops.destroy(plain);
  gg_dsmc_ops.destroy(scaled);
}

static void rescaling_is_exact(void **state)
{
  (void)state;
  rescale_in(GG_DOUBLE);
  rescale_in(GG_SINGLE);
  gg_error err = {0};
  gg_scene s = lab_scene(GG_USF, 0.1, 0.6, -1, 100);
  gg_model m = lab_model(&s);
  gg_engine *plain = lab_engine(&m, 1);
  assert_int_equal(gg_dsmc_ops.rescale(plain, 1, &err), GG_BAD_INPUT);
  gg_dsmc_ops.destroy(plain);
}

/* A checkpoint of the other precision is rejected with a message. */
static void a_checkpoint_keeps_its_precision(void **state)
{
  (void)state;
  gg_scene s = lab_scene(GG_HCS, 0.1, 0.6, -1, 1000);
  gg_model m = lab_model(&s);
  gg_engine *one = lab_engine(&m, 1), *two = NULL;
  gg_archive archive = {0};
  gg_error err = {0};
  assert_int_equal(gg_dsmc_ops.save(one, &archive, &err), GG_OK);
  s.dsmc.precision = GG_SINGLE;
  m = lab_model(&s);
  assert_int_equal(gg_dsmc_ops.restore(&m, &archive, &two, &err), GG_BAD_FILE);
  assert_non_null(strstr(err.message, "dsmc/velocity_1"));
  assert_non_null(strstr(err.message, "type"));
  gg_base_archive_clear(&archive);
  gg_dsmc_ops.destroy(one);
}

static bool never(void *context)
{
  (void)context;
  return false;
}

static bool by_chance(void *context)
{
  return gg_rng_uniform(context) < 0.5;
}

/* An advance that is stopped after random steps, saved and restored each time, ends as the uninterrupted one. */
static void stopped_runs_end_as_uninterrupted_ones(void **state)
{
  (void)state;
  const struct {
    gg_flow flow;
    int64_t n;
    double time_step;
  } cases[] = {{GG_USF, 5000, GG_AUTO}, {GG_HSS, 3000, GG_AUTO}, {GG_USF, 300, 1e-4}, {GG_HCS, 70000, GG_AUTO}};
  for (int k = 0; k < 4; k++) {
    gg_scene s = lab_scene(cases[k].flow, 0.1, 0.8, -1, cases[k].n);
    s.dsmc.time_step = cases[k].time_step;
    s.thermostat = cases[k].flow == GG_HSS ? GG_GAUSSIAN : GG_NO_THERMOSTAT;
    gg_model m = lab_model(&s);
    gg_rng rng = gg_common_rng_seed(1, 0);
    gg_stop stop = {never, &rng}; /* never stops its start */
    gg_error err;
    double dt = 20 / gg_common_model_collision_rate(&m, m.temperature0), gone;
    gg_engine *straight = lab_engine(&m, 8);
    m.stop = &stop;
    gg_engine *cut = lab_engine(&m, 8);
    stop.asked = by_chance;
    double whole = lab_advance(straight, dt, UINT64_MAX);
    gg_status status = gg_dsmc_ops.advance(cut, dt, UINT64_MAX, &gone, &err);
    int stops = 0;
    for (; status != GG_OK; stops++) {
      gg_archive a = {0};
      assert_int_equal(status, GG_INTERRUPTED);
      assert_true(gone > 0 && gone <= whole);
      assert_int_equal(gg_dsmc_ops.save(cut, &a, &err), GG_OK);
      gg_dsmc_ops.destroy(cut);
      assert_int_equal(gg_dsmc_ops.restore(&m, &a, &cut, &err), GG_OK);
      gg_base_archive_clear(&a);
      status = gg_dsmc_ops.go_on(cut, &gone, &err);
    }
    assert_true(stops > 0);
    assert_true(gone == whole);
    lab_same_archive(straight, cut);
    gg_dsmc_ops.destroy(straight);
    gg_dsmc_ops.destroy(cut);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test(restarts_bit_for_bit),
                                     cmocka_unit_test(restarts_while_it_warms),
                                     cmocka_unit_test(restarts_far_below),
                                     cmocka_unit_test(restarts_without_its_callback),
                                     cmocka_unit_test(rescaling_is_exact),
                                     cmocka_unit_test(a_checkpoint_keeps_its_precision),
                                     cmocka_unit_test(stopped_runs_end_as_uninterrupted_ones)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
