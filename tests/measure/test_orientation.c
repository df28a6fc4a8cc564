/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Orientation: planted angles are recovered in Lambda and both histograms, at any mean spin; instantaneous
 * velocities contain the flow; an engine's curve agrees with the quantity cos2_psi of rheology. */
#include "curve_test.h"
#include "graingas.h"

#define ALIGNED 0.3
static const double mean_spin = -2.5;

/* A fraction of the grains spins along (or against) its velocity, the others in random directions; a mean spin is
 * added. */
static void planted(gg_snapshot *s, gg_rng *r, int sample)
{
  (void)sample;
  for (size_t i = 0; i < s->n; i++) {
    gg_vec c = gg_rng_direction(r), w = gg_rng_direction(r);
    if (gg_rng_uniform(r) < ALIGNED) w = gg_scale(gg_rng_uniform(r) < 0.5 ? 1 : -1, c);
    double speed = 1 + gg_rng_uniform(r), rate = 0.2 + gg_rng_uniform(r);
    s->c[0][i] = speed * c.x, s->c[1][i] = speed * c.y, s->c[2][i] = speed * c.z;
    s->s[0][i] = rate * w.x, s->s[1][i] = rate * w.y, s->s[2][i] = rate * w.z + mean_spin;
    if (s->r[0])
      for (int a = 0; a < 3; a++) s->r[a][i] = gg_rng_uniform(r) * s->model->box[a];
  }
}

static double flat(double x, const void *context)
{
  (void)x, (void)context;
  return (1 - ALIGNED) / 2;
}

static void planted_angles(void **state)
{
  (void)state;
  gg_model m = ct_model(GG_USF, 0.1, 0, 20000, 1);
  gg_curves list = ct_curves(&gg_measure_orientation, &m, 48, planted, 31);
  const gg_curve *c = ct_find(&list, "orientation_cos"), *square = ct_find(&list, "orientation_cos2");
  gg_curve_number p = ct_number(c, "Lambda");
  ct_expect("Lambda", p.value, p.error, ALIGNED + (1 - ALIGNED) / 3, 0.005);
  double chi2 = ct_chi2(c, 1, c->n - 1, flat, NULL);
  assert_true(chi2 > 0.4 && chi2 < 2);
  /* the aligned ones are in the outermost bins, but for the scatter of the sample's mean spin */
  double ends = (c->value[0] + c->value[c->n - 1]) * 0.04 - 0.04 * (1 - ALIGNED);
  assert_true(fabs(ends - ALIGNED) < 0.005);
  double sum = 0;
  for (size_t i = 0; i < square->n; i++) sum += square->value[i] / (double)square->n;
  assert_true(fabs(sum - 1) < 1e-12);
  /* independent part: P(u) = (1 - ALIGNED)/(2 sqrt(u)), averaged over a bin */
  double u = square->x[10], half = 0.01, expected = (1 - ALIGNED) * (sqrt(u + half) - sqrt(u - half)) / (2 * half);
  ct_expect("P(cos^2)", square->value[10], square->error[10], expected, 0.1 * expected);
  gg_measure_curves_clear(&list);
}

/* Instantaneous: the flow velocity and the mean spin are included. With a very fast flow c is along x, and Lambda
 * becomes <omega_x^2/omega^2>, computed here separately. */
static void planted_flow(void **state)
{
  (void)state;
  gg_model m = ct_model(GG_USF, 0.1, 0, 5000, 1);
  m.shear_rate = 1e5;
  gg_curves list = ct_curves(&gg_measure_orientation, &m, 64, planted, 32);
  gg_rng r = gg_common_rng_seed(33, 0);
  double expected = 0;
  for (int i = 0; i < 1000000; i++) {
    gg_vec w = gg_scale(0.2 + gg_rng_uniform(&r), gg_rng_direction(&r));
    w.z += mean_spin;
    expected += w.x * w.x / gg_dot(w, w) / 1e6;
  }
  gg_curve_number p = ct_number(ct_find(&list, "orientation_cos_instantaneous"), "Lambda");
  ct_expect("Lambda of c and omega", p.value, hypot(p.error, 3e-5), expected, 0.04 * expected);
  p = ct_number(ct_find(&list, "orientation_cos"), "Lambda");
  ct_expect("Lambda", p.value, p.error, ALIGNED + (1 - ALIGNED) / 3, 0.02);
  gg_measure_curves_clear(&list);
}

/* Sheared rough grains: the same mean as rheology's within their errors, and below 1/3; md's instantaneous Lambda
 * contains the flow. */
static void engines_agree_with_rheology(void **state)
{
  (void)state;
  for (int k = 0; k < 2; k++) {
    gg_scene s = gg_scene_defaults();
    s.engine = k ? GG_DSMC : GG_MD, s.phi = 0.05, s.particles = 1000;
    for (int q = 0; q < GG_PAIRS; q++) s.collision.e[q] = 0.8, s.collision.beta[q] = 0;
    s.run.collisions = 600;
    s.measure |= GG_MEASURE_ORIENTATION;
    gg_result *r = ct_run(s);
    const gg_estimate *rheology = &r->value[GG_Q_COS2_PSI];
    gg_curve_number p = ct_number(ct_find(&r->curves, "orientation_cos"), "Lambda");
    ct_expect(r->engine, p.value, hypot(p.error, rheology->error), rheology->mean, 0.02);
    assert_true(p.value < 1.0 / 3 - 4 * p.error);
    gg_result_free(r);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(planted_angles),
      cmocka_unit_test(planted_flow),
      cmocka_unit_test(engines_agree_with_rheology),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
