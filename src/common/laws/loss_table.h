/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A built-in law as a table of 1 - e, linear between nodes that are 1/256 of an octave of speed apart: within 1e-7 of
 * the law, and as fast for one law as for another. Speeds are in the law's units; beyond the table they count as its
 * ends: below 10^-30 nothing is lost, above 3 10^8 as much as there. */
#ifndef GG_LOSS_TABLE_H
#define GG_LOSS_TABLE_H

#include <stdint.h>
#include <string.h>

#include "base/error.h"
#include "common/laws/laws.h"
#include "common/vec.h"

/* The first node is at 2^FIRST. */
enum { GG_LOSS_BITS = 8, GG_LOSS_FIRST = -100, GG_LOSS_OCTAVES = 128, GG_LOSS_NODES = (128 << 8) + 2 };
#define GG_LOSS_LOWEST 0x1p-100
#define GG_LOSS_HIGHEST 0x1p28

typedef struct gg_loss_table {
  double loss[GG_LOSS_NODES];
  float single[GG_LOSS_NODES];
} gg_loss_table;

/* NULL for a constant e. From malloc. */
gg_status gg_common_loss_table_new(gg_law_kind kind, gg_loss_table **table, gg_error *err);

GG_INLINE uint64_t gg_bits_of_double(double x)
{
  uint64_t bits;
  memcpy(&bits, &x, sizeof bits);
  return bits;
}
GG_INLINE double gg_double_of_bits(uint64_t bits)
{
  double x;
  memcpy(&x, &bits, sizeof x);
  return x;
}

/* gg_loss_at(table->loss, u). */
#define GG_NUMBER double
#define GG_OF(name) gg_##name
#define GG_REAL double
#define GG_WORDS uint64_t
#define GG_MANTISSA 52
#define GG_BIAS UINT64_C(1023)
#define GG_ONE UINT64_C(1)
#define GG_BETWEEN(x, low, high) ((x) > (low) ? (x) < (high) ? (x) : (high) : (low))
#define GG_BITS(x) gg_bits_of_double(x)
#define GG_FROM_BITS(w) gg_double_of_bits(w)
#define GG_LOOK_UP(table, at) (table)[at]
#include "common/laws/loss_at_of.h"

#endif
