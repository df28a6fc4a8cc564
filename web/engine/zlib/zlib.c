/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <zlib.h>

#include <stdint.h>
#include <string.h>

/* Eight tables, so that eight bytes go in one step: the remainders of a byte that k more bytes follow. */
static uint32_t table[8][256];

static void fill(void)
{
  for (uint32_t i = 0; i < 256; i++) {
    uint32_t rest = i;
    for (int bit = 0; bit < 8; bit++) rest = rest & 1 ? rest >> 1 ^ 0xedb88320u : rest >> 1;
    table[0][i] = rest;
  }
  for (int k = 1; k < 8; k++)
    for (int i = 0; i < 256; i++) table[k][i] = table[k - 1][i] >> 8 ^ table[0][table[k - 1][i] & 255];
}

uLong crc32(uLong sum, const Bytef *bytes, uInt size)
{
  uint32_t rest = ~(uint32_t)sum;
  if (!bytes) return 0;
  if (!table[0][1]) fill();
  for (; size >= 8; bytes += 8, size -= 8) {
    uint32_t a, b; /* lowest byte first, as in every browser */
    memcpy(&a, bytes, 4);
    memcpy(&b, bytes + 4, 4);
    a ^= rest;
    rest = table[7][a & 255] ^ table[6][a >> 8 & 255] ^ table[5][a >> 16 & 255] ^ table[4][a >> 24] ^
           table[3][b & 255] ^ table[2][b >> 8 & 255] ^ table[1][b >> 16 & 255] ^ table[0][b >> 24];
  }
  for (; size > 0; bytes++, size--) rest = rest >> 8 ^ table[0][(rest ^ *bytes) & 255];
  return (uint32_t)~rest;
}
