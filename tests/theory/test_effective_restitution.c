/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Theories of sheared frictional grains with an effective restitution. Smooth grains are limits known from other
 * theories; the effective restitution of Jenkins & Zhang is computed again by quadrature over contact velocities, and
 * compared with what an independent program has printed; the functions of extended kinetic theory stand here as the
 * paper has them. */
#include "theory_test.h"

#include "theory/jenkins_zhang2002.h"

static gg_model frictional(double phi, double e, double beta, double mu)
{
  gg_scene s = scene_of(GG_USF, phi, e, beta);
  for (int p = 0; p < GG_PAIRS; p++) s.collision.mu[p] = mu;
  return model_of(&s);
}

static gg_effective_restitution effective(double e, double beta, double mu, double K)
{
  return gg_theory_jenkins_zhang((gg_grain){(1 + e) / 2, (1 + beta) * K / (2 * (1 + K)), K}, mu);
}

/* Little friction: e - (pi/2) mu + (2 + 1/K) mu^2 and theta/T = (4/pi) mu, whatever e and beta. */
static void little_friction(void **state)
{
  (void)state;
  const double mu = 1e-4;
  for (double K = 0.4; K < 0.7; K += 0.2)
    for (double beta = -0.5; beta <= 1; beta += 0.5) {
      const gg_effective_restitution found = effective(0.9, beta, mu, K);
      assert_close(0.9 - found.e, M_PI_2 * mu - (2 + 1 / K) * mu * mu, 2e-7);
      assert_close(found.ratio, 4 / M_PI * mu, 2e-3);
    }
}

/* Means over contacts of two Maxwellians with theta/T = r, for J = min(q g_t, mu g_n), g = rho (cos psi, s sin psi):
 * <J g> and <J J>, where <rho^2> = 8. */
static void contact_means(double q, double mu, double r, double K, double *Jg, double *JJ)
{
  const int n = 200000;
  const double s = sqrt(1 + r / K);
  *Jg = *JJ = 0;
  for (int i = 0; i < n; i++) {
    const double psi = M_PI_2 * (i + 0.5) / n, g = s * sin(psi), J = fmin(q * g, mu * cos(psi));
    const double weight = 16 * M_PI_2 / n * cos(psi) * sin(psi);
    *Jg += weight * J * g, *JJ += weight * J * J;
  }
}

/* Energy that translation loses by friction, <J g>/(1 + r/K) - <J J>, to first order in r but with <J J> at r = 0, and
 * the r at which rotation gains as much as it loses. */
static void the_effective_restitution_is_the_exchange_of_two_maxwellians(void **state)
{
  (void)state;
  const double e[] = {0.95, 0.7, 0.9}, beta[] = {0.3, 0, 1}, mu[] = {0.1, 0.5, 2}, K[] = {0.4, 0.4, 0.6}, h = 1e-3;
  for (int i = 0; i < 3; i++) {
    const double q = (1 + beta[i]) * K[i] / ((1 + K[i]) * (1 + e[i]));
    double Jg, JJ, more, less, other;
    contact_means(q, mu[i], 0, K[i], &Jg, &JJ);
    contact_means(q, mu[i], h, K[i], &more, &other);
    contact_means(q, mu[i], -h, K[i], &less, &other);
    const double slope = (more / (1 + h / K[i]) - less / (1 - h / K[i])) / (2 * h), ratio = JJ / Jg;
    const gg_effective_restitution found = effective(e[i], beta[i], mu[i], K[i]);
    assert_close(found.ratio, ratio, 1e-8);
    assert_close(e[i] - found.e, (Jg - JJ + slope * ratio) / 2, 1e-5);
  }
}

static void smooth_grains_are_lun1991(void **state)
{
  (void)state;
  for (double phi = 0; phi < 0.6; phi += 0.15) {
    const gg_model smooth = model_for(GG_USF, phi, 0.9, -1), nearly = frictional(phi, 0.9, 0, 1e-8);
    const gg_theory_answer lun = answer_of(&gg_theory_lun1991, &smooth),
                           same = answer_of(&gg_theory_jenkins_zhang2002, &smooth),
                           limit = answer_of(&gg_theory_jenkins_zhang2002, &nearly);
    const gg_quantity compared[] = {GG_Q_TEMPERATURE, GG_Q_PRESSURE, GG_Q_P_XY, GG_Q_COLLISION_RATE, GG_Q_DISSIPATION};
    for (int i = 0; i < 5; i++) {
      assert_close(same.value[compared[i]], lun.value[compared[i]], 1e-13);
      assert_close(limit.value[compared[i]], lun.value[compared[i]], 1e-6);
    }
  }
}

/* Deviations of T, P_xy and theta/T from Monte Carlo in per cent, that another program has found and rounded. */
static void an_independent_program_has_the_same_deviations(void **state)
{
  (void)state;
  static const struct {
    double phi, e, mu, T, shear, ratio; /* beta = 0; Monte Carlo */
    double off_T, off_shear, off_ratio; /* per cent */
  } known[] = {
      {0, 0.9, 0.01, 0.20059, 0.071144, 0.01245, 14, 19, 2},  {0, 0.9, 0.1, 0.09527, 0.044746, 0.109225, 35, 42, -12},
      {0, 0.9, 1, 0.051631, 0.02783, 0.224317, 67, 87, -33},  {0.1, 0.7, 0.1, 1.1228, 0.09016, 0.112273, 58, 53, -11},
      {0.3, 0.9, 0.1, 0.5523, 0.30413, 0.11847, 8, -12, -19}, {0.5, 0.9, 0.1, 0.40195, 1.2969, 0.11923, 8, -13, -20}};
  for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
    const gg_model m = frictional(known[i].phi, known[i].e, 0, known[i].mu);
    const gg_theory_answer a = answer_of(&gg_theory_jenkins_zhang2002, &m);
    assert_true(fabs(100 * (a.value[GG_Q_TEMPERATURE] / known[i].T - 1) - known[i].off_T) < 0.55);
    assert_true(fabs(100 * (-a.value[GG_Q_P_XY] / known[i].shear - 1) - known[i].off_shear) < 0.55);
    assert_true(fabs(100 * (a.value[GG_Q_TEMPERATURE_RATIO] / known[i].ratio - 1) - known[i].off_ratio) < 0.55);
  }
}

/* Extended kinetic theory as the paper writes it, with rho_p = d = rate = 1; L from its own condition. */
static void extended_theory_has_its_printed_functions(void **state)
{
  (void)state;
  for (double phi = 0.05; phi < 0.6; phi += 0.1) /* the last has L > 1 */
    for (double e = 0.5; e < 1; e += 0.2) {
      const gg_model m = frictional(phi, e, 0, 0.01);
      const double G = phi * m.chi[0], ef = effective(e, 0, 0.01, 0.4).e, F = (1 + e) / 2 + 1 / (4 * G), u = 1 - e;
      const double J = (1 + e) / 2 + M_PI / 32 * (5 + 2 * (1 + e) * (3 * e - 1) * G) * (5 + 4 * (1 + e) * G) /
                                         ((24 - 6 * u * u - 5 * (1 - e * e)) * G * G);
      const double dense = 1 + 26 * (1 - ef) / 15 * fmax(0, (phi - 0.49) / (0.64 - phi));
      const double f0 = sqrt(2 * J / (15 * (1 - ef * ef))) * pow(dense, 1.5);
      const double viscosity = 8 * J * phi * G / (5 * sqrt(M_PI)), loss = 12 / sqrt(M_PI) * phi * G * (1 - ef * ef);
      const gg_theory_answer a = answer_of(&gg_theory_vescovi2014, &m);
      const double T = a.value[GG_Q_TEMPERATURE], L = fmax(1, f0 / sqrt(T));
      assert_close(viscosity * sqrt(T), loss * pow(T, 1.5) / L, 1e-12);
      assert_close(L, dense, 1e-12);
      assert_close(a.value[GG_Q_PRESSURE], 4 * phi * G * F * T, 1e-12);
      assert_close(a.value[GG_Q_P_XY], -viscosity * sqrt(T), 1e-12);
    }
}

/* The viscosity at e^2 = 1/2, where a_2 vanishes, is that of Garzo & Dufty 1999. */
static void the_viscosity_is_that_of_garzo_and_dufty(void **state)
{
  (void)state;
  for (double phi = 0; phi < 0.5; phi += 0.12) {
    const gg_model m = model_for(GG_USF, phi, sqrt(0.5), -1), cooling = model_for(GG_HCS, phi, sqrt(0.5), -1);
    const gg_theory_answer a = answer_of(&gg_theory_vescovi2014, &m);
    const double T = a.value[GG_Q_TEMPERATURE], eta0 = m.stress_unit * m.density * T / gg_common_model_nu0(&m, T);
    assert_close(a.value[GG_Q_SHEAR_VISCOSITY] / eta0,
                 value_of(&gg_theory_garzo_dufty1999, &cooling, GG_Q_VISCOSITY_REDUCED), 1e-12);
  }
}

/* Friction acts through e_eff alone, which is least at mu = 1/3: e - 1/(2 exp(1)). Dense grains have a least T. */
static void chialvo_sundaresan_has_its_fits(void **state)
{
  (void)state;
  const gg_model smooth = model_for(GG_USF, 0.3, 0.8, -1), rubbing = frictional(0.3, 0.8, 0, 1 / 3.);
  const gg_theory_answer a = answer_of(&gg_theory_chialvo_sundaresan2013, &smooth),
                         b = answer_of(&gg_theory_chialvo_sundaresan2013, &rubbing);
  const double e = 0.8 - 0.18393972058572117;
  assert_close(a.value[GG_Q_TEMPERATURE], value_of(&gg_theory_vescovi2014, &smooth, GG_Q_TEMPERATURE), 1e-13);
  assert_close(a.value[GG_Q_P_XY], value_of(&gg_theory_vescovi2014, &smooth, GG_Q_P_XY), 1e-13);
  assert_close(b.value[GG_Q_TEMPERATURE] / a.value[GG_Q_TEMPERATURE], (1 - 0.64) / (1 - e * e), 1e-12);
  assert_close(b.value[GG_Q_COMPRESSIBILITY], a.value[GG_Q_COMPRESSIBILITY], 1e-13);
  assert_true(isnan(b.value[GG_Q_P_XY]) && isnan(b.value[GG_Q_TEMPERATURE_RATIO]));
  gg_model dense = model_for(GG_USF, 0.58, 0.5, -1);
  assert_close(value_of(&gg_theory_chialvo_sundaresan2013, &dense, GG_Q_TEMPERATURE), 0.06 / sqrt(0.056), 1e-12);
  dense = frictional(0.54, 0.7, 0, 0.1);
  assert_refused(&gg_theory_chialvo_sundaresan2013, &dense, "critical density");
}

static void grains_outside_are_rejected(void **state)
{
  (void)state;
  const gg_theory *const theories[] = {&gg_theory_jenkins_zhang2002, &gg_theory_vescovi2014,
                                       &gg_theory_chialvo_sundaresan2013};
  const gg_model rough = model_for(GG_USF, 0.3, 0.9, 0), lossy = frictional(0.3, 0.05, 0, 0.3),
                 elastic = model_for(GG_USF, 0.3, 1, -1), mixture = mixture_for(GG_USF, 0.3, 0.9, -1, 2, 1, 1);
  for (int i = 0; i < 3; i++) {
    assert_refused(theories[i], &rough, "constant beta");
    assert_refused(theories[i], &lossy, "friction costs more");
    assert_refused(theories[i], &elastic, "heats up");
    assert_refused(theories[i], &mixture, "one species");
  }
  const gg_model made_for = frictional(0.3, 0.98, 1, 0.05), beyond = frictional(0.3, 0.98, 0, 0.5);
  const gg_model dissipative = model_for(GG_USF, 0.3, 0.8, -1);
  for (int i = 0; i < 3; i++) {
    assert_null(gg_theory_beyond(theories[i], &made_for));
    assert_non_null(gg_theory_beyond(theories[i], &beyond));
    assert_non_null(gg_theory_beyond(theories[i], &dissipative));
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(little_friction),
      cmocka_unit_test(the_effective_restitution_is_the_exchange_of_two_maxwellians),
      cmocka_unit_test(smooth_grains_are_lun1991),
      cmocka_unit_test(an_independent_program_has_the_same_deviations),
      cmocka_unit_test(extended_theory_has_its_printed_functions),
      cmocka_unit_test(the_viscosity_is_that_of_garzo_and_dufty),
      cmocka_unit_test(chialvo_sundaresan_has_its_fits),
      cmocka_unit_test(grains_outside_are_rejected),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
