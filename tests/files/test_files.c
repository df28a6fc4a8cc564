/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Files: results come back as they were written, and a write that fails leaves nothing behind. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>
#include <fcntl.h>
#include <pthread.h>
#include <stdio.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include "files/h5/checkpoint_file.h"
#include "files/h5/hdf5_reader.h"
#include "files/h5/hdf5_writer.h"
#include "files/h5/result_file.h"
#include "files/h5/result_reader.h"
#include "graingas.h"
#include "own_folder.h"
#include "planted.h"

static double read_number(gg_h5_in *h, const char *path)
{
  size_t n;
  double *x = gg_h5_read_array(h, path, GG_ITEM_F64, &n), value = x ? x[0] : NAN;
  assert_int_equal(n, 1);
  free(x);
  return value;
}

/* Means, series, scene and document come back to the last bit. */
static void run_round_trip(void **state)
{
  (void)state;
  gg_error err = {0};
  gg_result *r = planted_result(GG_MD);
  gg_stored_result s;
  assert_int_equal(gg_result_write(r, "r.h5", NULL, NULL, &err), GG_OK);
  assert_int_equal(gg_files_stored_result_read(&s, "r.h5", &err), GG_OK);
  assert_false(s.comparison);
  assert_string_equal(s.version, gg_version());
  assert_non_null(s.engine[GG_MD].name);
  assert_null(s.engine[GG_DSMC].name);
  assert_true(s.engine[GG_MD].window[0] == 3 && s.engine[GG_MD].window[1] == PLANTED_SAMPLES);
  assert_int_equal(s.engine[GG_MD].n_series, 6); /* those of NaN alone are not there */
  const gg_stored_series *T = gg_files_stored_series_find(&s.engine[GG_MD], "temperature");
  assert_int_equal(T->n, PLANTED_SAMPLES);
  assert_memory_equal(T->value, r->history.value[0], PLANTED_SAMPLES * sizeof(double));
  assert_memory_equal(T->time, r->history.time, PLANTED_SAMPLES * sizeof(double));
  gg_scene *scene;
  assert_int_equal(gg_scene_parse(s.scene, "stored", &scene, &err), GG_OK);
  r->scene->given = scene->given; /* the file gives every key */
  assert_memory_equal(scene, r->scene, sizeof *scene);
  gg_scene_free(scene);
  gg_files_stored_result_clear(&s);

  gg_h5_in h;
  gg_h5_open(&h, "r.h5", false);
  assert_true(read_number(&h, "/graingas/results/pressure/mean") == 0.1 + 0.2);
  assert_true(read_number(&h, "/graingas/results/pressure/stderr") == 0.002);
  assert_true(read_number(&h, "/graingas/seed") == 1);
  assert_false(gg_h5_exists(&h, "/graingas/results/a2/mean")); /* cannot be had: not there */
  assert_true(gg_h5_exists(&h, "/graingas/results/a2/unit"));
  char *unit = gg_h5_read_text(&h, "/graingas/results/pressure/unit");
  assert_string_equal(unit, "rho_p d^2 gamma^2");
  free(unit);
  gg_h5_in_close(&h);
  gg_result_free(r);
  remove_all();
}

static void comparison_round_trip(void **state)
{
  (void)state;
  gg_error err = {0};
  gg_comparison *c = planted_comparison();
  gg_result_file f;
  gg_stored_result s;
  assert_int_equal(gg_files_result_file_open(&f, "c.h5", "graingas compare x", &err), GG_OK);
  assert_int_equal(gg_files_result_file_finish_comparison(&f, c, &err), GG_OK);
  assert_int_equal(gg_files_stored_result_read(&s, "c.h5", &err), GG_OK);
  assert_true(s.comparison);
  assert_string_equal(s.command, "graingas compare x");
  for (int k = 0; k < 2; k++) assert_non_null(gg_files_stored_series_find(&s.engine[k], "pressure"));
  gg_files_stored_result_clear(&s);
  gg_h5_in h;
  gg_h5_open(&h, "c.h5", false);
  assert_true(read_number(&h, "/graingas/dsmc/results/temperature/mean") == 1.0 / 3 - 0.01);
  double lun = c->theory[0].answer.value[GG_Q_TEMPERATURE];
  assert_true(read_number(&h, "/graingas/theory/lun1991/temperature/mean") == lun);
  gg_h5_in_close(&h);
  assert_int_equal(count_files(), 1);
  planted_comparison_free(c);
  remove_all();
}

/* Frames stream to the disk; a row is the same grain in every frame, in whatever order the engine shows them. */
static void a_row_is_the_same_grain_in_every_frame(void **state)
{
  (void)state;
  gg_error err = {0};
  gg_result *r = planted_result(GG_MD);
  gg_result_file f;
  size_t n;
  assert_int_equal(gg_files_result_file_open(&f, "t.h5", "x", &err), GG_OK);
  for (uint64_t step = 0; step <= 100; step += 50) {
    gg_frame frame = planted_frame(step, true);
    assert_int_equal(gg_files_result_file_frame(&f, &r->model, &frame, &err), GG_OK);
    gg_measure_frame_free(&frame);
  }
  assert_int_equal(gg_files_result_file_finish_run(&f, r, &err),
                   GG_OK); /* the last state is frame 100 again: not doubled */
  gg_h5_in h;
  gg_h5_open(&h, "t.h5", false);
  double *x = gg_h5_read_array(&h, "/particles/grains/position/value", GG_ITEM_F64, &n);
  assert_int_equal(n, 3 * 3 * PLANTED_GRAINS);
  for (size_t k = 0; k < 3; k++)
    for (size_t i = 0; i < PLANTED_GRAINS; i++)
      assert_true(fabs(x[(k * PLANTED_GRAINS + i) * 3 + 1] - ((double)i + 0.1 + 0.05 * (double)k)) < 1e-12);
  free(x);
  double *time = gg_h5_read_array(&h, "/particles/grains/box/edges/time", GG_ITEM_F64, &n);
  assert_int_equal(n, 3);
  assert_true(time[2] == 50);
  free(time);
  gg_h5_in_close(&h);
  assert_int_equal(count_files(), 1);
  gg_result_free(r);
  remove_all();
}

/* Frames of averaging that was given up are not in the file: `after: warmup` keeps those of the last window. */
static void frames_of_the_window(void **state)
{
  (void)state;
  for (uint64_t window = 0; window <= 150; window += 50) {
    gg_error err = {0};
    gg_result *r = planted_result(GG_MD);
    gg_result_file f;
    size_t n, m;
    r->scene->output.after = GG_AFTER_WARMUP, r->window_step = window;
    assert_int_equal(gg_files_result_file_open(&f, "t.h5", "x", &err), GG_OK);
    for (uint64_t step = 0; step <= 100; step += 50) {
      gg_frame frame = planted_frame(step, true);
      assert_int_equal(gg_files_result_file_frame(&f, &r->model, &frame, &err), GG_OK);
      gg_measure_frame_free(&frame);
    }
    assert_int_equal(gg_files_result_file_finish_run(&f, r, &err), GG_OK);
    gg_h5_in h;
    gg_h5_open(&h, "t.h5", false);
    double *x = gg_h5_read_array(&h, "/particles/grains/position/value", GG_ITEM_F64, &n);
    double *time = gg_h5_read_array(&h, "/particles/grains/box/edges/time", GG_ITEM_F64, &m);
    const size_t kept = window >= 50 ? 1 : 2; /* of 50 and 100; the last state is there in any case */
    assert_int_equal(m, kept);
    assert_int_equal(n, kept * 3 * PLANTED_GRAINS);
    for (size_t k = 0; k < kept; k++)
      assert_true(fabs(x[k * PLANTED_GRAINS * 3 + 1] - 0.05 * (double)(3 - kept + k) - 0.1) < 1e-12);
    assert_true(time[kept - 1] == 50);
    free(x);
    free(time);
    gg_h5_in_close(&h);
    gg_result_free(r);
    remove_all();
  }
}

/* No room, no folder, a folder in the way: the message names file and cause, nothing new is left, the old file stays.
 */
static void failing_writes(void **state)
{
  (void)state;
  gg_error err = {0};
  gg_result *r = planted_result(GG_MD);
  assert_int_equal(gg_result_write(r, "nowhere/r.h5", NULL, NULL, &err), GG_BAD_FILE);
  assert_string_equal(err.message, "nowhere/r.h5: cannot be written: No such file or directory");
  mkdir("folder.h5", 0777);
  assert_int_equal(gg_result_write(r, "folder.h5", NULL, NULL, &err), GG_BAD_FILE);
  assert_non_null(strstr(err.message, "Is a directory"));
  rmdir("folder.h5");
  assert_int_equal(gg_result_write(r, "/proc/r.h5", NULL, NULL, &err), GG_BAD_FILE);
  assert_int_equal(gg_result_write(r, "old.h5", NULL, NULL, &err), GG_OK);
  struct rlimit whole, small;
  struct stat before, after;
  stat("old.h5", &before);
  getrlimit(RLIMIT_FSIZE, &whole);
  small = whole;
  small.rlim_cur = 20000;
  setrlimit(RLIMIT_FSIZE, &small);
  gg_status status = gg_result_write(r, "old.h5", NULL, NULL, &err);
  setrlimit(RLIMIT_FSIZE, &whole);
  assert_int_equal(status, GG_BAD_FILE);
  assert_string_equal(err.message, "old.h5: cannot be written: File too large");
  stat("old.h5", &after);
  assert_true(before.st_ino == after.st_ino && before.st_size == after.st_size);
  assert_int_equal(count_files(), 1);
  gg_result_free(r);
  remove_all();
}

/* The same while frames stream: HDF5's own writes fail, and nothing is left. */
static void failing_trajectory(void **state)
{
  (void)state;
  gg_error err = {0};
  gg_result *r = planted_result(GG_MD);
  gg_result_file f;
  struct rlimit whole, small;
  getrlimit(RLIMIT_FSIZE, &whole);
  small = whole;
  small.rlim_cur = 30000;
  assert_int_equal(gg_files_result_file_open(&f, "t.h5", "x", &err), GG_OK);
  setrlimit(RLIMIT_FSIZE, &small);
  gg_status status = GG_OK;
  for (uint64_t step = 0; step < 300 && status == GG_OK; step++) {
    gg_frame frame = planted_frame(step, true);
    status = gg_files_result_file_frame(&f, &r->model, &frame, &err);
    gg_measure_frame_free(&frame);
  }
  gg_status end = status == GG_OK ? gg_files_result_file_finish_run(&f, r, &err) : status;
  gg_files_result_file_abandon(&f);
  setrlimit(RLIMIT_FSIZE, &whole);
  assert_int_equal(end, GG_BAD_FILE);
  assert_string_equal(err.message, "t.h5: cannot be written: File too large");
  assert_int_equal(count_files(), 0);
  gg_result_free(r);
}

static void unreadable_results(void **state)
{
  (void)state;
  gg_error err = {0};
  gg_stored_result s;
  assert_int_equal(gg_files_stored_result_read(&s, "none.h5", &err), GG_BAD_FILE);
  FILE *out = fopen("rubbish.h5", "w");
  fputs("rubbish", out);
  fclose(out);
  assert_int_equal(gg_files_stored_result_read(&s, "rubbish.h5", &err), GG_BAD_FILE);
  assert_non_null(strstr(err.message, "rubbish.h5: cannot be read: it is not an HDF5 file"));
  gg_archive a = {0};
  gg_scene scene = gg_scene_defaults();
  assert_int_equal(gg_files_checkpoint_write("c.h5", false, true, &a, &scene, &err), GG_OK);
  assert_int_equal(gg_files_stored_result_read(&s, "c.h5", &err), GG_BAD_FILE);
  assert_non_null(strstr(err.message, "it is a checkpoint"));
  remove_all();
}

/* Thread that writes a file of its own and a file that all threads write. Each write of the shared file succeeds, or
 * fails because another writer holds its lock. */
static void *write_and_read(void *number)
{
  gg_error err;
  gg_stored_result s;
  gg_result *r = planted_result(GG_MD);
  char own[24];
  intptr_t wrong = 0;
  snprintf(own, sizeof own, "own%d.h5", *(int *)number);
  for (int i = 0; i < 20; i++) {
    bool read =
        gg_result_write(r, own, NULL, NULL, &err) == GG_OK && gg_files_stored_result_read(&s, own, &err) == GG_OK;
    wrong += !read || !gg_files_stored_series_find(&s.engine[GG_MD], "temperature");
    if (read) gg_files_stored_result_clear(&s);
    gg_status status = gg_result_write(r, "one.h5", NULL, NULL, &err);
    wrong += status != GG_OK && !(status == GG_BAD_FILE && strstr(err.message, "another process is writing it"));
  }
  gg_result_free(r);
  return (void *)wrong;
}

static void threads_at_once(void **state)
{
  (void)state;
  hbool_t safe = 0;
  pthread_t thread[4];
  int number[4] = {0, 1, 2, 3};
  void *wrong;
  gg_error err;
  gg_stored_result s;
  if (H5is_library_threadsafe(&safe) < 0 || !safe) skip();
  for (int i = 0; i < 4; i++) assert_int_equal(pthread_create(&thread[i], NULL, write_and_read, &number[i]), 0);
  for (int i = 0; i < 4; i++) {
    assert_int_equal(pthread_join(thread[i], &wrong), 0);
    assert_null(wrong);
  }
  assert_int_equal(gg_files_stored_result_read(&s, "one.h5", &err), GG_OK);
  gg_files_stored_result_clear(&s);
  assert_int_equal(count_files(), 5);
  remove_all();
}

/* Results for one pipe or device are made up side by side. */
static void two_in_memory(void **state)
{
  (void)state;
  gg_error err = {0};
  gg_result *r = planted_result(GG_MD);
  gg_result_file f[2];
  assert_int_equal(mkfifo("pipe", 0666), 0);
  int in = open("pipe", O_RDONLY | O_NONBLOCK);
  for (uint64_t step = 0; step <= 1; step++)
    for (int i = 0; i < 2; i++) {
      if (step == 0) assert_int_equal(gg_files_result_file_open(&f[i], "pipe", "x", &err), GG_OK);
      gg_frame frame = planted_frame(step, true);
      if (gg_files_result_file_frame(&f[i], &r->model, &frame, &err) != GG_OK) fail_msg("%s", err.message);
      gg_measure_frame_free(&frame);
    }
  for (int i = 0; i < 2; i++) gg_files_result_file_abandon(&f[i]);
  close(in);
  assert_int_equal(count_files(), 1);
  gg_result_free(r);
  remove_all();
}

/* HDF5's own error printing is given back to the program that uses the library. */
static void hdf5_stays_as_it_was(void **state)
{
  (void)state;
  H5E_auto2_t before, after;
  void *data;
  gg_error err;
  gg_stored_result s;
  H5Eget_auto2(H5E_DEFAULT, &before, &data);
  gg_files_stored_result_read(&s, "none.h5", &err);
  H5Eget_auto2(H5E_DEFAULT, &after, &data);
  assert_true(before == after);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(run_round_trip),
      cmocka_unit_test(comparison_round_trip),
      cmocka_unit_test(a_row_is_the_same_grain_in_every_frame),
      cmocka_unit_test(frames_of_the_window),
      cmocka_unit_test(failing_writes),
      cmocka_unit_test(failing_trajectory),
      cmocka_unit_test(unreadable_results),
      cmocka_unit_test(threads_at_once),
      cmocka_unit_test(two_in_memory),
      cmocka_unit_test(hdf5_stays_as_it_was),
  };
  H5dont_atexit();
  return cmocka_run_group_tests(tests, enter, leave);
}
