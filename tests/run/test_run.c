/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The run layer over an engine whose answers are planted: right means, honest ends, slow relaxation noticed, replicas
 * and threads, interruption and bitwise resumption. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>
#include <math.h>
#include <stdatomic.h>
#include <string.h>
#include <time.h>

#include "fake_engine.h"
#include "graingas.h"
#include "run/run.h"

static gg_result *run(const gg_scene *s, gg_status expected)
{
  gg_result *r = NULL;
  gg_error err = {0};
  gg_status status = gg_run_scene(s, NULL, 2, NULL, &r, &err);
  if (status != expected) print_message("unexpected: %s\n", err.message);
  assert_int_equal(status, expected);
  return r;
}

static void within(const gg_result *r, gg_quantity q, double expected)
{
  const gg_estimate *e = &r->value[q];
  assert_true(e->error > 0);
  assert_true(fabs(e->mean - expected) < 5 * e->error);
}

/* The planted means come out within five of their errors, the asked relative error is reached, the state is steady. */
static void planted_means(void **state)
{
  (void)state;
  gg_scene s = planted_scene(0);
  s.run.relative_error = 0.002;
  gg_result *r = run(&s, GG_OK);
  assert_int_equal(r->steadiness, GG_STEADY);
  within(r, GG_Q_TEMPERATURE, 2);
  within(r, GG_Q_TEMPERATURE_RATIO, 0.25);
  within(r, GG_Q_SHEAR_VISCOSITY, M_PI / 6 * 0.5);
  const gg_quantity headline[] = {GG_Q_TEMPERATURE, GG_Q_PRESSURE, GG_Q_SHEAR_VISCOSITY, GG_Q_TEMPERATURE_RATIO};
  for (int i = 0; i < 4; i++) assert_true(r->value[headline[i]].error <= 0.002 * fabs(r->value[headline[i]].mean));
  assert_true(r->value[GG_Q_TEMPERATURE].samples > 100);
  assert_true(isnan(r->value[GG_Q_COOLING_RATE].mean) && r->value[GG_Q_COOLING_RATE].reason[0]);
  gg_result_free(r);
}

static bool warns(const gg_scene *s, const char *words)
{
  gg_result *r = run(s, GG_OK);
  bool found = false;
  for (size_t i = 0; i < r->warnings.n; i++) found |= strstr(r->warnings.text[i], words) != NULL;
  gg_result_free(r);
  return found;
}

/* Work that collisions do not dissipate causes a warning from five errors on, in either engine. */
static void an_open_energy_balance_causes_a_warning(void **state)
{
  (void)state;
  for (int engine = GG_MD; engine <= GG_DSMC; engine++) {
    gg_scene s = planted_scene(0);
    s.engine = (gg_engine_kind)engine, s.run.relative_error = 0.003;
    if (engine == GG_DSMC) s.dsmc.particles = s.particles;
    assert_false(warns(&s, "energy is not balanced"));
    fake.unpaid = 0.1;
    assert_true(warns(&s, "energy is not balanced: energy_balance is 1.1"));
    fake.unpaid = -0.1;
    assert_true(warns(&s, "energy is not balanced: energy_balance is 0.9"));
  }
}

/* Too few grains for precise means cause a warning in either engine, unless the requested error implies one already. */
static void too_few_grains_cause_a_warning(void **state)
{
  (void)state;
  for (int engine = GG_MD; engine <= GG_DSMC; engine++)
    for (int64_t n = 40; n <= 160; n += 120) {
      gg_scene s = planted_scene(0);
      s.engine = (gg_engine_kind)engine, s.particles = n, s.run.collisions = 400;
      if (engine == GG_DSMC) s.dsmc.particles = n;
      assert_int_equal(warns(&s, "40 grains are few"), n == 40);
      s.run.collisions = GG_AUTO, s.run.relative_error = 0.003;
      assert_int_equal(warns(&s, "40 grains are few"), n == 40 && engine == GG_MD);
      if (engine == GG_DSMC) assert_true(warns(&s, "grains biases means"));
    }
}

/* Spheres of one diameter, at rest above freezing, started at random places. */
static void equal_spheres_above_freezing_cause_a_warning(void **state)
{
  (void)state;
  static const struct {
    gg_flow flow;
    double phi, diameter;
    gg_engine_kind engine;
    bool expected;
  } cases[] = {{GG_EQUILIBRIUM, 0.5, 1, GG_MD, true},
               {GG_EQUILIBRIUM, 0.49, 1, GG_MD, false},
               {GG_EQUILIBRIUM, 0.5, 1.2, GG_MD, false},
               {GG_EQUILIBRIUM, 0.5, 1, GG_DSMC, false},
               {GG_USF, 0.5, 1, GG_MD, false}};
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    gg_scene s = planted_scene(-1);
    s.flow = cases[i].flow, s.phi = cases[i].phi, s.engine = cases[i].engine, s.run.collisions = 400;
    s.dsmc.particles = s.particles;
    if (cases[i].flow == GG_EQUILIBRIUM) s.collision.e[0] = 1;
    if (cases[i].diameter != 1) {
      s.n_species = 2;
      s.species[0] = (gg_species){0.5, 1, 1, 0.4, 1, 0},
      s.species[1] = (gg_species){0.5, cases[i].diameter, 1, 0.4, 1, 0};
      for (int p = 0; p < GG_PAIRS; p++) s.collision.e[p] = s.collision.e[0], s.collision.beta[p] = s.collision.beta[0];
    }
    assert_int_equal(warns(&s, "above freezing"), cases[i].expected);
  }
}

/* Without a measured quantity no state is called steady. */
static void nothing_is_steady_where_nothing_is_measured(void **state)
{
  (void)state;
  gg_scene s = planted_scene(0);
  s.measure = 0;
  s.run.collisions = 4000;
  gg_result *r = run(&s, GG_OK);
  assert_int_equal(r->steadiness, GG_NOT_STEADY);
  assert_non_null(strstr(r->steadiness_text, "nothing is measured"));
  gg_result_free(r);
}

/* Under gravity a run ends, and says why, when nearly all collisions are contacts that last; in the flow before, and
 * without gravity, it goes on. */
static void arrest_share(void **state)
{
  (void)state;
  gg_scene s = planted_scene(0);
  s.run.relative_error = 0.002;
  const struct {
    double gravity, treated;
    gg_status status;
  } cases[] = {{-1, 0.8, GG_OK}, {0, 0.97, GG_OK}, {-1, 0.97, GG_FAILED}};
  for (int i = 0; i < 3; i++) {
    s.gravity[1] = cases[i].gravity;
    fake.treated = cases[i].treated;
    gg_result *r = run(&s, cases[i].status);
    assert_int_equal(r->steadiness, cases[i].status == GG_OK ? GG_STEADY : GG_NOT_STEADY);
    assert_int_equal(strstr(r->steadiness_text, "97 % of collisions") != NULL, cases[i].status != GG_OK);
    gg_result_free(r);
  }
}

/* Spins that relax ten times slower than estimated show as a trend in the data: averaging restarts until it is gone. */
static void slow_relaxation(void **state)
{
  (void)state;
  gg_scene s = planted_scene(0);
  fake.start = -0.9, fake.relaxation = 400;
  s.run.relative_error = 0.005;
  gg_result *r = run(&s, GG_OK);
  assert_int_equal(r->steadiness, GG_STEADY);
  within(r, GG_Q_TEMPERATURE_RATIO, 0.25);
  gg_result_free(r);
  s.run.warmup = 10, s.run.collisions = 400; /* a fixed short window: the result reports the trend */
  s.run.relative_error = GG_AUTO;
  r = run(&s, GG_OK);
  assert_int_equal(r->steadiness, GG_NOT_STEADY);
  assert_true(r->warnings.n > 0);
  gg_result_free(r);
}

/* beta near -1: a window shorter than the slow relaxation of spins is too short even if noise hides the trend. */
static void nearly_smooth(void **state)
{
  (void)state;
  gg_scene s = planted_scene(-0.99);
  s.run.collisions = 300;
  gg_result *r = run(&s, GG_OK);
  assert_int_equal(r->steadiness, GG_NOT_STEADY);
  assert_non_null(strstr(r->steadiness_text, "too short"));
  gg_result_free(r);
}

/* A temperature that grows for ever is not steady. */
static void endless_trend(void **state)
{
  (void)state;
  gg_scene s = planted_scene(-1);
  fake.trend = 1e-4, fake.noise = 0.005;
  s.run.collisions = 2000;
  gg_result *r = run(&s, GG_OK);
  assert_int_equal(r->steadiness, GG_NOT_STEADY);
  assert_non_null(strstr(r->steadiness_text, "has a trend"));
  gg_result_free(r);
}

/* Elastic smooth grains under shear heat up: a history and no mean is reported. */
static void elastic_shear_is_followed_as_heating(void **state)
{
  (void)state;
  gg_scene s = planted_scene(-1);
  s.collision.e[0] = 1;
  gg_result *r = run(&s, GG_OK);
  assert_int_equal(r->steadiness, GG_HEATING);
  assert_true(isnan(r->value[GG_Q_TEMPERATURE].mean));
  assert_non_null(strstr(r->value[GG_Q_TEMPERATURE].reason, "heats"));
  assert_true(r->history.n > 100 && r->history.value[0][50] > 0);
  gg_result_free(r);
}

/* `collisions` is kept to within a sample; the time limit ends a run that has no other end, short of what was asked. */
static void collisions_and_time_end_a_run(void **state)
{
  (void)state;
  gg_scene s = planted_scene(-1);
  s.run.collisions = 600;
  gg_result *r = run(&s, GG_OK);
  double per_grain = 2.0 * (double)r->averaging.collisions / 512;
  assert_true(fabs(per_grain - 600) < 30);
  gg_result_free(r);
  s = planted_scene(-1);
  s.run.relative_error = 1e-9, s.run.time_limit = 0.3;
  r = run(&s, GG_FAILED);
  assert_non_null(r);
  assert_true(r->total.wall_seconds < 5);
  gg_result_free(r);
}

static void same_results(const gg_result *a, const gg_result *b)
{
  for (int q = 0; q < GG_N_QUANTITIES; q++) {
    if (isnan(a->value[q].mean) && isnan(b->value[q].mean)) continue;
    assert_true(a->value[q].mean == b->value[q].mean && a->value[q].error == b->value[q].error);
  }
  assert_int_equal(a->total.collisions, b->total.collisions);
}

/* Replicas give the same result from one thread or two, and a smaller error than one. */
static void threads_do_not_change_the_result_of_replicas(void **state)
{
  (void)state;
  gg_scene s = planted_scene(0);
  s.run.collisions = 1000;
  gg_result *single = run(&s, GG_OK), *one = NULL, *two = NULL;
  s.run.replicas = 4;
  assert_int_equal(gg_run_scene(&s, NULL, 1, NULL, &one, NULL), GG_OK);
  assert_int_equal(gg_run_scene(&s, NULL, 2, NULL, &two, NULL), GG_OK);
  same_results(one, two);
  double gain = single->value[GG_Q_TEMPERATURE].error / one->value[GG_Q_TEMPERATURE].error;
  assert_true(gain > 1.2 && gain < 3.5);
  gg_result_free(single), gg_result_free(one), gg_result_free(two);
}

typedef struct keeper {
  int asked, stop_at, frames;
  gg_archive kept;
} keeper;

static bool stop_after(void *context)
{
  keeper *k = context;
  return ++k->asked > k->stop_at;
}

static gg_status keep(void *context, gg_archive *archive, gg_error *err)
{
  keeper *k = context;
  gg_base_archive_clear(&k->kept);
  return gg_base_archive_nest(&k->kept, "x", archive, err);
}

static gg_status count_frame(void *context, const gg_frame *frame, gg_error *err)
{
  (void)frame, (void)err;
  ((keeper *)context)->frames++;
  return GG_OK;
}

/* Run, interrupted by the callback's call number `stop` + 1, and resumed from its checkpoint. NULL: it ended before. */
static gg_result *in_two_parts(const gg_scene *s, int stop, gg_archive *archive)
{
  keeper k = {.stop_at = stop};
  gg_run_callbacks callbacks = {.context = &k, .interrupted = stop_after, .frame = count_frame, .checkpoint = keep};
  gg_result *r = NULL;
  gg_base_archive_clear(archive);
  if (gg_run_scene(s, NULL, 1, &callbacks, &r, NULL) == GG_INTERRUPTED) {
    assert_non_null(r); /* the result so far */
    gg_result_free(r);
    assert_int_equal(gg_base_archive_unnest(archive, "x", &k.kept, NULL), GG_OK);
    assert_int_equal(gg_run_scene(s, archive, 1, NULL, &r, NULL), GG_OK);
  } else {
    gg_result_free(r);
    r = NULL;
  }
  gg_base_archive_clear(&k.kept);
  return r;
}

/* Interrupted anywhere (warm-up, averaging, in the midst of an interval, between replicas) and resumed from its
 * checkpoint, a run ends with the same numbers to the last bit, whatever ends it. */
static void an_interrupted_run_resumes_to_the_same_bits(void **state)
{
  (void)state;
  for (int mode = 0; mode < 2; mode++) {
    gg_scene s = planted_scene(0);
    fake.start = 0.5, fake.relaxation = 60; /* windows are given up for their trend */
    s.run.replicas = 2, s.run.seed = 3;
    if (mode == 0)
      s.run.collisions = 800;
    else
      s.run.relative_error = 0.004;
    s.output.checkpoint_every = 1e6;
    gg_result *whole = run(&s, GG_OK);
    gg_archive archive = {0};
    int resumed = 0;
    for (int stop = 1; stop < 1200; stop += 23) {
      gg_result *r = in_two_parts(&s, stop, &archive);
      if (!r) break;
      same_results(whole, r);
      gg_result_free(r);
      resumed++;
    }
    assert_true(resumed > 20);
    gg_base_archive_clear(&archive), gg_result_free(whole);
  }
}

/* A checkpoint of other physics is refused, and the key named. */
static void other_scene(void **state)
{
  (void)state;
  gg_scene s = planted_scene(0);
  s.run.collisions = 400, s.output.checkpoint_every = 1e6;
  s.run.seed = 9007199254740992;
  gg_archive archive = {0};
  gg_result_free(in_two_parts(&s, 60, &archive));
  gg_scene other[7] = {s, s, s, s, s, s, s};
  other[0].phi = 0.21, other[1].collision.e[1] = 0.5, other[2].species[1].mass = 2, other[3].walls.beta = 0;
  other[4].gravity[1] = -1, other[5].run.warmup = 100, other[6].run.seed++;
  const char *const names[] = {"phi",     "collision.e", "species.2.mass",  "walls.beta",
                               "gravity", "run.warmup",  "9007199254740993"};
  for (int i = 0; i < 7; i++) {
    gg_result *r = NULL;
    gg_error err;
    assert_int_equal(gg_run_scene(&other[i], &archive, 1, NULL, &r, &err), GG_BAD_INPUT);
    assert_non_null(strstr(err.message, names[i]));
  }
  s.run.collisions = 800; /* a longer run of the same is welcome */
  gg_result *r = NULL;
  assert_int_equal(gg_run_scene(&s, &archive, 1, NULL, &r, NULL), GG_OK);
  gg_result_free(r), gg_base_archive_clear(&archive);
}

typedef struct frames {
  int n;
  double last;
} frames;

static gg_status see_frame(void *context, const gg_frame *frame, gg_error *err)
{
  frames *f = context;
  if (!(frame->time > f->last)) return gg_base_fail(err, GG_FAILED, "frames out of order");
  f->last = frame->time;
  f->n++;
  return GG_OK;
}

/* Only the first replica stores frames, in order, in a resumed run, too. */
static void frames_are_those_of_the_first_replica(void **state)
{
  (void)state;
  gg_scene s = planted_scene(-1);
  s.run.collisions = 400, s.run.replicas = 3, s.output.trajectory_every = 20, s.output.checkpoint_every = 1e6;
  gg_archive archive = {0};
  frames whole = {0, -1}, rest = {0, -1};
  gg_run_callbacks callbacks = {.context = &whole, .frame = see_frame};
  gg_result *r = NULL;
  assert_int_equal(gg_run_scene(&s, NULL, 3, &callbacks, &r, NULL), GG_OK);
  gg_result_free(r);
  gg_result_free(in_two_parts(&s, 200, &archive));
  callbacks.context = &rest;
  assert_int_equal(gg_run_scene(&s, &archive, 3, &callbacks, &r, NULL), GG_OK);
  assert_true(rest.n > 3 && rest.n < whole.n && rest.last == whole.last);
  gg_result_free(r), gg_base_archive_clear(&archive);
}

typedef struct crowd {
  atomic_int inside, most, calls;
} crowd;

static void enter(crowd *c)
{
  int now = atomic_fetch_add(&c->inside, 1) + 1;
  if (now > atomic_load(&c->most)) atomic_store(&c->most, now);
  nanosleep(&(struct timespec){0, 20000}, NULL);
  atomic_fetch_add(&c->calls, 1);
  atomic_fetch_sub(&c->inside, 1);
}

static bool ask(void *context)
{
  enter(context);
  return false;
}

static gg_status show(void *context, const gg_frame *frame, gg_error *err)
{
  (void)frame, (void)err;
  enter(context);
  return GG_OK;
}

/* Replicas on several threads call the callbacks one at a time. */
static void hooks_one_at_a_time(void **state)
{
  (void)state;
  gg_scene s = planted_scene(-1);
  s.run.collisions = 200, s.run.replicas = 4, s.output.trajectory_every = 10;
  crowd c = {0};
  gg_run_callbacks callbacks = {.context = &c, .interrupted = ask, .frame = show};
  gg_result *r = NULL;
  assert_int_equal(gg_run_scene(&s, NULL, 4, &callbacks, &r, NULL), GG_OK);
  assert_true(c.calls > 400);
  assert_int_equal(c.most, 1);
  gg_result_free(r);
}

/* The time limit stores a checkpoint, reports that the run is short, and never averages over the warm-up. */
static void the_time_limit_keeps_a_checkpoint(void **state)
{
  (void)state;
  gg_scene s = planted_scene(0);
  fake.seconds = 2e-3;
  s.run.collisions = 1e5, s.run.warmup = 1e5, s.run.time_limit = 0.1, s.output.checkpoint_every = 1e6;
  keeper k = {.stop_at = 1 << 30};
  gg_run_callbacks callbacks = {.context = &k, .checkpoint = keep};
  gg_result *r = NULL;
  assert_int_equal(gg_run_scene(&s, NULL, 1, &callbacks, &r, NULL), GG_FAILED);
  assert_true(k.kept.n_items > 0);
  assert_true(isnan(r->value[GG_Q_TEMPERATURE].mean));
  assert_non_null(strstr(r->value[GG_Q_TEMPERATURE].reason, "warm-up"));
  gg_result_free(r), gg_base_archive_clear(&k.kept);
}
int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(planted_means),
      cmocka_unit_test(an_open_energy_balance_causes_a_warning),
      cmocka_unit_test(too_few_grains_cause_a_warning),
      cmocka_unit_test(equal_spheres_above_freezing_cause_a_warning),
      cmocka_unit_test(nothing_is_steady_where_nothing_is_measured),
      cmocka_unit_test(slow_relaxation),
      cmocka_unit_test(nearly_smooth),
      cmocka_unit_test(endless_trend),
      cmocka_unit_test(elastic_shear_is_followed_as_heating),
      cmocka_unit_test(collisions_and_time_end_a_run),
      cmocka_unit_test(threads_do_not_change_the_result_of_replicas),
      cmocka_unit_test(an_interrupted_run_resumes_to_the_same_bits),
      cmocka_unit_test(other_scene),
      cmocka_unit_test(frames_are_those_of_the_first_replica),
      cmocka_unit_test(the_time_limit_keeps_a_checkpoint),
      cmocka_unit_test(hooks_one_at_a_time),
      cmocka_unit_test(arrest_share),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
