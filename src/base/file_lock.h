/* One writer a file: while it is held, PATH.graingas-lock stands beside PATH and says who holds it. The system takes
 * the lock from a process that ends in whatever way, so that what a dead one left behind never blocks. */
#ifndef GG_FILE_LOCK_H
#define GG_FILE_LOCK_H

#include <stdbool.h>

#include "base/error.h"

#define GG_LOCK_SUFFIX ".graingas-lock"

typedef struct gg_file_lock {
  char *path;
  int fd;    /* -1: not held ... */
  bool busy; /* ... because another run holds it */
} gg_file_lock;

#define GG_FILE_LOCK_NONE ((gg_file_lock){.fd = -1})

#define GG_TEMPORARY_SUFFIX ".graingas-tmp"

/* `target` is locked, `path` stands in messages. GG_BAD_FILE if another run holds it, or if its folder takes no files.
 * The temporary file that a dead run left beside it is removed, unless the file system has no locks: it may be that of
 * one that lives. */
gg_status gg_base_file_lock_take(gg_file_lock *lock, const char *target, const char *path, gg_error *err);
/* Harmless if it is not held. */
void gg_base_file_lock_release(gg_file_lock *lock);

#endif
