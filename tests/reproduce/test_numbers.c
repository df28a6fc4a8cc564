/* Numbers that are read off what was measured: where a quantity vanishes, where it is least, powers, tails; and figures
 * found by name. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "reproduce/figures.h"
#include "reproduce/points.h"
#include "reproduce/straight.h"
#include "scene/scene_reader.h"

static void near_to(double value, double expected, double within)
{
  if (!(fabs(value - expected) <= within)) fail_msg("%g, expected %g", value, expected);
}

static void where_it_vanishes(void **state)
{
  (void)state;
  const double x[] = {0.1, 0.2, 0.3}, y[] = {-0.02, -0.01, 0.03}, e[] = {0.001, 0.002, 0.002};
  gg_told zero = gg_reproduce_find_zero(3, x, y, e);
  near_to(zero.mean, 0.225, 1e-12);
  near_to(zero.error, 0.002 * hypot(0.75, 0.25) / 0.4, 1e-12);
  assert_true(isnan(gg_reproduce_find_zero(2, x, y, e).mean));
  const double twice[] = {0, 0, 0.01}, unknown[] = {NAN, -0.01, 0.03};
  near_to(gg_reproduce_find_zero(3, x, twice, e).mean, 0.2, 1e-12); /* where it is 0 all along, nobody can say */
  near_to(gg_reproduce_find_zero(3, x, unknown, e).mean, 0.225, 1e-12);
}

/* Of T = 1/x + x: least at 1, also between the points, in ln x where it is symmetric. */
static void where_it_is_least(void **state)
{
  (void)state;
  double x[5], y[5], e[5] = {0.01, 0.01, 0.01, 0.01, 0.01};
  for (int i = 0; i < 5; i++) x[i] = exp(0.2 * i - 0.45), y[i] = x[i] + 1 / x[i];
  gg_told least = gg_reproduce_find_extreme(5, x, y, e, true);
  near_to(least.mean, 1, 2e-3);
  assert_true(least.error > 0.01 && least.error < 0.2);
  assert_true(isnan(gg_reproduce_find_extreme(5, x, y, e, false).mean)); /* at an end: nobody knows */
  for (int i = 0; i < 5; i++) x[i] = 0.1 * i - 0.1, y[i] = x[i] * x[i];  /* not above 0: as it is */
  near_to(gg_reproduce_find_extreme(5, x, y, e, true).mean, 0, 1e-12);
  assert_true(isnan(gg_reproduce_find_extreme(2, x, y, e, true).mean));
}

static void powers(void **state)
{
  (void)state;
  double x[6], y[6], e[6];
  for (int i = 0; i < 6; i++) x[i] = 0.1 * (i + 1), y[i] = 0.625 * pow(x[i], 2. / 3), e[i] = 0.01 * y[i];
  near_to(gg_reproduce_find_power(6, x, y, e, true).mean, 2. / 3, 1e-12);
  near_to(gg_reproduce_find_power(6, x, y, e, false).mean, 0.625, 1e-12);
  assert_true(gg_reproduce_find_power(6, x, y, e, true).error > 0);
}

static void straight_lines(void **state)
{
  (void)state;
  const double x[] = {1, NAN, 2, 3, 4}, y[] = {3, 1, INFINITY, 7, 9}, e[] = {0.1, 0.1, 0.1, 0.1, 0};
  gg_straight line;
  assert_true(gg_reproduce_straight_fit(5, x, y, e, &line)); /* two of them are known */
  near_to(line.a, 1, 1e-12);
  near_to(line.b, 2, 1e-12);
  assert_false(gg_reproduce_straight_fit(3, x, y, e, &line));
  const double same[] = {2, 2};
  assert_false(gg_reproduce_straight_fit(2, same, y, e, &line));
}

static void figures_by_name(void **state)
{
  (void)state;
  static const char *const names[] = {"thesis 2.16", "Thesis-2.16", "2.16", "thesis 2.16.yaml", "thesis_2.16"};
  size_t first, k;
  gg_error err;
  assert_int_equal(gg_reproduce_figure_find("thesis-2.16", &first, &err), GG_OK);
  assert_string_equal(gg_entry_files[first].file, "thesis-2.16.yaml");
  for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
    if (gg_reproduce_figure_find(names[i], &k, &err) != GG_OK) fail_msg("%s: %s", names[i], err.message);
    assert_int_equal(k, first);
  }
  assert_int_equal(gg_reproduce_figure_find("review 3", &k, &err), GG_OK);
  assert_string_equal(gg_entry_files[k].file, "review-03.yaml");
  assert_int_equal(gg_reproduce_figure_find("review 33", &k, &err), GG_BAD_INPUT);
  assert_int_equal(gg_reproduce_figure_find(" - thesis :2.016 _", &k, &err), GG_OK);
  assert_int_equal(k, first);
  char longest[200];
  memset(longest, 'x', sizeof longest - 1);
  longest[sizeof longest - 1] = '\0';
  assert_int_equal(gg_reproduce_figure_find(longest, &k, &err), GG_BAD_INPUT);
  assert_int_equal(gg_reproduce_figure_find("", &k, &err), GG_BAD_INPUT);
  gg_figure_entry entry;
  assert_int_equal(gg_reproduce_figure_read(10000, &entry, &err), GG_BAD_INPUT);
}

/* {key: [values]}: does the scene meet it? */
static bool meets(const gg_scene *scene, const char *key, const char *one, const char *other)
{
  gg_conditions c = {.n = 1, .of = {{.key = key, .values = {.n = other ? 2 : 1, .text = {one, other}}}}};
  return gg_reproduce_scene_meets(scene, &c);
}

static void conditions(void **state)
{
  (void)state;
  gg_scene s = gg_scene_defaults();
  assert_int_equal(gg_scene_override(&s, "phi", "0.3", NULL), GG_OK);
  assert_int_equal(gg_scene_override(&s, "flow", "usf", NULL), GG_OK);
  assert_int_equal(gg_scene_override(&s, "measure", "[rheology, cells]", NULL), GG_OK);
  assert_true(meets(&s, "phi", "0.3", NULL) && meets(&s, "phi", "0.1", "3e-1") && !meets(&s, "phi", "0.1", "0.2"));
  assert_true(meets(&s, "flow", "usf", NULL) && !meets(&s, "flow", "hcs", NULL) && !meets(&s, "flow", "usd", NULL));
  assert_true(meets(&s, "measure", "[rheology, cells]", NULL) && !meets(&s, "measure", "[cells]", NULL));
  assert_true(meets(&s, "collision.mu", "inf", NULL) && !meets(&s, "collision.mu", "0.1", NULL));
  assert_false(meets(&s, "phi", "0.3 or so", ""));
  char text[80];
  gg_reproduce_key_text(&s, "flow", text, sizeof text);
  assert_string_equal(text, "usf");
  assert_int_equal(gg_scene_override(&s, "species", "[{fraction: 0.5}, {fraction: 0.5, mass: 4}]", NULL), GG_OK);
  assert_int_equal(gg_scene_override(&s, "collision.e", "{11: 0.9, 12: 0.8, other: 0.7}", NULL), GG_OK);
  assert_true(meets(&s, "species.2.mass", "4", NULL) && !meets(&s, "species.1.mass", "4", NULL));
  assert_true(meets(&s, "collision.e.12", "0.8", NULL) && meets(&s, "collision.e.22", "0.7", NULL));
  static const char *const nothing[] = {"species.3.mass", "species.0.mass",   "species.2.colour",
                                        "species.2mass",  "species.two.mass", "no.such.key"};
  for (int i = 0; i < 6; i++) {
    gg_reproduce_key_text(&s, nothing[i], text, sizeof text);
    assert_string_equal(text, "");
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(where_it_vanishes), cmocka_unit_test(where_it_is_least), cmocka_unit_test(powers),

      cmocka_unit_test(straight_lines),    cmocka_unit_test(conditions),        cmocka_unit_test(figures_by_name),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
