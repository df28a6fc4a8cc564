/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Escape of fast spins from friction in free cooling: the rate against counts of Monte Carlo (validation/escape), its
 * limits, and a theory that answers or rejects by it. */
#include "theory_test.h"

#include "theory/spin_escape.h"

static gg_model gas(double e, double beta, double mu, double phi)
{
  gg_scene s = scene_of(GG_HCS, phi, e, beta);
  for (int p = 0; p < GG_PAIRS; p++) s.collision.mu[p] = mu;
  return model_of(&s);
}

/* Grains beyond four times the spin s* at which friction balances the growth, counted in dsmc. */
static void rates_of_monte_carlo(void **state)
{
  (void)state;
  static const struct {
    double e, beta, mu, counted;
  } gases[] = {{0.7, 0, 0.5, 2.24e-4},   {0.75, 0, 0.5, 7.8e-5},   {0.8, 0, 0.5, 1.63e-5},
               {0.8, 0.5, 0.5, 6.96e-6}, {0.85, 0.3, 0.4, 8.8e-6}, {0.9, 0, 0.5, 6.7e-8},
               {0.9, 0, 0.3, 3.95e-6},   {0.9, 0, 0.2, 3.75e-5},   {0.95, 0, 0.1, 3.6e-6}};
  for (size_t k = 0; k < sizeof gases / sizeof *gases; k++) {
    gg_model m = gas(gases[k].e, gases[k].beta, gases[k].mu, 0);
    const double rate = gg_theory_spin_escape(&m), ratio = rate / gases[k].counted;
    print_message("# e %g beta %g mu %g: %.3g, counted %.3g: %.2f\n", gases[k].e, gases[k].beta, gases[k].mu, rate,
                  gases[k].counted, ratio);
    assert_true(ratio > 0.5 && ratio < 2);
  }
}

/* The rate is per collision: the density does not enter. No grain escapes from strong friction, none from constant
 * beta; where theta/T has no steady value there is no rate. */
static void the_rate_of_escape_has_its_limits(void **state)
{
  (void)state;
  gg_model dilute = gas(0.8, 0, 0.5, 0), dense = gas(0.8, 0, 0.5, 0.3);
  assert_close(gg_theory_spin_escape(&dense), gg_theory_spin_escape(&dilute), 1e-9);
  gg_model strong = gas(0.8, 0, 5, 0), weak = gas(0.7, 0, 0.05, 0), constant = model_for(GG_HCS, 0, 0.8, 0);
  assert_true(gg_theory_spin_escape(&strong) < 1e-15);
  assert_true(isnan(gg_theory_spin_escape(&weak)));
  assert_false(gg_theory_is_metastable(&constant));
  assert_true(isnan(gg_theory_spin_escape(&constant)));
  gg_model heated = dilute;
  heated.flow = GG_HSS;
  assert_false(gg_theory_is_metastable(&heated));
  double last = 1; /* fewer escape the stronger friction is, and the nearer e is to 1 */
  for (double mu = 0.15; mu < 1.3; mu *= 1.5) {
    gg_model m = gas(0.9, 0, mu, 0);
    assert_true(gg_theory_spin_escape(&m) < last);
    last = gg_theory_spin_escape(&m);
  }
  last = 1;
  for (double e = 0.7; e < 0.99; e += 0.05) {
    gg_model m = gas(e, 0, 0.5, 0);
    assert_true(gg_theory_spin_escape(&m) < last);
    last = gg_theory_spin_escape(&m);
  }
}

/* A theory answers for the metastable state, with a remark, where grains seldom escape; elsewhere it rejects. */
static void theories_answer_metastable_gases_with_a_remark(void **state)
{
  (void)state;
  const gg_theory *theory = &gg_theory_huthmann_zippelius1997;
  gg_model lasting = gas(0.9, 0, 0.5, 0.1), brief = gas(0.8, 0, 0.5, 0.1);
  assert_close(value_of(theory, &lasting, GG_Q_TEMPERATURE_RATIO), 0.5256, 0.06); /* Monte Carlo; 5 % high */
  assert_non_null(strstr(gg_theory_beyond(theory, &lasting), "metastable"));
  assert_refused(theory, &brief, "escape friction");
  brief.flow = lasting.flow = GG_HSS;
  assert_true(isfinite(value_of(theory, &brief, GG_Q_TEMPERATURE_RATIO)));
  assert_null(gg_theory_beyond_metastable(&lasting));
}

int main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test(rates_of_monte_carlo),
                                     cmocka_unit_test(the_rate_of_escape_has_its_limits),
                                     cmocka_unit_test(theories_answer_metastable_gases_with_a_remark)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
