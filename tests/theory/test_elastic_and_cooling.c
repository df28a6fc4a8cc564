/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Equations of state, contact values, collision rates, Haff's law, critical sizes. */
#include "theory_test.h"

#include "common/contact_value.h"
#include "theory/answer.h"
#include "theory/equation_of_state.h"
#include "theory/goldhirsch_zanetti1993.h"
#include "theory/haff1983.h"

/* Pieprzyk et al. 2019 at phi = 0.1 .. 0.45, and the differences of the others. */
static void equations_of_state(void **state)
{
  (void)state;
  static const double phi[] = {0.1, 0.2, 0.3, 0.4, 0.45};
  static const double Z[] = {1.521647, 2.409403, 3.983983, 6.945460, 9.404114};
  for (int i = 0; i < 5; i++) {
    gg_model m = model_for(GG_EQUILIBRIUM, phi[i], 1, -1);
    assert_close(value_of(&gg_theory_pieprzyk2019, &m, GG_Q_COMPRESSIBILITY), Z[i], 3e-7);
    assert_close(value_of(&gg_theory_kolafa2004, &m, GG_Q_COMPRESSIBILITY), Z[i], 4e-6);
    double cs = value_of(&gg_theory_carnahan_starling1969, &m, GG_Q_COMPRESSIBILITY);
    assert_true(cs < Z[i] && cs > Z[i] * (1 - 0.003));
    assert_close(cs, value_of(&gg_theory_enskog, &m, GG_Q_COMPRESSIBILITY), 1e-13);
    assert_close(value_of(&gg_theory_pieprzyk2019, &m, GG_Q_PRESSURE), 0.5 * phi[i] * Z[i], 3e-7);
    /* p = n T (1 + 4 phi chi) and nu = 24 phi chi sqrt(T/pi) hold for the same chi */
    double nu = value_of(&gg_theory_pieprzyk2019, &m, GG_Q_COLLISION_RATE);
    assert_close(nu, 6 * (Z[i] - 1) * sqrt(0.5 / M_PI), 1e-6);
  }
  gg_model m = model_for(GG_EQUILIBRIUM, 0.55, 1, -1);
  assert_refused(&gg_theory_pieprzyk2019, &m, "0.494");
}

/* Dilute limit: the rate is proportional to phi, as Enskog's, and the pressure is that of an ideal gas. */
static void dilute_equations_of_state(void **state)
{
  (void)state;
  const gg_theory *const all[] = {&gg_theory_carnahan_starling1969, &gg_theory_kolafa2004, &gg_theory_pieprzyk2019,
                                  &gg_theory_enskog};
  for (double phi = 1e-19; phi < 1e-6; phi *= 100) {
    gg_model m = model_for(GG_EQUILIBRIUM, phi, 1, -1);
    double chi = 1 + 2.5 * phi, rate = 24 * phi * chi * sqrt(0.5 / M_PI);
    for (int i = 0; i < 4; i++) {
      gg_theory_answer a = answer_of(all[i], &m);
      assert_close(a.value[GG_Q_COLLISION_RATE], rate, 1e-12);
      assert_close(a.value[GG_Q_MEAN_FREE_PATH], sqrt(4 / M_PI) / rate, 1e-12);
      assert_close(a.value[GG_Q_PRESSURE], phi / 2 * (1 + 4 * phi * chi), 1e-14);
    }
  }
}

/* Carnahan & Starling are low by 0.025, 0.257, 0.207 and 0.121 % at phi = 0.1, 0.3, 0.45, 0.49. */
static void carnahan_starling_error(void **state)
{
  (void)state;
  static const double phi[] = {0.1, 0.3, 0.45, 0.49}, low[] = {0.025, 0.257, 0.207, 0.121};
  for (int i = 0; i < 4; i++) {
    double cs = gg_common_compressibility(GG_CARNAHAN_STARLING, phi[i]),
           kolafa = gg_theory_compressibility_kolafa2004(phi[i]);
    assert_true(fabs(100 * (1 - cs / kolafa) - low[i]) < 0.001);
  }
}

/* Virial coefficients of hard spheres: B2 = 4, B3 = 10, B4 = 18.364768, B5 = 28.2244, B6 = 39.8151 in powers of phi. */
static void virial_coefficients(void **state)
{
  (void)state;
  static const double B[] = {4, 10, 18.364768, 28.2244, 39.8151};
  for (double phi = 0.004; phi < 0.05; phi *= 1.5) {
    double series = 1;
    for (int i = 0; i < 5; i++) series += B[i] * pow(phi, i + 1);
    double next = 53.4 * pow(phi, 6) * (1 + 2 * phi); /* B7 */
    assert_true(fabs(gg_theory_compressibility_kolafa2004(phi) - series - next) <
                1e-4 * pow(phi, 4) + 0.1 * next + 1e-15);
  }
}

/* The contact values of a mixture give the pressure of Mansoori, Carnahan, Starling & Leland, J. Chem. Phys. 54 (1971)
 * 1523: p/T = (6/pi) [x0/(1-x3) + 3 x1 x2/(1-x3)^2 + (3 - x3) x2^3/(1-x3)^3], x_k = (pi/6) sum n_i d_i^k. */
static void mixture_equation_of_state(void **state)
{
  (void)state;
  for (double size = 1; size < 5; size += 1.5)
    for (double phi = 0.1; phi < 0.5; phi += 0.1) {
      gg_model m = mixture_for(GG_EQUILIBRIUM, phi, 1, -1, 3, size, 0.5);
      double x[4] = {0};
      for (int k = 0; k < 4; k++)
        for (int i = 0; i < 2; i++)
          x[k] += M_PI / 6 * m.density * (double)m.n_of[i] / (double)m.n * pow(m.diameter[i], k);
      double f = 1 - x[3];
      double p = 6 / M_PI * (x[0] / f + 3 * x[1] * x[2] / (f * f) + (3 - x[3]) * pow(x[2] / f, 3));
      assert_close(value_of(&gg_theory_enskog, &m, GG_Q_COMPRESSIBILITY), p / m.density, 1e-12);
    }
}

/* Unlike masses at one temperature: all velocities together are not Maxwellian. Masses 1:10 in equal numbers: 5.008;
 * Monte Carlo 5.00(3). */
static void kurtosis_of_a_mixture(void **state)
{
  (void)state;
  gg_model m = mixture_for(GG_EQUILIBRIUM, 0.1, 1, -1, 0.1, 1, 1);
  gg_theory_answer a = answer_of(&gg_theory_enskog, &m);
  assert_close(a.value[GG_Q_KURTOSIS_CX], 3 * (0.5 + 0.005) / (0.55 * 0.55), 1e-12);
  assert_close(a.value[GG_Q_KURTOSIS_CZ], 5.008, 1e-4);
  m = mixture_for(GG_EQUILIBRIUM, 0.1, 1, -1, 1, 2, 1);
  assert_close(value_of(&gg_theory_enskog, &m, GG_Q_KURTOSIS_CX), 3, 1e-14);
}

/* Collisions between species balance: n_1 nu_12 = n_2 nu_21; equal species together have the collisions of one. */
static void collision_rates_of_mixtures(void **state)
{
  (void)state;
  gg_model m = mixture_for(GG_HCS, 0.2, 0.9, -1, 4, 2, 0.5);
  const double T[2] = {0.6, 0.4};
  double nu12 = gg_theory_pair_collision_rate(&m, 0, 1, T), nu21 = gg_theory_pair_collision_rate(&m, 1, 0, T);
  assert_close(nu12 * (double)m.n_of[0], nu21 * (double)m.n_of[1], 1e-13);
  m = mixture_for(GG_HCS, 0.2, 0.9, -1, 1, 1, 0.5);
  const double same[2] = {0.5, 0.5};
  double chi = (1 - 0.1) / pow(0.8, 3);
  assert_close(gg_theory_pair_collision_rate(&m, 0, 0, same) + gg_theory_pair_collision_rate(&m, 0, 1, same),
               24 * 0.2 * chi * sqrt(0.5 / M_PI), 1e-12);
  for (int i = 0; i < 2; i++) assert_close(gg_theory_mean_free_path(&m, i, same), 1 / (6 * sqrt(2) * 0.2 * chi), 1e-12);
}

/* Elastic equimolar mixture, masses 1 and 0.1, n = sqrt(2)/3: Enskog's viscosity 0.29379 at T = 1 (Erpenbeck 1989); in
 * this order 0.8 % below. */
static void viscosity_of_a_mixture(void **state)
{
  (void)state;
  gg_model m = mixture_for(GG_EQUILIBRIUM, M_PI / 6 * sqrt(2) / 3, 1, -1, 10, 1, 1);
  m.temperature0 = 1;
  double unit = m.density / (sqrt(M_PI) * m.density * sqrt(2 * 11)); /* n T/nu_0 */
  assert_close(value_of(&gg_theory_enskog, &m, GG_Q_VISCOSITY_REDUCED) * unit, 0.29379, 0.01);
}

/* Haff's law solves dT/dt = -zeta_0 sqrt(T/T_0) T with collisions dN/dt = nu_0 sqrt(T/T_0), by small steps. */
static void haff_law(void **state)
{
  (void)state;
  double T0 = 0.5, zeta0 = 0.3, nu0 = 5, T = T0, N = 0, dt = 1e-3;
  for (int i = 0; i < 20000; i++) { /* midpoint steps */
    double half = T - dt / 2 * zeta0 * sqrt(T / T0) * T;
    T -= dt * zeta0 * sqrt(half / T0) * half;
    N += dt * nu0 * sqrt(half / T0);
  }
  assert_close(gg_theory_haff_temperature(T0, zeta0, 20), T, 1e-6);
  assert_close(gg_theory_haff_collisions(nu0, zeta0, 20), N, 1e-6);
  assert_close(gg_theory_haff_collisions(nu0, 0, 20), 100, 0);
  /* zeta* = 5/12 chi (1-e^2), the leading order of the Sonine theories */
  gg_model m = model_for(GG_HCS, 0.3, 0.8, -1);
  assert_close(value_of(&gg_theory_haff1983, &m, GG_Q_COOLING_RATE), 5. / 12 * m.chi[0] * 0.36, 1e-13);
  assert_close(value_of(&gg_theory_haff1983, &m, GG_Q_COOLING_RATE),
               value_of(&gg_theory_garzo_dufty1999, &m, GG_Q_COOLING_RATE), 0.02);
}

/* Free cooling clusters above 12 d at phi = 0.3, e = 0.9, and above 7 d at e = 0.7. */
static void critical_size(void **state)
{
  (void)state;
  gg_model m = model_for(GG_HCS, 0.3, 0.9, -1);
  assert_close(gg_theory_clustering_length(&m), 12, 0.05);
  m = model_for(GG_HCS, 0.3, 0.7, -1);
  assert_close(gg_theory_clustering_length(&m), 7, 0.06);
  gg_model sheared = model_for(GG_USF, 0.3, 0.7, -1);
  assert_close(gg_theory_clustering_length(&sheared), gg_theory_clustering_length(&m), 1e-12);
  m = model_for(GG_USF, 0.3, 1, -1);
  assert_true(isinf(gg_theory_clustering_length(&m)));
  m = mixture_for(GG_HCS, 0.3, 0.9, 0, 2, 1, 1);
  assert_true(isnan(gg_theory_clustering_length(&m)));
}

/* One species divided in two; a mixture under the Gaussian thermostat equals one that cools, in other units. Dilute,
 * nearly elastic, apart from a trace species: eta and zeta of the other, one species with that mass. */
static void critical_size_of_mixtures(void **state)
{
  (void)state;
  const double e[] = {0.5, 0.8, 0.95};
  for (int k = 0; k < 3; k++) {
    gg_model one = model_for(GG_HCS, 0.3, e[k], -1), cut = mixture_for(GG_HCS, 0.3, e[k], -1, 1, 1, 1);
    assert_close(gg_theory_clustering_length(&cut), gg_theory_clustering_length(&one), 0.01);
    gg_model heavy = mixture_for(GG_HCS, 0.3, e[k], -1, 8, 1, 1e4);
    assert_close(gg_theory_clustering_length(&heavy), gg_theory_clustering_length(&one), 0.01);
    gg_model cooling = mixture_for(GG_HCS, 0.2, e[k], -1, 4, 2, 1), heated = cooling;
    heated.flow = GG_HSS, heated.thermostat = GG_GAUSSIAN;
    assert_close(gg_theory_clustering_length(&heated), gg_theory_clustering_length(&cooling), 1e-12);
    assert_true(gg_theory_clustering_length(&cooling) > 1);
  }
}

/* Rough grains with heated translation have colder spins than those that cool at beta = 0; perfectly rough and
 * nearly elastic ones share energy, and the thermostat replaces the loss of both: zeta is twice that of T in
 * cooling, where both fall together. */
static void critical_size_of_heated_rough_grains(void **state)
{
  (void)state;
  gg_model cooling = model_for(GG_HCS, 0.1, 1 - 1e-6, 1), heated = cooling;
  heated.flow = GG_HSS, heated.thermostat = GG_GAUSSIAN;
  assert_close(gg_theory_clustering_length(&heated), gg_theory_clustering_length(&cooling) / sqrt(2), 1e-4);
}

/* The number of grains in a box of that length; also under the Gaussian thermostat, not under noise or shear. */
static void stable_size(void **state)
{
  (void)state;
  char text[200], gaussian[200];
  gg_model m = model_for(GG_HCS, 0.3, 0.7, -1);
  m.n = 1000, m.homogeneous = false;
  m.box[0] = m.box[1] = m.box[2] = gg_theory_clustering_length(&m) / 0.7;
  assert_true(gg_theory_stable_size(&m, text, sizeof text));
  assert_non_null(strstr(text, "only, about 340 grains")); /* 0.7^3 = 0.343 */
  m.flow = GG_HSS, m.thermostat = GG_GAUSSIAN;
  assert_true(gg_theory_stable_size(&m, gaussian, sizeof gaussian));
  assert_string_equal(gaussian, text);
  m.thermostat = GG_WHITE_NOISE;
  assert_false(gg_theory_stable_size(&m, text, sizeof text));
  m.flow = GG_HCS, m.thermostat = GG_NO_THERMOSTAT, m.homogeneous = true;
  assert_false(gg_theory_stable_size(&m, text, sizeof text));
  m.homogeneous = false, m.box[0] = m.box[1] = m.box[2] = gg_theory_clustering_length(&m) / 2;
  assert_true(gg_theory_stable_size(&m, text, sizeof text));
  assert_non_null(strstr(text, "about 8000 grains"));
  assert_null(strstr(text, "will grow"));
}

/* Nearly elastic, perfectly rough, dilute: Pidduck's viscosity, and zeta = nu (1-e^2)/6, because translation and
 * rotation share the loss. */
static void critical_size_of_rough_grains(void **state)
{
  (void)state;
  double e = 1 - 1e-6, K = 0.4;
  gg_model m = model_for(GG_HCS, 0, e, 1);
  double eta = 15 / (8 * sqrt(M_PI)) * (1 + K) * (1 + K) / (6 + 13 * K), zeta = 4 * sqrt(M_PI) * (1 - e * e) / 6;
  assert_close(gg_theory_clustering_length(&m), 2 * M_PI * sqrt(2 * eta / zeta), 1e-5);
}

/* A flux that decays no faster than the gas cools has no first-order solution: D falls towards that pole and is
 * rejected beyond, where it would be large and positive. */
static void diffusion_where_cooling_is_fast(void **state)
{
  (void)state;
  static const gg_theory *const theories[] = {&gg_theory_garzo_dufty2002, &gg_theory_garzo_dufty_hrenya2007};
  for (int t = 0; t < 2; t++) {
    double before = INFINITY;
    for (double e = 0.5; e > 0.05; e -= 0.1) {
      const gg_model m = mixture_for(GG_HCS, 0, e, -1, 0.1, 0.2, 1);
      const double D = value_of(theories[t], &m, GG_Q_DIFFUSION_REDUCED);
      if (!(D < before)) fail_msg("D = %g at e = %g, %g before", D, e, before);
      before = D;
    }
    const gg_model m = mixture_for(GG_HCS, 0, 0, -1, 0.1, 0.2, 1);
    assert_refused(theories[t], &m, "decays more slowly than the gas cools");
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(equations_of_state),
      cmocka_unit_test(dilute_equations_of_state),
      cmocka_unit_test(carnahan_starling_error),
      cmocka_unit_test(virial_coefficients),
      cmocka_unit_test(mixture_equation_of_state),
      cmocka_unit_test(kurtosis_of_a_mixture),
      cmocka_unit_test(collision_rates_of_mixtures),
      cmocka_unit_test(viscosity_of_a_mixture),
      cmocka_unit_test(haff_law),
      cmocka_unit_test(critical_size),
      cmocka_unit_test(critical_size_of_mixtures),
      cmocka_unit_test(critical_size_of_heated_rough_grains),
      cmocka_unit_test(stable_size),
      cmocka_unit_test(critical_size_of_rough_grains),
      cmocka_unit_test(diffusion_where_cooling_is_fast),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
