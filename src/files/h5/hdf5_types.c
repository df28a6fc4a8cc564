/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Type and number of the elements of an array or attribute. */
#include <string.h>

#include "files/h5/hdf5_format.h"

/* Numbers that fill their bytes, as processors have them, and texts of fixed length. */
bool gg_h5_type_of(const unsigned char *data, size_t size, gg_h5_type *type)
{
  *type = (gg_h5_type){.kind = GG_H5_OTHER};
  if (size < 8) return false;
  const unsigned class = data[0] & 15, bits = data[1];
  type->size = gg_h5_word(data + 4, 4);
  type->backwards = bits & 1;
  if (class == 0 && size >= 12) {
    const bool whole = gg_h5_word(data + 8, 2) == 0 && gg_h5_word(data + 10, 2) == 8 * type->size;
    const bool sized = type->size == 1 || type->size == 2 || type->size == 4 || type->size == 8;
    if (whole && sized) type->kind = GG_H5_WHOLE;
    type->is_signed = bits & 8;
  } else if (class == 1 && size >= 20) { /* binary32 and binary64: where sign, exponent and fraction stand */
    const bool four = type->size == 4 && data[2] == 31 && data[12] == 23 && data[13] == 8 && data[15] == 23;
    const bool eight = type->size == 8 && data[2] == 63 && data[12] == 52 && data[13] == 11 && data[15] == 52;
    if ((four || eight) && !(bits & 64)) type->kind = GG_H5_REAL;
  } else if (class == 3) {
    type->backwards = false;
    type->kind = GG_H5_TEXT;
  }
  return type->size > 0;
}

bool gg_h5_space_of(const unsigned char *data, size_t size, gg_h5_space *space)
{
  *space = (gg_h5_space){.n = 1};
  if (size < 4 || (data[0] != 1 && data[0] != 2)) return false;
  const size_t head = data[0] == 1 ? 8 : 4;
  const int rank = data[1];
  if (data[0] == 2 && data[3] == 2) return space->n = 0, true; /* nothing at all */
  if (rank > GG_H5_MOST_RANK || size < head + 8 * (size_t)rank) return false;
  space->rank = rank;
  for (int a = 0; a < rank; a++) {
    space->dims[a] = gg_h5_word(data + head + 8 * a, 8);
    if (__builtin_mul_overflow(space->n, space->dims[a], &space->n)) return false;
  }
  return space->n <= INT64_MAX;
}

/* Numbers as files hold them into those that are requested. Whole numbers beyond the range of the other type take its
 * nearest end, as HDF5 has it. */

typedef struct number {
  bool real, negative; /* negative: a whole one below zero, whose bits are in `whole` */
  double x;
  uint64_t whole;
} number;

static number number_of(const gg_h5_type *t, const unsigned char *at)
{
  unsigned char bytes[8];
  uint64_t word;
  for (size_t i = 0; i < t->size; i++) bytes[i] = at[t->backwards ? t->size - 1 - i : i];
  word = gg_h5_word(bytes, (int)t->size);
  if (t->kind == GG_H5_REAL && t->size == 8) {
    double x;
    memcpy(&x, &word, sizeof x);
    return (number){.real = true, .x = x};
  }
  if (t->kind == GG_H5_REAL) {
    const uint32_t half = (uint32_t)word;
    float x;
    memcpy(&x, &half, sizeof x);
    return (number){.real = true, .x = (double)x};
  }
  const int bits = 8 * (int)t->size;
  const bool negative = t->is_signed && word >> (bits - 1);
  if (negative && bits < 64) word |= UINT64_MAX << bits;
  return (number){.negative = negative, .whole = word};
}

static uint64_t as_count(const number *n, uint64_t most)
{
  if (n->real) return !(n->x > 0) ? 0 : n->x >= (double)most ? most : (uint64_t)n->x;
  return n->negative ? 0 : n->whole > most ? most : n->whole;
}

static int64_t as_whole(const number *n)
{
  if (n->real) return n->x != n->x ? 0 : n->x >= 0x1p63 ? INT64_MAX : n->x < -0x1p63 ? INT64_MIN : (int64_t)n->x;
  return n->negative ? (int64_t)n->whole : n->whole > INT64_MAX ? INT64_MAX : (int64_t)n->whole;
}

static void put(const number *n, gg_item_type type, unsigned char *to)
{
  const double x = n->real ? n->x : n->negative ? (double)(int64_t)n->whole : (double)n->whole;
  switch (type) {
  case GG_ITEM_F64: memcpy(to, &x, sizeof x); return;
  case GG_ITEM_F32: memcpy(to, &(float){(float)x}, sizeof(float)); return;
  case GG_ITEM_I64: memcpy(to, &(int64_t){as_whole(n)}, sizeof(int64_t)); return;
  case GG_ITEM_U64: memcpy(to, &(uint64_t){as_count(n, UINT64_MAX)}, sizeof(uint64_t)); return;
  case GG_ITEM_U8: *to = (unsigned char)as_count(n, UINT8_MAX); return;
  case GG_ITEM_TYPES: return;
  }
}

/* True if both types have the same bits. */
static bool is_same(const gg_h5_type *from, gg_item_type type)
{
  static const struct {
    int kind;
    bool is_signed;
  } ours[] = {[GG_ITEM_F64] = {GG_H5_REAL, false},
              [GG_ITEM_I64] = {GG_H5_WHOLE, true},
              [GG_ITEM_U64] = {GG_H5_WHOLE, false},
              [GG_ITEM_U8] = {GG_H5_WHOLE, false},
              [GG_ITEM_F32] = {GG_H5_REAL, false}};
  const uint16_t one = 1;
  const bool lowest_first = *(const unsigned char *)&one;
  return (int)from->kind == ours[type].kind && from->size == gg_base_archive_item_size(type) &&
         from->backwards == !lowest_first && (from->kind != GG_H5_WHOLE || from->is_signed == ours[type].is_signed);
}

bool gg_h5_convert(const gg_h5_type *from, const void *data, gg_item_type type, void *to, size_t n)
{
  const unsigned char *at = data;
  unsigned char *put_at = to;
  if (from->kind != GG_H5_REAL && from->kind != GG_H5_WHOLE) return false;
  if (is_same(from, type)) return n ? memcpy(to, data, n * from->size) : NULL, true;
  for (size_t i = 0; i < n; i++, at += from->size, put_at += gg_base_archive_item_size(type)) {
    const number x = number_of(from, at);
    put(&x, type, put_at);
  }
  return true;
}
