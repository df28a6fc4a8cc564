/* A large ensemble in segments, so that threads can share it.
 *
 * Collisions go in rounds, like a tournament: in each, every segment meets one other (or itself), so that the meetings
 * of a round have no grain in common and may take place at once. A meeting may begin as soon as both of its segments
 * have done with theirs of the round before. All that goes from meeting to meeting belongs to a segment or to a pair of
 * them (random streams, a remainder of candidates, how far tops hold), and what is handed back is added up in the order
 * of segments: the bits do not depend on who plays which, when.
 *
 * A round lasts for a part of the step and makes up for all the segments that a grain does not meet meanwhile: the
 * collision rate of any pair over a whole tournament is what it should be, and that of a grain at any time, because all
 * segments are alike: grains come into them at random, sorting by speed goes on in each of them in the same way, and
 * they exchange grains whenever they meet. So rounds are no splitting of the step: nothing is advanced by more than its
 * part of the time. Every tournament has its rounds in a random order, those together in which the same quarters meet,
 * and begins with those that the last one has ended with, so that segments change hands, and caches, twice a
 * tournament.
 */
#ifndef GG_DSMC_SEGMENTS_H
#define GG_DSMC_SEGMENTS_H

#include "common/crew.h"
#include "dsmc/kernel/pairing.h"

enum { GG_MOST_SEGMENTS = 16 };

/* How many an ensemble of so many blocks is cut into: 1 below 8000, else 8 or 16. */
int gg_segments_of(size_t blocks);

gg_range gg_all_blocks(const gg_population *p);
/* Blocks of a segment; segments begin on cache lines of the tops. */
gg_range gg_segment(const gg_population *p, int segments, int segment);

/* Meetings of a round, 0 to segments - 1; in round 0 each meets itself. */
int gg_meetings(int segments, int round);
void gg_meeting_of(int segments, int round, int meeting, int *one, int *two);

/* The segment of part `part` (0 to segments - 1) of what goes through all, where quarters 0 and `halves` were last in
 * one half of the meetings: each half has its own in the half of the parts that goes with it. */
int gg_segment_in(int segments, int halves, int part);

/* What the tournaments of an ensemble need: plain data, saved as it is. */
typedef struct gg_tournament {
  gg_rng rng;    /* of the order */
  uint64_t next; /* round to play, in its order */
  uint8_t order[GG_MOST_SEGMENTS];
  double owed[GG_PAIRS][GG_MOST_SEGMENTS][GG_MOST_SEGMENTS]; /* fractions of candidates */
  gg_rng draws[GG_MOST_SEGMENTS];                            /* by segment: the first one of a meeting */
  gg_rng_lanes lanes[GG_MOST_SEGMENTS];
} gg_tournament;

/* From streams of their own of this seed. */
void gg_tournament_start(gg_tournament *t, uint64_t seed, uint64_t stream);
/* The next round. */
int gg_next_round(gg_tournament *t, int segments);

#endif
