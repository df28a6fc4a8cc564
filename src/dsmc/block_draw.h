/* Which blocks meet: draws made 32 at a time, ahead of the visits that they lead to. */
#ifndef GG_DSMC_BLOCK_DRAW_H
#define GG_DSMC_BLOCK_DRAW_H

#include "dsmc/block_contact.h"

enum { GG_DRAWS = 32, GG_DRAWN = GG_DRAWS + GG_LANES }; /* block pairs drawn at a time; room in lists of them */
#define GG_ODD (UINT32_C(1) << 31)                      /* in `two`: no visit for this path */

/* What is to be visited, in order of time. Lists as gg_pack leaves them: each a number's worth of bits. */
typedef struct gg_draw {
  unsigned n;
  double drift, unit; /* where these draws begin */
  gg_real one[GG_DRAWN], two[GG_DRAWN], order[GG_DRAWN], bound[GG_DRAWN], nth[GG_DRAWN];
  gg_vu words[GG_DRAWN][GG_PARTS]; /* random */
} gg_draw;

GG_INLINE gg_word gg_listed(const gg_real *list, unsigned i)
{
  gg_word bits;
  __builtin_memcpy(&bits, &list[i], sizeof bits);
  return bits;
}

GG_INLINE void gg_list(gg_real *list, unsigned i, gg_word bits)
{
  __builtin_memcpy(&list[i], &bits, sizeof bits);
}

GG_INLINE gg_vu gg_lane_numbers(unsigned first)
{
  static const gg_word count[GG_LANES] __attribute__((aligned(64))) = {0, 1, 2, 3, 4, 5, 6, 7};
  return *(const gg_vu *)count + first;
}

/* All bits of the lanes where a == b. */
GG_INLINE gg_vu gg_equal(gg_vu a, gg_vu b)
{
  return (gg_vu)(a == b);
}

GG_INLINE gg_vu gg_all_bits(gg_word x)
{
  return x - (gg_vu){0};
}

/* One draw a lane: which blocks, and under which bound of |C12|; another random word gives the order, and whether to
 * visit. */
GG_INLINE void gg_draw_part(gg_features f, gg_batch *w, gg_draw *next, int part, gg_real root, unsigned first,
                            unsigned n)
{
  gg_vu a, b, more, spare;
  gg_lane_two_below(&w->rng, part, w->blocks_one.n, w->blocks_two.n, &a, &b);
  const gg_vu backwards = (gg_vu)(b < a); /* by their places in their ranges: each range is sorted by speed */
  a += w->blocks_one.first;
  b += w->blocks_two.first;
  gg_lane_two(&w->rng, part, &more, &spare);
  gg_vd bound = (gg_roots_at(w->top_one, a) + gg_roots_at(w->top_two, b)) * root;
  const gg_real upper = w->floor == 0 ? 0 : (gg_real)INFINITY; /* a layer under one bound */
  bound = gg_smaller(bound + upper, gg_all(w->bound));
  gg_vd u = gg_lane_one_to_two(more) - 1;
  gg_vu odd = gg_equal(a, gg_all_bits(w->odd_one)) | gg_equal(b, gg_all_bits(w->odd_two));
  if (f.same) {
    gg_vu swap = (a ^ b) & backwards;
    odd |= gg_equal(a, b);
    a ^= swap;
    b ^= swap;
  }
  gg_mask keep = gg_or(gg_less(u * (w->bound + w->s0), bound + w->s0), gg_low_bit(odd));
  gg_vu nth = gg_lane_numbers(first);
  if (first + GG_WIDTH > n) keep = gg_and(keep, gg_low_bit((gg_vu)(nth < gg_all_bits(n))));
  gg_pack(next->one + next->n, keep, (gg_vd)a);
  gg_pack(next->two + next->n, keep, (gg_vd)(b | (odd & gg_all_bits(GG_ODD))));
  gg_pack(next->order + next->n, keep, (gg_vd)more);
  gg_pack(next->bound + next->n, keep, bound);
  if (f.shear != GG_UNSHEARED) gg_pack(next->nth + next->n, keep, (gg_vd)nth);
  next->n += (unsigned)__builtin_popcount(gg_bits(keep));
}

/* Draw `n` block pairs and keep those to be visited. */
GG_INLINE void gg_draw_visits(gg_features f, gg_batch *w, gg_draw *next, unsigned n, double drift_step)
{
  const double delta = n * drift_step;
  next->drift = w->next_drift;
  next->unit = w->next_unit;
  next->n = 0;
  w->next_drift += delta;
  w->next_unit *= gg_top_growth(delta);
  const gg_real root = (gg_real)(sqrt(w->next_unit) * (1 + 1e-6));
  for (unsigned first = 0; first < n; first += GG_LANES)
    for (int part = 0; part < GG_PARTS; part++)
      gg_draw_part(f, w, next, part, root, first + (unsigned)part * GG_WIDTH, n);
  for (unsigned i = 0; i < next->n; i += 2)
    for (int part = 0; part < GG_PARTS; part++)
      gg_lane_two(&w->rng, part, &next->words[i][part], &next->words[i + 1][part]);
}

#endif
