/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Grains whose restitution is 0, or nearly so, leave each other at a normal speed of 0, but for rounding. Where that
 * rounding says that they still approach they would collide again at once, with an impulse that is too small to change
 * their velocities: for ever. So such pairs part at a speed that is just above rounding; what it adds to the energy is
 * 10^-20 of it or less. The same is true, whatever their restitution, of grains that touch and move alike, as in a
 * lattice that falls on a floor: a pair that meets at the very time at which both have just been predicted parts so,
 * too. */
#include <math.h>

#include "md/resolution.h"

/* e from which on a pair parts by itself: a normal speed that e brings down to rounding is never seen. */
#define PARTS_FROM 1e-3
/* Some units of the last digit. */
#define ROUNDING 0x1p-50

bool gg_md_needs_parting(const gg_model *m)
{
  if (m->law.name) return true; /* who knows */
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

/* Normal speeds below are lost in rounding, of velocities and of the places that the normal follows from. */
static double least_speed(const gg_md *e, const gg_md_grain *one, const gg_md_grain *two, gg_vec dr)
{
  const double *edge = e->box.edge, longest = fmax(edge[0], fmax(edge[1], edge[2]));
  double velocity = largest_component(one->v, two->v) + e->box.image_velocity;
  return ROUNDING * (1 + longest / sqrt(gg_dot(dr, dr))) * velocity;
}

/* c12 and the impulse, then what comes of them: the relative velocity afterwards has the image in it. */
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
