/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Long calls poll `stop` often, also before and after the work of an engine; a stopped call leaves no file.
 * Counted in polls, not in time. */
#include <stdbool.h>

#include "api_test.h"

typedef struct polling {
  const char *checkpoint;
  int polls, samples;
  int from;    /* sample from whose end on polls count */
  int allowed; /* polls before it stops */
} polling;

static int is_enough(void *context)
{
  polling *p = context;
  return p->samples >= p->from && p->polls++ >= p->allowed;
}

static void count_sample(void *context, void *state, const gg_sample *now, double *values)
{
  (void)state;
  polling *p = context;
  p->samples++;
  values[0] = now->velocity[0];
}

/* Followed for so long that kinetic theory has to be followed for its second or two, and md hardly works. */
static gg_status follow(polling *p, const char *yaml, gg_result **r, gg_error *err)
{
  static const gg_quantity_definition q = {"one", "1", "a number"};
  gg_scene *s = scene_of(yaml);
  gg_status status = gg_scene_add_observable(
      s,
      &(gg_observable_definition){
          .name = "own", .n_quantities = 1, .quantities = &q, .sample = count_sample, .context = p},
      err);
  if (status == GG_OK)
    status = gg_run(
        s,
        &(gg_run_options){.size = sizeof(gg_run_options), .stop = is_enough, .checkpoint = p->checkpoint, .context = p},
        r, err);
  gg_scene_free(s);
  return status;
}

/* Long beside what the engine does of it. */
static const char followed[] =
    "{flow: hcs, engine: dsmc, phi: 0.05, dsmc: {particles: 40}, collision: {e: 0.9}, run: {duration: 30000}, "
    "species: [{fraction: 0.4}, {fraction: 0.3, mass: 2}, {fraction: 0.2, mass: 3}, {fraction: 0.1, mass: 4}]}";

/* An estimate of the cost comes before the engine. */
static void before_followed_runs(void **state)
{
  (void)state;
  gg_error err;
  gg_result *r = NULL;
  polling p = {.allowed = 100};
  assert_int_equal(follow(&p, followed, &r, &err), GG_INTERRUPTED);
  assert_int_equal(p.samples, 0);
  gg_result_free(r);
}

static bool has_theory(const gg_result *r)
{
  gg_error err;
  gg_curve_data c;
  for (size_t k = 0; gg_result_curve(r, k, &c, &err) == GG_OK; k++)
    if (c.law && !isnan(c.law[c.n - 1])) return true;
  return false;
}

/* The curves' theory comes after it: a run that is stopped there has its result, without what would last, and can be
 * resumed. */
static void after_followed_runs(void **state)
{
  (void)state;
  gg_error err;
  gg_result *r = NULL;
  polling whole = {.allowed = 1 << 30}, p;
  assert_ok(follow(&whole, followed, &r, &err));
  assert_true(has_theory(r));
  gg_result_free(r);
  for (int part = 0; part < 3; part++) {
    r = NULL;
    p = (polling){.from = whole.samples, .allowed = 100 + 50 * part, .checkpoint = "t_end.h5"};
    assert_int_equal(follow(&p, followed, &r, &err), GG_INTERRUPTED);
    assert_int_equal(p.samples, whole.samples);
    assert_non_null(r);
    assert_false(has_theory(r));
    gg_result_free(r);
    assert_int_equal(unlink("t_end.h5"), 0);
  }
}

/* Results that take no time are complete, also those of a run that is stopped on its way. */
static void short_theory_of_stopped_runs(void **state)
{
  (void)state;
  gg_error err;
  gg_result *r = NULL;
  polling p = {.from = 50};
  assert_int_equal(
      follow(&p,
             "{flow: hcs, engine: dsmc, phi: 0.05, dsmc: {particles: 4000}, collision: {e: 0.9}, run: {duration: 300}}",
             &r, &err),
      GG_INTERRUPTED);
  assert_true(has_theory(r));
  gg_result_free(r);
}

/* Calls that write files. */
typedef gg_status (*call_with_files)(polling *p, gg_error *err);

static gg_status write_result(polling *p, gg_error *err)
{
  gg_result *r = NULL;
  gg_status status = gg_result_read("t_run.h5", &r, err);
  if (status == GG_OK) status = gg_result_write(r, "t_made.h5", is_enough, p, err);
  gg_result_free(r);
  return status;
}

static gg_status write_comparison(polling *p, gg_error *err)
{
  gg_comparison *c = NULL;
  gg_status status = gg_comparison_read("t_both.h5", &c, err);
  if (status == GG_OK) status = gg_comparison_write(c, "t_made.h5", is_enough, p, err);
  gg_comparison_free(c);
  return status;
}

static gg_status export_result(polling *p, gg_error *err)
{
  return gg_export("t_run.h5", "t_made", GG_EXPORT_ALL, NULL, NULL, is_enough, p, err);
}

static gg_status draw_curves(polling *p, gg_error *err)
{
  return gg_plot("t_run.h5", "t_made.svg", NULL, NULL, NULL, is_enough, p, err);
}

static bool is_made(void)
{
  return access("t_made.h5", F_OK) == 0 || access("t_made.csv", F_OK) == 0 || access("t_made.xyz", F_OK) == 0;
}

/* Writes end where they are stopped, at every stage, and leave no file. Pictures are drawn one after the other. */
static void stopped_writes_leave_no_file(void **state)
{
  (void)state;
  gg_error err;
  gg_result *r = NULL;
  gg_comparison *c = NULL;
  gg_scene *s = scene_of("{flow: usf, phi: 0.1, particles: 5000, dsmc: {particles: 2000}, run: {collisions: 40}, "
                         "measure: [rheology, velocity_distributions], output: {trajectory_every: 20}}");
  assert_ok(gg_run(s, &(gg_run_options){.size = sizeof(gg_run_options), .output = "t_run.h5"}, &r, &err));
  gg_result_free(r);
  gg_scene_free(s);
  s = scene_of("{flow: usf, phi: 0.1, particles: 200, collision: {beta: 0}, run: {collisions: 40}}");
  assert_ok(gg_compare(s, &(gg_run_options){.size = sizeof(gg_run_options), .output = "t_both.h5"}, &c, &err));
  gg_comparison_free(c);
  gg_scene_free(s);
  const struct {
    call_with_files call;
    int least; /* polls of the whole call */
    bool keeps;
  } tries[] = {
      {write_result, 50, false}, {write_comparison, 50, false}, {export_result, 20, false}, {draw_curves, 100, true}};
  for (size_t k = 0; k < sizeof tries / sizeof *tries; k++) {
    polling whole = {.allowed = 1 << 30};
    assert_ok(tries[k].call(&whole, &err));
    assert_true(whole.polls >= tries[k].least);
    for (int part = 0; part < 4; part++) {
      polling p = {.allowed = part * (whole.polls - 1) / 3};
      assert_int_equal(system("rm -f t_made*"), 0);
      assert_int_equal(tries[k].call(&p, &err), GG_INTERRUPTED);
      assert_int_equal(p.polls, p.allowed + 1);
      assert_true(tries[k].keeps || !is_made());
    }
  }
}

static int polls_of_write(const char *yaml)
{
  gg_error err;
  gg_result *r = NULL;
  gg_scene *s = scene_of(yaml);
  polling p = {.allowed = 1 << 30};
  assert_ok(gg_run(s, NULL, &r, &err));
  assert_ok(gg_result_write(r, "t_made.h5", is_enough, &p, &err));
  gg_result_free(r);
  gg_scene_free(s);
  return p.polls;
}

/* A large file goes to the disk by parts: it has 3 MB of velocities and numbers of its grains. */
static void large_file(void **state)
{
  (void)state;
  const int small =
                polls_of_write("{flow: usf, engine: dsmc, phi: 0.1, dsmc: {particles: 100}, run: {collisions: 40}}"),
            large =
                polls_of_write("{flow: usf, engine: dsmc, phi: 0.1, dsmc: {particles: 100000}, run: {collisions: 40}}");
  assert_true(large >= small + 3);
}

/* A validation stops between points and before the page. */
static void a_validation_stops_between_points(void **state)
{
  (void)state;
  gg_error err;
  gg_sweep *w = NULL;
  char *verdict = NULL;
  assert_ok(gg_sweep_parse("{flow: usf, phi: 0.1, particles: 100, collision: {beta: 0}, dsmc: {particles: 200}, "
                           "run: {collisions: 40}, vary: {collision.e: [0.8, 0.9]}, sweep: {does: compare}}",
                           "test", &w, &err));
  gg_sweep_run(w, "t_grid", NULL, &err);
  for (int k = 0; k < 3; k++) {
    polling p = {.allowed = k};
    assert_int_equal(gg_sweep_validate(w, "t_grid",
                                       &(gg_validate_options){
                                           .size = sizeof(gg_validate_options), .page = "t_page.md", .stop = is_enough},
                                       NULL, &p, &verdict, &err),
                     GG_INTERRUPTED);
    assert_null(verdict);
    assert_int_equal(p.polls, k + 1);
    assert_int_not_equal(access("t_page.md", F_OK), 0);
  }
  gg_sweep_free(w);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(before_followed_runs),
      cmocka_unit_test(after_followed_runs),
      cmocka_unit_test(short_theory_of_stopped_runs),
      cmocka_unit_test(stopped_writes_leave_no_file),
      cmocka_unit_test(large_file),
      cmocka_unit_test(a_validation_stops_between_points),
  };
  return cmocka_run_group_tests(tests, enter_folder, leave_folder);
}
