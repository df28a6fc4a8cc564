/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The Gaussian closure to second order in the shear rate, in closed form, against the closure itself: collision
 * integrals by quadrature, and no expansion. */
#include "theory_test.h"

static const gg_quantity parts[] = {GG_Q_TEMPERATURE,     GG_Q_PRESSURE,     GG_Q_P_XY,
                                    GG_Q_COLLISION_RATE,  GG_Q_P_XY_KINETIC, GG_Q_P_XY_COLLISIONAL,
                                    GG_Q_P_XX_COLLISIONAL};

static double deviation_of(const gg_model *m, gg_quantity q)
{
  return value_of(&gg_theory_saha_alam2016, m, q) / value_of(&gg_theory_gaussian_closure, m, q) - 1;
}

/* Near e = 1 the deviation is of the order R^2, hence proportional to 1 - e. */
static void it_tends_to_the_closure(void **state)
{
  (void)state;
  for (double phi = 0; phi < 0.6; phi += 0.15) {
    const gg_model one = model_for(GG_USF, phi, 0.999, -1), two = model_for(GG_USF, phi, 0.998, -1);
    for (int i = 0; i < (phi > 0 ? 7 : 5); i++) {
      const double off = deviation_of(&one, parts[i]);
      assert_true(fabs(off) < 2e-3);
      assert_true(fabs(deviation_of(&two, parts[i]) - 2 * off) < 4e-5);
    }
  }
}

/* Second order itself: differences of normal stresses, of the order 1 - e, have the closure's leading coefficients, in
 * the kinetic and in the collisional part. */
static void normal_stresses_have_the_leading_coefficients(void **state)
{
  (void)state;
  const double e = 0.9995;
  for (double phi = 0; phi < 0.6; phi += 0.15) {
    const gg_model m = model_for(GG_USF, phi, e, -1);
    const gg_theory_answer a = answer_of(&gg_theory_saha_alam2016, &m), b = answer_of(&gg_theory_gaussian_closure, &m);
    const double p = b.value[GG_Q_PRESSURE] * (1 - e);
    assert_close((a.value[GG_Q_N1] - b.value[GG_Q_N1]) / (1 - e), 0, 3e-3);
    assert_close((a.value[GG_Q_N2] - b.value[GG_Q_N2]) / (1 - e), 0, 3e-3);
    const double plane = a.value[GG_Q_P_XX_KINETIC] - a.value[GG_Q_P_ZZ_KINETIC] - b.value[GG_Q_P_XX_KINETIC] +
                         b.value[GG_Q_P_ZZ_KINETIC];
    assert_close(plane / p, 0, 3e-3);
    if (phi == 0) continue;
    assert_close((a.value[GG_Q_P_XX_COLLISIONAL] - a.value[GG_Q_P_ZZ_COLLISIONAL] - b.value[GG_Q_P_XX_COLLISIONAL] +
                  b.value[GG_Q_P_ZZ_COLLISIONAL]) /
                     p,
                 0, 3e-3);
  }
}

/* Dilute grains: N2 = -N1/14. N2 changes its sign where the closure's does near e = 1, at phi = 0.13. */
static void the_second_difference(void **state)
{
  (void)state;
  const gg_model dilute = model_for(GG_USF, 0, 0.97, -1), less = model_for(GG_USF, 0.128, 0.99, -1),
                 more = model_for(GG_USF, 0.132, 0.99, -1);
  const gg_theory_answer a = answer_of(&gg_theory_saha_alam2016, &dilute);
  assert_close(a.value[GG_Q_N2], -a.value[GG_Q_N1] / 14, 1e-13);
  assert_true(value_of(&gg_theory_saha_alam2016, &less, GG_Q_N2) < 0);
  assert_true(value_of(&gg_theory_saha_alam2016, &more, GG_Q_N2) > 0);
}

/* Work of the stress against the flow, to the order of the expansion, is the loss: 16 sqrt(pi) N h (1-h) of T^3/2 at
 * leading order. Rough and elastic grains are rejected. */
static void its_range(void **state)
{
  (void)state;
  const gg_model m = model_for(GG_USF, 0.2, 0.9999, -1), rough = model_for(GG_USF, 0.2, 0.9, 0),
                 elastic = model_for(GG_USF, 0.2, 1, -1), lossy = model_for(GG_USF, 0.2, 0.7, -1);
  const gg_theory_answer a = answer_of(&gg_theory_saha_alam2016, &m);
  const double h = 0.99995, N = m.density * m.chi[0];
  assert_close(a.value[GG_Q_DISSIPATION] / (m.stress_unit * m.density * pow(a.value[GG_Q_TEMPERATURE], 1.5)),
               8 * sqrt(M_PI) * N * h * (1 - h), 1e-3);
  assert_refused(&gg_theory_saha_alam2016, &rough, "smooth");
  assert_refused(&gg_theory_saha_alam2016, &elastic, "heats up");
  assert_null(gg_theory_beyond(&gg_theory_saha_alam2016, &m));
  assert_non_null(gg_theory_beyond(&gg_theory_saha_alam2016, &lossy));
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(it_tends_to_the_closure),
      cmocka_unit_test(normal_stresses_have_the_leading_coefficients),
      cmocka_unit_test(the_second_difference),
      cmocka_unit_test(its_range),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
