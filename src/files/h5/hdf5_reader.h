/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Result files and checkpoints, read. HDF5 itself is not safe from files that somebody made to harm: they are read here
 * instead, and HDF5 never sees one. graingas writes a small part of HDF5's format, which is read and checked word by
 * word: version 0 of the superblock, old groups and object headers, arrays in one piece or in chunks, numbers and texts
 * of fixed length. Other programs repack files: chunks may be compressed by gzip, shuffled and have checksums. Other
 * objects are ignored. A requested object of another kind (of variable length, in a newer format, compressed otherwise)
 * is refused by name. Nothing takes more memory than the file has bytes; compressed data up to 32 times as many, or 64
 * MB.
 *
 * The first failure sticks: later calls do nothing, and gg_h5_in_status reports it. */
#ifndef GG_H5_READER_H
#define GG_H5_READER_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/archive.h"
#include "base/error.h"

enum { GG_H5_WINDOW = 4096, GG_H5_LONGEST = 160, GG_H5_DEEPEST = 8 };

/* The last lookup: the next one mostly is in the same group. */
typedef struct gg_h5_trail {
  char path[GG_H5_LONGEST];
  int depth;
  size_t end[GG_H5_DEEPEST];                /* of the path up to its k-th object */
  uint64_t at[GG_H5_DEEPEST];               /* the header of that */
  uint64_t group, tree, names, names_bytes; /* the last group that was opened: its header, and what that says */
} gg_h5_trail;

typedef struct gg_h5_in {
  int fd;
  uint64_t size, root;  /* of the HDF5 file; the header of its root group */
  bool failed, changed; /* changed: another program wrote it, so that it has no checksum */
  char why[256];
  const unsigned char *whole; /* all of it; NULL: it is too large for that */
  unsigned char *own;         /* what of that is to be freed */
  uint64_t window_at;         /* what was read last of what is small */
  size_t window_n;
  unsigned char window[GG_H5_WINDOW];
  gg_h5_trail trail;
} gg_h5_in;

/* The file's checksum is checked first (checksum_trailer.h). To be closed, also after a failure. `any`: also a file
 * that ends without one: another program has changed it, if it is as long as its superblock says. */
void gg_h5_open(gg_h5_in *in, const char *path, bool any);
/* A file that is in memory, with its checksum; the bytes are borrowed. */
void gg_h5_open_bytes(gg_h5_in *in, const void *bytes, size_t size);
void gg_h5_in_close(gg_h5_in *in);
/* GG_BAD_FILE "path: cannot be read: why" if anything failed. */
gg_status gg_h5_in_status(const gg_h5_in *in, const char *path, gg_error *err);
/* Record a failure that the caller found. */
void gg_h5_in_failed(gg_h5_in *in, const char *why);

bool gg_h5_exists(gg_h5_in *in, const char *path);
/* Text or all numbers of an array, converted to the type, to be freed; NULL on failure. */
char *gg_h5_read_text(gg_h5_in *in, const char *path);
void *gg_h5_read_array(gg_h5_in *in, const char *path, gg_item_type type, size_t *count);
/* How many numbers an array has; 0: it is not there. */
size_t gg_h5_count_of(gg_h5_in *in, const char *path);
/* The k-th row (from 0) of an array that grows, `items` of them; to be freed, NULL on failure. */
#define GG_H5_LAST UINT64_MAX
void *gg_h5_read_row(gg_h5_in *in, const char *path, uint64_t k, gg_item_type type, size_t items);

bool gg_h5_has_attribute(gg_h5_in *in, const char *object, const char *name);
char *gg_h5_read_text_attribute(gg_h5_in *in, const char *object, const char *name);
/* `n` texts of one length each: their first letters. */
void gg_h5_read_initials(gg_h5_in *in, const char *object, const char *name, char *letters, size_t n);
/* One number. */
void gg_h5_read_attribute(gg_h5_in *in, const char *object, const char *name, gg_item_type type, void *value);

#endif
