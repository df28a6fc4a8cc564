#include "common/surface/surfaces.h"

#include "common/surface/shapes.h"

static void add(gg_model *m, const gg_scene *s, bool spins, gg_surface surface)
{
  const gg_partner wall = {INFINITY, 1};
  for (int i = 0; i < GG_MAX_SPECIES; i++) {
    gg_partner grain = {m->mass[i], spins ? m->inertia[i] : INFINITY};
    surface.contact[i] = gg_contact_make(grain, wall, s->walls.e, s->walls.beta, s->walls.mu);
    surface.treated[i] = gg_contact_make(grain, wall, 1, s->walls.beta, s->walls.mu);
  }
  m->surface[m->n_surfaces++] = surface;
}

void gg_surfaces_make(const gg_scene *s, bool spins, double time_unit, gg_model *m)
{
  double speed = gg_flow_has_moving_walls(s->flow) ? s->walls.speed * time_unit / s->species[0].diameter : 0;
  m->n_surfaces = 0;
  if (!gg_flow_is_walled(s->flow)) return;
  add(m, s, spins,
      (gg_surface){.word = "lower",
                   .title = "a wall below",
                   .shape = GG_SHAPE_plane,
                   .axis = 1,
                   .side = -1,
                   .place = 0,
                   .velocity = {-speed, 0, 0}});
  if (gg_flow_of(s->flow)->may_be_open && s->walls.top == GG_OPEN_TOP) return;
  add(m, s, spins,
      (gg_surface){.word = "upper",
                   .title = "a wall above",
                   .shape = GG_SHAPE_plane,
                   .axis = 1,
                   .side = 1,
                   .place = m->box[1],
                   .velocity = {speed, 0, 0}});
}

const gg_surface *gg_surface_at(const gg_model *m, int axis, double side)
{
  for (int w = 0; w < m->n_surfaces; w++)
    if (m->surface[w].axis == axis && m->surface[w].side == side) return &m->surface[w];
  return NULL;
}

bool gg_is_closed(const gg_model *m, int axis)
{
  return gg_surface_at(m, axis, 1) || gg_surface_at(m, axis, -1);
}

bool gg_is_open_above(const gg_model *m)
{
  return m->walled && !gg_surface_at(m, 1, 1);
}

int gg_surface_image(const gg_model *m, int w)
{
  const gg_surface *s = &m->surface[w];
  if (s->axis != 1) return w;
  const gg_surface *image = gg_surface_at(m, 1, -s->side);
  return image ? (int)(image - m->surface) : -1;
}
