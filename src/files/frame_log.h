/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The frames of a run that keeps checkpoints, in one file beside them: what a resumed run has before it, and what
 * becomes the trajectory in the result at the end.
 *
 * A record a frame: header, positions, velocities, spins, species; grains in the order of their numbers. Checksums are
 * a chain: that of the last record vouches for all before it. A checkpoint holds a mark: how many records, bytes, and
 * their checksum. Bytes beyond the mark are unused and are overwritten; the file is never cut. For the frames of a run
 * are the same however often it is resumed: going on from an older checkpoint writes the bytes that are there already,
 * and the newer one stays good. */
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
  char *place;  /* where it is to be put; NULL: it is there */
  int fd;       /* -1: no log */
  bool created; /* by the opening: there was no such file */
  gg_frame_mark mark;
} gg_frame_log;

/* "usf.checkpoint.h5", "usf.checkpoint.h5.1" -> "usf.checkpoint.frames"; to be freed. */
char *gg_files_frame_log_path(const char *checkpoint);
/* "usf.checkpoint.frames" -> "usf.checkpoint.frames.new"; to be freed. */
char *gg_files_frame_log_new_path(const char *path);

/* To write there from the first frame on; a file that is there stays as it is until then. */
gg_status gg_files_frame_log_open(gg_frame_log *log, const char *path, gg_error *err);
/* The log of a run that does not resume from what is there: written as PATH.new, where none may be, until it is put in
 * the place of the log of another run. Messages name PATH. */
gg_status gg_files_frame_log_open_new(gg_frame_log *log, const char *path, gg_error *err);
gg_status gg_files_frame_log_put_in_place(gg_frame_log *log, gg_error *err);
/* To read the frames up to the mark, each of which is checked: GG_BAD_FILE where one is missing or damaged. `stop` is
 * asked in between: GG_INTERRUPTED. */
gg_status gg_files_frame_log_open_at(gg_frame_log *log, const char *path, const gg_frame_mark *mark,
                                     const gg_stop *stop, gg_error *err);
/* Does the log stand at this path? */
bool gg_files_frame_log_is_at(const gg_frame_log *log, const char *path);
/* Copy the frames of `from` before those of this log; nothing to do if both are one file. */
gg_status gg_files_frame_log_take_over(gg_frame_log *log, const gg_frame_log *from, gg_error *err);
gg_status gg_files_frame_log_append(gg_frame_log *log, const gg_frame *frame, gg_error *err);
/* Wait until the disk has all of it. */
gg_status gg_files_frame_log_sync(const gg_frame_log *log, gg_error *err);
/* Show every frame; each lasts for the call. */
typedef gg_status gg_frame_visit(void *context, const gg_frame *frame, gg_error *err);
gg_status gg_files_frame_log_replay(const gg_frame_log *log, gg_frame_visit *visit, void *context, gg_error *err);
/* Harmless again, and of one that is all zero but fd = -1. */
void gg_files_frame_log_close(gg_frame_log *log);

#endif
