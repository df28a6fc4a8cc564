/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Exchange of energy between translation and rotation of rough grains: closed forms, limits of roughness and friction,
 * and the theories that use it. */
#include "theory_test.h"

#include "theory/lun1991.h"
#include "theory/two_maxwellian.h"

static gg_grain grain(double e, double beta, double K)
{
  return (gg_grain){(1 + e) / 2, (1 + beta) * K / (2 * (1 + K)), K};
}

/* Closed form of the cooling ratio (Huthmann & Zippelius 1997): [(A-C) + sqrt((A-C)^2 + 4B^2)]/(2B). */
static void cooling_ratio(void **state)
{
  (void)state;
  for (double e = 0.3; e < 0.95; e += 0.2)
    for (double beta = -0.95; beta <= 1; beta += 0.15) {
      double K = 0.4;
      gg_grain g = grain(e, beta, K);
      double A = g.eta1 * (1 - g.eta1) + g.eta2 * (1 - g.eta2), B = g.eta2 * g.eta2 / K;
      double C = g.eta2 / K * (1 - g.eta2 / K);
      assert_close(gg_theory_ratio_cooling(g, INFINITY), (A - C + sqrt((A - C) * (A - C) + 4 * B * B)) / (2 * B),
                   1e-10);
      assert_close(gg_theory_ratio_driven(g, INFINITY), gg_theory_lun_ratio(g), 1e-10);
    }
  assert_close(gg_theory_ratio_cooling(grain(0.9, 0, 0.4), INFINITY), 0.5738, 1e-4);
  assert_close(gg_theory_ratio_cooling(grain(0.8, 0.5, 0.4), INFINITY), 1.043, 5e-4);
}

/* Nearly smooth grains: spins return nearly all the energy that translation loses, at theta/T = (A - C)/B, and have
 * most of the energy; driven they have next to none. Grains lose 4C of their energy in a collision, at any rounding
 * of A - B r. */
static void nearly_smooth_ratios(void **state)
{
  (void)state;
  for (double rough = 1e-5; rough > 1e-13; rough /= 100) {
    double beta = -1 + rough, K = 0.4, e = 0.9;
    gg_grain g = grain(e, beta, K);
    double A = g.eta1 * (1 - g.eta1) + g.eta2 * (1 - g.eta2), B = g.eta2 * g.eta2 / K, C = g.eta2 / K;
    double ratio = gg_theory_ratio_cooling(g, INFINITY);
    assert_close(ratio, (A - C) / B, 20 * rough);
    assert_close(gg_theory_cooling_at(g, INFINITY, ratio), 4 * C, 20 * rough + 1e-9);
    assert_close(gg_theory_ratio_driven(g, INFINITY), g.eta2, 20 * rough);
    assert_close(gg_theory_ratio_driven(g, 10), g.eta2, 20 * rough); /* with so much friction no contact slides */
  }
  gg_model m = model_for(GG_HCS, 0.01, 0.9, -0.9999999);
  const gg_theory *const all[] = {&gg_theory_huthmann_zippelius1997, &gg_theory_kremer_santos_garzo2014};
  for (int i = 0; i < 2; i++) assert_close(value_of(all[i], &m, GG_Q_TEMPERATURE_RATIO), 9.31e13, 1e-3);
  assert_true(isfinite(value_of(&gg_theory_goldhirsch_zanetti1993, &m, GG_Q_CLUSTERING_LENGTH)));
  assert_true(value_of(&gg_theory_enskog_hermite, &m, GG_Q_TEMPERATURE_RATIO) > 8e13);
}

/* Friction so strong that no contact slides is constant beta, at any value of mu. */
static void strong_friction(void **state)
{
  (void)state;
  gg_grain g = grain(0.9, 0.3, 0.4);
  const double mu[] = {1e6, 1e10, 1e13, 1e15, 1e16, 1e300};
  gg_exchange rough = gg_theory_exchange_at(g, INFINITY, 0.5);
  for (int i = 0; i < 6; i++) {
    gg_exchange x = gg_theory_exchange_at(g, mu[i], 0.5);
    assert_close(x.translation, rough.translation, 1e-11);
    assert_close(x.rotation, rough.rotation, 1e-11);
    assert_close(gg_theory_ratio_driven(g, mu[i]), gg_theory_ratio_driven(g, INFINITY), 1e-11);
    assert_close(gg_theory_ratio_cooling(g, mu[i]), gg_theory_ratio_cooling(g, INFINITY), 1e-11);
  }
  for (double small = 1e-4; small < 1; small *= 1.01) { /* where one form of delta - sin(4 delta)/4 ends */
    gg_exchange a = gg_theory_exchange_at(g, 0.2 / small, 0.5),
                b = gg_theory_exchange_at(g, 0.2 / small * (1 + 1e-9), 0.5);
    assert_close(a.translation, b.translation, 1e-9);
    assert_close(a.rotation + 1, b.rotation + 1, 1e-9);
  }
}

/* The rates in the form of Santos, Kremer & Garzo 2010, eq. (39): nu' = (16/5) n d^2 chi sqrt(pi T). */
static void rates_of_santos(void **state)
{
  (void)state;
  for (double beta = -0.9; beta <= 1; beta += 0.3) {
    double e = 0.8, K = 0.3, r = 0.7;
    gg_exchange x = gg_theory_exchange_at(grain(e, beta, K), INFINITY, r);
    double nu = 4, nu1 = 3.2; /* collision rate and nu' in units of n d^2 chi sqrt(pi T) */
    double tr =
        5. / 12 * nu1 * (1 - e * e + K / (1 + K) * (1 - beta * beta) + K * pow((1 + beta) / (1 + K), 2) * (1 - r));
    double rot = 5. / 12 * nu1 * (1 + beta) / (1 + K) * (1 - beta + K * (1 + beta) / (1 + K) * (1 - 1 / r));
    assert_close(-nu / 3 * x.translation, tr, 1e-13);
    assert_close(-nu / 3 * x.rotation / r, rot, 1e-12);
  }
}

/* Elastic perfectly rough grains share energy equally and lose none. */
static void perfectly_rough_elastic_grains_share_equally(void **state)
{
  (void)state;
  gg_grain g = grain(1, 1, 0.4);
  gg_exchange x = gg_theory_exchange_at(g, INFINITY, 1);
  assert_close(x.translation, 0, 1e-15);
  assert_close(x.rotation, 0, 1e-15);
  x = gg_theory_exchange_at(g, INFINITY, 0.3);
  assert_close(x.translation + x.rotation, 0, 1e-15);
}

/* Infinite friction is constant beta; vanishing friction leaves smooth grains. */
static void friction_limits(void **state)
{
  (void)state;
  for (double beta = -0.8; beta <= 1; beta += 0.3) {
    gg_grain g = grain(0.9, beta, 0.4);
    gg_exchange rough = gg_theory_exchange_at(g, INFINITY, 0.5), sticky = gg_theory_exchange_at(g, 1e5, 0.5);
    gg_exchange slippery = gg_theory_exchange_at(g, 1e-9, 0.5);
    assert_close(sticky.translation, rough.translation, 1e-7);
    assert_close(sticky.rotation, rough.rotation, 1e-7);
    assert_close(slippery.translation, -4 * g.eta1 * (1 - g.eta1), 1e-7);
    assert_close(slippery.rotation, 0, 1e-7);
    assert_close(gg_theory_sliding_fraction(g, 1e5, 0.5), 0, 1e-9);
    assert_close(gg_theory_sliding_fraction(g, 1e-9, 0.5), 1, 1e-12);
  }
}

/* One integral over the angle of impact instead of the closed form: with c = cot(psi) of the impact, the normal contact
 * velocity squared is 4T x, x exponential, and V |g_t|^2 likewise. */
static void friction_by_quadrature(void **state)
{
  (void)state;
  const double mu = 0.2, r = 0.6;
  gg_grain g = grain(0.9, 0.3, 0.4);
  double V = 2 * (1 + r / g.K), Jg = 0, JJ = 0, slides = 0;
  const int n = 1000; /* midpoints in both distribution functions; the kink at the critical angle sets the error */
  for (int i = 0; i < n; i++)
    for (int j = 0; j < n; j++) {
      double gn = sqrt(-4 * log((i + 0.5) / n)), gt = sqrt(-2 * V * log((j + 0.5) / n));
      double stick = g.eta2 * gt, limit = mu * g.eta1 * gn, Jt = fmin(stick, limit);
      Jg += Jt * gt, JJ += Jt * Jt, slides += stick > limit;
    }
  Jg /= (double)n * n, JJ /= (double)n * n, slides /= (double)n * n;
  gg_exchange x = gg_theory_exchange_at(g, mu, r);
  assert_close(slides, gg_theory_sliding_fraction(g, mu, r), 1e-3);
  assert_close(x.translation, -4 * g.eta1 * (1 - g.eta1) - Jg / (1 + r / g.K) + JJ, 1e-3);
  assert_close(x.rotation, -r / g.K * Jg / (1 + r / g.K) + JJ / g.K, 2e-3);
}

/* The theory: same numbers under the shared names, cooling rate with zeta = -(dT/dt)/T. */
static void theory_answers(void **state)
{
  (void)state;
  gg_model m = model_for(GG_HCS, 0.2, 0.9, 0);
  gg_theory_answer a = answer_of(&gg_theory_huthmann_zippelius1997, &m);
  double lambda = a.value[GG_Q_TEMPERATURE_RATIO], K = 0.4, chi = m.chi[0];
  double tr = 5. / 12 * (1 - 0.81 + K / (1 + K) + K / pow(1 + K, 2) * (1 - lambda)) * chi;
  assert_close(a.value[GG_Q_COOLING_RATE], tr, 1e-12);
  assert_close(a.value[GG_Q_TEMPERATURE], 0.5, 0);
  assert_close(a.value[GG_Q_COMPRESSIBILITY], 1 + 2 * 1.9 * 0.2 * chi, 1e-14);
  assert_close(a.value[GG_Q_PRESSURE], m.stress_unit * m.density * 0.5 * a.value[GG_Q_COMPRESSIBILITY], 1e-14);
  m = model_for(GG_USF, 0.2, 0.9, 0);
  assert_close(value_of(&gg_theory_huthmann_zippelius1997, &m, GG_Q_TEMPERATURE_RATIO), 2. / 9, 1e-10);
  m = model_for(GG_HCS, 0.2, 0.9, -1);
  assert_refused(&gg_theory_huthmann_zippelius1997, &m, "smooth");
  gg_scene s = scene_of(GG_HCS, 0.2, 0.5, 0.4);
  for (int p = 0; p < GG_PAIRS; p++) s.collision.mu[p] = 0.01;
  m = model_of(&s);
  assert_refused(&gg_theory_huthmann_zippelius1997, &m, "no steady theta/T");
}

/* White noise balances contacts that all stick: if grains slide, the temperature is that at which their own loss
 * balances, not the given one. Monte Carlo (phi = 0.1, e = 0.9): 0.696(3), 0.668(2), 0.2989(7), 0.2435(6); if all
 * stick, or the heating is not noise, it is the given one. */
static void heated_by_noise(void **state)
{
  (void)state;
  const double mu[] = {0.05, 0.1, 0.1, 0.3}, beta[] = {0.5, 0, 1, 1}, T[] = {0.6946, 0.6667, 0.2977, 0.2427};
  for (int i = 0; i < 4; i++) {
    gg_scene s = scene_of(GG_HSS, 0.1, 0.9, beta[i]);
    s.thermostat = GG_WHITE_NOISE;
    gg_model sticks = model_of(&s);
    assert_close(value_of(&gg_theory_huthmann_zippelius1997, &sticks, GG_Q_TEMPERATURE), 0.5, 1e-12);
    for (int p = 0; p < GG_PAIRS; p++) s.collision.mu[p] = mu[i];
    gg_model m = model_of(&s);
    gg_theory_answer a = answer_of(&gg_theory_huthmann_zippelius1997, &m);
    assert_close(a.value[GG_Q_TEMPERATURE], T[i], 2e-4);
    assert_close(a.value[GG_Q_PRESSURE], m.stress_unit * m.density * T[i] * a.value[GG_Q_COMPRESSIBILITY], 2e-4);
    assert_close(a.value[GG_Q_COLLISION_RATE], gg_common_model_collision_rate(&m, T[i]), 1e-4);
    assert_close(a.value[GG_Q_ROTATIONAL_TEMPERATURE], T[i] * a.value[GG_Q_TEMPERATURE_RATIO], 2e-4);
    s.thermostat = GG_GAUSSIAN;
    m = model_of(&s);
    assert_close(value_of(&gg_theory_huthmann_zippelius1997, &m, GG_Q_TEMPERATURE), 0.5, 0);
  }
}

/* Transport of rough grains that cool: elastic and perfectly rough it is Pidduck's (heat flux, bulk viscosity:
 * Chapman & Cowling, 11.62); without the cooling term it is Lun's at the ratio of the cooling state, whose integrals
 * are independent; theta/T and zeta are those of Maxwellians. */
static void rough_viscosity(void **state)
{
  (void)state;
  const double K[] = {0.1, 0.4, 2. / 3};
  for (int i = 0; i < 3; i++) {
    gg_scene s = scene_of(GG_HCS, 0, 1, 1);
    s.species[0].inertia = K[i];
    gg_model m = model_of(&s);
    assert_close(value_of(&gg_theory_kremer_santos_garzo2014, &m, GG_Q_VISCOSITY_REDUCED),
                 6 * pow(1 + K[i], 2) / (6 + 13 * K[i]), 1e-9);
    gg_theory_answer a = answer_of(&gg_theory_kremer_santos_garzo2014, &m);
    double kappa0 = 75 / (64 * sqrt(M_PI)), k = K[i];
    assert_close(a.value[GG_Q_THERMAL_CONDUCTIVITY_REDUCED] + a.value[GG_Q_ROTATIONAL_CONDUCTIVITY_REDUCED],
                 9 / (16 * sqrt(M_PI)) / kappa0 * pow(1 + k, 2) * (37 + 151 * k + 50 * k * k) /
                     (12 + 75 * k + 101 * k * k + 102 * k * k * k),
                 1e-9);
    assert_close(a.value[GG_Q_BULK_VISCOSITY_REDUCED], pow(1 + k, 2) / (10 * k), 1e-9);
    assert_close(a.value[GG_Q_DIFFUSIVE_HEAT_CONDUCTIVITY_REDUCED], 0, 0);
    assert_true(isnan(a.value[GG_Q_HEAT_MODE_LENGTH]));
  }
  const double e[] = {0.95, 0.8, 0.6}, beta[] = {0.9, 0, -0.7};
  for (int i = 0; i < 3; i++) {
    gg_model m = model_for(GG_HCS, 0, e[i], beta[i]);
    gg_theory_answer a = answer_of(&gg_theory_kremer_santos_garzo2014, &m),
                     two = answer_of(&gg_theory_huthmann_zippelius1997, &m);
    double ratio = a.value[GG_Q_TEMPERATURE_RATIO], zeta = a.value[GG_Q_COOLING_RATE];
    gg_lun_state state_of_lun = {1, 0, 1, gg_theory_grain_of(&m), ratio};
    double lun = gg_theory_lun_functions_at(state_of_lun).f2 / (5. / 16 / sqrt(M_PI));
    assert_close(1 / a.value[GG_Q_VISCOSITY_REDUCED] + zeta / 2, 1 / lun, 1e-12);
    assert_close(ratio, two.value[GG_Q_TEMPERATURE_RATIO], 1e-12);
    assert_close(zeta, two.value[GG_Q_COOLING_RATE], 1e-12);
  }
  gg_model m = model_for(GG_HCS, 0, 0.9, -1);
  assert_refused(&gg_theory_kremer_santos_garzo2014, &m, "garzo_dufty1999");
  m = model_for(GG_HCS, 0.2, 0.9, 0);
  assert_refused(&gg_theory_kremer_santos_garzo2014, &m, "dilute");
  m = model_for(GG_USF, 0, 0.9, 0);
  assert_refused(&gg_theory_kremer_santos_garzo2014, &m, "free cooling");
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(cooling_ratio),
      cmocka_unit_test(rates_of_santos),
      cmocka_unit_test(perfectly_rough_elastic_grains_share_equally),
      cmocka_unit_test(friction_limits),
      cmocka_unit_test(friction_by_quadrature),
      cmocka_unit_test(theory_answers),
      cmocka_unit_test(rough_viscosity),
      cmocka_unit_test(heated_by_noise),
      cmocka_unit_test(nearly_smooth_ratios),
      cmocka_unit_test(strong_friction),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
