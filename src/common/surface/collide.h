/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Collision of a grain with a surface, for all engines: by the collision rule, with a partner of infinite mass without
 * spin. A thermal wall re-emits the given fraction of contacts diffusely (Maxwell, Phil. Trans. 170 (1879) 231,
 * appendix): velocities are drawn from the flux of a gas at rest relative to the wall, of the wall's temperature T. The
 * normal speed v_n has the distribution v_n exp(-m v_n^2/2T); each tangential component of the velocity, relative to
 * the wall, and each of the spin is Maxwellian. So a gas in equilibrium at T remains so. Spins have the same T, as the
 * rotation of diffusely reflected molecules in SPARTA (Plimpton et al., Phys. Fluids 31 (2019) 086101). */
#ifndef GG_SURFACE_COLLIDE_H
#define GG_SURFACE_COLLIDE_H

#include "common/rng.h"
#include "common/surface/surface.h"

typedef struct gg_surface_hit {
  gg_vec J;    /* impulse on the surface */
  gg_vec g;    /* by the rule: velocity of the surfaces at contact */
  double heat; /* thermal: energy that the wall takes, as it moves with it */
  bool thermal;
} gg_surface_hit;

/* Three numbers for the velocity, one more for its normal part, three for a spin: sqrt(a^2 + b^2) of two normal ones
 * has the distribution of v_n. */
GG_INLINE gg_surface_hit gg_surface_take_up(const gg_surface *s, const gg_contact *contact, gg_rng *rng, gg_vec k,
                                            gg_vec *v, gg_vec *spin)
{
  const double m = 1 / contact->im1, speed = sqrt(s->temperature / m);
  gg_vec came = gg_sub(*v, s->velocity), random = gg_common_rng_normal_vec(rng);
  const double other = gg_common_rng_normal(rng), normal = gg_dot(k, random);
  gg_vec leaves = gg_scale(speed, gg_axpy(-normal - sqrt(normal * normal + other * other), k, random));
  double energy = gg_dot(came, came) - gg_dot(leaves, leaves);
  *v = gg_add(leaves, s->velocity);
  if (contact->ik1 > 0) {
    const gg_vec turned = gg_scale(sqrt(s->temperature * contact->ik1), gg_common_rng_normal_vec(rng));
    energy += (gg_dot(*spin, *spin) - gg_dot(turned, turned)) / (m * contact->ik1);
    *spin = turned;
  }
  return (gg_surface_hit){.J = gg_scale(m, gg_sub(came, leaves)), .heat = 0.5 * m * energy, .thermal = true};
}

/* The grain's velocity and spin become those after the contact; `contact` is that of its species, k the unit vector
 * from its centre into the surface. Random numbers are drawn at thermal walls alone. Without spins ik1 = 0, and *spin
 * is 0. */
GG_INLINE gg_surface_hit gg_surface_collide(gg_rule rule, const gg_surface *s, const gg_contact *contact, gg_rng *rng,
                                            gg_vec k, gg_vec *v, gg_vec *spin)
{
  if (s->accommodation == 1 || (s->accommodation > 0 && gg_rng_uniform(rng) < s->accommodation))
    return gg_surface_take_up(s, contact, rng, k, v, spin);
  gg_surface_hit hit = {.thermal = false};
  gg_vec wall_v = s->velocity, still = {0, 0, 0};
  hit.g = gg_contact_velocity(rule, k, gg_sub(*v, wall_v), *spin, still);
  hit.J = gg_impulse(rule, contact, k, hit.g, gg_dot(k, hit.g));
  gg_kick(rule, contact, k, hit.J, v, spin, &wall_v, &still);
  return hit;
}

/* Energy that the grain loses, relative to the surface. */
GG_INLINE double gg_surface_heat(const gg_contact *contact, gg_vec k, const gg_surface_hit *hit)
{
  return hit->thermal ? hit->heat : gg_energy_loss(contact, k, hit->g, hit->J);
}

#endif
