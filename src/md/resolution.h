/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Choice of the function that resolves a contact, and functions that wrap it. */
#ifndef GG_MD_RESOLUTION_H
#define GG_MD_RESOLUTION_H

#include "md/md_state.h"

/* resolve.c: select the resolutions that this model and its callback need. */
void gg_md_select_resolution(gg_md *e);

/* collision_callback.c: report the collision to the callback and resolve it by e->resolve_shown. */
gg_md_resolution gg_md_show_collision;
/* The same for a contact with a surface, by e->resolve_surface_shown. */
gg_md_surface_resolution gg_md_show_contact;

/* separating_pairs.c: resolve a contact by e->resolve_parted so that the pair separates, whatever rounding does. */
gg_md_resolution gg_md_resolve_parting;
/* The same in place of e->resolve, for a pair that collides again at the same time. */
gg_md_resolution gg_md_resolve_again;
/* True if this model needs gg_md_resolve_parting at every collision. */
bool gg_md_needs_parting(const gg_model *model);

#endif
