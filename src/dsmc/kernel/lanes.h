/* Eight lanes on whatever registers there are, in parts of GG_WIDTH: numbers `gg_real` are double, or float if
 * GG_SINGLE_LANES is defined. Every operation is lane by lane, exact or correctly rounded, and nothing is contracted,
 * so that all processors leave the same bits. Included only by files that are compiled once for each set of
 * instructions.
 *
 * From lanes_double.h or lanes_single.h:
 * gg_vd, gg_vi, gg_vu: numbers, whole numbers, and random words as wide. gg_mask: one truth a lane. gg_permute_of(r)
 * and gg_permute: lane l gets lane l ^ r (r < GG_WIDTH). gg_store_either: `yes` in
 * true lanes, else `no`. gg_spread: the next numbers of a list, one for each true lane;
 * gg_pack: the true lanes to the front of a list, then anything up to a width. gg_peaks: the largest lane of a, and
 * of b. gg_roots_at: square roots out of a table, rounded to float. gg_dsmc_lane_two: two random words a lane, from
 * whose high bits gg_dsmc_lane_one_to_two makes a number; bit GG_SPARE_BIT hardly matters to it.
 * gg_dsmc_lane_two_below: two random whole numbers. */
#ifndef GG_DSMC_LANES_H
#define GG_DSMC_LANES_H

#ifdef GG_SINGLE_LANES
#include "dsmc/kernel/lanes_single.h"
#else
#include "dsmc/kernel/lanes_double.h"
#endif

#ifndef GG_HAS_AVX512
GG_INLINE gg_mask gg_below_word(gg_vu a, gg_vu b)
{
  return (gg_mask)(a < b);
}
GG_INLINE gg_mask gg_same_word(gg_vu a, gg_vu b)
{
  return (gg_mask)(a == b);
}
GG_INLINE void gg_store_either(gg_real *p, gg_mask m, gg_vd yes, gg_vd no)
{
  *(gg_vd *)p = gg_select(m, yes, no);
}
#endif

/* Lane-wise vectors in space. */
typedef struct gg_vd3 {
  gg_vd x, y, z;
} gg_vd3;

GG_INLINE gg_vd gg_all(gg_real x)
{
  return x - (gg_vd){0};
}
GG_INLINE gg_vu gg_all_words(gg_word x)
{
  return x - (gg_vu){0};
}
GG_INLINE gg_vu gg_select_words(gg_mask m, gg_vu yes, gg_vu no)
{
  return (gg_vu)gg_select(m, (gg_vd)yes, (gg_vd)no);
}
GG_INLINE gg_vd3 gg_vd3_sub(gg_vd3 a, gg_vd3 b)
{
  return (gg_vd3){a.x - b.x, a.y - b.y, a.z - b.z};
}
GG_INLINE gg_vd3 gg_vd3_add(gg_vd3 a, gg_vd3 b)
{
  return (gg_vd3){a.x + b.x, a.y + b.y, a.z + b.z};
}
GG_INLINE gg_vd3 gg_vd3_scale(gg_vd f, gg_vd3 a)
{
  return (gg_vd3){f * a.x, f * a.y, f * a.z};
}
GG_INLINE gg_vd gg_vd3_dot(gg_vd3 a, gg_vd3 b)
{
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
GG_INLINE gg_vd3 gg_vd3_cross(gg_vd3 a, gg_vd3 b)
{
  return (gg_vd3){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

GG_INLINE gg_vd gg_load(const gg_real *p)
{
  return *(const gg_vd *)p;
}
GG_INLINE void gg_store(gg_real *p, gg_vd v)
{
  *(gg_vd *)p = v;
}

#endif
