/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Proves, for gases in a bath in md: elastic grains relax as drag and noise do, for any interval of the kick schedule;
 * sheared grains that hardly collide have the moments of the schedule in closed form, at the engine's interval and at
 * one twelve times as long, from which its error is known; inelastic dilute grains have the temperatures of Enskog's
 * equation. */
#include <stdlib.h>

#include "../dsmc/lab.h"

#include "common/thermostat.h"
#include "md/kicks.h"
#include "scene/model_of_scene.h"
#include "theory/theory.h"

static gg_model bath(gg_flow flow, double phi, double e, double beta, double drag, double T, double rotation, int64_t n)
{
  gg_scene s = lab_scene(flow, phi, e, beta, n);
  gg_model m;
  gg_error err = {0};
  s.particles = n;
  s.thermostat = GG_BATH;
  s.bath.drag = drag, s.bath.temperature = T, s.bath.rotation = rotation;
  if (gg_scene_model_make(&s, GG_MD, &m, &err) != GG_OK) fail_msg("%s", err.message);
  return m;
}

static gg_engine *engine_of(const gg_model *m, uint64_t seed)
{
  gg_engine *g = NULL;
  gg_error err = {0};
  if (gg_md_ops.create(m, seed, 0, &g, &err) != GG_OK) fail_msg("%s", err.message);
  return g;
}

static void advance(gg_engine *g, double dt)
{
  double elapsed;
  gg_error err = {0};
  if (gg_md_ops.advance(g, dt, UINT64_MAX, &elapsed, &err) != GG_OK) fail_msg("%s", err.message);
}

static lab_view view_of(gg_engine *g)
{
  lab_view v = {0};
  gg_md_ops.snapshot(g, false, lab_add_chunk, &v);
  return v;
}

/* Stretches the kick schedule by a factor. Returns the interval between kicks of a grain. */
static double stretch(gg_engine *g, double factor)
{
  gg_md *e = (gg_md *)g;
  const gg_bath *b = &e->model.bath;
  gg_md_kick_schedule *t = &e->kicks.schedule[0];
  t->interval *= factor;
  const double interval = t->interval * t->n / 2;
  const gg_relaxation r = gg_common_relaxation(b->drag[0], interval);
  t->keep = r.decay, t->size = sqrt(b->noise[0] * r.spread);
  return interval;
}

/* The momentum is removed, which lowers T by 1/N. */
static void elastic_grains_relax_as_drag_and_noise_do(void **state)
{
  (void)state;
  const int n = 1000;
  lab_mean T[3] = {{0}};
  for (uint64_t seed = 0; seed < 24; seed++) {
    gg_model m = bath(GG_HSS, 0.1, 1, -1, 0.5, 1, 0, n);
    m.temperature0 = 3;
    gg_engine *g = engine_of(&m, 1 + seed);
    for (int i = 0; i < 3; i++) {
      advance(g, 0.5);
      lab_view v = view_of(g);
      lab_add(&T[i], lab_temperature(&v));
    }
    gg_md_ops.destroy(g);
  }
  for (int i = 0; i < 3; i++) {
    const double rest = exp(-0.5 * (i + 1));
    lab_expect("T(t)", &T[i], 1 + 2 * rest, 1e-3, 0.05);
  }
}

/* Means over an interval t at shear rate 1, with h = gamma t and C = coth(h): M_yy = T_b, M_xy = -T_b (t/2) C,
 * M_xx = T_b [1 + t^2 (C^2/2 - 1/6)]. For h to 0 they are those of the bath. */
static void sheared_moments_are_known(void **state)
{
  (void)state;
  const double gamma = 1.5, Tb = 0.4;
  for (int k = 0; k < 2; k++) {
    gg_model m = bath(GG_USF, 1e-4, 0.9, 0.1, gamma, Tb, 0.7, 1000);
    m.temperature0 = 0.4;
    gg_engine *g = engine_of(&m, 1);
    const double t = stretch(g, k ? 12 : 1), C = 1 / tanh(gamma * t);
    lab_mean M[3] = {{0}}, theta = {0}, spin = {0};
    advance(g, 5);
    for (int i = 0; i < 80; i++) {
      lab_view v = {0};
      for (int s = 0; s < 10; s++) {
        advance(g, 0.37);
        gg_md_ops.snapshot(g, false, lab_add_chunk, &v);
      }
      lab_add(&M[0], v.cc[0][0] / v.n);
      lab_add(&M[1], v.cc[1][1] / v.n);
      lab_add(&M[2], v.cc[0][1] / v.n);
      const double sz = v.s_mean[2] / v.n;
      lab_add(&theta, m.inertia[0] * (v.ss / v.n - sz * sz) / 3);
      lab_add(&spin, 2 * sz);
    }
    print_message("# interval %.3g/gamma\n", gamma * t);
    lab_expect("M_xx", &M[0], Tb * (1 + t * t * (C * C / 2 - 1. / 6)), 4e-4, 0.02);
    lab_expect("M_yy", &M[1], Tb, 4e-4, 0.02);
    lab_expect("M_xy", &M[2], -Tb * t / 2 * C, 0, 0.04);
    gg_md_ops.destroy(g);
    if (k) continue;
    assert_true(gamma * t < 0.05); /* stresses within 0.1 % of the bath's */
    lab_expect("theta", &theta, Tb, 0, 0.02);
    lab_expect("spin", &spin, -0.5, 0, 0.03);
  }
}

static double interval_of(gg_engine *g)
{
  const gg_md_kick_schedule *t = &((gg_md *)g)->kicks.schedule[0];
  return t->interval * t->n / 2;
}

/* A model with noise of a given strength, or with a Gaussian thermostat of a given rate. */
static gg_model given(gg_thermostat thermostat, double strength)
{
  gg_scene s = lab_scene(GG_HSS, 0.02, 0.8, -1, 500);
  gg_model m;
  gg_error err = {0};
  s.particles = 500;
  s.thermostat = thermostat;
  *(thermostat == GG_GAUSSIAN ? &s.gaussian_rate : &s.noise_strength) = strength;
  if (gg_scene_model_make(&s, GG_MD, &m, &err) != GG_OK) fail_msg("%s", err.message);
  return m;
}

/* A gas that begins colder than its steady state has the kick schedule of one that begins in it, and comes to the
 * temperature of Enskog's equation. */
static void from_cold(gg_model steady)
{
  gg_model cold = steady;
  cold.temperature0 = 1e-6;
  gg_engine *a = engine_of(&steady, 1), *b = engine_of(&cold, 1);
  assert_true(fabs(interval_of(b) / interval_of(a) - 1) < 1e-9);
  advance(b, 150);
  lab_mean T = {0};
  for (int i = 0; i < 24; i++) {
    lab_view v = {0};
    for (int s = 0; s < 4; s++) {
      advance(b, 10);
      gg_md_ops.snapshot(b, false, lab_add_chunk, &v);
    }
    lab_add(&T, lab_temperature(&v));
  }
  gg_theory_answer answer;
  gg_error err;
  assert_int_equal(gg_theory_evaluate(gg_theory_find("enskog_hermite"), &steady, &answer, &err), GG_OK);
  lab_expect("T from cold", &T, answer.value[GG_Q_TEMPERATURE], 2e-3, 0.03);
  gg_md_ops.destroy(a);
  gg_md_ops.destroy(b);
}

static void cold_starts_become_steady(void **state)
{
  (void)state;
  from_cold(bath(GG_HSS, 0.02, 0.8, -1, 0.02, 1, 0, 500));
  from_cold(given(GG_WHITE_NOISE, 0.02));
  from_cold(given(GG_GAUSSIAN, 0.2));
  gg_model sheared = bath(GG_USF, 0.2, 0.9, -1, 0.02, 1e-4, 0, 500);
  sheared.temperature0 = 1e-4;
  gg_engine *c = engine_of(&sheared, 1);
  const double before = interval_of(c);
  advance(c, 100);
  lab_view v = view_of(c);
  const double free_time = 1 / gg_common_model_collision_rate(&sheared, lab_temperature(&v));
  print_message("# interval %.3g, then %.3g; mean free time %.3g\n", before, interval_of(c), free_time);
  assert_true(interval_of(c) < 2.9 * free_time && before > 5 * free_time); /* T is followed by factors of two */
  gg_md_ops.destroy(c);
}

static void against_theory(gg_model m)
{
  gg_theory_answer a;
  gg_error err;
  if (gg_theory_evaluate(gg_theory_find("enskog_hermite"), &m, &a, &err) != GG_OK) fail_msg("%s", err.message);
  m.temperature0 = a.value[GG_Q_TEMPERATURE];
  gg_engine *g = engine_of(&m, 5);
  lab_mean T = {0}, theta = {0};
  const double free_time = 1 / gg_common_model_collision_rate(&m, m.temperature0);
  /* Temperatures are remembered for 1/(2 drag), which under shear is many free times: blocks are longer. */
  const double apart = fmax(1.5 * free_time, 0.4 / m.bath.drag[0]);
  advance(g, 20 * apart);
  for (int i = 0; i < 24; i++) {
    lab_view v = {0};
    for (int s = 0; s < 10; s++) {
      advance(g, apart);
      gg_md_ops.snapshot(g, false, lab_add_chunk, &v);
    }
    lab_add(&T, lab_temperature(&v));
    const double sz = v.s_mean[2] / v.n;
    lab_add(&theta, m.inertia[0] * (v.ss / v.n - sz * sz) / 3);
  }
  const double error = isnan(a.error[GG_Q_TEMPERATURE]) ? 0 : a.error[GG_Q_TEMPERATURE];
  lab_expect("temperature", &T, a.value[GG_Q_TEMPERATURE], error, 0.03);
  if (m.rule == GG_ROUGH)
    lab_expect("theta", &theta, a.value[GG_Q_ROTATIONAL_TEMPERATURE], a.error[GG_Q_ROTATIONAL_TEMPERATURE], 0.03);
  gg_md_ops.destroy(g);
}

static void dilute_gases_follow_enskogs_equation(void **state)
{
  (void)state;
  if (getenv("NIGHTLY")) against_theory(bath(GG_HSS, 0.01, 0.7, -1, 0.03, 1, 0, 2000));
  against_theory(bath(GG_HSS, 0.01, 0.8, 0.1, 0.03, 1, 1, 2000));
  against_theory(bath(GG_USF, 0.01, 0.9, -1, 0.1, 40, 0, 2000));
}

/* In the steady temperature T a slot brings 2 gamma t (T_bath - T), as bath and losses do in an interval t, whatever
 * collisions do to a grain in between (kicks.c); the noise is no more than 1 % above that of the bath. The interval is
 * longer once a gas had time to relax. */
static void slots_bring_what_a_bath_does(void **state)
{
  (void)state;
  static const double phi[] = {0.01, 0.3}, beta[] = {-1, 0.5};
  for (int k = 0; k < 4; k++) {
    gg_model m = bath(GG_HSS, phi[k % 2], 0.9, beta[k / 2], 0.1, 1, 0, 400);
    gg_engine *g = engine_of(&m, 1);
    gg_md *e = (gg_md *)g;
    const double T = gg_common_thermostat_balance(&m, 0), early = interval_of(g), K = m.inertia[0];
    e->k.next_kick = e->k.now;
    while (e->k.kick[0].number < 25 * 200) {
      e->k.now = e->k.next_kick;
      gg_md_kick(e);
    }
    const gg_md_kick_schedule *t = &e->kicks.schedule[0];
    const double interval = interval_of(g), most = phi[k % 2] < 0.1 ? 0.18 : 0.1;
    const double kept = 1 - (1 + m.beta[0]) * K / (2 * (1 + K)), cooling = 0.2 * (1 / T - 1);
    const double u = ((2 - kept * kept) * 2 / 3 * gg_common_model_collision_rate(&m, T) + 0.25 * cooling) * interval;
    const double lags = 1 / u - 1 / expm1(u), takes = 1 - t->keep * t->keep, noise = t->size * t->size / T;
    print_message("# interval %.3g/gamma, early %.3g/gamma, fixed kicks %.3g\n", 0.1 * interval, 0.1 * early,
                  t->chance);
    assert_true(0.1 * interval < most * (1 + 1e-12) && early <= interval * (1 + 1e-12) && 0.1 * early < 0.12000001);
    assert_true(phi[k % 2] > 0.1 || (fabs(0.1 * interval - most) < 1e-12 && fabs(0.1 * early - 0.12) < 1e-12));
    assert_true(fabs((noise - takes) / (1 - takes * lags) / (cooling * interval) - 1) < 1e-6);
    assert_in_range((int)(1e6 * noise * T / takes), 1000000, 1010000);
    gg_md_ops.destroy(g);
  }
}

/* At e = 0.9 and beta = 0.5 a slot brings a quarter of T. With Gaussian kicks alone a2 would be 0.011 larger. */
static void cumulant_is_that_of_enskogs_equation(void **state)
{
  (void)state;
  gg_model m = bath(GG_HSS, 0.01, 0.9, 0.5, 0.0015, 1, 0, 2000);
  gg_theory_answer answer;
  gg_error err;
  if (gg_theory_evaluate(gg_theory_find("enskog_hermite"), &m, &answer, &err) != GG_OK) fail_msg("%s", err.message);
  gg_engine *g = engine_of(&m, 7);
  const double free_time = 1 / gg_common_model_collision_rate(&m, m.temperature0), expected = answer.value[GG_Q_A2];
  lab_mean a2 = {0};
  advance(g, 30 * free_time);
  for (int b = 0; b < 20; b++) {
    lab_view v = {0};
    for (int i = 0; i < 35; i++) {
      advance(g, 1.3 * free_time);
      gg_md_ops.snapshot(g, false, lab_add_chunk, &v);
    }
    const double T = lab_temperature(&v);
    lab_add(&a2, v.c4 / v.n / (15 * T * T) - expected);
  }
  print_message("# interval %.3g mean free times\n", interval_of(g) / free_time);
  lab_expect("1 + a2 - a2 of Enskog", &a2, 1, 0, 0.005);
  gg_md_ops.destroy(g);
}

/* The engine as a checkpoint keeps it. */
static gg_engine *restored(gg_engine *g, const gg_model *m)
{
  gg_archive a = {0};
  gg_error err = {0};
  gg_engine *back = NULL;
  assert_int_equal(gg_md_ops.save(g, &a, &err), GG_OK);
  if (gg_md_ops.restore(m, &a, &back, &err) != GG_OK) fail_msg("%s", err.message);
  gg_base_archive_clear(&a);
  return back;
}

static void continue_alike(gg_engine *g, const gg_model *m)
{
  gg_engine *back = restored(g, m);
  assert_memory_equal(&((gg_md *)g)->kicks.schedule[0].interval, &((gg_md *)back)->kicks.schedule[0].interval,
                      sizeof(double));
  advance(g, 3), advance(back, 3);
  lab_same_archive(g, back);
  gg_md_ops.destroy(back);
}

/* Before, at and after the slot from which intervals are longer; and where a sheared gas happens to be at rest. */
static void checkpoints_keep_the_schedule(void **state)
{
  (void)state;
  const gg_model m = bath(GG_HSS, 0.01, 0.9, -1, 0.1, 1, 0, 401);
  const uint64_t settled = 25 * 401 / 2;
  for (uint64_t number = settled - 1; number <= settled + 1; number++) {
    gg_engine *g = engine_of(&m, 1);
    gg_md *e = (gg_md *)g;
    while (e->k.kick[0].number < number) advance(g, fmax(0.5 * e->kicks.schedule[0].interval, 1e-12));
    assert_true(e->k.kick[0].number == number);
    assert_true(fabs(0.1 * interval_of(g) - (number < settled ? 0.12 : 0.18)) < 1e-12);
    continue_alike(g, &m);
    gg_md_ops.destroy(g);
  }
  gg_model sheared = bath(GG_USF, 0.01, 1, -1, 0.1, 1, 0, 400);
  gg_engine *g = engine_of(&sheared, 1);
  gg_error err;
  advance(g, 5);
  assert_int_equal(gg_md_ops.shear(g, 0, &err), GG_OK);
  sheared.shear_rate = 0;
  continue_alike(g, &sheared);
  gg_md_ops.destroy(g);
}

int main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test(elastic_grains_relax_as_drag_and_noise_do),
                                     cmocka_unit_test(sheared_moments_are_known),
                                     cmocka_unit_test(cold_starts_become_steady),
                                     cmocka_unit_test(dilute_gases_follow_enskogs_equation),
                                     cmocka_unit_test(slots_bring_what_a_bath_does),
                                     cmocka_unit_test(cumulant_is_that_of_enskogs_equation),
                                     cmocka_unit_test(checkpoints_keep_the_schedule)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
