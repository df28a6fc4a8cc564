/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A state that was read: is it one that the event loop can continue from? A checkpoint says what stands in every
 * record, and somebody may have written it to lead the loop out of its arrays. What is looked at here is what the loop
 * takes for granted: every index, every number that an index is made of, and that the events of a grain come before it
 * has gone far. What a state means is not looked at. */
#ifndef GG_MD_VERIFY_H
#define GG_MD_VERIFY_H

#include "md/md_state.h"

/* Is it the search that the model asks for, in as many cells? */
bool gg_md_is_search_of(const gg_model *model, const int32_t cells[3], double skin_radius, bool overlapping,
                        bool comoving);
/* The counts, of a grid of so many cells. */
bool gg_md_are_counts(const gg_md_counts *k, const int32_t cells[3]);
/* Grains, events, spins, numbers, lists; before they are put into cells and event queue. NULL, or what is wrong. */
const char *gg_md_wrong_grains(const gg_md *e);

/* verify.c: inspect all grains, once in as many events as there are grains. False: a position, velocity or spin is NaN
 * or infinite, and e->no_number is set. */
bool gg_md_check_numbers(gg_md *e);

#endif
