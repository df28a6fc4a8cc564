/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The noise-free solution of Enskog's equation for mixtures of smooth grains: limits of one species, known limits,
 * and errors that cover the true difference. The operator itself: test_hermite_operator. */
#include "theory_test.h"

#include "common/rng.h"
#include "theory/hermite/hermite_mixture.h"
#include "theory/hermite/shear.h"

static bool nightly(void)
{
  return getenv("NIGHTLY") != NULL;
}

/* Three species, of which the first and the last are equal. */
static gg_model three_of(gg_flow flow, double phi, double e)
{
  gg_scene s = scene_of(flow, phi, e, -1);
  s.n_species = 3;
  for (int i = 0; i < 3; i++) s.species[i] = (gg_species){1. / 3, 1, i == 1 ? 4 : 1, 0.4, 1, 0};
  s.dsmc.particles = 300000;
  return model_of(&s);
}

/* Viscosities of two equal species are those of one species. */
static void assert_equal_viscosities(const gg_model *one, const gg_theory_answer *a, const gg_model *two,
                                     const gg_theory_answer *b)
{
  const double unit = gg_common_model_nu0(one, 1) / gg_common_model_nu0(two, 1);
  const gg_quantity q[] = {GG_Q_VISCOSITY_REDUCED, GG_Q_VISCOSITY_REDUCED_KINETIC};
  for (int k = 0; k < 2; k++) assert_close(b->value[q[k]] * unit, a->value[q[k]], 1e-8);
}

/* At rest, three species are two if two of them are equal. */
static void three_resting_species(void **state)
{
  (void)state;
  enum { HALF_DEGREE = 5 };
  const gg_model three = three_of(GG_HCS, 0.1, 0.8), pair = mixture_for(GG_HCS, 0.1, 0.8, -1, 0.25, 1, 2);
  gg_hermite_mixture x = {.drive = gg_theory_heating_of(&three)}, y = {.drive = gg_theory_heating_of(&pair)};
  gg_error err;
  assert_int_equal(gg_hermite_mixture_solve(&x, &three, HALF_DEGREE, &err), GG_OK);
  assert_int_equal(gg_hermite_mixture_solve(&y, &pair, HALF_DEGREE, &err), GG_OK);
  const int same[] = {0, 1, 0};
  for (int i = 0; i < 3; i++) {
    assert_close(x.scale[i], y.scale[same[i]], 1e-7);
    assert_close(gg_hermite_mixture_fourth(&x, i), gg_hermite_mixture_fourth(&y, same[i]), 1e-7);
  }
  if (!nightly()) return; /* viscosities take most of the time of whole answers */
  const gg_theory_answer a = answer_of(&gg_theory_enskog_hermite, &pair),
                         b = answer_of(&gg_theory_enskog_hermite, &three);
  assert_close(b.value[GG_Q_PARTIAL_TEMPERATURE + 2], b.value[GG_Q_PARTIAL_TEMPERATURE], 1e-9);
  assert_close(b.value[GG_Q_PARTIAL_TEMPERATURE_RATIO], a.value[GG_Q_PARTIAL_TEMPERATURE_RATIO], 1e-6);
}

/* At rest: equal species are one; elastic ones are in equilibrium; unlike ones near the first Sonine order. */
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
  assert_equal_viscosities(&one, &a, &two, &b);
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
}

static const gg_quantity flow_of_shear[] = {
    GG_Q_TEMPERATURE, GG_Q_P_XX,        GG_Q_P_YY,           GG_Q_P_XY,           GG_Q_N1,
    GG_Q_N2,          GG_Q_KURTOSIS_CX, GG_Q_COLLISION_RATE, GG_Q_RELAXATION_RATE};
enum { OF_SHEAR = sizeof flow_of_shear / sizeof *flow_of_shear };

/* Second moments of each species at a low degree. */
static void moments_of(const gg_model *m, int degree, double M[][3][3])
{
  gg_hermite_shear h;
  gg_error err;
  assert_int_equal(gg_hermite_shear_begin(&h, m, &err), GG_OK);
  assert_int_equal(gg_hermite_shear_solve(&h, degree, &err), GG_OK);
  for (int i = 0; i < m->n_species; i++) gg_hermite_second_moments(&h.op.basis, &h.state[i], M[i]);
  gg_hermite_shear_end(&h);
}

/* Sheared, three species are two if two of them are equal, at every degree. */
static void three_sheared_species(void **state)
{
  (void)state;
  const gg_model three = three_of(GG_USF, 0.3, 0.9), pair = mixture_for(GG_USF, 0.3, 0.9, -1, 0.25, 1, 2);
  double of_three[3][3][3], of_pair[2][3][3];
  moments_of(&three, 6, of_three);
  moments_of(&pair, 6, of_pair);
  for (int i = 0; i < 3; i++)
    for (int k = 0; k < 9; k++)
      assert_true(fabs(of_three[i][k / 3][k % 3] - of_pair[i % 2][k / 3][k % 3]) < 1e-8 * of_pair[i % 2][1][1]);
  if (!nightly()) return;
  const gg_theory_answer a = answer_of(&gg_theory_enskog_hermite, &pair),
                         b = answer_of(&gg_theory_enskog_hermite, &three);
  assert_close(b.value[GG_Q_PARTIAL_TEMPERATURE + 2], b.value[GG_Q_PARTIAL_TEMPERATURE], 1e-9);
  for (int q = 0; q < OF_SHEAR; q++) assert_close(b.value[flow_of_shear[q]], a.value[flow_of_shear[q]], 1e-8);
  assert_close(b.value[GG_Q_DISSIPATION], -b.value[GG_Q_P_XY], 1e-7);
}

/* Sheared, equal species are one. Daily a dense gas, for which degree 10 is enough. */
static void equal_sheared_species_are_one(void **state)
{
  (void)state;
  const double phi[] = {0.3, 0.2}, e[] = {0.9, 0.8};
  for (int i = 0; i < (nightly() ? 2 : 1); i++) {
    const gg_model one = model_for(GG_USF, phi[i], e[i], -1), two = mixture_for(GG_USF, phi[i], e[i], -1, 1, 1, 2);
    const gg_theory_answer a = answer_of(&gg_theory_enskog_hermite, &one),
                           b = answer_of(&gg_theory_enskog_hermite, &two);
    assert_close(b.value[GG_Q_PARTIAL_TEMPERATURE_RATIO], 1, 1e-9);
    for (int q = 0; q < OF_SHEAR; q++) assert_close(b.value[flow_of_shear[q]], a.value[flow_of_shear[q]], 1e-8);
  }
}

/* Temperature and temperature ratio of degree 12. */
static void of_degree_12(const gg_model *m, double better[2])
{
  double M[2][3][3], T[2];
  moments_of(m, 12, M);
  for (int k = 0; k < 2; k++) T[k] = m->mass[k] * (M[k][0][0] + M[k][1][1] + M[k][2][2]) / 3;
  better[0] = (T[0] + T[1]) / 2, better[1] = T[0] / T[1];
}

/* The stated error covers the difference from degree 12, and is small; heating equals cooling. Nightly degree 12 is
 * computed, and the dilute gas too. */
static void errors_of_mixtures_are_honest(void **state)
{
  (void)state;
  const double phi[] = {0.3, 0}, stored[] = {0.19527854107905, 1.9335692434676};
  for (int i = 0; i < (nightly() ? 2 : 1); i++) {
    gg_model m = mixture_for(GG_USF, phi[i], 0.8, -1, 10, 1.5, 1);
    gg_theory_answer a = answer_of(&gg_theory_enskog_hermite, &m);
    assert_close(a.value[GG_Q_DISSIPATION], -a.value[GG_Q_P_XY], 1e-7);
    const gg_quantity q[] = {GG_Q_TEMPERATURE, GG_Q_PARTIAL_TEMPERATURE_RATIO};
    double better[] = {stored[0], stored[1]};
    if (nightly()) of_degree_12(&m, better);
    for (int k = 0; k < 2; k++) {
      double said = a.value[q[k]], error = a.error[q[k]];
      print_message("# phi %g, %s: %.8g +- %.1g, degree 12: %.12g\n", phi[i], gg_common_quantity_name(q[k]), said,
                    error, better[k]);
      if (!(fabs(said - better[k]) <= error))
        fail_msg("%d %s: %.8g +- %.1g, not %.8g", i, gg_common_quantity_name(q[k]), said, error, better[k]);
      assert_true(error <= 2e-4 * said);
      if (i == 0) assert_close(better[k], stored[k], 1e-9);
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
  s.species[0] = (gg_species){x, 1, 1, 0.4, 1, 0};
  s.species[1] = (gg_species){1 - x, 0.5 + 1.5 * u[5], pow(8, 2 * u[6] - 1), 0.4, 1, 0};
  s.dsmc.particles = 0;
  return model_of(&s);
}

/* Scenes in which the last step of N1 is small by chance: degree 14 is within twice the error, which is not far too
 * large either. In 90 scenes drawn likewise no quantity was off by more than 1.6 errors, half of all by more than
 * 0.2. The other three nightly. */
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
  for (size_t i = 0; i < (nightly() ? sizeof at / sizeof *at : 1); i++) {
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

/* The viscosity of a mixture: for elastic species Erpenbeck's (1989), of higher Sonine orders; near the first order
 * elsewhere. For equal species that of one is tested with cooling and white noise; a Gaussian thermostat nightly. */
static void viscosity_of_mixtures(void **state)
{
  (void)state;
  gg_model unlike = mixture_for(GG_HSS, 0.2, 0.8, -1, 4, 2, 0.5);
  const gg_theory_answer b = answer_of(&gg_theory_enskog_hermite, &unlike);
  assert_close(b.value[GG_Q_VISCOSITY_REDUCED],
               value_of(&gg_theory_garzo_montanero2003, &unlike, GG_Q_VISCOSITY_REDUCED), 0.01);
  assert_true(b.error[GG_Q_VISCOSITY_REDUCED] < 1e-3 * b.value[GG_Q_VISCOSITY_REDUCED]);
  double density = M_SQRT2 / 3;
  gg_model elastic = mixture_for(GG_HSS, M_PI / 6 * density, 1, -1, 10, 1, 1);
  double nu0 = gg_common_model_nu0(&elastic, 1);
  assert_close(value_of(&gg_theory_enskog_hermite, &elastic, GG_Q_VISCOSITY_REDUCED) * density / nu0, 0.29379, 1e-3);
  if (!nightly()) return;
  const gg_model one = model_for(GG_HSS, 0.2, 0.7, -1), two = mixture_for(GG_HSS, 0.2, 0.7, -1, 1, 1, 1);
  const gg_theory_answer of_one = answer_of(&gg_theory_enskog_hermite, &one),
                         of_two = answer_of(&gg_theory_enskog_hermite, &two);
  assert_equal_viscosities(&one, &of_one, &two, &of_two);
}

/* White noise on a mixture: equal species are one, and elastic ones keep one temperature. */
static void mixtures_in_white_noise(void **state)
{
  (void)state;
  gg_scene s = scene_of(GG_HSS, 0.2, 0.6, -1);
  s.thermostat = GG_WHITE_NOISE;
  gg_model one = model_of(&s);
  s.n_species = 2;
  for (int i = 0; i < 2; i++) s.species[i] = (gg_species){0.5, 1, 1, 0.4, 1, 0};
  gg_model two = model_of(&s);
  gg_theory_answer a = answer_of(&gg_theory_enskog_hermite, &one), b = answer_of(&gg_theory_enskog_hermite, &two);
  assert_close(b.value[GG_Q_PARTIAL_TEMPERATURE_RATIO], 1, 1e-9);
  assert_close(b.value[GG_Q_TEMPERATURE], a.value[GG_Q_TEMPERATURE], 1e-7);
  assert_close(b.value[GG_Q_CUMULANT + 1], 2 * a.value[GG_Q_A2], 1e-4);
  assert_close(b.value[GG_Q_PRESSURE], a.value[GG_Q_PRESSURE], 1e-7);
  assert_close(b.value[GG_Q_COOLING_RATE] * gg_common_model_nu0(&two, 1),
               a.value[GG_Q_COOLING_RATE] * gg_common_model_nu0(&one, 1), 1e-6);
  assert_equal_viscosities(&one, &a, &two, &b);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(resting_mixtures),
      cmocka_unit_test(three_resting_species),
      cmocka_unit_test(equal_sheared_species_are_one),
      cmocka_unit_test(three_sheared_species),
      cmocka_unit_test(errors_of_mixtures_are_honest),
      cmocka_unit_test(errors_do_not_vanish_by_chance),
      cmocka_unit_test(viscosity_of_mixtures),
      cmocka_unit_test(mixtures_in_white_noise),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
