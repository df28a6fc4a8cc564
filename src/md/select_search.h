/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Choice of the neighbour search and of the grid of cells that suit a model. */
#ifndef GG_MD_SELECT_SEARCH_H
#define GG_MD_SELECT_SEARCH_H

#include "md/md_state.h"

/* The largest distance at which two grains touch. */
double gg_md_reach(const gg_model *model);
/* The fastest search for a model, with the number of cells. *radius: of the skins; 0 if the search has no lists. */
gg_md_search_kind gg_md_search_select(const gg_model *model, double *radius, int32_t n[3]);
/* Count the cells for the centres of lists. False: the box has fewer than three cells along an edge, or a pair of
 * listed grains could have two nearest images. */
bool gg_md_fit_lists(const gg_model *model, double radius, int32_t n[3]);
/* True if this search has small cells (cell_grid.h) for this model. */
bool gg_md_has_small_cells(const gg_model *model, gg_md_search_kind kind);
/* Cells that all grains together cross between two collisions, at the initial temperature. */
double gg_md_crossings_per_collision(const gg_model *model);

#endif
