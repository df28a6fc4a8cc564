#include "dsmc/segments.h"

int gg_segments_of(size_t blocks)
{
  return blocks < 8000 ? 1 : blocks < 32000 ? 8 : 16;
}

gg_range gg_all_blocks(const gg_population *p)
{
  return (gg_range){0, (uint32_t)p->n_blocks};
}

static uint32_t beginning(const gg_population *p, int segments, int segment)
{
  enum { LINE = 64 / sizeof *p->top };
  if (segment == segments) return (uint32_t)p->n_blocks;
  return (uint32_t)(p->n_blocks * (size_t)segment / (size_t)segments / LINE * LINE);
}

gg_range gg_segment(const gg_population *p, int segments, int segment)
{
  uint32_t first = beginning(p, segments, segment);
  return (gg_range){first, beginning(p, segments, segment + 1) - first};
}

int gg_meetings(int segments, int round)
{
  return round ? segments / 2 : segments;
}

/* The round robin of the circle: the last one stands still and the others go round. */
void gg_meeting_of(int segments, int round, int meeting, int *one, int *two)
{
  const int circle = segments - 1;
  *one = round ? (round + meeting) % circle : meeting;
  *two = round == 0 ? meeting : meeting == 0 ? circle : (round - meeting + circle) % circle;
}

void gg_tournament_start(gg_tournament *t, uint64_t seed, uint64_t stream)
{
  uint64_t next = stream + GG_STREAM_SEGMENTS;
  t->rng = gg_rng_seed(seed, next++);
  for (int k = 0; k < GG_MOST_SEGMENTS; k++) {
    t->draws[k] = gg_rng_seed(seed, next++);
    gg_rng_lanes_seed(&t->lanes[k], seed, next);
    next += GG_LANES;
  }
}

int gg_next_round(gg_tournament *t, int segments)
{
  if (t->next % (uint64_t)segments == 0) {
    t->next = 0;
    for (int i = 0; i < segments; i++) { /* Fisher & Yates' shuffle */
      uint32_t j = gg_rng_below(&t->rng, (uint32_t)i + 1);
      t->order[i] = t->order[j];
      t->order[j] = (uint8_t)i;
    }
  }
  return t->order[t->next++];
}
