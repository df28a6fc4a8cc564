/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "files/frame_log.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/checksum.h"
#include "base/memory.h"
#include "io/output_path.h"

enum { POSITIONS = 1, SPINS = 2, SPECIES = 4, IMAGES = 8, ALL = 15 };
static const char word[8] = "GGFRAME";

typedef struct record { /* header of a frame, in the byte order of the machine */
  char word[8];
  uint64_t bytes, n, holds, step;
  double time, tilt;
  uint64_t checksum; /* over the checksum of the record before, this header up to here, and the data after it */
} record;

static uint64_t size_of(uint64_t n, uint64_t holds)
{
  uint64_t vectors = 1 + (holds & POSITIONS ? 1 : 0) + (holds & SPINS ? 1 : 0) + (holds & IMAGES ? 1 : 0);
  return sizeof(record) + n * (vectors * 3 * sizeof(double) + (holds & SPECIES ? 1 : 0));
}

static uint64_t checksum_of(const void *whole, uint64_t before)
{
  const record *r = whole;
  uint64_t sum = gg_base_checksum(before, r, offsetof(record, checksum));
  return gg_base_checksum(sum, r + 1, r->bytes - sizeof *r);
}

char *gg_files_frame_log_path(const char *checkpoint)
{
  static const char *const endings[] = {".1", ".h5"};
  size_t length = strlen(checkpoint);
  char *path = NULL;
  for (int i = 0; i < 2; i++) {
    size_t end = strlen(endings[i]);
    if (length > end && strncmp(checkpoint + length - end, endings[i], end) == 0) length -= end;
  }
  return asprintf(&path, "%.*s.frames", (int)length, checkpoint) < 0 ? NULL : path;
}

char *gg_files_frame_log_new_path(const char *path)
{
  char *fresh = NULL;
  return asprintf(&fresh, "%s.new", path) < 0 ? NULL : fresh;
}

static gg_status open_file(gg_frame_log *log, const char *path, int flags)
{
  *log = (gg_frame_log){.path = strdup(path), .mark.checksum = GG_CHECKSUM_START};
  log->fd = log->path ? open(path, flags | O_CLOEXEC, 0666) : -1;
  return log->fd < 0 ? GG_BAD_FILE : GG_OK;
}

static gg_status cannot_write(const gg_frame_log *log, gg_error *err)
{
  return gg_io_path_write_error(log->place ? log->place : log->path, strerror(errno), err);
}

gg_status gg_files_frame_log_open(gg_frame_log *log, const char *path, gg_error *err)
{
  bool there = access(path, F_OK) == 0;
  if (open_file(log, path, O_RDWR | O_CREAT) == GG_OK) {
    log->created = !there;
    return GG_OK;
  }
  gg_status status = log->path ? cannot_write(log, err) : gg_base_out_of_memory(err);
  gg_files_frame_log_close(log);
  return status;
}

gg_status gg_files_frame_log_open_new(gg_frame_log *log, const char *path, gg_error *err)
{
  GG_FREED char *fresh = gg_files_frame_log_new_path(path);
  char *place = strdup(path);
  bool made = fresh && place && open_file(log, fresh, O_RDWR | O_CREAT | O_EXCL) == GG_OK;
  gg_status status = made ? GG_OK : gg_io_path_write_error(path, strerror(errno), err);
  if (!fresh || !place) *log = (gg_frame_log){.fd = -1};
  log->place = place;
  log->created = made;
  if (!made) gg_files_frame_log_close(log);
  return status;
}

gg_status gg_files_frame_log_put_in_place(gg_frame_log *log, gg_error *err)
{
  if (!log->place) return GG_OK;
  if (rename(log->path, log->place) != 0) return cannot_write(log, err);
  free(log->path);
  log->path = log->place;
  log->place = NULL;
  return GG_OK;
}

static gg_status write_at(const gg_frame_log *log, const void *data, size_t size, uint64_t at, gg_error *err)
{
  const char *from = data;
  while (size > 0) {
    ssize_t done = pwrite(log->fd, from, size, (off_t)at);
    if (done < 0 && errno == EINTR) continue;
    if (done < 0) return cannot_write(log, err);
    from += done, size -= (size_t)done, at += (uint64_t)done;
  }
  return GG_OK;
}

/* False where the file ends before. */
static bool read_at(const gg_frame_log *log, void *data, size_t size, uint64_t at)
{
  char *to = data;
  while (size > 0) {
    ssize_t done = pread(log->fd, to, size, (off_t)at);
    if (done < 0 && errno == EINTR) continue;
    if (done <= 0) return false;
    to += done, size -= (size_t)done, at += (uint64_t)done;
  }
  return true;
}

static void *put_vectors(double *to, const double *from, const size_t *order, size_t n)
{
  if (!from) return to;
  for (size_t i = 0; i < n; i++) memcpy(to + 3 * i, from + 3 * order[i], 3 * sizeof *to);
  return to + 3 * n;
}

static void fill(record *r, const gg_frame *frame, const size_t *order, uint64_t before)
{
  double *vectors = put_vectors((double *)(r + 1), frame->position, order, frame->n);
  vectors = put_vectors(vectors, frame->velocity, order, frame->n);
  vectors = put_vectors(vectors, frame->spin, order, frame->n);
  uint8_t *species = put_vectors(vectors, frame->image, order, frame->n);
  for (size_t i = 0; frame->species && i < frame->n; i++) species[i] = frame->species[order[i]];
  r->checksum = checksum_of(r, before);
}

gg_status gg_files_frame_log_append(gg_frame_log *log, const gg_frame *frame, gg_error *err)
{
  uint64_t holds = (frame->position ? POSITIONS : 0u) | (frame->spin ? SPINS : 0u) | (frame->species ? SPECIES : 0u) |
                   (frame->image ? IMAGES : 0u);
  record header = {.n = frame->n, .holds = holds, .step = frame->step, .time = frame->time, .tilt = frame->tilt};
  header.bytes = size_of(frame->n, holds);
  memcpy(header.word, word, sizeof word);
  GG_FREED size_t *order = gg_measure_frame_order(frame, err);
  GG_FREED record *r = order ? gg_base_array_new(header.bytes, 1, err) : NULL;
  if (!r) return GG_FAILED;
  *r = header;
  fill(r, frame, order, log->mark.checksum);
  GG_TRY(write_at(log, r, r->bytes, log->mark.bytes, err));
  log->mark = (gg_frame_mark){log->mark.frames + 1, log->mark.bytes + r->bytes, r->checksum};
  return GG_OK;
}

gg_status gg_files_frame_log_sync(const gg_frame_log *log, gg_error *err)
{
  return fdatasync(log->fd) == 0 ? GG_OK : cannot_write(log, err);
}

typedef struct reader {
  gg_frame_mark at; /* read so far */
  record *whole;    /* the latest */
  uint64_t room;
} reader;

/* The next record: NULL, or what is wrong with it. */
static const char *read_next(const gg_frame_log *log, reader *r)
{
  record header;
  struct stat about;
  if (!read_at(log, &header, sizeof header, r->at.bytes) || fstat(log->fd, &about) != 0) return "missing";
  uint64_t left = log->mark.bytes - r->at.bytes, there = (uint64_t)about.st_size - r->at.bytes;
  /* A crafted mark may claim more bytes than there is memory, or a number of grains whose size in bytes overflows. */
  bool fits = memcmp(header.word, word, sizeof word) == 0 && header.n <= left && header.n <= INT64_MAX / 128 &&
              header.holds <= ALL && header.bytes == size_of(header.n, header.holds) && header.bytes <= left;
  if (!fits) return "damaged";
  if (header.bytes > there) return "missing"; /* before memory is allocated for it */
  if (header.bytes > r->room) {
    free(r->whole);
    r->whole = malloc(header.bytes);
    r->room = r->whole ? header.bytes : 0;
    if (!r->whole) return "too large for the memory";
  }
  if (!read_at(log, r->whole, header.bytes, r->at.bytes)) return "missing";
  if (checksum_of(r->whole, r->at.checksum) != r->whole->checksum) return "damaged";
  r->at = (gg_frame_mark){r->at.frames + 1, r->at.bytes + header.bytes, r->whole->checksum};
  return NULL;
}

static gg_frame frame_of(record *r)
{
  size_t n = r->n;
  double *vectors = (double *)(r + 1);
  gg_frame frame = {.time = r->time, .step = r->step, .n = n, .tilt = r->tilt};
  if (r->holds & POSITIONS) frame.position = vectors, vectors += 3 * n;
  frame.velocity = vectors, vectors += 3 * n;
  if (r->holds & SPINS) frame.spin = vectors, vectors += 3 * n;
  if (r->holds & IMAGES) frame.image = vectors, vectors += 3 * n;
  if (r->holds & SPECIES) frame.species = (uint8_t *)vectors;
  return frame;
}

gg_status gg_files_frame_log_replay(const gg_frame_log *log, gg_frame_visit *visit, void *context, gg_error *err)
{
  reader r = {.at.checksum = GG_CHECKSUM_START};
  gg_status status = GG_OK;
  const char *wrong = NULL;
  while (status == GG_OK && r.at.frames < log->mark.frames && !(wrong = read_next(log, &r))) {
    gg_frame frame = frame_of(r.whole);
    status = visit(context, &frame, err);
  }
  if (!wrong && status == GG_OK && (r.at.bytes != log->mark.bytes || r.at.checksum != log->mark.checksum))
    wrong = "of another run";
  if (wrong)
    status = gg_base_fail(err, GG_BAD_FILE, "%s: frame %llu of %llu is %s", log->path,
                          (unsigned long long)r.at.frames + (r.at.frames < log->mark.frames),
                          (unsigned long long)log->mark.frames, wrong);
  free(r.whole);
  return status;
}

static gg_status ask(void *stop, const gg_frame *frame, gg_error *err)
{
  (void)frame;
  return gg_stop_asked(*(const gg_stop **)stop) ? gg_base_fail(err, GG_INTERRUPTED, "interrupted") : GG_OK;
}

gg_status gg_files_frame_log_open_at(gg_frame_log *log, const char *path, const gg_frame_mark *mark,
                                     const gg_stop *stop, gg_error *err)
{
  gg_status status = open_file(log, path, O_RDONLY);
  log->mark = *mark;
  if (status != GG_OK)
    gg_base_fail(err, status, "%s: cannot be read: %s", path, strerror(errno));
  else
    status = gg_files_frame_log_replay(log, ask, &stop, err);
  if (status != GG_OK) gg_files_frame_log_close(log);
  return status;
}

bool gg_files_frame_log_is_at(const gg_frame_log *log, const char *path)
{
  struct stat mine, there;
  return fstat(log->fd, &mine) == 0 && stat(path, &there) == 0 && mine.st_dev == there.st_dev &&
         mine.st_ino == there.st_ino;
}

static gg_status copy_bytes(gg_frame_log *log, const gg_frame_log *from, gg_error *err)
{
  enum { PIECE = 1 << 20 };
  GG_FREED char *piece = gg_base_array_new(PIECE, 1, err);
  if (!piece) return GG_FAILED;
  for (uint64_t at = 0; at < from->mark.bytes; at += PIECE) {
    uint64_t left = from->mark.bytes - at;
    size_t size = left < PIECE ? (size_t)left : PIECE;
    if (!read_at(from, piece, size, at)) return gg_base_fail(err, GG_BAD_FILE, "%s: cannot be read", from->path);
    GG_TRY(write_at(log, piece, size, at, err));
  }
  return GG_OK;
}

gg_status gg_files_frame_log_take_over(gg_frame_log *log, const gg_frame_log *from, gg_error *err)
{
  if (!gg_files_frame_log_is_at(from, log->path)) GG_TRY(copy_bytes(log, from, err));
  log->mark = from->mark;
  return GG_OK;
}

void gg_files_frame_log_close(gg_frame_log *log)
{
  if (log->fd >= 0) close(log->fd);
  free(log->path);
  free(log->place);
  *log = (gg_frame_log){.fd = -1};
}
