/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A program with decimal commas gets what one with decimal points gets: every text and number that the library makes is
 * the same in both. The locale need not be installed: localedef makes it here, of one byte (de_DE) or of two (ps_AF).
 */
#include <inttypes.h>
#include <locale.h>
#include <sys/wait.h>

#include "api_test.h"

#define CHANGES                                                                                                        \
  "protocol: [{at: 1.5, collision.e: 0.85}, {at: 2.5, shear_rate: 1.5}], phi: 0.125, collision: {e: 0.75}, "           \
  "measure: [rheology, diffusion], "

static FILE *out; /* all of them */

static void put_line(void *context, const char *text)
{
  (void)context;
  if (!strstr(text, "one processor") && !strstr(text, "memory")) fprintf(out, "%s\n", text); /* of this machine */
}

static void put_text(char *text)
{
  fprintf(out, "%s\n", text);
  free(text);
}

/* By their bits, which no locale writes otherwise. */
static void put_numbers(const char *name, double x, double y, double z)
{
  const double all[] = {x, y, z};
  uint64_t bits[3];
  memcpy(bits, all, sizeof bits);
  fprintf(out, "%s %" PRIx64 " %" PRIx64 " %" PRIx64 "\n", name, bits[0], bits[1], bits[2]);
}

static void put_file(const char *path)
{
  char piece[4096];
  FILE *in = fopen(path, "r");
  if (!in) fail_msg("%s is missing", path);
  for (size_t n; (n = fread(piece, 1, sizeof piece, in)) > 0;) fwrite(piece, 1, n, out);
  fclose(in);
}

static void put_refusal(gg_status status, const gg_error *err)
{
  assert_int_not_equal(status, GG_OK);
  fprintf(out, "%s\n", err->message);
}

static void texts_of_scenes(void)
{
  gg_error err;
  char *text, value[400];
  gg_scene *s = scene_of("{flow: usf, engine: md, particles: 200, " CHANGES "run: {duration: 4.5, seed: 7}}");
  assert_ok(gg_scene_set(s, "collision.e", "0.7", &err));
  assert_ok(gg_scene_to_yaml(s, &text, &err));
  put_text(text);
  assert_ok(gg_scene_to_json(s, &text, &err));
  put_text(text);
  assert_ok(gg_scene_get(s, "protocol", value, sizeof value, &err));
  fprintf(out, "%s\n", value);
  assert_ok(gg_scene_title(s, value, sizeof value, &err));
  fprintf(out, "%s\n", value);
  assert_ok(gg_scene_describe(s, "md", put_line, NULL, &err));
  assert_ok(gg_scene_warnings(s, "md", put_line, NULL, &err));
  put_refusal(gg_scene_set(s, "phi", "0,25", &err), &err);
  put_refusal(gg_scene_set(s, "phi", "0.95", &err), &err);
  put_refusal(gg_scene_set(s, "protocol", "[{at: 2.5, shear_rate: 0.25}, {at: 0.5, shear_rate: 2}]", &err), &err);
  gg_scene_free(s);
  assert_ok(gg_schema_to_json(&text, &err));
  put_text(text);
  assert_ok(gg_scene_begin("usf", &text, &err));
  put_text(text);
  gg_entry entry;
  for (size_t i = 0; gg_catalogue_entry(GG_CATALOGUE_KEYS, i, NULL, &entry, &err) == GG_OK; i++)
    fprintf(out, "%s %s %s\n", entry.name, entry.allowed, entry.value);
}

static void texts_of_runs(void)
{
  gg_error err;
  double mean, error;
  char text[80];
  gg_result *r = NULL;
  gg_trajectory *t = NULL;
  gg_simulation_state state;
  gg_scene *s = scene_of("{flow: usf, engine: md, particles: 100, " CHANGES "run: {duration: 3, replicas: 2}, output: "
                         "{trajectory_every: 50.5, log: t_log.csv}}");
  unlink("t_log.csv");
  assert_ok(gg_run(s, &(gg_run_options){.size = sizeof(gg_run_options), .threads = 2, .output = "t_run.h5"}, &r,
                   &err)); /* threads of its own */
  gg_result_free(r);
  assert_ok(gg_result_read("t_run.h5", &r, &err));
  gg_measurement m;
  for (size_t i = 0; gg_result_at(r, i, &m, &err) == GG_OK; i++) put_numbers(m.name, m.mean, m.error, 0);
  for (size_t i = 0; gg_result_warning(r, i); i++) fprintf(out, "%s\n", gg_result_warning(r, i));
  assert_ok(gg_result_get(r, "temperature", &mean, &error, &err));
  gg_format_estimate(mean, error, text, sizeof text), fprintf(out, "%s\n", text);
  put_file("t_log.csv");
  assert_ok(gg_export("t_run.h5", "t_table", GG_EXPORT_ALL, put_line, NULL, NULL, NULL, &err));
  put_file("t_table.csv"), put_file("t_table.xyz");
  assert_ok(gg_trajectory_open("t_run.h5", &t, &err));
  for (size_t k = 0; k < gg_trajectory_frames(t); k++) {
    assert_ok(gg_trajectory_frame(t, k, &state, NULL, &err));
    put_numbers("frame", state.time, state.strain, state.temperature);
  }
  gg_trajectory_free(t);
  gg_result_free(r);
  gg_scene_free(s);
}

static void texts_of_simulations(void)
{
  gg_error err;
  gg_simulation *sim = NULL;
  gg_simulation_state state;
  gg_scene *s = scene_of("{flow: usf, engine: dsmc, dsmc: {particles: 400}, " CHANGES "run: {duration: 4.5}}");
  put_refusal(gg_simulation_advance(sim, 1, &err), &err);
  assert_ok(gg_simulation_new(s, NULL, &sim, &err));
  assert_ok(gg_simulation_advance(sim, 3.25, &err));
  assert_ok(gg_simulation_set(sim, "collision.e", "0.65", &err));
  put_refusal(gg_simulation_set(sim, "collision.e", "1.5", &err), &err);
  put_refusal(gg_simulation_advance(sim, -0.5, &err), &err);
  assert_ok(gg_simulation_advance(sim, 1.25, &err));
  assert_ok(gg_simulation_get_state(sim, &state, &err));
  put_numbers("state", state.time, state.strain, state.temperature);
  gg_simulation_free(sim);
  gg_scene_free(s);
}

static void texts_of_sweeps(void)
{
  gg_error err;
  char *text;
  gg_sweep *sweep = NULL;
  assert_ok(gg_sweep_parse(
      "{flow: usf, phi: 0.125, collision: {e: 0.75}, theories: {mine: {temperature: "
      "'0.5*(1-e^2)^(-1.5)'}}, vary: {collision.e: 0.55:0.85:0.15, phi: [0.05, 0.1]}, sweep: {does: theory}}",
      "test", &sweep, &err));
  assert_ok(gg_sweep_check(sweep, &err));
  assert_ok(gg_sweep_to_json(sweep, "t_sweep", &text, &err));
  put_text(text);
  for (size_t i = 0; i < gg_sweep_points(sweep); i++)
    for (size_t k = 0; gg_sweep_key(sweep, k); k++) fprintf(out, "%s\n", gg_sweep_value(sweep, i, k));
  gg_sweep_free(sweep);
}

static char *all_texts(void)
{
  char *text = NULL;
  size_t size;
  char *before = strdup(setlocale(LC_ALL, NULL));
  out = open_memstream(&text, &size);
  texts_of_scenes(), texts_of_runs(), texts_of_simulations(), texts_of_sweeps();
  assert_string_equal(before, setlocale(LC_ALL, NULL));
  fclose(out);
  free(before);
  return text;
}

/* False: this system can make no such locale, as where its sources are not installed. */
static int enter(const char *source)
{
  char command[200], half[8];
  snprintf(command, sizeof command, "localedef -i %s -f UTF-8 ./t_%s >/dev/null 2>&1", source, source);
  const int status = system(command);
  snprintf(command, sizeof command, "t_%s", source);
  if (status == -1 || !WIFEXITED(status) || setenv("LOCPATH", ".", 1) != 0 || !setlocale(LC_ALL, command)) return 0;
  snprintf(half, sizeof half, "%.1f", 0.5);
  return strcmp(half, "0.5") != 0;
}

static void no_comma_in(const char *source, const char *expected)
{
  if (!enter(source)) {
    print_message("%s cannot be made here (localedef, package locales)\n", source);
    skip();
  }
  char *text = all_texts();
  setlocale(LC_ALL, "C");
  size_t same = 0;
  while (text[same] && text[same] == expected[same]) same++;
  if (text[same] != expected[same])
    fail_msg("%s:\n%.200s\nwithout it:\n%.200s", source, text + (same < 80 ? 0 : same - 80),
             expected + (same < 80 ? 0 : same - 80));
  free(text);
}

static char *expected;

static int write_expected(void **state)
{
  if (enter_folder(state) != 0) return -1;
  expected = all_texts();
  return 0;
}

static int leave(void **state)
{
  free(expected);
  return leave_folder(state);
}

static void numbers_have_a_point_where_the_locale_has_a_comma(void **state)
{
  (void)state;
  no_comma_in("de_DE", expected);
}

static void point_of_two_bytes(void **state)
{
  (void)state;
  no_comma_in("ps_AF", expected);
}

int main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test(numbers_have_a_point_where_the_locale_has_a_comma),
                                     cmocka_unit_test(point_of_two_bytes)};
  return cmocka_run_group_tests(tests, write_expected, leave);
}
