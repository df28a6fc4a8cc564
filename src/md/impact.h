/* What a contact does to its grains: the collision rule, the contact-time rule and the tap. One always-inlined body
 * with constant features; kernels.c makes the instances. */
#ifndef GG_MD_IMPACT_H
#define GG_MD_IMPACT_H

#include <math.h>

#include "md/state.h"

typedef struct gg_impact_features {
  gg_rule rule;
  bool mixture, contact_time, tap;
} gg_impact_features;

/* Contact-time rule: a grain that collided less than t_c ago is still "in contact", and collides with e = 1, so that an
 * inelastic collapse ends in finite time (Luding & McNamara, Granular Matter 1 (1998) 113). */
GG_INLINE bool gg_is_treated(gg_md *e, uint32_t i, uint32_t j)
{
  double now = e->k.now, limit = e->k.contact_time;
  bool treated = now - e->last[i] < limit || now - e->last[j] < limit;
  e->last[i] = e->last[j] = now;
  e->k.treated += treated;
  return treated;
}

GG_INLINE void gg_tap_pair(gg_transfer *t, int pair, double sigma, gg_vec k, gg_vec J, double loss)
{
  for (int a = 0; a < 3; a++)
    for (int b = 0; b < 3; b++) t->stress[pair][a][b] += sigma * gg_along(&k, a) * gg_along(&J, b);
  t->loss[pair] += loss;
}

GG_INLINE void gg_impact_pair(gg_md *e, gg_impact_features f, uint32_t i, uint32_t j, gg_vec dr, gg_vec c12)
{
  gg_grain *one = &e->grain[i], *two = &e->grain[j];
  int a = f.mixture ? gg_species_of(one) : 0, b = f.mixture ? gg_species_of(two) : 0, pair = f.mixture ? 2 * a + b : 0;
  const gg_contact *contact = &e->model.contact[pair];
  if (f.contact_time && gg_is_treated(e, i, j)) contact = &e->model.treated[pair];
  double distance = sqrt(gg_dot(dr, dr)), sigma = e->model.sigma[pair];
  if (sigma - distance > e->k.worst_overlap) e->k.worst_overlap = sigma - distance;
  gg_vec k = gg_scale(1 / distance, dr);
  gg_vec none = {0, 0, 0}, *s1 = f.rule == GG_SMOOTH ? &none : &e->spin[i],
         *s2 = f.rule == GG_SMOOTH ? &none : &e->spin[j];
  gg_vec g = gg_contact_velocity(f.rule, k, c12, *s1, *s2);
  gg_vec J = gg_impulse(f.rule, contact, k, g, gg_dot(k, g));
  gg_kick(f.rule, contact, k, J, &one->v, s1, &two->v, s2);
  e->k.transfer.collisions[a + b]++;
  if (f.tap) gg_tap_pair(&e->k.transfer, a + b, sigma, k, J, gg_energy_loss(contact, k, g, J));
}

#endif
