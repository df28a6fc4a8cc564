/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Uniform shear: the sign of everything, the balance of energy, and numbers of independent solutions. */
#include "lab.h"

#include "theory/theory.h"
#include "theory/theory_list.h"

/* The solution in units that are `unit` of the engine's. */
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

/* Boltzmann limit, e = 0.9: reduced shear rate and normal stress differences of an independent Monte Carlo solution
 * (linear Grad gives a* .3587, N1 .2423, N2 0); no collisional stress. */
static void dilute(void **state)
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

/* Dense: temperature and stresses of Enskog's equation solved without random numbers; energy closes with the shear
 * between the centres in. A wrong sign of that shear lowers the work of the collisional stress by half. */
static void dense(void **state)
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
  assert_true(lab_value(&f.N2) > 0);                                           /* changed sign at phi = 0.13 */
}

/* Elastic, slowly sheared: Enskog's viscosity (first Sonine order, exact prefactor 1.016 in the kinetic part). */
static void elastic_viscosity(void **state)
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

static void rough(void **state)
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
  const struct CMUnitTest tests[] = {cmocka_unit_test(dilute), cmocka_unit_test(dense),
                                     cmocka_unit_test(elastic_viscosity), cmocka_unit_test(rough)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
