/* Processes that share the replicas of runs, as rank 0 sees them. Each replica belongs to one of them, this one
 * included, for as long as that lives. A piece of work is to bring one replica to so many samples; what comes back is
 * its whole state, an archive, so that whoever has it can go on from there. */
#ifndef GG_WORKERS_H
#define GG_WORKERS_H

#include "run/replicas.h"
#include "run/workers/message.h"

/* The part of a run (one gg_replicas) in it. */
typedef struct gg_share gg_share;

/* NULL, with GG_OK: the run has no workers, or its scene holds callbacks, which live in this process alone. */
gg_status gg_run_share_open(gg_replicas *all, gg_share **share, gg_error *err);
void gg_run_share_close(gg_share *share);

/* Replicas that are not there are made, by those to whom they will belong. */
gg_status gg_run_share_create(gg_share *share, gg_error *err);
/* All replicas take samples until they have `due`. Meanwhile progress is reported; where a checkpoint is due,
 * all stop where they are, and this is GG_OK before its time. */
gg_status gg_run_share_advance(gg_share *share, uint64_t due, bool adapt, gg_error *err);
/* The replicas here were changed since they came back: who works on them needs them anew. */
void gg_run_share_changed(gg_share *share);
/* Of a replica, wherever it is. */
gg_replica_news gg_run_share_news(const gg_share *share, int i);
/* Is anyone at work? Then the replicas are not to be read. */
bool gg_run_share_is_busy(const gg_share *share);

#endif
