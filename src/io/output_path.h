/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The file, device or pipe that an output path refers to. One rule for every output: symbolic links are followed, a
 * regular file is replaced by a whole new one if it is writable, a character device or a pipe is written to directly,
 * anything else is rejected. */
#ifndef GG_OUTPUT_PATH_H
#define GG_OUTPUT_PATH_H

#include <stdbool.h>
#include <sys/stat.h>

#include "base/error.h"

typedef struct gg_output_path {
  char *target;      /* where links lead; to be freed */
  bool stream;       /* a device or a pipe: no file beside it, none in its place */
  bool there;        /* a regular file is: */
  struct stat about; /* what is known of it */
} gg_output_path;

/* GG_BAD_INPUT for an empty name, GG_BAD_FILE with the reason where nothing can be written. */
gg_status gg_io_output_path_find(gg_output_path *place, const char *path, gg_error *err);
void gg_io_output_path_clear(gg_output_path *place);

/* Final target of symbolic links, also if it does not exist; to be freed. NULL: none, or out of memory, which is
 * counted. */
char *gg_io_path_follow_links(const char *path);

/* "PATH: cannot be written: WHY", GG_BAD_FILE. */
gg_status gg_io_path_write_error(const char *path, const char *why, gg_error *err);

/* True if both paths are one file: by device and inode if they exist, otherwise by folder and name. Devices never are.
 * False if out of memory, which is counted. */
bool gg_io_path_is_same_file(const char *a, const char *b);

#endif
