/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Fuzz target: the frame log beside a checkpoint, replayed into the arrays of a result. Input: one byte that selects
 * the model; the mark's number of frames and of bytes (8 bytes each); the log. Checksums of the mark and of all records
 * are made valid. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

#include "base.h"
#include "base/checksum.h"
#include "files/frame_log.h"
#include "files/h5/particles.h"
#include "fuzz.h"
#include "scene/model_of_scene.h"

enum {
  HEADER = 56,
  CHECKSUM = 48,
  BYTES = 8
}; /* header of a record: its size; offsets of its checksum and of its length */

typedef struct place {
  const gg_model *model;
  gg_h5 h;
  gg_h5_particles particles;
} place;

static gg_status take(void *context, const gg_frame *frame, gg_error *err)
{
  place *p = context;
  GG_TRY(gg_run_frame_check(frame, p->model, err));
  gg_h5_particles_append(&p->h, &p->particles, p->model, frame);
  return gg_h5_status(&p->h, "frames", "written", err);
}

/* Write the right checksum into every record that can be reached; returns the last checksum. */
static uint64_t mend(uint8_t *log, size_t size)
{
  uint64_t sum = GG_CHECKSUM_START, bytes;
  for (size_t at = 0; size - at >= HEADER; at += bytes) {
    memcpy(&bytes, log + at + BYTES, sizeof bytes);
    const uint64_t there = bytes < HEADER ? HEADER : bytes > size - at ? size - at : bytes;
    sum = gg_base_checksum(gg_base_checksum(sum, log + at, CHECKSUM), log + at + HEADER, there - HEADER);
    memcpy(log + at + CHECKSUM, &sum, sizeof sum);
    if (bytes < HEADER || bytes > size - at) break;
  }
  return sum;
}

static void make_model(gg_model *model, size_t which)
{
  if (gg_scene_model_make(&fuzz_base_of(which)->scene, fuzz_base_of(which)->scene.engine, model, NULL) != GG_OK)
    abort();
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
  static int fd = -1;
  static gg_model models[FUZZ_BASES];
  static bool made;
  char path[64];
  for (size_t k = 0; k < FUZZ_BASES && !made; k++) make_model(&models[k], k);
  made = true;
  if (fd < 0) fd = memfd_create("graingas-fuzz", MFD_CLOEXEC);
  if (size < 17 || fd < 0) return 0;
  const size_t length = size - 17;
  uint8_t *log = malloc(length + 1);
  if (!log) return 0;
  memcpy(log, data + 17, length);
  gg_frame_mark mark;
  memcpy(&mark.frames, data + 1, 8);
  memcpy(&mark.bytes, data + 9, 8);
  mark.checksum = mend(log, length);
  snprintf(path, sizeof path, "/proc/self/fd/%d", fd);
  if (ftruncate(fd, (off_t)length) != 0 || pwrite(fd, log, length, 0) != (ssize_t)length) abort();
  free(log);
  gg_frame_log opened;
  place p = {.model = &models[data[0] % FUZZ_BASES]};
  if (gg_files_frame_log_open_at(&opened, path, &mark, NULL, NULL) != GG_OK) return 0;
  gg_h5_create(&p.h, NULL);
  gg_files_frame_log_replay(&opened, take, &p, NULL);
  gg_h5_particles_close(&p.h, &p.particles);
  gg_h5_close(&p.h);
  gg_files_frame_log_close(&opened);
  return 0;
}
