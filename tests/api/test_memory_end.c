/* SPDX-License-Identifier: GPL-3.0-or-later */
/* No memory at all from the moment on at which the result is in place: what is left to do is done without any. */
#include "../faults/failing_malloc.h"
#include "api_test.h"

#define SHEAR "{flow: usf, engine: dsmc, phi: 0.1, dsmc: {particles: 200}, run: {collisions: 6000}}"

static bool is_in_place(void)
{
  return access("t_end.h5", F_OK) == 0;
}

static int stop_late(void *context, const gg_progress *now)
{
  (void)context;
  return now->phase[0] == 'a' && now->fraction > 0.6;
}

static void nothing_is_left_behind(void **state)
{
  (void)state;
  gg_error err;
  gg_scene *s = scene_of(SHEAR);
  gg_result *r = NULL;
  assert_ok(gg_scene_set(s, "output.checkpoint_every", "0.0001", &err));
  assert_ok(gg_scene_set(s, "output.trajectory_every", "50", &err));
  gg_run_options options = {
      .size = sizeof options, .output = "t_end.h5", .checkpoint = "t_end.checkpoint.h5", .progress = stop_late};
  for (int resumed = 0; resumed < 2; resumed++) {
    failing_malloc_arm_from(is_in_place);
    gg_status status = gg_run(s, &options, &r, &err);
    failing_malloc_disarm(NULL);
    assert_int_equal(status, resumed ? GG_OK : GG_INTERRUPTED);
    assert_int_equal(access("t_end.h5", F_OK) == 0, resumed);
    assert_int_equal(access("t_end.checkpoint.h5", F_OK) != 0, resumed);
    assert_int_equal(access("t_end.checkpoint.frames", F_OK) != 0, resumed);
    assert_true(!resumed || access("t_end.checkpoint.h5.1", F_OK) != 0);
    options.progress = NULL, options.resume = options.checkpoint;
    gg_result_free(r);
  }
  gg_scene_free(s);
}

int main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test(nothing_is_left_behind)};
  return cmocka_run_group_tests(tests, enter_folder, leave_folder);
}
