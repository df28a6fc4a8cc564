/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Instances of the event loop, by the features of a scene. Each is compiled into an object of its own (instance.c), and
 * instances that predict a batch of pairs at a time once for every set of instructions. All give the same bits. */
#ifndef GG_MD_EVENT_LOOPS_H
#define GG_MD_EVENT_LOOPS_H

#include "md/md_state.h"
#include "simd/dispatch.h"

enum gg_md_boundary { GG_MD_PERIODIC, GG_MD_SHEARED, GG_MD_WALLED, GG_MD_FALLING };

/* Instance of a compiled set of instructions; NULL: none with these features. */
const gg_md_kernel *gg_md_simd_kernel(gg_instructions set, gg_md_search_kind kind, enum gg_md_boundary boundary,
                                      bool mixture);

/* Select the kernel and the resolutions that this model needs. */
void gg_md_select(gg_md *e);

#endif
