/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Log of the frames of a run that keeps checkpoints, one file beside them. The result's trajectory is made of it at the
 * end, also after interruptions.
 *
 * One record per frame: header, positions, velocities, spins, species; grains in the order of their numbers. The
 * checksums are chained: the last record's covers all records before it. A checkpoint holds a mark: the number of
 * records, of bytes, and their checksum. Bytes beyond the mark are unused and are overwritten; the file is never
 * truncated. A resumed run writes the same frames again, bit for bit. So a run that resumes from an older checkpoint
 * rewrites the same bytes, and the newer checkpoint stays valid. */
#ifndef GG_FRAME_LOG_H
#define GG_FRAME_LOG_H

#include <stdbool.h>

#include "base/cancellation.h"
#include "run/result.h"

typedef struct gg_frame_mark { /* plain data: saved as bytes */
  uint64_t frames, bytes, checksum;
} gg_frame_mark;

typedef struct gg_frame_log {
  char *path;
  char *place;  /* final path; NULL: `path` is final */
  int fd;       /* -1: no log */
  bool created; /* opening created the file */
  gg_frame_mark mark;
} gg_frame_log;

/* "usf.checkpoint.h5", "usf.checkpoint.h5.1" -> "usf.checkpoint.frames"; to be freed. */
char *gg_files_frame_log_path(const char *checkpoint);
/* "usf.checkpoint.frames" -> "usf.checkpoint.frames.new"; to be freed. */
char *gg_files_frame_log_new_path(const char *path);

/* Open the log for writing from the first frame on. An existing file stays unchanged until then. */
gg_status gg_files_frame_log_open(gg_frame_log *log, const char *path, gg_error *err);
/* Open the log of a run that does not resume although PATH exists. It is written to PATH.new, which must not exist;
 * gg_files_frame_log_put_in_place then replaces PATH. Messages name PATH. */
gg_status gg_files_frame_log_open_new(gg_frame_log *log, const char *path, gg_error *err);
gg_status gg_files_frame_log_put_in_place(gg_frame_log *log, gg_error *err);
/* Open the log at a checkpoint's mark and check every frame before it: GG_BAD_FILE if one is missing or damaged,
 * GG_INTERRUPTED if `stop` is set meanwhile. */
gg_status gg_files_frame_log_open_at(gg_frame_log *log, const char *path, const gg_frame_mark *mark,
                                     const gg_stop *stop, gg_error *err);
bool gg_files_frame_log_is_at(const gg_frame_log *log, const char *path);
/* Copy the frames of `from` before those of this log; nothing to do if both are one file. */
gg_status gg_files_frame_log_take_over(gg_frame_log *log, const gg_frame_log *from, gg_error *err);
gg_status gg_files_frame_log_append(gg_frame_log *log, const gg_frame *frame, gg_error *err);
/* Flush the log to the disk (fsync). */
gg_status gg_files_frame_log_sync(const gg_frame_log *log, gg_error *err);
/* Call `visit` for every frame. The frame is valid during the call only. */
typedef gg_status gg_frame_visit(void *context, const gg_frame *frame, gg_error *err);
gg_status gg_files_frame_log_replay(const gg_frame_log *log, gg_frame_visit *visit, void *context, gg_error *err);
/* Safe to call twice, and on a struct that is zero except fd = -1. */
void gg_files_frame_log_close(gg_frame_log *log);

#endif
