/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Chunks that another program has compressed, as h5repack and h5py do: gzip, shuffled bytes, checksums. */
#include <stdlib.h>
#include <string.h>
#include <zlib.h>

#include "base/memory.h"
#include "files/h5/hdf5_format.h"

static const char other_filter[] =
    "is compressed by another filter than gzip, which graingas does not read (h5repack -f NONE undoes it)";

/* Bytes that describe a filter: number, length of its name, flags, number of parameters; then name and parameters. */
static size_t size_of_filter(const unsigned char *at, size_t left, unsigned version)
{
  const bool named = version == 1 || gg_h5_word(at, 2) >= 256;
  const size_t head = named ? 8 : 6;
  if (left < head) return 0;
  const size_t name = named ? gg_h5_word(at + 2, 2) : 0, parameters = gg_h5_word(at + head - 2, 2);
  const size_t padded = version == 1 ? (name + 7) / 8 * 8 : name, odd = version == 1 ? parameters % 2 : 0;
  const size_t all = head + padded + 4 * (parameters + odd);
  return all <= left ? all : 0;
}

const char *gg_h5_filters_of(const unsigned char *data, size_t size, gg_h5_array_in *a)
{
  if (size < 8 || (data[0] != 1 && data[0] != 2)) return "is damaged";
  const size_t head = data[0] == 1 ? 8 : 2;
  const unsigned char *at = data + head;
  size_t left = size - head;
  if (data[1] > GG_H5_MOST_FILTERS) return other_filter;
  for (a->n_filters = 0; a->n_filters < data[1]; a->n_filters++) {
    const size_t length = left >= 6 ? size_of_filter(at, left, data[0]) : 0;
    if (!length) return "is damaged";
    const unsigned number = (unsigned)gg_h5_word(at, 2);
    if (number < GG_H5_GZIP || number > GG_H5_FLETCHER32) return other_filter;
    a->filter[a->n_filters] = number;
    at += length, left -= length;
  }
  return NULL;
}

/* At most `room` bytes; 0: these are no gzip data, or more. The page of a browser reads what graingas wrote alone. */
static size_t inflate_into(const unsigned char *from, size_t n, unsigned char *to, size_t room)
{
#ifdef GG_PAGE_ZLIB_H
  (void)from, (void)n, (void)to, (void)room;
  return 0;
#else
  uLongf size = room;
  return uncompress(to, &size, from, n) == Z_OK ? size : 0;
#endif
}

/* First bytes of all elements, then second ones ...; what is left over stands behind. */
static size_t unshuffle(const unsigned char *from, size_t n, unsigned char *to, size_t each)
{
  const size_t elements = n / each;
  for (size_t i = 0; i < elements; i++)
    for (size_t k = 0; k < each; k++) to[i * each + k] = from[k * elements + i];
  memcpy(to + elements * each, from + elements * each, n - elements * each);
  return n;
}

/* The last filter first. Its checksum of four bytes is left unread: the file as a whole has none either. */
bool gg_h5_filters_undo(const gg_h5_array_in *a, unsigned skipped, const unsigned char *stored, size_t n,
                        unsigned char *chunk, size_t bytes)
{
  const size_t room = bytes + 4 * GG_H5_MOST_FILTERS;
  GG_FREED unsigned char *one = malloc(room), *two = malloc(room);
  unsigned char *from = one, *to = two;
  const unsigned char *now = stored;
  for (int i = a->n_filters - 1; i >= 0 && n > 0 && one && two; i--) {
    if (skipped >> i & 1) continue;
    if (a->filter[i] == GG_H5_FLETCHER32) {
      n = n > 4 ? n - 4 : 0;
      continue;
    }
    n = a->filter[i] == GG_H5_GZIP ? inflate_into(now, n, to, room)
        : n <= room                ? unshuffle(now, n, to, a->type.size)
                                   : 0;
    unsigned char *const free_one = from;
    now = from = to, to = free_one;
  }
  const bool good = one && two && n == bytes;
  if (good) memcpy(chunk, now, bytes);
  return good;
}
