/* Files that appear whole or not at all: written under a temporary name in the same folder, flushed to the disk, and
 * renamed. What stands at the path, and what is to become of it, says base/output_path.h. Devices and pipes, for which
 * there is no such thing, are written to as they are. */
#ifndef GG_ATOMIC_FILE_H
#define GG_ATOMIC_FILE_H

#include "base/cancellation.h"
#include "base/error.h"
#include "base/file_lock.h"
#include "base/output_path.h"

typedef struct gg_atomic_file {
  char *path; /* as it was asked for, for messages */
  gg_output_path place;
  char *temporary;   /* NULL of a device or pipe */
  int fd;            /* of the temporary file, which others may open by name and write, too; or of the device or pipe */
  gg_stop stop;      /* of a device or pipe: whoever is told to stop waits no longer for a reader who takes nothing */
  gg_file_lock lock; /* of the place, held until the end; not of a device or pipe */
} gg_atomic_file;

/* GG_BAD_FILE says why the file could not be written there, or which run is writing it. What a dead run left beside it
 * is gone after this call. */
gg_status gg_base_atomic_open(gg_atomic_file *file, const char *path, gg_error *err);
/* The same of a file whose lock the caller holds. */
gg_status gg_base_atomic_open_locked(gg_atomic_file *file, const char *path, gg_error *err);
/* Append to it. */
gg_status gg_base_atomic_write(gg_atomic_file *file, const void *data, size_t size, gg_error *err);
/* Flush, rename, and free; on failure nothing is left. A file that is replaced leaves its mode, and its owner where the
 * system allows it. */
gg_status gg_base_atomic_commit(gg_atomic_file *file, gg_error *err);
/* Remove the temporary file and free; harmless after a commit. */
void gg_base_atomic_abandon(gg_atomic_file *file);

#define GG_ATOMIC_NONE ((gg_atomic_file){.fd = -1, .lock.fd = -1})

/* Could a regular file be written there, not a device or pipe? Asked before a long run, so that it does not end in
 * vain. `why_regular` says what it is for: "pictures are files". */
gg_status gg_base_atomic_check_writable(const char *path, const char *why_regular, gg_error *err);

#endif
