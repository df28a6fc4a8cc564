/* The checksum at the end of result files and checkpoints. A damaged file is refused as a whole: only bytes
 * are read that are known to be those that were written. After the HDF5 file, which does not mind, follow
 *
 *   8 bytes "gg-crc32" | its size, 8 bytes | zlib's crc32 of it, 4 bytes; lowest byte first */
#ifndef GG_SEAL_H
#define GG_SEAL_H

#include <stddef.h>
#include <stdint.h>

#include "base/error.h"

enum { GG_SEAL_SIZE = 20, GG_SEAL_SMALL = 1 << 20 };

/* Of bytes in memory. */
void gg_files_checksum_trailer_of(const void *data, size_t size, unsigned char seal[GG_SEAL_SIZE]);
/* Of a whole file that can be read; errno tells on -1. One pass over it. */
int gg_files_checksum_trailer_of_file(int fd, unsigned char seal[GG_SEAL_SIZE]);
/* NULL: the file is what was written; it is open, and *size says where its checksum begins. Of one of up to
 * GG_SEAL_SMALL bytes *whole has those before its checksum, as they were summed, to be freed; of a larger one it is
 * NULL. Otherwise why it cannot be read. */
const char *gg_files_checksum_trailer_open(const char *path, int *fd, uint64_t *size, unsigned char **whole);

#endif
