/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Round-robin schedule of the collisions between the segments of an ensemble.
 *
 * In each round every segment is paired with one other segment (or with itself), so the pairs of a round have no grain
 * in common and can run at once. A pair can begin as soon as both of its segments have finished the round before.
 * Everything that is carried from one pair to the next belongs to a segment or to a pair of segments (random streams,
 * fractional remainders of candidates, scales of speed bounds), and results are added in the order of segments: the
 * bits do not depend on the assignment of pairs to threads.
 *
 * A round lasts for a part of the step, with a rate that accounts for all the segments that a grain is not paired with
 * meanwhile. So the collision rate of any pair over a whole schedule is right. The rate of a grain is right at any
 * time, because all segments are alike: grains are distributed to them at random, each is sorted by speed in the same
 * way, and they exchange grains whenever they are paired. So rounds are no splitting of the step: nothing is advanced
 * by more than its part of the time.
 *
 * Every schedule has its rounds in a random order. Rounds in which the same quarters of the segments are paired are
 * adjacent, and a schedule begins with the grouping at the end of the last one, so that segments change threads, and
 * caches, twice a schedule. */
#ifndef GG_DSMC_SCHEDULE_H
#define GG_DSMC_SCHEDULE_H

#include "dsmc/kernel/pass.h"

/* Most segments, parts of a large ensemble for several threads. */
enum { GG_DSMC_MAX_SEGMENTS = 16 };

/* Number of segments for so many blocks: 1 below 8000, else 8 or 16. */
int gg_dsmc_segments_of(size_t blocks);

gg_dsmc_range gg_dsmc_all_blocks(const gg_dsmc_population *p);
/* Blocks of a segment. Segments begin on cache lines of the speed bounds. */
gg_dsmc_range gg_dsmc_segment(const gg_dsmc_population *p, int segments, int segment);

/* Number of pairs in a round, 0 to segments - 1; in round 0 each segment is paired with itself. */
int gg_dsmc_segment_pairs(int segments, int round);
/* Segments of a pair of a round. */
void gg_dsmc_segment_pair(int segments, int round, int pair, int *one, int *two);

/* Segment of part `part`, for work on all segments in `segments` parts. Quarters 0 and `grouping` were last in one half
 * of the pairs; each half of the parts has the segments that its threads had before. */
int gg_dsmc_segment_in(int segments, int grouping, int part);

/* State of the schedule of an ensemble: plain data, saved as bytes. */
typedef struct gg_dsmc_schedule {
  gg_rng order_rng; /* for the order */
  uint64_t next;    /* next round, an index of `order` */
  uint8_t order[GG_DSMC_MAX_SEGMENTS];
  gg_rng rng[GG_DSMC_MAX_SEGMENTS]; /* by segment that is the first one of a pair */
  gg_dsmc_rng_lanes lanes[GG_DSMC_MAX_SEGMENTS];
  double remainder[][GG_DSMC_MAX_SEGMENTS]
                  [GG_DSMC_MAX_SEGMENTS]; /* fractional remainders of candidates, by pair of species */
} gg_dsmc_schedule;

/* Size of the struct for so many species, in bytes. */
GG_INLINE size_t gg_dsmc_schedule_size(int n_species)
{
  const gg_dsmc_schedule *s = NULL;
  return sizeof *s + (size_t)gg_pairs_of(n_species) * sizeof s->remainder[0];
}

/* Seed the schedule by its own random streams. */
void gg_dsmc_schedule_start(gg_dsmc_schedule *s, uint64_t seed, uint64_t stream);
/* Take the next round. */
int gg_dsmc_next_round(gg_dsmc_schedule *s, int segments);

#endif
