/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Pairs of blocks, drawn eight at a time and ahead of their use, so that their memory can be prefetched. */
#ifndef GG_DSMC_BLOCK_PAIRS_H
#define GG_DSMC_BLOCK_PAIRS_H

#include "dsmc/kernel/candidate.h"

/* Numbers of prefetched block pairs. Every fourth pair checks them. */
enum {
  GG_DSMC_PREFETCH_FROM = 20, /* fewer: draw more */
  GG_DSMC_PREFETCH_TO = 36,   /* up to so many */
  GG_DSMC_PREFETCH_SMALL =
      4, /* the same for small ensembles: their blocks are cached, and their majorants soon outdated */
  GG_DSMC_PREFETCH_AHEAD = 12, /* the memory of a pair is prefetched so many pairs before its use */
  GG_DSMC_BLOCK_PAIRS = 128,
  GG_DSMC_BLOCK_PAIRS_ROOM = GG_DSMC_BLOCK_PAIRS + 2 * GG_DSMC_LANES
};
#define GG_DSMC_ODD (UINT32_C(1) << 31) /* flag in `two`: the pair is left to the plain path */

/* Block pairs to come, in the order of time. The lists are filled by gg_pack; an entry has the bits of a number. There
 * is always room for one more pair before the next one. */
typedef struct gg_dsmc_block_pairs {
  unsigned at, n;  /* next pair; end of the lists */
  uint64_t left;   /* draws to be made */
  bool correction; /* the next pair is a correction, over the layer from `lowest` above its majorant */
  gg_real lowest;
  double strain; /* of the next draw */
  gg_real one[GG_DSMC_BLOCK_PAIRS_ROOM], two[GG_DSMC_BLOCK_PAIRS_ROOM], order[GG_DSMC_BLOCK_PAIRS_ROOM],
      majorant[GG_DSMC_BLOCK_PAIRS_ROOM];
  gg_real strains[GG_DSMC_BLOCK_PAIRS_ROOM],
      per_scale[GG_DSMC_BLOCK_PAIRS_ROOM]; /* inverse scale of the speed bounds; both only if sheared */
} gg_dsmc_block_pairs;

GG_INLINE gg_word gg_dsmc_listed(const gg_real *list, unsigned i)
{
  gg_word bits;
  __builtin_memcpy(&bits, &list[i], sizeof bits);
  return bits;
}

GG_INLINE void gg_dsmc_list(gg_real *list, unsigned i, gg_word bits)
{
  __builtin_memcpy(&list[i], &bits, sizeof bits);
}

GG_INLINE gg_vu gg_dsmc_lane_numbers(unsigned first)
{
  static const gg_word count[GG_DSMC_LANES] __attribute__((aligned(64))) = {0, 1, 2, 3, 4, 5, 6, 7};
  return *(const gg_vu *)(count + first);
}

/* One draw a lane: the blocks, and the majorant of |C12|. Another random word gives the order of lanes, and the
 * acceptance of the block pair. n: number of valid draws. */
GG_INLINE void gg_dsmc_draw_part(gg_dsmc_features features, gg_dsmc_pass_state *state, gg_dsmc_samples *samples,
                                 gg_dsmc_block_pairs *pairs, int part, gg_real root, gg_real step, unsigned n)
{
  gg_vu a, b, more, spare, number = gg_dsmc_lane_numbers((unsigned)part * GG_WIDTH);
  gg_dsmc_lane_two_below(&samples->rng, part, state->n_one, state->n_two, &a, &b);
  const gg_mask backwards = gg_below_word(b, a); /* by places in their ranges: each range is sorted by speed */
  a += state->first_one;
  b += state->first_two;
  gg_dsmc_lane_two(&samples->rng, part, &more, &spare);
  gg_vd majorant = state->most;
  if (!state->correction_pass)
    majorant =
        gg_smaller((gg_dsmc_roots_at(state->bound_one, a) + gg_dsmc_roots_at(state->bound_two, b)) * root, majorant);
  gg_vd u = gg_dsmc_lane_one_to_two(more) - 1;
  gg_mask odd = features.same ? gg_same_word(a, b) : gg_less(majorant, majorant); /* false in all lanes */
  if (state->any_odd) odd = gg_or(odd, gg_or(gg_same_word(a, state->odd_one), gg_same_word(b, state->odd_two)));
  gg_vu one = a, two = b;
  if (features.same) {
    one = gg_select_words(backwards, b, a);
    two = gg_select_words(backwards, a, b);
  }
  two |= (gg_vu)gg_where(odd, (gg_vd)gg_all_words(GG_DSMC_ODD));
  gg_mask keep = gg_or(gg_less(u * state->most_rate, majorant + state->s0), odd);
  if (n < GG_DSMC_LANES) keep = gg_and(keep, gg_below_word(number, gg_all_words(n)));
  gg_pack(pairs->one + pairs->n, keep, (gg_vd)one);
  gg_pack(pairs->two + pairs->n, keep, (gg_vd)two);
  gg_pack(pairs->order + pairs->n, keep, (gg_vd)more);
  gg_pack(pairs->majorant + pairs->n, keep, majorant);
  if (features.shear != GG_DSMC_UNSHEARED) {
    gg_vd numbers = __builtin_convertvector((gg_vi)number, gg_vd);
    gg_pack(pairs->strains + pairs->n, keep, (gg_real)pairs->strain + numbers * step);
    gg_pack(pairs->per_scale + pairs->n, keep, gg_all(state->per_scale));
  }
  pairs->n += (unsigned)__builtin_popcount(gg_bits(keep));
}

/* Make room at the end of the lists. */
GG_INLINE void gg_dsmc_block_pairs_move_up(gg_dsmc_features features, gg_dsmc_block_pairs *pairs)
{
  gg_real *const lists[] = {pairs->one, pairs->two, pairs->order, pairs->majorant, pairs->strains, pairs->per_scale};
  for (unsigned k = 0; k < (features.shear != GG_DSMC_UNSHEARED ? 6u : 4u); k++)
    for (unsigned i = 0; i < pairs->n - pairs->at; i++) lists[k][1 + i] = lists[k][pairs->at + i];
  pairs->n -= pairs->at - 1;
  pairs->at = 1;
}

/* Make eight draws, and keep the accepted block pairs. */
GG_INLINE void gg_dsmc_draw(gg_dsmc_features features, gg_dsmc_pass_state *state, gg_dsmc_samples *samples,
                            gg_dsmc_block_pairs *pairs, double strain_step)
{
  const unsigned n = pairs->left < GG_DSMC_LANES ? (unsigned)pairs->left : GG_DSMC_LANES;
  if (__builtin_expect(pairs->n + GG_DSMC_LANES > GG_DSMC_BLOCK_PAIRS, 0)) gg_dsmc_block_pairs_move_up(features, pairs);
  if (features.shear != GG_DSMC_UNSHEARED) {
    const double delta = n * strain_step;
    /* The strain only grows, so an earlier scale is valid. */
    state->per_scale = (gg_real)(gg_dsmc_per_bound(state->scale) * state->margin);
    if (!(state->margin > 1)) state->scale *= gg_dsmc_bound_growth(delta);
    state->root = (gg_real)(sqrt(state->scale) * (1 + 1e-6));
  }
  for (int part = 0; part < GG_PARTS; part++)
    gg_dsmc_draw_part(features, state, samples, pairs, part, state->root, (gg_real)strain_step, n);
  pairs->strain += n * strain_step;
  pairs->left -= n;
}

/* Draw more block pairs if few are left. */
GG_INLINE void gg_dsmc_draw_ahead(gg_dsmc_features features, gg_dsmc_pass_state *state, gg_dsmc_samples *samples,
                                  gg_dsmc_block_pairs *pairs, double strain_step)
{
  if (pairs->n - pairs->at >= (state->sorts ? GG_DSMC_PREFETCH_FROM : GG_DSMC_PREFETCH_SMALL)) return;
  while (pairs->left && pairs->n - pairs->at < (state->sorts ? GG_DSMC_PREFETCH_TO : GG_DSMC_PREFETCH_SMALL))
    gg_dsmc_draw(features, state, samples, pairs, strain_step);
}

/* Insert a correction for a majorant overflow: the block pair is repeated as the next one, over the layer from `lowest`
 * to `majorant`. It has no block in common with pairs that have begun since. */
GG_INLINE void gg_dsmc_draw_correction(gg_dsmc_features features, gg_dsmc_block_pairs *pairs, uint32_t one,
                                       uint32_t two, gg_word order, gg_real lowest, gg_real majorant, gg_real strain,
                                       gg_real per_scale)
{
  const unsigned i = --pairs->at;
  pairs->correction = true;
  pairs->lowest = lowest;
  gg_dsmc_list(pairs->one, i, one);
  gg_dsmc_list(pairs->two, i, two);
  gg_dsmc_list(pairs->order, i, order);
  pairs->majorant[i] = majorant;
  if (features.shear == GG_DSMC_UNSHEARED) return;
  pairs->strains[i] = strain;
  pairs->per_scale[i] = per_scale;
}

#endif
