/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Snapshot of the grains at the present time, with peculiar velocities, in chunks of a few hundred. */
#include "md/md_operations.h"

#include "md/epoch.h"
#include "md/images.h"

enum { SHOWN = 256 }; /* grains of a chunk: they stay in the first cache until they have been sampled */

typedef struct scratch {
  double r[3][SHOWN], c[3][SHOWN], s[3][SHOWN];
  int32_t image[3][SHOWN];
  uint8_t species[SHOWN];
  int64_t id[SHOWN];
} scratch;

static void show_grain(const gg_md *e, uint32_t i, size_t slot, bool positions, scratch *out)
{
  const gg_md_grain *g = &e->grain[i];
  gg_vec r = gg_md_position(e, e->falls, g, e->k.now),
         c = gg_scale(e->k.scale, gg_md_velocity(e, e->falls, g, e->k.now));
  c.x -= e->model.shear_rate * (r.y - 0.5 * e->box.edge[1]);
  const gg_vec was = r;
  if (positions) gg_md_wrap(e, &r);
  if (positions && e->image) {
    const gg_md_image image = gg_md_image_after(e, e->image[i], was, r);
    out->image[0][slot] = image.x, out->image[1][slot] = image.y, out->image[2][slot] = image.z;
  }
  const gg_vec none = {0, 0, 0}, s = e->spin ? gg_md_spin(e, i) : none;
  for (int a = 0; a < 3; a++) {
    out->r[a][slot] = gg_along(&r, a);
    out->c[a][slot] = gg_along(&c, a);
    out->s[a][slot] = gg_along(&s, a);
  }
  out->species[slot] = (uint8_t)gg_md_species_of(g);
  out->id[slot] = e->id[i];
}

void gg_md_snapshot(gg_engine *engine, bool positions, gg_visit *visit, void *context)
{
  const gg_md *e = (const gg_md *)engine;
  scratch out;
  for (uint32_t begin = 0; begin < e->n; begin += SHOWN) {
    gg_chunk chunk = {.n = e->n - begin < SHOWN ? e->n - begin : SHOWN};
    for (size_t k = 0; k < chunk.n; k++) show_grain(e, begin + (uint32_t)k, k, positions, &out);
    for (int a = 0; a < 3; a++) {
      chunk.r[a] = positions ? out.r[a] : NULL;
      chunk.c[a] = out.c[a];
      chunk.s[a] = e->spin ? out.s[a] : NULL;
      chunk.image[a] = positions && e->image ? out.image[a] : NULL;
    }
    chunk.species = e->model.n_species > 1 ? out.species : NULL;
    chunk.id = positions ? out.id : NULL;
    visit(context, &chunk);
  }
}
