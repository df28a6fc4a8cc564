/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sonine deviation: speeds drawn from the first Sonine form give c and the polynomial; a Maxwellian has none; the
 * Monte Carlo engine cools freely with the cumulant of the literature. */
#include "curve_test.h"
#include "graingas.h"

#define C_PLANTED 0.15

static double polynomial(double x, const void *context)
{
  (void)context;
  double xx = x * x;
  return xx * xx / 2 - 2.5 * xx + 15.0 / 8;
}

static double excess(double x, const void *context)
{
  return *(const double *)context / 2 * polynomial(x, NULL);
}

/* Maxwellian speeds with acceptance 1 + (c/2) Delta, which is positive and below 6 where x < 4. */
static void planted(gg_snapshot *s, gg_rng *r, int sample)
{
  (void)sample;
  for (size_t i = 0; i < s->n; i++) {
    gg_vec v;
    double x2;
    do {
      v = gg_common_rng_normal_vec(r);
      x2 = gg_dot(v, v) / 2;
    } while (x2 > 16 || 8 * gg_rng_uniform(r) > 1 + C_PLANTED / 2 * polynomial(sqrt(x2), NULL));
    if (gg_snapshot_species(s, i)) v = gg_scale(0.4, gg_common_rng_normal_vec(r));
    s->c[0][i] = v.x, s->c[1][i] = v.y, s->c[2][i] = v.z;
  }
}

static void planted_form(void **state)
{
  (void)state;
  gg_model m = ct_model(GG_HCS, 0.1, -1, 20000, 1);
  gg_curves list = ct_curves(&gg_measure_sonine, &m, 48, planted, 41);
  const gg_curve *c = ct_find(&list, "sonine_excess");
  gg_curve_number p = ct_number(c, "c");
  ct_expect("c", p.value, p.error, C_PLANTED, 0.01);
  p = ct_number(c, "a3"); /* the forms are orthogonal */
  ct_expect("a3", p.value, p.error, 0, 0.01);
  double value = C_PLANTED, chi2 = ct_chi2(c, 4, 50, excess, &value);
  assert_true(chi2 > 0.3 && chi2 < 2.2);
  chi2 = ct_chi2(ct_find(&list, "sonine_deviation"), 4, 50, polynomial, NULL);
  assert_true(chi2 > 0.2 && chi2 < 2.2);
  c = ct_find(&list, "sonine_polynomial"); /* a line: up to its last point */
  for (size_t i = 0; i < c->n; i++) assert_true(fabs(c->value[i] - polynomial(c->x[i], NULL)) < 1e-10);
  assert_true(c->n >= 50);
  gg_measure_curves_clear(&list);
}

/* A fifth of the grains at T = 2, the others at T = 3/4: <T^2> = 1.25, <T^3> = 1.9375, so c = 0.5, a_3 = -0.1875. */
static void hot_and_cold(gg_snapshot *s, gg_rng *r, int sample)
{
  (void)sample;
  for (size_t i = 0; i < s->n; i++) {
    gg_vec v = gg_scale(sqrt(i % 5 ? 0.75 : 2), gg_common_rng_normal_vec(r));
    s->c[0][i] = v.x, s->c[1][i] = v.y, s->c[2][i] = v.z;
  }
}

static void planted_moments(void **state)
{
  (void)state;
  gg_model m = ct_model(GG_HCS, 0.1, -1, 20000, 1);
  gg_curves list = ct_curves(&gg_measure_sonine, &m, 64, hot_and_cold, 43);
  gg_curve_number c = ct_number(ct_find(&list, "sonine_excess"), "c");
  gg_curve_number a3 = ct_number(ct_find(&list, "sonine_excess"), "a3");
  ct_expect("c", c.value, c.error, 0.5, 0.02);
  ct_expect("a3", a3.value, a3.error, -0.1875, 0.03);
  gg_measure_curves_clear(&list);
}

/* Two species, the second Maxwellian: v* of each by its own lambda_i = T/(T_i mu_ji). */
static void each_species_has_its_own_scale(void **state)
{
  (void)state;
  gg_model m = ct_model(GG_HCS, 0.1, -1, 20000, 2);
  gg_curves list = ct_curves(&gg_measure_sonine, &m, 48, planted, 42);
  gg_curve_number p = ct_number(ct_find(&list, "sonine_excess_1"), "c");
  ct_expect("c_1", p.value, p.error, C_PLANTED, 0.02);
  p = ct_number(ct_find(&list, "sonine_excess_2"), "c");
  ct_expect("c_2", p.value, p.error, 0, 0.02);
  /* m_1 <C.C>_1/3 = 1, m_2 <C.C>_2/3 = 3 x 0.16; x_1 = 0.6: T = 0.792; mu_21 = 3/4, mu_12 = 1/4 */
  /* the second has no c as divisor */
  const gg_curve *with = ct_find(&list, "sonine_deviation_1"), *without = ct_find(&list, "sonine_deviation_2");
  assert_true(isfinite(with->value[20]) && isfinite(with->error[20]));
  for (size_t i = 0; i < without->n; i++) assert_true(isnan(without->value[i]) && isnan(without->error[i]));
  const gg_curve *one = ct_find(&list, "sonine_excess_1"), *two = ct_find(&list, "sonine_excess_2");
  assert_true(fabs(one->x[20] / (1.025 * sqrt(1 / 0.792 * 0.75)) - 1) < 0.005);
  assert_true(fabs(two->x[20] / (1.025 * sqrt(0.48 / 0.792 * 0.25)) - 1) < 0.005);
  gg_measure_curves_clear(&list);
}

static void gaussian(gg_snapshot *s, gg_rng *r, int sample)
{
  (void)sample;
  for (size_t i = 0; i < s->n; i++) {
    gg_vec v = gg_common_rng_normal_vec(r);
    s->c[0][i] = v.x, s->c[1][i] = v.y, s->c[2][i] = v.z;
  }
}

/* Nine Gaussian grains among 15: their <x^4>, in units of their own energy, is lower by 27/29, which is corrected. */
static void few_of_a_species(void **state)
{
  (void)state;
  gg_model m = ct_model(GG_EQUILIBRIUM, 0.01, -1, 15, 2);
  m.mass[1] = 1e6; /* absorbs all momentum: grains of species 1 are free */
  gg_curves list = ct_curves(&gg_measure_sonine, &m, 200000, gaussian, 44);
  gg_curve_number c = ct_number(ct_find(&list, "sonine_excess_1"), "c");
  gg_curve_number a3 = ct_number(ct_find(&list, "sonine_excess_1"), "a3");
  ct_expect("c_1 of few", c.value, c.error, 0, 0.02);
  ct_expect("a3_1 of few", a3.value, a3.error, 0, 0.02);
  gg_measure_curves_clear(&list);
}

/* Free cooling at e = 0.5: c = 2 a_2 = 0.0948(6) (Brey, Cubero & Ruiz-Montero 1996 and many since), and Delta
 * follows the first Sonine polynomial for most grains. */
static void cooling_gas_has_the_published_cumulant(void **state)
{
  (void)state;
  gg_scene s = gg_scene_defaults();
  s.engine = GG_DSMC, s.flow = GG_HCS, s.phi = 0, s.dsmc.particles = 20000;
  for (int q = 0; q < GG_PAIRS; q++) s.collision.e[q] = 0.5;
  s.run.collisions = 600;
  s.measure |= GG_MEASURE_SONINE;
  gg_result *r = ct_run(s);
  const gg_curve *c = ct_find(&r->curves, "sonine_excess");
  gg_curve_number p = ct_number(c, "c");
  ct_expect("c in free cooling", p.value, hypot(p.error, 0.0006), 0.0948, 0.012);
  gg_curve_number a3 = ct_number(c, "a3");
  print_message("# a3 in free cooling %.5f +- %.5f\n", a3.value, a3.error);
  assert_true(a3.value < -4 * a3.error && a3.value > -0.03); /* negative below e = 0.7, and smaller than a_2 */
  assert_true(fabs(p.value / 2 - r->value[GG_Q_A2].mean) < 4 * hypot(p.error / 2, r->value[GG_Q_A2].error));
  for (int i = 4; i < 8; i++) assert_true(c->value[i] > 0.5 * excess(c->x[i], &p.value));
  for (int i = 26; i < 30; i++) assert_true(c->value[i] < 0.5 * excess(c->x[i], &p.value));
  gg_result_free(r);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(planted_form),
      cmocka_unit_test(planted_moments),
      cmocka_unit_test(each_species_has_its_own_scale),
      cmocka_unit_test(few_of_a_species),
      cmocka_unit_test(cooling_gas_has_the_published_cumulant),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
