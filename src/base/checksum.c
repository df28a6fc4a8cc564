/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/checksum.h"

#include <string.h>

/* 64-bit FNV-1a over words where it can: megabytes take milliseconds. */
uint64_t gg_base_checksum(uint64_t sum, const void *data, size_t size)
{
  const unsigned char *at = data;
  for (; size >= 8; at += 8, size -= 8) {
    uint64_t word;
    memcpy(&word, at, 8);
    sum = (sum ^ word) * UINT64_C(0x100000001b3);
    sum ^= sum >> 29;
  }
  for (; size > 0; at++, size--) sum = (sum ^ *at) * UINT64_C(0x100000001b3);
  return sum;
}
