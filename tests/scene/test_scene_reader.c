/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Scenes: what is read, what is refused and with which words, what is written back. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "graingas.h"
#include "scene/scene_reader.h"

static gg_scene parse(const char *yaml)
{
  gg_error err = {0};
  gg_scene scene = gg_scene_defaults();
  gg_status status = gg_scene_read(&scene, yaml, strlen(yaml), "s.yaml", &err);
  if (status == GG_OK) status = gg_scene_finish(&scene, &err);
  if (status != GG_OK) print_message("unexpected: %s\n", err.message);
  assert_int_equal(status, GG_OK);
  return scene;
}

/* A scene that gives every key comes out with exactly those values. */
static void reads_every_key(void **state)
{
  (void)state;
  gg_scene s = parse(
      "flow: hss\nengine: dsmc\nthermostat: white_noise\ncontact_value: kolafa\nphi: 0.25\n"
      "particles: 1e5\nshear_rate: 2.5\ntemperature: 0.125\naspect: [1, 2, 0.5]\n"
      "collision:\n  e: {11: 0.9, 12: 0.8, 22: 0.7}\n  beta: 0.5\n  mu: {11: inf, 12: 0.25, 22: .inf}\n"
      "species:\n  - {fraction: 0.25, diameter: 2, mass: 3, inertia: 0.5}\n"
      "  - {fraction: 0.75, diameter: 1, mass: 4}\n"
      "walls: {e: 0.5, beta: -1, mu: 0.1, speed: 3, temperature: [4, 0.5], accommodation: 0.25}\ngravity: [0, 0, 0]\n"
      "run: {relative_error: 0.02, collisions: 500, time_limit: 60, warmup: 10, replicas: 3, "
      "seed: 9007199254740993}\n"
      "md: {contact_time: 0.001}\ndsmc: {time_step: 0.05, particles: 777, precision: single}\nmeasure: []\n"
      "output: {checkpoint_every: 30, trajectory_every: 4}\n");
  assert_int_equal(s.flow, GG_HSS);
  assert_int_equal(s.engine, GG_DSMC);
  assert_int_equal(s.thermostat, GG_WHITE_NOISE);
  assert_int_equal(s.contact_value, GG_KOLAFA);
  assert_true(s.phi == 0.25 && s.particles == 100000 && s.shear.rate == 2.5 && s.start.temperature == 0.125);
  assert_true(s.aspect[0] == 1 && s.aspect[1] == 2 && s.aspect[2] == 0.5);
  assert_true(s.collision.e[GG_11] == 0.9 && s.collision.e[GG_12] == 0.8 && s.collision.e[GG_22] == 0.7);
  assert_true(s.collision.beta[GG_11] == 0.5 && s.collision.beta[GG_22] == 0.5);
  assert_true(s.collision.mu[GG_11] == INFINITY && s.collision.mu[GG_12] == 0.25 && s.collision.mu[GG_22] == INFINITY);
  assert_int_equal(s.n_species, 2);
  assert_true(s.species[0].diameter == 2 && s.species[0].mass == 3 && s.species[0].inertia == 0.5);
  assert_true(s.species[1].fraction == 0.75 && s.species[1].inertia == 0.4);
  assert_true(s.walls.e == 0.5 && s.walls.beta == -1 && s.walls.mu == 0.1 && s.walls.speed == 3);
  assert_true(s.walls.temperature[0] == 4 && s.walls.temperature[1] == 0.5 && s.walls.accommodation == 0.25);
  assert_true(s.run.relative_error == 0.02 && s.run.collisions == 500 && s.run.time_limit == 60);
  assert_true(s.run.warmup == 10 && s.run.replicas == 3 && s.run.seed == UINT64_C(9007199254740993));
  assert_true(s.md.contact_time == 0.001 && s.dsmc.time_step == 0.05 && s.dsmc.particles == 777);
  assert_int_equal(s.dsmc.precision, GG_SINGLE);
  assert_true(s.measure == 0 && s.output.checkpoint_every == 30 && s.output.trajectory_every == 4);
}

/* All keys but flow and phi have defaults, some of which depend on the flow. */
static void all_keys_but_flow_and_phi_have_defaults(void **state)
{
  (void)state;
  gg_scene s = parse("flow: usf\nphi: 0.3\n"), d = gg_scene_defaults();
  d.phi = 0.3;
  assert_true(gg_scene_is_given(&s, "flow") && gg_scene_is_given(&s, "phi") && !gg_scene_is_given(&s, "engine"));
  d.given = s.given;
  assert_memory_equal(&s, &d, sizeof s);
  assert_true(parse("flow: equilibrium\nphi: 0.3\n").collision.e[GG_12] == 1);
  assert_int_equal(parse("flow: hss\nphi: 0.3\n").thermostat, GG_GAUSSIAN);
  s = parse("flow: fourier\nphi: 0.3\n");
  assert_true(s.walls.temperature[0] == 1 && s.walls.temperature[1] == 0.5);
  s = parse("flow: chute\nphi: 0.3\nwalls: {temperature: 2}\n");
  assert_true(s.walls.temperature[0] == 2 && s.walls.temperature[1] == 2);
}

/* Overrides set whole keys, single pairs and members of a species; a rejected one leaves the scene unchanged. */
static void a_rejected_override_leaves_the_scene(void **state)
{
  (void)state;
  gg_error err = {0};
  gg_scene *s;
  assert_int_equal(gg_scene_parse("flow: usf\nphi: 0.3\nspecies: [{fraction: 0.5}, {fraction: 0.5}]\n", "s", &s, &err),
                   GG_OK);
  assert_int_equal(gg_scene_set(s, "collision.e", "0.8", &err), GG_OK);
  assert_int_equal(gg_scene_set(s, "collision.e.12", "0.7", &err), GG_OK);
  assert_int_equal(gg_scene_set(s, "species.2.mass", "5", &err), GG_OK);
  assert_int_equal(gg_scene_set(s, "run", "{seed: 5, warmup: 7}", &err), GG_OK);
  assert_true(s->collision.e[GG_11] == 0.8 && s->collision.e[GG_12] == 0.7 && s->species[1].mass == 5);
  assert_true(s->run.seed == 5 && s->run.warmup == 7);
  gg_scene before = *s;
  assert_int_equal(gg_scene_set(s, "collision.e", "2", &err), GG_BAD_INPUT);
  assert_non_null(strstr(err.message, "key 'collision.e': value '2' is not allowed"));
  assert_int_equal(gg_scene_set(s, "colision.e", "1", &err), GG_BAD_INPUT);
  assert_non_null(strstr(err.message, "did you mean 'collision.e'?"));
  assert_int_equal(gg_scene_set(s, "species.3.mass", "1", &err), GG_BAD_INPUT);
  assert_int_equal(gg_scene_set(s, "phi", "", &err), GG_BAD_INPUT);
  assert_int_equal(gg_scene_set(s, "flow", "hcs", &err), GG_OK);
  before.flow = GG_HCS;
  assert_memory_equal(s, &before, sizeof before);
  /* Weights are normalised in what is made of a scene, not between two changes of it. */
  assert_int_equal(gg_scene_set(s, "species.1.fraction", "0.1", &err), GG_OK);
  assert_int_equal(gg_scene_check(s, &err), GG_OK);
  assert_int_equal(gg_scene_set(s, "species.2.fraction", "0.9", &err), GG_OK);
  assert_true(s->species[0].fraction == 0.1 && s->species[1].fraction == 0.9);
  gg_scene_free(s);
}

static void assert_fractions(const char *species, const double *x)
{
  char yaml[400], *again;
  gg_error err = {0};
  snprintf(yaml, sizeof yaml, "{flow: usf, phi: 0.3, species: %s}", species);
  const gg_scene s = parse(yaml);
  for (int i = 0; i < s.n_species; i++) assert_true(fabs(s.species[i].fraction - x[i]) < 4e-16);
  assert_int_equal(gg_scene_to_yaml(&s, &again, &err), GG_OK);
  const gg_scene t = parse(again);
  for (int i = 0; i < s.n_species; i++) assert_true(s.species[i].fraction == t.species[i].fraction);
  free(again);
}

/* Fractions are weights: the normalised ones sum to 1 and read back to the last bit. */
static void fractions_are_weights(void **state)
{
  (void)state;
  const double third[] = {1 / 3., 1 / 3., 1 / 3.}, quarters[] = {0.25, 0.75}, tenth[] = {0.1, 0.9};
  assert_fractions("[{fraction: 0.333}, {fraction: 0.333}, {fraction: 0.333}]", third);
  assert_fractions("[{fraction: 0.3333333432674408}, {fraction: 0.3333333432674408}, {fraction: 0.3333333432674408}]",
                   third); /* single precision */
  assert_fractions("[{}, {}, {}]", third);
  assert_fractions("[{fraction: 1}, {fraction: 3}]", quarters);
  assert_fractions("[{fraction: 25}, {fraction: 75}]", quarters);
  assert_fractions("[{fraction: 0.1}, {fraction: 0.9}]", tenth);
  assert_true(parse("{flow: usf, phi: 0.3, species: [{fraction: 0.1}, {fraction: 0.9}]}").species[1].fraction == 0.9);
}

/* Pairs by their names, in either order; those left out take `other`. */
static void pairs_of_many_species(void **state)
{
  (void)state;
  gg_scene s = parse(
      "flow: usf\nphi: 0.3\ncollision: {e: {11: 0.9, 3-1: 0.8, 1-12: 0.6, other: 0.7}, mu: {23: 0.5, other: inf}, "
      "beta: 0}\nspecies: [{},{},{},{},{},{},{},{},{},{},{},{}]\n");
  assert_int_equal(s.n_species, 12);
  assert_true(s.species[11].fraction == 1.0 / 12 && s.species[11].mass == 1);
  assert_true(s.collision.e[GG_11] == 0.9 && s.collision.e[gg_pair(0, 2)] == 0.8 &&
              s.collision.e[gg_pair(11, 0)] == 0.6);
  assert_true(s.collision.e[GG_22] == 0.7 && s.collision.e[gg_pair(11, 11)] == 0.7);
  assert_true(s.collision.mu[gg_pair(1, 2)] == 0.5 && s.collision.mu[GG_11] == INFINITY);
  gg_error err = {0};
  assert_int_equal(gg_scene_set(&s, "collision.e.2-11", "0.5", &err), GG_OK);
  assert_int_equal(gg_scene_set(&s, "species.12.diameter", "1.5", &err), GG_OK);
  assert_true(s.collision.e[gg_pair(1, 10)] == 0.5 && s.species[11].diameter == 1.5);
  char text[200];
  assert_int_equal(gg_scene_get(&s, "collision.e.11-2", text, sizeof text, &err), GG_OK);
  assert_string_equal(text, "0.5");
  assert_int_equal(gg_scene_get(&s, "collision.e", text, sizeof text, &err), GG_OK);
  assert_string_equal(text, "{11: 0.9, 13: 0.8, 2-11: 0.5, 1-12: 0.6, other: 0.7}");
  char *yaml = gg_scene_yaml(&s);
  gg_scene again = parse(yaml);
  s.given = again.given;
  assert_memory_equal(&s, &again, sizeof s);
  free(yaml);
  gg_scene last = parse("flow: usf\nphi: 0.3\ncollision: {e: {16-16: 0.4, 1-16: 0.6, other: 0.8}}\n"
                        "species: [{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}]\n");
  assert_int_equal(gg_scene_get(&last, "collision.e", text, sizeof text, &err), GG_OK);
  assert_string_equal(text,
                      "{1-16: 0.6, 16-16: 0.4, other: 0.8}"); /* and not 134 pairs, with what the last has as other */
}

/* Written as YAML or as JSON and read again, a scene is the same to the last bit. */
static void round_trip(void **state)
{
  (void)state;
  gg_scene s = parse("flow: hss\nphi: 0.1\nthermostat: white_noise\nparticles: 123\ntemperature: 0.1\n"
                     "collision: {e: {11: 0.3, 12: 0.7, 22: 0.123456789012345678}, mu: 0.1, beta: 0}\n"
                     "species: [{fraction: 0.3, mass: 0.1}, {fraction: 0.7, inertia: 0.6666666666666666}]\n"
                     "run: {seed: 9223372036854775807, warmup: 3.3}\ndsmc: {particles: 50}\n");
  char *yaml = gg_scene_yaml(&s);
  gg_scene again = parse(yaml);
  s.given = again.given; /* by then every key is */
  assert_memory_equal(&s, &again, sizeof s);
  json_t *json = gg_scene_json(&s);
  char *text = json_dumps(json, JSON_REAL_PRECISION(17));
  again = parse(text);
  assert_memory_equal(&s, &again, sizeof s);
  json_decref(json);
  free(text);
  free(yaml);
}

/* A name means itself, whatever it means to YAML: in the scene that is written, and from the key's value set again. */
static void names_of_files(void **state)
{
  static const char *const names[] = {
      "run #1.csv", "! a.csv",    "!!int 5.csv", "#.csv",      "a: b.csv",   "a:.csv",
      "- a.csv",    "-.csv",      "--- a.csv",   "? a.csv",    "[a].csv",    "[a, b].csv",
      "{a: b}.csv", "}.csv",      "*a.csv",      "&a b.csv",   "%a.csv",     "@a.csv",
      "`a.csv",     "| a.csv",    "> a.csv",     "'a'.csv",    "\"a\".csv",  "a\\nb.csv",
      "a, b.csv",   " a.csv",     "a  b.csv",    "~.csv",      "5.csv",      "1e5.csv",
      "=a.csv",     "true.csv",   "none.csv",    "/tmp/a.csv", "../a b.csv", "gr\303\274n #2.csv",
      "... .csv",   "a.csv\\.csv"};
  (void)state;
  for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
    gg_error err = {0};
    char text[GG_FILE_NAME];
    gg_scene s = parse("flow: usf\nphi: 0.1\n"), set = s;
    snprintf(s.output.log, sizeof s.output.log, "%s", names[i]);
    char *yaml = gg_scene_yaml(&s);
    const gg_scene again = parse(yaml);
    assert_string_equal(again.output.log, names[i]);
    assert_int_equal(gg_scene_get(&s, "output.log", text, sizeof text, &err), GG_OK);
    if (gg_scene_set(&set, "output.log", text, &err) != GG_OK) fail_msg("%s: %s", text, err.message);
    assert_string_equal(set.output.log, names[i]);
    free(yaml);
  }
}

/* Any text at all, read by libyaml alone. */
static void texts_of_any_bytes(void **state)
{
  static const char *const texts[] = {"",
                                      "yes",
                                      "Off",
                                      "NULL",
                                      "y",
                                      "usf",
                                      "1:30",
                                      ".inf",
                                      "a\nb",
                                      "a\tb",
                                      "\x01\x7f",
                                      "\302\205",
                                      "\342\200\250 \342\200\251",
                                      "\357\273\277a",
                                      "\360\237\230\200"};
  (void)state;
  for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
    char *yaml = NULL;
    FILE *out = gg_base_memory_stream_open(&yaml);
    gg_scene_yaml_text_print(out, texts[i]);
    assert_true(gg_base_memory_stream_close(out, &yaml));
    yaml_parser_t parser;
    yaml_document_t document;
    yaml_parser_initialize(&parser);
    yaml_parser_set_input_string(&parser, (const unsigned char *)yaml, strlen(yaml));
    if (!yaml_parser_load(&parser, &document)) fail_msg("%s: %s", yaml, parser.problem);
    const yaml_node_t *node = yaml_document_get_root_node(&document);
    assert_string_equal(node->data.scalar.value, texts[i]);
    assert_int_equal(node->data.scalar.style == YAML_PLAIN_SCALAR_STYLE, strcmp(texts[i], "usf") == 0);
    yaml_document_delete(&document);
    yaml_parser_delete(&parser);
    free(yaml);
  }
}

/* As the pattern of YAML 1.1 has them: a point, and a sign in the exponent. */
static void numbers_of_yaml_1_1(void **state)
{
  static const struct {
    double x;
    const char *text;
  } rows[] = {{1e-07, "1.0e-07"}, {-1e-07, "-1.0e-07"}, {1.25e-09, "1.25e-09"}, {1e+22, "1.0e+22"}, {0.1, "0.1"}};
  (void)state;
  for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
    char text[GG_NUMBER_TEXT], phi[60];
    gg_error err = {0};
    gg_scene_yaml_number(rows[i].x, text);
    assert_string_equal(text, rows[i].text);
    assert_true(strtod(text, NULL) == rows[i].x);
    if (rows[i].x < 0 || rows[i].x > 0.5) continue;
    gg_scene s = parse("flow: usf\nphi: 0.1\n");
    assert_int_equal(gg_scene_set(&s, "phi", rows[i].text, &err), GG_OK);
    assert_int_equal(gg_scene_get(&s, "phi", phi, sizeof phi, &err), GG_OK);
    assert_string_equal(phi, rows[i].text);
  }
}

/* A scene with any one byte changed is read or rejected (a sanitizer shows more). */
static void a_changed_byte_is_read_or_rejected(void **state)
{
  (void)state;
  const char yaml[] = "flow: usf\nphi: 0.3\ncollision: {e: {11: 0.9, 12: 1, 22: 1}}\nspecies: [{mass: 2}]\n";
  for (size_t i = 0; i + 1 < sizeof yaml; i++)
    for (int byte = 1; byte < 256; byte += 5) {
      char changed[sizeof yaml];
      gg_scene *scene = NULL;
      gg_error err;
      memcpy(changed, yaml, sizeof yaml);
      changed[i] = (char)byte;
      gg_status status = gg_scene_parse(changed, "s", &scene, &err);
      assert_true(status == GG_OK || status == GG_BAD_INPUT);
      gg_scene_free(scene);
    }
}

/* The table itself: no key twice, defaults inside their ranges, room for all. */
static void table_is_sound(void **state)
{
  (void)state;
  int n = 0;
  for (; gg_scene_fields[n].key; n++) {
    assert_int_equal(gg_scene_field_find(gg_scene_fields[n].key), n);
    assert_non_null(gg_scene_fields[n].doc);
  }
  assert_true(n <= GG_MAX_FIELDS);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(reads_every_key),
      cmocka_unit_test(all_keys_but_flow_and_phi_have_defaults),
      cmocka_unit_test(a_rejected_override_leaves_the_scene),
      cmocka_unit_test(round_trip),
      cmocka_unit_test(a_changed_byte_is_read_or_rejected),
      cmocka_unit_test(table_is_sound),
      cmocka_unit_test(fractions_are_weights),
      cmocka_unit_test(pairs_of_many_species),
      cmocka_unit_test(names_of_files),
      cmocka_unit_test(texts_of_any_bytes),
      cmocka_unit_test(numbers_of_yaml_1_1),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
