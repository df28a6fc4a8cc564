/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Engines and theories side by side, over an engine whose answers are planted and over made-up results: what differs is
 * marked, and causes are named. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>
#include <math.h>
#include <string.h>

#include "fake_engine.h"
#include "graingas.h"
#include "run/z_scores.h"
#include "scene/model_of_scene.h"

/* A comparison puts both columns and the theories side by side; z is the difference over the combined error. */
static void z_is_the_difference_over_the_combined_error(void **state)
{
  (void)state;
  gg_scene s = planted_scene(0);
  s.dsmc.particles = 512; /* one chunk */
  gg_comparison c;
  gg_error err;
  assert_int_equal(gg_run_compare_scene(&s, NULL, 2, NULL, &c, &err), GG_OK);
  assert_non_null(c.by_engine[GG_MD]);
  assert_non_null(c.by_engine[GG_DSMC]);
  gg_estimate a = {.mean = 1, .error = 0.03}, b = {.mean = 1.5, .error = 0.04};
  assert_true(fabs(gg_run_z_score(&a, &b) + 10) < 1e-12);
  gg_run_comparison_clear(&c);
}

/* Differences are marked only where they exceed four errors and what is expected at that density, and a cause is named.
 */
static void only_unexpected_differences_are_marked(void **state)
{
  (void)state;
  gg_scene s = planted_scene(0);
  gg_result md = {.scene = &s, .engine = "md"}, dsmc = {.scene = &s, .engine = "dsmc"};
  gg_comparison c = {.scene = &s, .by_engine = {&md, &dsmc}};
  assert_int_equal(gg_scene_model_make(&s, GG_MD, &c.model, NULL), GG_OK);
  gg_run_rows_make(&c.model, &c.rows);
  const struct {
    double phi, md, error;
    bool marked;
  } cases[] = {{0.2, 1.02, 0.001, false}, {0.2, 1.05, 0.001, true},  {0.2, 1.05, 0.02, false},
               {0.01, 1.02, 0.001, true}, {0.4, 1.05, 0.001, false}, {0.4, 1.2, 0.001, true}};
  for (int i = 0; i < 6; i++) {
    gg_causes causes;
    c.model.phi = cases[i].phi;
    md.value[GG_Q_TEMPERATURE] = (gg_estimate){.mean = cases[i].md, .error = cases[i].error};
    dsmc.value[GG_Q_TEMPERATURE] = (gg_estimate){.mean = 1, .error = 0.001};
    assert_int_equal(gg_run_results_disagree(&c, GG_Q_TEMPERATURE), cases[i].marked);
    gg_run_causes_find(&c, &causes);
    assert_int_equal(causes.n > 0, cases[i].marked);
  }
}

/* Both engines are compared with the noise-free solution where it exists. A number near zero has a difference and no
 * ratio; the numerical error adds to that of the engine. */
static void engines_are_compared_with_the_noise_free_solution(void **state)
{
  (void)state;
  gg_scene s = planted_scene(0);
  gg_result md = {.scene = &s, .engine = "md"}, dsmc = {.scene = &s, .engine = "dsmc"};
  gg_comparison c = {.scene = &s, .by_engine = {&md, &dsmc}, .n_theories = 1};
  gg_departure d;
  assert_int_equal(gg_scene_model_make(&s, GG_MD, &c.model, NULL), GG_OK);
  c.model.phi = 0.2;
  md.value[GG_Q_TEMPERATURE] = (gg_estimate){.mean = 2.2, .error = 0.008};
  dsmc.value[GG_Q_TEMPERATURE] = (gg_estimate){.mean = 2.1, .error = 0.1};
  md.value[GG_Q_N1] = (gg_estimate){.mean = 0.11, .error = 0.01};
  md.value[GG_Q_A2] = (gg_estimate){.mean = 0.11, .error = NAN};
  assert_false(gg_run_enskog_deviation(&c, GG_MD, GG_Q_TEMPERATURE, &d));
  assert_false(gg_run_results_disagree(&c, GG_Q_TEMPERATURE)); /* dsmc's noise hides it */

  c.theory[0].theory = &gg_theory_enskog_hermite;
  c.theory[0].applies = true;
  gg_theory_answer *a = &c.theory[0].answer;
  a->value[GG_Q_TEMPERATURE] = 2, a->error[GG_Q_TEMPERATURE] = 0.006;
  a->value[GG_Q_N1] = 0.1, a->error[GG_Q_N1] = NAN;
  a->value[GG_Q_A2] = 0.1, a->error[GG_Q_A2] = 0.001;
  a->value[GG_Q_N2] = NAN;
  assert_true(gg_run_enskog_deviation(&c, GG_MD, GG_Q_TEMPERATURE, &d));
  assert_true(fabs(d.difference - 0.2) < 1e-12 && fabs(d.error - 0.01) < 1e-12 && fabs(d.z - 20) < 1e-9);
  assert_true(fabs(d.deviation - 0.1) < 1e-12 && fabs(d.deviation_error - hypot(0.008, 1.1 * 0.006) / 2) < 1e-12 &&
              d.headline);
  assert_true(gg_run_results_disagree(&c, GG_Q_TEMPERATURE));
  assert_true(gg_run_enskog_deviation(&c, GG_DSMC, GG_Q_TEMPERATURE, &d));
  assert_true(fabs(d.z - 0.1 / hypot(0.1, 0.006)) < 1e-9);
  assert_true(gg_run_enskog_deviation(&c, GG_MD, GG_Q_N1, &d));
  assert_true(fabs(d.difference - 0.01) < 1e-12 && fabs(d.z - 1) < 1e-9 && isnan(d.deviation));
  assert_false(gg_run_enskog_deviation(&c, GG_MD, GG_Q_A2, &d)); /* no error of md's */
  assert_false(gg_run_enskog_deviation(&c, GG_MD, GG_Q_N2, &d)); /* no solution */

  dsmc.value[GG_Q_TEMPERATURE] = (gg_estimate){.mean = 2.2, .error = 0.001}; /* biased as md */
  assert_true(gg_run_results_disagree(&c, GG_Q_TEMPERATURE));
  c.by_engine[GG_DSMC] = NULL;
  assert_true(gg_run_results_disagree(&c, GG_Q_TEMPERATURE));
  c.theory[0].applies = false;
  assert_false(gg_run_results_disagree(&c, GG_Q_TEMPERATURE));
}

/* Theories are remarked on where they are off by more than four errors and more than expected: with the cause that
 * applies, be it the theory's range or, where it agrees with the Monte Carlo engine, what Enskog's equation leaves out.
 */
static void deviating_theories_have_a_remark(void **state)
{
  (void)state;
  const struct {
    double e, md, dsmc, lun, error;
    const char *cause; /* NULL: nothing to remark on */
  } cases[] = {{0.98, 1, 1, 1.02, 0.001, NULL},
               {0.98, 1, 1, 1.2, 0.06, NULL},
               {0.98, 1, 1, 1.2, 0.001, "no cause"},
               {0.8, 1, 1, 1.2, 0.001, "quasi-elastic"},
               {0.98, 1, 1.2, 1.2, 0.001, "agrees with dsmc"}};
  gg_scene s = planted_scene(-1);
  gg_result md = {.scene = &s, .engine = "md"}, dsmc = {.scene = &s, .engine = "dsmc"};
  gg_comparison c = {.scene = &s, .by_engine = {&md, &dsmc}};
  for (int i = 0; i < 5; i++) {
    gg_run_theory_remark r[GG_MOST_THEORIES];
    for (int p = 0; p < GG_PAIRS; p++) s.collision.e[p] = cases[i].e;
    assert_int_equal(gg_scene_model_make(&s, GG_MD, &c.model, NULL), GG_OK);
    bool wanted[GG_MOST_THEORIES] = {false}; /* all but one, which takes seconds */
    const gg_theory *theory;
    for (int k = 0; k < GG_MOST_THEORIES && (theory = gg_theory_of(&c.model, k)); k++)
      wanted[k] = theory != &gg_theory_enskog_hermite;
    assert_int_equal(gg_run_compare_theories(&c.model, wanted, &c, NULL), GG_OK);
    for (int k = 0; k < c.n_theories; k++) c.theory[k].applies = strcmp(c.theory[k].theory->name, "lun1991") == 0;
    for (int q = 0; q < GG_N_QUANTITIES; q++) md.value[q].mean = dsmc.value[q].mean = NAN;
    md.value[GG_Q_TEMPERATURE] = (gg_estimate){.mean = cases[i].md, .error = cases[i].error};
    dsmc.value[GG_Q_TEMPERATURE] = (gg_estimate){.mean = cases[i].dsmc, .error = cases[i].error};
    for (int k = 0; k < c.n_theories; k++) c.theory[k].answer.value[GG_Q_TEMPERATURE] = cases[i].lun;
    int n = gg_run_theory_remarks(&c, r);
    assert_int_equal(n, cases[i].cause ? 1 : 0);
    if (n == 0) continue;
    assert_int_equal(r[0].quantity, GG_Q_TEMPERATURE);
    assert_true(fabs(r[0].deviation - (cases[i].lun / cases[i].md - 1)) < 1e-12);
    assert_non_null(strstr(r[0].cause, cases[i].cause));
  }
}
int main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test(z_is_the_difference_over_the_combined_error),
                                     cmocka_unit_test(only_unexpected_differences_are_marked),
                                     cmocka_unit_test(engines_are_compared_with_the_noise_free_solution),
                                     cmocka_unit_test(deviating_theories_have_a_remark)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
