/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Parallel work of a start over all grains, with the same bits for any number of threads; and its interruption. */
#ifndef GG_MD_START_ALL_GRAINS_H
#define GG_MD_START_ALL_GRAINS_H

#include "md/md_state.h"

/* Grains of a start between two polls of `stop`: some milliseconds. */
enum { GG_MD_GRAINS_PER_POLL = 1 << 13 };

/* Work on the grains from `from` to `to` by a thread-local engine (parallel/parallel.h). It does not depend on the work
 * on other grains. False: give up the work on all grains. */
typedef bool gg_md_for_grains(gg_md *local, uint32_t from, uint32_t to);

typedef enum gg_md_all_grains {
  GG_MD_ALL_DONE,
  GG_MD_GIVEN_UP, /* a part returned false */
  GG_MD_STOPPED,
  GG_MD_NO_MEMORY
} gg_md_all_grains;

/* Run `part` over all grains. `stop` is polled (NULL: never). */
gg_md_all_grains gg_md_for_all_grains(gg_md *e, gg_md_for_grains *part, const gg_stop *stop);

/* Poll the model's `stop` between two parts of the start of a large system: GG_INTERRUPTED if it is set. */
gg_status gg_md_poll_stop(const gg_md *e, gg_error *err);
/* The error of a start that was stopped, or that ran out of memory. */
gg_status gg_md_start_stopped(const gg_md *e, gg_error *err);

#endif
