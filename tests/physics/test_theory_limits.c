/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Theories where they must hold: Lun (1991) for nearly elastic, nearly smooth and nearly perfectly rough grains within
 * a few per cent of the Monte Carlo solution of its own equation; the Gaussian closure within 2 % for dissipative ones;
 * and a contact value 2 % off is seen (a canary). */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>
#include <math.h>

#include "graingas.h"
#include "run/run.h"
#include "scene/scene.h"

static gg_result *run(double phi, double e, double beta)
{
  gg_scene s = gg_scene_defaults();
  s.engine = GG_DSMC, s.phi = phi, s.run.relative_error = 0.004;
  s.collision.e[0] = e, s.collision.beta[0] = beta;
  gg_result *r = NULL;
  gg_error err = {0};
  gg_status status = gg_run_scene(&s, NULL, 1, NULL, &r, &err);
  if (status != GG_OK) print_message("%s\n", err.message);
  assert_int_equal(status, GG_OK);
  assert_int_equal(r->steadiness, GG_STEADY);
  return r;
}

/* Relative deviation of a theory from the run. */
static double deviation(const char *theory, const gg_model *model, const gg_result *r, gg_quantity q)
{
  gg_theory_answer answer;
  gg_error err = {0};
  assert_int_equal(gg_theory_evaluate(gg_theory_find(theory), model, &answer, &err), GG_OK);
  double d = answer.value[q] / r->value[q].mean - 1;
  print_message("# %s %s: %+.2f %% (error %.2f %%)\n", theory, gg_common_quantity_name(q), 100 * d,
                100 * r->value[q].error / fabs(r->value[q].mean));
  return d;
}

static void check(const char *theory, const gg_result *r, double bound)
{
  const gg_quantity all[] = {GG_Q_TEMPERATURE, GG_Q_PRESSURE, GG_Q_SHEAR_VISCOSITY, GG_Q_COLLISION_RATE};
  for (int i = 0; i < 4; i++) {
    double error = r->value[all[i]].error / fabs(r->value[all[i]].mean);
    assert_true(fabs(deviation(theory, &r->model, r, all[i])) < bound + 4 * error);
  }
}

/* Nearly elastic and smooth, dilute and dense. */
static void lun_smooth(void **state)
{
  (void)state;
  gg_result *dilute = run(0.02, 0.98, -1), *dense = run(0.3, 0.98, -1);
  check("lun1991", dilute, 0.04);
  check("lun1991", dense, 0.03);
  gg_result_free(dilute), gg_result_free(dense);
}

/* Nearly elastic and perfectly rough: T, and theta/T = 1. */
static void lun_rough(void **state)
{
  (void)state;
  gg_result *r = run(0.2, 0.98, 1);
  check("lun1991", r, 0.05);
  assert_true(fabs(deviation("lun1991", &r->model, r, GG_Q_TEMPERATURE_RATIO)) < 0.02);
  gg_result_free(r);
}

/* The closure has all orders of the gradient, so it holds for dissipative grains and N1, too. */
static void the_closure_holds_for_dissipative_grains(void **state)
{
  (void)state;
  gg_result *r = run(0.2, 0.8, -1);
  check("gaussian_closure", r, 0.02);
  assert_true(fabs(deviation("gaussian_closure", &r->model, r, GG_Q_N1)) < 0.06);
  gg_result_free(r);
}

/* The canary: chi 2 % off moves the temperature of a dilute gas by 4 %. Near e = 1 the temperature goes as the
 * viscosity, whose exact value in a dilute gas is 1.016034 times that of first Sonine order, which is the closure's: it
 * should lie 1.6 % low, within half a per cent. */
static void a_wrong_contact_value_is_detected(void **state)
{
  (void)state;
  const double expected = 1 / 1.016034 - 1;
  gg_result *r = run(0.02, 0.98, -1);
  double right = deviation("gaussian_closure", &r->model, r, GG_Q_TEMPERATURE);
  gg_model wrong = r->model;
  wrong.chi[0] *= 1.02;
  double off = deviation("gaussian_closure", &wrong, r, GG_Q_TEMPERATURE);
  double error = r->value[GG_Q_TEMPERATURE].error / r->value[GG_Q_TEMPERATURE].mean;
  assert_true(fabs(right - expected) < 0.005 + 4 * error);
  assert_true(fabs(off - expected) > 0.005 + 4 * error);
  gg_result_free(r);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(lun_smooth),
      cmocka_unit_test(lun_rough),
      cmocka_unit_test(the_closure_holds_for_dissipative_grains),
      cmocka_unit_test(a_wrong_contact_value_is_detected),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
