/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Distributions by local density: Gaussian grains with any cell flow are Gaussian at every density, at one
 * temperature; grains that are colder and of another law in dense regions are found there and only there, and all
 * cells together are the mixture; an elastic gas of rough hard spheres has one Maxwellian at every density, and a
 * sheared inelastic one is colder where it is dense. */
#include <stdio.h>

#include "curve_test.h"
#include "graingas.h"

static void scatter(gg_snapshot *s, gg_rng *r)
{
  const double *L = s->model->box;
  for (size_t i = 0; i < s->n; i++)
    for (int a = 0; a < 3; a++) {
      s->r[a][i] = L[a] * gg_rng_uniform(r);
      s->c[a][i] = gg_common_rng_normal(r) / sqrt(s->model->mass[gg_snapshot_species(s, i)]);
      if (s->s[a]) s->s[a][i] = gg_common_rng_normal(r) - 5;
    }
}

/* Uniform places; another flow velocity in every cell. */
static void gaussian(gg_snapshot *s, gg_rng *r, int sample)
{
  (void)sample;
  scatter(s, r);
  int cells = (int)fmax(3, round(s->model->box[0] / cbrt(8 * s->model->volume / (double)s->n)));
  for (size_t i = 0; i < s->n; i++) s->c[0][i] += 3 * floor(s->r[0][i] / s->model->box[0] * cells);
}

static const char *const classes[] = {"0.5", "0.75", "1", "1.25", "1.5", "all"};

static void expect_number(const gg_curves *list, const char *name, const char *number, double expected, double sight)
{
  gg_curve_number p = ct_number(ct_find(list, name), number);
  ct_expect(number, p.value, p.error, expected, sight);
}

/* Grains of two sizes that rotate at one mean rate. */
static void turning(gg_snapshot *s, gg_rng *r, int sample)
{
  gaussian(s, r, sample);
  for (size_t i = 0; i < s->n; i++)
    for (int a = 0; a < 3; a++)
      s->s[a][i] = s->model->diameter[gg_snapshot_species(s, i)] / 2 * (gg_common_rng_normal(r) - 4);
}

/* Omega is about the mean omega of a cell, for any grains in it. */
static void two_sizes(void **state)
{
  (void)state;
  gg_model m = ct_model(GG_HCS, 0.1, 0, 4096, 2);
  gg_curves list = ct_curves(&gg_measure_local_distributions, &m, 128, turning, 75);
  for (int k = 1; k <= 2; k++) {
    char name[64];
    double mean = 0, all = 0;
    snprintf(name, sizeof name, "local_distribution_Wz_%d_all", k);
    const gg_curve *c = ct_find(&list, name);
    for (size_t i = 0; i < c->n; i++) mean += c->value[i] * c->x[i], all += c->value[i];
    print_message("# mean Omega_z of species %d over sigma: %.5f\n", k, mean / all);
    assert_true(fabs(mean / all) < 0.01);
    expect_number(&list, name, "skewness", 0, 0.05);
  }
  gg_measure_curves_clear(&list);
}

static void gaussian_cells(void **state)
{
  (void)state;
  gg_model m = ct_model(GG_HCS, 0.1, 0, 4096, 1);
  gg_curves list = ct_curves(&gg_measure_local_distributions, &m, 640, gaussian, 71);
  for (int k = 0; k < 6; k++) {
    char name[64];
    snprintf(name, sizeof name, "local_distribution_Cx_%s", classes[k]);
    expect_number(&list, name, "kurtosis", 3, 0.15);
    expect_number(&list, name, "skewness", 0, 0.08);
    expect_number(&list, name, "temperature_over_mean", 1, 0.03);
    snprintf(name, sizeof name, "local_distribution_Wz_%s", classes[k]);
    expect_number(&list, name, "temperature_over_mean", 1, 0.03);
    if (k == 2) expect_number(&list, name, "alpha", 2, 0.15);
  }
  gg_measure_curves_clear(&list);
}

/* Two species of unlike mass and spin at one temperature: each has its own sigma. */
static void mixed_cells(void **state)
{
  (void)state;
  gg_model m = ct_model(GG_HCS, 0.1, -1, 4096, 2);
  gg_curves list = ct_curves(&gg_measure_local_distributions, &m, 256, gaussian, 73);
  for (int k = 0; k < 2; k++) {
    char name[64];
    snprintf(name, sizeof name, "local_distribution_Cx_%d_1", k + 1);
    expect_number(&list, name, "kurtosis", 3, 0.2);
    expect_number(&list, name, "temperature_over_mean", 1, 0.04);
  }
  gg_measure_curves_clear(&list);
}

/* The left half of the box has three of four grains, and those are +-1/2 along x instead of Gaussian. */
static void two_halves(gg_snapshot *s, gg_rng *r, int sample)
{
  (void)sample;
  scatter(s, r);
  for (size_t i = 0; i < s->n; i++) {
    bool dense = gg_rng_uniform(r) < 0.75;
    s->r[0][i] = s->model->box[0] * (0.5 * gg_rng_uniform(r) + (dense ? 0 : 0.5));
    if (dense) s->c[0][i] = gg_rng_uniform(r) < 0.5 ? 0.5 : -0.5;
  }
}

static void planted_halves(void **state)
{
  (void)state;
  gg_model m = ct_model(GG_HCS, 0.1, -1, 4096, 1);
  gg_curves list = ct_curves(&gg_measure_local_distributions, &m, 64, two_halves, 72);
  const gg_curve *thin = ct_find(&list, "local_distribution_Cx_0.5"),
                 *dense = ct_find(&list, "local_distribution_Cx_1.5");
  gg_curve_number p = ct_number(thin, "kurtosis"), q = ct_number(dense, "kurtosis");
  /* Three of four grains have the variance 1/4, the others 1. */
  double all = (0.75 * q.value / 16 + 0.25 * 3) / pow(0.75 / 4 + 0.25, 2);
  expect_number(&list, "local_distribution_Cx_all", "kurtosis", all, 0.15);
  gg_curve_number warmth = ct_number(ct_find(&list, "local_distribution_Cx_all"), "temperature_over_mean");
  assert_true(fabs(warmth.value - 1) < 1e-12 && warmth.error < 1e-12); /* for all cells both are rounding */
  print_message("# kurtosis thin %.3f +- %.3f, dense %.3f +- %.3f\n", p.value, p.error, q.value, q.error);
  assert_true(fabs(p.value - 3) < 4 * p.error + 0.05 && q.value < 1.8); /* for +-1/2: 1, and 3 in thin cells */
  p = ct_number(thin, "temperature_over_mean"), q = ct_number(dense, "temperature_over_mean");
  print_message("# warmth, thin over dense %.3f\n", p.value / q.value);
  assert_true(fabs(p.value / q.value - 4) < 0.15); /* a few cells of the dense half are as thin as those */
  gg_measure_curves_clear(&list);
}

/* Classes given as solid fractions are the same classes under other names. */
static void given_densities(void **state)
{
  (void)state;
  static const double phi[] = {0.15, 0.05, 0.1};
  static const char *const same[][2] = {{"phi_0.15", "1.5"}, {"phi_0.05", "0.5"}, {"phi_0.1", "1"}, {"all", "all"}};
  gg_model m = ct_model(GG_HCS, 0.1, -1, 4096, 1);
  gg_curves usual = ct_curves(&gg_measure_local_distributions, &m, 8, two_halves, 72);
  memcpy(m.local_density, phi, sizeof phi);
  gg_curves given = ct_curves(&gg_measure_local_distributions, &m, 8, two_halves, 72);
  assert_int_equal(given.n, 4);
  for (int k = 0; k < 4; k++) {
    char name[2][64];
    for (int i = 0; i < 2; i++) snprintf(name[i], sizeof name[i], "local_distribution_Cx_%s", same[k][i]);
    const gg_curve *one = ct_find(&given, name[0]), *other = ct_find(&usual, name[1]);
    assert_memory_equal(one->value, other->value, one->n * sizeof *one->value);
    assert_true(ct_number(one, "solid_fraction").value == (k < 3 ? phi[k] : 0.1));
  }
  gg_measure_curves_clear(&usual);
  gg_measure_curves_clear(&given);
}

static gg_result *engine(double e, double phi)
{
  gg_scene s = gg_scene_defaults();
  s.engine = GG_MD, s.flow = e == 1 ? GG_EQUILIBRIUM : GG_USF, s.phi = phi, s.particles = 1000;
  for (int p = 0; p < GG_PAIRS; p++) s.collision.e[p] = e, s.collision.beta[p] = e == 1 ? 1 : -1;
  s.run.collisions = e == 1 ? 2500 : 6000;
  s.measure |= GG_MEASURE_LOCAL_DISTRIBUTIONS;
  return ct_run(s);
}

static void elastic_grains_have_one_maxwellian_at_every_density(void **state)
{
  (void)state;
  gg_result *elastic = engine(1, 0.2);
  for (int k = 1; k < 4; k++) {
    char name[64];
    snprintf(name, sizeof name, "local_distribution_Cx_%s", classes[k]);
    expect_number(&elastic->curves, name, "kurtosis", 3, 0.2);
    expect_number(&elastic->curves, name, "temperature_over_mean", 1, 0.05);
    snprintf(name, sizeof name, "local_distribution_Wz_%s", classes[k]);
    expect_number(&elastic->curves, name, "kurtosis", 3, 0.2);
  }
  gg_result_free(elastic);
  gg_result *sheared = engine(0.7, 0.2);
  gg_curve_number thin = ct_number(ct_find(&sheared->curves, "local_distribution_Cx_0.5"), "temperature_over_mean");
  gg_curve_number dense = ct_number(ct_find(&sheared->curves, "local_distribution_Cx_1.5"), "temperature_over_mean");
  print_message("# T thin %.4f +- %.4f, dense %.4f +- %.4f\n", thin.value, thin.error, dense.value, dense.error);
  assert_true(thin.value - dense.value > 4 * hypot(thin.error, dense.error));
  gg_result_free(sheared);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(gaussian_cells),  cmocka_unit_test(mixed_cells),
      cmocka_unit_test(two_sizes),       cmocka_unit_test(planted_halves),
      cmocka_unit_test(given_densities), cmocka_unit_test(elastic_grains_have_one_maxwellian_at_every_density),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
