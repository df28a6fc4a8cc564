/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A missing argument is answered with GG_BAD_INPUT and a message that names it, in every function. */
#include "api_test.h"

#define SHEAR "{flow: usf, phi: 0.1, particles: 100, collision: {beta: 0}, engine: dsmc}"
#define assert_missing(call) assert_refused(call, "is missing (NULL)")

static void line(void *context, const char *text)
{
  (void)context, (void)text;
}

static void calls_of_scenes_reject_missing_arguments(void **state)
{
  (void)state;
  gg_error err;
  char text[40], *whole;
  gg_scene *s = scene_of(SHEAR), *other = NULL;
  assert_missing(gg_scene_load(NULL, &other, &err));
  assert_missing(gg_scene_load("x", NULL, &err));
  assert_missing(gg_scene_parse(NULL, "x", &other, &err));
  assert_missing(gg_scene_parse(SHEAR, "x", NULL, &err));
  assert_missing(gg_scene_copy(NULL, &other, &err));
  assert_missing(gg_scene_copy(s, NULL, &err));
  assert_missing(gg_scene_set(NULL, "phi", "1", &err));
  assert_missing(gg_scene_set(s, NULL, "1", &err));
  assert_missing(gg_scene_set(s, "phi", NULL, &err));
  assert_missing(gg_scene_get(NULL, "phi", text, sizeof text, &err));
  assert_missing(gg_scene_get(s, NULL, text, sizeof text, &err));
  assert_missing(gg_scene_get(s, "phi", NULL, 0, &err));
  assert_missing(gg_scene_check(NULL, &err));
  assert_missing(gg_scene_to_yaml(NULL, &whole, &err));
  assert_missing(gg_scene_to_yaml(s, NULL, &err));
  assert_missing(gg_scene_to_json(NULL, &whole, &err));
  assert_missing(gg_scene_to_json(s, NULL, &err));
  assert_missing(gg_scene_title(NULL, text, sizeof text, &err));
  assert_missing(gg_scene_title(s, NULL, 0, &err));
  assert_missing(gg_scene_describe(NULL, "md", line, NULL, &err));
  assert_missing(gg_scene_describe(s, NULL, line, NULL, &err));
  assert_missing(gg_scene_describe(s, "md", NULL, NULL, &err));
  gg_scene_needs needs;
  assert_missing(gg_scene_get_needs(NULL, "md", &needs, &err));
  assert_missing(gg_scene_get_needs(s, NULL, &needs, &err));
  assert_missing(gg_scene_get_needs(s, "md", NULL, &err));
  assert_int_equal(gg_scene_check(NULL, NULL), GG_BAD_INPUT); /* nobody has to listen */
  assert_null(other);
  gg_scene_free(s);
  gg_scene_free(NULL);
}

static void calls_of_simulations_reject_missing_arguments(void **state)
{
  (void)state;
  gg_error err;
  gg_scene *s = scene_of(SHEAR);
  gg_simulation *m = NULL, *other = NULL;
  gg_simulation_state now;
  gg_simulation_sums sums;
  gg_grains grains = {0};
  assert_ok(gg_simulation_new(s, NULL, &m, &err));
  assert_missing(gg_simulation_new(NULL, NULL, &other, &err));
  assert_missing(gg_simulation_new(s, NULL, NULL, &err));
  assert_missing(gg_simulation_advance(NULL, 1, &err));
  assert_missing(gg_simulation_collide(NULL, 1, &err));
  assert_missing(gg_simulation_get_state(NULL, &now, &err));
  assert_missing(gg_simulation_get_state(m, NULL, &err));
  assert_missing(gg_simulation_get_grains(NULL, &grains, &err));
  assert_missing(gg_simulation_get_grains(m, NULL, &err));
  assert_missing(gg_simulation_take_sums(NULL, &sums, &err));
  assert_missing(gg_simulation_take_sums(m, NULL, &err));
  assert_missing(gg_simulation_on_collision(NULL, NULL, NULL, &err));
  assert_missing(gg_simulation_on_stop(NULL, NULL, NULL, &err));
  assert_missing(gg_simulation_save(NULL, "x", NULL, NULL, &err));
  assert_missing(gg_simulation_save(m, NULL, NULL, NULL, &err));
  assert_missing(gg_simulation_load(NULL, NULL, NULL, NULL, &other, &err));
  assert_missing(gg_simulation_load("x", NULL, NULL, NULL, NULL, &err));
  assert_missing(gg_checkpoint_about(NULL, &(gg_checkpoint_info){0}, NULL, &err));
  assert_missing(gg_checkpoint_about("x", NULL, NULL, &err));
  void *bytes = NULL;
  size_t size;
  assert_missing(gg_simulation_to_bytes(NULL, NULL, NULL, &bytes, &size, &err));
  assert_missing(gg_simulation_to_bytes(m, NULL, NULL, NULL, &size, &err));
  assert_missing(gg_simulation_to_bytes(m, NULL, NULL, &bytes, NULL, &err));
  assert_missing(gg_simulation_from_bytes(NULL, 1, NULL, NULL, NULL, &other, &err));
  assert_missing(gg_simulation_from_bytes("x", 1, NULL, NULL, NULL, NULL, &err));
  assert_null(bytes);
  assert_null(other);
  gg_simulation_free(m);
  gg_simulation_free(NULL);
  gg_scene_free(s);
}

static void calls_of_results_reject_missing_arguments(void **state)
{
  (void)state;
  gg_error err;
  gg_scene *s = scene_of(SHEAR);
  gg_result *r = NULL, *other = NULL;
  gg_measurement m;
  gg_result_info info;
  gg_curve_data curve;
  gg_grains grains = {0};
  char *text;
  size_t n;
  assert_ok(gg_scene_set(s, "run", "{collisions: 400}", &err));
  assert_ok(gg_run(s, NULL, &r, &err));
  assert_missing(gg_run(NULL, NULL, &other, &err));
  assert_missing(gg_run(s, NULL, NULL, &err));
  assert_missing(gg_result_get(NULL, "N1", NULL, NULL, &err));
  assert_missing(gg_result_get(r, NULL, NULL, NULL, &err));
  assert_missing(gg_result_find(NULL, "N1", &m, &err));
  assert_missing(gg_result_find(r, NULL, &m, &err));
  assert_missing(gg_result_find(r, "N1", NULL, &err));
  double covariance;
  assert_missing(gg_result_covariance(NULL, "N1", "N1", &covariance, &err));
  assert_missing(gg_result_covariance(r, NULL, "N1", &covariance, &err));
  assert_missing(gg_result_covariance(r, "N1", NULL, &covariance, &err));
  assert_missing(gg_result_covariance(r, "N1", "N1", NULL, &err));
  assert_missing(gg_result_at(NULL, 0, &m, &err));
  assert_missing(gg_result_at(r, 0, NULL, &err));
  assert_missing(gg_result_get_info(NULL, &info, &err));
  assert_missing(gg_result_get_info(r, NULL, &err));
  assert_missing(gg_result_history(NULL, "N1", &n, NULL, NULL, &err));
  assert_missing(gg_result_history(r, NULL, &n, NULL, NULL, &err));
  assert_missing(gg_result_history(r, "N1", NULL, NULL, NULL, &err));
  assert_missing(gg_result_curve(NULL, 0, &curve, &err));
  assert_missing(gg_result_curve(r, 0, NULL, &err));
  assert_missing(gg_result_curve_number(NULL, 0, 0, &m, &err));
  assert_missing(gg_result_curve_number(r, 0, 0, NULL, &err));
  assert_missing(gg_result_grains(NULL, &grains, &err));
  assert_missing(gg_result_grains(r, NULL, &err));
  assert_missing(gg_result_to_json(NULL, &text, &err));
  assert_missing(gg_result_to_json(r, NULL, &err));
  assert_missing(gg_result_write(NULL, "x", NULL, NULL, &err));
  assert_missing(gg_result_write(r, NULL, NULL, NULL, &err));
  assert_missing(gg_result_read(NULL, &other, &err));
  assert_missing(gg_result_read("x", NULL, &err));
  void *bytes = NULL;
  assert_missing(gg_result_to_bytes(NULL, &bytes, &n, &err));
  assert_missing(gg_result_to_bytes(r, NULL, &n, &err));
  assert_missing(gg_result_to_bytes(r, &bytes, NULL, &err));
  assert_missing(gg_result_from_bytes(NULL, 1, &other, &err));
  assert_missing(gg_result_from_bytes("x", 1, NULL, &err));
  assert_null(bytes);
  assert_null(gg_result_unit(NULL, "N1"));
  assert_null(gg_result_unit(r, NULL));
  assert_int_equal(gg_result_is_steady(NULL), 0);
  assert_null(gg_result_scene(NULL));
  assert_null(gg_result_warning(NULL, 0));
  assert_null(other);
  gg_result_free(r);
  gg_result_free(NULL);
  gg_scene_free(s);
}

static void calls_of_comparisons_reject_missing_arguments(void **state)
{
  (void)state;
  gg_error err;
  gg_scene *s = scene_of(SHEAR);
  gg_comparison *c = NULL, *other = NULL;
  gg_theory_info theory;
  gg_departure departure;
  gg_remark remark;
  double x;
  char *text;
  assert_ok(gg_theories_evaluate(s, NULL, NULL, NULL, &c, &err));
  assert_missing(gg_theories_evaluate(NULL, NULL, NULL, NULL, &other, &err));
  assert_missing(gg_theories_evaluate(s, NULL, NULL, NULL, NULL, &err));
  assert_missing(gg_compare(NULL, NULL, &other, &err));
  assert_missing(gg_compare(s, NULL, NULL, &err));
  assert_null(gg_comparison_result(NULL, "md"));
  assert_null(gg_comparison_result(c, NULL));
  assert_null(gg_comparison_refusal(NULL, "md"));
  assert_null(gg_comparison_refusal(c, NULL));
  assert_null(gg_comparison_scene(NULL));
  assert_missing(gg_comparison_agreement(NULL, "N1", &x, NULL, &err));
  assert_missing(gg_comparison_agreement(c, NULL, &x, NULL, &err));
  assert_missing(gg_comparison_departure(NULL, "md", "N1", &departure, &err));
  assert_missing(gg_comparison_departure(c, NULL, "N1", &departure, &err));
  assert_missing(gg_comparison_departure(c, "md", NULL, &departure, &err));
  assert_missing(gg_comparison_departure(c, "md", "N1", NULL, &err));
  assert_ok(gg_comparison_departure(c, "md", "N1", &departure, &err));
  assert_true(isnan(departure.z) && isnan(departure.difference));
  assert_missing(gg_comparison_theory(NULL, 0, &theory, &err));
  assert_missing(gg_comparison_theory(c, 0, NULL, &err));
  assert_missing(gg_comparison_theory_value(NULL, "grad", "N1", &x, NULL, &err));
  assert_missing(gg_comparison_theory_value(c, NULL, "N1", &x, NULL, &err));
  assert_missing(gg_comparison_theory_value(c, "grad", NULL, &x, NULL, &err));
  assert_missing(gg_comparison_remark(NULL, 0, &remark, &err));
  assert_missing(gg_comparison_remark(c, 0, NULL, &err));
  assert_missing(gg_comparison_to_json(NULL, &text, &err));
  assert_missing(gg_comparison_to_json(c, NULL, &err));
  assert_missing(gg_comparison_write(NULL, "x", NULL, NULL, &err));
  assert_missing(gg_comparison_write(c, NULL, NULL, NULL, &err));
  assert_missing(gg_comparison_read(NULL, &other, &err));
  assert_missing(gg_comparison_read("x", NULL, &err));
  void *bytes = NULL;
  size_t size;
  assert_missing(gg_comparison_to_bytes(NULL, &bytes, &size, &err));
  assert_missing(gg_comparison_to_bytes(c, NULL, &size, &err));
  assert_missing(gg_comparison_to_bytes(c, &bytes, NULL, &err));
  assert_missing(gg_comparison_from_bytes(NULL, 1, &other, &err));
  assert_missing(gg_comparison_from_bytes("x", 1, NULL, &err));
  assert_null(bytes);
  assert_missing(gg_plot(NULL, "x.svg", NULL, NULL, NULL, NULL, NULL, &err));
  assert_missing(gg_plot("x", NULL, NULL, NULL, NULL, NULL, NULL, &err));
  assert_missing(gg_export(NULL, "x", GG_EXPORT_ALL, NULL, NULL, NULL, NULL, &err));
  assert_missing(gg_export("x", NULL, GG_EXPORT_ALL, NULL, NULL, NULL, NULL, &err));
  char notice[8];
  assert_missing(gg_result_file_notice(NULL, notice, sizeof notice, &err));
  assert_missing(gg_result_file_notice("x", NULL, 8, &err));
  assert_refused(gg_result_file_notice("x", notice, 0, &err), "no room");
  gg_text_make_printable(NULL);
  assert_null(other);
  gg_comparison_free(c);
  gg_comparison_free(NULL);
  gg_scene_free(s);
}

static void calls_of_tables_reject_missing_arguments(void **state)
{
  (void)state;
  gg_error err;
  gg_entry entry;
  const char *const known[] = {"md", NULL};
  assert_missing(gg_catalogue_entry(GG_CATALOGUE_KEYS, 0, NULL, NULL, &err));
  assert_missing(gg_catalogue_word(NULL, 0, &entry, &err));
  assert_missing(gg_catalogue_word("flow", 0, NULL, &err));
  assert_null(gg_nearest_word(NULL, known));
  assert_null(gg_nearest_word("md", NULL));
  gg_format_estimate(1, 1, NULL, 10);
}

static const char sweep_text[] = "{flow: usf, phi: 0.1, particles: 100, vary: {phi: [0.1, 0.2]}}";

static void file(void *context, const char *path)
{
  (void)context, (void)path;
}

static void calls_of_sweeps_reject_missing_arguments(void **state)
{
  (void)state;
  gg_error err;
  gg_sweep *s = NULL, *other = NULL;
  gg_sweep_point point;
  gg_point_state found;
  gg_scene *scene = NULL;
  char *text = NULL, *path = NULL;
  assert_ok(gg_sweep_parse(sweep_text, NULL, &s, &err));
  assert_missing(gg_sweep_load(NULL, &other, &err));
  assert_missing(gg_sweep_load("x", NULL, &err));
  assert_missing(gg_sweep_parse(NULL, "x", &other, &err));
  assert_missing(gg_sweep_parse(sweep_text, "x", NULL, &err));
  assert_missing(gg_sweep_set(NULL, "phi", "1", &err));
  assert_missing(gg_sweep_set(s, NULL, "1", &err));
  assert_missing(gg_sweep_set(s, "phi", NULL, &err));
  assert_missing(gg_sweep_vary(NULL, "phi", "1", &err));
  assert_missing(gg_sweep_vary(s, NULL, "1", &err));
  assert_missing(gg_sweep_vary(s, "phi", NULL, &err));
  assert_missing(gg_sweep_check(NULL, &err));
  assert_refused(gg_sweep_at(s, 0, &point, &err), "call gg_sweep_check first");
  assert_refused(gg_sweep_to_json(s, "x", &text, &err), "call gg_sweep_check first");
  assert_ok(gg_sweep_check(s, &err));
  assert_missing(gg_sweep_at(NULL, 0, &point, &err));
  assert_missing(gg_sweep_at(s, 0, NULL, &err));
  assert_refused(gg_sweep_at(s, 2, &point, &err), "there is no point 3; the sweep has 2");
  assert_missing(gg_sweep_scene(NULL, 0, &scene, &err));
  assert_missing(gg_sweep_scene(s, 0, NULL, &err));
  assert_refused(gg_sweep_scene(s, 2, &scene, &err), "there is no point 3");
  assert_missing(gg_sweep_find(NULL, "x", 0, &found, &path, &err));
  assert_missing(gg_sweep_find(s, NULL, 0, &found, &path, &err));
  assert_missing(gg_sweep_find(s, "x", 0, NULL, &path, &err));
  assert_refused(gg_sweep_find(s, "x", 7, &found, &path, &err), "there is no point 8");
  assert_missing(gg_sweep_to_json(NULL, "x", &text, &err));
  assert_missing(gg_sweep_to_json(s, "x", NULL, &err));
  assert_missing(gg_sweep_run(NULL, "x", NULL, &err));
  assert_missing(gg_sweep_run(s, NULL, NULL, &err));
  assert_missing(gg_sweep_run_point(NULL, "x", 0, NULL, &err));
  assert_missing(gg_sweep_run_point(s, NULL, 0, NULL, &err));
  assert_refused(gg_sweep_run_point(s, "x", 2, NULL, &err), "there is no point 3");
  assert_missing(gg_sweep_collect(NULL, "x", "y", NULL, file, NULL, &err));
  assert_missing(gg_sweep_collect(s, NULL, "y", NULL, file, NULL, &err));
  assert_missing(gg_sweep_collect(s, "x", NULL, NULL, file, NULL, &err));
  assert_missing(gg_sweep_validate(NULL, "x", NULL, file, NULL, &text, &err));
  assert_missing(gg_sweep_validate(s, NULL, NULL, file, NULL, &text, &err));
  assert_missing(gg_sweep_validate(s, "x", NULL, file, NULL, NULL, &err));
  assert_refused(gg_sweep_validate(s, "x", NULL, file, NULL, &text, &err), "needs does: compare");
  assert_true(strcmp(gg_standard_grid(0), gg_standard_grid(1)) != 0);
  assert_int_equal(gg_sweep_points(NULL), 0);
  assert_null(gg_sweep_does(NULL));
  assert_null(gg_sweep_key(NULL, 0));
  assert_null(gg_sweep_key(s, 1));
  assert_null(gg_sweep_value(NULL, 0, 0));
  assert_null(gg_sweep_value(s, 2, 0));
  assert_null(gg_sweep_value(s, 0, 1));
  assert_string_equal(gg_sweep_value(s, 1, 0), "0.2");
  assert_true(!other && !scene && !text && !path);
  gg_sweep_free(s);
  gg_sweep_free(NULL);
}

/* Names that are nobody's, of theories, quantities and engines; and what there is nothing of. */
static void unknown_names(void **state)
{
  (void)state;
  gg_error err;
  gg_scene *s = scene_of(SHEAR);
  gg_comparison *c = NULL, *other = NULL;
  gg_result *r = NULL;
  gg_curve_data curve;
  gg_departure departure;
  gg_measurement m;
  gg_theory_info theory;
  gg_remark remark;
  double x;
  size_t n;
  assert_refused(gg_theories_evaluate(s, "grade", NULL, NULL, &other, &err), "there is no theory called 'grade'");
  assert_null(other);
  assert_ok(gg_theories_evaluate(s, "lun1991", NULL, NULL, &other, &err)); /* that one alone */
  assert_ok(gg_comparison_theory(other, 0, &theory, &err));
  assert_string_equal(theory.name, "lun1991");
  assert_refused(gg_comparison_theory(other, 1, &theory, &err), "");
  assert_refused(gg_comparison_write(other, "none.h5", NULL, NULL, &err), "nothing was simulated");
  gg_comparison_free(other);
  assert_ok(gg_theories_evaluate(s, NULL, NULL, NULL, &c, &err));
  assert_refused(gg_comparison_theory_value(c, "grade", "N1", &x, NULL, &err),
                 "there is no theory called 'grade' here");
  assert_refused(gg_comparison_theory_value(c, "grad", "N7", &x, NULL, &err), "there is no quantity called 'N7'");
  assert_refused(gg_comparison_theory_error(c, "grade", "N1", &x, &err), "there is no theory called 'grade' here");
  assert_refused(gg_comparison_theory_error(c, "grad", "N7", &x, &err), "there is no quantity called 'N7'");
  assert_refused(gg_comparison_theory_curve(c, "grade", 0, &curve, &err), "there is no theory called 'grade' here");
  assert_refused(gg_comparison_theory_curve(c, "grad", 99, &curve, &err), "has 0 curves here");
  assert_missing(gg_comparison_theory_error(NULL, "grad", "N1", &x, &err));
  assert_missing(gg_comparison_theory_error(c, NULL, "N1", &x, &err));
  assert_missing(gg_comparison_theory_error(c, "grad", NULL, &x, &err));
  assert_missing(gg_comparison_theory_error(c, "grad", "N1", NULL, &err));
  assert_missing(gg_comparison_theory_curve(NULL, "grad", 0, &curve, &err));
  assert_missing(gg_comparison_theory_curve(c, NULL, 0, &curve, &err));
  assert_missing(gg_comparison_theory_curve(c, "grad", 0, NULL, &err));
  assert_refused(gg_comparison_agreement(c, "N7", &x, NULL, &err), "there is no quantity called 'N7'");
  assert_refused(gg_comparison_departure(c, "mc", "N1", &departure, &err), "mc");
  assert_refused(gg_comparison_departure(c, "md", "N7", &departure, &err), "there is no quantity called 'N7'");
  assert_refused(gg_comparison_remark(c, 1000, &remark, &err), "");
  assert_null(gg_comparison_result(c, "mc"));
  assert_null(gg_comparison_result(c, "md"));
  assert_null(gg_comparison_refusal(c, "mc"));
  assert_null(gg_comparison_refusal(c, "md"));
  assert_null(gg_comparison_warning(NULL, 0));
  gg_comparison_free(c);
  assert_missing(gg_scene_warnings(NULL, "md", line, NULL, &err));
  assert_missing(gg_scene_warnings(s, NULL, line, NULL, &err));
  assert_missing(gg_scene_warnings(s, "md", NULL, NULL, &err));
  assert_refused(gg_scene_warnings(s, "both", line, NULL, &err), "allowed: md, dsmc, compare, theory");
  assert_ok(gg_scene_set(s, "run", "{collisions: 200}", &err));
  assert_ok(gg_run(s, NULL, &r, &err));
  assert_refused(gg_result_get(r, "N7", &x, NULL, &err), "there is no quantity called 'N7'");
  assert_refused(gg_result_find(r, "N7", &m, &err), "there is no quantity called 'N7'");
  assert_refused(gg_result_history(r, "N7", &n, NULL, NULL, &err), "there is no quantity called 'N7'");
  assert_refused(gg_result_curve_number(r, 0, 0, &m, &err), "");
  assert_null(gg_result_unit(r, "N7"));
  gg_result_free(r);
  assert_refused(gg_plot("same.svg", "same.svg", NULL, NULL, NULL, NULL, NULL, &err),
                 "would be both the result and its picture");
  assert_refused(gg_export("x.h5", "x", 0, NULL, NULL, NULL, NULL, &err), "0 is not a set of parts to export");
  assert_refused(gg_export("x.h5", "x", ~0u, NULL, NULL, NULL, NULL, &err), "is not a set of parts to export");
  assert_refused(gg_export("x.h5", "folder/", GG_EXPORT_ALL, NULL, NULL, NULL, NULL, &err),
                 "need a prefix to their names");
  gg_scene_free(s);
}

/* Species of a simulation, and times that cannot be advanced by. */
static void beyond_the_ends(void **state)
{
  (void)state;
  gg_error err;
  gg_scene *s = scene_of(SHEAR);
  gg_simulation *m = NULL;
  gg_species_state species;
  gg_simulation_state now;
  assert_ok(gg_simulation_new(s, NULL, &m, &err));
  assert_int_equal(gg_simulation_species(NULL), 0);
  assert_int_equal(gg_simulation_species(m), 1);
  assert_missing(gg_simulation_get_species(NULL, 0, &species, &err));
  assert_missing(gg_simulation_get_species(m, 0, NULL, &err));
  assert_refused(gg_simulation_get_species(m, 1, &species, &err), "");
  assert_refused(gg_simulation_get_species(m, -1, &species, &err), "");
  assert_ok(gg_simulation_get_species(m, 0, &species, &err));
  const double bad[] = {-1, NAN, INFINITY};
  for (int i = 0; i < 3; i++) assert_refused(gg_simulation_advance(m, bad[i], &err), "");
  assert_ok(gg_simulation_advance(m, 0, &err));
  assert_ok(gg_simulation_get_state(m, &now, &err));
  assert_true(now.time == 0);
  gg_simulation_free(m);
  gg_scene_free(s);
}

static int nothing_sent(void *context, int to, void *block, size_t size)
{
  (void)context, (void)to, (void)size;
  free(block);
  return 0;
}

static int nothing_comes(void *context, int *from, void **block, size_t *size)
{
  (void)context, (void)from, (void)block, (void)size;
  return -1;
}

/* Incomplete messages and messages of the other side are rejected before anything is sent. */
static void malformed_messages_are_rejected(void **state)
{
  (void)state;
  gg_error err;
  gg_workers *w = NULL;
  gg_messages m = {.rank = 0, .size = 2, .send = nothing_sent, .receive = nothing_comes};
  assert_refused(gg_worker_run(NULL, &err), "gg_worker_run: messages of a rank above 0");
  assert_refused(gg_worker_run(&m, &err), "gg_worker_run: messages of a rank above 0");
  assert_refused(gg_workers_new(NULL, 1, &w, &err), "gg_workers_new: messages of rank 0");
  assert_refused(gg_workers_new(&m, 1, NULL, &err), "gg_workers_new: messages of rank 0");
  m.rank = 1;
  assert_refused(gg_workers_new(&m, 1, &w, &err), "gg_workers_new: messages of rank 0");
  assert_int_equal(gg_worker_run(&m, &err), GG_FAILED); /* rank 0 is gone */
  m.receive = NULL;
  assert_refused(gg_worker_run(&m, &err), "gg_worker_run: messages of a rank above 0");
  m.rank = 0;
  assert_refused(gg_workers_new(&m, 1, &w, &err), "gg_workers_new: messages of rank 0");
  assert_null(w);
  assert_int_equal(gg_workers_threads(NULL), 0);
}

static int at_once(void *context)
{
  (void)context;
  return 1;
}

#define assert_size_matters(options, call)                                                                             \
  do {                                                                                                                 \
    (options).size = 0;                                                                                                \
    assert_refused(call, "options.size is 0");                                                                         \
    (options).size = sizeof(options) + 1;                                                                              \
    assert_refused(call, "options.size is ");                                                                          \
  } while (0)

/* Options are rejected without their size, or with that of a larger struct of a later version. */
static void options_have_their_size(void **state)
{
  (void)state;
  gg_error err;
  gg_scene *s = scene_of(SHEAR);
  gg_sweep *w = NULL;
  gg_simulation *m = NULL;
  gg_result *r = NULL;
  gg_comparison *c = NULL;
  char *verdict = NULL;
  const gg_grains grains = {0};
  gg_start_options start = {0};
  gg_run_options run = {0};
  gg_sweep_options points = {0};
  gg_collect_options tables = {0};
  gg_validate_options maps = {0};
  assert_ok(gg_sweep_parse(SHEAR, NULL, &w, &err));
  assert_size_matters(start, gg_simulation_new(s, &start, &m, &err));
  assert_size_matters(start, gg_simulation_from_grains(s, &grains, 100, &start, &m, &err));
  assert_size_matters(run, gg_run(s, &run, &r, &err));
  assert_size_matters(run, gg_compare(s, &run, &c, &err));
  assert_size_matters(points, gg_sweep_run(w, "t_points", &points, &err));
  assert_size_matters(points, gg_sweep_run_point(w, "t_points", 0, &points, &err));
  assert_size_matters(tables, gg_sweep_collect(w, "t_points", "t_tables", &tables, NULL, NULL, &err));
  assert_size_matters(maps, gg_sweep_validate(w, "t_points", &maps, NULL, NULL, &verdict, &err));
  gg_sweep_free(w);
  gg_scene_free(s);
}

/* A program of an earlier version: the library does not read beyond the size of its options. */
static void shorter_options_have_defaults(void **state)
{
  (void)state;
  gg_error err;
  gg_simulation *m = NULL;
  gg_scene *s = scene_of(SHEAR);
  gg_start_options options = {.size = offsetof(gg_start_options, stop), .stop = at_once};
  assert_ok(gg_simulation_new(s, &options, &m, &err));
  gg_simulation_free(m);
  options.size = sizeof options;
  assert_int_equal(gg_simulation_new(s, &options, &m, &err), GG_INTERRUPTED);
  gg_scene_free(s);
}

int main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test(calls_of_scenes_reject_missing_arguments),
                                     cmocka_unit_test(calls_of_simulations_reject_missing_arguments),
                                     cmocka_unit_test(calls_of_results_reject_missing_arguments),
                                     cmocka_unit_test(calls_of_comparisons_reject_missing_arguments),
                                     cmocka_unit_test(calls_of_tables_reject_missing_arguments),
                                     cmocka_unit_test(malformed_messages_are_rejected),
                                     cmocka_unit_test(calls_of_sweeps_reject_missing_arguments),
                                     cmocka_unit_test(unknown_names),
                                     cmocka_unit_test(beyond_the_ends),
                                     cmocka_unit_test(options_have_their_size),
                                     cmocka_unit_test(shorter_options_have_defaults)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
