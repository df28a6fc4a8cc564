/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Charts: every point is at the place of its numbers, on linear and logarithmic axes, with a bar as long as its error.
 * NaN, and numbers without a place on a logarithmic axis, are not drawn. Methods and groups differ without colours, and
 * have one look in all panels. */
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

#include "plot/chart.h"
#include "plot/plot.h"

enum {
  MOST = 64,
  FILLED_CIRCLE = 6,
  OPEN_CIRCLE = 5,
  OPEN_SQUARE = 3,
  FILLED_SQUARE = 4
}; /* gnuplot's svg counts from 0 */

static char folder[] = "/tmp/graingas-chart-XXXXXX";

static int enter(void **state)
{
  (void)state;
  return mkdtemp(folder) && chdir(folder) == 0 ? 0 : -1;
}

static int leave(void **state)
{
  (void)state;
  unlink("c.svg");
  unlink("c.png");
  unlink("c.pdf");
  return chdir("/") == 0 ? rmdir(folder) : -1;
}

static gg_status draw(gg_chart *chart, const char *picture, const char *width, gg_error *err)
{
  gg_plot_paper paper;
  gg_status status = gg_plot_paper_choose(&paper, picture, NULL, width, err);
  if (status == GG_OK) return gg_plot_chart_finish(chart, &paper, picture, err);
  gg_plot_chart_free(chart);
  return status;
}

static char *drawn(gg_chart *chart)
{
  gg_error err;
  if (draw(chart, "c.svg", NULL, &err) != GG_OK) fail_msg("%s", err.message);
  FILE *f = fopen("c.svg", "r");
  char *text = calloc(1, 1 << 20);
  assert_non_null(f);
  assert_true(fread(text, 1, (1 << 20) - 1, f) > 0);
  fclose(f);
  return text;
}

/* A series of the last panel; error NULL: none. */
static gg_chart_series *add(gg_chart *c, const char *method, const char *group, int style, size_t n, const double *x,
                            const double *y, const double *error)
{
  gg_chart_series *s = gg_plot_chart_series(c, method, group, style);
  for (size_t i = 0; i < n; i++)
    gg_plot_chart_point(c, s, (gg_chart_point){x[i], y[i], error ? error[i] : NAN, NAN, false});
  return s;
}

typedef struct mark {
  int symbol;
  double x, y, size;
} mark;

/* Symbols of the page in their colours; those of white clear the ground behind others. */
static int marks_of(const char *svg, int symbol, mark marks[])
{
  int n = 0;
  mark m;
  for (const char *at = svg; (at = strstr(at, "<use xlink:href='#gpPt")); at++) {
    if (sscanf(at, "<use xlink:href='#gpPt%d' transform='translate(%lf,%lf) scale(%lf)", &m.symbol, &m.x, &m.y,
               &m.size) != 4)
      continue;
    const char *white = strstr(at, "#FFFFFF"), *end = strstr(at, "/>");
    if (m.symbol == symbol && !(white && white < end) && n < MOST) marks[n++] = m;
  }
  return n;
}

/* The upright stroke through a point, which is at no tic: how long. */
static double bar_at(const char *svg, double x)
{
  double a[2], b[2];
  for (const char *at = svg; (at = strchr(at, 'M')); at++)
    if (sscanf(at, "M%lf,%lf L%lf,%lf", &a[0], &a[1], &b[0], &b[1]) == 4 && a[0] == b[0] && fabs(a[0] - x) < 0.02)
      return fabs(a[1] - b[1]);
  return 0;
}

static const double x3[] = {1.5, 15, 150}, y3[] = {2, 3, 4}, e3[] = {0.5, 0.25, NAN}, e4[] = {2, 2.5, 3};

static void points_are_at_their_places(void **state)
{
  (void)state;
  gg_chart *chart = gg_plot_chart_new();
  gg_chart_panel *panel = gg_plot_chart_panel(chart);
  panel->x.label = "x", panel->x.log = true, panel->y.label = "y";
  add(chart, "md", NULL, GG_CHART_POINTS, 3, x3, y3, e3);
  char *svg = drawn(chart);
  mark m[MOST];
  assert_int_equal(marks_of(svg, FILLED_CIRCLE, m), 4); /* the first is in the legend */
  assert_true(fabs(m[3].x - m[2].x - (m[2].x - m[1].x)) < 0.05);
  assert_true(fabs(m[2].y - m[3].y - (m[1].y - m[2].y)) < 0.05);
  double unit = m[1].y - m[2].y;
  assert_true(unit > 20 && fabs(bar_at(svg, m[1].x) - 2 * 0.5 * unit) < 0.05);
  assert_true(fabs(bar_at(svg, m[2].x) - 2 * 0.25 * unit) < 0.05);
  assert_true(bar_at(svg, m[3].x) == 0);
  free(svg);
}

static int marks_of_chart(size_t n, bool log_x)
{
  const double x[] = {-1, 1, 2, 3, 4}, y[] = {1, 0, NAN, 5, 6};
  gg_chart *chart = gg_plot_chart_new();
  gg_chart_panel *panel = gg_plot_chart_panel(chart);
  panel->y.log = true, panel->x.log = log_x;
  add(chart, "md", NULL, GG_CHART_POINTS, n, x, y, NULL);
  mark m[MOST];
  char *svg = drawn(chart);
  const int marks = marks_of(svg, FILLED_CIRCLE, m);
  free(svg);
  return marks;
}

static void numbers_without_a_place(void **state)
{
  (void)state;
  assert_int_equal(marks_of_chart(5, false), 3 + 1); /* one in the legend */
  assert_int_equal(marks_of_chart(5, true), 2 + 1);
  assert_int_equal(marks_of_chart(0, true), 0); /* an empty frame */
}

static int count(const char *text, const char *what)
{
  int n = 0;
  for (const char *at = text; (at = strstr(at, what)); at++) n++;
  return n;
}

/* Symbols of runs that are not steady are open, at their places, and the text below the picture is whole. */
static void unsteady_runs_are_open(void **state)
{
  (void)state;
  gg_chart *chart = gg_plot_chart_new();
  gg_plot_chart_panel(chart)->x.log = true;
  add(chart, "md", NULL, GG_CHART_POINTS, 3, x3, y3, e3)->point[1].open = true;
  chart->note = "Open symbols: not steady, point 2 of some that have a name so "
                "long that one line of the page has no room for it at all";
  mark filled[MOST], empty[MOST];
  char *svg = drawn(chart);
  assert_int_equal(marks_of(svg, FILLED_CIRCLE, filled), 2 + 1);
  assert_int_equal(marks_of(svg, OPEN_CIRCLE, empty), 1);
  assert_true(fabs(empty[0].x - (filled[1].x + filled[2].x) / 2) < 0.05);
  assert_true(bar_at(svg, empty[0].x) > 5);
  assert_int_equal(count(svg, ">Open symbols: not steady, point 2") + count(svg, "for it at all"), 2);
  free(svg);
}

/* The texts of the page without their marks, a line each: "2·10^6" is a text of three pieces. */
static char *texts_of(const char *svg)
{
  char *texts = calloc(1, strlen(svg) + 1), *to = texts;
  for (const char *at = svg; (at = strstr(at, "<text>")); *to++ = '\n')
    for (const char *end = strstr(at, "</text>"); at < end; at++) {
      if (*at == '<')
        at = strchr(at, '>');
      else if (*at != ' ')
        *to++ = *at;
    }
  return texts;
}

/* md is small and dsmc pale, groups have symbols, theories dashes: the same in both panels, each once in the legend. */
static void looks_follow_from_names(void **state)
{
  (void)state;
  gg_chart *chart = gg_plot_chart_new();
  chart->title = "'it's a title'";
  for (int p = 0; p < 2; p++) {
    gg_plot_chart_panel(chart)->title = p ? "b" : "a";
    add(chart, "md", "one", GG_CHART_POINTS, 3, x3, y3, e3);
    add(chart, "md", "two", GG_CHART_POINTS, 3, x3, y3, e3);
    add(chart, "dsmc", "one", GG_CHART_POINTS, 3, x3, y3, e3);
    add(chart, "dsmc", "two", GG_CHART_POINTS, 3, x3, y3, e3);
    if (p) continue;
    for (int group = 0; group < 2; group++) {
      add(chart, "lun1991", group ? "two" : "one", GG_CHART_LINE, 3, x3, y3, NULL);
      add(chart, "enskog_hermite", group ? "two" : "one", GG_CHART_LINE, 3, x3, e4, NULL);
    }
  }
  mark m[MOST];
  char *svg = drawn(chart);
  assert_int_equal(marks_of(svg, FILLED_CIRCLE, m), 2 * (3 + 3) + 3); /* one, md and dsmc in the legend */
  assert_int_equal(marks_of(svg, FILLED_SQUARE, m), 2 * (3 + 3) + 1); /* two in the legend */
  assert_true(m[1].size != m[4].size);
  assert_int_equal(marks_of(svg, OPEN_SQUARE, m), 0);
  assert_int_equal(count(svg, "stroke-dasharray"), 2 + 1);
  assert_int_equal(count(svg, ">Enskog (Hermite)</tspan>") + count(svg, ">Lun 1991</tspan>") +
                       count(svg, ">one</tspan>") + count(svg, ">two</tspan>"),
                   4);
  assert_int_equal(count(svg, "’it’s a title’"), 1);
  free(svg);
}

/* Few methods and groups have an entry each, in their own colour. */
static void few_looks_are_listed_one_by_one(void **state)
{
  (void)state;
  gg_chart *chart = gg_plot_chart_new();
  gg_plot_chart_panel(chart);
  add(chart, "md", "a_2", GG_CHART_POINTS, 3, x3, y3, e3);
  add(chart, "lun1991", "a_2", GG_CHART_LINE, 3, x3, e4, NULL);
  char *svg = drawn(chart), *texts = texts_of(svg);
  assert_non_null(strstr(texts, "\nmd,a2\n"));
  assert_non_null(strstr(texts, "\nLun1991,a2\n"));
  assert_null(strstr(svg, "#444444'  point"));
  free(texts), free(svg);
}

/* Curves measured at many points are lines, in the legend too; a law beside them is dashed. */
static void laws_beside_bands(void **state)
{
  (void)state;
  gg_chart *chart = gg_plot_chart_new();
  gg_plot_chart_panel(chart);
  add(chart, "md", "one", GG_CHART_BAND, 3, x3, y3, e3);
  add(chart, "Gaussian", NULL, GG_CHART_LINE, 3, x3, y3, NULL);
  char *svg = drawn(chart);
  assert_int_equal(count(svg, "stroke-dasharray"), 1 + 1); /* the law and its sample */
  free(svg);
}

/* Labels of tics stay short, and round; those of a long logarithmic axis are powers. */
static void labels_of_tics_are_short_and_round(void **state)
{
  (void)state;
  static const struct {
    bool log;
    double from, to;
    const char *has, *has_not;
  } cases[] = {{false, 0, 1, "\n0.2\n", "\n0.25\n"},
               {false, 2.3e6, 3.6e6, "\n2.4×106\n", "2400000"},
               {false, -1.6e-5, -0.9e-5, "1.1×10-5\n", "0.00001"},
               {false, -0.1, 0.1, "\n0\n", "-0\n"},
               {false, 1e7, 4e7, "\n1×107\n", "10000000"},
               {true, 1, 1000, "\n10\n", "\n20\n"},
               {true, 1, 100, "\n20\n", "\n30\n"},
               {true, 1e-8, 1, "\n10-4\n", "0.0001"},
               {true, 2, 3, "\n2.2\n", "\n10\n"},
               {true, 1e-300, 1, "\n10-50\n", "\n10-47\n"},
               {false, 1e-322, 9e-322, "label", "inf"}}; /* and comes to an end */
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    gg_chart *chart = gg_plot_chart_new();
    gg_plot_chart_panel(chart)->x = (gg_chart_axis){"label", NULL, cases[i].log, cases[i].from, cases[i].to};
    char *svg = drawn(chart), *text = texts_of(svg);
    if (!strstr(text, cases[i].has)) fail_msg("%s: no %s", text, cases[i].has);
    if (strstr(text, cases[i].has_not)) fail_msg("%s: has %s", text, cases[i].has_not);
    free(text), free(svg);
  }
}

static gg_chart_axis axis_around(size_t n, const double *numbers, bool log)
{
  gg_chart *chart = gg_plot_chart_new();
  gg_chart_panel *panel = gg_plot_chart_panel(chart);
  panel->y.log = log;
  add(chart, "md", NULL, GG_CHART_POINTS, n, x3, numbers, NULL);
  gg_plot_axes_choose(panel);
  const gg_chart_axis axis = panel->y;
  gg_plot_chart_free(chart);
  return axis;
}

static void axes_have_room(void **state)
{
  (void)state;
  gg_chart_axis a = axis_around(3, (const double[]){0.5, 9, NAN}, false);
  assert_true(a.from <= 0 && a.to > 9); /* 0 is near */
  a = axis_around(2, (const double[]){8, 9}, false);
  assert_true(a.from > 7 && a.from < 8 && a.to > 9);
  a = axis_around(1, (const double[]){5}, false);
  assert_true(a.from < 5 && a.to > 5);
  a = axis_around(3, (const double[]){-1, 1e-3, 1}, true);
  assert_true(a.log && a.from > 0 && a.from < 1e-3 && a.to > 1);
}

static void keys_have_symbols_and_units(void **state)
{
  (void)state;
  static const char *const cases[][3] = {{"collision.beta", "β", "1"},
                                         {"collision.e.12", "e_{12}", "1"},
                                         {"species.2.mass", "m_{2}", "1"},
                                         {"shear_rate", "γ", "1/time"},
                                         {"dsmc.time_step", "Δt", "mean free times"},
                                         {"run.relative_error", "run.relative\\_error", "1"}};
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    char text[64];
    const char *unit;
    gg_plot_chart_key(cases[i][0], text, sizeof text, &unit);
    assert_string_equal(text, cases[i][1]);
    assert_string_equal(unit, cases[i][2]);
  }
}

static gg_chart *empty_chart(void)
{
  gg_chart *chart = gg_plot_chart_new();
  gg_plot_chart_panel(chart);
  return chart;
}

static void bad_formats_and_folders_are_refused(void **state)
{
  (void)state;
  gg_error err;
  assert_int_equal(draw(empty_chart(), "c.gif", NULL, &err), GG_BAD_INPUT);
  assert_int_equal(draw(empty_chart(), "c.svg", "86", &err), GG_BAD_INPUT);
  assert_int_equal(draw(empty_chart(), "none/c.svg", NULL, &err), GG_BAD_FILE);
  assert_int_equal(draw(gg_plot_chart_new(), "c.svg", NULL, &err), GG_BAD_INPUT);
  if (draw(empty_chart(), "c.png", NULL, &err) != GG_OK) fail_msg("%s", err.message);
}

/* The format follows from the name, from the option, or from both if they agree. */
static void kinds_of_pictures(void **state)
{
  (void)state;
  static const struct {
    const char *picture, *format, *said;
  } bad[] = {{"a.svg", "gif", "not 'gif'"},         {"a", NULL, "ends with .svg, .png, .pdf or .gp"},
             {"a/.svg", NULL, "ends with"},         {"b.d/a", NULL, "ends with"},
             {"a.eps", NULL, "not .eps"},           {"a.svg", "png", "its name says svg"},
             {"a.svg", "pdf", "its name says svg"}, {"folder/", "svg", "needs a name"}};
  static const struct {
    const char *picture, *format;
    gg_plot_format is;
  } good[] = {{"b.d/a", "svg", GG_PLOT_SVG}, {"a.png", NULL, GG_PLOT_PNG}, {"a.png", "png", GG_PLOT_PNG},
              {"a.gp", NULL, GG_PLOT_GP},    {"a", "png", GG_PLOT_PNG},    {"a.b.pdf", NULL, GG_PLOT_PDF},
              {"a", "pdf", GG_PLOT_PDF}};
  gg_error err;
  gg_plot_paper paper;
  for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
    assert_int_equal(gg_plot_paper_choose(&paper, bad[i].picture, bad[i].format, NULL, &err), GG_BAD_INPUT);
    if (!strstr(err.message, bad[i].said)) fail_msg("'%s' is not in '%s'", bad[i].said, err.message);
  }
  for (size_t i = 0; i < sizeof good / sizeof *good; i++) {
    assert_int_equal(gg_plot_paper_choose(&paper, good[i].picture, good[i].format, NULL, &err), GG_OK);
    assert_true(paper.format == good[i].is && paper.width == 0);
  }
}

static void widths_are_lengths_of_paper(void **state)
{
  (void)state;
  static const char *const bad[] = {"", "86", "mm", "86 km", "-86mm", "nanmm", "infmm", "1mm", "2000mm", "86mm "};
  static const char *const same[] = {"86mm", "8.6cm", "3.38583in", "243.78pt", "86.0mm"};
  gg_error err;
  gg_plot_paper paper;
  for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
    assert_int_equal(gg_plot_paper_choose(&paper, "a.svg", NULL, bad[i], &err), GG_BAD_INPUT);
    assert_non_null(strstr(err.message, "mm, cm, in or pt, from 40mm to 1000mm"));
  }
  for (size_t i = 0; i < sizeof same / sizeof *same; i++) {
    assert_int_equal(gg_plot_paper_choose(&paper, "a.svg", NULL, same[i], &err), GG_OK);
    assert_true(fabs(paper.width - 1.5 * 86 * 72 / 25.4) < 0.01); /* 8 points for 12 pixels */
  }
}

static size_t read_file(const char *name, char *text, size_t size)
{
  FILE *f = fopen(name, "r");
  assert_non_null(f);
  size_t n = fread(text, 1, size - 1, f);
  text[n] = '\0';
  fclose(f);
  return n;
}

static gg_chart *two_panels(void)
{
  gg_chart *chart = gg_plot_chart_new();
  for (int p = 0; p < 2; p++) {
    gg_plot_chart_panel(chart);
    add(chart, "md", NULL, GG_CHART_POINTS, 3, x3, y3, e3);
  }
  return chart;
}

/* A PDF has the given width in points, and an SVG in pixels of 1/96 inch. */
static void width_on_paper(void **state)
{
  (void)state;
  static char text[1 << 20];
  double box[4], wide = 0;
  gg_error err;
  if (draw(two_panels(), "c.pdf", "86mm", &err) != GG_OK) fail_msg("%s", err.message);
  size_t n = read_file("c.pdf", text, sizeof text);
  assert_memory_equal(text, "%PDF-", 5);
  const char *media = memmem(text, n, "/MediaBox", 9);
  assert_non_null(media);
  assert_int_equal(sscanf(media, "/MediaBox [ %lf %lf %lf %lf", &box[0], &box[1], &box[2], &box[3]), 4);
  assert_true(fabs(box[2] - box[0] - 86 * 72 / 25.4) < 0.5);
  assert_true(box[3] - box[1] > box[2] - box[0]); /* two panels below each other */
  if (draw(two_panels(), "c.svg", "86mm", &err) != GG_OK) fail_msg("%s", err.message);
  read_file("c.svg", text, sizeof text);
  assert_int_equal(sscanf(strstr(text, "width="), "width=\"%lf\"", &wide), 1);
  assert_true(fabs(wide - 86 * 96 / 25.4) < 1);
}

static void check_theories(const double *second, const char *names, int dashed)
{
  gg_chart *chart = gg_plot_chart_new();
  gg_plot_chart_panel(chart);
  add(chart, "md", NULL, GG_CHART_POINTS, 3, x3, y3, e3);
  add(chart, "lun1991", NULL, GG_CHART_LINE, 3, x3, y3, NULL);
  add(chart, "grad", NULL, GG_CHART_LINE, 3, x3, second, NULL);
  char *svg = drawn(chart), *texts = texts_of(svg);
  assert_non_null(strstr(texts, names));
  assert_int_equal(count(svg, "stroke-dasharray"), dashed);
  free(texts), free(svg);
}

/* Theories have the names that people use. Theories that coincide are drawn once, under both names. */
static void theories_have_the_names_that_people_use(void **state)
{
  (void)state;
  static const char *const names[][2] = {{"garzo_dufty1999", "Garzó & Dufty 1999"},
                                         {"kremer_santos_garzo2014", "Kremer, Santos & Garzó 2014"},
                                         {"montanero_santos2000", "Montanero & Santos 2000"},
                                         {"haff1983", "Haff 1983"},
                                         {"grad", "Grad"},
                                         {"md", "md"},
                                         {"my_theory2020", "my_theory2020"}};
  char name[64];
  for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
    gg_plot_method_name(names[i][0], name, sizeof name);
    assert_string_equal(name, names[i][1]);
  }
  const double near[] = {2.0001, 3, 4}, far[] = {2.2, 3, 4};
  check_theories(near, "\nLun1991;Grad\n", 0);
  check_theories(far, "\nLun1991\nGrad\n", 1 + 1);
}

/* SVG drops a space at the end of a piece of text, but not a no-break space. */
static void units_keep_their_space(void **state)
{
  (void)state;
  char text[64];
  gg_plot_text_unit("rho_p d^2 gamma^2", text, sizeof text);
  assert_string_equal(text, "ρ_p\u00a0d^2\u00a0γ^2");
  gg_chart *chart = empty_chart();
  chart->panel[0]->x = (gg_chart_axis){"x", "d^2 gamma^2", false, 0, 1};
  char *svg = drawn(chart), *texts = texts_of(svg);
  assert_non_null(strstr(texts, "[d2\u00a0γ2]"));
  free(texts), free(svg);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(kinds_of_pictures),
      cmocka_unit_test(points_are_at_their_places),
      cmocka_unit_test(numbers_without_a_place),
      cmocka_unit_test(unsteady_runs_are_open),
      cmocka_unit_test(looks_follow_from_names),
      cmocka_unit_test(few_looks_are_listed_one_by_one),
      cmocka_unit_test(laws_beside_bands),
      cmocka_unit_test(labels_of_tics_are_short_and_round),
      cmocka_unit_test(axes_have_room),
      cmocka_unit_test(keys_have_symbols_and_units),
      cmocka_unit_test(bad_formats_and_folders_are_refused),
      cmocka_unit_test(widths_are_lengths_of_paper),
      cmocka_unit_test(width_on_paper),
      cmocka_unit_test(theories_have_the_names_that_people_use),
      cmocka_unit_test(units_keep_their_space),
  };
  return cmocka_run_group_tests(tests, enter, leave);
}
