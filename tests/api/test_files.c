/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Runs and their files: what is stopped at any moment goes on to the same end; what cannot be written is said, and no
 * result is lost for it. */
#include <sys/stat.h>

#include "api_test.h"

/* Rough grains: their theories take a fifth of the time that those of smooth ones take. */
#define SHEAR                                                                                                          \
  "{flow: usf, engine: dsmc, phi: 0.1, collision: {beta: 0}, dsmc: {particles: 200}, run: {collisions: 6000}}"

static int stop_now(void *context)
{
  return (*(int *)context)-- <= 0;
}

/* Before the first sample, in the warm-up, around its end, while averaging; with curves, in both engines. */
static void stopped_anywhere(void **state)
{
  (void)state;
  gg_error err;
  const char *const scenes[] = {
      "{flow: usf, engine: dsmc, phi: 0.1, dsmc: {particles: 2000}, measure: [rheology, velocity_distributions, "
      "diffusion], run: {collisions: 40, warmup: 20}}",
      "{flow: hcs, phi: 0.1, particles: 300, collision: {e: 0.7}, measure: [rheology, sonine, structure], run: "
      "{collisions: 40, warmup: 20}}"};
  const int after[] = {0, 1, 5, 9, 10, 11, 12, 20, 29};
  for (int k = 0; k < 2; k++) {
    gg_scene *s = scene_of(scenes[k]);
    gg_result *whole = NULL;
    gg_run(s, NULL, &whole, &err);
    assert_non_null(whole);
    gg_measurement end, here;
    assert_ok(gg_result_find(whole, k ? "cooling_rate" : "temperature", &end, &err));
    for (size_t i = 0; i < sizeof after / sizeof *after; i++) {
      int left = after[i];
      gg_result *part = NULL, *rest = NULL;
      char *text = NULL;
      gg_run_options options = {.size = sizeof options, .stop = stop_now, .context = &left, .checkpoint = "t_any.h5"};
      unlink("t_any.h5"), unlink("t_any.h5.1"); /* without an output the checkpoint stays when the run is done */
      assert_int_equal(gg_run(s, &options, &part, &err), GG_INTERRUPTED);
      assert_non_null(part);
      assert_ok(gg_result_to_json(part, &text, &err));
      free(text);
      assert_ok(gg_result_write(part, "t_part.h5", NULL, NULL, &err));
      gg_result_free(part);
      assert_ok(gg_result_read("t_part.h5", &part, &err));
      gg_result_free(part);
      gg_run(s, &(gg_run_options){.size = sizeof(gg_run_options), .resume = "t_any.h5", .checkpoint = "t_any.h5"},
             &rest, &err);
      assert_non_null(rest);
      assert_ok(gg_result_find(rest, end.name, &here, &err));
      if (!(here.mean == end.mean && here.error == end.error))
        fail_msg("%d: %.17g %.17g", after[i], here.mean, end.mean);
      gg_result_free(rest);
    }
    gg_result_free(whole);
    gg_scene_free(s);
  }
}

static int stop_in_averaging(void *context, const gg_progress *progress)
{
  (void)context;
  return strcmp(progress->phase, "averaging") == 0;
}

/* A large ensemble is stopped in steps of a single sample: the first of the averaging is all that there is. */
static void a_single_sample(void **state)
{
  (void)state;
  gg_error err;
  gg_scene *s = scene_of("{flow: usf, engine: dsmc, phi: 0.1, dsmc: {particles: 250000}, measure: [rheology, "
                         "velocity_distributions], run: {collisions: 40, warmup: 4}}");
  gg_result *r = NULL;
  gg_measurement m;
  assert_int_equal(
      gg_run(s, &(gg_run_options){.size = sizeof(gg_run_options), .progress = stop_in_averaging}, &r, &err),
      GG_INTERRUPTED);
  assert_ok(gg_result_find(r, "temperature", &m, &err));
  assert_true(m.mean > 0 && isnan(m.error) && m.samples == 1);
  assert_ok(gg_result_write(r, "t_single.h5", NULL, NULL, &err));
  gg_result_free(r);
  gg_scene_free(s);
}

static int remove_folder(void *context, const gg_progress *now)
{
  (void)context;
  if (now->phase[0] != 'a' || now->fraction < 0.5) return 0;
  unlink("t_folder/c.h5.graingas-lock"); /* the run's */
  assert_true(rmdir("t_folder") == 0 || access("t_folder", F_OK) != 0);
  return 1;
}

/* Known before the run; and if it happens on the way, with the results so far. */
static void unwritable_checkpoints(void **state)
{
  (void)state;
  gg_error err;
  gg_scene *s = scene_of(SHEAR);
  gg_result *r = NULL;
  gg_comparison *c = NULL;
  gg_measurement m;
  gg_run_options options = {
      .size = sizeof options, .checkpoint = "t_folder/c.h5", .output = "t_out.h5", .progress = remove_folder};
  assert_int_equal(gg_run(s, &options, &r, &err), GG_BAD_FILE);
  assert_null(r);
  assert_int_equal(mkdir("t_folder", 0777), 0);
  assert_int_equal(gg_run(s, &options, &r, &err), GG_BAD_FILE);
  assert_true(err.status == GG_BAD_FILE && strstr(err.message, "t_folder/c.h5"));
  assert_non_null(r);
  assert_ok(gg_result_find(r, "temperature", &m, &err));
  assert_true(m.mean > 0 && access("t_out.h5", F_OK) != 0);
  gg_result_free(r);
  assert_int_equal(mkdir("t_folder", 0777), 0);
  assert_int_equal(gg_compare(s, &options, &c, &err), GG_BAD_FILE);
  assert_non_null(c);
  assert_ok(gg_result_find(gg_comparison_result(c, "md"), "temperature", &m, &err));
  assert_null(gg_comparison_result(c, "dsmc")); /* was not begun any more */
  assert_true(access("t_out.h5", F_OK) != 0);
  gg_comparison_free(c);
  gg_scene_free(s);
}

/* A result never takes the place of a checkpoint; a checkpoint may that of the one that is resumed from. */
static void one_path_for_two(void **state)
{
  (void)state;
  gg_error err;
  int left = 3;
  gg_scene *s = scene_of(SHEAR);
  gg_result *r = NULL;
  gg_comparison *c = NULL;
  gg_run_options same = {.size = sizeof same, .output = "t_same.h5", .checkpoint = "t_same.h5"};
  assert_refused(gg_run(s, &same, &r, &err), "choose another output");
  assert_refused(gg_compare(s, &same, &c, &err), "choose another output");
  assert_int_equal(
      gg_run(s,
             &(gg_run_options){
                 .size = sizeof(gg_run_options), .checkpoint = "t_cp.h5", .stop = stop_now, .context = &left},
             &r, &err),
      GG_INTERRUPTED);
  gg_result_free(r);
  r = NULL;
  assert_refused(gg_run(s,
                        &(gg_run_options){.size = sizeof(gg_run_options), .output = "./t_cp.h5", .resume = "t_cp.h5"},
                        &r, &err),
                 "another output");
  assert_null(r);
  assert_ok(
      gg_run(s,
             &(gg_run_options){
                 .size = sizeof(gg_run_options), .checkpoint = "t_cp.h5", .resume = "t_cp.h5", .output = "t_o.h5"},
             &r, &err));
  gg_result_free(r);
  gg_scene_free(s);
}

/* A checkpoint of another kind is rejected, and its kind named. */
static void checkpoints_of_others(void **state)
{
  (void)state;
  gg_error err;
  int left = 3;
  gg_scene *s = scene_of(SHEAR);
  gg_result *r = NULL;
  gg_comparison *c = NULL;
  gg_simulation *m = NULL;
  gg_run_options options = {.size = sizeof options, .checkpoint = "t_both.h5", .progress = stop_in_averaging};
  assert_int_equal(gg_compare(s, &options, &c, &err), GG_INTERRUPTED);
  options =
      (gg_run_options){.size = sizeof(gg_run_options), .checkpoint = "t_one.h5", .stop = stop_now, .context = &left};
  assert_int_equal(gg_run(s, &options, &r, &err), GG_INTERRUPTED);
  gg_comparison_free(c);
  gg_result_free(r);
  r = NULL, c = NULL;
  assert_ok(gg_simulation_new(s, NULL, &m, &err));
  assert_ok(gg_simulation_save(m, "t_simulation.h5", NULL, NULL, &err));
  gg_simulation_free(m);
  m = NULL;
  assert_refused(gg_run(s, &(gg_run_options){.size = sizeof(gg_run_options), .resume = "t_both.h5"}, &r, &err),
                 "one of a comparison");
  assert_refused(gg_run(s, &(gg_run_options){.size = sizeof(gg_run_options), .resume = "t_simulation.h5"}, &r, &err),
                 "a saved simulation");
  assert_refused(gg_compare(s, &(gg_run_options){.size = sizeof(gg_run_options), .resume = "t_one.h5"}, &c, &err),
                 "not one of a comparison");
  assert_refused(gg_simulation_load("t_one.h5", NULL, NULL, NULL, &m, &err), "not a saved simulation");
  assert_true(!r && !c && !m);
  gg_scene_free(s);
}

static int is_over(void *context, const gg_progress *now)
{
  if (context && now->fraction == 1) *(int *)context = 1;
  return 0;
}

static int if_over(void *context)
{
  return context && *(int *)context;
}

/* Stopped while the frames go into the result: nothing is lost, and the run ends when it is gone on from. */
static void stopped_at_the_end(void **state)
{
  (void)state;
  gg_error err;
  int over = 0;
  gg_scene *s = scene_of(SHEAR);
  gg_result *r = NULL;
  assert_ok(gg_scene_set(s, "output.checkpoint_every", "0.0001", &err));
  assert_ok(gg_scene_set(s, "output.trajectory_every", "50", &err));
  gg_run_options options = {
      .size = sizeof options, .output = "t_late.h5", .checkpoint = "t_late.checkpoint.h5", .context = &over};
  options.progress = is_over, options.stop = if_over;
  assert_int_equal(gg_run(s, &options, &r, &err), GG_INTERRUPTED);
  assert_non_null(strstr(err.message, "the trajectory"));
  assert_true(r && access("t_late.h5", F_OK) != 0 && access("t_late.checkpoint.frames", F_OK) == 0);
  gg_result_free(r);
  options.context = NULL, options.resume = options.checkpoint;
  gg_run(s, &options, &r, &err);
  assert_true(r && access("t_late.h5", F_OK) == 0 && access("t_late.checkpoint.frames", F_OK) != 0);
  gg_result_free(r);
  gg_scene_free(s);
}

static int stop_late(void *context, const gg_progress *now)
{
  (void)context;
  return now->phase[0] == 'a' && now->fraction > 0.6;
}

/* Until it is stopped with frames in its log. */
static void begin_trajectory(const gg_scene *s, const char *checkpoint)
{
  gg_error err;
  gg_result *r = NULL;
  const gg_run_options options = {
      .size = sizeof options, .output = "t_frames.h5", .checkpoint = checkpoint, .progress = stop_late};
  unlink("t_log.h5"), unlink("t_log.h5.1"); /* what an earlier one left is not replaced */
  assert_int_equal(gg_run(s, &options, &r, &err), GG_INTERRUPTED);
  gg_result_free(r);
}

static size_t frames_of(const char *path)
{
  gg_error err;
  gg_result *r = NULL;
  gg_result_info about;
  assert_ok(gg_result_read(path, &r, &err));
  assert_ok(gg_result_get_info(r, &about, &err));
  gg_result_free(r);
  return about.frames;
}

/* The frame log beside a checkpoint is found if the checkpoint was renamed. A resumed run continues it in the log of
 * another checkpoint, or puts it into its result if it keeps no checkpoints. A missing or truncated log is an error. */
static void logs_of_frames(void **state)
{
  (void)state;
  gg_error err;
  gg_scene *s = scene_of(SHEAR);
  gg_result *r = NULL;
  const char *const on[] = {"t_log.h5", "t_moved.h5", NULL}; /* checkpoint of the resumed run */
  assert_ok(gg_scene_set(s, "output.trajectory_every", "100", &err));
  assert_ok(gg_scene_set(s, "output.checkpoint_every", "0.001", &err));
  gg_run(s, &(gg_run_options){.size = sizeof(gg_run_options), .output = "t_frames.h5"}, &r, &err);
  gg_result_free(r);
  const size_t whole = frames_of("t_frames.h5");
  assert_true(whole > 30);
  for (int k = 0; k < 3; k++) {
    gg_run_options options = {
        .size = sizeof options, .output = "t_frames.h5", .checkpoint = on[k], .resume = k ? "t_other.h5" : "t_log.h5"};
    begin_trajectory(s, "t_log.h5");
    if (k) assert_int_equal(rename("t_log.h5", "t_other.h5"), 0); /* the log keeps its name */
    r = NULL;
    gg_run(s, &options, &r, &err);
    assert_non_null(r);
    gg_result_free(r);
    assert_int_equal(frames_of("t_frames.h5"), whole);
    assert_true(access("t_log.frames", F_OK) != 0 || k);
    unlink("t_log.frames"), unlink("t_other.h5");
  }
  const gg_run_options options = {
      .size = sizeof options, .output = "t_frames.h5", .checkpoint = "t_log.h5", .resume = "t_log.h5"};
  for (int k = 0; k < 2; k++) {
    begin_trajectory(s, "t_log.h5");
    assert_int_equal(k ? truncate("t_log.frames", 100) : unlink("t_log.frames"), 0);
    r = NULL;
    assert_int_equal(gg_run(s, &options, &r, &err), GG_BAD_FILE);
    assert_true(!r && strstr(err.message, "t_log.frames") && strstr(err.message, "output.trajectory_every: 0"));
    unlink("t_log.h5"), unlink("t_log.h5.1"), unlink("t_log.frames");
  }
  /* A pipe keeps no frames. */
  assert_int_equal(mkfifo("t_log.frames", 0666), 0);
  assert_int_equal(
      gg_run(s, &(gg_run_options){.size = sizeof(gg_run_options), .checkpoint = "t_log.h5", .output = "t_frames.h5"},
             &r, &err),
      GG_BAD_FILE);
  assert_non_null(strstr(err.message, "frames are kept in files"));
  gg_scene_free(s);
}

static uint64_t last_count;
static int note_count(void *context, const gg_progress *now)
{
  (void)context;
  assert_int_equal(now->replicas, 3);
  last_count = now->collisions;
  return 0;
}

static void progress_counts_all_replicas(void **state)
{
  (void)state;
  gg_error err;
  gg_scene *s = scene_of(SHEAR);
  gg_result *r = NULL;
  gg_result_info about;
  assert_ok(gg_scene_set(s, "run.replicas", "3", &err));
  gg_run(s, &(gg_run_options){.size = sizeof(gg_run_options), .progress = note_count}, &r, &err);
  assert_ok(gg_result_get_info(r, &about, &err));
  assert_true(last_count > 0 && fabs((double)last_count / (double)about.total_collisions - 1) < 1e-9);
  gg_result_free(r);
  gg_scene_free(s);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(stopped_anywhere),       cmocka_unit_test(a_single_sample),
      cmocka_unit_test(unwritable_checkpoints), cmocka_unit_test(one_path_for_two),
      cmocka_unit_test(checkpoints_of_others),  cmocka_unit_test(progress_counts_all_replicas),
      cmocka_unit_test(stopped_at_the_end),     cmocka_unit_test(logs_of_frames),
  };
  return cmocka_run_group_tests(tests, enter_folder, leave_folder);
}
