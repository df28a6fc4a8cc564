/* Numbers as files hold them into those that are asked for. Whole numbers beyond the range of the other type take its
 * nearest end, as HDF5 has it. */
#include <string.h>

#include "files/h5/hdf5_format.h"

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

static double as_real(const number *n)
{
  return n->real ? n->x : n->negative ? (double)(int64_t)n->whole : (double)n->whole;
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
  const double x = as_real(n);
  switch (type) {
  case GG_ITEM_F64: memcpy(to, &x, sizeof x); return;
  case GG_ITEM_F32: memcpy(to, &(float){(float)x}, sizeof(float)); return;
  case GG_ITEM_I64: memcpy(to, &(int64_t){as_whole(n)}, sizeof(int64_t)); return;
  case GG_ITEM_U64: memcpy(to, &(uint64_t){as_count(n, UINT64_MAX)}, sizeof(uint64_t)); return;
  case GG_ITEM_U8: *to = (unsigned char)as_count(n, UINT8_MAX); return;
  case GG_ITEM_TYPES: return;
  }
}

/* Are they the same bits? */
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
