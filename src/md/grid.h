/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The grid of cells with everything that a kind of search keeps beside it: neighbour lists, and the surfaces near each
 * cell. */
#ifndef GG_MD_GRID_H
#define GG_MD_GRID_H

#include "common/surface/surface.h"
#include "md/md_state.h"

/* grid.c: choose and make the grid that suits the model. */
gg_status gg_md_make_grid(gg_md *e, gg_error *err);
/* Make n[] empty cells for e->search.kind. */
gg_status gg_md_make_cells(gg_md *e, const int32_t n[3], double reach, gg_error *err);
/* Make neighbour lists with skins of this radius and their cells; nothing is made if the box is too narrow for lists.
 */
gg_status gg_md_make_lists(gg_md *e, double radius, gg_error *err);
void gg_md_set_skins(gg_md *e, double radius);
/* Find the cells of all grains from their positions. */
void gg_md_enter_grid(gg_md *e);
/* Fill the cells with the grains that belong there. False: out of memory. */
bool gg_md_fill_grid(gg_md *e);

/* lists.c: renew skin and list of every grain at the present time. If lists overflow, all skins become smaller. False:
 * `stop` (NULL: none) interrupted it, and lists are missing. */
bool gg_md_build_lists(gg_md *e, const gg_stop *stop);

/* wall_contacts.c: fill search.near for the present cells. */
gg_status gg_md_find_near_surfaces(gg_md *e, gg_error *err);
/* Time until a grain of this cell touches a surface that is no plane. */
double gg_md_shaped_delay(const gg_md *e, const gg_surface *surface, const gg_flight *flight, const int32_t *cell);

#endif
