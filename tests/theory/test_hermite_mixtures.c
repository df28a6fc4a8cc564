/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The noise-free solution of Enskog's equation for mixtures of smooth grains: limits of one species, known limits,
 * and errors that cover the true difference. The operator itself: test_hermite_operator. */
#include "theory_test.h"

#include "common/rng.h"
#include "theory/hermite/shear.h"

/* At rest: equal species are one; elastic ones are in equilibrium; unlike ones near the first Sonine order; the
 * largest number of species. */
static void resting_mixtures(void **state)
{
  (void)state;
  gg_model one = model_for(GG_HCS, 0.2, 0.6, -1), two = mixture_for(GG_HCS, 0.2, 0.6, -1, 1, 1, 2);
  gg_theory_answer a = answer_of(&gg_theory_enskog_hermite, &one), b = answer_of(&gg_theory_enskog_hermite, &two);
  assert_close(b.value[GG_Q_PARTIAL_TEMPERATURE_RATIO], 1, 1e-9);
  assert_close(b.value[GG_Q_CUMULANT + 1], 2 * a.value[GG_Q_A2], 2e-3);
  assert_close(b.value[GG_Q_PRESSURE], a.value[GG_Q_PRESSURE], 1e-9);
  assert_close(b.value[GG_Q_COLLISION_RATE], a.value[GG_Q_COLLISION_RATE], 1e-6);
  assert_close(b.value[GG_Q_COOLING_RATE] * gg_common_model_nu0(&two, 1),
               a.value[GG_Q_COOLING_RATE] * gg_common_model_nu0(&one, 1), 1e-5);
  gg_model elastic = mixture_for(GG_HSS, 0.3, 1, -1, 10, 2, 1);
  b = answer_of(&gg_theory_enskog_hermite, &elastic);
  assert_close(b.value[GG_Q_PARTIAL_TEMPERATURE_RATIO], 1, 1e-9);
  assert_close(b.value[GG_Q_CUMULANT], 0, 1e-8);
  assert_close(b.value[GG_Q_COOLING_RATE], 0, 1e-10);
  assert_close(b.value[GG_Q_PRESSURE], value_of(&gg_theory_garzo_montanero2003, &elastic, GG_Q_PRESSURE), 1e-9);
  gg_model unlike = mixture_for(GG_HCS, 0, 0.5, -1, 10, 1, 2);
  b = answer_of(&gg_theory_enskog_hermite, &unlike);
  assert_close(b.value[GG_Q_PARTIAL_TEMPERATURE_RATIO], 3.79752, 1e-5);
  assert_close(b.value[GG_Q_PARTIAL_TEMPERATURE_RATIO],
               value_of(&gg_theory_garzo_montanero2003, &unlike, GG_Q_PARTIAL_TEMPERATURE_RATIO), 2e-3);
  assert_true(b.error[GG_Q_PARTIAL_TEMPERATURE_RATIO] < 1e-4);
  gg_scene s = scene_of(GG_HCS, 0.1, 0.8, -1);
  s.n_species = 3;
  for (int i = 0; i < 3; i++) s.species[i] = (gg_species){1. / 3, 1, i == 1 ? 4 : 1, 0.4, 1};
  s.dsmc.particles = 300000;
  gg_model three = model_of(&s), pair = mixture_for(GG_HCS, 0.1, 0.8, -1, 0.25, 1, 2);
  b = answer_of(&gg_theory_enskog_hermite, &three), a = answer_of(&gg_theory_enskog_hermite, &pair);
  assert_close(b.value[GG_Q_PARTIAL_TEMPERATURE + 2], b.value[GG_Q_PARTIAL_TEMPERATURE], 1e-9);
  assert_close(b.value[GG_Q_PARTIAL_TEMPERATURE_RATIO], a.value[GG_Q_PARTIAL_TEMPERATURE_RATIO], 1e-6);
}

static const gg_quantity flow_of_shear[] = {
    GG_Q_TEMPERATURE, GG_Q_P_XX,        GG_Q_P_YY,           GG_Q_P_XY,           GG_Q_N1,
    GG_Q_N2,          GG_Q_KURTOSIS_CX, GG_Q_COLLISION_RATE, GG_Q_RELAXATION_RATE};
enum { OF_SHEAR = sizeof flow_of_shear / sizeof *flow_of_shear };

/* Sheared mixtures: equal species are one; three are two if two of them are equal; heating equals cooling. */
static void sheared_mixtures(void **state)
{
  (void)state;
  gg_model one = model_for(GG_USF, 0.2, 0.8, -1), two = mixture_for(GG_USF, 0.2, 0.8, -1, 1, 1, 2);
  gg_theory_answer a = answer_of(&gg_theory_enskog_hermite, &one), b = answer_of(&gg_theory_enskog_hermite, &two);
  assert_close(b.value[GG_Q_PARTIAL_TEMPERATURE_RATIO], 1, 1e-9);
  for (int q = 0; q < OF_SHEAR; q++) assert_close(b.value[flow_of_shear[q]], a.value[flow_of_shear[q]], 1e-8);
  gg_scene s = scene_of(GG_USF, 0.3, 0.9, -1);
  s.n_species = 3;
  for (int i = 0; i < 3; i++) s.species[i] = (gg_species){1. / 3, 1, i == 1 ? 4 : 1, 0.4, 1};
  s.dsmc.particles = 300000;
  gg_model three = model_of(&s), pair = mixture_for(GG_USF, 0.3, 0.9, -1, 0.25, 1, 2);
  a = answer_of(&gg_theory_enskog_hermite, &pair), b = answer_of(&gg_theory_enskog_hermite, &three);
  assert_close(b.value[GG_Q_PARTIAL_TEMPERATURE + 2], b.value[GG_Q_PARTIAL_TEMPERATURE], 1e-9);
  for (int q = 0; q < OF_SHEAR; q++) assert_close(b.value[flow_of_shear[q]], a.value[flow_of_shear[q]], 1e-8);
  assert_close(b.value[GG_Q_DISSIPATION], -b.value[GG_Q_P_XY], 1e-7);
}

/* The stated error covers the difference from a higher degree, and is small; the dilute gas nightly. */
static void errors_of_mixtures_are_honest(void **state)
{
  (void)state;
  const double phi[] = {0.3, 0}, e[] = {0.8, 0.8}, most[] = {2e-4, 2e-4};
  for (int i = 0; i < (getenv("NIGHTLY") ? 2 : 1); i++) {
    gg_model m = mixture_for(GG_USF, phi[i], e[i], -1, 10, 1.5, 1);
    gg_theory_answer a = answer_of(&gg_theory_enskog_hermite, &m);
    gg_hermite_shear h;
    gg_error err;
    double M[3][3], T[2];
    assert_int_equal(gg_hermite_shear_begin(&h, &m, &err), GG_OK);
    assert_int_equal(gg_hermite_shear_solve(&h, 12, &err), GG_OK);
    for (int k = 0; k < 2; k++) {
      gg_hermite_second_moments(&h.op.basis, &h.state[k], M);
      T[k] = m.mass[k] * (M[0][0] + M[1][1] + M[2][2]) / 3;
    }
    gg_hermite_shear_end(&h);
    const gg_quantity q[] = {GG_Q_TEMPERATURE, GG_Q_PARTIAL_TEMPERATURE_RATIO};
    const double better[] = {(T[0] + T[1]) / 2, T[0] / T[1]};
    for (int k = 0; k < 2; k++) {
      double said = a.value[q[k]], error = a.error[q[k]];
      if (!(fabs(said - better[k]) <= error))
        fail_msg("%d %s: %.8g +- %.1g, not %.8g", i, gg_common_quantity_name(q[k]), said, error, better[k]);
      assert_true(error <= most[i] * said);
    }
  }
}

/* Two species drawn at random. */
static gg_model drawn(int k)
{
  gg_rng r = gg_common_rng_seed(4242, (uint64_t)k);
  double u[7];
  for (int i = 0; i < 7; i++) u[i] = gg_rng_uniform(&r);
  gg_scene s = scene_of(GG_USF, k % 4 == 0 ? 0 : 0.1 * u[0], 0.9, -1);
  s.n_species = 2;
  for (int q = 0; q < 3; q++) s.collision.e[q] = 0.2 + 0.7 * u[1 + q];
  double x = 0.1 + 0.8 * u[4];
  s.species[0] = (gg_species){x, 1, 1, 0.4, 1};
  s.species[1] = (gg_species){1 - x, 0.5 + 1.5 * u[5], pow(8, 2 * u[6] - 1), 0.4, 1};
  s.dsmc.particles = 0;
  return model_of(&s);
}

/* Scenes in which the last step of N1 is small by chance: degree 14 is within twice the error, which is not far too
 * large either. In 90 scenes drawn likewise no quantity was off by more than 1.6 errors, half of all by more than
 * 0.2. The other two nightly. */
static void errors_do_not_vanish_by_chance(void **state)
{
  (void)state;
  static const struct {
    int drawn;
    double N1, kurtosis_x, kurtosis_y; /* degree 14 */
  } at[] = {{4, 1.32792721759, 3.85378562518, 4.75005066182},
            {42, 0.914444403596, 3.54484049992, 3.5981280545},
            {38, 0.613806541056, 3.68033356207, 3.59682670098},
            {35, 1.00449861098, 3.62615692589, 4.13185751157}};
  for (size_t i = 0; i < (getenv("NIGHTLY") ? sizeof at / sizeof *at : 2); i++) {
    gg_model m = drawn(at[i].drawn);
    gg_theory_answer a = answer_of(&gg_theory_enskog_hermite, &m);
    const gg_quantity q[] = {GG_Q_N1, GG_Q_KURTOSIS_CX, GG_Q_KURTOSIS_CY};
    const double better[] = {at[i].N1, at[i].kurtosis_x, at[i].kurtosis_y};
    for (int k = 0; k < 3; k++) {
      double off = fabs(a.value[q[k]] - better[k]) / a.error[q[k]];
      print_message("# scene %d, %s: %.8g +- %.1g, %.2f errors off\n", at[i].drawn, gg_common_quantity_name(q[k]),
                    a.value[q[k]], a.error[q[k]], off);
      assert_true(off < 2);
      assert_true(a.error[q[k]] < 0.01 * better[k]);
    }
    assert_true(fabs(a.value[q[1]] - better[1]) > 0.05 * a.error[q[1]]);
  }
}

/* The viscosity of a mixture: for equal species that of one; for elastic ones Erpenbeck's (1989), of higher Sonine
 * orders; near the first order elsewhere. */
static void viscosity_of_mixtures(void **state)
{
  (void)state;
  const gg_flow flow[] = {GG_HCS, GG_HSS};
  for (int k = 0; k < 2; k++) {
    gg_model one = model_for(flow[k], 0.2, 0.7, -1), two = mixture_for(flow[k], 0.2, 0.7, -1, 1, 1, 1);
    gg_theory_answer a = answer_of(&gg_theory_enskog_hermite, &one), b = answer_of(&gg_theory_enskog_hermite, &two);
    double unit = gg_common_model_nu0(&one, 1) / gg_common_model_nu0(&two, 1);
    assert_close(b.value[GG_Q_VISCOSITY_REDUCED] * unit, a.value[GG_Q_VISCOSITY_REDUCED], 1e-8);
    assert_close(b.value[GG_Q_VISCOSITY_REDUCED_KINETIC] * unit, a.value[GG_Q_VISCOSITY_REDUCED_KINETIC], 1e-8);
    if (k == 0) continue;
    gg_model unlike = mixture_for(flow[k], 0.2, 0.8, -1, 4, 2, 0.5);
    b = answer_of(&gg_theory_enskog_hermite, &unlike);
    assert_close(b.value[GG_Q_VISCOSITY_REDUCED],
                 value_of(&gg_theory_garzo_montanero2003, &unlike, GG_Q_VISCOSITY_REDUCED), 0.01);
    assert_true(b.error[GG_Q_VISCOSITY_REDUCED] < 1e-3 * b.value[GG_Q_VISCOSITY_REDUCED]);
  }
  double density = M_SQRT2 / 3;
  gg_model elastic = mixture_for(GG_HSS, M_PI / 6 * density, 1, -1, 10, 1, 1);
  double nu0 = gg_common_model_nu0(&elastic, 1);
  assert_close(value_of(&gg_theory_enskog_hermite, &elastic, GG_Q_VISCOSITY_REDUCED) * density / nu0, 0.29379, 1e-3);
}

/* White noise on a mixture: equal species are one, and elastic ones keep one temperature. */
static void mixtures_in_white_noise(void **state)
{
  (void)state;
  gg_scene s = scene_of(GG_HSS, 0.2, 0.6, -1);
  s.thermostat = GG_WHITE_NOISE;
  gg_model one = model_of(&s);
  s.n_species = 2;
  for (int i = 0; i < 2; i++) s.species[i] = (gg_species){0.5, 1, 1, 0.4, 1};
  gg_model two = model_of(&s);
  gg_theory_answer a = answer_of(&gg_theory_enskog_hermite, &one), b = answer_of(&gg_theory_enskog_hermite, &two);
  assert_close(b.value[GG_Q_PARTIAL_TEMPERATURE_RATIO], 1, 1e-9);
  assert_close(b.value[GG_Q_TEMPERATURE], a.value[GG_Q_TEMPERATURE], 1e-7);
  assert_close(b.value[GG_Q_CUMULANT + 1], 2 * a.value[GG_Q_A2], 1e-4);
  assert_close(b.value[GG_Q_PRESSURE], a.value[GG_Q_PRESSURE], 1e-7);
  assert_close(b.value[GG_Q_COOLING_RATE] * gg_common_model_nu0(&two, 1),
               a.value[GG_Q_COOLING_RATE] * gg_common_model_nu0(&one, 1), 1e-6);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(resting_mixtures),
      cmocka_unit_test(sheared_mixtures),
      cmocka_unit_test(errors_of_mixtures_are_honest),
      cmocka_unit_test(errors_do_not_vanish_by_chance),
      cmocka_unit_test(viscosity_of_mixtures),
      cmocka_unit_test(mixtures_in_white_noise),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
