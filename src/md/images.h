/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Unwrapped positions: engines may count the images of the box that each grain enters. With the counts x, y, z the
 * unwrapped position r + (x L_x + y S, y L_y, z L_z) is continuous in time. S is the total displacement of the image
 * above (box.h): the offset D and `image_turns` edges. A step into the image above adds 1 to y, and subtracts the edges
 * in S from x. */
#ifndef GG_MD_IMAGES_H
#define GG_MD_IMAGES_H

#include "md/md_state.h"

/* Count from now on: the present images have the number 0. */
gg_status gg_md_keep_images(gg_engine *engine, gg_error *err);
/* The same, from the images of another engine with the same grains on. */
gg_status gg_md_take_images(gg_md *e, const gg_md *before, gg_error *err);
/* The image of a grain whose position at the present time is replaced by one of its images. */
gg_md_image gg_md_image_after(const gg_md *e, gg_md_image image, gg_vec was, gg_vec is);
/* Grain i, which was at `was`, has been replaced by its image in the box. Only if images are counted. */
void gg_md_count_image(gg_md *e, uint32_t i, gg_vec was);
/* Edges by which the image above has moved at the present time, beside the offset. */
double gg_md_turns(const gg_md *e);
/* Move the images of the box to epoch time t, at which a new epoch begins. */
void gg_md_move_images(gg_md *e, double t);
/* Replace a position at the present time by its image in the box. */
void gg_md_wrap(const gg_md *e, gg_vec *r);

#endif
