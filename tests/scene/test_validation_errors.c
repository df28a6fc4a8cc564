/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How scenes are refused: file, line, key, value, what is allowed and what was probably meant. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/spelling.h"
#include "graingas.h"
#include "scene/scene_reader.h"

static gg_status read_and_finish(const char *yaml, gg_error *err)
{
  gg_scene scene = gg_scene_defaults();
  gg_status status = gg_scene_read(&scene, yaml, strlen(yaml), "s.yaml", err);
  return status == GG_OK ? gg_scene_finish(&scene, err) : status;
}

static void assert_taken(const char *yaml)
{
  gg_error err = {0};
  assert_int_equal(read_and_finish(yaml, &err), GG_OK);
}

static void assert_refused(const char *yaml, const char *words)
{
  gg_error err = {0};
  gg_status status = read_and_finish(yaml, &err);
  assert_int_equal(status, GG_BAD_INPUT);
  if (!strstr(err.message, words)) print_message("'%s' lacks '%s'\n", err.message, words);
  assert_non_null(strstr(err.message, words));
}

/* Each mistake is reported with file, line, key, value and allowed values. */
static void mistakes_are_named_with_line_key_and_allowed_values(void **state)
{
  (void)state;
  assert_refused("flow: usf\nphi: 0.3\ncollision:\n  e: 1.5\n",
                 "s.yaml:4: key 'collision.e': value '1.5' is not allowed; allowed: a number from 0 to 1");
#define FOLLOWED "flow: hss\nphi: 0.1\nthermostat: bath\nrun: {duration: 20}\nprotocol:\n"
  assert_taken(FOLLOWED "- {at: 5, bath.temperature: 2, bath.drag: 3}\n- {at: 5, collision.e: 0.8}\n");
  assert_refused(FOLLOWED "- {at: 5, phi: 0.2}\n",
                 "s.yaml:6: key 'protocol': 'phi' cannot change on the way; allowed: at, collision.*");
  assert_refused(FOLLOWED "- {at: 5}\n", "s.yaml:6: key 'protocol': a change needs a time and a key");
  assert_refused(FOLLOWED "- {at: 25, bath.drag: 2}\n", "at: 25 is not allowed; allowed: below run.duration, 20");
  assert_refused(FOLLOWED "- {at: 0, bath.drag: 2}\n", "s.yaml:6: key 'at': value '0' is not allowed");
  assert_refused(FOLLOWED "- {at: 5, bath.drag: -2}\n", "s.yaml:6: key 'bath.drag': value '-2' is not allowed");
  assert_refused(FOLLOWED "- {at: 5, bath.drag: [1, 2]}\n", "on the way it takes one number or word");
  assert_refused(FOLLOWED "- {at: 5, bath.drag: 2}\n- {at: 4, bath.drag: 1}\n", "in the order of times");
  assert_refused(FOLLOWED "- {at: 5, thermostat: none}\n", "key 'protocol': at: 5: flow: hss needs a thermostat");
  assert_refused(FOLLOWED "- {at: 1, at: 1.5, bath.drag: 2}\n", "s.yaml:6: key 'protocol': at is given twice");
  assert_refused(FOLLOWED "- {at: 1, bath.drag: 2, bath.drag: 3}\n", "changes bath.drag twice at: 1");
  assert_refused(FOLLOWED "- {at: 1, bath.drag: 2}\n- {at: 1, bath.drag: 3}\n", "changes bath.drag twice at: 1");
#define SHEARED(rate)                                                                                                  \
  "flow: usf\nphi: 0.1\nprotocol: [{at: 2, shear_rate: " rate "}]\nshear_rate: 2\nrun: {duration: 4}\n"
  assert_taken(SHEARED("2e3"));
  assert_taken(SHEARED("2e-3"));
  assert_refused(SHEARED("1e12"), "key 'protocol': at: 2: key 'shear_rate': 1e+12 is not allowed on the way from 2; "
                                  "allowed: from 0.002 to 2000");
  assert_refused(SHEARED("1.9e-3"), "key 'shear_rate': 0.0019 is not allowed");
#define FOUR(decade)                                                                                                   \
  "- {at: " decade "1, bath.drag: 2}\n- {at: " decade "2, bath.drag: 3}\n- {at: " decade "3, bath.drag: 2}\n"          \
  "- {at: " decade "4, bath.drag: 3}\n"
#define SIXTEEN FOUR("0.") FOUR("1.") FOUR("2.") FOUR("3.")
  assert_taken(FOLLOWED SIXTEEN);
  assert_refused(FOLLOWED SIXTEEN "- {at: 4, bath.drag: 2}\n", "s.yaml:22: key 'protocol': takes at most 16 changes");
  assert_refused("flow: hss\nphi: 0.1\nprotocol: [{at: 5, collision.e: 0.8}]\n", "protocol needs run.duration");
  assert_refused("flow: couette\nphi: 0.1\nrun: {duration: 5}\n", "run.duration does not go with flow: couette");
  assert_refused("flow: usf\nphi: 0.3\ndsmc: {precision: float}\n", "allowed: one of double, single");
  assert_refused("flow: usf\nphi: 0.7\n",
                 "s.yaml:2: key 'phi': value '0.7' is not allowed; allowed: a number from 0 to 0.6");
  assert_refused("flow: usf\nphi: -0.1\n", "s.yaml:2: key 'phi'");
  assert_refused("flow: usf\nphi: nan\n", "value 'nan'");
  assert_refused(
      "flow: usf\nphi: 1e-400\n",
      "s.yaml:2: key 'phi': value '1e-400' is not allowed (did you mean 0?); allowed: a number from 0 to 0.6");
  assert_refused("flow: usf\nphi: -0.0001e-400\n", "s.yaml:2: key 'phi': value '-0.0001e-400'");
  assert_refused("flow: usf\nphi: 0.3\ncollision: {e: 1e-400}\n", "key 'collision.e': value '1e-400'");
  assert_refused("flow: usf\nphi: 0.3\ncollision: {beta: {11: 1e-999}}\n", "key 'collision.beta': value '1e-999'");
  assert_refused("flow: usf\nphi: 0.3\ncollision: {mu: 1e999}\n", "key 'collision.mu': value '1e999'");
  assert_refused("flow: couette\nphi: 0.3\ngravity: [0, 1e-400, 0]\n", "key 'gravity': value '1e-400'");
  assert_refused("flow: usf\nphi: 0.3\nrun: {seed: 1e-400}\n", "key 'run.seed': value '1e-400'");
  assert_taken("flow: usf\nphi: 0e-400\n");
  assert_refused("flow: usf\nphi: 0x1p-2\n", "value '0x1p-2'");
  assert_refused("flow: usf\nphi: '0.3'\n", "text '0.3' is not allowed; allowed: a number");
  assert_refused("flow: usf\nphi:\n", "nothing is not allowed");
  assert_refused("flow: usf\nphi: [0.3]\n", "a list is not allowed");
  assert_refused("flow: shear\nphi: 0.3\n", "one of equilibrium, usf, hcs, hss, couette, poiseuille, chute");
  assert_refused("flow: usf\nphi: 0.3\nparticles: 10.5\n", "a whole number from 2");
  assert_refused("flow: usf\nphi: 0.3\nparticles: 1\n", "a whole number from 2");
  assert_refused("flow: usf\nphi: 0.3\nrun: {seed: 99999999999999999999}\n", "run.seed");
  assert_refused("flow: usf\nphi: 0.3\nrun: {seed: 9223372036854775808}\n", "run.seed");
  assert_refused("flow: usf\nphi: 0.3\nrun: {seed: 9223372036854775808.0}\n", "run.seed");
  assert_refused("flow: usf\nphi: 0.3\nshear_rate: 0\n", "key 'shear_rate': 0 is not allowed here; allowed: above 0");
  assert_refused("flow: usf\nphi: 0.3\nshear_rate: 5e-324\n",
                 "s.yaml:3: key 'shear_rate': value '5e-324' is not allowed (did you mean 0?); allowed: a number from "
                 "1e-30 to 1e+30, such a number below 0, 0, or a formula of t");
  assert_refused("flow: usf\nphi: 0.3\nspecies: [{mass: 1e-300}]\n", "key 'species.mass': value '1e-300'");
  assert_refused("flow: couette\nphi: 0.3\nwalls: {speed: 1e300}\n", "key 'walls.speed': value '1e300'");
  assert_refused("flow: usf\nphi: 0.3\naspect: [1, 2]\n", "a list of three numbers");
  assert_refused("flow: usf\nphi: 0.3\nmeasure: [rheologie]\n", "a list of rheology");
  assert_refused("flow: usf\nphi: 0.3\ncollision: 0.9\n", "s.yaml:3: key 'collision': is a section");
  assert_refused("flow: usf\nphi: 0.3\ncollision: {e: {11: 1, 12: 1, 22: 1, 21: 1}}\n", "or other, each pair once");
  assert_refused("flow: usf\nphi: 0.3\nspecies: [{}, {mass: 2}]\ncollision:\n  e: {11: 0.7}\n",
                 "s.yaml:5: key 'collision.e': lacks the pair 12: name every pair of the 2 species, or give `other`");
  assert_refused("flow: usf\nphi: 0.3\ncollision: {e: {1-17: 1}}\n", "keys like 11, 12 or 1-10");
  assert_refused("flow: usf\nphi: 0.3\ncollision: {mu: -1}\n", "at least 0, or inf");
}

/* A key that does not exist is answered with the one that was meant. */
static void unknown_keys(void **state)
{
  (void)state;
  assert_refused("flow: usf\nphi: 0.3\ncolision: {e: 0.9}\n",
                 "s.yaml:3: key 'colision': no such key; did you mean 'collision'?");
  assert_refused("flow: usf\nphi: 0.3\ncollision: {bet: 0}\n", "did you mean 'collision.beta'?");
  assert_refused("flow: usf\nphi: 0.3\nparticels: 10\n", "did you mean 'particles'?");
  assert_refused("flow: usf\nphi: 0.3\nseed: 7\n", "did you mean 'run.seed'?");
  assert_refused("flow: usf\nphi: 0.3\nspecies: [{masss: 1}]\n",
                 "key 'species.masss': no such key; did you mean 'mass'?");
  assert_refused("flow: usf\nphi: 0.3\nxyzzyplugh: 1\n", "no such key; `graingas info` lists every key");
}

/* Misspelled keys (short, long, swapped, of other programs, in the wrong section) get a suggestion; keys like none get
 * a list. */
static void wrong_keys_get_the_nearest_one(void **state)
{
  (void)state;
  const struct {
    const char *line, *words;
  } cases[] = {
      {"Phi: 1", "did you mean 'phi'?"},
      {"ph: 1", "did you mean 'phi'?"},
      {"N: 5", "did you mean 'particles'?"},
      {"nparticles: 5", "did you mean 'particles'?"},
      {"alpha: 0.9", "did you mean 'collision.e'?"},
      {"collision: {friction: 0.3}", "did you mean 'collision.mu'?"},
      {"collision: {r: 1}", "no such key; under collision there are e, beta, mu"},
      {"shear: 1", "did you mean 'shear_rate'?"},
      {"density: 1", "did you mean 'phi'?"},
      {"temp: 1", "did you mean 'start.temperature'?"},
      {"run: {k0: 1}",
       "under run there are relative_error, until, collisions, time_limit, duration, warmup, replicas, seed"},
      {"run: {error: 1}", "did you mean 'run.relative_error'?"},
      {"run: {time: 1}", "did you mean 'run.time_limit'?"},
      {"wall: {e: 1}", "did you mean 'walls'?"},
      {"walls: {vel: 1}", "under walls there are"},
      {"species: [{d: 1}]", "did you mean 'diameter'?"},
      {"species: [{foo: 1}]", "a species has fraction, diameter, mass and inertia"},
      {"foo: 1", "`graingas info` lists every key"},
      {"title: 1", "`graingas info` lists every key"},
      {"measure: [rheologie]", "value 'rheologie' is not allowed (did you mean rheology?); allowed:"},
      {"measure: rheology", "is a list, also of one: measure: [rheology]"},
      {"engine: MD", "(did you mean md?)"},
      {"engine: mc", "value 'mc' is not allowed; allowed: one of md, dsmc"},
      {"thermostat: gauss", "(did you mean gaussian?)"},
  };
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    char yaml[120];
    snprintf(yaml, sizeof yaml, "flow: hss\n%s\n", cases[i].line);
    assert_refused(yaml, cases[i].words);
  }
  assert_refused("flow: usf\nphi: 0,3\n", "value '0,3' is not allowed (did you mean a decimal point?)");
  assert_refused("flow: cooling\n", "(did you mean hcs?)");
  assert_refused("flow: shear\n", "(did you mean usf?)");
}

static char *repeated(const char *head, const char *one, size_t n)
{
  size_t before = strlen(head), length = strlen(one);
  char *text = malloc(before + n * length + 1);
  memcpy(text, head, before);
  for (size_t i = 0; i < n; i++) memcpy(text + before + i * length, one, length);
  text[before + n * length] = '\0';
  return text;
}

/* Input that libyaml would parse for minutes is rejected first: a megabyte of brackets takes half an hour. */
static void input_that_takes_minutes_is_rejected_at_once(void **state)
{
  (void)state;
  const struct {
    const char *head, *one;
    size_t n;
    const char *words;
  } cases[] = {
      {"measure: ", "[", 1000000, "s.yaml:1: is not a scene: lists and maps stand more than 16 deep in each other"},
      {"measure: ", "{a: ", 260000, "16 deep"},
      {"measure: ", "[[]", 300000, "16 deep"},
      {"measure:\n ", "- ", 500000, "s.yaml:2: is not a scene: lists"},
      {"measure:\n ", "? ", 500000, "16 deep"},
      {"measure: [", "&a x,", 200000, "more than 20000 words and marks"},
      {"measure: [", "rheology,", 100000, "more than 20000 words and marks"},
      {"", "%TAG !a! b\n", 90000, "s.yaml:20000: is not a scene"},
      {"", "---\n", 250000, "more than 20000"},
      {"", "\n", 1100000, "s.yaml: is not a scene: larger than 1 MiB"},
      {"flow: ", "x", 1000000, "value 'xxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxx' is not allowed"},
  };
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    char *yaml = repeated(cases[i].head, cases[i].one, cases[i].n);
    assert_refused(yaml, cases[i].words);
    free(yaml);
  }
  gg_scene *s;
  gg_error err;
  char *value = repeated("", "[", 100000);
  assert_int_equal(gg_scene_parse("{flow: usf, phi: 0.3}", "s", &s, &err), GG_OK);
  assert_int_equal(gg_scene_set(s, "measure", value, &err), GG_BAD_INPUT);
  assert_string_equal(err.message,
                      "key 'measure': is not a scene: lists and maps stand more than 16 deep in each other");
  gg_scene_free(s);
  free(value);
}

/* Control characters of a scene do not reach the terminal, and text is not cut within a character. */
static void control_characters_are_quoted(void **state)
{
  (void)state;
  assert_refused("flow: \"a\\e[31mb\\nc\"\n", "text 'a?[31mb?c' is not allowed");
  assert_refused("flow: xxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxx\u00e9\n",
                 "value 'xxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxx' is");
  assert_refused("flow: xxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxx\u00e9\n",
                 "value 'xxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxx\u00e9' is");
  assert_refused("\"a\\tb\": 1\n", "key 'a?b': no such key");
  assert_refused("flow: \"a\\u202eb\\u0085c\"\n", "text 'a?b?c' is not allowed");
  assert_refused("flow:\n\tusf\n", "s.yaml:2: is not YAML: a tab cannot indent; use blanks");
}

static void keys_given_twice_are_rejected(void **state)
{
  (void)state;
  assert_refused("flow: usf\nphi: 0.3\nphi: 0.2\n", "s.yaml:3: key 'phi': is given twice, first on line 2");
  assert_refused("flow: usf\nphi: 0.3\nrun: {seed: 1}\nrun: {seed: 2}\n", "key 'run.seed': is given twice");
  assert_refused("flow: usf\nphi: 0.3\nspecies: [{mass: 1, mass: 2}]\n", "given twice");
}

/* Conditions on several keys. */
static void contradicting_keys_are_rejected(void **state)
{
  (void)state;
  assert_refused("phi: 0.3\n", "flow is missing");
  assert_refused("flow: usf\n", "phi is missing");
  assert_refused("flow: usf\nphi: 0.56\ncontact_value: kolafa\n", "the formula holds up to phi = 0.55");
  assert_refused("flow: usf\nphi: 0.3\nspecies: [{fraction: 0}, {fraction: 1}]\n",
                 "allowed: a number above 0, at most 1e+30 (leave out a species without grains)");
  assert_refused("flow: usf\nphi: 0.3\nspecies: [{fraction: -1}, {fraction: 1}]\n", "leave out a species");
  assert_refused("flow: usf\nphi: 0.3\nspecies: [{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}]\n",
                 "17 species are given; allowed: 1 to 16");
  assert_refused("flow: usf\nphi: 0.3\nspecies: []\n", "0 species");
  assert_refused("flow: equilibrium\nphi: 0.3\ncollision: {e: 0.9}\n", "lose no energy");
  assert_refused("flow: equilibrium\nphi: 0.3\ncollision: {beta: 0}\n", "lose no energy");
  assert_refused("flow: hss\nphi: 0.3\nthermostat: none\n", "hss needs a thermostat");
  assert_refused("flow: hss\nphi: 0.3\nthermostat: injection\n", "injection needs collision.normal_kick, ");
  assert_refused(
      "flow: hcs\nphi: 0.3\ncollision: {normal_kick: 1}\n",
      "collision.normal_kick or tangential_kick: flow: hcs takes no energy from kicks and torques; use flow: hss");
  assert_refused("flow: equilibrium\nphi: 0.3\ncollision: {tangential_kick: -1}\n", "needs collisions that lose no");
  assert_refused("flow: hss\nphi: 0.3\ncollision: {normal_kick: -1}\n", "allowed: a number from 0 to 1e+30");
  assert_refused("flow: small_shear\nphi: 0.3\ncollision: {beta: 0}\nspecies: [{torque: 1}]\n",
                 "species.torque: flow: small_shear takes no energy");
  assert_refused("flow: hss\nphi: 0.3\nthermostat: gaussian\ncollision: {beta: 0}\nspecies: [{torque: 1}]\n",
                 "give gaussian_rate a value, or use thermostat: bath");
  assert_refused("flow: hcs\nphi: 0.3\nthermostat: gaussian\n", "gaussian does not go with flow: hcs; use flow: ");
  assert_refused("flow: usf\nphi: 0.3\nthermostat: gaussian\n",
                 "gaussian does not go with flow: usf; use flow: hss or small_shear");
  assert_refused("flow: usf\nphi: 0.3\nsmall_shear: on\n",
                 "s.yaml:3: key 'small_shear': is a flow of its own: write flow: small_shear instead of flow: usf");
  assert_refused("flow: usf\nphi: 0.3\ngravity: [0, -1, 0]\n", "gravity needs a flow with walls");
  assert_refused("flow: couette\nphi: 0.3\nstart: {temperature: 1}\n",
                 "key 'start.temperature': flow: couette has a start of its own; allowed in flow: equilibrium, usf, ");
  assert_refused("flow: small_shear\nphi: 0.3\nstart: {a2: 0.1}\n", "key 'start.a2': flow: small_shear has");
  assert_refused("flow: usf\nphi: 0.3\ntemperature: 2\nstart: {temperature: 1}\n", "is given twice, first on line 3");
  const char thermal[] = "flow: fourier needs walls.temperature, e.g. [1, 0.5], and walls.accommodation above 0";
  assert_refused("flow: fourier\nphi: 0.3\nwalls: {temperature: none}\n", thermal);
  assert_refused("flow: fourier\nphi: 0.3\nwalls: {accommodation: 0}\n", thermal);
  const char ends[] = "allowed: a number or [lower, upper], each from 1e-30 to 1e+30, or none";
  assert_refused("flow: fourier\nphi: 0.3\nwalls: {temperature: 0}\n", ends);
  assert_refused("flow: fourier\nphi: 0.3\nwalls: {temperature: [1, 2, 3]}\n", ends);
  assert_refused("flow: fourier\nphi: 0.3\nwalls: {temperature: [1, none]}\n", "value 'none'");
  assert_refused("flow: chute\nphi: 0.3\ngravity: [0, 0, 0]\n", "chute needs gravity, e.g. gravity: [0.1, -0.1, 0]");
  assert_refused("flow: usf\nphi: 0.3\ncollision: {mu: 0.5}\n",
                 "key 'collision.mu': has no effect without collision.beta, whose default -1 is smooth grains");
  assert_refused("flow: usf\nphi: 0.3\nspecies: [{}, {}]\ncollision: {mu: {11: inf, 12: 0.5, 22: 0}}\n",
                 "e.g. collision: {beta: 0, mu: 0.5}");
  assert_taken("flow: usf\nphi: 0.3\ncollision: {mu: 0}\n");
  assert_taken("flow: usf\nphi: 0.3\ncollision: {mu: inf}\n");
  assert_taken("flow: usf\nphi: 0.3\ncollision: {mu: 0.5, beta: -1}\n");
}

/* Text that is not a scene. */
static void text_that_is_no_scene_is_rejected(void **state)
{
  (void)state;
  assert_refused("", "is empty");
  assert_refused("# nothing\n", "is empty");
  assert_refused("\x01\x02\x03", "is not a scene");
  assert_refused("\x80\x81 rubbish", "s.yaml: is not a scene");
  assert_refused("flow: [usf\n", "s.yaml:2: is not YAML");
  assert_refused("flow: usf\nphi 0.1\nparticles: 100\n", "s.yaml:2: is not YAML: could not find expected ':'");
  assert_refused("flow: usf\nphi: \"0.1\nparticles: 100\n", "s.yaml:2: is not YAML: found unexpected end");
  assert_refused("flow: usf\nphi: 0.1\ncollision:\n  e: 0.9\n\tbeta: 0\n", "s.yaml:5: is not YAML: a tab");
  assert_refused("- flow\n- usf\n", "lines of 'key: value'");
  assert_refused("flow: usf\nphi: 0.3\n---\nflow: hcs\n", "more than one document");
  assert_refused("? [a, b]\n: 1\n", "a key must be a word");
  assert_refused("&a flow: *a\n", "flow");
}

static void edit_distance(void **state)
{
  (void)state;
  assert_int_equal(gg_base_spelling_distance("", "abc"), 3);
  assert_int_equal(gg_base_spelling_distance("kitten", "sitting"), 3);
  assert_int_equal(gg_base_spelling_distance("flaw", "lawn"), 2);
  assert_int_equal(gg_base_spelling_distance("output", "outptu"), 1);
  assert_int_equal(gg_base_spelling_distance("Phi", "phi"), 0);
  assert_int_equal(gg_base_spelling_distance("ca", "abc"), 3);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(mistakes_are_named_with_line_key_and_allowed_values),
      cmocka_unit_test(unknown_keys),
      cmocka_unit_test(wrong_keys_get_the_nearest_one),
      cmocka_unit_test(input_that_takes_minutes_is_rejected_at_once),
      cmocka_unit_test(control_characters_are_quoted),
      cmocka_unit_test(keys_given_twice_are_rejected),
      cmocka_unit_test(contradicting_keys_are_rejected),
      cmocka_unit_test(text_that_is_no_scene_is_rejected),
      cmocka_unit_test(edit_distance),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
