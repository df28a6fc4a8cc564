/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "common/model.h"
#include "common/surface/shapes.h"

static void add(gg_model *m, const gg_scene *s, bool spins, gg_surface surface)
{
  const gg_partner wall = {INFINITY, 1};
  for (int i = 0; i < GG_MAX_SPECIES; i++) {
    gg_partner grain = {m->mass[i], spins ? m->inertia[i] : INFINITY};
    surface.contact[i] = gg_common_contact_make(grain, wall, s->walls.e, s->walls.beta, s->walls.mu);
    surface.treated[i] = gg_common_contact_make(grain, wall, 1, s->walls.beta, s->walls.mu);
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
  return gg_base_fail(
      err, GG_BAD_INPUT,
      "walls: their grains or ridges leave %.3g of the %.3g diameters between them free; at least %.3g are "
      "needed",
      room, m->box[1], 2 * widest);
}

/* Flat, or with half cylinders of so great a diameter that a whole number of them stands along x. */
static void set_shape(gg_surface *wall, const gg_scene *s, const gg_model *m)
{
  if (s->walls.ridges == 0) return;
  double number = fmax(1, round(m->box[0] * s->species[0].diameter / s->walls.ridges));
  wall->shape = GG_SHAPE_ridges;
  wall->radius = 0.5 * m->box[0] / number;
  wall->title = wall->side > 0 ? "a ridged wall above" : "a ridged wall below";
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

static void set_temperature(gg_surface *wall, const gg_scene *s, gg_units unit)
{
  const double T = s->walls.temperature[wall->side > 0];
  if (T == GG_AUTO || s->walls.accommodation == 0) return;
  wall->temperature = gg_units_temperature(unit, T);
  wall->accommodation = s->walls.accommodation;
}

gg_status gg_common_surfaces_make(const gg_scene *s, bool spins, gg_model *m, gg_error *err)
{
  double speed = gg_flow_has_moving_walls(s->flow) ? gg_units_velocity(m->unit, s->walls.speed) : 0;
  bool open = gg_flow_of(s->flow)->may_be_open && s->walls.top == GG_OPEN_TOP;
  m->n_surfaces = 0;
  if (!gg_flow_is_walled(s->flow)) return GG_OK;
  if (s->walls.ridges != 0 && (speed != 0 || s->walls.ridges < 0.1 * s->species[0].diameter))
    return gg_base_fail(err, GG_BAD_INPUT,
                        "walls.ridges: %g; allowed: 0 (flat), or on walls at rest at least a tenth of the diameter",
                        s->walls.ridges);
  const double length = m->box[0] * s->species[0].diameter;
  if (s->walls.ridges > 2 * length)
    return gg_base_fail(
        err, GG_BAD_INPUT,
        "walls.ridges: %g in a box that is %.4g long along x; allowed: up to %.4g, of which one is made that "
        "is as wide as the box",
        s->walls.ridges, length, 2 * length);
  for (double side = -1; side <= (open ? -1 : 1); side += 2) {
    gg_surface wall = end_of_gap(m, side, speed);
    set_shape(&wall, s, m);
    set_temperature(&wall, s, m->unit);
    add(m, s, spins, wall);
  }
  return check_room(m, err);
}

const gg_surface *gg_surface_at(const gg_model *m, int axis, double side)
{
  for (int w = 0; w < m->n_surfaces; w++)
    if (m->surface[w].axis == axis && m->surface[w].side == side) return &m->surface[w];
  return NULL;
}

bool gg_common_surface_is_closed(const gg_model *m, int axis)
{
  return gg_surface_at(m, axis, 1) || gg_surface_at(m, axis, -1);
}

bool gg_common_surface_is_open_above(const gg_model *m)
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
