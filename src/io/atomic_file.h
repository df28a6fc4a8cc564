/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Files that appear whole or not at all: written under a temporary name in the same folder, flushed to the disk, and
 * renamed. io/output_path.h decides what happens to an existing file at the path. Devices and pipes are written to
 * directly. */
#ifndef GG_ATOMIC_FILE_H
#define GG_ATOMIC_FILE_H

#include <stdbool.h>

#include "base/cancellation.h"
#include "base/error.h"
#include "io/output_path.h"

#define GG_LOCK_SUFFIX ".graingas-lock"

/* One writer per file: while the lock is held, PATH.graingas-lock beside PATH names the holder. The system releases the
 * lock of a process that ends in any way, so a dead process never blocks. */
typedef struct gg_file_lock {
  char *path;
  int fd;    /* -1: not held ... */
  bool busy; /* ... because another run holds it */
} gg_file_lock;

#define GG_FILE_LOCK_NONE ((gg_file_lock){.fd = -1})

#define GG_TEMPORARY_SUFFIX ".graingas-tmp"
#define GG_KEPT_SUFFIX ".graingas-kept" /* a temporary file whole but for its name */

/* `target` is locked, `path` is the name in messages. GG_BAD_FILE if another run holds the lock, or if the folder is
 * not writable. The temporary file of a dead run is removed, unless the file system has no locks: then the run may be
 * alive. */
gg_status gg_io_file_lock_take(gg_file_lock *lock, const char *target, const char *path, gg_error *err);
/* Harmless if it is not held. */
void gg_io_file_lock_release(gg_file_lock *lock);

typedef struct gg_atomic_file {
  char *path; /* as given, for messages */
  gg_output_path place;
  char *temporary;   /* NULL of a device or pipe */
  int fd;            /* of the temporary file, which others may open by name and write, too; or of the device or pipe */
  gg_stop stop;      /* device or pipe: after a stop request writes do not wait for a stalled reader */
  gg_file_lock lock; /* held until the file is closed; none for a device or pipe */
  bool repeated;     /* written again and again (checkpoints): not kept if it cannot be put in place */
} gg_atomic_file;

/* GG_BAD_FILE says why the file could not be written there, or which run is writing it. Temporary files that a dead run
 * left are removed. `locked`: the caller holds its lock. */
gg_status gg_io_atomic_open(gg_atomic_file *file, const char *path, bool locked, gg_error *err);
gg_status gg_io_atomic_write(gg_atomic_file *file, const void *data, size_t size, gg_error *err);
/* Flush, rename, and free, if `status`, that of the writing, is GG_OK; abandon the file otherwise. On failure the
 * temporary file stays, unless `repeated`, and the message names it. A file that is replaced leaves its mode, and its
 * owner where the system allows it. */
gg_status gg_io_atomic_commit(gg_atomic_file *file, gg_status status, gg_error *err);
/* Remove the temporary file and free; harmless after a commit. */
void gg_io_atomic_abandon(gg_atomic_file *file);

#define GG_ATOMIC_NONE ((gg_atomic_file){.fd = -1, .lock.fd = -1})

/* Check that a regular file, not a device or pipe, can be written there; called before a long run, so that its result
 * is not lost. `why_regular` gives the reason: "pictures are files". */
gg_status gg_io_atomic_check_writable(const char *path, const char *why_regular, gg_error *err);

#endif
