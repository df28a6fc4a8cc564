/* Eight predictions at a time. Plain vector types of a fixed width: the compiler maps them on whatever the processor
 * has, and every element goes through the operations of predict.h in the same order, so that each delay is the same bit
 * for bit as the one pair at a time. */
#ifndef GG_MD_BATCH_H
#define GG_MD_BATCH_H

#include <math.h>

#include "md/state.h"

typedef double gg_v8 __attribute__((vector_size(64)));
typedef int64_t gg_m8 __attribute__((vector_size(64)));
typedef double gg_line __attribute__((vector_size(64), may_alias));

enum { GG_BATCH = 8 };
typedef uint32_t gg_list8 __attribute__((vector_size(32), may_alias, aligned(4)));

/* Eight records as columns: r, v, t and the bits of (stamp, next). */
typedef struct gg_batch {
  gg_v8 x, y, z, vx, vy, vz, t, tag;
} gg_batch;

GG_INLINE gg_v8 gg_all(double x)
{
  return (gg_v8){x, x, x, x, x, x, x, x};
}

GG_INLINE gg_v8 gg_choose(gg_m8 mask, gg_v8 yes, gg_v8 no)
{
  return (gg_v8)(((gg_m8)yes & mask) | ((gg_m8)no & ~mask));
}

/* Nearest integers, ties to even: as gg_nearest. */
GG_INLINE gg_v8 gg_nearest8(gg_v8 x)
{
  gg_v8 shift = gg_all(0x1.8p52);
  return (x + shift) - shift;
}

GG_INLINE gg_v8 gg_sqrt8(gg_v8 x)
{
  gg_v8 root;
  for (int l = 0; l < GG_BATCH; l++) root[l] = sqrt(x[l]);
  return root;
}

/* Into the nearest image, for separations below one and a half edges: as x - edge * gg_nearest(x/edge). */
GG_INLINE gg_v8 gg_fold8(gg_v8 x, double edge)
{
  gg_v8 down = (gg_v8)((gg_m8)gg_all(edge) & (x > 0.5 * edge)), up = (gg_v8)((gg_m8)gg_all(edge) & (x < -0.5 * edge));
  return x - (down - up);
}

/* The earliest of eight times and with whom; of equal times the smallest index. */
GG_INLINE double gg_earliest8(gg_v8 t, gg_m8 who, int64_t *partner)
{
#define FOLD(v, a, b, c, d, e, f, g, h) __builtin_shufflevector(v, v, a, b, c, d, e, f, g, h)
#define SOONER(v, w) gg_choose(w < v, w, v)
  gg_v8 m = SOONER(t, FOLD(t, 4, 5, 6, 7, 0, 1, 2, 3));
  m = SOONER(m, FOLD(m, 2, 3, 0, 1, 6, 7, 4, 5));
  m = SOONER(m, FOLD(m, 1, 0, 3, 2, 5, 4, 7, 6));
  gg_m8 first = who | ~(t == m), swapped; /* -1 where later */
  first &= INT64_MAX;
#define SMALLER(v) swapped = (v), first = (first & (first < swapped)) | (swapped & ~(first < swapped))
  SMALLER(FOLD(first, 4, 5, 6, 7, 0, 1, 2, 3));
  SMALLER(FOLD(first, 2, 3, 0, 1, 6, 7, 4, 5));
  SMALLER(FOLD(first, 1, 0, 3, 2, 5, 4, 7, 6));
#undef FOLD
#undef SOONER
#undef SMALLER
  *partner = first[0];
  return m[0];
}

/* Records are one cache line each: load the lines of eight grains and transpose. */
GG_INLINE gg_batch gg_gather(const gg_grain *grain, const uint32_t *index)
{
  gg_v8 a = *(const gg_line *)&grain[index[0]], b = *(const gg_line *)&grain[index[1]];
  gg_v8 c = *(const gg_line *)&grain[index[2]], d = *(const gg_line *)&grain[index[3]];
  gg_v8 e = *(const gg_line *)&grain[index[4]], f = *(const gg_line *)&grain[index[5]];
  gg_v8 g = *(const gg_line *)&grain[index[6]], h = *(const gg_line *)&grain[index[7]];
#define EVEN(p, q) __builtin_shufflevector(p, q, 0, 8, 2, 10, 4, 12, 6, 14)
#define ODD(p, q) __builtin_shufflevector(p, q, 1, 9, 3, 11, 5, 13, 7, 15)
#define PAIR0(p, q) __builtin_shufflevector(p, q, 0, 1, 8, 9, 4, 5, 12, 13)
#define PAIR1(p, q) __builtin_shufflevector(p, q, 2, 3, 10, 11, 6, 7, 14, 15)
#define LOW(p, q) __builtin_shufflevector(p, q, 0, 1, 2, 3, 8, 9, 10, 11)
#define HIGH(p, q) __builtin_shufflevector(p, q, 4, 5, 6, 7, 12, 13, 14, 15)
  gg_v8 ab0 = EVEN(a, b), ab1 = ODD(a, b), cd0 = EVEN(c, d), cd1 = ODD(c, d);
  gg_v8 ef0 = EVEN(e, f), ef1 = ODD(e, f), gh0 = EVEN(g, h), gh1 = ODD(g, h);
  gg_v8 p0 = PAIR0(ab0, cd0), p1 = PAIR0(ab1, cd1), p2 = PAIR1(ab0, cd0), p3 = PAIR1(ab1, cd1);
  gg_v8 q0 = PAIR0(ef0, gh0), q1 = PAIR0(ef1, gh1), q2 = PAIR1(ef0, gh0), q3 = PAIR1(ef1, gh1);
  return (gg_batch){LOW(p0, q0),  LOW(p1, q1),  LOW(p2, q2),  LOW(p3, q3),
                    HIGH(p0, q0), HIGH(p1, q1), HIGH(p2, q2), HIGH(p3, q3)};
#undef EVEN
#undef ODD
#undef PAIR0
#undef PAIR1
#undef LOW
#undef HIGH
}

/* gg_contact_delay, eight times. */
GG_INLINE gg_v8 gg_contact_delay8(gg_v8 x, gg_v8 y, gg_v8 z, gg_v8 vx, gg_v8 vy, gg_v8 vz, gg_v8 sigma2)
{
  gg_v8 b = x * vx + y * vy + z * vz, a = vx * vx + vy * vy + vz * vz;
  gg_v8 c = x * x + y * y + z * z - sigma2, discriminant = b * b - a * c;
  gg_m8 meets = (b < 0) & (discriminant >= 0);
  gg_v8 delay = c / (gg_sqrt8(discriminant) - b);
  delay = gg_choose(delay > 0, delay, gg_all(0));
  return gg_choose(meets, delay, gg_all(INFINITY));
}

#endif
