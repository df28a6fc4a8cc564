/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One run on several cores, with the bits of a run on one: docs/explanation/md.md has the method. */
#ifndef GG_MD_PARALLEL_H
#define GG_MD_PARALLEL_H

#include "md/md_state.h"

/* Why events of this model are handled one after another, whatever its size; NULL: threads may share them. */
const char *gg_md_serial_because(const gg_model *model);
/* Into how many slabs a box of this model is cut at most; 1: too small. */
int gg_md_most_slabs(const gg_model *model);
/* From so many grains on threads gain. */
enum { GG_MD_FEWEST_SHARED = 30000 };

/* Share the events of this engine out to so many threads, where that is possible; 1: no longer. `adapts`: only while
 * that is faster by the clock. */
void gg_md_share(gg_md *e, int threads, bool adapts);
void gg_md_parallel_free(gg_md *e);

/* Events up to about e->k.stop or the epoch's end in whole windows, as far as there is room for some; false: there was
 * none. */
bool gg_md_run_windows(gg_md *e);

/* The engine as it is now, for work beside others: with candidates of its own, and an event queue that takes in
 * nothing. Renewed where memory is there. */
gg_md *gg_md_view_new(void);
void gg_md_view_renew(gg_md *view, const gg_md *engine);
void gg_md_view_free(gg_md *view);

/* Processor time of the other threads so far, in seconds. */
double gg_md_parallel_cpu(const gg_md *e);

#endif
