/* Which blocks meet: draws made eight at a time, ahead of the visits that they lead to. */
#ifndef GG_DSMC_BLOCK_DRAW_H
#define GG_DSMC_BLOCK_DRAW_H

#include "dsmc/kernel/block_contact.h"

/* Visits to be had in stock: draws begin when every fourth visit finds less, and end with more. Few in small ensembles,
 * whose blocks are at hand, and change so soon that bounds would not hold for long. GG_CALLED: how far ahead of a visit
 * its memory is called. */
enum {
  GG_STOCK = 20,
  GG_STOCKED = 36,
  GG_STOCK_OF_FEW = 4,
  GG_CALLED = 12,
  GG_DRAW_FULL = 128,
  GG_DRAW_ROOM = GG_DRAW_FULL + 2 * GG_LANES
};
#define GG_ODD (UINT32_C(1) << 31) /* in `two`: no visit for this path */

/* What is to be visited, in order of time. Lists as gg_pack leaves them: each a number's worth of bits. Before the
 * next one there is always room for another. */
typedef struct gg_draws {
  unsigned at, n; /* next, and how many there are */
  uint64_t left;  /* draws to be made */
  bool layer;     /* the next is a visit made again, in the layer above its bound, from `lowest` on */
  gg_real lowest;
  double drift; /* of the next draw */
  gg_real one[GG_DRAW_ROOM], two[GG_DRAW_ROOM], order[GG_DRAW_ROOM], bound[GG_DRAW_ROOM];
  gg_real drifts[GG_DRAW_ROOM], per_unit[GG_DRAW_ROOM]; /* of the tops; both only if sheared */
} gg_draws;

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
  return *(const gg_vu *)(count + first);
}

/* One draw a lane: which blocks, and under which bound of |C12|; another random word gives the order, and whether to
 * visit. `number`: of the lane's draw, of which there are n. */
GG_INLINE void gg_draw_part(gg_features f, gg_batch *w, gg_chance *c, gg_draws *d, int part, gg_real root, gg_real step,
                            unsigned n)
{
  gg_vu a, b, more, spare, number = gg_lane_numbers((unsigned)part * GG_WIDTH);
  gg_lane_two_below(&c->rng, part, w->n_one, w->n_two, &a, &b);
  const gg_mask backwards = gg_below_word(b, a); /* by their places in their ranges: each range is sorted by speed */
  a += w->first_one;
  b += w->first_two;
  gg_lane_two(&c->rng, part, &more, &spare);
  gg_vd bound = w->most;
  if (!w->layer) bound = gg_smaller((gg_roots_at(w->top_one, a) + gg_roots_at(w->top_two, b)) * root, bound);
  gg_vd u = gg_lane_one_to_two(more) - 1;
  gg_mask odd = f.same ? gg_same_word(a, b) : gg_less(bound, bound); /* none */
  if (w->any_odd) odd = gg_or(odd, gg_or(gg_same_word(a, w->odd_one), gg_same_word(b, w->odd_two)));
  gg_vu one = a, two = b;
  if (f.same) {
    one = gg_select_words(backwards, b, a);
    two = gg_select_words(backwards, a, b);
  }
  two |= (gg_vu)gg_where(odd, (gg_vd)gg_all_words(GG_ODD));
  gg_mask keep = gg_or(gg_less(u * w->most_rate, bound + w->s0), odd);
  if (n < GG_LANES) keep = gg_and(keep, gg_below_word(number, gg_all_words(n)));
  gg_pack(d->one + d->n, keep, (gg_vd)one);
  gg_pack(d->two + d->n, keep, (gg_vd)two);
  gg_pack(d->order + d->n, keep, (gg_vd)more);
  gg_pack(d->bound + d->n, keep, bound);
  if (f.shear != GG_UNSHEARED) {
    gg_vd numbers = __builtin_convertvector((gg_vi)number, gg_vd);
    gg_pack(d->drifts + d->n, keep, (gg_real)d->drift + numbers * step);
    gg_pack(d->per_unit + d->n, keep, gg_all(w->per_unit));
  }
  d->n += (unsigned)__builtin_popcount(gg_bits(keep));
}

/* Make room at the end of the lists. */
GG_INLINE void gg_draws_move_up(gg_features f, gg_draws *d)
{
  gg_real *const lists[] = {d->one, d->two, d->order, d->bound, d->drifts, d->per_unit};
  for (unsigned k = 0; k < (f.shear != GG_UNSHEARED ? 6u : 4u); k++)
    for (unsigned i = 0; i < d->n - d->at; i++) lists[k][1 + i] = lists[k][d->at + i];
  d->n -= d->at - 1;
  d->at = 1;
}

/* Eight draws, of which those to be visited are kept. */
GG_INLINE void gg_draw(gg_features f, gg_batch *w, gg_chance *c, gg_draws *d, double drift_step)
{
  const unsigned n = d->left < GG_LANES ? (unsigned)d->left : GG_LANES;
  if (__builtin_expect(d->n + GG_LANES > GG_DRAW_FULL, 0)) gg_draws_move_up(f, d);
  if (f.shear != GG_UNSHEARED) {
    const double delta = n * drift_step;
    w->per_unit = (gg_real)gg_per_top(w->unit); /* as the drift only grows, tops in an earlier unit hold */
    w->unit *= gg_top_growth(delta);
    w->root = (gg_real)(sqrt(w->unit) * (1 + 1e-6));
  }
  for (int part = 0; part < GG_PARTS; part++) gg_draw_part(f, w, c, d, part, w->root, (gg_real)drift_step, n);
  d->drift += n * drift_step;
  d->left -= n;
}

/* Draw ahead if little is left in stock: then for some visits to come. */
GG_INLINE void gg_draw_ahead(gg_features f, gg_batch *w, gg_chance *c, gg_draws *d, double drift_step)
{
  if (d->n - d->at >= (w->sorts ? GG_STOCK : GG_STOCK_OF_FEW)) return;
  while (d->left && d->n - d->at < (w->sorts ? GG_STOCKED : GG_STOCK_OF_FEW)) gg_draw(f, w, c, d, drift_step);
}

/* A visit comes once more, as the next one, in the layer from `lowest` to `bound`. It has no block in common with those
 * that have begun since. */
GG_INLINE void gg_draw_again(gg_features f, gg_draws *d, uint32_t one, uint32_t two, gg_word order, gg_real lowest,
                             gg_real bound, gg_real drift, gg_real per_unit)
{
  const unsigned i = --d->at;
  d->layer = true;
  d->lowest = lowest;
  gg_list(d->one, i, one);
  gg_list(d->two, i, two);
  gg_list(d->order, i, order);
  d->bound[i] = bound;
  if (f.shear == GG_UNSHEARED) return;
  d->drifts[i] = drift;
  d->per_unit[i] = per_unit;
}

#endif
