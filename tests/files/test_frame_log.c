/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The log of frames: what was put in comes out in the order of the grains' numbers; a mark vouches for every byte
 * before it, and for none behind it. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/checksum.h"
#include "files/frame_log.h"

enum { N = 7, FRAMES = 5 };
static const char path[] = "t_log.frames", other[] = "t_other.frames";

typedef struct planted {
  double position[3 * N], velocity[3 * N], spin[3 * N], image[3 * N];
  uint8_t species[N];
  int64_t id[N];
} planted;

/* Frame k: grain i has numbers made of both; the grains stand in another order in each. */
static gg_frame frame_of(planted *p, int k)
{
  for (int i = 0; i < N; i++) {
    int grain = (i * 3 + k) % N;
    p->id[i] = grain;
    p->species[i] = (uint8_t)(grain % 2);
    for (int a = 0; a < 3; a++) {
      p->velocity[3 * i + a] = 100 * k + 10 * grain + a;
      p->position[3 * i + a] = -p->velocity[3 * i + a];
      p->image[3 * i + a] = grain - k;
      p->spin[3 * i + a] = 1 / (1 + p->velocity[3 * i + a]);
    }
  }
  return (gg_frame){.time = 0.1 * k,
                    .step = (uint64_t)k,
                    .n = N,
                    .tilt = 0.3 * k,
                    .position = p->position,
                    .velocity = p->velocity,
                    .spin = k % 2 ? p->spin : NULL,
                    .image = k % 3 ? p->image : NULL,
                    .species = p->species,
                    .id = p->id};
}

static gg_status expect(void *context, const gg_frame *f, gg_error *err)
{
  int k = (*(int *)context)++;
  (void)err;
  assert_true(f->n == N && f->step == (uint64_t)k && f->time == 0.1 * k && !f->id && !f->spin == !(k % 2));
  assert_true(f->tilt == 0.3 * k && !f->image == !(k % 3));
  for (int i = 0; i < N; i++) {
    assert_int_equal(f->species[i], i % 2);
    for (int a = 0; a < 3; a++) {
      double c = 100 * k + 10 * i + a;
      assert_true(f->velocity[3 * i + a] == c && f->position[3 * i + a] == -c);
      if (f->image) assert_true(f->image[3 * i + a] == i - k);
      if (f->spin) assert_true(f->spin[3 * i + a] == 1 / (1 + c));
    }
  }
  return GG_OK;
}

static void holds(const gg_frame_log *log, int frames)
{
  int seen = 0;
  assert_int_equal(gg_files_frame_log_replay(log, expect, &seen, NULL), GG_OK);
  assert_int_equal(seen, frames);
}

static void append(gg_frame_log *log, int from, int to)
{
  for (int k = from; k < to; k++) {
    planted p;
    gg_frame frame = frame_of(&p, k);
    assert_int_equal(gg_files_frame_log_append(log, &frame, NULL), GG_OK);
  }
}

/* A new file with all frames; marks after each of them. */
static void write_log(const char *at, gg_frame_mark mark[FRAMES + 1])
{
  gg_frame_log log;
  unlink(at);
  assert_int_equal(gg_files_frame_log_open(&log, at, NULL), GG_OK);
  assert_true(log.created);
  mark[0] = log.mark;
  for (int k = 0; k < FRAMES; k++) append(&log, k, k + 1), mark[k + 1] = log.mark;
  holds(&log, FRAMES);
  assert_int_equal(gg_files_frame_log_sync(&log, NULL), GG_OK);
  gg_files_frame_log_close(&log);
  gg_files_frame_log_close(&log);
}

static gg_status open_at(gg_frame_log *log, const gg_frame_mark *mark, gg_error *err)
{
  return gg_files_frame_log_open_at(log, path, mark, NULL, err);
}

static void the_log_is_named_after_the_checkpoint(void **state)
{
  (void)state;
  const char *const pairs[][2] = {{"a/usf.checkpoint.h5", "a/usf.checkpoint.frames"},
                                  {"usf.checkpoint.h5.1", "usf.checkpoint.frames"},
                                  {"x", "x.frames"},
                                  {"v1.1", "v1.frames"},
                                  {".h5", ".h5.frames"}};
  for (int i = 0; i < 5; i++) {
    char *made = gg_files_frame_log_path(pairs[i][0]);
    assert_string_equal(made, pairs[i][1]);
    free(made);
  }
}

static void any_mark(void **state)
{
  (void)state;
  gg_frame_mark mark[FRAMES + 1];
  gg_frame_log log;
  write_log(path, mark);
  for (int k = 0; k <= FRAMES; k++) {
    assert_int_equal(open_at(&log, &mark[k], NULL), GG_OK);
    holds(&log, k);
    gg_files_frame_log_close(&log);
  }
}

/* An older checkpoint was gone on from; the newer one stays good until the file is past it, and then, too. */
static void written_over(void **state)
{
  (void)state;
  gg_frame_mark mark[FRAMES + 1];
  gg_frame_log log, earlier;
  write_log(path, mark);
  assert_int_equal(gg_files_frame_log_open(&log, path, NULL), GG_OK);
  assert_int_equal(open_at(&earlier, &mark[2], NULL), GG_OK);
  assert_int_equal(gg_files_frame_log_take_over(&log, &earlier, NULL), GG_OK);
  gg_files_frame_log_close(&earlier);
  for (int k = 2; k < FRAMES; k++) {
    assert_int_equal(open_at(&earlier, &mark[FRAMES], NULL), GG_OK);
    gg_files_frame_log_close(&earlier);
    append(&log, k, k + 1);
    assert_memory_equal(&log.mark, &mark[k + 1], sizeof log.mark);
  }
  holds(&log, FRAMES);
  assert_false(log.created);
  gg_files_frame_log_close(&log);
}

static void taken_to_another_file(void **state)
{
  (void)state;
  gg_frame_mark mark[FRAMES + 1];
  gg_frame_log log, earlier;
  write_log(path, mark);
  unlink(other);
  assert_int_equal(gg_files_frame_log_open(&log, other, NULL), GG_OK);
  assert_int_equal(open_at(&earlier, &mark[3], NULL), GG_OK);
  assert_int_equal(gg_files_frame_log_take_over(&log, &earlier, NULL), GG_OK);
  gg_files_frame_log_close(&earlier);
  append(&log, 3, FRAMES);
  holds(&log, FRAMES);
  assert_memory_equal(&log.mark, &mark[FRAMES], sizeof log.mark);
  gg_files_frame_log_close(&log);
}

/* The existing log is unchanged until the new one replaces it. */
static void put_in_place(void **state)
{
  (void)state;
  gg_frame_mark mark[FRAMES + 1];
  gg_frame_log log, earlier;
  write_log(path, mark);
  assert_int_equal(gg_files_frame_log_open_new(&log, path, NULL), GG_OK);
  append(&log, 2, FRAMES);
  assert_false(gg_files_frame_log_is_at(&log, path));
  assert_int_equal(open_at(&earlier, &mark[FRAMES], NULL), GG_OK);
  gg_files_frame_log_close(&earlier);
  assert_int_equal(gg_files_frame_log_put_in_place(&log, NULL), GG_OK);
  assert_int_equal(gg_files_frame_log_put_in_place(&log, NULL), GG_OK);
  assert_true(gg_files_frame_log_is_at(&log, path));
  assert_int_equal(open_at(&earlier, &mark[FRAMES], NULL), GG_BAD_FILE);
  assert_int_equal(open_at(&earlier, &log.mark, NULL), GG_OK);
  gg_files_frame_log_close(&earlier);
  gg_files_frame_log_close(&log);
}

static void refuse(const gg_frame_mark *mark, const char *what)
{
  gg_frame_log log;
  gg_error err;
  assert_int_equal(open_at(&log, mark, &err), GG_BAD_FILE);
  if (!strstr(err.message, what)) fail_msg("'%s' is not in '%s'", what, err.message);
  assert_int_equal(log.fd, -1);
}

/* The log is cut at every length, and each byte is changed. */
static void damaged_logs_are_rejected(void **state)
{
  (void)state;
  char text[40];
  gg_frame_mark mark[FRAMES + 1];
  gg_frame_log log;
  write_log(path, mark);
  for (uint64_t at = 0; at < mark[FRAMES].bytes; at++) {
    int k = 1;
    while (at >= mark[k].bytes) k++;
    FILE *f = fopen(path, "r+b");
    assert_true(f && fseek(f, (long)at, SEEK_SET) == 0);
    int byte = fgetc(f);
    fseek(f, (long)at, SEEK_SET);
    fputc(byte ^ (1 << at % 8), f);
    fclose(f);
    snprintf(text, sizeof text, "frame %d of %d is damaged", k, FRAMES);
    refuse(&mark[FRAMES], text);
    assert_int_equal(open_at(&log, &mark[k - 1], NULL), GG_OK); /* the one before does not mind */
    gg_files_frame_log_close(&log);
    f = fopen(path, "r+b");
    fseek(f, (long)at, SEEK_SET);
    fputc(byte, f);
    fclose(f);
  }
  for (uint64_t size = mark[FRAMES].bytes; size-- > 0;) {
    int k = 1;
    while (size >= mark[k].bytes) k++;
    assert_int_equal(truncate(path, (off_t)size), 0);
    snprintf(text, sizeof text, "frame %d of %d is missing", k, FRAMES);
    refuse(&mark[FRAMES], text);
  }
  unlink(path);
  refuse(&mark[1], "cannot be read: No such file");
}

/* A mark of a run whose frames were others. */
static void mark_of_another(void **state)
{
  (void)state;
  gg_frame_mark mark[FRAMES + 1], wrong;
  write_log(path, mark);
  wrong = mark[2], wrong.checksum++;
  refuse(&wrong, "frame 2 of 2 is of another run");
  wrong = mark[2], wrong.bytes = mark[3].bytes;
  refuse(&wrong, "of another run");
  wrong = mark[2], wrong.bytes--;
  refuse(&wrong, "frame 2 of 2 is damaged");
}

/* A mark and a record, checksums right, that claim more grains than bytes can be counted of: the size of the record,
 * counted modulo 2^64, would be that of its header. */
static void overflowing_sizes_are_rejected(void **state)
{
  (void)state;
  const uint64_t grains[] = {UINT64_C(1) << 61, UINT64_C(1) << 40, 3};
  for (size_t k = 0; k < sizeof grains / sizeof *grains; k++) {
    struct {
      char word[8];
      uint64_t bytes, n, holds, step;
      double time, tilt;
      uint64_t checksum;
    } r = {.bytes = sizeof r + grains[k] * 24, .n = grains[k]};
    memcpy(r.word, "GGFRAME", 8);
    r.checksum = gg_base_checksum(GG_CHECKSUM_START, &r, offsetof(__typeof__(r), checksum));
    FILE *f = fopen(path, "wb");
    assert_int_equal(fwrite(&r, sizeof r, 1, f), 1);
    fclose(f);
    refuse(&(gg_frame_mark){1, UINT64_MAX, r.checksum}, k == 0 ? "is damaged" : "is missing");
  }
}

static bool at_the_third(void *context)
{
  return ++*(int *)context == 3;
}

static void reading_a_log_can_be_stopped(void **state)
{
  (void)state;
  int asked = 0;
  gg_frame_mark mark[FRAMES + 1];
  gg_frame_log log;
  write_log(path, mark);
  assert_int_equal(gg_files_frame_log_open_at(&log, path, &mark[FRAMES], &(gg_stop){at_the_third, &asked}, NULL),
                   GG_INTERRUPTED);
  assert_true(asked == 3 && log.fd == -1);
}

/* A frame that does not fit on the disk is not counted. */
static void a_frame_on_a_full_disk_does_not_count(void **state)
{
  (void)state;
  gg_frame_log log;
  gg_error err;
  planted p;
  gg_frame frame = frame_of(&p, 0);
  if (access("/dev/full", W_OK) != 0) skip();
  assert_int_equal(gg_files_frame_log_open(&log, "/dev/full", NULL), GG_OK);
  gg_frame_mark before = log.mark;
  assert_int_equal(gg_files_frame_log_append(&log, &frame, &err), GG_BAD_FILE);
  assert_non_null(strstr(err.message, "/dev/full: cannot be written: No space left"));
  assert_memory_equal(&before, &log.mark, sizeof before);
  gg_files_frame_log_close(&log);
  assert_int_equal(gg_files_frame_log_open(&log, "nowhere/x.frames", &err), GG_BAD_FILE);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(the_log_is_named_after_the_checkpoint),
      cmocka_unit_test(any_mark),
      cmocka_unit_test(written_over),
      cmocka_unit_test(taken_to_another_file),
      cmocka_unit_test(put_in_place),
      cmocka_unit_test(damaged_logs_are_rejected),
      cmocka_unit_test(mark_of_another),
      cmocka_unit_test(overflowing_sizes_are_rejected),
      cmocka_unit_test(reading_a_log_can_be_stopped),
      cmocka_unit_test(a_frame_on_a_full_disk_does_not_count),
  };
  int failed = cmocka_run_group_tests(tests, NULL, NULL);
  unlink(path), unlink(other);
  return failed;
}
