/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Lun's theory: limits of smooth, elastic and perfectly rough grains known from other papers, and the balances of its
 * steady state. */
#include "theory_test.h"

#include "common/contact_value.h"
#include "theory/lun1991.h"

static gg_grain grain(double e, double beta, double K)
{
  return (gg_grain){(1 + e) / 2, (1 + beta) * K / (2 * (1 + K)), K};
}

static gg_lun_functions functions(double phi, double chi, gg_grain g)
{
  return gg_theory_lun_functions_at((gg_lun_state){6 * phi / M_PI, phi, chi, g, gg_theory_lun_ratio(g)});
}

static double chi_cs(double phi)
{
  return (1 - phi / 2) / pow(1 - phi, 3);
}

/* Smooth grains: Lun, Savage, Jeffrey & Chepurniy, J. Fluid Mech. 140 (1984) 223, with eta = (1+e)/2: f2 = 5
 * sqrt(pi)/(96 eta(2-eta)) (1/chi + 8/5 eta phi ...) in units of rho_p. */
static void smooth_is_lun_1984(void **state)
{
  (void)state;
  for (double e = 0.5; e <= 1; e += 0.1)
    for (double phi = 0.01; phi < 0.6; phi += 0.07) {
      double eta = (1 + e) / 2, chi = chi_cs(phi), g0 = chi;
      double f1 = phi * (1 + 4 * eta * phi * g0);
      double f2 = 5 * sqrt(M_PI) / 96 *
                  (1 / (eta * (2 - eta) * g0) + 8. / 5 * (3 * eta - 1) / (2 - eta) * phi +
                   64. / 25 * eta * ((3 * eta - 2) / (2 - eta) + 12 / M_PI) * phi * phi * g0);
      double f3 = 8 / (3 * sqrt(M_PI)) * eta * phi * phi * g0;
      double f5 = 48 / sqrt(M_PI) * eta * (1 - eta) * phi * phi * g0, s = eta * phi * g0, t = eta * (41 - 33 * eta);
      double f4 = 75 / (64 * sqrt(M_PI)) * 8 / (t * g0) *
                  ((1 + 2.4 * s) * (1 + 2.4 * s * eta * (4 * eta - 3)) + 64 / (25 * M_PI) * (41 - 33 * eta) * s * s);
      gg_lun_functions f = functions(phi, chi, grain(e, -1, 0.4));
      assert_close(f.f1 * M_PI / 6, f1, 1e-12);
      assert_close(f.f2 * M_PI / 6, f2, 1e-12);
      assert_close(f.f3 * M_PI / 6, f3, 1e-12);
      assert_close(f.f5 * M_PI / 6, f5, 1e-12);
      assert_close(f.f4[0][0], f4, 1e-12);
      assert_close(f.f2r, 0, 0);
      assert_close(f.f5r, 0, 0);
    }
}

/* Elastic smooth grains: Enskog's viscosities and conductivity at first Sonine order. */
static void elastic_is_enskog(void **state)
{
  (void)state;
  for (double phi = 0.01; phi < 0.6; phi += 0.07) {
    double chi = chi_cs(phi), y = phi * chi, eta0 = 5 / (16 * sqrt(M_PI));
    gg_lun_functions f = functions(phi, chi, grain(1, -1, 0.4));
    assert_close(f.f2, eta0 * (pow(1 + 1.6 * y, 2) / chi + 768 / (25 * M_PI) * phi * y), 1e-12);
    assert_close(f.f3, eta0 * 256 / (5 * M_PI) * phi * y, 1e-12);
    assert_close(f.f4[0][0], 15. / 4 * eta0 * (pow(1 + 2.4 * y, 2) / chi + 512 / (25 * M_PI) * phi * y), 1e-12);
    assert_close(f.f5, 0, 0);
  }
}

/* Elastic perfectly rough dilute grains: Pidduck, Proc. R. Soc. A 101 (1922) 101:
 * 15/8 sqrt(T/pi) (1+K)^2/(6+13K), and with theta = T the conductivity of Chapman & Cowling, 11.62. */
static void perfectly_rough_is_pidduck(void **state)
{
  (void)state;
  for (double K = 0.05; K < 0.67; K += 0.1) {
    gg_grain g = grain(1, 1, K);
    assert_close(gg_theory_lun_ratio(g), 1, 1e-14);
    gg_lun_functions f = gg_theory_lun_functions_at((gg_lun_state){1, 0, 1, g, 1});
    assert_close(f.f2, 15 / (8 * sqrt(M_PI)) * (1 + K) * (1 + K) / (6 + 13 * K), 1e-12);
    assert_close(f.f5, 0, 1e-14);
    assert_close(f.f4[0][0] + f.f4[0][1] + f.f4[1][0] + f.f4[1][1],
                 9 / (16 * sqrt(M_PI)) * pow(1 + K, 2) * (37 + 151 * K + 50 * K * K) /
                     (12 + 75 * K + 101 * K * K + 102 * K * K * K),
                 1e-12);
  }
}

/* theta/T = K(1+beta)/(1+2K-beta) (Gayen's thesis, eq. 5.13), at which rotation gains nothing. */
static void ratio_makes_rotation_steady(void **state)
{
  (void)state;
  for (double beta = -0.9; beta <= 1; beta += 0.1)
    for (double K = 0.1; K < 0.67; K += 0.1) {
      gg_grain g = grain(0.8, beta, K);
      assert_close(gg_theory_lun_ratio(g), K * (1 + beta) / (1 + 2 * K - beta), 1e-13);
      assert_close(functions(0.2, chi_cs(0.2), g).f5r, 0, 1e-13);
    }
}

/* The steady state balances the work of shear and dissipation, and the reported numbers are consistent. */
static void steady_state_balances(void **state)
{
  (void)state;
  gg_model m = model_for(GG_USF, 0.3, 0.9, 0.2);
  gg_theory_answer a = answer_of(&gg_theory_lun1991, &m);
  const double *v = a.value;
  assert_close(-v[GG_Q_P_XY], v[GG_Q_DISSIPATION], 1e-13);
  assert_close(v[GG_Q_SHEAR_VISCOSITY], -v[GG_Q_P_XY], 1e-15);
  assert_close(v[GG_Q_P_XX], v[GG_Q_P_XX_KINETIC] + v[GG_Q_P_XX_COLLISIONAL], 1e-14);
  assert_close(v[GG_Q_P_XX_KINETIC], 0.3 * v[GG_Q_TEMPERATURE], 1e-13); /* phi T in units of rho_p */
  assert_close(v[GG_Q_PRESSURE], v[GG_Q_COMPRESSIBILITY] * 0.3 * v[GG_Q_TEMPERATURE], 1e-13);
  assert_close(v[GG_Q_TEMPERATURE_RATIO] * v[GG_Q_TEMPERATURE], v[GG_Q_ROTATIONAL_TEMPERATURE], 1e-14);
  assert_close(v[GG_Q_SPIN_Z], -0.5, 0);
  assert_close(v[GG_Q_BULK_VISCOSITY] / v[GG_Q_ROTATIONAL_VISCOSITY], 4. / 3 * 0.95 / (1.2 * 0.4 / 2.8), 1e-13);
  /* nu = 24 phi chi sqrt(T/pi)/d, l = d/(6 sqrt(2) phi chi) */
  assert_close(v[GG_Q_COLLISION_RATE], 24 * 0.3 * chi_cs(0.3) * sqrt(v[GG_Q_TEMPERATURE] / M_PI), 1e-12);
  assert_close(v[GG_Q_MEAN_FREE_PATH], 1 / (6 * sqrt(2) * 0.3 * chi_cs(0.3)), 1e-12);
}

/* phi = 0 is the limit phi -> 0 with lengths in 1/(n d^2): T scales by (n d^2)^2, mu/(n m) likewise. */
static void boltzmann_is_the_dilute_limit(void **state)
{
  (void)state;
  for (double beta = -1; beta < 1; beta += 0.5) {
    gg_model zero = model_for(GG_USF, 0, 0.9, beta);
    double worst[2] = {0, 0};
    for (int i = 0; i < 2; i++) {
      double phi = i ? 1e-7 : 1e-5, n = 6 * phi / M_PI;
      gg_model thin = model_for(GG_USF, phi, 0.9, beta);
      gg_theory_answer a = answer_of(&gg_theory_lun1991, &thin), b = answer_of(&gg_theory_lun1991, &zero);
      double T = a.value[GG_Q_TEMPERATURE] * n * n / b.value[GG_Q_TEMPERATURE] - 1;
      double p = a.value[GG_Q_PRESSURE] / phi * n * n / b.value[GG_Q_PRESSURE] - 1;
      double mu = a.value[GG_Q_SHEAR_VISCOSITY] / phi * n * n / b.value[GG_Q_SHEAR_VISCOSITY] - 1;
      double nu = a.value[GG_Q_COLLISION_RATE] / b.value[GG_Q_COLLISION_RATE] - 1;
      double kappa = a.value[GG_Q_THERMAL_CONDUCTIVITY] / phi * n * n / b.value[GG_Q_THERMAL_CONDUCTIVITY] - 1;
      worst[i] = fmax(fmax(fabs(T), fabs(p)), fmax(fmax(fabs(mu), fabs(kappa)), fabs(nu)));
      assert_close(a.value[GG_Q_MEAN_FREE_PATH] * n, b.value[GG_Q_MEAN_FREE_PATH], 10 * phi);
      assert_true(isnan(b.value[GG_Q_P_XX_COLLISIONAL]) && isnan(b.value[GG_Q_SPIN_Z]));
    }
    assert_true(worst[0] < 2e-4 && worst[1] < 2e-6); /* vanishes linearly */
  }
}

/* The collisional stress of dilute gases is smaller than the kinetic one by phi, and reported as well: Pc = 4 eta_1
 * phi chi nT. */
static void transfer_of_dilute_gases(void **state)
{
  (void)state;
  double first = 0;
  for (double phi = 1e-6; phi > 1e-19; phi /= 10) {
    gg_model m = model_for(GG_USF, phi, 0.9, -1);
    gg_theory_answer a = answer_of(&gg_theory_lun1991, &m);
    assert_close(a.value[GG_Q_P_XX_COLLISIONAL] / a.value[GG_Q_P_XX_KINETIC], 3.8 * phi, 1e-5);
    if (first == 0) first = a.value[GG_Q_P_XY_COLLISIONAL];
    assert_close(a.value[GG_Q_P_XY_COLLISIONAL], first, 1e-5);
  }
  assert_true(first < -0.01);
}

/* Smooth grains in the Boltzmann limit, by hand: T = f2/f5. */
static void boltzmann_by_hand(void **state)
{
  (void)state;
  gg_model m = model_for(GG_USF, 0, 0.8, -1);
  double eta = 0.9, T = 5 / (16 * sqrt(M_PI) * eta * (2 - eta)) / (8 * sqrt(M_PI) * eta * (1 - eta));
  assert_close(value_of(&gg_theory_lun1991, &m, GG_Q_TEMPERATURE), T, 1e-13);
  assert_close(value_of(&gg_theory_lun1991, &m, GG_Q_PRESSURE), T, 1e-13);
}

/* The pressure minimum at e = 0.99 lies at phi = 0.150 for either contact value (Gayen's thesis, sect. 5.3.1). */
static void pressure_minimum(void **state)
{
  (void)state;
  for (int kind = GG_CARNAHAN_STARLING; kind <= GG_LUN_SAVAGE; kind++) {
    double best = 0, lowest = INFINITY;
    for (double phi = 0.1; phi < 0.2; phi += 0.0005) {
      gg_scene s = scene_of(GG_USF, phi, 0.99, -1);
      s.contact_value = (gg_contact_value)kind;
      gg_model m = model_of(&s);
      double p = value_of(&gg_theory_lun1991, &m, GG_Q_PRESSURE);
      if (p < lowest) lowest = p, best = phi;
    }
    assert_close(best, 0.150, 0.005 / 0.150);
  }
}

/* Both contact values side by side: 11 % apart at phi = 0.3 and 90 % at 0.5; at one contact value, one theory. */
static void contact_values(void **state)
{
  (void)state;
  gg_model m = model_for(GG_USF, 0.3, 0.9, -1);
  double cs = gg_common_contact_value_of(GG_CARNAHAN_STARLING, 0.3),
         ls = gg_common_contact_value_of(GG_LUN_SAVAGE, 0.3);
  assert_close(ls / cs, 1.11, 0.005);
  assert_close(gg_common_contact_value_of(GG_LUN_SAVAGE, 0.5) / gg_common_contact_value_of(GG_CARNAHAN_STARLING, 0.5),
               1.9, 0.01);
  double l = value_of(&gg_theory_lun1991_lun_savage, &m, GG_Q_MEAN_FREE_PATH);
  assert_close(l, 1 / (6 * sqrt(2) * 0.3 * ls), 1e-12);
  assert_close(l * value_of(&gg_theory_lun1991_lun_savage, &m, GG_Q_COLLISION_RATE),
               sqrt(8 / M_PI * value_of(&gg_theory_lun1991_lun_savage, &m, GG_Q_TEMPERATURE)), 1e-12);
  gg_scene s = scene_of(GG_USF, 0.3, 0.9, -1);
  s.contact_value = GG_LUN_SAVAGE;
  gg_model same = model_of(&s);
  gg_theory_answer a = answer_of(&gg_theory_lun1991, &same), b = answer_of(&gg_theory_lun1991_lun_savage, &m);
  for (int q = 0; q < GG_N_QUANTITIES; q++)
    if (!isnan(a.value[q])) assert_close(b.value[q], a.value[q], 1e-12);
  m = model_for(GG_USF, 0.65, 0.9, -1);
  assert_refused(&gg_theory_lun1991_lun_savage, &m, "below phi = 0.64");
}

/* A scene that the theory does not describe is rejected with the reason. */
static void refuses_politely(void **state)
{
  (void)state;
  gg_model m = model_for(GG_HCS, 0.1, 0.9, -1);
  assert_refused(&gg_theory_lun1991, &m, "lun1991 describes uniform shear; this scene is free cooling");
  m = model_for(GG_USF, 0.1, 1, -1);
  assert_refused(&gg_theory_lun1991, &m, "lose no energy");
  m = model_for(GG_USF, 0.1, 1, 1);
  assert_refused(&gg_theory_lun1991, &m, "lose no energy");
  gg_scene s = scene_of(GG_USF, 0.1, 0.9, 0.4);
  for (int p = 0; p < GG_PAIRS; p++) s.collision.mu[p] = 0.1;
  m = model_of(&s);
  assert_refused(&gg_theory_lun1991, &m, "Coulomb");
  s = scene_of(GG_USF, 0.1, 0.9, -1);
  s.n_species = 2;
  s.species[1] = s.species[0];
  m = model_of(&s);
  assert_refused(&gg_theory_lun1991, &m, "one species");
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(smooth_is_lun_1984),         cmocka_unit_test(elastic_is_enskog),
      cmocka_unit_test(perfectly_rough_is_pidduck), cmocka_unit_test(ratio_makes_rotation_steady),
      cmocka_unit_test(steady_state_balances),      cmocka_unit_test(boltzmann_is_the_dilute_limit),
      cmocka_unit_test(transfer_of_dilute_gases),   cmocka_unit_test(boltzmann_by_hand),
      cmocka_unit_test(pressure_minimum),           cmocka_unit_test(contact_values),
      cmocka_unit_test(refuses_politely),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
