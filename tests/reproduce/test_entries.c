/* Every entry of a figure that the program holds can be read: its keys are known, and quantities, theories and scene
 * keys that it names exist. What is wrong is refused with file, line and key. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "reproduce/entry.h"

static void every_entry_is_read(void **state)
{
  (void)state;
  int n = 0;
  for (; gg_entry_files[n].file; n++) {
    gg_figure_entry e;
    gg_error err;
    if (gg_reproduce_entry_read(&e, gg_entry_files[n].file, gg_entry_files[n].yaml, &err) != GG_OK)
      fail_msg("%s", err.message);
    if (!e.cannot && strcmp(e.verdict, "open") != 0 && !*e.because)
      fail_msg("%s: a verdict without its reason", e.file);
    gg_reproduce_entry_clear(&e);
  }
  assert_true(n >= 20);
}

/* "thesis-3.05.yaml" is thesis 3.5 */
static void files_are_named_by_their_figures(void **state)
{
  (void)state;
  for (int n = 0; gg_entry_files[n].file; n++) {
    gg_figure_entry e;
    char paper[16], chapter[8], expected[64];
    int number = 0;
    assert_int_equal(gg_reproduce_entry_read(&e, gg_entry_files[n].file, gg_entry_files[n].yaml, NULL), GG_OK);
    if (sscanf(e.file, "%15[a-z]-%7[0-9IV].%d", paper, chapter, &number) == 3)
      snprintf(expected, sizeof expected, "%s %s.%d", paper, chapter, number);
    else if (sscanf(e.file, "%15[a-z]-%d", paper, &number) == 2)
      snprintf(expected, sizeof expected, "%s %d", paper, number);
    assert_string_equal(e.figure, expected);
    gg_reproduce_entry_clear(&e);
  }
}

#define BEGINNING "figure: thesis 9.9\nshows: a test\nsweep: {flow: usf, phi: 0.1, vary: {phi: [0.1]}}\n"

static void refused(const char *rest, const char *message)
{
  char yaml[4000];
  gg_figure_entry e;
  gg_error err;
  snprintf(yaml, sizeof yaml, "%s%s", BEGINNING, rest);
  assert_int_equal(gg_reproduce_entry_read(&e, "thesis-9.09.yaml", yaml, &err), GG_BAD_INPUT);
  if (!strstr(err.message, message)) fail_msg("'%s' is not in '%s'", message, err.message);
}

static void mistakes_are_refused_where_they_stand(void **state)
{
  (void)state;
  refused("pannels: []\n", "thesis-9.09.yaml:4: key 'pannels': unknown in an entry; did you mean panels?");
  refused("panels:\n  - x: {key: phi}\n    y: {quantity: temprature}\n", ":6: key 'quantity': there is no quantity");
  refused("panels:\n  - x: {key: fi}\n    y: {quantity: N1}\n", ":5: key 'key': 'fi' is no key of a scene");
  refused("panels: [{x: {key: phi}, y: {quantity: N1}, theories: [lun91]}]\n", "there is no theory 'lun91'");
  refused("panels: [{y: {quantity: N1}}]\n", "needs the scene key that this is drawn over");
  refused("panels: [{x: {key: phi}, y: {quantity: N1, as: y+}}]\n", "'y+' at character 3");
  refused("panels: [{x: {key: phi}, y: {quantity: N1}}]\nverdict: good\n", ":5: key 'verdict': 'good' is not allowed");
  refused("quick: {run.error: 1}\npanels: [{x: {key: phi}, y: {quantity: N1}}]\n", ":4: key 'run.error'");
  refused("panels: [{x: {key: phi}, y: {quantity: N1}, of: smooth}]\n", "there is no sweep 'smooth'");
  refused("panels: [{x: {key: phi}, y: {number: alpha, curve: velocity_distribution_Cx, tail: [3, 2]}}]\n",
          "is a range");
}

#define PANEL "panels: [{x: {key: phi}, y: {quantity: N1}}]\n"
#define NUMBER(rest) PANEL "numbers: [" rest "]\n"

/* Each part of an entry, by what is wrong with it. */
static void parts_are_refused(void **state)
{
  (void)state;
  static const struct {
    const char *rest, *said;
  } bad[] = {
      {"", "key 'panels': must be given"},
      {"panels: {}\n", "key 'panels': is a list"},
      {"panels: [7]\n", "key 'panels': is a map with the keys title of"},
      {PANEL "shows: again\n", "key 'shows': is given twice"},
      {PANEL "zzzzzzzzz: 1\n", "unknown in an entry; allowed: figure shows"},
      {PANEL "because: [a, list]\n", "key 'because': is a text"},
      {PANEL "[a]: 1\n", "key '?': unknown in an entry; allowed: figure"},
      {PANEL "sweeps: {}\n", "key 'sweep': or sweeps must be given, one of them"},
      {PANEL "quick: 3\n", "key 'quick': is a map of scene keys"},
      {PANEL "quick: {vary: 3}\n", "key 'vary': is a map of scene keys"},
      {PANEL "quick: {[a]: 3}\n", "key '?': is no key of a scene"},
      {PANEL "quick: {vary: {species.1.weight: 3}}\n", "'species.1.weight': is no key of a scene"},
      {"panels: [{x: {key: phi, log: maybe}, y: {quantity: N1}}]\n", "key 'log': is true or false"},
      {"panels: [{x: {key: phi, from: 1}, y: {quantity: N1}}]\n", "and to come together"},
      {"panels: [{x: {key: phi, from: 2, to: 1}, y: {quantity: N1}}]\n", "and to come together"},
      {"panels: [{x: {key: phi, from: 1e999, to: 2}, y: {quantity: N1}}]\n", "key 'from': is a number"},
      {"panels: [{x: {key: phi, from: 1x, to: 2}, y: {quantity: N1}}]\n", "key 'from': is a number"},
      {"panels: [{x: {key: phi, from: '', to: 2}, y: {quantity: N1}}]\n", "key 'from': is a number"},
      {"panels: [{x: {key: phi, from: [1], to: 2}, y: {quantity: N1}}]\n", "key 'from': is a number"},
      {"panels: [{x: {key: phi}, y: {quantity: N1}, lines: {label: a}}]\n", "are by a scene key: give it"},
      {"panels: [{x: {key: phi}, y: {quantity: N1}, lines: {by: fi}}]\n", "key 'by': 'fi' is no key of a scene"},
      {"panels: [{x: {key: phi}, y: {quantity: N1}, lines: {by: phi, label: [a, b]}}]\n", "one for each key"},
      {"panels: [{x: {key: phi}, y: {quantity: N1}, lines: {by: {a: b}}}]\n", "is a text or a list of them"},
      {"panels: [{x: {key: phi}, y: {quantity: N1}, lines: {by: [[a]]}}]\n", "is a list of texts"},
      {"panels: [{x: {key: phi}, y: {quantity: N1}, guides: {}}]\n", "is a list of {label, as}"},
      {"panels: [{x: {key: phi}, y: {quantity: N1}, guides: [{label: a}]}]\n", "have a label and a formula each"},
      {"panels: [{x: {key: phi}, y: {quantity: N1}, guides: [{as: x}]}]\n", "have a label and a formula each"},
      {"panels: [{x: {key: phi}, y: {quantity: N1}, engines: [mc]}]\n", "key 'engines': are md and dsmc"},
      {"panels: [{x: {key: phi}, y: {quantity: N1}, where: [a]}]\n", "key 'where': is a map of scene keys"},
      {"panels: [{x: {key: phi}, y: {quantity: N1}, where: {fi: 1}}]\n", "key 'fi': is no key of a scene"},
      {"panels: [{x: {key: phi}, y: {quantity: N1}, where: {[a]: 1}}]\n", "key '?': is no key of a scene"},
      {"panels: [{x: {key: phi}, y: {curve: impact_speed}}]\n", "has no scene key here"},
      {"panels: [{y: {curve: impact_speed}, theories: lun1991}]\n", "speak of quantities alone"},
      {"panels: [{x: {key: phi}, y: {number: kurtosis}}]\n", "is that of a curve: give it"},
      {"panels: [{x: {key: phi}, y: {label: T}}]\n", "names what is shown"},
      {"panels: [{y: {snapshot: yz}}]\n", "key 'snapshot': is xy or zy"},
      {"panels: [{y: {snapshot: [xy, zy]}}]\n", "key 'snapshot': is xy or zy"},
      {"panels: [{y: {frames: place}}]\n", "key 'frames': is velocity"},
      {"panels: [{y: {series: warmth}}]\n", "key 'series': there is no quantity 'warmth'"},
      {"panels: [{x: {key: phi}, y: {quantity: [N1, N1, N1, N1, N1, N1, N1, N1, N1]}}]\n", "names more than 8"},
      {"panels: [{x: {key: phi}, y: {quantity: N1, tail: [2, 4.5]}}]\n", "goes with number: alpha or gamma"},
      {"panels: [{x: {key: phi}, y: {number: kurtosis, curve: c, tail: [2, 4.5]}}]\n", "goes with number: alpha"},
      {"panels: [{x: {key: phi}, y: {number: alpha, curve: c, tail: [1, b]}}]\n", "is a range"},
      {"panels: [{x: {key: phi}, y: {number: alpha, curve: c, tail: 1}}]\n", "is a range"},
      {"panels: [{x: {key: phi}, y: {number: alpha, curve: c, tail: [1, 2]}}]\n", "no range that fits are made over"},
      {"panels: [{x: {key: phi}, y: {quantity: N1, frame: one}}]\n", "key 'frame': is a number"},
      {"panels: [{x: {key: phi}, y: {quantity: N1, beside: 1}}]\n", "key 'beside': is true or false"},
      {"panels: [{x: {key: phi}, y: {quantity: N1, relative_to: {theory: none}}}]\n", "there is no theory 'none'"},
      {"panels: [{x: {key: phi}, y: {quantity: N1, relative_to: {number: n}}}]\n",
       "key 'number': is no key of a scene"},
      {"panels: [{x: {key: phi}, y: {quantity: N1, relative_to: {theory: lun1991, phi: 1}}}]\n", "'phi': unknown in"},
      {"panels: [{x: {key: phi}, y: {quantity: N1}, of: [a]}]\n", "there is no sweep 'a'"},
      {PANEL "numbers: 3\n", "key 'numbers': is a list"},
      {NUMBER("{what: T, of: N1}"), "say what they are, and what the paper has"},
      {NUMBER("{paper: 1, of: N1}"), "say what they are, and what the paper has"},
      {NUMBER("{what: T, paper: one, of: N1}"), "key 'paper': is a number"},
      {NUMBER("{what: T, paper: 1, of: warmth}"), "names one quantity, or is a map"},
      {NUMBER("{what: T, paper: 1, of: [N1, N2]}"), "names one quantity, or is a map"},
      {NUMBER("{what: T, paper: 1, of: {curve: c}}"), "is a quantity or a number of a curve"},
      {NUMBER("{what: T, paper: 1, of: N1, find: middle}"), "is zero, minimum, maximum"},
      {NUMBER("{what: T, paper: 1, of: N1, find: zero}"), "needs over: the key along which"},
      {NUMBER("{what: T, paper: 1, of: N1, over: fi}"), "'fi' is no key of a scene"},
      {NUMBER("{what: T, paper: 1, of: N1, sweep: none}"), "there is no sweep 'none'"},
      {NUMBER("{what: T, paper: 1, of: N1, theories: none}"), "there is no theory 'none'"},
      {NUMBER("{what: T, paper: 1, of: N1, as: (y}"), ") is missing"},
      {NUMBER("{what: T, paper: 1, of: N1, x: ln y}"), "( is missing after a function"},
      {NUMBER("{what: T, paper: 1, of: N1, x: ln(y}"), ") is missing"},
      {NUMBER("{what: T, paper: 1, of: N1, x: foo(y)}"), "not known; there are x, y"},
      {NUMBER("{what: T, paper: 1, of: N1, x: y y}"), "not expected here"},
      {NUMBER("{what: T, paper: 1, of: N1, x: y*}"), "a number, a name or ( is missing"},
  };
  for (size_t k = 0; k < sizeof bad / sizeof *bad; k++) refused(bad[k].rest, bad[k].said);
}

/* More of a kind than there is room for. */
static void too_many(void **state)
{
  (void)state;
  static const struct {
    const char *before, *each, *after, *said;
    int n;
  } lists[] = {
      {"panels: [", "{x: {key: phi}, y: {quantity: N1}}, ", "]\n", "are more than 9", 10},
      {PANEL "numbers: [", "{what: T, paper: 1, of: N1}, ", "]\n", "are more than 32", 33},
      {"panels: [{x: {key: phi}, y: {quantity: N1}, guides: [", "{label: a, as: x}, ", "]}]\n", "are more than 8", 9},
      {"panels: [{x: {key: phi}, y: {quantity: N1}, theories: [", "lun1991, ", "]}]\n", "are more than 8", 9},
      {"panels: [{x: {key: phi}, y: {quantity: N1}, theories_over: [", "1, ", "]}]\n", "has more than 64", 65},
      {"panels: [{x: {key: phi}, y: {quantity: N1}, where: {", "phi: 1, ", "}}]\n", "has too many keys", 9},
      {PANEL "quick: {", "phi: 1, ", "}\n", "one too many", 25},
  };
  for (size_t k = 0; k < sizeof lists / sizeof *lists; k++) {
    char text[2000] = "";
    snprintf(text, sizeof text, "%s", lists[k].before);
    for (int i = 0; i < lists[k].n; i++) snprintf(text + strlen(text), sizeof text - strlen(text), "%s", lists[k].each);
    snprintf(text + strlen(text), sizeof text - strlen(text), "%s", lists[k].after);
    refused(text, lists[k].said);
  }
}

static void formula_refused(const char *sign, int n, const char *said)
{
  char text[400] = "";
  gg_expression e;
  gg_error err;
  for (int i = 0; i < n; i++) snprintf(text + strlen(text), sizeof text - strlen(text), "%s", sign);
  snprintf(text + strlen(text), sizeof text - strlen(text), "x");
  assert_int_equal(gg_reproduce_expression_parse(&e, text, &err), GG_BAD_INPUT);
  if (!strstr(err.message, said)) fail_msg("'%s' lacks '%s'", err.message, said);
}

static void long_formulas(void **state)
{
  (void)state;
  formula_refused("x+", 70, "the formula is too long");
  formula_refused("-", 70, "the formula is too deep");
  formula_refused("2^", 70, "the formula is too deep");
  formula_refused("(", 70, "the formula is too deep");
}

static void whole_entry_refused(const char *yaml, const char *said)
{
  gg_figure_entry e;
  gg_error err;
  assert_int_equal(gg_reproduce_entry_read(&e, "x.yaml", yaml, &err), GG_BAD_INPUT);
  if (!strstr(err.message, said)) fail_msg("'%s' is not in '%s'", said, err.message);
}

static void entries_are_refused(void **state)
{
  (void)state;
  static const char *const many = "figure: a\nshows: b\nsweeps: {a: b, c: b, d: b, e: b, f: b, g: b, h: b}\n";
  whole_entry_refused("", "x.yaml: is empty");
  whole_entry_refused("figure: [", "x.yaml:");
  whole_entry_refused("sweeps: {a: b}\n[a]: 1\n", "key '?': unknown in an entry; allowed: figure");
  whole_entry_refused("- a list\n", "is a map with the keys figure shows");
  whole_entry_refused("figure: a\n", "key 'figure': and shows must be given");
  whole_entry_refused("shows: a\n", "key 'figure': and shows must be given");
  whole_entry_refused("figure: a\nshows: b\n", "or sweeps must be given, one of them");
  whole_entry_refused("figure: a\nshows: b\nsweep: [1]\n", "is a map, a sweep file, or the name of the figure");
  whole_entry_refused("figure: a\nshows: b\nsweeps: [1]\n", "is a map of sweeps by name");
  whole_entry_refused(many, "are more than 6");
  gg_figure_entry e;
  gg_error err;
  assert_int_equal(gg_reproduce_entry_read(&e, "x.yaml", "figure: a\nshows: b\ncannot: because\n", &err), GG_OK);
  assert_string_equal(e.cannot, "because");
  gg_reproduce_entry_clear(&e);
}

/* The sweep's own text keeps its lines, and characters of several bytes before it do not matter. */
static void a_sweep_is_cut_out_whole(void **state)
{
  (void)state;
  gg_figure_entry e;
  const char *yaml = "figure: thesis 9.9\nshows: φ and θ\nsweep:\n  flow: usf\n  phi: 0.1\nquick: {phi: 0.25}\n"
                     "panels: [{x: {key: phi, label: φ}, y: {quantity: N1}}]\n";
  assert_int_equal(gg_reproduce_entry_read(&e, "thesis-9.09.yaml", yaml, NULL), GG_OK);
  assert_non_null(strstr(e.sweep[0].yaml, "\n\n\n  flow: usf\n  phi: 0.1\n"));
  assert_null(strstr(e.sweep[0].yaml, "quick"));
  assert_string_equal(e.quick[0].key, "phi");
  assert_int_equal(strncmp(e.quick[0].value, "0.25", 4), 0);
  gg_reproduce_entry_clear(&e);
}

static double value(const char *text, double x, double y)
{
  gg_expression e;
  assert_int_equal(gg_reproduce_expression_parse(&e, text, NULL), GG_OK);
  return gg_reproduce_expression_value(&e, (gg_variables){.x = x, .y = y});
}

static void formulas(void **state)
{
  (void)state;
  assert_true(value("2-0.625*(1-x^2)^(2/3)", 0.6, 0) == 2 - 0.625 * pow(0.64, 2. / 3));
  assert_true(value("-x^2 + 3*y/2 - -1", 3, 4) == -2);
  assert_true(value("2^3^2", 0, 0) == 512);
  assert_true(value("abs(-3) + sqrt(4)*exp(0) + sin(0) - cos(0) + log10(100)", 0, 0) == 6);
  assert_true(value("+x + pi/pi + .5 * (1 / inf)", 3, 0) == 4);
  assert_true(fabs(value("-ln(-ln(y))", 0, exp(-exp(-1.5))) - 1.5) < 1e-12);
  gg_expression e;
  assert_int_equal(gg_reproduce_expression_parse(&e, "y/(1+y)", NULL), GG_OK);
  assert_true(fabs(gg_reproduce_expression_slope(&e, (gg_variables){.y = 0.5}, 'y') - 1 / 2.25) < 1e-8);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(every_entry_is_read),
      cmocka_unit_test(files_are_named_by_their_figures),
      cmocka_unit_test(mistakes_are_refused_where_they_stand),
      cmocka_unit_test(a_sweep_is_cut_out_whole),
      cmocka_unit_test(formulas),
      cmocka_unit_test(parts_are_refused),
      cmocka_unit_test(too_many),
      cmocka_unit_test(long_formulas),
      cmocka_unit_test(entries_are_refused),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
