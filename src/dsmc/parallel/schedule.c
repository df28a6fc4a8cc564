/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "dsmc/parallel/schedule.h"

int gg_dsmc_segment_pairs(int segments, int round)
{
  return round ? segments / 2 : segments;
}

/* Smaller one of the two quarters other than 0 and c. */
static int second_half(int c)
{
  return c == 1 ? 2 : 1;
}

/* In round (c, k) segment i of quarter q is paired with segment i ^ k of quarter q ^ c. The first half of the pairs has
 * quarters 0 and c (or 1, if each quarter is paired within itself; gg_dsmc_segment_in maps it), the second half the
 * other quarters: a thread that runs the same half again has its segments in the cache. */
void gg_dsmc_segment_pair(int segments, int round, int pair, int *one, int *two)
{
  const int quarter = segments / 4, c = round / quarter, k = round % quarter;
  int q, i;
  if (c == 0) {
    const int each = k ? quarter / 2 : quarter, nth = pair % each;
    q = pair / each;
    /* The nth i that is smaller than i ^ k: the highest bit of k is not set in it. */
    int high = 1;
    while (2 * high <= k) high *= 2;
    i = k ? nth % high + nth / high * 2 * high : nth;
  } else {
    q = pair < quarter ? 0 : second_half(c);
    i = pair % quarter;
  }
  *one = q * quarter + i;
  *two = (q ^ c) * quarter + (i ^ k);
}

int gg_dsmc_segment_in(int segments, int grouping, int part)
{
  if (segments < 4 || grouping == 0) return part;
  const int quarter = segments / 4, at = part / quarter;
  const int q = (at < 2 ? 0 : second_half(grouping)) ^ (at % 2 ? grouping : 0);
  return q * quarter + part % quarter;
}

void gg_dsmc_schedule_start(gg_dsmc_schedule *s, uint64_t seed, uint64_t stream)
{
  uint64_t next = stream + GG_STREAM_SEGMENTS;
  s->order_rng = gg_common_rng_seed(seed, next++);
  for (int k = 0; k < GG_DSMC_MAX_SEGMENTS; k++) {
    s->rng[k] = gg_common_rng_seed(seed, next++);
    gg_dsmc_rng_lanes_seed(&s->lanes[k], seed, next);
    next += GG_DSMC_LANES;
  }
}

/* Numbers 0 to n - 1 in random order (Fisher & Yates). */
static void shuffle(gg_rng *rng, int n, uint8_t *list)
{
  for (int i = 0; i < n; i++) {
    uint32_t j = gg_rng_below(rng, (uint32_t)i + 1);
    list[i] = list[j];
    list[j] = (uint8_t)i;
  }
}

/* Grouping at the end of the last schedule; 0: this is the first schedule. */
static int last_grouping(const gg_dsmc_schedule *s, int segments)
{
  for (int n = segments - 1; n >= 0; n--)
    if (s->order[n] >= segments / 4) return s->order[n] / (segments / 4);
  return 0;
}

/* Order the quarters at random, but begin with the grouping at the end of the last schedule; c = 0 keeps any grouping.
 * All c are equally often at each place. */
static void order_quarters(gg_rng *rng, int last, uint8_t c[4])
{
  shuffle(rng, 4, c);
  const uint8_t first = c[0] ? c[0] : c[1];
  for (int n = 0; n < 4 && last; n++) c[n] = c[n] == first ? (uint8_t)last : c[n] == last ? first : c[n];
}

static void new_order(gg_dsmc_schedule *s, int segments)
{
  const int quarter = segments / 4;
  uint8_t c[4], k[GG_DSMC_MAX_SEGMENTS];
  order_quarters(&s->order_rng, last_grouping(s, segments), c);
  for (int n = 0; n < 4; n++) {
    shuffle(&s->order_rng, quarter, k);
    for (int i = 0; i < quarter; i++) s->order[n * quarter + i] = (uint8_t)(c[n] * quarter + k[i]);
  }
}

int gg_dsmc_next_round(gg_dsmc_schedule *s, int segments)
{
  if (s->next % (uint64_t)segments == 0) {
    s->next = 0;
    new_order(s, segments);
  }
  return s->order[s->next++];
}

int gg_dsmc_segments_of(size_t blocks)
{
  return blocks < 8000 ? 1 : blocks < 32000 ? 8 : 16;
}

gg_dsmc_range gg_dsmc_all_blocks(const gg_dsmc_population *p)
{
  return (gg_dsmc_range){0, (uint32_t)p->n_blocks};
}

static uint32_t beginning(const gg_dsmc_population *p, int segments, int segment)
{
  enum { LINE = 64 / sizeof *p->speed_bound };
  if (segment == segments) return (uint32_t)p->n_blocks;
  return (uint32_t)(p->n_blocks * (size_t)segment / (size_t)segments / LINE * LINE);
}

gg_dsmc_range gg_dsmc_segment(const gg_dsmc_population *p, int segments, int segment)
{
  uint32_t first = beginning(p, segments, segment);
  return (gg_dsmc_range){first, beginning(p, segments, segment + 1) - first};
}
