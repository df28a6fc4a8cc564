/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Distributions and tails: fits on exact counts and on drawn samples give the planted exponents; a Gaussian gas has
 * no deviation; an elastic engine has alpha = 2, a sheared inelastic one does not. */
#include "curve_test.h"
#include "measure/stretched_tail.h"
#include "graingas.h"

#include <stdio.h>

/* Counts of exp(-gamma x^alpha), integrated finely over each bin: maximum likelihood gives the law to 1e-6, least
 * squares on bin centres to the width of the bins. */
static void exact_tail(void **state)
{
  (void)state;
  const double law[][2] = {{2, 0.5}, {1.5, 0.8}, {1, 1.3}, {2.3, 0.4}};
  for (int k = 0; k < 4; k++) {
    double counts[30], alpha = law[k][0], gamma = law[k][1];
    for (int i = 0; i < 30; i++) {
      counts[i] = 0;
      for (int j = 0; j < 200; j++)
        counts[i] += 1e9 / 200 * exp(-gamma * pow(1.5 + (i + (j + 0.5) / 200) * 0.1, alpha));
    }
    gg_stretched_tail_data data = {counts, 30, 1.5, 0.1, 1e9};
    gg_stretched_tail least = gg_measure_stretched_tail_double_log(&data),
                      likely = gg_measure_stretched_tail_likelihood(&data);
    assert_true(fabs(likely.alpha - alpha) < 1e-5 && fabs(likely.gamma - gamma) < 1e-5);
    assert_true(fabs(least.alpha - alpha) < 2e-3 && fabs(least.gamma - gamma) < 2e-3);
  }
}

static void gaussian(gg_snapshot *s, gg_rng *r, int sample)
{
  (void)sample;
  for (size_t i = 0; i < s->n; i++)
    for (int a = 0; a < 3; a++) {
      s->c[a][i] = (a + 1) * gg_common_rng_normal(r);
      if (s->s[a]) s->s[a][i] = 0.4 * gg_common_rng_normal(r) - 3 * (a == 2);
    }
}

static double none(double x, const void *context)
{
  (void)x, (void)context;
  return 0;
}

/* Gaussian grains of any width and mean: alpha = 2, gamma = 1/2 from both fits, and no deviation at low velocity. */
static void gaussian_grains(void **state)
{
  (void)state;
  gg_model m = ct_model(GG_HCS, 0.1, 0, 20000, 1);
  gg_curves list = ct_curves(&gg_measure_velocity_distributions, &m, 64, gaussian, 21);
  const char *names[] = {"Cx", "Cz", "Wz"};
  for (int k = 0; k < 3; k++) {
    char name[64];
    snprintf(name, sizeof name, "velocity_distribution_%s", names[k]);
    const gg_curve *c = ct_find(&list, name);
    assert_true(fabs(c->value[c->n / 2] - 1) < 0.02); /* P(0) = 1 */
    const struct {
      const char *name;
      double expected;
    } numbers[] = {{"alpha", 2},       {"alpha_likelihood", 2}, {"gamma", 0.5}, {"gamma_likelihood", 0.5},
                   {"alpha_2_4.5", 2}, {"gamma_2_4.5", 0.5}};
    for (int i = 0; i < 6; i++) {
      gg_curve_number p = ct_number(c, numbers[i].name);
      ct_expect(numbers[i].name, p.value, p.error, numbers[i].expected, 0.06);
    }
    snprintf(name, sizeof name, "velocity_deviation_%s", names[k]);
    double chi2 = ct_chi2(ct_find(&list, name), 0, 100, none, NULL);
    assert_true(chi2 < 2.2 && chi2 > 0.3);
  }
  gg_measure_curves_clear(&list);
}

/* Two-sided exp(-|x|^2.5) by rejection; species 2 Gaussian. */
static void stretched(gg_snapshot *s, gg_rng *r, int sample)
{
  gaussian(s, r, sample);
  for (size_t i = 0; i < s->n; i++) {
    if (gg_snapshot_species(s, i)) continue;
    double x;
    do x = 7 * gg_rng_uniform(r) - 3.5;
    while (gg_rng_uniform(r) > exp(-pow(fabs(x), 2.5)));
    s->c[1][i] = 2 * x;
  }
}

/* A stretched exponential planted in one component of one species is found there and only there. sigma^2 of
 * exp(-|x|^2.5) is Gamma(3/2.5)/Gamma(1/2.5), so gamma = sigma^2.5. */
static void stretched_grains(void **state)
{
  (void)state;
  gg_model m = ct_model(GG_HCS, 0.1, -1, 20000, 2);
  gg_curves list = ct_curves(&gg_measure_velocity_distributions, &m, 128, stretched, 22);
  const gg_curve *y1 = ct_find(&list, "velocity_distribution_Cy_1"), *y2 = ct_find(&list, "velocity_distribution_Cy_2");
  gg_curve_number p = ct_number(y1, "alpha_likelihood");
  ct_expect("alpha of species 1", p.value, p.error, 2.5, 0.1);
  p = ct_number(y1, "gamma");
  ct_expect("gamma of species 1", p.value, p.error, pow(tgamma(1.2) / tgamma(0.4), 1.25), 0.03);
  p = ct_number(y2, "alpha");
  ct_expect("alpha of species 2", p.value, p.error, 2, 0.08);
  gg_measure_curves_clear(&list);
}

static gg_result *engine(double e)
{
  gg_scene s = gg_scene_defaults();
  s.engine = GG_DSMC, s.flow = e == 1 ? GG_EQUILIBRIUM : GG_USF, s.phi = 0.01;
  for (int p = 0; p < GG_PAIRS; p++) s.collision.e[p] = e;
  s.run.collisions = 1200, s.dsmc.particles = 5000;
  s.measure |= GG_MEASURE_VELOCITY_DISTRIBUTIONS;
  return ct_run(s);
}

/* The Monte Carlo engine in equilibrium: alpha = 2; sheared at e = 0.7: tails above a Gaussian's, alpha < 2. */
static void only_inelastic_shear_has_long_tails(void **state)
{
  (void)state;
  gg_result *elastic = engine(1), *sheared = engine(0.7);
  gg_curve_number p = ct_number(ct_find(&elastic->curves, "velocity_distribution_Cx"), "alpha");
  ct_expect("alpha in equilibrium", p.value, p.error, 2, 0.06);
  p = ct_number(ct_find(&sheared->curves, "velocity_distribution_Cx"), "alpha");
  print_message("# sheared: alpha = %.4f +- %.4f\n", p.value, p.error);
  assert_true(p.value < 2 - 4 * p.error && p.value > 1.2);
  gg_result_free(elastic);
  gg_result_free(sheared);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(exact_tail),
      cmocka_unit_test(gaussian_grains),
      cmocka_unit_test(stretched_grains),
      cmocka_unit_test(only_inelastic_shear_has_long_tails),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
