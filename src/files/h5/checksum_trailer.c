/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "files/h5/checksum_trailer.h"

#include <errno.h>
#include <fcntl.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>

#include "base/memory.h"

enum { BLOCK = GG_TRAILER_SMALL };
static const char hdf5[8] = "\x89HDF\r\n\x1a\n", mark[8] = {'g', 'g', '-', 'c', 'r', 'c', '3', '2'};

static void put(unsigned char *to, uint64_t value, int bytes)
{
  for (int i = 0; i < bytes; i++) to[i] = (unsigned char)(value >> 8 * i);
}

static void fill(unsigned char *trailer, uint64_t size, uint64_t sum)
{
  memcpy(trailer, mark, sizeof mark);
  put(trailer + 8, size, 8);
  put(trailer + 16, sum, 4);
}

void gg_files_checksum_trailer_of(const void *data, size_t size, unsigned char trailer[GG_TRAILER_SIZE])
{
  const unsigned char *at = data;
  uLong sum = crc32(0, NULL, 0);
  for (size_t left = size, now; left > 0; at += now, left -= now) {
    now = left < BLOCK ? left : BLOCK;
    sum = crc32(sum, at, (uInt)now);
  }
  fill(trailer, size, sum);
}

gg_status gg_files_checksum_trailer_write(gg_atomic_file *file, const void *data, size_t size, const gg_stop *stop,
                                          gg_error *err)
{
  unsigned char trailer[GG_TRAILER_SIZE];
  const unsigned char *at = data;
  uLong sum = crc32(0, NULL, 0);
  for (size_t left = size, now; left > 0; at += now, left -= now) {
    now = left < BLOCK ? left : BLOCK;
    if (stop && gg_stop_asked(stop)) return gg_base_fail(err, GG_INTERRUPTED, "%s: interrupted", file->path);
    sum = crc32(sum, at, (uInt)now);
    GG_TRY(gg_io_atomic_write(file, at, now, err));
  }
  fill(trailer, size, sum);
  return gg_io_atomic_write(file, trailer, sizeof trailer, err);
}

void *gg_files_checksum_trailer_append(void *data, size_t size, gg_error *err)
{
  unsigned char *all = realloc(data, size + GG_TRAILER_SIZE);
  if (all)
    gg_files_checksum_trailer_of(all, size, all + size);
  else
    gg_base_out_of_memory(err), free(data);
  return all;
}

const char *gg_files_checksum_trailer_check(const void *data, size_t size, uint64_t *before)
{
  unsigned char wanted[GG_TRAILER_SIZE];
  if (size < GG_TRAILER_SIZE + sizeof hdf5 || memcmp(data, hdf5, sizeof hdf5) != 0)
    return "they are no image of a file of graingas, or a damaged one";
  *before = size - GG_TRAILER_SIZE;
  gg_files_checksum_trailer_of(data, size - GG_TRAILER_SIZE, wanted);
  const unsigned char *there = (const unsigned char *)data + *before;
  return memcmp(there, wanted, sizeof wanted) == 0 ? NULL : "their checksum does not match: they are damaged";
}

/* Checksum of the first `size` bytes. The block that holds them, if they are few, is to be freed by the caller. */
static int sum_up(int fd, off_t size, unsigned char *trailer, unsigned char **block)
{
  uLong sum = crc32(0, NULL, 0);
  off_t at = 0;
  *block = malloc(size >= BLOCK ? BLOCK : size ? (size_t)size : 1);
  while (*block && at < size) {
    const off_t from = at % BLOCK, now = size - at < BLOCK - from ? size - at : BLOCK - from;
    ssize_t got = pread(fd, *block + from, (size_t)now, at);
    if (got > 0) {
      sum = crc32(sum, *block + from, (uInt)got);
      at += got;
    } else if (got == 0 || errno != EINTR) {
      if (got == 0) errno = EIO; /* it was shortened while graingas read it */
      break;
    }
  }
  fill(trailer, (uint64_t)size, sum);
  return *block && at == size ? 0 : -1;
}

int gg_files_checksum_trailer_of_file(int fd, unsigned char trailer[GG_TRAILER_SIZE])
{
  struct stat about;
  GG_FREED unsigned char *block = NULL;
  return fstat(fd, &about) == 0 ? sum_up(fd, about.st_size, trailer, &block) : -1;
}

static const char *broken(int fd, uint64_t *size_of, unsigned char **block, bool *bare)
{
  struct stat about;
  unsigned char there[GG_TRAILER_SIZE], wanted[GG_TRAILER_SIZE], start[sizeof hdf5];
  if (fstat(fd, &about) != 0) return strerror(errno);
  if (!S_ISREG(about.st_mode)) return "it is not a regular file";
  if (pread(fd, start, sizeof start, 0) != sizeof start || memcmp(start, hdf5, sizeof start) != 0)
    return "it is not an HDF5 file, or a damaged one";
  off_t size = about.st_size - GG_TRAILER_SIZE;
  *bare =
      size < 0 || pread(fd, there, GG_TRAILER_SIZE, size) != GG_TRAILER_SIZE || memcmp(there, mark, sizeof mark) != 0;
  if (*bare) size = about.st_size;
  if (sum_up(fd, size, wanted, block) != 0) return strerror(errno);
  *size_of = (uint64_t)size;
  return *bare || memcmp(there, wanted, sizeof there) == 0 ? NULL : "its checksum does not match: it is damaged";
}

const char *gg_files_checksum_trailer_open(const char *path, int *fd, uint64_t *size, unsigned char **whole, bool *bare)
{
  GG_FREED unsigned char *block = NULL;
  *whole = NULL;
  if (!*path) return "the name is empty";
  int opened = open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (opened < 0) return strerror(errno);
  const char *why = broken(opened, size, &block, bare);
  if (why) return close(opened), why;
  *fd = opened;
  if (*size <= GG_TRAILER_SMALL) GG_HAND_OVER(whole, block);
  return NULL;
}
