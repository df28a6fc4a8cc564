/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Single precision has the physics of double precision within errors, and rounding does no harm. */
#include "lab.h"

/* Elastic grains keep their energy, momentum and Maxwellian over 100 collisions a grain. Rounding by 6e-8 a collision
 * changes the energy by 6e-8 sqrt(200/N) if it is random, and by 1e-7 a collision if it has a preferred side. */
static void elastic_energy_stays_at_rounding(void **state)
{
  (void)state;
  for (int rough = 0; rough < 2; rough++) {
    gg_scene s = lab_scene(GG_EQUILIBRIUM, 0.2, 1, rough ? 1 : -1, 20000);
    s.dsmc.precision = GG_SINGLE;
    gg_model m = lab_model(&s);
    gg_engine *g = lab_engine(&m, 3);
    lab_view before = lab_snapshot(g);
    lab_advance(g, INFINITY, 50 * (uint64_t)m.n);
    lab_view after = lab_snapshot(g);
    double E0 = 3 * lab_temperature(&before) + m.inertia[0] * before.ss / before.n * rough;
    double E1 = 3 * lab_temperature(&after) + m.inertia[0] * after.ss / after.n * rough;
    printf("# %s: energy changed by %.2e of itself, mean velocity %.1e\n", rough ? "rough" : "smooth", E1 / E0 - 1,
           after.momentum[0] / after.n);
    assert_true(fabs(E1 / E0 - 1) < 1e-5);
    for (int a = 0; a < 3; a++) assert_true(fabs(after.momentum[a] / after.n) < 1e-6);
    gg_dsmc_ops.destroy(g);
  }
}

/* The share of the energy that is gone after 1500 collisions a grain whose loss a thermostat gives back. */
static double gone(double e)
{
  gg_scene s = lab_scene(GG_HSS, 0.1, e, -1, 1000);
  s.thermostat = GG_GAUSSIAN;
  s.dsmc.precision = GG_SINGLE;
  gg_model m = lab_model(&s);
  gg_engine *g = lab_engine(&m, 3);
  lab_view before = lab_snapshot(g);
  lab_advance(g, INFINITY, 750 * (uint64_t)m.n);
  lab_view after = lab_snapshot(g);
  gg_dsmc_ops.destroy(g);
  return 1 - lab_temperature(&after) / lab_temperature(&before);
}

/* The energy that is given back in a step is so little that each velocity would be rounded to its old value. It is
 * given back later, with more; otherwise 2 x 10^-4 of the energy would be lost. (With e one step of single precision
 * below 1, collisions themselves lose energy by rounding.) */
static void little_heat_is_given_back_later(void **state)
{
  (void)state;
  double elastic = gone(1), inelastic = gone(1 - 0x1p-22);
  printf("# little heat: %.2e of the energy gone, %.2e of elastic grains\n", inelastic, elastic);
  assert_true(fabs(inelastic - elastic) < 2e-5);
}

static void agree(const char *what, const lab_mean *a, const lab_mean *b, double sight)
{
  double error = hypot(lab_error(a), lab_error(b)), difference = lab_value(a) - lab_value(b);
  printf("# %-10s double %.6f, single %.6f, difference %+.6f +- %.6f\n", what, lab_value(a), lab_value(b), difference,
         error);
  if (fabs(difference) > 4.5 * error) fail_msg("%s differs", what);
  if (error > sight * fabs(lab_value(a))) fail_msg("%s: an error of %g is too large", what, error);
}

/* Mean a2 of a gas that cools for 10^4 collisions a grain. Its temperature falls by hundreds of decades, rescaled as in
 * a run. The mean velocity that rounding leaves would grow relative to the thermal speed if it were not removed. */
static lab_mean long_cooling_in(gg_precision precision)
{
  gg_scene s = lab_scene(GG_HCS, 0, 0.8, -1, 1000);
  s.dsmc.precision = precision;
  gg_model m = lab_model(&s);
  gg_engine *g = lab_engine(&m, 4 + precision);
  gg_error err = {0};
  double sum = 0;
  lab_mean a2 = {0};
  for (int i = 0; i < 2500; i++) {
    lab_advance(g, INFINITY, 2 * (uint64_t)m.n);
    lab_view v = lab_snapshot(g);
    double T = lab_temperature(&v);
    for (int a = 0; a < 3; a++) assert_true(fabs(v.momentum[a] / v.n) < 1e-6 * sqrt(T));
    sum += (v.c4 / v.n / (15 * T * T) - 1) / 50;
    if (i % 50 == 49) lab_add(&a2, sum), sum = 0;
    while (T < 0.125) {
      assert_int_equal(gg_dsmc_ops.rescale(g, 1, &err), GG_OK);
      T *= 4;
    }
  }
  gg_dsmc_ops.destroy(g);
  return a2;
}

static void long_cooling_is_that_of_double(void **state)
{
  (void)state;
  lab_mean of_double = long_cooling_in(GG_DOUBLE), of_single = long_cooling_in(GG_SINGLE);
  agree("a2", &of_double, &of_single, 0.08); /* a gas that moves would tend to -2/3 */
}

/* Cooling at e = 0.5 has the same a2 and d ln T/ds in both precisions (s: collisions a grain). */
static void cooling_is_that_of_double(void **state)
{
  (void)state;
  lab_mean a2[2] = {{0}}, rate[2] = {{0}};
  for (int p = 0; p < 2; p++)
    for (uint64_t seed = 0; seed < 8; seed++) {
      gg_scene s = lab_scene(GG_HCS, 0, 0.5, -1, 100000);
      s.dsmc.precision = (gg_precision)p;
      gg_model m = lab_model(&s);
      gg_engine *g = lab_engine(&m, seed + 100 * (uint64_t)p);
      lab_advance(g, INFINITY, 3 * (uint64_t)m.n);
      lab_view v = lab_snapshot(g);
      gg_engine_state before, after;
      gg_dsmc_ops.state(g, &before);
      double T = lab_temperature(&v), sum = v.c4 / v.n / (15 * T * T) - 1;
      lab_advance(g, INFINITY, 2 * (uint64_t)m.n);
      v = lab_snapshot(g);
      gg_dsmc_ops.state(g, &after);
      double per_grain = 2 * (double)(after.collisions - before.collisions) / (double)m.n, T1 = lab_temperature(&v);
      lab_add(&rate[p], log(T / T1) / per_grain);
      lab_add(&a2[p], 0.5 * (sum + v.c4 / v.n / (15 * T1 * T1) - 1));
      gg_dsmc_ops.destroy(g);
    }
  agree("a2", &a2[0], &a2[1], 0.1);
  agree("d ln T/ds", &rate[0], &rate[1], 0.002);
}

/* Sheared and heated gases have the same temperatures, stresses, loss and rates: each rule, one species and two. */
static void flows_are_those_of_double(void **state)
{
  (void)state;
  const struct {
    gg_flow flow;
    double beta, mu;
    int species;
  } cases[] = {
      {GG_USF, -1, INFINITY, 1}, {GG_USF, 0.3, INFINITY, 1}, {GG_USF, 0.4, 0.123, 2}, {GG_HSS, -1, INFINITY, 2}};
  for (int k = 0; k < 4; k++) {
    lab_flow f[2] = {{.T = {0}}, {.T = {0}}};
    for (int p = 0; p < 2; p++)
      for (uint64_t seed = 0; seed < 8; seed++) {
        gg_scene s = lab_scene(cases[k].flow, 0.3, 0.8, cases[k].beta, 10000);
        for (int q = 0; q < GG_PAIRS; q++) s.collision.mu[q] = cases[k].mu;
        if (k == 3) s.thermostat = GG_WHITE_NOISE;
        s.n_species = cases[k].species;
        s.species[0].fraction = 0.5;
        s.species[1] = (gg_species){0.5, 0.7, 0.5, 0.3, 1, 0};
        if (s.n_species == 1) s.species[0].fraction = 1;
        s.dsmc.precision = (gg_precision)p;
        gg_model m = lab_model(&s);
        gg_engine *g = lab_engine(&m, seed + 100 * (uint64_t)p);
        lab_average(g, &m, 60, 2, 20, &f[p]);
        gg_dsmc_ops.destroy(g);
      }
    printf("# case %d\n", k);
    agree("T", &f[0].T, &f[1].T, 0.02);
    agree("p", &f[0].p, &f[1].p, 0.02);
    agree("loss", &f[0].loss, &f[1].loss, 0.02);
    agree("rate", &f[0].rate, &f[1].rate, 0.01);
    if (cases[k].flow == GG_USF) agree("P_xy", &f[0].P[0][1], &f[1].P[0][1], 0.02);
    if (cases[k].beta > -1) agree("theta", &f[0].theta, &f[1].theta, 0.02);
    if (cases[k].beta > -1) agree("spin", &f[0].spin_z, &f[1].spin_z, 0.02);
  }
}

/* A cooling mixture of masses 1 and 8 has the same T_1/T_2. */
static void mixtures_are_those_of_double(void **state)
{
  (void)state;
  lab_mean ratio[2] = {{0}};
  for (int p = 0; p < 2; p++)
    for (uint64_t seed = 0; seed < 8; seed++) {
      gg_scene s = lab_scene(GG_HCS, 0.1, 0.7, -1, 20000);
      s.n_species = 2;
      s.species[0] = (gg_species){0.5, 1, 1, 0.4, 1, 0};
      s.species[1] = (gg_species){0.5, 1, 8, 0.4, 1, 0};
      s.dsmc.precision = (gg_precision)p;
      gg_model m = lab_model(&s);
      gg_engine *g = lab_engine(&m, seed + 100 * (uint64_t)p);
      double sum = 0;
      lab_advance(g, INFINITY, 10 * (uint64_t)m.n);
      for (int k = 0; k < 20; k++) {
        lab_advance(g, INFINITY, (uint64_t)m.n / 2);
        lab_view v = lab_snapshot(g);
        sum += v.cc_of[0] / v.n_of[0] / (8 * v.cc_of[1] / v.n_of[1]) / 20;
      }
      lab_add(&ratio[p], sum);
      gg_dsmc_ops.destroy(g);
    }
  agree("T_1/T_2", &ratio[0], &ratio[1], 0.01);
}

/* The plain path computes in double precision with grains stored in single precision. Energy is balanced in a small
 * ensemble, and in a large one with a collision callback; neither is a multiple of eight. */
static void add_normal_speed(void *context, const gg_collision_record *collision)
{
  *(double *)context += gg_dot(collision->k, collision->c12);
}

static void the_plain_path_balances_energy(void **state)
{
  (void)state;
  gg_error err = {0};
  for (int big = 0; big < 2; big++) {
    gg_scene s = lab_scene(GG_HCS, 0.1, 0.8, 0.3, big ? 10001 : 101);
    s.dsmc.precision = GG_SINGLE;
    gg_model m = lab_model(&s);
    gg_engine *g = lab_engine(&m, 5);
    double sum = 0;
    if (big) assert_int_equal(gg_dsmc_ops.set_callback(g, add_normal_speed, &sum, &err), GG_OK);
    lab_view before = lab_snapshot(g);
    lab_advance(g, INFINITY, 2 * (uint64_t)m.n);
    lab_view after = lab_snapshot(g);
    gg_collision_sums t;
    gg_dsmc_ops.take_sums(g, &t);
    double E0 = 3 * lab_temperature(&before) + m.inertia[0] * before.ss / before.n;
    double E1 = 3 * lab_temperature(&after) + m.inertia[0] * after.ss / after.n;
    assert_true(fabs(0.5 * before.n * (E0 - E1) / t.loss[0] - 1) < 1e-5);
    assert_true((sum > 0) == big);
    gg_dsmc_ops.destroy(g);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(elastic_energy_stays_at_rounding), cmocka_unit_test(little_heat_is_given_back_later),
      cmocka_unit_test(long_cooling_is_that_of_double),   cmocka_unit_test(the_plain_path_balances_energy),
      cmocka_unit_test(cooling_is_that_of_double),        cmocka_unit_test(flows_are_those_of_double),
      cmocka_unit_test(mixtures_are_those_of_double)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
