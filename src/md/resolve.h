/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Resolution of a contact: the collision rule, the contact-time rule and the collision sums. One always-inline body
 * with constant features; resolve.c makes the instances. */
#ifndef GG_MD_RESOLVE_H
#define GG_MD_RESOLVE_H

#include <math.h>

#include "common/surface/collide.h"
#include "common/surface/shapes.h"
#include "md/epoch.h"

typedef struct gg_md_resolve_features {
  gg_rule rule;
  bool mixture, contact_time;
  bool gaussian; /* thermostat: lost energy is returned by a slower clock */
  bool spins;    /* at walls; without spins a wall acts on the centre */
  bool own; /* the contact is made at the collision: e depends on the relative normal speed, or kicks; or torques */
} gg_md_resolve_features;

/* True if this collision is treated by the contact-time rule. A grain that collided less than t_c ago is still in
 * contact and collides with e = 1, so that an inelastic collapse ends in finite time (Luding & McNamara, Granular
 * Matter 1 (1998) 113). */
GG_INLINE bool gg_md_is_treated(gg_md *e, uint32_t i, uint32_t j)
{
  double now = e->k.now, limit = e->k.contact_time;
  bool treated = now - e->last[i] < limit || now - e->last[j] < limit;
  e->last[i] = e->last[j] = now;
  return treated;
}

GG_INLINE void gg_md_sum_pair(gg_collision_sums *t, int pair, double sigma, gg_vec k, gg_vec J, gg_kicked_loss energy)
{
  gg_add_stress(t->stress[pair], sigma, k, J);
  t->loss[pair] += energy.loss;
  t->given[pair] += energy.given;
}

/* Energy of a collision outside of the Gaussian thermostat. */
GG_INLINE gg_kicked_loss gg_md_energy_loss(gg_md_resolve_features f, const gg_contact *c, gg_vec k, gg_vec g, gg_vec J,
                                           double scale)
{
  if (!f.own) return (gg_kicked_loss){.loss = gg_energy_loss(c, k, g, J) * scale * scale};
  const gg_kicked_loss inside = gg_kicked_energy_loss(c, k, g, J);
  return (gg_kicked_loss){inside.loss * scale * scale, inside.given * scale * scale};
}

/* Return lost energy by the Gaussian thermostat: outside the kinetic energy is constant, velocities are larger by a
 * factor that grows with every loss, and the clock is slower by it. */
GG_INLINE void gg_md_return_energy(gg_md *e, double lost)
{
  gg_md_counts *k = &e->k;
  k->kinetic -= lost;
  if (e->model.linear_response) return; /* it is returned at the times of kicks.h */
  k->outer += (k->now - k->mark) / k->scale;
  k->mark = k->now;
  k->scale = sqrt(k->kinetic0 / k->kinetic);
  k->stop = k->now + (k->asked - k->outer) * k->scale;
}

/* Spin inside of the Gaussian thermostat, which acts on centres alone: spins are stored as they are outside. */
GG_INLINE gg_vec gg_md_spin_inside(gg_md_resolve_features f, double scale, gg_vec spin)
{
  return f.gaussian ? gg_scale(1 / scale, spin) : spin;
}

/* Spins at contact, the effect of torques included. */
GG_INLINE void gg_md_load_spins(const gg_md *e, gg_md_resolve_features f, double scale, const uint32_t at[2],
                                const int species[2], gg_vec *s1, gg_vec *s2)
{
  *s1 = gg_md_spin_inside(f, scale, e->spin[at[0]]), *s2 = gg_md_spin_inside(f, scale, e->spin[at[1]]);
  if (!f.own) return;
  s1->z += gg_md_turned(e, species[0]), s2->z += gg_md_turned(e, species[1]);
}

/* Kinetic energy lost, from the velocities before and after. */
GG_INLINE double gg_md_kinetic_loss(const gg_contact *c, gg_vec was1, gg_vec was2, gg_vec is1, gg_vec is2)
{
  double one = gg_dot(gg_sub(was1, is1), gg_add(was1, is1)), two = gg_dot(gg_sub(was2, is2), gg_add(was2, is2));
  return 0.5 * (one / c->im1 + two / c->im2);
}

/* Contact of a pair by the law of restitution, unless it is treated, and with kicks. Speeds of both are outside, in
 * units of the start. */
GG_INLINE gg_contact gg_md_own_contact(gg_md *e, const gg_contact *contact, bool treated, double gn, int a, int b,
                                       uint32_t number)
{
  gg_contact at = *contact;
  const gg_restitution_law *law = &e->model.law;
  const double inside = ldexp(1 / e->k.scale, e->k.power);
  for (int k = 0; k < GG_N_KICKS; k++) at.kick[k] *= inside;
  if (!law->name || treated) return at;
  const int pair = gg_pair(a, b);
  const double speed = ldexp(gn * e->k.scale, -e->k.power), u = law->e ? 0 : e->tables->scale[pair] * speed;
  const gg_loss_table *table = law->e ? NULL : e->tables->of[GG_OF_E][pair];
  if (law->e || table) {
    const double restitution =
        law->e ? gg_common_law_at(law, speed, a, b, &e->k.clamped) : 1 - gg_law_table_at(table, u);
    at.jn = gg_md_contact_normal_coefficient(contact, restitution, number);
  }
  if (law->e) return at;
  gg_coefficients_set_friction(e->tables, pair, u, &at);
  e->k.clamped += gg_coefficients_clamp(e->tables, pair, u);
  return at;
}

GG_INLINE void gg_md_resolve_pair(gg_md *e, gg_md_resolve_features f, uint32_t i, uint32_t j, gg_vec dr, gg_vec c12)
{
  gg_md_grain *one = &e->grain[i], *two = &e->grain[j];
  int a = f.mixture ? gg_md_species_of(one) : 0, b = f.mixture ? gg_md_species_of(two) : 0,
      pair = f.mixture ? gg_md_pair(&e->contacts, a, b) : 0, q = f.mixture ? gg_pair(a, b) : 0;
  const gg_md_contacts *contacts = &e->contacts;
  const uint32_t number = one->counter + two->counter; /* a local number: independent of events elsewhere */
  uint64_t dither = number & contacts->dither_mask;
  const uint64_t row = f.mixture ? dither * (uint64_t)contacts->n_pairs : dither;
  const gg_contact *contact = &contacts->contact[row + (uint64_t)pair];
  bool treated = f.contact_time && gg_md_is_treated(e, i, j);
  e->k.treated += treated;
  if (treated) contact = &contacts->treated[row + (uint64_t)pair];
  double r2 = gg_dot(dr, dr), overlap = 0.5 * (contacts->sigma2[pair] - r2) * contacts->inverse[pair];
  if (overlap > e->k.worst_overlap) e->k.worst_overlap = overlap;
  gg_vec k = gg_md_contact_normal(contacts, pair, dr, r2, number);
  const double scale = f.gaussian ? e->k.scale : 1;
  gg_vec s1 = {0, 0, 0}, s2 = s1;
  if (f.rule != GG_SMOOTH) gg_md_load_spins(e, f, scale, (const uint32_t[]){i, j}, (const int[]){a, b}, &s1, &s2);
  gg_vec g = gg_contact_velocity(f.rule, k, c12, s1, s2);
  const double gn = gg_dot(k, g);
  gg_contact own;
  if (f.own) own = gg_md_own_contact(e, contact, treated, gn, a, b, number), contact = &own;
  gg_vec J = f.own ? gg_kicked_impulse(f.rule, contact, k, g, gn) : gg_impulse(f.rule, contact, k, g, gn);
  gg_vec v1 = one->v, v2 = two->v;
  gg_kick_centres(contact->im1, contact->im2, J, &one->v, &two->v);
  if (f.rule != GG_SMOOTH) gg_kick_spins(contact->ik1 * scale, contact->ik2 * scale, k, J, &e->spin[i], &e->spin[j]);
  e->k.transfer.collisions[q]++;
  gg_md_sum_pair(&e->k.transfer, q, e->model.sigma[q] * scale, k, J, gg_md_energy_loss(f, contact, k, g, J, scale));
  if (f.gaussian) gg_md_return_energy(e, gg_md_kinetic_loss(contact, v1, v2, one->v, two->v));
}

/* Least speed after a contact with a wall. A grain at rest on a wall by gravity would collide infinitely often in
 * finite time; with the contact-time rule it leaves so fast that gravity brings it back after t_c at the earliest. */
GG_INLINE double gg_md_least_speed(const gg_md *e, bool contact_time, double towards)
{
  return contact_time && towards > 0 ? 0.5 * towards * e->k.contact_time : 0;
}

/* Resolve a contact with surface w of the model. */
GG_INLINE void gg_md_resolve_surface(gg_md *e, gg_md_resolve_features f, uint32_t i, int w)
{
  gg_md_grain *one = &e->grain[i];
  int a = gg_md_species_of(one);
  const gg_surface *surface = &e->model.surface[w];
  const gg_contact *contact = &surface->contact[a];
  const bool treated = f.contact_time && gg_md_is_treated(e, i, i);
  if (treated) contact = &surface->treated[a];
  double overlap = -gg_surface_clearance(surface, &one->r, 0.5 * e->model.diameter[a]);
  if (overlap > e->k.worst_overlap) e->k.worst_overlap = overlap;
  gg_vec k = gg_surface_normal(surface, &one->r), spin = {0, 0, 0};
  if (f.spins) spin = gg_md_spin(e, i);
  gg_surface_hit hit = gg_surface_collide(f.rule, surface, contact, &e->k.rng, k, &one->v, &spin);
  if (f.spins) e->spin[i] = spin, e->spin[i].z -= e->model.turns ? gg_md_turned(e, a) : 0;
  e->k.wall_treated += treated && !hit.thermal;
  double least = gg_md_least_speed(e, f.contact_time, gg_dot(k, e->gravity)), towards = gg_dot(k, one->v);
  if (!hit.thermal && -towards < least) {
    hit.J = gg_axpy((least + towards) / contact->im1, k, hit.J);
    one->v = gg_axpy(-least, k, gg_axpy(-towards, k, one->v));
  }
  gg_surface_sums *t = &e->k.transfer.surface[w];
  t->collisions++;
  for (int c = 0; c < 3; c++) t->impulse[c] += gg_along(&hit.J, c);
  t->loss += gg_surface_heat(contact, k, &hit);
}

#endif
