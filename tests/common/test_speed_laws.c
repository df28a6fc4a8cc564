/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Coefficients that depend on the normal speed: portable functions beside those of C, tables of laws beside the laws,
 * steps to the last bit, values that are not allowed, invalid texts, and what a model makes of them. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "common/laws/coefficient_tables.h"
#include "common/portable_functions.h"
#include "common/rng.h"
#include "scene/model_of_scene.h"
#include "scene/scene_reader.h"

static void near(const char *name, double x, double is, double expected, double error)
{
  if (!(fabs(is - expected) <= error * fabs(expected)))
    fail_msg("%s(%.17g) is %.17g, not %.17g", name, x, is, expected);
}

static void portable_functions_are_those_of_c(void **state)
{
  (void)state;
  gg_rng rng = gg_common_rng_seed(1, 0);
  for (int i = 0; i < 20000; i++) {
    const double x = 20 * gg_rng_uniform(&rng) - 10, y = exp(x), small = 1e-3 * x;
    near("exp", x, gg_common_portable_exp(x), y, 4e-16);
    near("ln", y, gg_common_portable_ln(y), log(y), 5e-16);
    near("ln", 1 + small, gg_common_portable_ln(1 + small), log(1 + small), 6e-16);
    near("log10", y, gg_common_portable_log10(y), log10(y), 8e-16);
    near("pow", y, gg_common_portable_pow(y, 0.37), pow(y, 0.37), 4e-15);
    near("pow", x, gg_common_portable_pow(x, 3), x * x * x, 4e-16);
    near("atan", x, gg_common_portable_atan(x), atan(x), 1e-15);
    near("tanh", x, gg_common_portable_tanh(x), tanh(x), 8e-16);
    near("tanh", small, gg_common_portable_tanh(small), tanh(small), 8e-16);
    near("erf", x, gg_common_portable_erf(x), erf(x), 4e-15);
    assert_true(fabs(gg_common_portable_sin(x) - sin(x)) < 4e-16 && fabs(gg_common_portable_cos(x) - cos(x)) < 4e-16);
  }
  assert_true(gg_common_portable_exp(-800) == 0 && isinf(gg_common_portable_exp(800)) && isnan(gg_common_portable_ln(-1)));
  assert_true(gg_common_portable_pow(0, 0.2) == 0 && isnan(gg_common_portable_pow(-1, 0.5)) && gg_common_portable_pow(-8, 101) < 0);
}

static gg_loss_table *table_of(gg_contact_coefficient of, const char *text)
{
  gg_loss_table *t;
  gg_error err;
  if (gg_common_law_table_new(of, text, &t, &err) != GG_OK) fail_msg("%s: %s", text, err.message);
  return t;
}

/* 1 - e, 1 + beta, mu. */
static double stored(gg_contact_coefficient of, double x)
{
  return of == GG_OF_E ? 1 - x : of == GG_OF_BETA ? 1 + x : x;
}

/* Tables are within 2e-6 of smooth laws. Steps between constants are exact; where the slope changes by b at v, the
 * table is within b v/1024, here 2e-4. */
static void tables_follow_laws(void **state)
{
  (void)state;
  static const struct {
    gg_contact_coefficient of;
    const char *text;
    double within;
  } cases[] = {
      {GG_OF_E, "1 - 0.2*v^0.2", 2e-7},
      {GG_OF_E, "0.9 if v < 2 else 0.6", 1e-15},
      {GG_OF_E, "0.5 + 0.4*exp(-v) if v < 1.3 else 0.3 + 0.1*tanh(v) if v <= 2.7 else 1.2", 2e-4},
      {GG_OF_BETA, "atan(v) - 1 if v > 0.5 else -0.5", 2e-6},
      {GG_OF_MU, "0.5/(1 + v)", 1e-6},
      {GG_OF_E, "table 0 0.9;1 0.9;1 0.5;4 0.5;", 1e-15},
  };
  gg_rng rng = gg_common_rng_seed(2, 0);
  for (size_t c = 0; c < sizeof cases / sizeof *cases; c++) {
    gg_loss_table *t = table_of(cases[c].of, cases[c].text);
    gg_speed_law law;
    assert_int_equal(gg_common_speed_law_parse(&law, cases[c].of, cases[c].text, NULL), GG_OK);
    double worst = 0;
    for (int i = 0; i < 50000; i++) {
      const double v = exp2(12 * gg_rng_uniform(&rng) - 6);
      const double is = gg_law_table_at(t, ldexp(v, -GG_LAW_OCTAVES)),
                   expected = stored(cases[c].of, gg_common_speed_law_value(&law, v, NULL));
      worst = fmax(worst, fabs(is - expected));
    }
    print_message("# %s: within %.1e\n", cases[c].text, worst);
    assert_true(worst < cases[c].within);
    free(t);
  }
}

/* The step is between two neighbouring numbers, on the side that the sign says. */
static void steps_are_exact(void **state)
{
  (void)state;
  static const double at[] = {2, 0.3, 1.7320508075688772, 77.7};
  char text[80];
  for (int k = 0; k < 8; k++) {
    const bool also = k >= 4;
    snprintf(text, sizeof text, "0.9 if v %s %.17g else 0.6", also ? "<=" : "<", at[k % 4]);
    gg_loss_table *t = table_of(GG_OF_E, text);
    const double v = at[k % 4], first = also ? nextafter(v, INFINITY) : v, last = nextafter(first, 0);
    assert_int_equal(t->n_steps, 1);
    assert_true(fabs(gg_law_table_at(t, ldexp(last, -GG_LAW_OCTAVES)) - 0.1) < 1e-15);
    assert_true(fabs(gg_law_table_at(t, ldexp(first, -GG_LAW_OCTAVES)) - 0.4) < 1e-15);
    free(t);
  }
  gg_loss_table *kink = table_of(GG_OF_E, "0.9 - 0.1*v if v < 2 else 0.7");
  assert_int_equal(kink->n_steps, 0);
  free(kink);
}

/* Values that are not allowed are the nearest allowed ones, and speeds with them are known. */
static void values_beyond_are_clamped(void **state)
{
  (void)state;
  gg_loss_table *t = table_of(GG_OF_E, "1 - 0.5*v");
  for (double v = 0.15; v < 9; v += 0.1) {
    const double u = ldexp(v, -GG_LAW_OCTAVES);
    assert_true(fabs(gg_law_table_at(t, u) - fmin(0.5 * v, 1)) < 1e-3 && gg_law_table_clamps(t, u) == (v > 2));
  }
  assert_false(gg_law_table_clamps(t, ldexp(1.99999, -GG_LAW_OCTAVES)));
  assert_true(gg_law_table_clamps(t, ldexp(2.00001, -GG_LAW_OCTAVES)));
  free(t);
  t = table_of(GG_OF_E, "ln(-1) if v < 1 else 1.5"); /* NaN: 0; e above 1 is allowed */
  assert_true(gg_law_table_clamps(t, ldexp(0.5, -GG_LAW_OCTAVES)) &&
              !gg_law_table_clamps(t, ldexp(1, -GG_LAW_OCTAVES)));
  assert_true(gg_law_table_at(t, ldexp(0.5, -GG_LAW_OCTAVES)) == 1 && gg_law_table_at(t, 1) == -0.5);
  free(t);
  t = table_of(GG_OF_BETA, "v - 1");
  assert_true(gg_law_table_at(t, ldexp(5, -GG_LAW_OCTAVES)) == 2 && gg_law_table_clamps(t, ldexp(5, -GG_LAW_OCTAVES)));
  free(t);
  t = table_of(GG_OF_MU, "inf if v < 1 else 0.25");
  assert_true(gg_law_table_at(t, ldexp(0.5, -GG_LAW_OCTAVES)) == GG_LAW_MOST &&
              fabs(gg_law_table_at(t, ldexp(1, -GG_LAW_OCTAVES)) - 0.25) < 1e-9 && t->n_invalid == 0);
  free(t);
}

static void texts_that_are_wrong(void **state)
{
  (void)state;
  static const struct {
    gg_contact_coefficient of;
    const char *text, *says;
  } cases[] = {
      {GG_OF_E, "1 - 0.2*w", "character 9: not known"},
      {GG_OF_E, "1 - 0.2*v)", "character 10"},
      {GG_OF_E, "sin(100*v) > 0", "more than 16 steps"},
      {GG_OF_E, "table 0 0.9;2 0.8;1 0.7;", "row 3: the speed 1; speeds ascend"},
      {GG_OF_E, "table 0 0.9;1 0.8;1 0.7;1 0.6;", "row 4: the speed 1 a third time"},
      {GG_OF_E, "table 0 0.9;1 -0.1;", "row 2: e = -0.1; allowed: from 0 to 1e+06"},
      {GG_OF_BETA, "table 0 1.1;", "row 1: beta = 1.1; allowed: from -1 to 1"},
      {GG_OF_MU, "table -1 0.1;", "row 1: the speed -1"},
  };
  for (size_t c = 0; c < sizeof cases / sizeof *cases; c++) {
    gg_speed_law law;
    gg_error err = {0};
    bool above = false, below = false;
    gg_status status = gg_common_speed_law_parse(&law, cases[c].of, cases[c].text, &err);
    if (status == GG_OK) status = gg_common_speed_law_check(&law, &above, &below, &err);
    if (status != GG_BAD_INPUT || !strstr(err.message, cases[c].says)) fail_msg("%s: %s", cases[c].text, err.message);
  }
}

static gg_scene scene_of(const char *yaml)
{
  gg_scene s = gg_scene_defaults();
  gg_error err;
  gg_status status = gg_scene_read(&s, yaml, strlen(yaml), "test", &err);
  if (status == GG_OK) status = gg_scene_finish(&s, &err);
  if (status != GG_OK) fail_msg("%s: %s", yaml, err.message);
  return s;
}

/* Pairs have laws of their own; equal texts are kept once; the JSON of a scene is read back as the same laws; a number
 * takes the place of a law. */
static void laws_by_pair(void **state)
{
  (void)state;
  static const char mixture[] = "flow: hcs\nphi: 0.1\nspecies: [{mass: 1}, {mass: 2}]\n"
                                "collision: {e: {11: 1 - 0.1*v, 12: 0.8, 22: {table: [[0, 0.9], [1, 0.9], [1, 0.5]]}}, "
                                "mu: {11: '0.3 if v < 1 else 0.1', other: 0.2}, beta: 0}";
  gg_scene s = scene_of(mixture), back = gg_scene_defaults();
  gg_error err;
  assert_string_equal(gg_speed_law_text(&s.collision.by_speed, GG_OF_E, GG_11), "1 - 0.1*v");
  assert_null(gg_speed_law_text(&s.collision.by_speed, GG_OF_E, GG_12));
  assert_string_equal(gg_speed_law_text(&s.collision.by_speed, GG_OF_E, GG_22), "table 0 0.9;1 0.9;1 0.5;");
  assert_non_null(gg_speed_law_text(&s.collision.by_speed, GG_OF_MU, GG_11));
  assert_true(s.collision.by_speed.loses && !s.collision.by_speed.gains);
  char *yaml = gg_scene_yaml(&s);
  assert_int_equal(gg_scene_read(&back, yaml, strlen(yaml), "back", &err), GG_OK);
  assert_memory_equal(&s.collision.by_speed, &back.collision.by_speed, sizeof s.collision.by_speed);
  free(yaml);
  assert_int_equal(gg_scene_override(&s, "collision.e", "0.7", &err), GG_OK);
  assert_int_equal(gg_scene_override(&s, "collision.mu.11", "0.2", &err), GG_OK);
  const gg_speed_laws none = {0};
  assert_memory_equal(&s.collision.by_speed, &none, sizeof none);
}

/* Speeds are those of the scene: with lengths and times of its own, too. */
static void speeds_are_those_of_the_scene(void **state)
{
  (void)state;
  gg_scene s = scene_of("flow: usf\nphi: 0.1\nshear_rate: 4\nspecies: [{diameter: 0.5}]\ncollision: {e: 1 - 0.1*v}");
  gg_model *m = malloc(sizeof *m);
  gg_coefficient_tables *t;
  gg_error err;
  assert_int_equal(gg_scene_model_make(&s, GG_MD, m, &err), GG_OK);
  assert_true(m->speed_unit == 2 && !m->elastic && gg_common_pair_loses(m, 0, 0));
  assert_int_equal(gg_common_coefficient_tables_new(m, &t, &err), GG_OK);
  const double loss = gg_law_table_at(t->of[GG_OF_E][0], t->scale[0] * 1.5); /* v = 3 */
  assert_true(fabs(loss - 0.3) < 1e-12);
  gg_common_coefficient_tables_free(t);
  gg_common_model_at(m, 8 / M_PI); /* the mean normal speed at impact is sqrt(pi T) = sqrt(8), v twice that */
  assert_true(fabs(m->e[0] - (1 - 0.2 * sqrt(8))) < 1e-12);
  free(m);
}

/* Constant formulas are numbers, with the limits of numbers. */
static void constant_formulas_are_numbers(void **state)
{
  (void)state;
  gg_scene s = scene_of("flow: hcs\nphi: 0.1\ncollision: {e: '0.9', beta: '-1/2', mu: {table: [[0, 0.3], [5, 0.3]]}}");
  const gg_speed_laws none = {0};
  gg_error err;
  assert_memory_equal(&s.collision.by_speed, &none, sizeof none);
  assert_true(s.collision.e[0] == 0.9 && s.collision.beta[0] == -0.5 && s.collision.mu[0] == 0.3);
  assert_int_equal(gg_scene_override(&s, "collision.e", "'1.1 + 0'", &err), GG_BAD_INPUT);
  assert_non_null(strstr(err.message, "allowed: a number from 0 to 1"));
}

int main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test(portable_functions_are_those_of_c),
                                     cmocka_unit_test(tables_follow_laws),
                                     cmocka_unit_test(steps_are_exact),
                                     cmocka_unit_test(values_beyond_are_clamped),
                                     cmocka_unit_test(texts_that_are_wrong),
                                     cmocka_unit_test(laws_by_pair),
                                     cmocka_unit_test(speeds_are_those_of_the_scene),
                                     cmocka_unit_test(constant_formulas_are_numbers)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
