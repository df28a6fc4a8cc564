/* SPDX-License-Identifier: GPL-3.0-or-later */
/* In dilute gases Enskog theory is exact, so both engines must agree within four combined standard errors. Uniform
 * shear at phi = 0.01 of smooth, rough and frictional grains; heated gases at e = 0; heated shear. The energy balance
 * closes. Canary: the same test must fail if one engine's e is off by 0.02. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>
#include <math.h>
#include <stdlib.h>

#include "graingas.h"
#include "run/run.h"
#include "run/z_scores.h"
#include "scene/scene.h"

static gg_scene scene_of(double e, double beta, double mu)
{
  gg_scene s = gg_scene_defaults();
  s.phi = 0.01, s.particles = 1000;
  s.collision.e[0] = e, s.collision.beta[0] = beta, s.collision.mu[0] = mu;
  s.run.relative_error = 0.015;
  return s;
}

static gg_result *run(gg_scene s, gg_engine_kind engine)
{
  gg_result *r = NULL;
  gg_error err = {0};
  s.engine = engine;
  gg_status status = gg_run_scene(&s, NULL, 1, NULL, &r, &err);
  if (status != GG_OK) print_message("%s\n", err.message);
  assert_int_equal(status, GG_OK);
  assert_int_equal(r->steadiness, GG_STEADY);
  return r;
}

static double worst_z(const gg_result *a, const gg_result *b, bool rough)
{
  const gg_quantity all[] = {GG_Q_TEMPERATURE, GG_Q_PRESSURE,       GG_Q_SHEAR_VISCOSITY,  GG_Q_N1,
                             GG_Q_P_XY,        GG_Q_COLLISION_RATE, GG_Q_TEMPERATURE_RATIO};
  double worst = 0;
  for (int i = 0; i < (rough ? 7 : 6); i++) {
    double z = gg_run_z_score(&a->value[all[i]], &b->value[all[i]]);
    print_message("# %s: md %.5g +- %.2g, dsmc %.5g +- %.2g, z = %.2f\n", gg_common_quantity_name(all[i]),
                  a->value[all[i]].mean, a->value[all[i]].error, b->value[all[i]].mean, b->value[all[i]].error, z);
    worst = fmax(worst, fabs(z));
  }
  return worst;
}

static void balance_closes(const gg_result *r)
{
  const gg_estimate *b = &r->value[GG_Q_ENERGY_BALANCE];
  assert_true(fabs(b->mean - 1) < 5 * b->error + 2e-3); /* 2e-3: energy stored in the gas over a finite window */
}

/* Returns the result of md. */
static gg_result *agree(double e, double beta, double mu)
{
  gg_scene s = scene_of(e, beta, mu);
  gg_result *md = run(s, GG_MD), *dsmc = run(s, GG_DSMC);
  balance_closes(md), balance_closes(dsmc);
  assert_true(worst_z(md, dsmc, md->model.rule != GG_SMOOTH) < 4);
  assert_true(md->value[GG_Q_P_XY].mean < 0 && dsmc->value[GG_Q_P_XY].mean < 0);
  gg_result_free(dsmc);
  return md;
}

/* Canary: e off by 0.02 in one engine is detected. */
static void engines_agree_on_smooth_grains(void **state)
{
  (void)state;
  gg_result *md = agree(0.9, -1, INFINITY), *other = run(scene_of(0.92, -1, INFINITY), GG_DSMC);
  assert_true(worst_z(md, other, false) > 6);
  gg_result_free(md), gg_result_free(other);
}
static void engines_agree_on_rough_grains(void **state)
{
  (void)state, gg_result_free(agree(0.9, 0, INFINITY));
}
static void engines_agree_on_frictional_grains(void **state)
{
  (void)state, gg_result_free(agree(0.9, 0.4, 0.123));
}

/* At e = 0 grains separate with no normal velocity. The gas is so dilute that these pairs do not collide again, which
 * dsmc neglects. */
static void engines_agree_at_e_0(void **state)
{
  (void)state;
  gg_scene s = scene_of(0, -1, INFINITY);
  s.flow = GG_HSS, s.thermostat = GG_GAUSSIAN;
  s.phi = 0.001, s.particles = 300;
  s.run.collisions = 1500;
  gg_result *md = run(s, GG_MD), *dsmc = run(s, GG_DSMC);
  const gg_quantity all[] = {GG_Q_COLLISION_RATE, GG_Q_PRESSURE, GG_Q_A2};
  for (int i = 0; i < 3; i++) {
    double z = gg_run_z_score(&md->value[all[i]], &dsmc->value[all[i]]);
    print_message("# %s: md %.5g +- %.2g, dsmc %.5g +- %.2g, z = %.2f\n", gg_common_quantity_name(all[i]),
                  md->value[all[i]].mean, md->value[all[i]].error, dsmc->value[all[i]].mean, dsmc->value[all[i]].error,
                  z);
    assert_true(fabs(z) < 4);
  }
  assert_true(md->value[GG_Q_COLLISION_RATE].error < 0.005 * md->value[GG_Q_COLLISION_RATE].mean);
  gg_result_free(md), gg_result_free(dsmc);
}

/* The Gaussian thermostat of both engines keeps T and does not change spins. For sticking, nearly smooth and sliding
 * grains theta/T is far from that of free cooling. */
static void heated_spins(void **state)
{
  (void)state;
  const double beta[] = {0, -0.9, 0.5}, mu[] = {INFINITY, INFINITY, 0.05};
  for (int k = 0; k < 3; k++) {
    gg_scene s = scene_of(0.9, beta[k], mu[k]);
    s.flow = GG_HSS, s.thermostat = GG_GAUSSIAN;
    s.particles = 500, s.run.relative_error = 0.02;
    gg_result *md = run(s, GG_MD), *dsmc = run(s, GG_DSMC);
    const gg_estimate *a = &md->value[GG_Q_TEMPERATURE_RATIO], *b = &dsmc->value[GG_Q_TEMPERATURE_RATIO];
    const gg_estimate *T = &dsmc->value[GG_Q_TEMPERATURE];
    double z = gg_run_z_score(a, b);
    print_message("# theta/T: md %.5g +- %.2g, dsmc %.5g +- %.2g, z = %.2f; T of dsmc: %.6g +- %.2g\n", a->mean,
                  a->error, b->mean, b->error, z, T->mean, T->error);
    assert_true(fabs(z) < 4 && a->error < 0.03 * a->mean);
    assert_true(fabs(md->value[GG_Q_TEMPERATURE].mean - 0.5) < 1e-9);
    assert_true(fabs(T->mean - 0.5) < 4 * T->error && T->error < 5e-4);
    gg_result_free(md), gg_result_free(dsmc);
  }
}

/* White noise heats the sheared gas, once weakly, nightly also so strongly that shear hardly matters. */
static void engines_agree_on_heated_shear(void **state)
{
  (void)state;
  const double temperature[] = {GG_AUTO, 20000};
  for (int k = 0; k < (getenv("NIGHTLY") ? 2 : 1); k++) {
    gg_scene s = scene_of(0.9, -1, INFINITY);
    s.flow = GG_HEATED_SHEAR, s.thermostat = GG_WHITE_NOISE;
    s.start.temperature = temperature[k], s.run.relative_error = 0.03;
    gg_result *md = run(s, GG_MD), *dsmc = run(s, GG_DSMC);
    assert_true(worst_z(md, dsmc, false) < 4);
    const gg_estimate *balance =
        &md->value[GG_Q_ENERGY_BALANCE]; /* a tenth of the heat and more comes from the kicks */
    assert_true(balance->error < 0.01 && fabs(balance->mean - 1) < 5 * balance->error);
    gg_result_free(md), gg_result_free(dsmc);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(engines_agree_on_smooth_grains), cmocka_unit_test(engines_agree_on_rough_grains),
      cmocka_unit_test(engines_agree_at_e_0),           cmocka_unit_test(engines_agree_on_frictional_grains),
      cmocka_unit_test(engines_agree_on_heated_shear),  cmocka_unit_test(heated_spins),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
