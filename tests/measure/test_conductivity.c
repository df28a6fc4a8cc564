/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Conductivity: snapshots of Maxwellian grains have that of elastic spheres, 1.025218 of first Sonine order if they
 * are dilute (Chapman & Cowling 1970, 10.21), and with Enskog's two factors and his transfer if they are dense; no
 * heat flows along gradients of their density; the last point of the curve is the mean of the rows. Functions in
 * which f1 is expanded: degrees, slopes against differences, and <C.b> = <d/dC . b> of Maxwellian grains. */
#include "curve_test.h"
#include "measure/heat_copies.h"
#include "scene/model_of_scene.h"

enum { N = 2000, SAMPLES = 6000 };

static void maxwellian(gg_snapshot *s, gg_rng *r, int sample)
{
  (void)sample;
  for (int a = 0; a < 3; a++) {
    double momentum = 0;
    for (size_t i = 0; i < s->n; i++) momentum += s->c[a][i] = 0.7 * gg_common_rng_normal(r);
    for (size_t i = 0; i < s->n; i++) s->c[a][i] -= momentum / (double)s->n;
  }
}

static gg_model model(gg_flow flow, gg_engine_kind engine, double phi, double beta)
{
  gg_scene s = gg_scene_defaults();
  gg_model m;
  s.flow = flow, s.phi = phi, s.dsmc.particles = N, s.collision.e[0] = 1, s.collision.beta[0] = beta;
  assert_int_equal(gg_scene_model_make(&s, engine, &m, NULL), GG_OK);
  return m;
}

static void expect_last(const gg_curves *list, const char *name, double value, double most)
{
  const gg_curve *c = ct_find(list, name);
  for (size_t i = 0; i < c->n; i++) ct_expect(name, c->value[i], c->error[i], value, most);
}

static void maxwellians_have_enskogs_conductivity(void **state)
{
  (void)state;
  const double phi[] = {0, 0.3};
  for (int k = 0; k < 2; k++) {
    const gg_model m = model(GG_HCS, GG_DSMC, phi[k], -1);
    const double chi = m.chi[0], y = 4 * phi[k] * chi, kinetic = 1.025218 * (1 + 0.6 * y) / chi;
    const double total = kinetic * (1 + 0.6 * y) + 512 / (25 * M_PI) * phi[k] * phi[k] * chi;
    gg_curves list = ct_curves(&gg_measure_conductivity, &m, SAMPLES, maxwellian, 17);
    expect_last(&list, "thermal_conductivity_of_lag", total, 0.014 * total);
    expect_last(&list, "diffusive_heat_conductivity_of_lag", 0, 0.014 * total);
    gg_measure_curves_clear(&list);
  }
}

static void last_point_is_the_mean_of_rows(void **state)
{
  (void)state;
  const gg_model m = model(GG_HCS, GG_DSMC, 0.2, -1);
  const gg_observable *o = &gg_measure_conductivity;
  gg_snapshot s;
  gg_rng r = gg_common_rng_seed(18, 0);
  void *self = o->create(&m, NULL);
  double *bin = calloc(o->curves->bins(self), sizeof *bin), *row = calloc(o->rows->width(&m), sizeof *row);
  assert_int_equal(gg_measure_snapshot_init(&s, &m, false, NULL), GG_OK);
  maxwellian(&s, &r, 0);
  o->curves->add_snapshot(self, &s, bin);
  o->rows->finish(self, &(gg_interval){.model = &m, .velocity_factor = 1}, row);
  gg_curves list = {.model = &m, .curve = calloc(GG_MOST_CURVES, sizeof *list.curve)};
  o->curves->of_bins(self, bin, &list);
  for (int k = 0; k < 2; k++) {
    gg_function f;
    assert_true(gg_measure_derived_find(
        o->rows->derived, k ? GG_Q_DIFFUSIVE_HEAT_CONDUCTIVITY_REDUCED : GG_Q_THERMAL_CONDUCTIVITY_REDUCED, &f));
    const gg_curve *c = &list.curve[k];
    assert_true(gg_function_value(f, row, &m) == c->value[c->n - 1]);
  }
  o->rows->finish(self, &(gg_interval){.model = &m, .velocity_factor = 1}, row); /* without a snapshot the row is 0 */
  for (size_t i = 0; i < o->rows->width(&m); i++) assert_true(row[i] == 0);
  gg_measure_curves_clear(&list);
  gg_measure_snapshot_clear(&s);
  free(bin), free(row);
  o->destroy(self);
}

static double component(const double x[6], int axis, int k)
{
  double b[GG_HEAT_ORDERS];
  gg_heat_values(GG_HEAT_ORDERS, sqrt(gg_heat_dot(x, x)), x, x + 3, axis, b);
  return b[k];
}

static void slopes_are_differences(void **state)
{
  (void)state;
  const double x[6] = {0.3, -0.7, 1.1, 0.8, 0.5, -0.4}, dx[6] = {-0.2, 0.9, 0.4, 0.6, -1.3, 0.7}, h = 1e-4;
  double slope[GG_HEAT_ORDERS], twice[6], more[6], less[6];
  for (int i = 0; i < 6; i++) twice[i] = 2 * x[i], more[i] = x[i] + h * dx[i], less[i] = x[i] - h * dx[i];
  for (int axis = 0; axis < 3; axis++) {
    gg_heat_slopes(GG_HEAT_ORDERS, x, x + 3, dx, dx + 3, axis, slope);
    for (int k = 0; k < GG_HEAT_ORDERS; k++) {
      const double difference = (component(more, axis, k) - component(less, axis, k)) / (2 * h);
      assert_true(fabs(slope[k] - difference) < 1e-6);
      assert_true(fabs(component(twice, axis, k) / component(x, axis, k) - pow(2, gg_heat_functions[k].degree)) < 1e-9);
    }
  }
}

/* Spins half as fast as velocities: a Maxwellian, which needs no equipartition here. */
static void divergences_are_those_of_maxwellians(void **state)
{
  (void)state;
  enum { ROWS = 40 };
  const gg_model m = model(GG_HCS, GG_DSMC, 0, 0.5);
  const gg_heat_layout l = gg_measure_heat_layout(&m);
  double sum[GG_HEAT_ORDERS] = {0}, squares[GG_HEAT_ORDERS] = {0}, *row = calloc(GG_HEAT_MOST, sizeof *row);
  gg_heat_copies copies;
  gg_snapshot s;
  gg_rng r = gg_common_rng_seed(19, 0);
  assert_int_equal(gg_measure_heat_copies_make(&copies, &m, NULL), GG_OK);
  assert_int_equal(gg_measure_snapshot_init(&s, &m, true, NULL), GG_OK);
  for (int i = 0; i < ROWS; i++) {
    maxwellian(&s, &r, i);
    for (int a = 0; a < 3; a++)
      for (size_t k = 0; k < s.n; k++) s.s[a][k] = 0.35 * gg_common_rng_normal(&r);
    memset(row, 0, GG_HEAT_MOST * sizeof *row);
    gg_measure_heat_copies_follow(&copies, &s, &r, row);
    for (int k = 0; k < l.n; k++) {
      const double off = row[l.diverged + k] - row[l.projected + k];
      sum[k] += off, squares[k] += off * off;
    }
  }
  for (int k = 0; k < l.n; k++) {
    const double mean = sum[k] / ROWS, error = sqrt((squares[k] / ROWS - mean * mean) / (ROWS - 1));
    print_message("# function %d: %.5f +- %.5f of %.4f\n", k, mean, error, row[l.diverged + k]);
    assert_true(error <= 0.01 * fabs(row[l.diverged + k]) && fabs(mean) <= 4 * error);
  }
  gg_measure_snapshot_clear(&s);
  gg_measure_heat_copies_clear(&copies);
  free(row);
}

static void models_without_it_give_the_reason(void **state)
{
  (void)state;
  const gg_model fine = model(GG_EQUILIBRIUM, GG_DSMC, 0.1, -1), md = model(GG_HCS, GG_MD, 0.1, -1),
                 rough = model(GG_HCS, GG_DSMC, 0, 0), dense = model(GG_HCS, GG_DSMC, 0.1, 0),
                 rough_md = model(GG_HCS, GG_MD, 0.1, 1), heated = model(GG_HSS, GG_DSMC, 0.1, -1),
                 sheared = model(GG_USF, GG_DSMC, 0.1, -1);
  assert_null(gg_measure_conductivity.refuses(&fine));
  assert_null(gg_measure_conductivity.refuses(&rough));
  assert_null(gg_measure_conductivity.refuses(&dense));
  const gg_model * not [] = {&md, &rough_md, &heated, &sheared};
  for (size_t i = 0; i < sizeof not / sizeof *not ; i++) assert_non_null(gg_measure_conductivity.refuses(not [i]));
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(maxwellians_have_enskogs_conductivity), cmocka_unit_test(last_point_is_the_mean_of_rows),
      cmocka_unit_test(slopes_are_differences), cmocka_unit_test(divergences_are_those_of_maxwellians),
      cmocka_unit_test(models_without_it_give_the_reason)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
