/* A figure of our own with every kind of panel and number, from its entry to its files; twice, stopped, and where a
 * file is in the way. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmocka.h>

#include "reproduce/figures.h"

static const char yaml[] =
    "figure: thesis 9.9\n"
    "shows: every kind of panel\n"
    "sweeps:\n"
    "  means:\n"
    "    flow: usf\n"
    "    particles: 80\n"
    "    dsmc: {particles: 100}\n"
    "    measure: [rheology, velocity_distributions]\n"
    "    run: {collisions: 800, warmup: 20}\n"
    "    vary: {collision.e: [0.7, 0.8, 0.9], phi: [0.05, 0.1]}\n"
    "    sweep: {does: compare}\n"
    "  frames:\n"
    "    flow: usf\n"
    "    engine: md\n"
    "    particles: 80\n"
    "    run: {collisions: 80, warmup: 10}\n"
    "    output: {trajectory_every: 4}\n"
    "    vary: {phi: [0.1]}\n"
    "    sweep: {does: run}\n"
    "quick: {run.collisions: 600, vary: {phi: [0.08, 0.1]}}\n"
    "panels:\n"
    "  - {title: means, of: means, x: {key: collision.e}, y: {quantity: [temperature, N1]}, lines: {by: phi},\n"
    "     theories: [lun1991, lun1991_lun_savage], guides: [{label: one, as: 1}]}\n"
    "  - {of: means, x: {key: collision.e, as: 1-x^2, label: loss, from: 0.1, to: 0.6}, engines: [dsmc, md],\n"
    "     y: {quantity: temperature, relative_to: {theory: lun1991}, log: true}, theories: [lun1991],\n"
    "     theories_over: [0.72, 0.85], lines: {by: [phi, run.seed], label: [the fraction, \"\"], as: 100*v}}\n"
    "  - {of: means, x: {key: phi, log: true}, y: {quantity: temperature, relative_to: {phi: 0.1}, label: T},\n"
    "     lines: {by: collision.e}, where: {collision.e: [0.7, 0.9]}, guides: [{label: straight, as: x/0.1}]}\n"
    "  - {of: means, x: {key: collision.e}, y: {number: alpha, curve: velocity_distribution_Cx, tail: [2, 4.5]}}\n"
    "  - {of: means, x: {number: kurtosis}, y: {number: kurtosis, curve: [velocity_distribution_Cx,\n"
    "     velocity_distribution_Cy], as: y/3}}\n"
    "  - {of: means, x: {bins: 2, from: -3, to: 3}, y: {curve: velocity_distribution_Cx, log: true, as: 2*y},\n"
    "     lines: {by: collision.e}, where: {phi: 0.1}}\n"
    "  - {of: frames, x: {from: 0, to: 60}, y: {series: [temperature, N1]}, guides: [{label: ln, as: ln(-x)}]}\n"
    "  - {of: frames, x: {label: y}, y: {frames: velocity}}\n"
    "  - {of: frames, title: grains, y: {snapshot: zy, frame: 1}, lines: {by: phi, label: \"\"}}\n"
    "numbers:\n"
    "  - {what: T, sweep: means, paper: 0.70, of: temperature, at: {phi: 0.1, collision.e: 0.8}, theories: [lun1991]}\n"
    "  - {what: zero of N1 - 0.3, sweep: means, paper: 1, error: 0.5, over: collision.e, find: zero, of: N1, as: "
    "y-0.3,\n"
    "     at: {phi: 0.1}, where: table 1}\n"
    "  - {what: least, sweep: means, paper: 1, over: collision.e, find: minimum, of: temperature, at: {phi: 0.1}}\n"
    "  - {what: most, sweep: means, paper: 1, over: collision.e, find: maximum, of: {quantity: N1, as: \"(y-1)^2\"},\n"
    "     x: x}\n"
    "  - {what: power, sweep: means, paper: -1, over: collision.e, x: 1-x^2, find: exponent, of: temperature,\n"
    "     theories: [lun1991]}\n"
    "  - {what: factor, sweep: means, paper: 1.0, over: collision.e, x: 1-x^2, find: prefactor, of: temperature}\n"
    "  - {what: tail, sweep: means, paper: 2, of: {number: alpha, curve: velocity_distribution_Cx, tail: [2, 4.5]},\n"
    "     at: {phi: 0.1, collision.e: 0.9}}\n"
    "  - {what: of nothing, sweep: means, paper: 2, of: temperature, at: {phi: 0.3}}\n";

typedef struct told {
  int files, numbers, progress, warned;
  bool stops;
  gg_figure_number number[GG_MOST_NUMBERS];
} told;

static void written(void *context, const char *file)
{
  assert_int_equal(access(file, R_OK), 0);
  ((told *)context)->files++;
}

static void number(void *context, const gg_figure_number *n)
{
  told *t = context;
  t->number[t->numbers++] = *n;
}

static void progress(void *context, const char *figure, const gg_sweep_progress *now)
{
  assert_string_equal(figure, "thesis 9.9");
  assert_true(now->points >= 1);
  ((told *)context)->progress++;
}

static int stop(void *context)
{
  return ((told *)context)->stops;
}

static void warn(void *context, const char *figure, const char *message)
{
  assert_true(strlen(figure) > 0 && strlen(message) > 0);
  ((told *)context)->warned++;
}

static void read_entry(gg_figure_entry *e)
{
  gg_error err;
  if (gg_reproduce_entry_read(e, "thesis-9.09.yaml", yaml, &err) != GG_OK) fail_msg("%s", err.message);
}

static gg_reproduce_options options(told *t)
{
  return (gg_reproduce_options){.quick = 1,
                                .folder = "out",
                                .command = "a test",
                                .context = t,
                                .progress = progress,
                                .stop = stop,
                                .warn = warn,
                                .written = written,
                                .number = number};
}

static char *text_of(const char *path)
{
  static char text[1 << 20];
  FILE *f = fopen(path, "r");
  if (!f) fail_msg("%s is not there", path);
  text[fread(text, 1, sizeof text - 1, f)] = 0;
  fclose(f);
  return text;
}

static bool draws(void)
{
  return system("command -v gnuplot >/dev/null") == 0;
}

static void every_kind(void **state)
{
  (void)state;
  gg_figure_entry e;
  gg_error err;
  read_entry(&e);
  for (int again = 0; again < 2; again++) {
    told t = {0};
    const gg_reproduce_options o = options(&t);
    if (gg_reproduce_figure_reproduce(&e, &o, &err) != GG_OK) fail_msg("%s", err.message);
    assert_int_equal(t.files, 7);
    assert_int_equal(t.warned, 0);
    assert_int_equal(t.numbers, 8);
    /* T of usf at 0.1 and 0.8 is about 3; both engines have it, with an error. */
    for (int k = 0; k < 8; k++) assert_string_equal(t.number[k].figure, "thesis 9.9");
    assert_true(t.number[0].md > 0.3 && t.number[0].md < 9 && t.number[0].md_error > 0);
    assert_true(fabs(t.number[0].dsmc / t.number[0].md - 1) < 0.6);
    assert_true(fabs(t.number[0].md_z * hypot(t.number[0].md_error, 0.005) - (t.number[0].md - 0.70)) < 1e-9);
    assert_true(t.number[0].paper_error == 0.005 && t.number[1].paper_error == 0.5);
    assert_string_equal(t.number[1].where, "table 1");
    assert_true(isnan(t.number[2].md)); /* least at an end: T rises with e */
    assert_true(t.number[4].md < -0.3 && t.number[4].md > -3);
    assert_true(fabs(t.number[6].md - 2) < 1.5);
    assert_true(isnan(t.number[7].md) && isnan(t.number[7].md_z));
    const char *table = text_of("out/thesis-9.09.csv");
    for (int panel = 1; panel <= 8; panel++) {
      char begins[8];
      snprintf(begins, sizeof begins, "\n%d,", panel);
      if (!strstr(table, begins)) fail_msg("panel %d is not in the table", panel);
    }
    for (const char *const *word =
             (const char *const[]){"lun1991", "lun1991_lun_savage", "md", "dsmc", "straight", NULL};
         *word; word++)
      if (!strstr(table, *word)) fail_msg("%s is not in the table", *word);
    assert_non_null(strstr(text_of("out/thesis-9.09_numbers.csv"), "zero of N1 - 0.3"));
    assert_non_null(strstr(text_of("out/thesis-9.09.svg"), "</svg>"));
  }
  gg_reproduce_entry_clear(&e);
}

/* Stopped at once; a folder where a file has to go, told before anything is run; a folder that cannot be made. */
static void not_to_the_end(void **state)
{
  (void)state;
  gg_figure_entry e;
  gg_error err;
  read_entry(&e);
  told t = {.stops = true};
  gg_reproduce_options o = options(&t);
  o.folder = "other";
  o.threads = 2;
  assert_int_equal(gg_reproduce_figure_reproduce(&e, &o, &err), GG_INTERRUPTED);
  assert_int_equal(t.files, 0);
  assert_int_equal(access("other/thesis-9.09.csv", F_OK), -1);
  t.stops = false;
  assert_int_equal(mkdir("way", 0777) + mkdir("way/thesis-9.09.svg", 0777), 0);
  o.folder = "way";
  assert_true(gg_reproduce_figure_reproduce(&e, &o, &err) != GG_OK);
  assert_non_null(strstr(err.message, "way/thesis-9.09.svg"));
  assert_int_equal(access("way/figures.sweep", F_OK), -1);
  o.folder = "nowhere/out";
  assert_true(gg_reproduce_figure_reproduce(&e, &o, &err) != GG_OK);
  assert_non_null(strstr(err.message, "nowhere/out"));
  gg_reproduce_entry_clear(&e);
}

/* A point that fails is told of, and leaves the figure without it; where all fail there are no files. */
static void points_that_fail(void **state)
{
  (void)state;
  static const char half[] =
      "figure: thesis 9.8\nshows: a collapse\nsweep:\n  flow: hcs\n  engine: md\n"
      "  particles: 60\n  phi: 0.3\n  md: {contact_time: 0}\n  run: {collisions: 20000, warmup: 1}\n"
      "  vary: {collision.e: [%s]}\n  sweep: {does: run}\n"
      "panels: [{x: {key: collision.e}, y: {quantity: N1}}]\n";
  const char *const e_of[] = {"0.1", "0.1, 1"};
  for (int k = 0; k < 2; k++) {
    char text[600], folder[] = "fail0";
    gg_figure_entry e;
    gg_error err;
    told t = {0};
    gg_reproduce_options o = options(&t);
    snprintf(text, sizeof text, half, e_of[k]);
    if (k) memcpy(strstr(text, "20000"), "50   ", 5); /* it collapses at once */
    assert_int_equal(gg_reproduce_entry_read(&e, "thesis-9.08.yaml", text, &err), GG_OK);
    folder[4] = (char)('0' + k);
    o.folder = folder, o.progress = NULL, o.stop = NULL, o.number = NULL;
    gg_status status = gg_reproduce_figure_reproduce(&e, &o, &err);
    if (k == 0) {
      assert_int_equal(status, GG_FAILED);
      assert_non_null(strstr(err.message, "no point came to an end"));
      assert_int_equal(t.warned, 1);
      assert_int_equal(t.files, 0);
    } else {
      assert_true(status == GG_OK || status == GG_FAILED);
      assert_int_equal(t.files, 4);
    }
    gg_reproduce_entry_clear(&e);
  }
}

int main(void)
{
  char folder[] = "/tmp/graingas-figure-XXXXXX", command[64];
  const struct CMUnitTest tests[] = {cmocka_unit_test(every_kind), cmocka_unit_test(not_to_the_end),
                                     cmocka_unit_test(points_that_fail)};
  if (!draws()) return printf("1..0 # SKIP gnuplot is not installed\n"), 0;
  if (!mkdtemp(folder) || chdir(folder) != 0) return 1;
  int failed = cmocka_run_group_tests(tests, NULL, NULL);
  snprintf(command, sizeof command, "rm -r %s", folder);
  return chdir("/") != 0 || system(command) != 0 ? 1 : failed;
}
