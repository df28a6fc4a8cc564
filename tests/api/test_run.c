/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Runs with options, comparisons, and results: asked, written, read back. */
#include "api_test.h"

#define SHORT "{flow: usf, engine: dsmc, phi: 0.1, particles: 200, dsmc: {particles: 500}, run: {collisions: 6000}}"

static int reports;
static int count_progress(void *context, const gg_progress *now)
{
  reports++;
  assert_true(now->fraction >= 0 && now->fraction <= 1 && now->engine && now->phase);
  assert_true(isnan(now->relative_error) || (now->phase[0] == 'a' && now->relative_error > 0)); /* not known, never 0 */
  return context && now->phase[0] == 'a' && now->fraction > *(double *)context;
}

/* The fraction of a comparison never falls, whichever engine reports it. */
static int follow_overall(void *context, const gg_progress *now)
{
  double *last = context;
  assert_true(now->overall >= *last && now->overall <= 1 && now->overall >= 0.5 * now->fraction);
  *last = now->overall;
  return count_progress(NULL, now);
}

static double mean_of(const gg_result *r, const char *name)
{
  gg_error err;
  double mean = NAN;
  assert_ok(gg_result_get(r, name, &mean, NULL, &err));
  return mean;
}

/* A callback that stops the run gets results so far; the run goes on from its checkpoint to the very same end. */
static void stopped_and_resumed(void **state)
{
  (void)state;
  gg_error err;
  double half = 0.5;
  gg_scene *s = scene_of(SHORT);
  gg_result *whole = NULL, *part = NULL, *rest = NULL;
  gg_run_options options = {.size = sizeof options, .progress = count_progress};
  assert_ok(gg_run(s, &options, &whole, &err));
  assert_true(reports > 2);
  options.context = &half;
  options.checkpoint = "t_stopped.h5";
  options.output = "t_never.h5";
  assert_int_equal(gg_run(s, &options, &part, &err), GG_INTERRUPTED);
  assert_non_null(part);
  gg_measurement m;
  assert_ok(gg_result_find(part, "temperature", &m, &err));
  assert_true(m.mean > 0 && m.samples > 0 && access("t_never.h5", F_OK) != 0);
  options = (gg_run_options){.size = sizeof(gg_run_options), .resume = "t_stopped.h5", .threads = 2};
  assert_ok(gg_run(s, &options, &rest, &err));
  assert_true(mean_of(rest, "temperature") == mean_of(whole, "temperature"));
  assert_true(mean_of(rest, "N1") == mean_of(whole, "N1") && mean_of(part, "N1") != mean_of(whole, "N1"));
  gg_result_free(whole);
  gg_result_free(part);
  gg_result_free(rest);
  gg_scene_free(s);
}

/* In pieces of a millisecond, asked in between, it ends with the bits of the whole; beside theories it fills the
 * table. */
static void in_pieces(void **state)
{
  (void)state;
  gg_error err;
  int over = 0, pieces = 0;
  gg_scene *s = scene_of(SHORT), *other = scene_of("{flow: usf, phi: 0.2, run: {replicas: 2}}");
  gg_result *whole = NULL, *now = NULL;
  gg_session *session = NULL;
  gg_comparison *table = NULL;
  assert_ok(gg_run(s, NULL, &whole, &err));
  assert_ok(gg_session_new(s, &session, &err));
  for (; !over; pieces++) {
    assert_ok(gg_session_advance(session, 0.005, &over, &err));
    gg_result_free(now);
    assert_ok(gg_session_result(session, &now, &err));
  }
  assert_true(pieces > 3);
  assert_true(mean_of(now, "temperature") == mean_of(whole, "temperature") &&
              mean_of(now, "N1") == mean_of(whole, "N1"));
  gg_progress progress;
  assert_ok(gg_session_get_progress(session, &progress, &err));
  assert_true(progress.fraction == 1);
  assert_ok(gg_theories_evaluate(s, "enskog_hermite", NULL, NULL, &table, &err));
  assert_ok(gg_comparison_take(table, now, &err));
  assert_true(gg_comparison_result(table, "dsmc") == now && !gg_comparison_result(table, "md"));
  gg_comparison *another = NULL;
  assert_ok(gg_theories_evaluate(other, "lun1991", NULL, NULL, &another, &err));
  assert_refused(gg_comparison_take(another, whole, &err), "another scene");
  gg_session *refused = NULL;
  assert_refused(gg_session_new(other, &refused, &err), "run.replicas");
  assert_refused(gg_session_advance(session, 0, NULL, &err), "0 seconds");
  gg_comparison_free(table);
  gg_comparison_free(another);
  gg_session_free(session);
  gg_session_free(NULL);
  gg_result_free(whole);
  gg_scene_free(s);
  gg_scene_free(other);
}

static int at_first(void *context, const gg_progress *progress)
{
  (void)context, (void)progress;
  return 1;
}

static int at_once(void *context)
{
  (void)context;
  return 1;
}

/* Replicas on threads, stopped anywhere, are brought to the same sample before they are averaged. */
static void replicas_stopped(void **state)
{
  (void)state;
  gg_error err;
  double half = 0.5;
  gg_scene *s = scene_of(SHORT);
  gg_result *r = NULL;
  assert_ok(gg_scene_set(s, "run.replicas", "3", &err));
  gg_run_options options = {.size = sizeof options, .threads = 3, .progress = count_progress, .context = &half};
  assert_int_equal(gg_run(s, &options, &r, &err), GG_INTERRUPTED);
  gg_measurement m;
  assert_ok(gg_result_find(r, "pressure", &m, &err));
  assert_true(m.mean > 0 && m.samples % 3 == 0);
  gg_result_free(r);
  options = (gg_run_options){.size = sizeof(gg_run_options), .stop = at_once};
  assert_int_equal(gg_run(s, &options, &r, &err), GG_INTERRUPTED);
  assert_refused(gg_result_get(r, "pressure", NULL, NULL, &err), "warm-up");
  gg_result_free(r);
  gg_scene_free(s);
}

static void same_means(const gg_result *a, const gg_result *b)
{
  gg_measurement x, y;
  gg_error err;
  size_t i = 0;
  for (; gg_result_at(a, i, &x, NULL) == GG_OK; i++) {
    assert_ok(gg_result_at(b, i, &y, &err));
    assert_string_equal(x.name, y.name);
    assert_string_equal(x.unit, y.unit);
    assert_true(x.mean == y.mean || (isnan(x.mean) && isnan(y.mean)));
    assert_true(x.error == y.error || (isnan(x.error) && isnan(y.error)));
    assert_true(x.samples == y.samples && (x.reason == NULL) == (y.reason == NULL));
    if (x.reason) assert_string_equal(x.reason, y.reason);
  }
  assert_true(i > 40);
}

static void same_curves(const gg_result *a, const gg_result *b)
{
  gg_curve_data x, y;
  gg_measurement p, q;
  gg_error err;
  size_t i = 0, numbers = 0;
  for (; gg_result_curve(a, i, &x, NULL) == GG_OK; i++) {
    assert_ok(gg_result_curve(b, i, &y, &err));
    assert_string_equal(x.name, y.name);
    assert_string_equal(x.observable, y.observable);
    assert_string_equal(x.x_unit, y.x_unit);
    assert_true(x.n == y.n && x.log_y == y.log_y && (x.law == NULL) == (y.law == NULL) && x.samples == y.samples);
    assert_memory_equal(x.x, y.x, x.n * sizeof *x.x);
    assert_memory_equal(x.value, y.value, x.n * sizeof *x.value);
    if (x.law) assert_memory_equal(x.law, y.law, x.n * sizeof *x.law);
    for (size_t k = 0; gg_result_curve_number(a, i, k, &p, NULL) == GG_OK; k++, numbers++) {
      assert_ok(gg_result_curve_number(b, i, k, &q, &err));
      assert_string_equal(p.name, q.name);
      assert_true(p.mean == q.mean || (isnan(p.mean) && isnan(q.mean)));
    }
  }
  assert_true(i > 3 && numbers > 3);
}

static void same_text(const gg_result *a, const gg_result *b)
{
  gg_error err;
  char *x = NULL, *y = NULL;
  assert_ok(gg_result_to_json(a, &x, &err));
  assert_ok(gg_result_to_json(b, &y, &err));
  assert_string_equal(x, y);
  free(x);
  free(y);
}

/* A result read back is the one that was written: means, reasons, curves, history, grains, document; and written once
 * more it is so again. */
static void written_and_read(void **state)
{
  (void)state;
  gg_error err;
  gg_scene *s = scene_of("{flow: usf, phi: 0.1, particles: 100, measure: [rheology, velocity_distributions, sonine], "
                         "collision: {beta: 0}, run: {collisions: 300}}");
  gg_result *r = NULL, *back = NULL, *twice = NULL;
  gg_run_options options = {.size = sizeof options, .output = "t_run.h5", .command = "a test"};
  assert_ok(gg_run(s, &options, &r, &err));
  assert_ok(gg_result_read("t_run.h5", &back, &err));
  same_means(r, back);
  same_curves(r, back);
  same_text(r, back);
  gg_result_info a, b;
  assert_ok(gg_result_get_info(r, &a, &err));
  assert_ok(gg_result_get_info(back, &b, &err));
  assert_true(!a.version && strcmp(b.command, "a test") == 0 && strcmp(b.version, gg_version()) == 0);
  assert_true(a.steady == b.steady && a.grains == 100 && b.grains == 100 && a.collisions == b.collisions);
  assert_true(a.window[0] == b.window[0] && b.frames == 1 && strcmp(a.verdict, b.verdict) == 0);
  const double *t[2], *x[2];
  size_t n[2];
  assert_ok(gg_result_history(r, "temperature", &n[0], &t[0], &x[0], &err));
  assert_ok(gg_result_history(back, "temperature", &n[1], &t[1], &x[1], &err));
  assert_true(n[0] == n[1] && n[0] > 100);
  assert_memory_equal(t[0], t[1], n[0] * sizeof(double));
  assert_memory_equal(x[0], x[1], n[0] * sizeof(double));
  double one[300], two[300], spin[300];
  assert_ok(gg_result_grains(r, &(gg_grains){one, NULL, NULL, NULL}, &err));
  assert_ok(gg_result_grains(back, &(gg_grains){two, NULL, spin, NULL}, &err));
  assert_memory_equal(one, two, sizeof one);
  assert_ok(gg_result_write(back, "t_again.h5", NULL, NULL, &err));
  assert_ok(gg_result_read("t_again.h5", &twice, &err));
  same_means(r, twice);
  same_text(r, twice);
  char yaml[40];
  assert_ok(gg_scene_get(gg_result_scene(twice), "particles", yaml, sizeof yaml, &err));
  assert_string_equal(yaml, "100");
  gg_result_free(r);
  gg_result_free(back);
  gg_result_free(twice);
  gg_scene_free(s);
}

/* A missing value has its reason, by every function that returns it. */
static void missing_quantities(void **state)
{
  (void)state;
  gg_error err;
  gg_scene *s = scene_of(SHORT);
  gg_result *r = NULL;
  gg_measurement m;
  size_t n;
  assert_ok(gg_run(s, NULL, &r, &err));
  assert_refused(gg_result_get(r, "temperatur", NULL, NULL, &err),
                 "no quantity called 'temperatur'; did you mean 'temperature'?");
  assert_refused(gg_result_get(r, "temperature_ratio", NULL, NULL, &err), "cannot be had here: ");
  assert_ok(gg_result_find(r, "temperature_ratio", &m, &err));
  assert_true(isnan(m.mean) && m.reason && m.reason[0]);
  assert_null(gg_result_unit(r, "temperature_ratio"));
  assert_string_equal(gg_result_unit(r, "temperature"), "d^2 gamma^2");
  assert_refused(gg_result_history(r, "N1", &n, NULL, NULL, &err), "not followed in time; allowed: temperature, ");
  const char *const followed[] = {"temperature",
                                  "rotational_temperature",
                                  "temperature_ratio",
                                  "pressure",
                                  "P_xy",
                                  "spin_z",
                                  "collision_rate",
                                  "a2",
                                  "cos2_psi"};
  size_t histories = 0, named = 0; /* as the header names them */
  for (size_t i = 0; gg_result_at(r, i, &m, NULL) == GG_OK; i++) {
    histories += gg_result_history(r, m.name, &n, NULL, NULL, NULL) == GG_OK;
    for (size_t k = 0; k < 9; k++) named += strcmp(followed[k], m.name) == 0;
  }
  assert_true(histories == 9 && named == 9);
  for (size_t k = 0; k < 9; k++) assert_ok(gg_result_history(r, followed[k], &n, NULL, NULL, &err));
  gg_curve_data curve;
  assert_refused(gg_result_curve(r, 0, &curve, &err), "0 curves");
  double x[3];
  assert_refused(gg_result_grains(r, &(gg_grains){x, NULL, NULL, NULL}, &err), "no positions");
  assert_int_equal(gg_result_read("t_nowhere.h5", &r, &err), GG_BAD_FILE);
  gg_result_free(r);
  gg_scene_free(s);
}

/* Files that cannot be written: known before the run, or with the result in hand. */
static void unwritable_output(void **state)
{
  (void)state;
  gg_error err;
  gg_scene *s = scene_of(SHORT);
  gg_result *r = NULL;
  assert_int_equal(gg_run(s, &(gg_run_options){.size = sizeof(gg_run_options), .output = "nowhere/t.h5"}, &r, &err),
                   GG_BAD_FILE);
  assert_null(r);
  assert_int_equal(gg_run(s, &(gg_run_options){.size = sizeof(gg_run_options), .resume = "t_nowhere.h5"}, &r, &err),
                   GG_BAD_FILE);
  assert_null(r);
  gg_scene_free(s);
}

/* A comparison has both parts, agreement, theories with their deviations; read back it has them still. */
static void a_comparison_is_read_back_whole(void **state)
{
  (void)state;
  gg_error err;
  gg_scene *s = scene_of("{flow: usf, phi: 0.05, particles: 200, collision: {e: 0.8}, run: {collisions: 300}}");
  gg_comparison *c = NULL, *back = NULL;
  double overall = 0;
  gg_run_options options = {
      .size = sizeof options, .threads = 2, .output = "t_compare.h5", .progress = follow_overall, .context = &overall};
  gg_status status = gg_compare(s, &options, &c, &err);
  assert_true(status == GG_OK || status == GG_FAILED);
  assert_true(overall == 1);
  assert_ok(gg_comparison_read("t_compare.h5", &back, &err));
  const gg_comparison *both[] = {c, back};
  double z[2], value[2], deviation[2], md = mean_of(gg_comparison_result(c, "md"), "temperature");
  for (int k = 0; k < 2; k++) {
    assert_non_null(gg_comparison_result(both[k], "dsmc"));
    assert_null(gg_comparison_refusal(both[k], "md"));
    assert_null(gg_comparison_result(both[k], "lattice"));
    assert_ok(gg_comparison_agreement(both[k], "temperature", &z[k], NULL, &err));
    assert_ok(gg_comparison_theory_value(both[k], "grad", "temperature", &value[k], &deviation[k], &err));
    assert_true(fabs(deviation[k] - (value[k] / md - 1)) < 1e-12);
  }
  assert_true(z[0] == z[1] && value[0] == value[1]);
  gg_theory_info theory;
  int applying = 0, refusing = 0;
  for (size_t i = 0; gg_comparison_theory(back, i, &theory, NULL) == GG_OK; i++)
    theory.reason ? refusing++ : applying++;
  assert_true(applying > 2 && refusing > 5);
  assert_refused(gg_comparison_theory_value(c, "newton", "temperature", value, NULL, &err), "no theory called");
  gg_remark remark;
  for (size_t i = 0; gg_comparison_remark(c, i, &remark, NULL) == GG_OK; i++) assert_non_null(remark.cause);
  gg_result *r = NULL;
  assert_refused(gg_result_read("t_compare.h5", &r, &err), "gg_comparison_read");
  same_means(gg_comparison_result(c, "dsmc"), gg_comparison_result(back, "dsmc"));
  gg_comparison_free(c);
  gg_comparison_free(back);
  gg_scene_free(s);
}

/* An engine that cannot run the scene is left out with the reason; a comparison that is stopped has what there is. */
static void part_comparisons(void **state)
{
  (void)state;
  gg_error err;
  gg_scene *s = scene_of("{flow: usf, phi: 0, collision: {beta: 0}, dsmc: {particles: 500}, run: {collisions: 400}}");
  gg_comparison *c = NULL;
  assert_ok(gg_compare(s, NULL, &c, &err));
  assert_null(gg_comparison_result(c, "md"));
  assert_non_null(strstr(gg_comparison_refusal(c, "md"), "phi"));
  assert_non_null(gg_comparison_result(c, "dsmc"));
  gg_comparison_free(c);
  c = NULL;
  assert_int_equal(gg_compare(s, &(gg_run_options){.size = sizeof(gg_run_options), .stop = at_once}, &c, &err),
                   GG_INTERRUPTED);
  assert_null(c); /* in a theory */
  assert_ok(gg_scene_set(s, "run.collisions", "100000", &err));
  assert_int_equal(gg_compare(s, &(gg_run_options){.size = sizeof(gg_run_options), .progress = at_first}, &c, &err),
                   GG_INTERRUPTED);
  assert_non_null(gg_comparison_result(c, "dsmc"));
  gg_comparison_free(c);
  gg_scene_free(s);
}

static double cooling_rate_of(const char *yaml)
{
  gg_error err;
  gg_scene *s = scene_of(yaml);
  gg_comparison *c = NULL;
  double zeta;
  assert_ok(gg_theories_evaluate(s, "garzo_dufty1999", NULL, NULL, &c, &err));
  assert_ok(gg_comparison_theory_value(c, "garzo_dufty1999", "cooling_rate", &zeta, NULL, &err));
  gg_comparison_free(c);
  gg_scene_free(s);
  return zeta;
}

/* Theories describe the final state of a gas that changes on the way. */
static void theories_after_changes(void **state)
{
  (void)state;
  const double zeta =
      cooling_rate_of("{flow: hcs, phi: 0.1, collision: {e: 0.8}, run: {duration: 9}, protocol: [{at: 1, "
                      "collision.e: 0.7}, {at: 5, collision.e: 0.6}]}");
  assert_true(zeta == cooling_rate_of("{flow: hcs, phi: 0.1, collision: {e: 0.6}}"));
  assert_true(zeta > cooling_rate_of("{flow: hcs, phi: 0.1, collision: {e: 0.8}}"));
}

/* Theories without engines: all, one, and a name that none has. */
static void named_theories_alone_are_evaluated(void **state)
{
  (void)state;
  gg_error err;
  gg_scene *s = scene_of("{flow: hcs, phi: 0.1, collision: {e: 0.8}}");
  gg_comparison *all = NULL, *one = NULL;
  gg_theory_info info;
  double zeta[2], none;
  assert_ok(gg_theories_evaluate(s, NULL, NULL, NULL, &all, &err));
  assert_ok(gg_theories_evaluate(s, "garzo_dufty1999", NULL, NULL, &one, &err));
  assert_ok(gg_comparison_theory_value(all, "garzo_dufty1999", "cooling_rate", &zeta[0], NULL, &err));
  assert_ok(gg_comparison_theory_value(one, "garzo_dufty1999", "cooling_rate", &zeta[1], &none, &err));
  assert_true(zeta[0] == zeta[1] && zeta[0] > 0 && isnan(none));
  assert_ok(gg_comparison_theory(one, 0, &info, &err));
  assert_true(!info.reason && strstr(info.citation, "1999") && info.title && info.assumptions);
  assert_int_equal(gg_comparison_theory(one, 1, &info, &err), GG_BAD_INPUT);
  assert_refused(gg_theories_evaluate(s, "newton", NULL, NULL, &one, &err), "no theory called 'newton'");
  assert_refused(gg_comparison_write(all, "t_theory.h5", NULL, NULL, &err), "nothing was simulated");
  char *text = NULL;
  assert_ok(gg_comparison_to_json(all, &text, &err));
  assert_non_null(strstr(text, "\"garzo_dufty1999\""));
  free(text);
  gg_comparison_free(all);
  gg_comparison_free(one);
  gg_scene_free(s);
}

/* Times in a cooling gas grow without end: its correlation times are collisions a grain, also in the document. */
static void correlation_times(void **state)
{
  (void)state;
  static const struct {
    const char *flow, *quantity, *unit;
  } cases[] = {{"hcs", "cooling_rate", "collisions a grain"}, {"usf", "temperature", "1/gamma"}};
  for (int i = 0; i < 2; i++) {
    gg_error err;
    char yaml[200], *text = NULL;
    snprintf(yaml, sizeof yaml,
             "{flow: %s, engine: dsmc, phi: 0.1, dsmc: {particles: 500}, collision: {e: 0.7}, run: {collisions: 2000}}",
             cases[i].flow);
    gg_scene *s = scene_of(yaml);
    gg_result *r = NULL;
    gg_measurement m;
    assert_ok(gg_run(s, NULL, &r, &err));
    assert_ok(gg_result_find(r, cases[i].quantity, &m, &err));
    print_message("# %s: %g %s\n", cases[i].flow, m.correlation_time, m.correlation_time_unit);
    assert_string_equal(m.correlation_time_unit, cases[i].unit);
    assert_true(m.correlation_time > 0.1 && m.correlation_time < 20);
    assert_ok(gg_result_to_json(r, &text, &err));
    assert_non_null(strstr(text, "\"correlation_time_unit\""));
    assert_non_null(strstr(text, cases[i].unit));
    free(text);
    gg_result_free(r);
    gg_scene_free(s);
  }
}

/* Estimates of what a run needs: collisions up to a requested error, also of quantities that are small beside what
 * they are made of (N1, a2); time a collision where a species has too few grains for blocks of eight. */
static void a_run_states_what_it_needs(void **state)
{
  (void)state;
  static const struct {
    const char *scene;
    double factor; /* that collisions are within */
  } scenes[] = {
      {"{flow: usf, engine: dsmc, phi: 0.1, dsmc: {particles: 1000}, run: {relative_error: 0.03}}", 4},
      {"{flow: usf, engine: dsmc, phi: 0.1, collision: {e: 0.98}, dsmc: {particles: 1000}, run: {until: {N1: 0.05}}}",
       3},
      {"{flow: hcs, engine: dsmc, phi: 0.1, dsmc: {particles: 1000}, run: {until: {a2: 0.03}}}", 3},
  };
  gg_error err;
  for (size_t k = 0; k < sizeof scenes / sizeof *scenes; k++) {
    gg_scene *s = scene_of(scenes[k].scene);
    gg_scene_needs n;
    gg_result *r = NULL;
    gg_result_info info;
    assert_ok(gg_scene_get_needs(s, "dsmc", &n, &err));
    assert_ok(gg_run(s, NULL, &r, &err));
    assert_ok(gg_result_get_info(r, &info, &err));
    const double took = 2 * (double)info.total_collisions / 1000;
    print_message("# %.0f collisions a grain, expected %.0f\n", took, n.collisions_per_grain);
    assert_true(n.collisions_per_grain < scenes[k].factor * took && took < scenes[k].factor * n.collisions_per_grain);
    gg_result_free(r);
    gg_scene_free(s);
  }
  double seconds[3];
  for (int k = 0; k < 3; k++) {
    gg_scene *s =
        scene_of("{flow: usf, phi: 0.1, species: [{fraction: 0.5}, {fraction: 0.5}], run: {collisions: 500}}");
    gg_scene_needs n;
    if (k == 1) assert_ok(gg_scene_set(s, "species", "[{fraction: 0.9}, {fraction: 0.1, diameter: 4}]", &err));
    if (k == 2) assert_ok(gg_scene_set(s, "dsmc.particles", "500", &err));
    assert_ok(gg_scene_get_needs(s, "dsmc", &n, &err));
    seconds[k] = n.cpu_seconds / n.collisions_per_grain / (k == 2 ? 500 : 5000);
    gg_scene_free(s);
  }
  assert_true(seconds[1] > 5 * seconds[0] && seconds[2] > 10 * seconds[0]);
}

static int at_a_third(void *context, const gg_progress *now)
{
  (void)context;
  return now->overall > 0.33;
}

/* The text of a member of a JSON document, an object; to be freed. */
static char *member_of(const gg_comparison *c, const char *name)
{
  char *text, *end;
  gg_error err;
  assert_ok(gg_comparison_to_json(c, &text, &err));
  char *at = strstr(text, name);
  assert_non_null(at);
  int depth = 0;
  for (end = strchr(at, '{'); *end && (depth += (*end == '{') - (*end == '}')) > 0;) end++;
  *end = 0;
  memmove(text, at, strlen(at) + 1);
  return text;
}

/* Between walls, curves of theories do not depend on an interruption: in what is returned, in JSON, in the file. */
static void a_resumed_comparison_has_the_curves_of_theories(void **state)
{
  (void)state;
  gg_error err;
  gg_scene *s = scene_of("{flow: couette, phi: 0.1, particles: 200, collision: {e: 0.9}, walls: {e: 0.9, beta: 0}, "
                         "dsmc: {particles: 400}, measure: [rheology, profiles, fluxes], "
                         "run: {collisions: 200, warmup: 20}}");
  gg_comparison *c[4] = {NULL};
  gg_run_options options = {.size = sizeof options, .output = "t_whole.h5"};
  gg_compare(s, &options, &c[0], &err);
  options = (gg_run_options){.size = sizeof options, .checkpoint = "t_walls.h5", .progress = at_a_third};
  assert_int_equal(gg_compare(s, &options, &c[1], &err), GG_INTERRUPTED);
  gg_comparison_free(c[1]);
  options = (gg_run_options){.size = sizeof options, .resume = "t_walls.h5", .output = "t_resumed.h5"};
  gg_compare(s, &options, &c[1], &err);
  assert_ok(gg_comparison_read("t_whole.h5", &c[2], &err));
  assert_ok(gg_comparison_read("t_resumed.h5", &c[3], &err));
  char *json = member_of(c[0], "\"theory_curves\"");
  assert_non_null(strstr(json, "\"moments\""));
  assert_true(strlen(json) > 5000);
  for (int k = 1; k < 4; k++) {
    char *other = member_of(c[k], "\"theory_curves\"");
    assert_string_equal(json, other);
    free(other);
  }
  gg_curve_data a, b;
  size_t n = 0;
  for (; gg_comparison_theory_curve(c[0], "moments", n, &a, NULL) == GG_OK; n++) {
    assert_ok(gg_comparison_theory_curve(c[3], "moments", n, &b, &err));
    assert_string_equal(a.name, b.name);
    assert_memory_equal(a.value, b.value, a.n * sizeof *a.value);
  }
  assert_true(n > 8);
  same_means(gg_comparison_result(c[0], "md"), gg_comparison_result(c[3], "md"));
  free(json);
  for (int k = 0; k < 4; k++) gg_comparison_free(c[k]);
  gg_scene_free(s);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(stopped_and_resumed),
      cmocka_unit_test(in_pieces),
      cmocka_unit_test(replicas_stopped),
      cmocka_unit_test(written_and_read),
      cmocka_unit_test(missing_quantities),
      cmocka_unit_test(unwritable_output),
      cmocka_unit_test(a_comparison_is_read_back_whole),
      cmocka_unit_test(a_resumed_comparison_has_the_curves_of_theories),
      cmocka_unit_test(part_comparisons),
      cmocka_unit_test(named_theories_alone_are_evaluated),
      cmocka_unit_test(theories_after_changes),
      cmocka_unit_test(correlation_times),
      cmocka_unit_test(a_run_states_what_it_needs),
  };
  return cmocka_run_group_tests(tests, enter_folder, leave_folder);
}
