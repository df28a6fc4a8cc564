/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The round-robin schedule by which the segments of an ensemble collide with each other.
 *
 * In each round every segment is paired with one other (or with itself), so that the pairs of a round have no grain in
 * common and may run at once. A pair may begin as soon as both of its segments are done with theirs of the round
 * before. All that is carried from one pair to the next belongs to a segment or to a pair of them (random streams, a
 * fractional remainder of candidates, the scale of speed bounds), and what is handed back is added up in the order of
 * segments: the bits do not depend on which thread does what, when.
 *
 * A round lasts for a part of the step and makes up for all the segments that a grain is not paired with meanwhile: the
 * collision rate of any pair over a whole schedule is what it should be, and that of a grain at any time, because all
 * segments are alike: grains come into them at random, sorting by speed goes on in each of them in the same way, and
 * they exchange grains whenever they are paired. So rounds are no splitting of the step: nothing is advanced by more
 * than its part of the time.
 *
 * Every schedule has its rounds in a random order, those together in which the same quarters of the segments are
 * paired, and begins with those that the last one has ended with, so that segments change threads, and caches, twice a
 * schedule.
 */
#ifndef GG_DSMC_SCHEDULE_H
#define GG_DSMC_SCHEDULE_H

#include "dsmc/kernel/pass.h"

/* The partition of a large ensemble into segments of blocks, so that threads can share it. */
enum { GG_DSMC_MAX_SEGMENTS = 16 };

/* How many segments for so many blocks: 1 below 8000, else 8 or 16. */
int gg_dsmc_segments_of(size_t blocks);

gg_dsmc_range gg_dsmc_all_blocks(const gg_dsmc_population *p);
/* Blocks of a segment; segments begin on cache lines of the speed bounds. */
gg_dsmc_range gg_dsmc_segment(const gg_dsmc_population *p, int segments, int segment);

/* Pairs of segments in a round, 0 to segments - 1; in round 0 each is paired with itself. */
int gg_dsmc_segment_pairs(int segments, int round);
void gg_dsmc_segment_pair(int segments, int round, int pair, int *one, int *two);

/* Segments for work on all of them, in `segments` parts, where quarters 0 and `grouping` were last in one half of the
 * pairs: the segment of part `part`, so that each half of the parts has those that its threads had before. */
int gg_dsmc_segment_in(int segments, int grouping, int part);

/* What the schedule of an ensemble needs: plain data, saved as it is. */
typedef struct gg_dsmc_schedule {
  gg_rng order_rng; /* of the order */
  uint64_t next;    /* round to run, in its order */
  uint8_t order[GG_DSMC_MAX_SEGMENTS];
  gg_rng rng[GG_DSMC_MAX_SEGMENTS]; /* by segment: the first one of a pair */
  gg_dsmc_rng_lanes lanes[GG_DSMC_MAX_SEGMENTS];
  double remainder[][GG_DSMC_MAX_SEGMENTS][GG_DSMC_MAX_SEGMENTS]; /* fractional, of candidates; by pair of species */
} gg_dsmc_schedule;

/* Bytes of one for so many species. */
GG_INLINE size_t gg_dsmc_schedule_size(int n_species)
{
  const gg_dsmc_schedule *s = NULL;
  return sizeof *s + (size_t)gg_pairs_of(n_species) * sizeof s->remainder[0];
}

/* From streams of their own of this seed. */
void gg_dsmc_schedule_start(gg_dsmc_schedule *s, uint64_t seed, uint64_t stream);
/* The next round. */
int gg_dsmc_next_round(gg_dsmc_schedule *s, int segments);

#endif
