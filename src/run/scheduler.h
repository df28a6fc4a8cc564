/* Threads that several runs in one process share, each run steered by a thread of its own (a course) that decides what
 * is next: which replicas are to take samples, and when a window is tested. The pieces of work that courses hand over
 * wait here; the next free thread takes one of the run whose relative error is the largest. Results do not depend on
 * it: a course is the same whoever works for it, and when. */
#ifndef GG_CREW_H
#define GG_CREW_H

#include "run/replicas.h"

/* `threads` of them, and no more are busy at a time, courses included. */
gg_status gg_run_crew_new(int threads, gg_crew **crew, gg_error *err);
/* Once every course has left. */
void gg_run_crew_free(gg_crew *crew);

/* A course begins and ends: in between it counts as busy, but while it waits for its pieces. */
void gg_run_crew_enter(gg_crew *crew);
void gg_run_crew_leave(gg_crew *crew);
/* While a course does what takes more patience than work, as writing to a disk. NULL: nothing happens. */
void gg_run_crew_pause(gg_crew *crew);
void gg_run_crew_go_on(gg_crew *crew);

/* Every replica takes samples until it has `due` of them; called by a course. */
gg_status gg_run_crew_advance(gg_crew *crew, gg_replicas *all, uint64_t due, bool adapt, const gg_hooks *hooks,
                              gg_error *err);

#endif
