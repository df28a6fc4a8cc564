/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Keys of a scene that have no effect are reported, with the reason. Keys with an effect, with their default value or
 * not in the scene are not. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "scene/scene_reader.h"

enum { BOTH = GG_USE_MD | GG_USE_DSMC | GG_USE_THEORY };

static gg_string_list inert(const char *yaml, unsigned uses)
{
  gg_error err = {0};
  gg_string_list lines = {0};
  gg_scene scene = gg_scene_defaults();
  gg_status status = gg_scene_read(&scene, yaml, strlen(yaml), "s", &err);
  if (status == GG_OK) status = gg_scene_finish(&scene, &err);
  if (status != GG_OK) print_message("%s: %s\n", yaml, err.message);
  assert_int_equal(status, GG_OK);
  gg_scene_ineffective_keys(&scene, uses, &lines);
  return lines;
}

/* NULL: none at all. */
static void assert_line(const char *yaml, unsigned uses, const char *expected)
{
  gg_string_list lines = inert(yaml, uses);
  if (lines.n != (expected ? 1 : 0)) print_message("%s: %zu lines, %s\n", yaml, lines.n, lines.n ? lines.text[0] : "");
  assert_int_equal(lines.n, expected ? 1 : 0);
  if (expected) assert_string_equal(lines.text[0], expected);
  gg_base_string_list_clear(&lines);
}

/* Not a key without effect, but a line of the same list: fractions that may have lost a species. */
static void forgotten_fractions(void **state)
{
  (void)state;
  assert_line("{flow: usf, phi: 0.1, species: [{fraction: 0.3}, {fraction: 0.5}]}", BOTH,
              "species: the fractions sum to 0.8 and count as weights: the mole fractions are 0.375, 0.625");
  assert_line("{flow: usf, phi: 0.1, species: [{fraction: 0.333}, {fraction: 0.333}, {fraction: 0.333}]}", BOTH, NULL);
  assert_line("{flow: usf, phi: 0.1, species: [{fraction: 1}, {fraction: 0.5}]}", BOTH, NULL);
}

static void keys_of_other_flows_have_no_effect(void **state)
{
  (void)state;
  char words[160], expected[240];
  gg_common_flow_list(gg_flow_is_sheared, words, sizeof words);
  snprintf(expected, sizeof expected, "shear_rate has no effect but in flow: %s", words);
  assert_line("{flow: hcs, phi: 0.1, shear_rate: 2}", BOTH, expected);
  assert_line("{flow: hss, phi: 0.1, start: {temperature: 3}}", BOTH, NULL);
  assert_line("{flow: hcs, phi: 0.1, rotational_temperature: 3}", BOTH,
              "start.rotational_temperature has no effect on smooth grains, which do not spin");
  assert_line("{flow: hss, phi: 0.1, gaussian_rate: 2, temperature: 3}", BOTH, NULL);
  assert_line("{flow: hss, phi: 0.1, thermostat: bath, bath: {drag: 2}, temperature: 3}", BOTH, NULL);
  assert_line("{flow: hss, phi: 0.1, bath: {drag: 2}}", BOTH, "bath.drag has no effect but with thermostat: bath");
  assert_line("{flow: small_shear, phi: 0.1, thermostat: gaussian, gaussian_rate: 2}", BOTH,
              "gaussian_rate has no effect but in flow: hss");
  assert_line("{flow: usf, phi: 0.1, shear_rate: 2, temperature: 3}", BOTH, NULL);
  assert_line("{flow: hcs, phi: 0.1, walls: {e: 0.5, beta: 0.5, mu: 1, speed: 2, top: open}}", BOTH,
              "walls.e, walls.beta, walls.mu, walls.top, walls.speed have no effect but between walls (flow: couette, "
              "poiseuille, chute or fourier)");
  assert_line("{flow: couette, phi: 0.1, walls: {e: 0.5, beta: 0.5, mu: 1, speed: 2}}", BOTH, NULL);
  assert_line("{flow: chute, phi: 0.1, gravity: [1, -1, 0], walls: {speed: 2, top: open}}", GG_USE_MD,
              "walls.speed has no effect but in flow: couette");
  assert_line("{flow: couette, phi: 0.1, walls: {top: open}}", GG_USE_MD, "walls.top has no effect but in flow: chute");
  assert_line("{flow: couette, phi: 0.1, walls: {temperature: 2, accommodation: 0.5, e: 0.5}}", GG_USE_MD, NULL);
  assert_line("{flow: couette, phi: 0.1, walls: {accommodation: 0.5}}", GG_USE_MD,
              "walls.accommodation has no effect while walls.temperature is none");
  assert_line("{flow: couette, phi: 0.1, walls: {temperature: 2, accommodation: 0}}", GG_USE_MD,
              "walls.temperature has no effect while walls.accommodation is 0");
  assert_line("{flow: chute, phi: 0.1, gravity: [1, -1, 0], walls: {temperature: [1, 2], top: open}}", GG_USE_MD,
              "walls.temperature of the upper wall has no effect under an open top");
  assert_line("{flow: chute, phi: 0.1, gravity: [1, -1, 0], walls: {temperature: 2, top: open}}", GG_USE_MD, NULL);
  assert_line("{flow: fourier, phi: 0.1, walls: {e: 0.5, mu: 1}}", GG_USE_MD,
              "walls.e, walls.mu have no effect while every contact with a wall is by its temperature: "
              "walls.accommodation is 1");
  assert_line("{flow: fourier, phi: 0.1, collision: {e: 1}, md: {contact_time: 1e-3}}", GG_USE_MD,
              "md.contact_time has no effect where no collision loses energy");
  assert_line("{flow: couette, phi: 0.1, walls: {beta: -1, mu: 0.5}}", GG_USE_MD,
              "walls.mu has no effect while walls.beta is -1: smooth walls");
  assert_line("{flow: couette, phi: 0.1, walls: {beta: 0.5, mu: 0}}", GG_USE_MD,
              "walls.beta has no effect while walls.mu is 0: smooth walls");
}

static void keys_of_the_other_engine_have_no_effect(void **state)
{
  (void)state;
  const char keys[] = "{flow: usf, phi: 0.1, dsmc: {time_step: 0.1, particles: 300, precision: single}, "
                      "md: {contact_time: 0.01}}";
  assert_line(keys, GG_USE_MD, "dsmc.time_step, dsmc.particles, dsmc.precision have no effect with engine: md");
  assert_line(keys, GG_USE_DSMC, "md.contact_time has no effect with engine: dsmc");
  assert_line(keys, BOTH, NULL);
  assert_line(keys, GG_USE_THEORY, NULL);
  assert_line("{flow: usf, phi: 0, md: {contact_time: 0.01}}", BOTH, "md.contact_time has no effect with engine: dsmc");
  assert_line("{flow: couette, phi: 0.1, dsmc: {particles: 10}}", BOTH, NULL);
  assert_line("{flow: couette, phi: 0.1, particles: 2000, aspect: [1, 2, 1]}", GG_USE_DSMC, NULL);
  assert_line("{flow: usf, phi: 0.1, aspect: [1, 2, 1]}", GG_USE_DSMC,
              "aspect has no effect with engine: dsmc, which has no box");
  assert_line("{flow: usf, phi: 0.1, output: {trajectory_every: 5}}", BOTH,
              "output.trajectory_every has no effect in a comparison; graingas run keeps trajectories and logs");
  assert_line("{flow: usf, phi: 0.1, output: {trajectory_every: 5}}", GG_USE_MD, NULL);
  const char ensemble[] =
      "particles has no effect with engine: dsmc, whose ensemble has dsmc.particles (auto: at least 5000)";
  assert_line("{flow: usf, phi: 0.1, particles: 2000}", GG_USE_DSMC, ensemble);
  assert_line("{flow: usf, phi: 0.1, particles: 20000}", GG_USE_DSMC, NULL);
  assert_line("{flow: usf, phi: 0.1, particles: 20000, dsmc: {particles: 700}}", GG_USE_DSMC, ensemble);
  assert_line("{flow: usf, phi: 0.1, particles: 2000}", BOTH, NULL);
  const char contact[] =
      "contact_value has no effect but on theories, engine: dsmc and the strength of white noise, with one species and "
      "phi above 0";
  assert_line("{flow: usf, phi: 0.1, contact_value: kolafa}", GG_USE_MD, contact);
  assert_line("{flow: usf, phi: 0, contact_value: kolafa}", GG_USE_DSMC, contact);
  assert_line("{flow: usf, phi: 0.1, contact_value: kolafa, species: [{}, {}]}", BOTH, contact);
  assert_line("{flow: usf, phi: 0.1, contact_value: kolafa}", BOTH, NULL);
  assert_line("{flow: hss, phi: 0.1, contact_value: kolafa}", GG_USE_MD, contact);
  assert_line("{flow: hss, thermostat: white_noise, phi: 0.1, contact_value: kolafa}", GG_USE_MD, NULL);
  assert_line("{flow: heated_shear, temperature: 9, phi: 0.1, contact_value: kolafa}", GG_USE_MD, NULL);
}

static void keys_of_other_grains_have_no_effect(void **state)
{
  (void)state;
  assert_line("{flow: usf, phi: 0.1, collision: {mu: 0.5, beta: -1}}", BOTH,
              "collision.mu has no effect while collision.beta is -1: smooth grains");
  assert_line("{flow: usf, phi: 0.1, collision: {mu: 0, beta: 0.5}}", BOTH,
              "collision.beta has no effect while collision.mu is 0: smooth grains");
  assert_line("{flow: usf, phi: 0.1, collision: {mu: 0.5, beta: 0.5}}", BOTH, NULL);
  assert_line("{flow: usf, phi: 0.1, collision: {e: {11: 0.9, 12: 0.8, 22: 0.7}}}", BOTH,
              "collision.e.12, collision.e.22 have no effect with one species");
  assert_line("{flow: usf, phi: 0.1, collision: {e: {11: 0.9, 12: 0.8, 22: 0.7}}, species: [{}, {}]}", BOTH, NULL);
  assert_line("{flow: usf, phi: 0.1, species: [{inertia: 0.5}]}", BOTH,
              "species.1.inertia has no effect on smooth grains, which do not spin");
  assert_line("{flow: usf, phi: 0.1, species: [{inertia: 0.5}], collision: {beta: 0}}", BOTH, NULL);
  assert_line("{flow: equilibrium, phi: 0.1, md: {contact_time: 0.01}}", BOTH,
              "md.contact_time has no effect where no collision loses energy");
}

/* A quantity without a mean rejects a requested error. */
static void asked_errors(void **state)
{
  (void)state;
  static const char none[] =
      "run.relative_error has no effect but on the ensemble's size, in a gas without such means: "
      "elastic and sheared, elastic and alone, or cooling by a law";
  assert_line("{flow: usf, phi: 0.1, collision: {e: 1}, run: {relative_error: 0.1}}", BOTH, none);
  assert_line("{flow: hcs, phi: 0.1, collision: {e: 1}, run: {relative_error: 0.1}}", BOTH, none);
  assert_line("{flow: hcs, phi: 0.1, collision: {law: viscoelastic}, run: {relative_error: 0.1}}", BOTH, none);
  static const char *const some[] = {
      "{flow: hcs, phi: 0.1, collision: {e: 1, beta: 1}, run: {relative_error: 0.1}}",
      "{flow: hcs, phi: 0.1, collision: {e: 0.9}, run: {relative_error: 0.1}}",
      "{flow: usf, phi: 0.1, collision: {law: viscoelastic}, run: {relative_error: 0.1}}",
      "{flow: equilibrium, phi: 0.1, run: {relative_error: 0.1}}",
      "{flow: small_shear, phi: 0.1, collision: {e: 1}, run: {relative_error: 0.1}}",
  };
  for (size_t i = 0; i < sizeof some / sizeof *some; i++) assert_line(some[i], GG_USE_DSMC, NULL);
}

/* A scene from a result or checkpoint has every key, but gets the same warnings as the user's scene. */
static void defaults_are_not_reported(void **state)
{
  (void)state;
  const char *scenes[] = {"{flow: hcs, phi: 0.1}", "{flow: equilibrium, phi: 0.1}", "{flow: hss, phi: 0}",
                          "{flow: couette, phi: 0.2}", "{flow: hcs, phi: 0.1, shear_rate: 2}"};
  for (size_t i = 0; i < sizeof scenes / sizeof *scenes; i++) {
    gg_error err;
    gg_scene s = gg_scene_defaults();
    assert_int_equal(gg_scene_read(&s, scenes[i], strlen(scenes[i]), "s", &err), GG_OK);
    assert_int_equal(gg_scene_finish(&s, &err), GG_OK);
    char *yaml = gg_scene_yaml(&s);
    gg_string_list once = inert(scenes[i], BOTH), again = inert(yaml, BOTH);
    assert_int_equal(once.n, i == 4);
    assert_int_equal(again.n, once.n);
    gg_base_string_list_clear(&once);
    gg_base_string_list_clear(&again);
    free(yaml);
  }
}

/* A change of a key without effect until the next change is named; a key that gains its effect by a change is not. */
static void changes_without_effect_until_the_next_are_named(void **state)
{
  (void)state;
#define FOLLOWED "flow: hss, phi: 0.1, thermostat: bath, run: {duration: 20}, protocol: "
  assert_line("{" FOLLOWED "[{at: 5, noise_strength: 2}]}", BOTH,
              "noise_strength (protocol, at: 5) has no effect but with thermostat: white_noise");
  assert_line("{" FOLLOWED "[{at: 5, gaussian_rate: 2}]}", BOTH,
              "gaussian_rate (protocol, at: 5) has no effect but with thermostat: gaussian");
  assert_line("{" FOLLOWED "[{at: 5, collision.mu: 0.3}]}", BOTH,
              "collision.mu (protocol, at: 5) has no effect while collision.beta is -1: smooth grains");
  assert_line("{" FOLLOWED "[{at: 5, collision.speed: 2}]}", BOTH,
              "collision.speed (protocol, at: 5) has no effect while collision.law is constant");
  assert_line("{" FOLLOWED "[{at: 5, collision.speed: 2}, {at: 6, collision.law: viscoelastic}]}", BOTH, NULL);
  assert_line("{" FOLLOWED "[{at: 5, collision.speed: 2}, {at: 6, collision.law: viscoelastic, collision.speed: 3}]}",
              BOTH, "collision.speed (protocol, at: 5) has no effect while collision.law is constant");
  assert_line("{" FOLLOWED "[{at: 5, thermostat: gaussian, gaussian_rate: 1}, {at: 6, bath.drag: 2}]}", BOTH,
              "bath.drag (protocol, at: 6) has no effect but with thermostat: bath");
  assert_line("{" FOLLOWED "[{at: 5, bath.drag: 2, thermostat: white_noise}]}", BOTH,
              "bath.drag (protocol, at: 5) has no effect but with thermostat: bath");
  assert_line("{noise_strength: 2, " FOLLOWED "[{at: 5, thermostat: white_noise}]}", BOTH, NULL);
  assert_line("{" FOLLOWED "[{at: 5, bath.temperature: 2, collision.e: 0.8}]}", BOTH, NULL);
}

int main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test(forgotten_fractions),
                                     cmocka_unit_test(keys_of_other_flows_have_no_effect),
                                     cmocka_unit_test(keys_of_the_other_engine_have_no_effect),
                                     cmocka_unit_test(keys_of_other_grains_have_no_effect),
                                     cmocka_unit_test(asked_errors),
                                     cmocka_unit_test(defaults_are_not_reported),
                                     cmocka_unit_test(changes_without_effect_until_the_next_are_named)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
