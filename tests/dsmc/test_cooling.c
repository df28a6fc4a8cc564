/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Free cooling: fourth cumulant and cooling rate of smooth grains, and the temperature ratio of rough ones. */
#include "lab.h"

typedef struct cooling {
  lab_mean a2, zeta, ratio;
} cooling;

/* Averages over `blocks` blocks of 20 collisions a grain, in scaled time. */
static void cool(const gg_model *m, uint64_t seed, int blocks, cooling *c)
{
  gg_engine *g = lab_engine(m, seed);
  gg_error err = {0};
  for (int b = -3; b < blocks; b++) {
    double a2 = 0, zeta = 0, ratio = 0;
    const int samples = 20;
    for (int i = 0; i < samples; i++) {
      gg_collision_sums t;
      lab_view v = lab_snapshot(g);
      double T0 = lab_temperature(&v);
      gg_dsmc_ops.take_sums(g, &t);
      double time = lab_advance(g, INFINITY, (uint64_t)m->n / 2);
      gg_dsmc_ops.take_sums(g, &t);
      v = lab_snapshot(g);
      double T = lab_temperature(&v), fell = T0 / T;
      a2 += (v.c4 / v.n / (15 * T * T) - 1) / samples;
      ratio += m->inertia[0] * v.ss / v.n / 3 / T / samples;
      /* dT/dt = -zeta T with zeta ~ sqrt(T): 1/sqrt(T) grows linearly. */
      zeta += 2 * (sqrt(fell) - 1) / (time * gg_common_model_nu0(m, T0)) / samples;
      if (T < 0x1p-20) assert_int_equal(gg_dsmc_ops.rescale(g, 10, &err), GG_OK);
    }
    if (b < 0) continue;
    lab_add(&c->a2, a2);
    lab_add(&c->zeta, zeta);
    lab_add(&c->ratio, ratio);
  }
  gg_dsmc_ops.destroy(g);
}

static void smooth_grains_have_their_cumulant_and_rate(void **state)
{
  (void)state;
  const double e[] = {0.8, 0.5}, a2[] = {-0.0145, 0.0474};
  for (int i = 0; i < 2; i++) {
    gg_scene s = lab_scene(GG_HCS, i ? 0.3 : 0, e[i], -1, 20000);
    gg_model m = lab_model(&s);
    cooling c = {0};
    cool(&m, 19, 40, &c);
    lab_expect("a2", &c.a2, a2[i], 3e-4, 0.25);
    /* Garzo & Dufty, PRE 59 (1999) 5895, with the cumulant measured. */
    lab_expect("zeta*", &c.zeta, 5. / 12 * m.chi[0] * (1 - e[i] * e[i]) * (1 + 3. / 16 * lab_value(&c.a2)), 0, 0.01);
  }
}

static void rough_grains_have_their_temperature_ratio(void **state)
{
  (void)state;
  gg_scene s = lab_scene(GG_HCS, 0.1, 0.9, 0, 20000);
  gg_model m = lab_model(&s);
  cooling c = {0};
  cool(&m, 23, 12, &c);
  lab_expect("theta/T at e .9, beta 0", &c.ratio, 0.5455, 5e-4, 0.02);
}

/* Friction too strong to slide is roughness, bit for bit; with a small mu spins gain less, and more energy is left. */
static void strong_friction_is_roughness(void **state)
{
  (void)state;
  gg_scene s = lab_scene(GG_HCS, 0.1, 0.9, 0, 2000);
  gg_model rough = lab_model(&s);
  s.collision.mu[0] = 1e12;
  gg_model sticking = lab_model(&s);
  s.collision.mu[0] = 0.05;
  gg_model sliding = lab_model(&s);
  sliding.ratio0 = sticking.ratio0 = rough.ratio0;
  assert_int_equal(sticking.rule, GG_FRICTIONAL);
  gg_engine *a = lab_engine(&rough, 29), *b = lab_engine(&sticking, 29), *c = lab_engine(&sliding, 29);
  lab_advance(a, INFINITY, 20000);
  lab_advance(b, INFINITY, 20000);
  lab_advance(c, INFINITY, 20000);
  lab_view va = lab_snapshot(a), vb = lab_snapshot(b), vc = lab_snapshot(c);
  assert_memory_equal(&va, &vb, sizeof va);
  assert_true(lab_temperature(&vc) > 1.05 * lab_temperature(&va));
  gg_dsmc_ops.destroy(a);
  gg_dsmc_ops.destroy(b);
  gg_dsmc_ops.destroy(c);
}

/* Ten thousand collisions a grain. The motion of the centre of mass stays at rounding, though rounding feeds it and
 * cooling would let it grow as exp(zeta t/2) relative to the thermal speed. The second half of the run has the fourth
 * cumulant of the first. */
static void long_cooling_keeps_the_centre_at_rest(void **state)
{
  (void)state;
  gg_scene s = lab_scene(GG_HCS, 0, 0.9, -1, 4000);
  gg_model m = lab_model(&s);
  gg_engine *g = lab_engine(&m, 77);
  gg_error err = {0};
  lab_mean half[2] = {{0}, {0}};
  double drift = 0;
  gg_engine_state st;
  lab_advance(g, INFINITY, 20 * (uint64_t)m.n);
  for (int b = 0; b < 100; b++) {
    double a2 = 0;
    for (int i = 0; i < 50; i++) {
      lab_advance(g, INFINITY, (uint64_t)m.n);
      lab_view v = lab_snapshot(g);
      double T = lab_temperature(&v);
      a2 += (v.c4 / v.n / (15 * T * T) - 1) / 50;
      for (int a = 0; a < 3; a++) drift = fmax(drift, fabs(v.momentum[a]) / v.n / sqrt(T));
      if (T < 0x1p-20) assert_int_equal(gg_dsmc_ops.rescale(g, 10, &err), GG_OK);
    }
    lab_add(&half[b / 50], a2);
  }
  gg_dsmc_ops.state(g, &st);
  assert_true(2 * (double)st.collisions / (double)m.n > 1e4);
  printf("# mean velocity over thermal speed: at most %.1e\n", drift);
  assert_true(drift < 1e-14);
  lab_expect("a2, second half of 10^4", &half[1], lab_value(&half[0]), lab_error(&half[0]), 0.3);
  gg_dsmc_ops.destroy(g);
}

int main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test(strong_friction_is_roughness),
                                     cmocka_unit_test(long_cooling_keeps_the_centre_at_rest),
                                     cmocka_unit_test(smooth_grains_have_their_cumulant_and_rate),
                                     cmocka_unit_test(rough_grains_have_their_temperature_ratio)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
