/* What stands where a file is to be written. One place decides for every output: a symbolic link is followed, a regular
 * file is replaced by a whole new one if its owner lets it be written, a character device or a pipe is written to as it
 * is; anything else is refused. */
#ifndef GG_OUTPUT_PATH_H
#define GG_OUTPUT_PATH_H

#include <stdbool.h>
#include <sys/stat.h>

#include "base/error.h"

typedef struct gg_output_path {
  char *target;      /* where links lead; to be freed */
  bool stream;       /* a device or a pipe: nothing can stand beside it or take its place */
  bool there;        /* a regular file is: */
  struct stat about; /* what is known of it */
} gg_output_path;

/* GG_BAD_INPUT for an empty name, GG_BAD_FILE with the reason where nothing can be written. */
gg_status gg_base_output_path_find(gg_output_path *place, const char *path, gg_error *err);
void gg_base_output_path_clear(gg_output_path *place);

/* Where symbolic links lead in the end, also if nothing stands there; to be freed. NULL: nowhere, or out of memory,
 * which is noted. */
char *gg_base_path_follow_links(const char *path);

/* "PATH: cannot be written: WHY", GG_BAD_FILE. */
gg_status gg_base_path_write_error(const char *path, const char *why, gg_error *err);

/* Would both be one file? By what stands there, or where nothing does, by folder and name. Devices are never one.
 * Not for want of memory, which is noted. */
bool gg_base_path_is_same_file(const char *a, const char *b);

#endif
