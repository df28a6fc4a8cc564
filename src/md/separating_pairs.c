/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Separation of pairs after a collision without restitution. At e = 0, or nearly 0, grains have a normal speed of 0
 * after the collision, but for rounding. If by rounding they still approach, they collide again at once, with an
 * impulse too small to change their velocities, without end. So such pairs separate at a speed just above rounding,
 * which adds 10^-20 of the energy or less. The same happens at any restitution to grains that touch and move alike, as
 * in a lattice that falls on a floor: so a pair that collides at the very time at which both were predicted separates,
 * too. */
#include <math.h>

#include "md/resolution.h"

/* Least e at which a pair separates by itself: no normal speed is so small that e reduces it to rounding. */
#define PARTS_FROM 1e-3
/* Some units of the last digit. */
#define ROUNDING 0x1p-50

bool gg_md_needs_parting(const gg_model *m)
{
  if (m->law.name) return true; /* e may be 0 at some speed */
  for (int i = 0; i < m->n_species; i++)
    for (int j = 0; j < m->n_species; j++)
      if (m->e[gg_pair(i, j)] < PARTS_FROM) return true;
  return false;
}

static double largest_component(gg_vec a, gg_vec b)
{
  double one = fmax(fabs(a.x), fmax(fabs(a.y), fabs(a.z))), two = fmax(fabs(b.x), fmax(fabs(b.y), fabs(b.z)));
  return fmax(one, two);
}

/* Normal speed below which rounding decides: of velocities, and of the positions that define the normal. */
static double least_speed(const gg_md *e, const gg_md_grain *one, const gg_md_grain *two, gg_vec dr)
{
  const double *edge = e->box.edge, longest = fmax(edge[0], fmax(edge[1], edge[2]));
  double velocity = largest_component(one->v, two->v) + fabs(e->box.image_velocity);
  return ROUNDING * (1 + longest / sqrt(gg_dot(dr, dr))) * velocity;
}

/* Resolve the contact, then correct the normal speed. `image`: velocity of the image, part of the relative velocity. */
void gg_md_resolve_parting(gg_md *e, uint32_t i, uint32_t j, gg_vec dr, gg_vec c12)
{
  gg_md_grain *one = &e->grain[i], *two = &e->grain[j];
  gg_vec image = gg_sub(c12, gg_sub(one->v, two->v)), k = gg_scale(1 / sqrt(gg_dot(dr, dr)), dr);
  double im1 = 1 / e->model.mass[gg_md_species_of(one)], im2 = 1 / e->model.mass[gg_md_species_of(two)];
  e->resolve_parted(e, i, j, dr, c12);
  double least = least_speed(e, one, two, dr), approach = gg_dot(k, gg_add(image, gg_sub(one->v, two->v)));
  if (approach <= -least) return;
  double J = (approach + 2 * least) / (im1 + im2);
  one->v = gg_axpy(-im1 * J, k, one->v);
  two->v = gg_axpy(im2 * J, k, two->v);
}

void gg_md_resolve_again(gg_md *e, uint32_t i, uint32_t j, gg_vec dr, gg_vec c12)
{
  gg_md_resolution *const usual = e->resolve_shown;
  e->resolve_shown = gg_md_resolve_parting;
  (e->callback ? gg_md_show_collision : gg_md_resolve_parting)(e, i, j, dr, c12);
  e->resolve_shown = usual;
}
