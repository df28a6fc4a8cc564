/* Files that appear whole or not at all: written under a temporary name in the same folder, flushed to the disk, and
 * renamed. */
#ifndef GG_ATOMIC_FILE_H
#define GG_ATOMIC_FILE_H

#include "common/error.h"

typedef struct gg_atomic_file {
  char *path, *temporary;
  int fd; /* of the temporary file, which others may open by name and write, too */
} gg_atomic_file;

/* GG_BAD_FILE says why the file could not be written there. */
gg_status gg_atomic_open(gg_atomic_file *file, const char *path, gg_error *err);
/* Append to it. */
gg_status gg_atomic_write(gg_atomic_file *file, const void *data, size_t size, gg_error *err);
/* Flush, rename, and free; on failure nothing is left. */
gg_status gg_atomic_commit(gg_atomic_file *file, gg_error *err);
/* Remove the temporary file and free; harmless after a commit. */
void gg_atomic_abandon(gg_atomic_file *file);

/* Could a file be written there? Asked before a long run, so that it does not end in vain. */
gg_status gg_check_writable(const char *path, gg_error *err);

#endif
