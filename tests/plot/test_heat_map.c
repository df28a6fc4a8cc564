/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Maps of deviations: the scale is odd and rises throughout, and colours of either sign are equally dark, so that grey
 * tells the size. A map is drawn with cells that are unknown, hatched and not steady. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>

#include <cmocka.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "plot/heat_map.h"
#include "plot/plot.h"

static double lightness(unsigned colour)
{
  double sum = 0;
  const double weights[] = {0.2126, 0.7152, 0.0722};
  for (int k = 0; k < 3; k++) sum += weights[k] * pow((colour >> (16 - 8 * k) & 0xff) / 255.0, 2.2);
  return 116 * cbrt(sum) - 16; /* CIE L* */
}

static void test_scale(void **state)
{
  (void)state;
  assert_true(gg_plot_heat_place(0) == 0 && gg_plot_heat_place(1) == 1 && gg_plot_heat_place(-5) == -1);
  for (double v = 0.001; v < 0.9; v *= 1.3) {
    assert_true(gg_plot_heat_place(1.3 * v) > gg_plot_heat_place(v));
    assert_true(gg_plot_heat_place(-v) == -gg_plot_heat_place(v));
    assert_true(lightness(gg_plot_heat_colour(1.3 * v)) < lightness(gg_plot_heat_colour(v)));
    assert_true(lightness(gg_plot_heat_colour(-1.3 * v)) < lightness(gg_plot_heat_colour(-v)));
    assert_true(fabs(lightness(gg_plot_heat_colour(v)) - lightness(gg_plot_heat_colour(-v))) < 4);
  }
  assert_int_equal(gg_plot_heat_colour(0), 0xffffff);
}

/* Number of times that a text is in the file. */
static int count(const char *path, const char *what)
{
  static char text[1 << 20];
  FILE *f = fopen(path, "r");
  assert_non_null(f);
  text[fread(text, 1, sizeof text - 1, f)] = '\0';
  fclose(f);
  int n = 0;
  for (const char *at = text; (at = strstr(at, what)); at++) n++;
  return n;
}

static void test_drawn(void **state)
{
  (void)state;
  const gg_heat_cell cell[] = {{0.0012, 0.01, false, 0}, {0.03, 0.001, false, 0}, {-0.072, 0.001, true, 'c'},
                               {NAN, NAN, false, 0},     {NAN, NAN, false, 0},    {NAN, NAN, false, 0},
                               {NAN, NAN, false, 0},     {NAN, NAN, false, 0}};
  const char *values[] = {"0.1", "0.2"}, *columns[] = {"β = 0", "β = 1"}, *rows[] = {"md/dsmc - 1"};
  const gg_heat_map map = {"a map", 2, 2, "φ", "e", values, values, 2, 1, columns, rows, NULL, cell};
  char path[] = "/tmp/heatXXXXXX.svg";
  gg_error err;
  if (gg_plot_gnuplot_is_there(NULL) != GG_OK) skip();
  close(mkstemps(path, 4));
  assert_int_equal(gg_plot_heat_map_draw(&map, path, NULL, &err), GG_OK);
  assert_int_equal(count(path, "+0.1<"), 1);
  assert_int_equal(count(path, "+3.0<"), 1);
  assert_int_equal(count(path, "-7.2<"), 1);
  assert_int_equal(count(path, "no answer"), 1);
  assert_true(count(path, "β = 1") == 1 && count(path, "md/dsmc - 1") == 1);
  /* Each cross has an edge. A cross more where one more run is not steady, no hatch where no cell is below its errors.
   */
  gg_heat_cell other[8];
  memcpy(other, cell, sizeof cell);
  const int crosses = count(path, "xlink:href='#gpPt1'"), strokes = count(path, "rgb(136, 136, 136)");
  assert_true(crosses == 2 && strokes > 0);
  other[1].not_steady = true, other[0].error = 0.0001;
  gg_heat_map changed = map;
  changed.cell = other;
  assert_int_equal(gg_plot_heat_map_draw(&changed, path, "120mm", &err), GG_OK);
  assert_int_equal(count(path, "xlink:href='#gpPt1'"), 4);
  assert_true(count(path, "rgb(136, 136, 136)") < strokes);
  remove(path);
}

int main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_scale), cmocka_unit_test(test_drawn)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
