/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Validation of a restored state. A checkpoint defines every record, and a crafted one could lead the event loop out of
 * its arrays. Checked is what the loop relies on: every index, every number that an index is computed from, and that
 * the next event of a grain comes before it is far away. The physics of a state is not checked. */
#ifndef GG_MD_VERIFY_H
#define GG_MD_VERIFY_H

#include "md/md_state.h"

/* True if this is the search, with this number of cells, that the model needs. */
bool gg_md_is_search_of(const gg_model *model, const int32_t cells[3], double skin_radius, bool overlapping,
                        bool comoving);
/* Validate the counts, for a grid of so many cells. */
bool gg_md_are_counts(const gg_md_counts *k, const int32_t cells[3]);
/* Validate grains, events, spins and lists before they enter cells and event queue. Returns the first error, or NULL.
 */
const char *gg_md_wrong_grains(const gg_md *e);

/* Inspect all grains, once in as many events as there are grains. False: a position, velocity or spin is NaN or
 * infinite, and e->no_number is set. */
bool gg_md_check_numbers(gg_md *e);

#endif
