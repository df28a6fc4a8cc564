/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One run on several cores, with the bits of a run on one: docs/explanation/md.md has the method. */
#ifndef GG_MD_PARALLEL_PARALLEL_H
#define GG_MD_PARALLEL_PARALLEL_H

#include "md/md_state.h"

/* Why threads cannot share the events of this model, whatever its size; NULL: they can. */
const char *gg_md_serial_because(const gg_model *model);
/* Most slabs into which a box of this model is partitioned; 1: it is too small. */
int gg_md_most_slabs(const gg_model *model);
/* Fewest grains for which several threads are faster than one. */
enum { GG_MD_FEWEST_PARALLEL = 30000 };

/* Run the events of this engine on up to so many threads, if the model allows it; 1: on one. `adapts`: only while
 * several threads are faster in wall time. */
void gg_md_use_threads(gg_md *e, int threads, bool adapts);
void gg_md_parallel_free(gg_md *e);

/* Run whole windows of events up to about e->k.stop or the end of the epoch. False: no window fits before it. */
bool gg_md_run_windows(gg_md *e);

/* Processor time of the other threads so far, in seconds. */
double gg_md_parallel_cpu(const gg_md *e);

/* thread_local.c: a thread-local engine, a copy of the engine for work beside other threads. It has its own candidates,
 * and its event queue stores nothing. */
gg_md *gg_md_local_new(void);
/* Copy the present state of the engine into it. */
void gg_md_local_renew(gg_md *local, const gg_md *engine);
void gg_md_local_free(gg_md *local);

#endif
