/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "md/images.h"

#include <stdlib.h>

#include "base/memory.h"

gg_status gg_md_keep_images(gg_engine *engine, gg_error *err)
{
  gg_md *e = (gg_md *)engine;
  if (!e->image) e->image = gg_base_array_new(e->n, sizeof *e->image, err);
  return e->image ? GG_OK : GG_FAILED;
}

double gg_md_turns(const gg_md *e)
{
  return e->k.image_turns + gg_floor((e->box.offset0 + e->box.image_velocity * e->k.now) * e->box.inverse[0]);
}

void gg_md_move_images(gg_md *e, double t)
{
  e->k.image_turns += gg_floor((e->box.offset0 + e->box.image_velocity * t) * e->box.inverse[0]);
  e->box.offset0 = gg_md_offset(&e->box, t);
}

static int32_t sum(int32_t a, double b)
{
  return (int32_t)((int64_t)a + (int64_t)b);
}

gg_md_image gg_md_image_after(const gg_md *e, gg_md_image image, gg_vec was, gg_vec is)
{
  const double layers = gg_nearest((was.y - is.y) * e->box.inverse[1]),
               x = was.x - is.x - layers * gg_md_offset(&e->box, e->k.now);
  const double turns = layers != 0 ? layers * gg_md_turns(e) : 0;
  return (gg_md_image){sum(image.x, gg_nearest(x * e->box.inverse[0]) - turns), sum(image.y, layers),
                       sum(image.z, gg_nearest((was.z - is.z) * e->box.inverse[2]))};
}

void gg_md_count_image(gg_md *e, uint32_t i, gg_vec was)
{
  e->image[i] = gg_md_image_after(e, e->image[i], was, e->grain[i].r);
}

/* Under shear the peculiar velocity is that of the image. */
void gg_md_wrap(const gg_md *e, gg_vec *r)
{
  double layers = gg_floor(r->y * e->box.inverse[1]);
  if (gg_model_is_sheared(&e->model)) r->x -= layers * gg_md_offset(&e->box, e->k.now);
  for (int a = 0; a < 3; a++) {
    if (e->box.inverse[a] == 0) continue; /* no image between walls, or above an open top */
    double x = gg_wrap(gg_along(r, a), e->box.edge[a], e->box.inverse[a]);
    *gg_component(r, a) = x < e->box.edge[a] ? x : 0;
  }
}

gg_status gg_md_take_images(gg_md *e, const gg_md *before, gg_error *err)
{
  GG_TRY(gg_md_keep_images(&e->base, err));
  gg_md_image *by_number = gg_base_array_new(e->n, sizeof *by_number, err);
  if (!by_number) return GG_FAILED;
  for (uint32_t i = 0; i < e->n; i++) {
    const gg_vec was = gg_md_position(before, before->falls, &before->grain[i], before->k.now);
    gg_vec is = was;
    gg_md_wrap(before, &is);
    by_number[before->id[i]] = gg_md_image_after(before, before->image[i], was, is);
  }
  for (uint32_t i = 0; i < e->n; i++) e->image[i] = by_number[e->id[i]];
  free(by_number);
  return GG_OK;
}
