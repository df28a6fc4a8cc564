/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Distributions by height between walls: planted laws, variances and skewness are recovered slab by slab; for walls
 * that are alike a slab and its image are one, each component with its own sign; free molecules between a hot and a
 * cold wall have the moments of two half Maxwellians at every height. */
#include <stdio.h>

#include "curve_test.h"
#include "measure/wall_modes.h"
#include "graingas.h"

enum { SLABS = 6 };

static void expect(const gg_curves *list, const char *component, int slab, const char *number, double expected,
                   double sight)
{
  char name[64];
  snprintf(name, sizeof name, "slab_distribution_%s_%d", component, slab + 1);
  const gg_curve_number p = ct_number(ct_find(list, name), number);
  ct_expect(name, p.value, p.error, expected, sight);
}

static int slab_of(const gg_snapshot *s, size_t i)
{
  return (int)floor(s->r[1][i] / s->model->box[1] * SLABS);
}

static void place(gg_snapshot *s, gg_rng *r)
{
  for (size_t i = 0; i < s->n; i++)
    for (int a = 0; a < 3; a++) s->r[a][i] = s->model->box[a] * gg_rng_uniform(r);
}

/* Mean 0, variance 1, skewness 2, kurtosis 9. */
static double exponential(gg_rng *r)
{
  return -1 - log(1 - gg_rng_uniform(r));
}

/* Warmer from slab to slab; C_y is +-1 in the second, skewed in the third. */
static void warmer(gg_snapshot *s, gg_rng *r, int sample)
{
  (void)sample;
  place(s, r);
  for (size_t i = 0; i < s->n; i++) {
    const int slab = slab_of(s, i);
    const double mass = s->model->mass[gg_snapshot_species(s, i)];
    for (int a = 0; a < 3; a++) {
      double x = gg_common_rng_normal(r);
      if (a == 1 && slab == 1) x = x > 0 ? 1 : -1;
      if (a == 1 && slab == 2) x = exponential(r);
      s->c[a][i] = x * sqrt((1 + slab) / mass);
      s->s[a][i] = gg_common_rng_normal(r);
    }
  }
}

static void planted_slabs(void **state)
{
  (void)state;
  gg_model m = ct_model(GG_COUETTE, 0.1, 0, 4096, 1);
  m.gravity[1] = -1; /* below differs from above: nothing is folded */
  gg_curves list = ct_curves(&gg_measure_slab_distributions, &m, 256, warmer, 41);
  for (int k = 0; k < SLABS; k++) {
    expect(&list, "Cx", k, "variance_over_mean", (1 + k) / 3.5, 0.03);
    expect(&list, "Wz", k, "variance_over_mean", 1, 0.03);
    expect(&list, "Cx", k, "kurtosis", 3, 0.1);
  }
  expect(&list, "Cy", 2, "skewness", 2, 0.1);
  expect(&list, "Cy", 2, "kurtosis", 9, 1);
  expect(&list, "Cy", 4, "skewness", 0, 0.05);
  assert_true(fabs(ct_number(ct_find(&list, "slab_distribution_Cy_2"), "kurtosis").value - 1) < 1e-3);
  gg_measure_curves_clear(&list);
}

/* Each species in its own units. */
static void two_species(void **state)
{
  (void)state;
  gg_model m = ct_model(GG_COUETTE, 0.1, 0, 4096, 2);
  m.gravity[1] = -1;
  gg_curves list = ct_curves(&gg_measure_slab_distributions, &m, 256, warmer, 42);
  for (int k = 0; k < SLABS; k += SLABS - 1) {
    expect(&list, "Cx_1", k, "variance_over_mean", (1 + k) / 3.5, 0.04);
    expect(&list, "Cx_2", k, "variance_over_mean", (1 + k) / 3.5, 0.05);
  }
  gg_measure_curves_clear(&list);
}

/* Signs of C and Omega in the image of a half turn about z, and of a mirror across y: spins are axial. */
static const double turned[6] = {-1, -1, 1, -1, -1, 1}, mirrored[6] = {1, -1, 1, -1, 1, -1};

/* Skewed in the lower half, and in the upper half as its image. */
static void images(gg_snapshot *s, gg_rng *r, int sample)
{
  (void)sample;
  place(s, r);
  const double *sign = gg_wall_symmetry_of(s->model) == GG_TURNED ? turned : mirrored;
  for (size_t i = 0; i < s->n; i++)
    for (int a = 0; a < 3; a++) {
      const bool above = slab_of(s, i) >= SLABS / 2;
      s->c[a][i] = exponential(r) * (above ? sign[a] : 1);
      s->s[a][i] = exponential(r) * (above ? sign[3 + a] : 1);
    }
}

static void a_slab_and_its_image_are_one(void **state)
{
  (void)state;
  static const char *const components[] = {"Cx", "Cy", "Cz", "Wx", "Wy", "Wz"};
  const gg_flow flows[] = {GG_COUETTE, GG_POISEUILLE};
  for (int f = 0; f < 2; f++) {
    gg_model m = ct_model(flows[f], 0.1, 0, 4096, 1);
    assert_int_equal(gg_wall_symmetry_of(&m), f ? GG_MIRRORED : GG_TURNED);
    gg_curves list = ct_curves(&gg_measure_slab_distributions, &m, 128, images, 43);
    assert_int_equal(list.n, 6 * SLABS / 2);
    for (int c = 0; c < 6; c++)
      for (int k = 0; k < SLABS / 2; k++) expect(&list, components[c], k, "skewness", 2, 0.12);
    const gg_curve *x = ct_find(&list, "slab_distribution_Cx_1");
    for (size_t i = 0; i < x->n; i++) /* no value is below -1 */
      if (x->x[i] < -1.2) assert_true(x->value[i] == 0);
    gg_measure_curves_clear(&list);
  }
}

/* Walls of 1 and 1/4: two thirds of the grains are cold ones, so that <C_y^2> = 1/2, <C_y^3> = 1/sqrt(2 pi) and
 * <C_y^4> = 9/8, if grains collide rarely (Kn = 100). */
static void free_molecules(void **state)
{
  (void)state;
  gg_scene s = gg_scene_defaults();
  s.engine = GG_DSMC, s.flow = GG_FOURIER, s.phi = 0, s.particles = s.dsmc.particles = 1000;
  for (int p = 0; p < GG_PAIRS; p++) s.collision.e[p] = 1, s.collision.beta[p] = -1;
  const double path = 1 / (sqrt(2) * M_PI), gap = path / 100, edge = cbrt(1000);
  s.aspect[1] = pow(gap / edge, 1.5);
  s.walls.temperature[0] = 1, s.walls.temperature[1] = 0.25, s.walls.accommodation = 1;
  s.measure |= GG_MEASURE_SLAB_DISTRIBUTIONS;
  s.run.collisions = 800;
  gg_result *result = ct_run(s);
  for (int k = 0; k < SLABS; k += SLABS - 1) {
    expect(&result->curves, "Cy", k, "skewness", 2 / sqrt(M_PI), 0.2);
    expect(&result->curves, "Cy", k, "kurtosis", 4.5, 0.5);
    expect(&result->curves, "Cx", k, "skewness", 0, 0.3);
    expect(&result->curves, "Cx", k, "variance_over_mean", 1, 0.12);
  }
  gg_result_free(result);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(planted_slabs),
      cmocka_unit_test(two_species),
      cmocka_unit_test(a_slab_and_its_image_are_one),
      cmocka_unit_test(free_molecules),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
