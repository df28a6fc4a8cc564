/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The table of flows: every row is complete and its words are its own; its defaults make a scene that every engine it
 * claims takes and no other; thermostats it does not name are refused; its headline quantities are there in short runs,
 * of plain grains and of rough ones; lists of flows read like English. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "common/thermostat.h"
#include "files/text_format.h"
#include "graingas.h"
#include "run/run.h"
#include "scene/model_of_scene.h"
#include "scene/scene_reader.h"

static gg_scene scene_of(int flow, const char *rest)
{
  char text[400];
  gg_error err = {0};
  gg_scene s = gg_scene_defaults();
  snprintf(text, sizeof text, "{flow: %s, phi: 0.1, particles: 400%s}", gg_common_flows[flow].word, rest);
  if (gg_scene_read(&s, text, strlen(text), "s", &err) != GG_OK) fail_msg("%s: %s", text, err.message);
  return s;
}

static void rows_are_complete(void **state)
{
  (void)state;
  for (int f = 0; f < GG_N_FLOWS; f++) {
    const gg_flow_row *row = &gg_common_flows[f];
    if (!row->word || !row->title || !row->doc || !row->state) fail_msg("row %d lacks words", f);
    print_message("# %s: %s\n", row->word, row->doc);
    assert_int_equal(strspn(row->word, "abcdefghijklmnopqrstuvwxyz_"), strlen(row->word));
    for (int g = 0; g < f; g++) {
      assert_string_not_equal(row->word, gg_common_flows[g].word);
      assert_string_not_equal(row->title, gg_common_flows[g].title);
      assert_string_not_equal(row->state, gg_common_flows[g].state);
    }
    assert_true(row->engines != 0 && row->engines >> 2 == 0);
    assert_true(row->thermostats != 0 && row->thermostats >> GG_N_THERMOSTATS == 0);
    assert_true(gg_flow_takes((gg_flow)f, row->thermostat));
    bool falls = row->gravity[0] != 0 || row->gravity[1] != 0 || row->gravity[2] != 0;
    assert_int_equal(falls, row->falling == GG_ALWAYS_FALLS);
    assert_true(row->walls != GG_NO_WALLS || (!row->may_be_open && row->falling == GG_NEVER_FALLS));
    assert_true(row->walls == GG_NO_WALLS || row->frame == GG_LABORATORY);
    assert_non_null(row->headline);
    assert_true(*row->headline != GG_N_QUANTITIES);
    for (const int *q = row->headline; *q != GG_N_QUANTITIES; q++) assert_true(*q >= 0 && *q < GG_N_QUANTITIES);
  }
}

/* Optional keys may be missing in every flow. */
static void defaults_run(void **state)
{
  (void)state;
  for (int f = 0; f < GG_N_FLOWS; f++)
    for (int engine = GG_MD; engine <= GG_DSMC; engine++) {
      gg_scene s = scene_of(f, "");
      gg_model m;
      gg_error err = {0};
      if (gg_scene_finish(&s, &err) != GG_OK) fail_msg("%s", err.message);
      assert_int_equal(gg_scene_model_make(&s, (gg_engine_kind)engine, &m, &err), GG_OK);
      gg_status status = gg_common_engine_of(engine)->accepts(&m, &err);
      if (gg_flow_runs_in((gg_flow)f, engine) && status != GG_OK) fail_msg("%s", err.message);
      if (gg_flow_runs_in((gg_flow)f, engine)) continue;
      assert_int_equal(status, GG_BAD_INPUT);
      assert_non_null(strstr(err.message, gg_common_flows[f].word));
    }
}

/* A thermostat has words, acts on grains, and goes with some flow; keys of its own begin with its strength. */
static void rows_of_thermostats_are_complete(void **state)
{
  (void)state;
  char text[160];
  for (int t = 0; t < GG_N_THERMOSTATS; t++) {
    const gg_thermostat_row *row = &gg_common_thermostats[t];
    if (!row->word || !row->doc || !row->title) fail_msg("row %d lacks words", t);
    for (int u = 0; u < t; u++) assert_string_not_equal(row->word, gg_common_thermostats[u].word);
    const bool has_strength = t != GG_NO_THERMOSTAT && t != GG_INJECTION; /* collisions and torques inject */
    assert_int_equal(row->heat != GG_UNHEATED, has_strength);
    gg_common_flows_taking((gg_thermostat)t, text, sizeof text);
    assert_true(*text);
    const gg_field *strength = gg_scene_strength_of((gg_thermostat)t);
    assert_int_equal(strength != NULL, has_strength);
    if (strength) assert_int_equal(strength->type, GG_FIELD_NUMBER);
  }
}

static void each_flow_has_its_thermostats(void **state)
{
  (void)state;
  for (int f = 0; f < GG_N_FLOWS; f++)
    for (int t = 0; t < GG_N_THERMOSTATS; t++) {
      char key[80];
      gg_error err = {0};
      snprintf(key, sizeof key, ", thermostat: %s", gg_common_thermostats[t].word);
      gg_scene s = scene_of(f, key);
      if (t == GG_INJECTION) s.collision.kick[GG_NORMAL_KICK][0] = 0.1;
      gg_status status = gg_scene_finish(&s, &err);
      if (gg_flow_takes((gg_flow)f, (gg_thermostat)t) && status != GG_OK) fail_msg("%s", err.message);
      if (gg_flow_takes((gg_flow)f, (gg_thermostat)t)) continue;
      assert_int_equal(status, GG_BAD_INPUT);
      if (!strstr(err.message, gg_common_flows[f].word)) fail_msg("'%s' names no flow", err.message);
    }
}

/* `rest`: other keys. */
static void run_briefly(int flow, gg_engine_kind engine, const char *rest)
{
  gg_scene s = scene_of(flow, rest);
  gg_quantity list[GG_N_QUANTITIES];
  gg_result *r = NULL;
  gg_error err = {0};
  char title[256];
  s.engine = engine, s.dsmc.particles = 2000, s.run.collisions = 60, s.run.warmup = 20;
  if (gg_scene_finish(&s, &err) != GG_OK) fail_msg("%s", err.message);
  if (gg_run_scene(&s, NULL, 1, NULL, &r, &err) != GG_OK) fail_msg("%s: %s", gg_common_flows[flow].word, err.message);
  int n = gg_run_headline_quantities(&r->model, list);
  assert_true(n > 0);
  for (int i = 0; i < n; i++)
    if (!isfinite(r->value[list[i]].mean))
      fail_msg("%s: no %s: %s", gg_common_flows[flow].word, gg_common_quantity_name(list[i]), r->value[list[i]].reason);
  gg_files_scene_title(&s, NULL, title, sizeof title);
  assert_int_equal(strncmp(title, gg_common_flows[flow].title, strlen(gg_common_flows[flow].title)), 0);
  gg_result_free(r);
}

static void headline_quantities(void **state)
{
  (void)state;
  for (int f = 0; f < GG_N_FLOWS; f++)
    for (int engine = GG_MD; engine <= GG_DSMC; engine++) {
      if (!gg_flow_runs_in((gg_flow)f, engine)) continue;
      run_briefly(f, (gg_engine_kind)engine, "");
      if (!gg_common_flows[f].conserves) run_briefly(f, (gg_engine_kind)engine, ", collision: {beta: 0}");
    }
}

static bool none(gg_flow flow)
{
  return flow == GG_N_FLOWS;
}
static bool first(gg_flow flow)
{
  return flow == 0;
}
static bool first_two(gg_flow flow)
{
  return flow < 2;
}
static bool first_three(gg_flow flow)
{
  return flow < 3;
}

static void flows_are_listed_in_words(void **state)
{
  (void)state;
  char text[160];
  gg_common_flow_list(none, text, sizeof text);
  assert_string_equal(text, "");
  gg_common_flow_list(first, text, sizeof text);
  assert_string_equal(text, "equilibrium");
  gg_common_flow_list(first_two, text, sizeof text);
  assert_string_equal(text, "equilibrium or usf");
  gg_common_flow_list(first_three, text, sizeof text);
  assert_string_equal(text, "equilibrium, usf or hcs");
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(rows_are_complete),
      cmocka_unit_test(defaults_run),
      cmocka_unit_test(rows_of_thermostats_are_complete),
      cmocka_unit_test(each_flow_has_its_thermostats),
      cmocka_unit_test(headline_quantities),
      cmocka_unit_test(flows_are_listed_in_words),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
