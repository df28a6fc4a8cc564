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
    if (gg_entry_read(&e, gg_entry_files[n].file, gg_entry_files[n].yaml, &err) != GG_OK) fail_msg("%s", err.message);
    if (!e.cannot && strcmp(e.verdict, "open") != 0 && !*e.because)
      fail_msg("%s: a verdict without its reason", e.file);
    gg_entry_clear(&e);
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
    assert_int_equal(gg_entry_read(&e, gg_entry_files[n].file, gg_entry_files[n].yaml, NULL), GG_OK);
    if (sscanf(e.file, "%15[a-z]-%7[0-9IV].%d", paper, chapter, &number) == 3)
      snprintf(expected, sizeof expected, "%s %s.%d", paper, chapter, number);
    else if (sscanf(e.file, "%15[a-z]-%d", paper, &number) == 2)
      snprintf(expected, sizeof expected, "%s %d", paper, number);
    assert_string_equal(e.figure, expected);
    gg_entry_clear(&e);
  }
}

#define BEGINNING "figure: thesis 9.9\nshows: a test\nsweep: {flow: usf, phi: 0.1, vary: {phi: [0.1]}}\n"

static void refused(const char *rest, const char *message)
{
  char yaml[2000];
  gg_figure_entry e;
  gg_error err;
  snprintf(yaml, sizeof yaml, "%s%s", BEGINNING, rest);
  assert_int_equal(gg_entry_read(&e, "thesis-9.09.yaml", yaml, &err), GG_BAD_INPUT);
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

/* The sweep's own text keeps its lines, and characters of several bytes before it do not matter. */
static void a_sweep_is_cut_out_whole(void **state)
{
  (void)state;
  gg_figure_entry e;
  const char *yaml = "figure: thesis 9.9\nshows: φ and θ\nsweep:\n  flow: usf\n  phi: 0.1\nquick: {phi: 0.25}\n"
                     "panels: [{x: {key: phi, label: φ}, y: {quantity: N1}}]\n";
  assert_int_equal(gg_entry_read(&e, "thesis-9.09.yaml", yaml, NULL), GG_OK);
  assert_non_null(strstr(e.sweep[0].yaml, "\n\n\n  flow: usf\n  phi: 0.1\n"));
  assert_null(strstr(e.sweep[0].yaml, "quick"));
  assert_string_equal(e.quick[0].key, "phi");
  assert_int_equal(strncmp(e.quick[0].value, "0.25", 4), 0);
  gg_entry_clear(&e);
}

static double value(const char *text, double x, double y)
{
  gg_expression e;
  assert_int_equal(gg_expression_parse(&e, text, NULL), GG_OK);
  return gg_expression_value(&e, (gg_variables){.x = x, .y = y});
}

static void formulas(void **state)
{
  (void)state;
  assert_true(value("2-0.625*(1-x^2)^(2/3)", 0.6, 0) == 2 - 0.625 * pow(0.64, 2. / 3));
  assert_true(value("-x^2 + 3*y/2 - -1", 3, 4) == -2);
  assert_true(value("2^3^2", 0, 0) == 512);
  assert_true(fabs(value("-ln(-ln(y))", 0, exp(-exp(-1.5))) - 1.5) < 1e-12);
  gg_expression e;
  assert_int_equal(gg_expression_parse(&e, "y/(1+y)", NULL), GG_OK);
  assert_true(fabs(gg_expression_slope(&e, (gg_variables){.y = 0.5}, 'y') - 1 / 2.25) < 1e-8);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(every_entry_is_read),
      cmocka_unit_test(files_are_named_by_their_figures),
      cmocka_unit_test(mistakes_are_refused_where_they_stand),
      cmocka_unit_test(a_sweep_is_cut_out_whole),
      cmocka_unit_test(formulas),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
