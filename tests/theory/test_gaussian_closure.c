/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The Gaussian closure of uniform shear: steady and found for all scenes, exact in its limits (elastic, dilute, slow
 * shear), and near Monte Carlo solutions. */
#include "theory_test.h"

#include "theory/gaussian_moments.h"
#include "theory/lun1991.h"

static gg_theory_answer closure(double phi, double e, double beta)
{
  gg_model m = model_for(GG_USF, phi, e, beta);
  return answer_of(&gg_theory_gaussian_closure, &m);
}

/* The steady state is steady to 1e-9 and found for all scenes, in fifty milliseconds on average. */
static void is_steady_everywhere(void **state)
{
  (void)state;
  const double phis[] = {0, 0.001, 0.1, 0.6}, es[] = {0.1, 0.7, 0.9999}, betas[] = {-1, -0.999, 0, 1};
  const double masses[] = {1, 0.03, 20};
  for (int i = 0; i < 4 * 3 * 4 * 3; i++) {
    double phi = phis[i % 4], e = es[i / 4 % 3], beta = betas[i / 12 % 4], mass = masses[i / 48];
    gg_model m = mass == 1 ? model_for(GG_USF, phi, e, beta) : mixture_for(GG_USF, phi, e, beta, mass, 1.5, 1);
    gg_gaussian s[2];
    double left = gg_theory_gaussian_steady(&m, s);
    if (!(left < 1e-9)) fail_msg("phi %g e %g beta %g mass %g: residual %g", phi, e, beta, mass, left);
  }
}

static gg_model unlike(double phi, double e, double mass, double diameter)
{
  gg_scene s = scene_of(GG_USF, phi, e, -1);
  s.n_species = 2;
  s.species[0] = (gg_species){0.5, 1, 1, 0.4, 1, 0}, s.species[1] = (gg_species){0.5, diameter, mass, 0.4, 1, 0};
  return model_of(&s);
}

/* As e -> 1 T is proportional to 1/(1-e), and N1 to 1-e, down to the last bit of e: the loss of energy is 10^-16 of
 * the energy that collisions exchange. Also for perfectly rough grains, whose anisotropic spins add to the
 * viscosity. */
static void nearly_elastic(void **state)
{
  (void)state;
  double first[4][2];
  for (int k = 0; k < 5; k++) {
    const double less[] = {1e-7, 1e-9, 1e-10, 1e-12, 1e-15}, e = 1 - less[k];
    gg_model model[] = {unlike(0, e, 100, 2), unlike(0.1, e, 10, 1), model_for(GG_USF, 0, e, 1),
                        model_for(GG_USF, 0.3, e, -1)};
    for (int i = 0; i < 4; i++) {
      gg_theory_answer a = answer_of(&gg_theory_gaussian_closure, &model[i]);
      double T = a.value[GG_Q_TEMPERATURE] * (1 - e), N1 = a.value[GG_Q_N1] / (1 - e);
      if (k == 0) first[i][0] = T, first[i][1] = N1;
      assert_close(T, first[i][0], 1e-5);
      if (k < 4) assert_close(N1, first[i][1], 0.005);
    }
  }
  const double right[] = {0.05346, 2.0316, 0.027515, 0.12580};
  for (int i = 0; i < 4; i++) assert_close(first[i][0], right[i], 2e-4);
}

/* Rough grains as dilute as can be: thermal spins are 1/phi times those of rolling. */
static void dilute_rough_grains(void **state)
{
  (void)state;
  gg_theory_answer zero = closure(0, 0.9, 0.5);
  for (double phi = 1e-7; phi > 1e-19; phi /= 10) {
    double n = 6 * phi / M_PI;
    gg_theory_answer a = closure(phi, 0.9, 0.5);
    assert_close(a.value[GG_Q_TEMPERATURE] * n * n, zero.value[GG_Q_TEMPERATURE], 1e-5);
    assert_close(a.value[GG_Q_TEMPERATURE_RATIO], zero.value[GG_Q_TEMPERATURE_RATIO], 1e-5);
    assert_close(a.value[GG_Q_N1], zero.value[GG_Q_N1], 1e-5);
  }
}

/* A first species that hardly loses energy does not determine the temperature of one that does. */
static void unlike_losses(void **state)
{
  (void)state;
  gg_scene s = scene_of(GG_USF, 0.416624, 0.9999881646604375, 1);
  s.n_species = 2;
  s.species[0] = (gg_species){0.5, 1, 1, 0.4, 1, 0}, s.species[1] = (gg_species){0.5, 0.36, 30, 0.2, 1, 0};
  s.collision.beta[gg_pair(0, 1)] = -0.6, s.collision.beta[gg_pair(1, 1)] = -1;
  gg_model m = model_of(&s);
  gg_gaussian g[2];
  assert_true(gg_theory_gaussian_steady(&m, g) < 1e-9);
}

/* Spins independent of velocities roll, which is the whole mean spin of dense gases; for dilute ones there is no
 * answer. */
static void mean_spin(void **state)
{
  (void)state;
  const double phi[] = {0, 1e-6, 0.009, 0.01, 0.3};
  for (int i = 0; i < 5; i++) {
    gg_model m = model_for(GG_USF, phi[i], 0.7, -0.5);
    double spin = value_of(&gg_theory_gaussian_closure, &m, GG_Q_SPIN_Z),
           lun = value_of(&gg_theory_lun1991, &m, GG_Q_SPIN_Z);
    assert_int_equal(isnan(spin), phi[i] < 0.01);
    assert_int_equal(isnan(lun), phi[i] < 0.01);
    if (phi[i] == 0.01) assert_close(spin, -0.5495, 1e-3);
  }
  gg_model m = model_for(GG_USF, 0, 0.7, -0.5);
  assert_non_null(strstr(gg_common_quantity_missing(&m, GG_Q_SPIN_Z), "infinite in units of the shear rate"));
}

/* Angular momentum: the stress of a steady state is symmetric, with spins or without; no net torque. */
static void stress_is_symmetric(void **state)
{
  (void)state;
  for (double beta = -0.5; beta <= 1; beta += 0.5) {
    gg_theory_answer a = closure(0.3, 0.7, beta);
    assert_close(a.value[GG_Q_P_XY], a.value[GG_Q_P_YX], 1e-9);
    assert_close(a.value[GG_Q_P_XX], a.value[GG_Q_P_XX_KINETIC] + a.value[GG_Q_P_XX_COLLISIONAL], 1e-12);
  }
}

/* Small shear (e -> 1) of smooth grains: Lun's viscosity and pressure, to first order in 1 - e. (Not for rough
 * grains: under shear their spins have a separate stress, which Lun neglects.) */
static void quasi_elastic_is_navier_stokes(void **state)
{
  (void)state;
  for (double phi = 0; phi < 0.6; phi += 0.15) {
    double error[2];
    for (int i = 0; i < 2; i++) {
      gg_model m = model_for(GG_USF, phi, 1 - (i ? 1e-5 : 1e-3), -1);
      gg_theory_answer a = answer_of(&gg_theory_gaussian_closure, &m), b = answer_of(&gg_theory_lun1991, &m);
      double T = a.value[GG_Q_TEMPERATURE] / b.value[GG_Q_TEMPERATURE] - 1;
      double p = a.value[GG_Q_PRESSURE] / b.value[GG_Q_PRESSURE] - 1;
      double mu = a.value[GG_Q_SHEAR_VISCOSITY] / b.value[GG_Q_SHEAR_VISCOSITY] - 1;
      error[i] = fmax(fmax(fabs(T), fabs(p)), fabs(mu));
    }
    assert_true(error[0] < 2e-3 && error[1] < 2e-5);
  }
}

/* phi = 0 is the limit phi -> 0 in units of 1/(n d^2). */
static void boltzmann_is_the_dilute_limit(void **state)
{
  (void)state;
  for (double beta = -1; beta <= 1; beta += 1) {
    double phi = 1e-6, n = 6 * phi / M_PI;
    gg_theory_answer thin = closure(phi, 0.8, beta), zero = closure(0, 0.8, beta);
    assert_close(thin.value[GG_Q_TEMPERATURE] * n * n, zero.value[GG_Q_TEMPERATURE], 1e-4);
    assert_close(thin.value[GG_Q_P_XY] / phi * n * n, zero.value[GG_Q_P_XY], 1e-4);
    assert_close(thin.value[GG_Q_N1], zero.value[GG_Q_N1], 1e-4);
    assert_close(thin.value[GG_Q_COLLISION_RATE], zero.value[GG_Q_COLLISION_RATE], 1e-4);
    if (beta > -1) assert_close(thin.value[GG_Q_TEMPERATURE_RATIO], zero.value[GG_Q_TEMPERATURE_RATIO], 1e-4);
    assert_true(isnan(zero.value[GG_Q_SPIN_Z]));
  }
}

/* Independent Monte Carlo solutions of the Boltzmann and Enskog equations (N = 1e5): within 1 % in T and viscosity for
 * e = 0.9 smooth, 2 % in theta/T (3 % for dilute half-rough grains). */
static void against_enskog_simulations(void **state)
{
  (void)state;
  /* a* = rate/nu_0 = 0.3638 and N1 = 0.2420 at phi = 0, e = 0.9 */
  gg_theory_answer a = closure(0, 0.9, -1);
  double shear = 1 / (3.2 * sqrt(M_PI * a.value[GG_Q_TEMPERATURE]));
  assert_close(shear, 0.3638, 0.006);
  assert_close(a.value[GG_Q_N1], 0.2420, 0.02);
  assert_close(a.value[GG_Q_N2], -0.0193, 0.2);
  assert_close(closure(0.01, 0.9, 0).value[GG_Q_N1], 0.795, 0.01);
  assert_close(closure(0.01, 0.9, 0).value[GG_Q_TEMPERATURE_RATIO], 0.2295, 0.03);
  assert_close(closure(0.3, 0.9, 0).value[GG_Q_TEMPERATURE_RATIO], 0.257, 0.02);
  assert_close(closure(0.5, 0.9, 0).value[GG_Q_TEMPERATURE_RATIO], 0.261, 0.02);
  assert_close(closure(0.01, 0.9, 1).value[GG_Q_TEMPERATURE_RATIO], 1.017, 0.01);
  assert_close(closure(0.3, 0.9, 1).value[GG_Q_TEMPERATURE_RATIO], 1.045, 0.01);
}

/* N2 changes sign at phi = 0.1317 (e = 0.9) and 0.1299 (e = 0.99); simulations of sheared grains: 0.130. */
static void second_normal_stress_difference(void **state)
{
  (void)state;
  const double e[] = {0.9, 0.99}, at[] = {0.1317, 0.1299};
  for (int i = 0; i < 2; i++) {
    assert_true(closure(at[i] - 1e-4, e[i], -1).value[GG_Q_N2] < 0);
    assert_true(closure(at[i] + 1e-4, e[i], -1).value[GG_Q_N2] > 0);
  }
}

/* Dilute mixture, m1/m2 = 4, e = 0.75, equal sizes and numbers: T = 0.853, T1/T2 = 1.601 in units of m2 and of
 * rate/(n2 sigma^2); simulated 0.831 and 1.625. */
static void dilute_mixture(void **state)
{
  (void)state;
  gg_model m = mixture_for(GG_USF, 0, 0.75, -1, 4, 1, 1);
  gg_theory_answer a = answer_of(&gg_theory_gaussian_closure, &m);
  assert_close(a.value[GG_Q_TEMPERATURE] * 4 * 4, 0.853, 6e-4);
  assert_close(a.value[GG_Q_PARTIAL_TEMPERATURE_RATIO], 1.601, 4e-4);
  assert_close(a.value[GG_Q_PARTIAL_TEMPERATURE_RATIO], 1.625, 0.02);
}

/* Exchanging the labels of equal species changes nothing. */
static void equal_species(void **state)
{
  (void)state;
  gg_theory_answer one = closure(0.2, 0.8, 0.2);
  gg_model m = mixture_for(GG_USF, 0.2, 0.8, 0.2, 1, 1, 0.5);
  gg_theory_answer two = answer_of(&gg_theory_gaussian_closure, &m);
  const gg_quantity q[] = {GG_Q_TEMPERATURE, GG_Q_TEMPERATURE_RATIO, GG_Q_PRESSURE, GG_Q_P_XY, GG_Q_N1, GG_Q_SPIN_Z};
  for (size_t i = 0; i < sizeof q / sizeof *q; i++) assert_close(two.value[q[i]], one.value[q[i]], 1e-9);
  assert_close(two.value[GG_Q_PARTIAL_TEMPERATURE_RATIO], 1, 1e-9);
}

static void refuses_politely(void **state)
{
  (void)state;
  gg_model m = model_for(GG_HCS, 0.1, 0.9, -1);
  assert_refused(&gg_theory_gaussian_closure, &m, "this scene is free cooling");
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(is_steady_everywhere),
      cmocka_unit_test(mean_spin),
      cmocka_unit_test(nearly_elastic),
      cmocka_unit_test(dilute_rough_grains),
      cmocka_unit_test(unlike_losses),
      cmocka_unit_test(stress_is_symmetric),
      cmocka_unit_test(quasi_elastic_is_navier_stokes),
      cmocka_unit_test(boltzmann_is_the_dilute_limit),
      cmocka_unit_test(against_enskog_simulations),
      cmocka_unit_test(second_normal_stress_difference),
      cmocka_unit_test(dilute_mixture),
      cmocka_unit_test(equal_species),
      cmocka_unit_test(refuses_politely),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
