/* SPDX-License-Identifier: GPL-3.0-or-later */
/* 1 - e off a table (common/laws/loss_table.h), stated once for doubles and for lanes. Included with
 *
 *   GG_NUMBER, GG_OF(name)          as in common/vec_of.h
 *   GG_REAL, GG_WORDS               an entry of the table; as many bits as a GG_NUMBER has
 *   GG_MANTISSA, GG_BIAS, GG_ONE    bits of the fraction of a GG_REAL; what its exponent counts from; 1: as words
 *   GG_BETWEEN(x, low, high)        x, but at least `low` and at most `high`
 *   GG_BITS(x), GG_FROM_BITS(w)     a number as its bits, and back
 *   GG_LOOK_UP(table, at)           entries
 *
 * Nodes divide each octave evenly: the leading bits of a number are its place in the table, the others how far it is
 * from there to the next node. Each inclusion forgets what it was included with. */
GG_INLINE GG_NUMBER GG_OF(loss_at)(const GG_REAL *table, GG_NUMBER u)
{
  const GG_WORDS bits = GG_BITS(GG_BETWEEN(u, GG_LOSS_LOWEST, GG_LOSS_HIGHEST));
  const GG_WORDS at = (bits >> (GG_MANTISSA - GG_LOSS_BITS)) - ((GG_BIAS + GG_LOSS_FIRST) << GG_LOSS_BITS);
  const GG_WORDS past = (bits << GG_LOSS_BITS) & ((GG_ONE << GG_MANTISSA) - 1);
  const GG_NUMBER share = GG_FROM_BITS(past | (GG_BIAS << GG_MANTISSA)) - 1;
  const GG_NUMBER low = GG_LOOK_UP(table, at), high = GG_LOOK_UP(table + 1, at);
  return low + share * (high - low);
}

#undef GG_NUMBER
#undef GG_OF
#undef GG_REAL
#undef GG_WORDS
#undef GG_MANTISSA
#undef GG_BIAS
#undef GG_ONE
#undef GG_BETWEEN
#undef GG_BITS
#undef GG_FROM_BITS
#undef GG_LOOK_UP
