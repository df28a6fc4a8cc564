/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A law as a table, linear between nodes that are 1/256 of an octave of speed apart: within 1e-7 of a built-in law, and
 * as fast for one law as for another. Speeds are in the law's units; beyond the table they count as its ends.
 * Tables of built-in laws have 1 - e: below 10^-30 nothing is lost, above 3 10^8 as much as there. Those of formulas
 * and tables (speed_laws.h) have 1 - e, 1 + beta or mu without their steps, which are added where they are. */
#ifndef GG_LOSS_TABLE_H
#define GG_LOSS_TABLE_H

#include <stdint.h>
#include <string.h>

#include "base/error.h"
#include "common/laws/laws.h"
#include "common/laws/speed_laws.h"
#include "common/vec.h"

/* The first node is at 2^FIRST. */
enum { GG_LOSS_BITS = 8, GG_LOSS_FIRST = -100, GG_LOSS_OCTAVES = 128, GG_LOSS_NODES = (128 << 8) + 2 };
#define GG_LOSS_LOWEST 0x1p-100
#define GG_LOSS_HIGHEST 0x1p28

typedef struct gg_loss_table {
  int n_steps, n_invalid;
  double at[GG_LAW_STEPS], height[GG_LAW_STEPS];       /* from this speed on, so much more */
  double from[GG_LAW_STEPS + 1], to[GG_LAW_STEPS + 1]; /* speeds at which the law itself has no allowed value */
  double loss[GG_LOSS_NODES];
  float single[GG_LOSS_NODES];
} gg_loss_table;

/* NULL for a constant e. From malloc. */
gg_status gg_common_loss_table_new(gg_law_kind kind, gg_loss_table **table, gg_error *err);
/* The table of a law by a formula or a table, whose unit of speed is 2^GG_LAW_OCTAVES of the scene's: speeds of the
 * scene from 10^-19 to 10^19 are within. From malloc. */
enum { GG_LAW_OCTAVES = 36 };
gg_status gg_common_law_table_new(gg_contact_coefficient of, const char *text, gg_loss_table **table, gg_error *err);

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

/* The same with the steps of the law. */
GG_INLINE double gg_law_table_at(const gg_loss_table *table, double u)
{
  double x = gg_loss_at(table->loss, u);
  for (int k = 0; k < table->n_steps; k++) x += u >= table->at[k] ? table->height[k] : 0;
  return x;
}

/* True if the law itself has no allowed value at this speed. */
GG_INLINE bool gg_law_table_clamps(const gg_loss_table *table, double u)
{
  bool clamps = false;
  for (int k = 0; k < table->n_invalid; k++) clamps |= u >= table->from[k] && u < table->to[k];
  return clamps;
}

#endif
