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

/* Between the two ends of y two grains pass each other. */
static gg_status check_room(const gg_model *m, gg_error *err)
{
  double room = m->box[1], widest = 0;
  for (int i = 0; i < m->n_species; i++) widest = fmax(widest, m->diameter[i]);
  for (int w = 0; w < m->n_surfaces; w++) room -= m->surface[w].axis == 1 ? gg_surface_height(&m->surface[w]) : 0;
  if (room == m->box[1] || room >= 2 * widest) return GG_OK; /* of flat walls the box alone decides */
  return gg_fail(err, GG_BAD_INPUT,
                 "walls: what stands on them leaves %.3g of the %.3g diameters between them free; at least %.3g are "
                 "needed",
                 room, m->box[1], 2 * widest);
}

static gg_surface end_of_gap(const gg_model *m, double side, double speed)
{
  return (gg_surface){.word = side > 0 ? "upper" : "lower",
                      .title = side > 0 ? "a wall above" : "a wall below",
                      .shape = GG_SHAPE_plane,
                      .axis = 1,
                      .side = side,
                      .place = side > 0 ? m->box[1] : 0,
                      .velocity = {side * speed, 0, 0}};
}

gg_status gg_surfaces_make(const gg_scene *s, bool spins, double time_unit, gg_model *m, gg_error *err)
{
  double speed = gg_flow_has_moving_walls(s->flow) ? s->walls.speed * time_unit / s->species[0].diameter : 0;
  bool open = gg_flow_of(s->flow)->may_be_open && s->walls.top == GG_OPEN_TOP;
  m->n_surfaces = 0;
  if (!gg_flow_is_walled(s->flow)) return GG_OK;
  for (double side = -1; side <= (open ? -1 : 1); side += 2) add(m, s, spins, end_of_gap(m, side, speed));
  return check_room(m, err);
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
