/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Words of a whole that is good, replaced: what a file that somebody makes is mostly like. An input is a list of
 * records of 12 bytes: what to do, of how many bytes, where (counted in words that are not 0, or in steps of 8), and a
 * value. */
#ifndef GG_FUZZ_PATCH_H
#define GG_FUZZ_PATCH_H

#include <stddef.h>
#include <stdint.h>
#include <string.h>

enum { FUZZ_RECORD = 12, FUZZ_MOST_RECORDS = 24 };

/* The place of the k-th word that is not 0; k wraps. `words` of them are listed. */
static inline size_t fuzz_place(const uint8_t *record, const uint32_t *listed, size_t words, size_t size)
{
  const size_t k = (size_t)record[2] | (size_t)record[3] << 8;
  if (record[0] & 1 || words == 0) return size < 8 ? 0 : k * 8 % (size - 7);
  return listed[k % words];
}

static inline void fuzz_patch_one(uint8_t *whole, size_t size, const uint8_t *record, size_t at, size_t from)
{
  static const size_t widths[] = {8, 4, 2, 1};
  size_t width = widths[record[1] % 4];
  uint64_t was = 0, value;
  memcpy(&value, record + 4, 8);
  if (at >= size) return;
  if (width > size - at) width = size - at;
  memcpy(&was, whole + at, width);
  switch (record[0] >> 1 & 3) {
  case 0: break;
  case 1: value = was + (uint64_t)(int64_t)(int8_t)record[4]; break;
  case 2: value = was ^ UINT64_C(1) << record[4] % 64; break;
  default: /* what stands elsewhere in it */
    memmove(whole + at, whole + from, width <= size - from ? width : size - from);
    return;
  }
  memcpy(whole + at, &value, width);
}

/* Words of `whole` that are not 0; returns how many there are, at most `most`. */
static inline size_t fuzz_list_words(const uint8_t *whole, size_t size, uint32_t *listed, size_t most)
{
  size_t n = 0;
  for (size_t at = 0; at + 8 <= size && n < most; at += 8) {
    uint64_t word;
    memcpy(&word, whole + at, 8);
    if (word) listed[n++] = (uint32_t)at;
  }
  return n;
}

static inline void fuzz_patch(uint8_t *whole, size_t size, const uint32_t *listed, size_t words, const uint8_t *data,
                              size_t length)
{
  for (size_t k = 0; k < FUZZ_MOST_RECORDS && length >= FUZZ_RECORD; k++, data += FUZZ_RECORD, length -= FUZZ_RECORD) {
    const uint8_t other[4] = {data[0], 0, data[4], data[5]};
    if (size)
      fuzz_patch_one(whole, size, data, fuzz_place(data, listed, words, size), fuzz_place(other, listed, words, size));
  }
}

/* Each place that a patch changed, as it was. */
static inline void fuzz_unpatch(uint8_t *whole, const uint8_t *was, size_t size, const uint32_t *listed, size_t words,
                                const uint8_t *data, size_t length)
{
  for (size_t k = 0; k < FUZZ_MOST_RECORDS && length >= FUZZ_RECORD; k++, data += FUZZ_RECORD, length -= FUZZ_RECORD) {
    const size_t at = size ? fuzz_place(data, listed, words, size) : 0;
    if (at < size) memcpy(whole + at, was + at, size - at < 8 ? size - at : 8);
  }
}

#endif
