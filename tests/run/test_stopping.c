/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Proves, with the real engines: a run that is stopped in the midst of an interval and resumed from the checkpoint it
 * left ends with the same numbers to the last bit, whatever stops it; replicas that were stopped at different samples
 * are reported as far as all of them came; the time limit is kept within an interval; a start in the cold, a gas that
 * has cooled for long, and a box of a few diameters. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

#include "common/rng.h"
#include "graingas.h"
#include "run/run.h"
#include "run/z_scores.h"
#include "scene/scene_reader.h"

typedef struct caller {
  gg_rng rng;
  double chance; /* of a stop, whenever asked */
  int stops;
  gg_archive kept;
} caller;

static bool by_chance(void *context)
{
  caller *c = context;
  bool stop = gg_rng_uniform(&c->rng) < c->chance;
  c->stops += stop;
  return stop;
}

static gg_status keep(void *context, gg_archive *archive, gg_error *err)
{
  caller *c = context;
  gg_base_archive_clear(&c->kept);
  return gg_base_archive_append(&c->kept, archive, err);
}

static gg_scene scene_of(const char *yaml)
{
  gg_scene s = gg_scene_defaults();
  gg_error err = {0};
  if (gg_scene_read(&s, yaml, strlen(yaml), "test", &err) != GG_OK || gg_scene_finish(&s, &err) != GG_OK)
    fail_msg("%s", err.message);
  return s;
}

static void same(const gg_result *a, const gg_result *b)
{
  assert_int_equal(a->final.n, b->final.n);
  assert_memory_equal(a->final.velocity, b->final.velocity, 3 * a->final.n * sizeof(double));
  assert_true(a->final.time == b->final.time && a->engine_state.collisions == b->engine_state.collisions);
  for (int q = 0; q < GG_N_QUANTITIES; q++) {
    assert_memory_equal(&a->value[q].mean, &b->value[q].mean, sizeof(double));
    assert_memory_equal(&a->value[q].error, &b->value[q].error, sizeof(double));
  }
  assert_int_equal(a->curves.n, b->curves.n);
  for (int k = 0; k < a->curves.n; k++)
    assert_memory_equal(a->curves.curve[k].value, b->curves.curve[k].value, a->curves.curve[k].n * sizeof(double));
}

/* Go on from checkpoint to checkpoint until the run is over. */
static gg_result *in_pieces(const gg_scene *s, int threads, caller *c)
{
  gg_run_callbacks callbacks = {.context = c, .interrupted = by_chance, .checkpoint = keep};
  gg_result *r = NULL;
  gg_archive from = {0};
  gg_error err;
  while (gg_run_scene(s, from.n_items ? &from : NULL, threads, &callbacks, &r, &err) == GG_INTERRUPTED) {
    if (!r) continue; /* interrupted while grains were placed */
    gg_result_free(r);
    r = NULL;
    gg_base_archive_clear(&from);
    assert_int_equal(gg_base_archive_append(&from, &c->kept, &err), GG_OK);
  }
  assert_non_null(r);
  gg_base_archive_clear(&from);
  gg_base_archive_clear(&c->kept);
  return r;
}

/* Dilute, so that an interval has many events; small steps; a thermostat with kicks; curves of several parts. */
static const char *const scenes[] = {
    "{flow: hcs, phi: 1e-4, particles: 150, collision: {e: 0.7}, measure: [rheology, velocity_distributions], run: "
    "{collisions: 30, warmup: 10}}",
    "{flow: usf, phi: 1e-3, particles: 200, measure: [rheology, diffusion, viscosity], run: {collisions: 40, warmup: "
    "10, replicas: 2}}",
    "{flow: hss, thermostat: white_noise, phi: 0.01, particles: 150, run: {collisions: 30, warmup: 10}}",
    "{engine: dsmc, flow: usf, phi: 0.1, dsmc: {particles: 200, time_step: 5e-5}, measure: [rheology, diffusion], run: "
    "{collisions: 20, warmup: 4, replicas: 2}}",
};

static void in_the_midst_of_an_interval(void **state)
{
  (void)state;
  for (size_t k = 0; k < sizeof scenes / sizeof *scenes; k++) {
    gg_scene s = scene_of(scenes[k]);
    gg_result *whole = NULL;
    gg_run_scene(&s, NULL, 1, NULL, &whole, NULL);
    assert_non_null(whole);
    for (int threads = 1; threads < 3; threads++) {
      caller c = {.rng = gg_common_rng_seed(k, 1), .chance = 0.3};
      gg_result *pieces = in_pieces(&s, threads, &c);
      assert_true(c.stops >= 3);
      same(whole, pieces);
      gg_result_free(pieces);
    }
    gg_result_free(whole);
  }
}

static double now(void)
{
  struct timespec t;
  clock_gettime(CLOCK_MONOTONIC, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* An interval that would take minutes: the time limit ends it, and what was kept goes on from there. */
static void the_time_limit_ends_a_long_interval(void **state)
{
  (void)state;
  const char *const long_intervals[] = {
      "{flow: hcs, phi: 1e-9, particles: 1000, run: {time_limit: 0.2}}",
      "{engine: dsmc, flow: usf, phi: 0.1, dsmc: {particles: 1000, time_step: 1e-9}, run: {time_limit: 0.2}}"};
  for (int k = 0; k < 2; k++) {
    gg_scene s = scene_of(long_intervals[k]);
    caller c = {.chance = 0};
    gg_run_callbacks callbacks = {.context = &c, .checkpoint = keep};
    gg_result *r = NULL;
    gg_error err = {0};
    double before = now(), reached = 0, limit = 0;
    for (int piece = 0; piece < 2; piece++) {
      gg_archive from = {0};
      assert_int_equal(gg_base_archive_append(&from, &c.kept, NULL), GG_OK);
      /* On a busy machine the limit may pass before the gas moves: within the start, which has no result yet. */
      for (double last = reached; reached == last; gg_result_free(r)) {
        s.run.time_limit = limit += 0.2;
        assert_true(limit < 10);
        assert_int_equal(gg_run_scene(&s, piece ? &from : NULL, 1, &callbacks, &r, &err), GG_FAILED);
        assert_non_null(strstr(err.message, r ? "time limit" : "time limit reached before the start was done"));
        if (r) reached = r->final.time;
        assert_true(reached >= last);
      }
      gg_base_archive_clear(&from);
    }
    assert_true(now() - before < 20); /* and not minutes */
    gg_base_archive_clear(&c.kept);
  }
}

/* From a start far below the steady temperature both engines come to the same. */
static void cold_start(void **state)
{
  (void)state;
  gg_result *r[2];
  for (int k = 0; k < 2; k++) {
    gg_scene s = scene_of("{flow: usf, phi: 0.01, particles: 500, temperature: 1e-6, dsmc: {particles: 2000}, run: "
                          "{collisions: 600, warmup: 100}}");
    s.engine = (gg_engine_kind)k;
    gg_error err = {0};
    if (gg_run_scene(&s, NULL, 1, NULL, &r[k], &err) != GG_OK) fail_msg("%s", err.message);
  }
  double z = gg_run_z_score(&r[GG_MD]->value[GG_Q_COLLISION_RATE], &r[GG_DSMC]->value[GG_Q_COLLISION_RATE]);
  assert_true(fabs(z) < 4);
  gg_result_free(r[GG_MD]), gg_result_free(r[GG_DSMC]);
}

/* Without the contact-time rule grains of e = 0 collapse in the warm-up. That is said, wherever the warm-up ends: never
 * a window without collisions, in which nothing varies. */
static void collapse_in_the_warm_up_fails(void **state)
{
  (void)state;
  for (int warmup = 6; warmup < 60; warmup += 17) {
    char yaml[300];
    snprintf(yaml, sizeof yaml,
             "{flow: usf, phi: 0.2, particles: 200, collision: {e: 0, beta: 0}, "
             "md: {contact_time: 0}, run: {collisions: 300, warmup: %d}}",
             warmup);
    gg_scene s = scene_of(yaml);
    gg_error err = {0};
    gg_result *r = NULL;
    assert_int_equal(gg_run_scene(&s, NULL, 1, NULL, &r, &err), GG_FAILED);
    assert_int_equal(err.cause, GG_CAUSE_COLLAPSE);
    gg_result_free(r);
  }
}

/* Light rough grains between heavy ones are no such collapse: bursts that the contact-time rule ends. */
static void unlike_rough_grains(void **state)
{
  (void)state;
  gg_scene s = scene_of("{flow: usf, phi: 0.2, particles: 400, species: [{fraction: .5}, {fraction: .5, mass: 100}], "
                        "collision: {e: 0.9, beta: 0}, run: {collisions: 300, seed: 1}}");
  gg_error err = {0};
  gg_result *r = NULL;
  if (gg_run_scene(&s, NULL, 1, NULL, &r, &err) != GG_OK) fail_msg("%s", err.message);
  assert_true(r->averaging.collisions > 0.2 * 300 * 200);
  assert_true(fabs(r->value[GG_Q_ENERGY_BALANCE].mean - 1) < 4 * r->value[GG_Q_ENERGY_BALANCE].error + 0.05);
  gg_result_free(r);
}

/* A box of a few diameters has a warning. */
static void narrow_box(void **state)
{
  (void)state;
  const char *const sizes[] = {"10", "200"};
  for (int k = 0; k < 2; k++) {
    char yaml[200];
    snprintf(yaml, sizeof yaml, "{flow: usf, phi: 0.3, particles: %s, run: {collisions: 100, warmup: 10}}", sizes[k]);
    gg_scene s = scene_of(yaml);
    gg_result *r = NULL;
    gg_run_scene(&s, NULL, 1, NULL, &r, NULL);
    assert_non_null(r);
    bool told = false;
    for (size_t i = 0; i < r->warnings.n; i++) told |= strstr(r->warnings.text[i], "diameters wide") != NULL;
    assert_int_equal(told, k == 0);
    gg_result_free(r);
  }
}

/* However cold a gas is when averaging begins, and be it below all numbers: the collapse of which runs are warned is
 * judged by its speeds, not by those of its start. */
static void cold_end(void **state)
{
  (void)state;
  for (int k = 0; k < 4; k++) {
    gg_scene s = scene_of("{flow: hcs, phi: 0.02, particles: 100, dsmc: {particles: 100}, collision: {e: 0.5}, run: "
                          "{collisions: 20}}");
    s.engine = k % 2 ? GG_DSMC : GG_MD;
    s.run.warmup = k < 2 ? 100 : 4000;
    gg_result *r = NULL;
    gg_error err = {0};
    if (gg_run_scene(&s, NULL, 1, NULL, &r, &err) != GG_OK) fail_msg("%s", err.message);
    assert_true(r->value[GG_Q_COOLING_RATE].mean > 0.3 && r->value[GG_Q_COOLING_RATE].mean < 0.5);
    gg_result_free(r);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test(in_the_midst_of_an_interval),
                                     cmocka_unit_test(the_time_limit_ends_a_long_interval),
                                     cmocka_unit_test(cold_start),
                                     cmocka_unit_test(cold_end),
                                     cmocka_unit_test(collapse_in_the_warm_up_fails),
                                     cmocka_unit_test(unlike_rough_grains),
                                     cmocka_unit_test(narrow_box)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
