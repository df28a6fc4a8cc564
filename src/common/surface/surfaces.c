/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "common/model.h"
#include "common/surface/shapes.h"

static void add(gg_model *m, const gg_walls *walls, bool spins, gg_surface surface)
{
  const gg_partner wall = {INFINITY, 1};
  for (int i = 0; i < GG_MAX_SPECIES; i++) {
    gg_partner grain = {m->mass[i], spins ? m->inertia[i] : INFINITY};
    surface.contact[i] = gg_common_contact_make(grain, wall, walls->e, walls->beta, walls->mu);
    surface.treated[i] = gg_common_contact_make(grain, wall, 1, walls->beta, walls->mu);
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

/* Flat, or with half cylinders side by side along x. */
static void set_shape(gg_surface *wall, double ridges, const gg_model *m)
{
  if (ridges == 0) return;
  wall->shape = GG_SHAPE_ridges;
  wall->radius = 0.5 * m->box[0] / ridges;
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

gg_status gg_common_surfaces_make(gg_model *m, const gg_walls *walls, bool spins, gg_error *err)
{
  m->n_surfaces = 0;
  if (!gg_flow_is_walled(m->flow)) return GG_OK;
  for (double side = -1; side <= (walls->open_top ? -1 : 1); side += 2) {
    gg_surface wall = end_of_gap(m, side, walls->speed);
    const double T = walls->temperature[side > 0];
    set_shape(&wall, walls->ridges, m);
    if (T != GG_AUTO && walls->accommodation > 0) wall.temperature = T, wall.accommodation = walls->accommodation;
    add(m, walls, spins, wall);
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
