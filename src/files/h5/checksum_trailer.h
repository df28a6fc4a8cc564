/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The checksum at the end of result files and checkpoints. A damaged file is refused as a whole: only bytes
 * are read that are known to be those that were written. After the HDF5 file, which does not mind, follow
 *
 *   8 bytes "gg-crc32" | its size, 8 bytes | zlib's crc32 of it, 4 bytes; lowest byte first */
#ifndef GG_CHECKSUM_TRAILER_H
#define GG_CHECKSUM_TRAILER_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "io/atomic_file.h"

enum { GG_TRAILER_SIZE = 20, GG_TRAILER_SMALL = 1 << 20 };

void gg_files_checksum_trailer_of(const void *data, size_t size, unsigned char trailer[GG_TRAILER_SIZE]);
/* Bytes in memory with their checksum into a file; `stop` (may be NULL) is polled for each megabyte. */
gg_status gg_files_checksum_trailer_write(gg_atomic_file *file, const void *data, size_t size, const gg_stop *stop,
                                          gg_error *err);
/* The bytes with their checksum behind them, to be freed. */
void *gg_files_checksum_trailer_append(void *data, size_t size, gg_error *err);
/* Likewise read: NULL if they are what was written, with the size before the checksum; otherwise why not. */
const char *gg_files_checksum_trailer_check(const void *data, size_t size, uint64_t *before);
/* Trailer of a whole readable file, in one pass; -1 with the reason in errno. */
int gg_files_checksum_trailer_of_file(int fd, unsigned char trailer[GG_TRAILER_SIZE]);
/* NULL: the file is what was written, or *bare: it ends without a checksum. It is open, and *size says where its
 * checksum begins. For a file of up to GG_TRAILER_SMALL bytes *whole has the bytes before its checksum, to be freed;
 * for a larger one it is NULL. Otherwise the reason why the file cannot be read. */
const char *gg_files_checksum_trailer_open(const char *path, int *fd, uint64_t *size, unsigned char **whole,
                                           bool *bare);

#endif
