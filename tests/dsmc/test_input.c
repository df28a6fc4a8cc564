/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Scenes that the engine cannot run are rejected with the scene key to change. */
#include "lab.h"

static void check_rejected(const gg_model *m, const char *key)
{
  gg_error err = {0};
  gg_engine *g;
  assert_int_equal(gg_dsmc_ops.create(m, 1, 0, &g, &err), GG_BAD_INPUT);
  assert_non_null(strstr(err.message, key));
}

static void scenes_are_rejected_by_key(void **state)
{
  (void)state;
  gg_scene s = lab_scene(GG_POISEUILLE, 0.1, 0.9, -1, 100);
  s.gravity[0] = 1;
  s.walls.ridges = 1;
  gg_model m = lab_model(&s);
  check_rejected(&m, "walls.ridges");
  s.walls.ridges = 0;
  m = lab_model(&s);
  m.n = m.n_of[0] = 1;
  check_rejected(&m, "dsmc.particles");
  m = lab_model(&s);
  m.single = true;
  check_rejected(&m, "dsmc.precision");
  s.gravity[0] = 0;
  s.flow = GG_USF;
  m = lab_model(&s);
  m.gravity[1] = -1;
  check_rejected(&m, "gravity");
  m = lab_model(&s);
  m.n = m.n_of[0] = 1;
  check_rejected(&m, "dsmc.particles");
  m = lab_model(&s);
  m.time_step = 0;
  check_rejected(&m, "dsmc.time_step");
}

static void count_line(void *context, const char *text)
{
  assert_non_null(text);
  ++*(int *)context;
}

static void a_scene_is_described_in_seven_lines(void **state)
{
  (void)state;
  gg_scene s = lab_scene(GG_USF, 0, 0.9, -1, 100);
  gg_model m = lab_model(&s);
  int lines = 0;
  gg_dsmc_ops.describe(&m, count_line, &lines);
  assert_int_equal(lines, 7);
}

int main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test(scenes_are_rejected_by_key),
                                     cmocka_unit_test(a_scene_is_described_in_seven_lines)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
