/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a start does for each grain, whatever has been done for others: threads share it, with the same bits. */
#ifndef GG_MD_START_ALL_GRAINS_H
#define GG_MD_START_ALL_GRAINS_H

#include "md/md_state.h"

/* For some grains, of a view of the engine (parallel/parallel.h), whose event queue takes in nothing; false: all that
 * is in vain. */
typedef bool gg_md_for_grains(gg_md *view, uint32_t from, uint32_t to);

/* `stop` is asked now and then; NULL: never. */
typedef enum gg_md_all_grains { GG_MD_ALL_DONE, GG_MD_IN_VAIN, GG_MD_STOPPED, GG_MD_NO_MEMORY } gg_md_all_grains;
gg_md_all_grains gg_md_for_all_grains(gg_md *e, gg_md_for_grains *part, const gg_stop *stop);

#endif
