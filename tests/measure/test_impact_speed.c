/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Normal speeds of collisions: speeds planted with the law of a Maxwellian gas are recovered as that law, for one
 * species, for two with different temperatures, and for a gas that cools while it is sampled; elastic gases have it
 * in both engines; for inelastic ones the mean square agrees with their loss of energy. */
#include "curve_test.h"
#include "graingas.h"

static double law(double x, const void *none)
{
  (void)none;
  return 0.5 * x * exp(-0.25 * x * x);
}

enum { GRAINS = 1000, SAMPLES = 64, PER_SAMPLE = 20000 };

/* Velocities along one axis, half of them to either side: <C.C>/3 is T_i/m_i of each species to the last bit. */
typedef struct planted {
  double c[3][GRAINS];
  uint8_t species[GRAINS];
  double over_m[2];
} planted;

static void set_speeds(planted *p, double factor)
{
  for (int i = 0; i < GRAINS; i++) {
    double speed = sqrt(3 * p->over_m[p->species[i]] * factor);
    p->c[i % 3][i] = (i / 6) % 2 ? speed : -speed;
  }
}

static gg_collision_record draw(const planted *p, const gg_model *m, double factor, gg_rng *r)
{
  gg_collision_record c = {.since = {INFINITY, INFINITY}};
  for (int k = 0; k < 2; k++) c.species[k] = m->n_species > 1 && gg_rng_uniform(r) < 0.5;
  double s2 = factor * (p->over_m[c.species[0]] + p->over_m[c.species[1]]);
  double g = sqrt(-2 * s2 * log(1 - gg_rng_uniform(r))); /* density g/s^2 exp(-g^2/2s^2) */
  c.k = gg_rng_direction(r);
  c.c12 = gg_scale(g, c.k);
  return c;
}

/* T falls by `fall` from a sample to the next, in proportion to the collisions. */
static gg_curves fed(const gg_model *m, double first, double second, double fall)
{
  planted p = {.over_m = {first, second}};
  gg_rng r = gg_common_rng_seed(7, 0);
  gg_bins bins;
  void *self = gg_measure_impact_speed.create(m, NULL);
  assert_int_equal(gg_statistics_bins_init(&bins, gg_measure_impact_speed.curves->bins(self), NULL), GG_OK);
  for (int i = 0; i < GRAINS; i++) p.species[i] = i >= m->n_of[0];
  gg_snapshot s = {.model = m, .n = GRAINS, .c = {p.c[0], p.c[1], p.c[2]}, .species = p.species};
  for (int k = 0; k < SAMPLES; k++) {
    for (int i = 0; i < PER_SAMPLE && k; i++) {
      gg_collision_record c = draw(&p, m, exp(-fall * (k - 1 + (i + 0.5) / PER_SAMPLE)), &r);
      gg_measure_impact_speed.collisions->add(self, &c);
    }
    set_speeds(&p, exp(-fall * k));
    gg_measure_impact_speed.curves->add_snapshot(self, &s, gg_statistics_bins_sample(&bins));
    gg_statistics_bins_commit(&bins);
  }
  const gg_bins *list[] = {&bins};
  gg_curves curves = {.model = m};
  assert_int_equal(gg_measure_curves_estimate(list, 1, gg_measure_impact_speed.curves->of_bins, self, "impact_speed", 0,
                                              &curves, NULL),
                   GG_OK);
  gg_statistics_bins_clear(&bins);
  gg_measure_impact_speed.destroy(self);
  return curves;
}

/* Mean sqrt(pi), mean square 4, and the law of the curve, point by point. */
static void expect_maxwellian(const gg_curves *list, size_t points, double sight)
{
  const gg_curve *c = ct_find(list, "impact_speed");
  gg_curve_number mean = ct_number(c, "mean_impact_speed"), square = ct_number(c, "mean_square_impact_speed");
  ct_expect("mean", mean.value, mean.error, sqrt(M_PI), sight);
  ct_expect("mean square", square.value, square.error, 4, 4 * sight);
  assert_true(ct_chi2(c, 0, points, law, NULL) < 1.6);
  for (size_t i = 0; i < c->n; i++) assert_true(fabs(c->reference[i] - law(c->x[i], NULL)) < 1e-15);
}

static void planted_law(void **state)
{
  (void)state;
  gg_model one = ct_model(GG_EQUILIBRIUM, 0.1, -1, GRAINS, 1), two = ct_model(GG_EQUILIBRIUM, 0.1, -1, GRAINS, 2);
  gg_model cooling = ct_model(GG_HCS, 0.1, -1, GRAINS, 1);
  gg_curves a = fed(&one, 0.5, 0, 0), b = fed(&two, 0.5, 0.08, 0), c = fed(&cooling, 0.5, 0, 0.1);
  expect_maxwellian(&a, 60, 0.006);
  expect_maxwellian(&b, 60, 0.006);
  expect_maxwellian(&c, 60, 0.006);
  gg_measure_curves_clear(&a), gg_measure_curves_clear(&b), gg_measure_curves_clear(&c);
}

static void models_without_it_give_the_reason(void **state)
{
  (void)state;
  gg_model walled = ct_model(GG_COUETTE, 0.1, -1, GRAINS, 1), sheared = ct_model(GG_USF, 0.1, -1, GRAINS, 1);
  assert_non_null(gg_measure_impact_speed.refuses(&walled));
  assert_null(gg_measure_impact_speed.refuses(&sheared));
  sheared.linear_response = true;
  assert_non_null(gg_measure_impact_speed.refuses(&sheared));
}

static gg_scene scene_of(gg_flow flow, gg_engine_kind engine, double e, double phi)
{
  gg_scene s = gg_scene_defaults();
  s.flow = flow, s.engine = engine, s.phi = phi, s.particles = 1000, s.dsmc.particles = 4000;
  for (int p = 0; p < GG_PAIRS; p++) s.collision.e[p] = e;
  s.run.collisions = engine == GG_MD ? 1000 : 20000;
  s.measure |= GG_MEASURE_IMPACT_SPEED;
  return s;
}

/* Both engines, also a dense gas: chaos before collisions. T of a sample is conserved, with the 3N - 3 degrees of
 * freedom of a gas at rest: mean square 4 (1 + O(1/N)), as for the collision rate. */
static void elastic_gases_have_the_maxwellian_law(void **state)
{
  (void)state;
  for (int kind = GG_MD; kind <= GG_DSMC; kind++) {
    gg_result *r = ct_run(scene_of(GG_EQUILIBRIUM, (gg_engine_kind)kind, 1, kind == GG_MD ? 0.3 : 0.1));
    const gg_curve *c = ct_find(&r->curves, "impact_speed");
    gg_curve_number mean = ct_number(c, "mean_impact_speed");
    double finite = 2.0 / (double)r->model.n;
    ct_expect("mean", mean.value, mean.error + finite, sqrt(M_PI), 0.02);
    assert_true(ct_chi2(c, 0, 50, law, NULL) < 1.8);
    gg_result_free(r);
  }
}

/* Each collision of smooth grains loses (1 - e^2) g_n^2/4: dissipation = (n/2) rate (1 - e^2)/4 <g_n^2>, the rate
 * counting a collision for both grains; so in a cooling gas zeta = rate (1 - e^2) <x^2>/12. */
static void mean_square_gives_the_loss(void **state)
{
  (void)state;
  const double e = 0.7;
  gg_result *r = ct_run(scene_of(GG_USF, GG_MD, e, 0.1));
  gg_curve_number square = ct_number(ct_find(&r->curves, "impact_speed"), "mean_square_impact_speed");
  const gg_estimate *v = r->value;
  double loss = r->model.stress_unit * r->model.density / 8 * (1 - e * e) * v[GG_Q_COLLISION_RATE].mean *
                v[GG_Q_TEMPERATURE].mean;
  double error = hypot(square.error, square.value * v[GG_Q_DISSIPATION].error / v[GG_Q_DISSIPATION].mean);
  ct_expect("sheared: <x^2> from the loss", v[GG_Q_DISSIPATION].mean / loss, error, square.value, 0.2);
  gg_result_free(r);

  gg_scene s = scene_of(GG_HCS, GG_DSMC, e, 0);
  s.dsmc.particles = 20000, s.run.collisions = 6000;
  r = ct_run(s);
  square = ct_number(ct_find(&r->curves, "impact_speed"), "mean_square_impact_speed");
  double zeta = r->value[GG_Q_COOLING_RATE].mean, a2 = r->value[GG_Q_A2].mean; /* over nu_0; the rate at T = 1 */
  double rate = gg_common_model_collision_rate(&r->model, 1) * (1 - a2 / 16) / gg_common_model_nu0(&r->model, 1);
  ct_expect("cooling: <x^2> from zeta", 12 * zeta / (rate * (1 - e * e)), square.error + 0.004, square.value, 0.1);
  gg_result_free(r);
}

int main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test(planted_law), cmocka_unit_test(models_without_it_give_the_reason),
                                     cmocka_unit_test(elastic_gases_have_the_maxwellian_law),
                                     cmocka_unit_test(mean_square_gives_the_loss)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
