/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Uniform shear: signs, the balance of energy, and comparison with independent solutions. */
#include "lab.h"

#include "theory/theory.h"
#include "theory/theory_list.h"

/* Compares with a solution in units that are `unit` of the engine's. */
static void lab_solution(const char *what, const lab_mean *m, const gg_theory_answer *a, gg_quantity q, double unit,
                         double sight)
{
  lab_expect(what, m, a->value[q] / unit, a->error[q] / unit, sight);
}

static void average(const gg_model *m, uint64_t seed, double warmup, int blocks, double length, lab_flow *f)
{
  gg_engine *g = lab_engine(m, seed);
  *f = (lab_flow){0};
  lab_average(g, m, warmup, blocks, length, f);
  gg_dsmc_ops.destroy(g);
}

/* In the Boltzmann limit, at e = 0.9, reduced shear rate and normal stress differences are those of an independent
 * Monte Carlo solution (linear Grad gives a* .3587, N1 .2423, N2 0), and there is no collisional stress. */
static void dilute_shear_is_boltzmanns(void **state)
{
  (void)state;
  gg_scene s = lab_scene(GG_USF, 0, 0.9, -1, 20000);
  gg_model m = lab_model(&s);
  lab_flow f;
  average(&m, 31, 50, 70, 20, &f);
  lab_expect("temperature", &f.T, pow(3.2 * sqrt(M_PI) * 0.3638, -2), 3e-4 * 0.235, 0.02);
  lab_expect("N1", &f.N1, 0.2420, 4e-4, 0.03);
  lab_expect("N2", &f.N2, -0.0193, 4e-4, 0.30);
  lab_expect("energy balance", &f.balance, 1, 0, 0.015);
  assert_true(lab_value(&f.P[0][1]) < 0);
  assert_true(fabs(lab_value(&f.p) / lab_value(&f.T) - 1) < 1e-12);
}

/* A dense gas has the temperature and stresses of the deterministic solution of Enskog's equation. Energy is balanced
 * only if the difference of the flow between the two centres is counted: its wrong sign would halve the work of the
 * collisional stress. */
static void dense_shear_is_enskogs(void **state)
{
  (void)state;
  gg_scene s = lab_scene(GG_USF, 0.3, 0.9, -1, 10000);
  gg_model m = lab_model(&s);
  lab_flow f;
  average(&m, 37, 50, 25, 20, &f);
  gg_theory_answer a;
  assert_int_equal(gg_theory_evaluate(&gg_theory_enskog_hermite, &m, &a, NULL), GG_OK);
  lab_solution("temperature", &f.T, &a, GG_Q_TEMPERATURE, 1, 0.015);
  lab_solution("collision rate", &f.rate, &a, GG_Q_COLLISION_RATE, 1, 0.01);
  lab_solution("P_xy", &f.P[0][1], &a, GG_Q_P_XY, m.stress_unit, 0.015);
  lab_solution("P_xy, kinetic", &f.kinetic[0][1], &a, GG_Q_P_XY_KINETIC, m.stress_unit, 0.015);
  lab_solution("pressure", &f.p, &a, GG_Q_PRESSURE, m.stress_unit, 0.015);
  lab_expect("energy balance", &f.balance, 1, 0, 0.01);
  assert_true(lab_value(&f.P[0][1]) < 0 && lab_value(&f.kinetic[0][1]) < 0);
  assert_true(lab_value(&f.P[0][1]) < 2 * lab_value(&f.kinetic[0][1]));
  assert_true(fabs(lab_value(&f.P[0][1]) / lab_value(&f.P[1][0]) - 1) < 1e-9); /* smooth: symmetric */
  assert_true(lab_value(&f.N2) > 0);                                           /* changes sign at phi = 0.13 */
}

/* Elastic grains in slow shear have Enskog's viscosity (first Sonine order, with an exact kinetic prefactor, 1.016). */
static void elastic_viscosity_is_enskogs(void **state)
{
  (void)state;
  gg_scene s = lab_scene(GG_USF, 0.3, 1, -1, 20000);
  gg_model m = lab_model(&s);
  double chi = m.chi[0], phi = 0.3;
  m.temperature0 = 12;
  lab_mean eta = {0};
  for (uint64_t seed = 1; seed <= 3; seed++) {
    gg_engine *g = lab_engine(&m, seed);
    lab_advance(g, INFINITY, 10 * 10000);
    for (int b = 0; b < 15; b++) {
      lab_flow f = {0};
      lab_average(g, &m, 0, 2, 5, &f);
      lab_add(&eta, lab_value(&f.eta) / sqrt(lab_value(&f.T)) / (5. / 16 / sqrt(M_PI)));
    }
    gg_dsmc_ops.destroy(g);
  }
  double x = 1 + 1.6 * phi * chi;
  lab_expect("eta/eta_0, Enskog", &eta, 1.016 * x * x / chi + 768 / (25 * M_PI) * phi * phi * chi, 0.006, 0.04);
}

static void rough_grains_have_their_temperature_ratio(void **state)
{
  (void)state;
  gg_scene s = lab_scene(GG_USF, 0.01, 0.9, 0, 10000);
  gg_model m = lab_model(&s);
  lab_flow f;
  average(&m, 41, 50, 15, 20, &f);
  printf("# theta/T %.4f at phi .01\n", lab_value(&f.theta) / lab_value(&f.T));
  assert_true(fabs(lab_value(&f.theta) / lab_value(&f.T) / 0.2295 - 1) < 0.01);
  lab_expect("N1, phi .01", &f.N1, 0.795, 0.003, 0.05);
  s.phi = 0.3;
  m = lab_model(&s);
  average(&m, 43, 50, 15, 20, &f);
  printf("# theta/T %.4f at phi .3\n", lab_value(&f.theta) / lab_value(&f.T));
  assert_true(fabs(lab_value(&f.theta) / lab_value(&f.T) / 0.257 - 1) < 0.01);
  lab_expect("energy balance", &f.balance, 1, 0, 0.02);
  assert_true(lab_value(&f.spin_z) < -0.4 && lab_value(&f.spin_z) > -0.6);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(dilute_shear_is_boltzmanns), cmocka_unit_test(dense_shear_is_enskogs),
      cmocka_unit_test(elastic_viscosity_is_enskogs), cmocka_unit_test(rough_grains_have_their_temperature_ratio)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
