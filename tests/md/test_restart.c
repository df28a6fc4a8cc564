/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Proves: a run that is saved and restored continues bit for bit, and saving does not change it; a run cut into
 * advances of any length has the same trajectory; rescaling by powers of two is exact; an advance that is stopped and
 * continued ends as an uninterrupted one. */
#include <stdlib.h>

#include "md/start/all_grains.h"
#include "md_test.h"
#include "scene/scene.h"

static const md_case cases[] = {
    {GG_USF, 200, 0.3, 0.9, 0, INFINITY, {0}},        {GG_USF, 200, 0.02, 0.8, 0.5, 0.3, {0}},
    {GG_HCS, 200, 0.5, 0.9, -1, INFINITY, {0}},       {GG_EQUILIBRIUM, 200, 0.1, 1, -1, INFINITY, {0}},
    {GG_HCS, 200, 0.2, 0.95, 0.8, INFINITY, {0}},     {GG_HCS, 400, 0.01, 0.9, -1, INFINITY, {0}},
    {GG_USF, 700, 0.01, 0.9, 0, INFINITY, {2, 1, 1}}, {GG_FOURIER, 300, 0.5, 0.9, 0, INFINITY, {0}},
    {GG_CHUTE, 300, 0.5, 1, -1, INFINITY, {0}},       {GG_COUETTE, 400, 0.01, 0.9, 0, INFINITY, {0}},
    {GG_CHUTE, 400, 0.01, 0.9, 0, INFINITY, {0}},
};
enum { CASES = sizeof cases / sizeof *cases };

/* The model of a case, or the same with three species. */
static gg_model model_of(int k, bool mixture)
{
  gg_scene s = md_scene(cases[k]);
  if (s.flow == GG_CHUTE)
    s.gravity[0] = 0, s.gravity[1] = -0.1, s.walls.e = 1, s.walls.beta = -1; /* so that there are lists */
  if (mixture) {
    s.n_species = 3;
    s.species[0].fraction = 0.5;
    s.species[1] = (gg_species){0.3, 0.8, 0.5, 0.4, 1, 0};
    s.species[2] = (gg_species){0.2, 1.2, 2, 0.3, 1, 0};
  }
  return md_model_of(&s);
}

static void restored_runs_continue_bit_for_bit(void **state)
{
  (void)state;
  for (int k = 0; k < 2 * CASES; k++) {
    gg_model m = model_of(k / 2, k % 2);
    gg_md *e = md_create(&m, 1);
    gg_engine *back = NULL;
    gg_archive a = {0};
    gg_error err;
    md_collide(e, 7777);
    uint64_t before = md_hash(e);
    assert_int_equal(gg_md_ops.save(&e->base, &a, &err), GG_OK);
    assert_int_equal(before, md_hash(e));
    assert_int_equal(gg_md_ops.restore(&m, &a, &back, &err), GG_OK);
    gg_base_archive_clear(&a);
    md_collide(e, 4000);
    md_collide((gg_md *)back, 4000);
    gg_collision_sums one, two;
    gg_md_ops.take_sums(&e->base, &one);
    gg_md_ops.take_sums(back, &two);
    assert_int_equal(md_hash(e), md_hash((gg_md *)back));
    assert_memory_equal(&one, &two, sizeof one);
    md_destroy(e);
    md_destroy((gg_md *)back);
  }
}

/* A checkpoint with a clock so far from the times of its grains that their places overflow is rejected. */
static void a_clock_far_off_is_rejected(void **state)
{
  (void)state;
  for (int k = 0; k < 2 * CASES; k++) {
    gg_model m = model_of(k / 2, k % 2);
    gg_md *e = md_create(&m, 1);
    gg_engine *back = NULL;
    gg_archive a = {0};
    gg_error err;
    md_collide(e, 1000);
    e->k.now = k % 3 ? -1e34 : 1e34;
    assert_int_equal(gg_md_ops.save(&e->base, &a, &err), GG_OK);
    assert_int_equal(gg_md_ops.restore(&m, &a, &back, &err), GG_BAD_FILE);
    gg_base_archive_clear(&a);
    md_destroy(e);
  }
}

static void runs_can_be_cut_anywhere(void **state)
{
  (void)state;
  for (int k = 0; k < CASES; k++) {
    gg_model m = md_model(cases[k]);
    gg_md *whole = md_create(&m, 2), *cut = md_create(&m, 2);
    gg_rng rng = gg_common_rng_seed(4, 0);
    gg_error err;
    double elapsed, total = 0, straight = md_collide(whole, 30000);
    while (cut->k.collisions < 30000) {
      uint64_t left = 30000 - cut->k.collisions, few = 1 + gg_rng_below(&rng, 200);
      double dt = gg_rng_uniform(&rng) * 20 * whole->k.mean_free_time / (double)m.n;
      assert_int_equal(gg_md_ops.advance(&cut->base, dt, few < left ? few : left, &elapsed, &err), GG_OK);
      assert_true(elapsed <= dt);
      total += elapsed;
    }
    assert_int_equal(md_hash(whole), md_hash(cut));
    assert_true(fabs(total - straight) < 1e-9 * straight);
    md_destroy(whole);
    md_destroy(cut);
  }
}

typedef struct grains {
  size_t n;
  double r[3][1000], c[3][1000];
} grains;

static void note(void *context, const gg_chunk *chunk)
{
  grains *g = context;
  for (size_t i = 0; i < chunk->n; i++, g->n++)
    for (int a = 0; a < 3; a++) g->r[a][g->n] = chunk->r[a][i], g->c[a][g->n] = chunk->c[a][i];
}

/* The next sweep of a linear response begins with the same places and time, and a multiple of the peculiar velocities.
 * No grains overlap then or later, and it continues from a checkpoint bit for bit. */
static void sweeps_begin_in_the_same_places(void **state)
{
  (void)state;
  static const md_case swept[] = {{GG_SMALL_SHEAR, 200, 0.3, 0.9, 0.3, INFINITY, {0}},
                                  {GG_SMALL_SHEAR, 700, 0.01, 0.9, -1, INFINITY, {2, 1, 1}},
                                  {GG_SMALL_SHEAR, 900, 0.45, 1, -1, INFINITY, {0}}};
  for (size_t k = 0; k < sizeof swept / sizeof *swept; k++) {
    gg_model m = md_model(swept[k]);
    gg_md *e = md_create(&m, 2);
    gg_engine *back = NULL;
    gg_archive a = {0};
    gg_error err;
    md_collide(e, 20001);
    for (int power = -2; power <= 4; power += 6) {
      grains before = {0}, after = {0};
      gg_engine_state then, now;
      gg_md_ops.snapshot(&e->base, true, note, &before);
      gg_md_ops.state(&e->base, &then);
      assert_int_equal(gg_md_ops.rescale(&e->base, power, &err), GG_OK);
      gg_md_ops.snapshot(&e->base, true, note, &after);
      gg_md_ops.state(&e->base, &now);
      assert_true(fabs(now.time - then.time) < 1e-12 * then.time && now.collisions == then.collisions);
      for (size_t i = 0; i < before.n; i++)
        for (int b = 0; b < 3; b++) {
          const double moved = fabs(after.r[b][i] - before.r[b][i]);
          assert_true(fmin(moved, fabs(moved - m.box[b])) < 1e-9);
          assert_true(fabs(after.c[b][i] - ldexp(before.c[b][i], power)) < 1e-9 * (1 + fabs(after.c[b][i])));
        }
      md_collide(e, 20001);
    }
    gg_engine_state s;
    gg_md_ops.state(&e->base, &s);
    assert_true(s.worst_overlap < 1e-12);
    assert_int_equal(gg_md_ops.save(&e->base, &a, &err), GG_OK);
    assert_int_equal(gg_md_ops.restore(&m, &a, &back, &err), GG_OK);
    gg_base_archive_clear(&a);
    for (int part = 0; part < 2; part++) {
      md_collide(e, 7777);
      md_collide((gg_md *)back, 7777);
      assert_int_equal(md_hash(e), md_hash((gg_md *)back));
      assert_int_equal(gg_md_ops.rescale(&e->base, -2, &err), GG_OK);
      assert_int_equal(gg_md_ops.rescale(back, -2, &err), GG_OK);
    }
    md_destroy(e);
    md_destroy((gg_md *)back);
  }
}

/* A run that is rescaled by 2^p at random moments and back has the same trajectory. */
static void rescaling_leaves_the_trajectory(void **state)
{
  (void)state;
  for (int k = 0; k < CASES; k++) {
    gg_model m = md_model(cases[k]);
    if (m.shear_rate != 0 || m.walled) continue;
    gg_md *plain = md_create(&m, 2), *scaled = md_create(&m, 2);
    gg_error err;
    md_collide(plain, 20000);
    for (int part = 0; part < 20; part++) {
      assert_int_equal(gg_md_ops.rescale(&scaled->base, part % 2 ? -3 : 3, &err), GG_OK);
      md_collide(scaled, 1000);
    }
    assert_int_equal(md_hash(plain), md_hash(scaled));
    md_destroy(plain);
    md_destroy(scaled);
  }
  gg_model m = md_model(cases[0]);
  gg_md *e = md_create(&m, 2);
  gg_error err;
  assert_int_equal(gg_md_ops.rescale(&e->base, 1, &err), GG_BAD_INPUT);
  md_destroy(e);
}

/* ---- stopped within an advance ---- */

static bool by_chance(void *context)
{
  return gg_rng_uniform(context) < 0.7;
}

/* An advance that is stopped at random polls, saved and restored each time, ends with the bits of the uninterrupted
 * one, and returns the same time. */
static void advance_stopped(const gg_model *model, double dt, uint64_t most, int *stops)
{
  gg_model m = *model;
  gg_rng rng = gg_common_rng_seed(9, 0);
  gg_stop stop = {by_chance, &rng};
  gg_md *whole = md_create(&m, 5);
  double gone, straight;
  gg_error err;
  gg_collision_sums one, two;
  assert_int_equal(gg_md_ops.advance(&whole->base, 0.1 * dt, most, &straight, &err), GG_OK);
  gg_engine *cut = &md_create(&m, 5)->base;
  m.stop = ((gg_md *)cut)->model.stop = &stop;
  gg_status status = gg_md_ops.advance(cut, 0.1 * dt, most, &gone, &err);
  for (int advance = 0; advance < 2; advance++) {
    for (; status != GG_OK; ++*stops) {
      gg_archive a = {0};
      assert_int_equal(status, GG_INTERRUPTED);
      assert_int_equal(gg_md_ops.save(cut, &a, &err), GG_OK);
      gg_md_ops.destroy(cut);
      assert_int_equal(gg_md_ops.restore(&m, &a, &cut, &err), GG_OK);
      gg_base_archive_clear(&a);
      status = gg_md_ops.go_on(cut, &gone, &err);
    }
    assert_true(gone == straight);
    assert_int_equal(md_hash(whole), md_hash((gg_md *)cut));
    if (advance) break;
    assert_int_equal(gg_md_ops.advance(&whole->base, dt, most, &straight, &err), GG_OK);
    status = gg_md_ops.advance(cut, dt, most, &gone, &err);
  }
  gg_md_ops.take_sums(&whole->base, &one);
  gg_md_ops.take_sums(cut, &two);
  assert_memory_equal(&one, &two, sizeof one);
  md_destroy(whole);
  gg_md_ops.destroy(cut);
}

static void stopped_advances_end_as_uninterrupted_ones(void **state)
{
  (void)state;
  for (int k = 0; k < CASES; k += getenv("NIGHTLY") ? 1 : 2) {
    gg_model m = md_model(cases[k]);
    double dt = 1000 / gg_common_model_collision_rate(&m, m.temperature0);
    int stops = 0;
    advance_stopped(&m, dt, UINT64_MAX, &stops);
    advance_stopped(&m, INFINITY, 100000, &stops);
    assert_true(stops >= 4);
  }
}

/* The same with a thermostat: one with a time of its own, and one with kicks. */
static void heated_advances_end_as_uninterrupted_ones(void **state)
{
  (void)state;
  const gg_thermostat thermostats[] = {GG_GAUSSIAN, GG_WHITE_NOISE};
  for (int k = 0; k < 2; k++) {
    gg_scene s = md_scene((md_case){GG_HSS, 200, 0.1, 0.7, -1, INFINITY, {0}});
    s.thermostat = thermostats[k];
    gg_model m = md_model_of(&s);
    int stops = 0;
    advance_stopped(&m, 400 / gg_common_model_collision_rate(&m, m.temperature0), UINT64_MAX, &stops);
    assert_true(stops >= 4);
  }
}

/* An advance that was stopped may be left unfinished: the next one continues the trajectory, and no time is lost. */
static void a_stopped_advance_may_be_left(void **state)
{
  (void)state;
  gg_model m = md_model(cases[0]);
  gg_rng rng = gg_common_rng_seed(3, 0);
  gg_stop stop = {by_chance, &rng};
  gg_md *whole = md_create(&m, 6);
  md_collide(whole, 60000);
  gg_md *cut = md_create(&m, 6);
  cut->model.stop = &stop;
  gg_error err;
  double gone, total = 0;
  int stops = 0;
  while (cut->k.collisions < 60000) {
    stops += gg_md_ops.advance(&cut->base, INFINITY, 60000 - cut->k.collisions, &gone, &err) == GG_INTERRUPTED;
    total += gone;
  }
  assert_true(stops >= 4);
  assert_int_equal(md_hash(whole), md_hash(cut));
  assert_true(fabs(total - (whole->k.epoch_start + whole->k.now)) < 1e-9 * total);
  md_destroy(whole);
  md_destroy(cut);
}

static bool at_once(void *context)
{
  (void)context;
  return true;
}

/* Restoring does not poll the model's stop, as a run that is being stopped for a checkpoint must restore the replicas
 * of other processes. It polls the archive's. */
static void a_stopped_run_can_restore(void **state)
{
  (void)state;
  const gg_stop stop = {at_once, NULL};
  gg_model m = md_model((md_case){GG_EQUILIBRIUM, 2 * GG_MD_GRAINS_PER_POLL, 0.1, 1, -1, INFINITY, {0}});
  gg_md *e = md_create(&m, 1);
  gg_engine *back = NULL;
  gg_archive a = {0};
  gg_error err;
  double gone;
  assert_int_equal(gg_md_ops.save(&e->base, &a, &err), GG_OK);
  m.stop = &stop;
  assert_int_equal(gg_md_ops.restore(&m, &a, &back, &err), GG_OK);
  assert_int_equal(md_hash(e), md_hash((gg_md *)back));
  assert_int_equal(gg_md_ops.advance(back, INFINITY, 100000, &gone, &err), GG_INTERRUPTED);
  md_destroy((gg_md *)back);
  m.stop = NULL, a.stop = &stop;
  assert_int_equal(gg_md_ops.restore(&m, &a, &back, &err), GG_INTERRUPTED);
  gg_base_archive_clear(&a);
  md_destroy(e);
}

int main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test(restored_runs_continue_bit_for_bit),
                                     cmocka_unit_test(a_clock_far_off_is_rejected),
                                     cmocka_unit_test(runs_can_be_cut_anywhere),
                                     cmocka_unit_test(sweeps_begin_in_the_same_places),
                                     cmocka_unit_test(rescaling_leaves_the_trajectory),
                                     cmocka_unit_test(stopped_advances_end_as_uninterrupted_ones),
                                     cmocka_unit_test(heated_advances_end_as_uninterrupted_ones),
                                     cmocka_unit_test(a_stopped_advance_may_be_left),
                                     cmocka_unit_test(a_stopped_run_can_restore)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
