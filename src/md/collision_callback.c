/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Collision callback. While a callback is set, the resolution of contacts is wrapped by one that reports them; a run
 * without a callback has no cost. */
#include <math.h>

#include "common/surface/shapes.h"
#include "md/epoch.h"
#include "md/md_thermostat.h"
#include "md/resolution.h"

static void show_grain(const gg_md *e, uint32_t i, int which, gg_collision_record *m)
{
  const gg_md_grain *g = &e->grain[i];
  double height = g->r.y - 0.5 * e->box.edge[1];
  gg_vec c = g->v;
  c.x -= e->model.shear_rate * height;
  m->id[which] = e->id[i];
  m->species[which] = gg_md_species_of(g);
  m->c[which] = gg_scale(e->k.scale, c);
  m->height[which] = height;
  if (e->spin && e->model.walled) m->s[which] = gg_md_spin(e, i);
  m->since[which] = (e->k.now - e->last[i]) / e->k.scale; /* with the present scale of a Gaussian thermostat */
}

static void show_spin_changes(const gg_md *e, uint32_t i, uint32_t j, gg_collision_record *m)
{
  if (!e->spin || !e->model.walled) return;
  m->turn[0] = gg_sub(gg_md_spin(e, i), m->s[0]);
  if (j != i) m->turn[1] = gg_sub(gg_md_spin(e, j), m->s[1]);
}

void gg_md_show_collision(gg_md *e, uint32_t i, uint32_t j, gg_vec dr, gg_vec c12)
{
  gg_collision_record m = {
      .k = gg_scale(1 / sqrt(gg_dot(dr, dr)), dr), .c12 = gg_scale(e->k.scale, c12), .time = gg_md_time(e)};
  show_grain(e, i, 0, &m);
  show_grain(e, j, 1, &m);
  const gg_vec before = e->grain[j].v;
  const double scale = e->k.scale; /* of the velocities before: a Gaussian thermostat changes it with every loss */
  e->resolve_shown(e, i, j, dr, c12);
  m.J = gg_scale(scale * e->model.mass[m.species[1]], gg_sub(e->grain[j].v, before));
  show_spin_changes(e, i, j, &m);
  e->callback(e->callback_context, &m);
}

void gg_md_show_contact(gg_md *e, uint32_t i, int w)
{
  const gg_surface *surface = &e->model.surface[w];
  gg_collision_record m = {.k = gg_surface_normal(surface, &e->grain[i].r),
                           .time = gg_md_time(e),
                           .wall = w + 1,
                           .id[1] = -1,
                           .c[1] = surface->velocity,
                           .since[1] = INFINITY};
  show_grain(e, i, 0, &m);
  m.height[1] = surface->place - 0.5 * e->box.edge[1];
  m.c12 = gg_sub(m.c[0], m.c[1]);
  e->resolve_surface_shown(e, i, w);
  m.J = gg_scale(e->model.mass[m.species[0]], gg_sub(m.c[0], e->grain[i].v));
  show_spin_changes(e, i, i, &m);
  e->callback(e->callback_context, &m);
}
