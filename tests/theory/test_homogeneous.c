/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Cooling and heated states of smooth grains, one species and mixtures, and dilute shear of both by Grad's method. */
#include "theory_test.h"

#include "theory/garzo_dufty1999.h"
#include "theory/garzo_montanero2003.h"

static double value_at(const gg_theory *t, gg_flow flow, gg_thermostat thermostat, double phi, double e, gg_quantity q)
{
  gg_scene s = scene_of(flow, phi, e, -1);
  s.thermostat = thermostat;
  gg_model m = model_of(&s);
  return value_of(t, &m, q);
}

/* Elastic: Enskog's viscosity, pressure, no cooling, in every flow. */
static void elastic_is_enskog(void **state)
{
  (void)state;
  for (double phi = 0; phi < 0.6; phi += 0.1)
    for (int flow = GG_HCS; flow <= GG_HSS; flow++)
      for (int thermostat = 0; thermostat <= GG_WHITE_NOISE; thermostat++) {
        double eta = value_at(&gg_theory_enskog, GG_EQUILIBRIUM, 0, phi, 1, GG_Q_VISCOSITY_REDUCED);
        double p = value_at(&gg_theory_enskog, GG_EQUILIBRIUM, 0, phi, 1, GG_Q_PRESSURE);
        gg_flow f = (gg_flow)flow;
        gg_thermostat t = (gg_thermostat)thermostat;
        assert_close(value_at(&gg_theory_garzo_dufty1999, f, t, phi, 1, GG_Q_VISCOSITY_REDUCED), eta, 1e-13);
        assert_close(value_at(&gg_theory_garzo_dufty1999, f, t, phi, 1, GG_Q_PRESSURE), p, 1e-13);
        assert_close(value_at(&gg_theory_garzo_dufty1999, f, t, phi, 1, GG_Q_COOLING_RATE), 0, 0);
        assert_close(value_at(&gg_theory_garzo_dufty1999, f, t, phi, 1, GG_Q_A2), 0, 0);
      }
}

/* Monte Carlo solutions: heated state e = 0.8, phi = 0.3: eta/eta_0 = 3.700, kinetic 0.8417; free cooling e = 0.7,
 * phi = 0: eta = 0.202(4) against 0.2024, and 0.2305 for the heated state; collision rate at e = 0.4. */
static void one_species_numbers(void **state)
{
  (void)state;
  double eta0 = 5 / (16 * sqrt(M_PI)); /* at T = 1 */
  assert_close(value_at(&gg_theory_garzo_dufty1999, GG_HSS, GG_GAUSSIAN, 0.3, 0.8, GG_Q_VISCOSITY_REDUCED), 3.703,
               1e-4);
  assert_close(value_at(&gg_theory_garzo_dufty1999, GG_HSS, GG_GAUSSIAN, 0.3, 0.8, GG_Q_VISCOSITY_REDUCED_KINETIC),
               0.8396, 1e-4);
  assert_close(eta0 * value_at(&gg_theory_garzo_dufty1999, GG_HCS, 0, 0, 0.7, GG_Q_VISCOSITY_REDUCED), 0.2024, 3e-4);
  assert_close(eta0 * value_at(&gg_theory_garzo_dufty1999, GG_HSS, GG_GAUSSIAN, 0, 0.7, GG_Q_VISCOSITY_REDUCED), 0.2305,
               3e-4);
  assert_close(2 * gg_theory_a2_van_noije_ernst(0.4), 0.1694, 3e-4);
  assert_close(2 * gg_theory_a2_montanero_santos(0.4), 0.1562, 3e-4);
  /* a2 in free cooling, simulated -0.0145(3) and 0.0474(3): Sonine formulas are off by up to 0.003. */
  assert_true(fabs(gg_theory_a2_montanero_santos(0.8) + 0.0145) < 0.003 &&
              fabs(gg_theory_a2_montanero_santos(0.5) - 0.0474) < 0.003);
  /* Simulated collision rate 0.35156 in units in which the Maxwellian has 0.35276: ratio 1 - a2/16 with a2 = 0.0758. */
  double maxwell = value_at(&gg_theory_enskog, GG_EQUILIBRIUM, 0, 0, 1, GG_Q_COLLISION_RATE);
  assert_close(value_at(&gg_theory_montanero_santos2000, GG_HCS, 0, 0, 0.4, GG_Q_COLLISION_RATE) / maxwell,
               1 - gg_theory_a2_montanero_santos(0.4) / 16, 1e-12);
  /* The modified first Sonine: elastic Enskog, and at e = 0.6 nearer to Monte Carlo, 1.4045(20) heated and 1.184(3)
   * cooling (linear response, validation/figures/review-06.yaml), than the standard one, which is 3 % and 2.3 %
   * above. */
  assert_close(value_at(&gg_theory_garzo_santos_montanero2007, GG_HCS, 0, 0.3, 1, GG_Q_VISCOSITY_REDUCED),
               value_at(&gg_theory_enskog, GG_EQUILIBRIUM, 0, 0.3, 1, GG_Q_VISCOSITY_REDUCED), 1e-13);
  assert_close(value_at(&gg_theory_garzo_santos_montanero2007, GG_HSS, GG_GAUSSIAN, 0, 0.6, GG_Q_VISCOSITY_REDUCED),
               1.4045, 0.02);
  assert_close(value_at(&gg_theory_garzo_santos_montanero2007, GG_HCS, 0, 0, 0.6, GG_Q_VISCOSITY_REDUCED), 1.184,
               0.015);
  assert_true(value_at(&gg_theory_garzo_dufty1999, GG_HSS, GG_GAUSSIAN, 0, 0.6, GG_Q_VISCOSITY_REDUCED) >
              1.025 * 1.4045);
  /* The same viscosity through slow shear with a Gaussian thermostat. */
  assert_close(value_at(&gg_theory_garzo_dufty1999, GG_SMALL_SHEAR, GG_GAUSSIAN, 0.3, 0.8, GG_Q_VISCOSITY_REDUCED),
               3.703, 1e-4);
}

/* One species divided in two: the a_2 of van Noije & Ernst, of Montanero & Santos, and the viscosity of Garzo &
 * Dufty. */
static void equal_species_are_one(void **state)
{
  (void)state;
  for (double e = 0.3; e <= 1; e += 0.1)
    for (double phi = 0; phi < 0.5; phi += 0.2) {
      gg_model two = mixture_for(GG_HCS, phi, e, -1, 1, 1, 0.5), one = model_for(GG_HCS, phi, e, -1);
      gg_theory_answer vne = answer_of(&gg_theory_garzo_montanero2003, &two),
                       ms = answer_of(&gg_theory_garzo_montanero2003_ms, &two);
      assert_close(vne.value[GG_Q_PARTIAL_TEMPERATURE_RATIO], 1, 1e-12);
      assert_close(vne.value[GG_Q_CUMULANT] + 1, 2 * gg_theory_a2_van_noije_ernst(e) + 1, 1e-12);
      assert_close(ms.value[GG_Q_CUMULANT + 1] + 1, 2 * gg_theory_a2_montanero_santos(e) + 1, 1e-12);
      assert_close(vne.value[GG_Q_PRESSURE], value_of(&gg_theory_garzo_dufty1999, &one, GG_Q_PRESSURE), 1e-12);
    }
}

/* The viscosity equations of mixtures contain those of one species; without cumulants, which enter differently. */
static void equal_species_viscosity(void **state)
{
  (void)state;
  for (double phi = 0; phi < 0.5; phi += 0.2)
    for (double e = 0.5; e <= 1; e += 0.25) {
      gg_model m = mixture_for(GG_HSS, phi, e, -1, 1, 1, 0.5);
      double T = 0.8, chi = m.chi[0], y = phi * chi, share = 1;
      double zeta = 5. / 12 * chi * (1 - e * e), nu0 = 3.2 * sqrt(M_PI * T) * m.density;
      gg_mixture_state s = {{T, T}, {0, 0}, zeta * nu0};
      gg_mixture_viscosity v = gg_theory_mixture_viscosity_of(&m, &s, share);
      double kinetic = (1 - 0.4 * (1 + e) * (1 - 3 * e) * y) / (chi * (1 - (1 - e) * (1 - e) / 4) - zeta);
      double total = kinetic * (1 + 0.8 * (1 + e) * y) + 0.6 * 128 / (5 * M_PI) * phi * y * (1 + e);
      assert_close(v.kinetic * nu0 / (m.density * T), kinetic, 1e-12);
      assert_close(v.total * nu0 / (m.density * T), total, 1e-12);
    }
}

/* White noise: the cumulant makes the fourth moment steady, d<v^4>/dt + 30 zeta a^2 = 0, to first order in it. */
static void white_noise_cumulant(void **state)
{
  (void)state;
  for (double e = 0.3; e < 0.95; e += 0.1) {
    gg_model m = model_for(GG_HSS, 0, e, -1);
    double a[2] = {0.7, 0.7};
    gg_linear r = gg_theory_rate_v4(&m, 0, a), z = gg_theory_zeta(&m, 0, a);
    double c = -(r.at0 + 30 * z.at0 * 0.49) / (r.slope[0] + 30 * z.slope[0] * 0.49);
    assert_close(gg_theory_a2_white_noise(e) + 1, 1 + c / 2, 1e-12);
  }
}

/* ... and the temperature is lower by the effect of the cumulant on the loss: Monte Carlo 0.4964(9) at e = 0; near
 * the solution of Enskog's equation. */
static void white_noise_temperature(void **state)
{
  (void)state;
  assert_close(value_at(&gg_theory_garzo_dufty1999, GG_HSS, GG_WHITE_NOISE, 0.1, 0, GG_Q_TEMPERATURE), 0.4959, 1e-4);
  for (double e = 0.3; e < 0.95; e += 0.3) {
    double T = value_at(&gg_theory_garzo_dufty1999, GG_HSS, GG_WHITE_NOISE, 0.1, e, GG_Q_TEMPERATURE);
    assert_close(T, value_at(&gg_theory_enskog_hermite, GG_HSS, GG_WHITE_NOISE, 0.1, e, GG_Q_TEMPERATURE), 3e-4);
  }
  assert_close(value_at(&gg_theory_garzo_dufty1999, GG_HSS, GG_GAUSSIAN, 0.1, 0.3, GG_Q_TEMPERATURE), 0.5, 0);
}

/* T1/T2 by the theory as published in figures 3 to 5 of Montanero's review (his simulations within 0.4 %), and c. */
static void mixture_numbers(void **state)
{
  (void)state;
  static const struct {
    double phi, e, mass, size, number, theory, simulated;
  } row[] = {
      {0, 0.5, 2, 1, 1, 1.362, 1.367},     {0, 0.7, 2, 1, 1, 1.193, 1.197},     {0, 0.9, 2, 1, 1, 1.056, 1.057},
      {0, 0.5, 10, 1, 2, 3.801, 3.809},    {0, 0.7, 10, 1, 2, 2.518, 2.519},    {0, 0.9, 10, 1, 2, 1.437, 1.435},
      {0.3, 0.6, 2, 2, 0.5, .8894, .8913}, {0.1, 0.8, 2, 2, 0.5, .9548, .9551},
  };
  for (size_t i = 0; i < sizeof row / sizeof *row; i++)
    for (int flow = GG_HCS; flow <= GG_HSS; flow++) { /* the same state, scaled */
      gg_model m = mixture_for((gg_flow)flow, row[i].phi, row[i].e, -1, row[i].mass, row[i].size, row[i].number);
      double ratio = value_of(&gg_theory_garzo_montanero2003, &m, GG_Q_PARTIAL_TEMPERATURE_RATIO);
      assert_close(ratio, row[i].theory, 4e-4);
      assert_close(ratio, row[i].simulated, 5e-3);
    }
  gg_model m = mixture_for(GG_HCS, 0, 0.5, -1, 2, 1, 1);
  assert_close(value_of(&gg_theory_garzo_montanero2003, &m, GG_Q_CUMULANT), 0.143, 4e-3);
  assert_close(value_of(&gg_theory_garzo_montanero2003, &m, GG_Q_CUMULANT + 1), 0.071, 7e-3);
  assert_close(value_of(&gg_theory_garzo_montanero2003_ms, &m, GG_Q_CUMULANT), 0.133, 4e-3);
  assert_close(value_of(&gg_theory_garzo_montanero2003_ms, &m, GG_Q_CUMULANT + 1), 0.068, 7e-3);
}

/* The form printed in the literature: theta_i = m_i T/(m T_i); tau by beta_ij, right side by mu_ji (3 e - 1). */
static void published_source_term(void **state)
{
  (void)state;
  gg_model m = mixture_for(GG_HSS, 0.2, 0.8, -1, 4, 2, 0.5);
  double a[2] = {0.5, 1.7};
  for (int i = 0; i < 2; i++) {
    double ours = 0, theirs = 0;
    for (int j = 0; j < 2; j++) {
      int o = gg_pair(i, j);
      double mu = m.mass[j] / (m.mass[i] + m.mass[j]), B = 1.8 * mu;
      double Ti = m.mass[i] * a[i], Tj = m.mass[j] * a[j],
             weight = gg_theory_fraction(&m, j) * m.chi[o] * pow(m.sigma[o], 3);
      ours -= 2 * M_PI * weight * (4 * a[i] * B / 15 - B * B * (a[i] + a[j]) / 5);
      theirs +=
          2 * M_PI / 15 * weight * mu * 1.8 * (mu * 1.4 * (a[i] + a[j]) - 4 * (Ti - Tj) / (m.mass[i] + m.mass[j]));
    }
    assert_close(ours, theirs, 1e-12);
  }
}

/* Elastic mixture, equimolar, m = 1 and 0.1, n = sqrt(2)/3 d^-3, T = 1: Enskog shear viscosity 0.29379 (Erpenbeck,
 * Phys. Rev. A 39 (1989) 4718, in higher Sonine order). */
static void elastic_mixture_has_erpenbecks_viscosity(void **state)
{
  (void)state;
  gg_model m = mixture_for(GG_EQUILIBRIUM, M_PI / 6 * sqrt(2) / 3, 1, -1, 10, 1, 1);
  gg_mixture_state s = {{1, 10}, {0, 0}, 0};
  assert_close(gg_theory_mixture_viscosity_of(&m, &s, 0).total, 0.29379, 0.01);
}

/* Brey, Ruiz-Montero & Moreno 1997 in their own form, beta_1 = (1+e)(2+e)/6. */
static void grad_smooth(void **state)
{
  (void)state;
  for (double e = 0.3; e < 0.95; e += 0.1) {
    gg_model m = model_for(GG_USF, 0, e, -1);
    gg_theory_answer a = answer_of(&gg_theory_grad, &m);
    double beta1 = (1 + e) * (2 + e) / 6, zeta = 5. / 12 * (1 - e * e), T = a.value[GG_Q_TEMPERATURE];
    double shear = 1 / (3.2 * sqrt(M_PI * T));
    assert_close(shear * shear, 1.5 * zeta * pow(beta1 + zeta, 2) / beta1, 1e-12);
    assert_close(a.value[GG_Q_P_YY] / T, beta1 / (beta1 + zeta), 1e-12);
    assert_close(a.value[GG_Q_P_XY] / T, -beta1 * shear / pow(beta1 + zeta, 2), 1e-12);
    assert_close(a.value[GG_Q_N1], 3 * zeta / (beta1 + zeta), 1e-12);
    /* the work of shear balances cooling: -P_xy rate = (3/2) n T zeta */
    assert_close(-a.value[GG_Q_P_XY], 1.5 * T * zeta / shear, 1e-12);
  }
  gg_model m = model_for(GG_USF, 0, 0.9, -1);
  double shear = 1 / (3.2 * sqrt(M_PI * value_of(&gg_theory_grad, &m, GG_Q_TEMPERATURE)));
  assert_close(shear, 0.3587, 2e-4);
  m = model_for(GG_USF, 0.01, 0.9, 0); /* rough; simulated 0.795 */
  assert_close(value_of(&gg_theory_grad, &m, GG_Q_N1), 0.798, 1e-3);
  m = model_for(GG_USF, 0.2, 0.9, 0);
  assert_refused(&gg_theory_grad, &m, "dilute");
}

/* Montanero & Garzo 2002: m1/m2 = 4, e = 0.75: T = 0.933, T1/T2 = 1.652 (simulated 0.831, 1.625); equal species are
 * one; the closure without linearisation agrees as e -> 1. */
static void grad_mixture(void **state)
{
  (void)state;
  gg_model m = mixture_for(GG_USF, 0, 0.75, -1, 4, 1, 1);
  gg_theory_answer a = answer_of(&gg_theory_grad, &m);
  assert_close(a.value[GG_Q_TEMPERATURE] * 16, 0.933, 6e-4);
  assert_close(a.value[GG_Q_PARTIAL_TEMPERATURE_RATIO], 1.652, 4e-4);
  gg_model two = mixture_for(GG_USF, 0, 0.8, -1, 1, 1, 0.5), one = model_for(GG_USF, 0, 0.8, -1);
  gg_theory_answer b = answer_of(&gg_theory_grad, &two), c = answer_of(&gg_theory_grad, &one);
  const gg_quantity q[] = {GG_Q_TEMPERATURE, GG_Q_PRESSURE, GG_Q_P_XY, GG_Q_P_YY, GG_Q_N1, GG_Q_COLLISION_RATE};
  for (size_t i = 0; i < sizeof q / sizeof *q; i++) assert_close(b.value[q[i]], c.value[q[i]], 1e-11);
  m = mixture_for(GG_USF, 0, 0.9999, -1, 4, 1, 1);
  assert_close(value_of(&gg_theory_grad, &m, GG_Q_TEMPERATURE),
               value_of(&gg_theory_gaussian_closure, &m, GG_Q_TEMPERATURE), 1e-3);
  assert_close(value_of(&gg_theory_grad, &m, GG_Q_PARTIAL_TEMPERATURE_RATIO),
               value_of(&gg_theory_gaussian_closure, &m, GG_Q_PARTIAL_TEMPERATURE_RATIO), 1e-4);
}

/* Boltzmann's equation at any solid fraction: no contact value, neither of one species nor between two, in the rate
 * of collisions or in the temperature. */
static void grad_knows_no_contact_value(void **state)
{
  (void)state;
  gg_model one = model_for(GG_USF, 0.05, 0.9, -1), two = mixture_for(GG_USF, 0.05, 0.9, -1, 1, 1, 0.5);
  gg_model zero = model_for(GG_USF, 0, 0.9, -1);
  gg_theory_answer a = answer_of(&gg_theory_grad, &one), b = answer_of(&gg_theory_grad, &two),
                   c = answer_of(&gg_theory_grad, &zero);
  const gg_quantity q[] = {GG_Q_TEMPERATURE, GG_Q_PRESSURE,    GG_Q_P_XY,           GG_Q_P_YY,
                           GG_Q_N1,          GG_Q_DISSIPATION, GG_Q_COLLISION_RATE, GG_Q_MEAN_FREE_PATH};
  for (size_t i = 0; i < sizeof q / sizeof *q; i++) assert_close(b.value[q[i]], a.value[q[i]], 1e-11);
  assert_close(a.value[GG_Q_TEMPERATURE], 26.494, 1e-4);
  assert_close(a.value[GG_Q_TEMPERATURE] * pow(one.density, 2), c.value[GG_Q_TEMPERATURE], 1e-12);
  assert_close(a.value[GG_Q_COLLISION_RATE], c.value[GG_Q_COLLISION_RATE], 1e-12);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(elastic_is_enskog),
      cmocka_unit_test(one_species_numbers),
      cmocka_unit_test(equal_species_are_one),
      cmocka_unit_test(equal_species_viscosity),
      cmocka_unit_test(white_noise_cumulant),
      cmocka_unit_test(mixture_numbers),
      cmocka_unit_test(published_source_term),
      cmocka_unit_test(elastic_mixture_has_erpenbecks_viscosity),
      cmocka_unit_test(grad_smooth),
      cmocka_unit_test(grad_mixture),
      cmocka_unit_test(white_noise_temperature),
      cmocka_unit_test(grad_knows_no_contact_value),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
