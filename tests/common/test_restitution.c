/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Built-in laws of restitution: viscoelastic spheres against their series and their equation of motion, the table
 * against the law, and what a scene makes of it. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "common/laws/loss_table.h"
#include "common/model.h"
#include "common/rng.h"
#include "scene/model_of_scene.h"
#include "theory/theory.h"
#include "theory/theory_list.h"

/* The deceleration of a contact: rho = m_eff = 1. */
static double force(double A, double xi, double v)
{
  double root = sqrt(fmax(xi, 0));
  return -root * (xi + 1.5 * A * v);
}

/* e by the equation of motion, by Runge and Kutta's rule, from a relative speed of 1 until nothing repels any more. */
static double integrated(double x)
{
  const double A = x * x / 1.5, h = 2e-4; /* A kappa^(2/5) = x^2, kappa = 1.5^(5/2) */
  double xi = 0, v = 1;
  for (;;) {
    double k1 = force(A, xi, v), k2 = force(A, xi + h / 2 * v, v + h / 2 * k1),
           k3 = force(A, xi + h / 2 * v + h * h / 4 * k1, v + h / 2 * k2),
           k4 = force(A, xi + h * v + h * h / 2 * k2, v + h * k3);
    double next = xi + h * v + h * h / 6 * (k1 + k2 + k3);
    v += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    xi = next;
    if (v < 0 && (xi <= 0 || force(A, xi, v) >= 0)) return -v;
  }
}

/* Their difference is what the header says. */
static void equation_of_motion(void **state)
{
  (void)state;
  const struct {
    double x, within;
  } at[] = {{0.2, 2e-5}, {0.3, 5e-5}, {0.4, 2e-4}, {0.5, 4.5e-4}, {0.7, 2e-3}, {1, 5e-3}, {2, 9e-3}, {3, 6e-3}};
  for (size_t k = 0; k < sizeof at / sizeof *at; k++) {
    double e = 1 - gg_common_loss_viscoelastic(pow(at[k].x, 10)), exact = integrated(at[k].x);
    print_message("# x = %.1f: e = %.5f, equation of motion %.5f\n", at[k].x, e, exact);
    assert_true(fabs(e - exact) < at[k].within);
  }
}

/* 1 - e = C1 x^2 - C2 x^4 - ...: the coefficients of Ramirez et al. 1999, next that of x^5, 4/15. */
static void the_viscoelastic_series_has_published_coefficients(void **state)
{
  (void)state;
  const double C1 = 1.15344, C2 = 0.6 * C1 * C1;
  for (double x = 0.005; x < 0.03; x *= 1.5) {
    double loss = gg_common_loss_viscoelastic(pow(x, 10)), x2 = x * x;
    assert_true(fabs(loss / x2 - C1) < 1e-5 + x2);
    assert_true(fabs((loss - 1.15345 * x2) / (x2 * x2) + C2 + 4. / 15 * x) < 3e-4 + x2);
  }
}

static void the_speed_of_a_loss_inverts_the_law(void **state)
{
  (void)state;
  for (double loss = 0.001; loss <= 0.991; loss += 0.01) {
    double u = gg_common_law_speed_of(GG_LAW_VISCOELASTIC, loss);
    assert_true(fabs(gg_common_law_loss(GG_LAW_VISCOELASTIC, u) - loss) < 1e-12);
  }
  assert_true(gg_common_law_speed_of(GG_LAW_VISCOELASTIC, 0) == 0 && gg_common_law_loss(GG_LAW_VISCOELASTIC, 0) == 0);
}

/* A user's table: straight lines between its speeds, which need not be evenly spaced, and its ends beyond. */
static void straight_between_speeds(void **state)
{
  (void)state;
  const double speed[] = {1, 2, 6}, e[] = {0.9, 0.7, 0.3};
  gg_law_table table = {3, speed, e};
  const double at[] = {0.5, 1, 1.25, 1.75, 2, 3, 5.9, 6, 60},
               value[] = {0.9, 0.9, 0.85, 0.75, 0.7, 0.6, 0.31, 0.3, 0.3};
  for (int k = 0; k < 9; k++) assert_true(fabs(gg_common_law_from_table(&table, at[k], 0, 0) - value[k]) < 1e-15);
}

/* The loss of each law rises from 0 towards 1; its table is within 2e-7, and constant beyond its ends. */
static void tables_of_laws_are_within_2e_7(void **state)
{
  (void)state;
  gg_rng rng = gg_common_rng_seed(3, 0);
  for (gg_law_kind kind = GG_LAW_CONSTANT + 1; kind < GG_N_LAWS; kind++) {
    gg_loss_table *t;
    gg_error err;
    assert_int_equal(gg_common_loss_table_new(kind, &t, &err), GG_OK);
    for (int i = 0; i < 200000; i++) {
      double u = exp2(-99.99 + 127.99 * gg_rng_uniform(&rng)), loss = gg_common_law_loss(kind, u);
      assert_true(loss > 0 && loss < 1 && gg_common_law_loss(kind, 1.01 * u) > loss);
      assert_true(fabs(gg_loss_at(t->loss, u) - loss) < 2e-7);
    }
    assert_true(gg_loss_at(t->loss, 0) == 0 && gg_loss_at(t->loss, 1e-300) == 0);
    assert_true(gg_loss_at(t->loss, 1e300) == gg_common_law_loss(kind, GG_LOSS_HIGHEST));
    free(t);
  }
}

static gg_scene viscoelastic(gg_flow flow)
{
  gg_scene s = gg_scene_defaults();
  s.flow = flow;
  s.phi = 0.1;
  s.collision.law = GG_LAW_VISCOELASTIC;
  return s;
}

static gg_model model_of(const gg_scene *s)
{
  gg_model m;
  gg_error err;
  if (gg_scene_model_make(s, GG_MD, &m, &err) != GG_OK) fail_msg("%s", err.message);
  return m;
}

/* collision.e is e at collision.speed, in the user's units; of each pair; and slower is more elastic. */
static void reference_speed(void **state)
{
  (void)state;
  gg_scene s = viscoelastic(GG_USF);
  gg_model m = model_of(&s);
  assert_true(fabs(gg_common_law_at(&m.law, 1, 0, 0, NULL) - 0.9) < 1e-12);
  s.shear.rate = 4, s.species[0].diameter = 0.5, s.collision.speed = 6; /* 3 d gamma */
  s.species[0].fraction = s.species[1].fraction = 0.5;
  s.n_species = 2, s.collision.e[GG_12] = 0.8, s.collision.e[GG_22] = 1;
  m = model_of(&s);
  assert_true(fabs(gg_common_law_at(&m.law, 3, 0, 0, NULL) - 0.9) < 1e-12 &&
              fabs(gg_common_law_at(&m.law, 3, 1, 0, NULL) - 0.8) < 1e-12);
  assert_true(gg_common_law_at(&m.law, 3, 1, 1, NULL) == 1 && gg_common_law_at(&m.law, 0.3, 0, 0, NULL) > 0.93 &&
              !m.elastic);
  s = viscoelastic(GG_HCS);
  s.species[0].diameter = 7, s.collision.speed = 3.5; /* v_0 is a diameter per unit of time */
  m = model_of(&s);
  assert_true(fabs(gg_common_law_at(&m.law, 0.5, 0, 0, NULL) - 0.9) < 1e-12);
}

/* Theories of a constant e and the linear response reject laws; e must be a value that the law has.
 */
static void theories_of_constant_e_reject_laws(void **state)
{
  (void)state;
  gg_scene s = viscoelastic(GG_USF);
  gg_model m = model_of(&s);
  gg_error err;
  for (int k = 0; gg_theory_theories[k]; k++) {
    gg_theory_answer answer;
    assert_int_equal(gg_theory_evaluate(gg_theory_theories[k], &m, &answer, &err), GG_BAD_INPUT);
    assert_non_null(strstr(err.message, "'viscoelastic'"));
  }
  s = viscoelastic(GG_SMALL_SHEAR);
  assert_int_equal(gg_scene_model_make(&s, GG_MD, &m, &err), GG_BAD_INPUT);
  s = viscoelastic(GG_HCS);
  s.collision.e[0] = 0;
  assert_int_equal(gg_scene_model_make(&s, GG_MD, &m, &err), GG_BAD_INPUT);
  assert_non_null(strstr(err.message, "collision.e"));
  s.collision.e[0] = 1 - 1e-7; /* the table of losses has none that small */
  assert_int_equal(gg_scene_model_make(&s, GG_MD, &m, &err), GG_BAD_INPUT);
  assert_non_null(strstr(err.message, "from 0.01 to 0.99999, or 1"));
}

int main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test(equation_of_motion),
                                     cmocka_unit_test(the_viscoelastic_series_has_published_coefficients),
                                     cmocka_unit_test(the_speed_of_a_loss_inverts_the_law),
                                     cmocka_unit_test(tables_of_laws_are_within_2e_7),
                                     cmocka_unit_test(straight_between_speeds),
                                     cmocka_unit_test(reference_speed),
                                     cmocka_unit_test(theories_of_constant_e_reject_laws)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
