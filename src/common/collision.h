/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The one collision rule: grain-grain and grain-wall; smooth, rough and frictional; equal and unequal partners.
 *
 * Spins are carried as the surface velocity s = a omega (a = d/2), which drops the diameter from the rule, so that
 * the same lines hold in the Boltzmann limit. With k the unit vector from grain 1 to grain 2 and K = 4I/(m d^2):
 *
 *   g    = c1 - c2 - k x (s1 + s2),   g_n = k.g > 0 (approaching),   g_t = g - g_n k
 *   J    = m_r (1+e) g_n k + m_t (1+beta) g_t,    |J_t| <= mu |J_n|   (Coulomb)
 *   c1'  = c1 - J/m1,   c2' = c2 + J/m2,   s_i' = s_i - k x J / (K_i m_i)
 *   1/m_r = 1/m1 + 1/m2,   1/m_t = (1 + 1/K1)/m1 + (1 + 1/K2)/m2
 *
 * Lun & Savage, J. Appl. Mech. 54 (1987) 47; Walton & Braun, Acta Mech. 63 (1986) 73 (Coulomb cut-off); Gayen's
 * thesis, eqs 2.3-2.17, where the printed eta_2 = (1+beta)/K(1+K) must read (1+beta)K/(2(1+K)).
 * A wall is a partner of infinite mass without spin: 1/m2 = 1/(K2 m2) = 0.
 *
 * Kicks inject energy at contact: J gets the normal part 2 m_r D k more, so that the relative normal velocity after
 * contact is -(e g_n + 2 D) (R. Brito, D. Risso & R. Soto, Phys. Rev. E 87 (2013) 022209), and the tangential part
 * -2 m_t D_t k x z. Above 0, D_t turns the pair about z by the right hand. J_n of the Coulomb limit has its kick. Walls
 * give none.
 *
 * The rule itself is in common/collision_of.h, stated once for doubles (here) and for lanes (src/dsmc/kernel). Every
 * function inlines and takes `rule` as a constant, so that a smooth kernel holds no line of the others. */
#ifndef GG_COLLISION_H
#define GG_COLLISION_H

#include <math.h>
#include <stdbool.h>

#include "common/vec.h"

typedef enum gg_rule {
  GG_SMOOTH,    /* beta = -1, or mu = 0: no tangential impulse, no spins */
  GG_ROUGH,     /* constant beta */
  GG_FRICTIONAL /* Coulomb: beta_0 while sticking, mu while sliding */
} gg_rule;

/* Kicks at contact: a kind is its value here, its row in collision.c, and its part of kicked_impulse_of and kick_energy
 * in collision_of.h. */
typedef enum gg_kick_kind { GG_NORMAL_KICK, GG_TANGENTIAL_KICK, GG_N_KICKS } gg_kick_kind;

/* Coefficients of the collision rule for two partners of given kinds, made once by gg_common_contact_make. Units:
 * mass. */
typedef struct gg_contact {
  double jn;               /* m_r (1+e) */
  double jt;               /* m_t (1+beta); 0 if smooth */
  double mu;               /* friction coefficient; INFINITY: constant beta */
  double im1, im2;         /* 1/m_i */
  double ik1, ik2;         /* 1/(K_i m_i) */
  double kick[GG_N_KICKS]; /* 2 m D, with m_r or m_t by the kind; 0: none */
} gg_contact;

/* One partner; a wall is {INFINITY, any}. */
typedef struct gg_partner {
  double mass, inertia; /* m; K = 4I/(m d^2) */
} gg_partner;

gg_contact gg_common_contact_make(gg_partner one, gg_partner two, double e, double beta, double mu);

/* Set the kicks of a contact, velocities such as D and D_t above, by kind. Grains without spins have no inertia of
 * rotation: m_t is m_r. */
void gg_common_contact_set_kicks(gg_contact *contact, bool spins, const double D[GG_N_KICKS]);
/* True if kicks of this kind single out the z axis, which then is the mean direction of spins. */
bool gg_common_kick_turns(gg_kick_kind kind);

/* The simplest rule that does for these coefficients. */
gg_rule gg_common_rule_select(double beta, double mu);

GG_INLINE double gg_inverse_mr(const gg_contact *c)
{
  return c->im1 + c->im2;
}
GG_INLINE double gg_inverse_mt(const gg_contact *c)
{
  return (c->im1 + c->im2) + (c->ik1 + c->ik2);
}

#define GG_NUMBER double
#define GG_VECTOR gg_vec
#define GG_OF(name) gg_##name
#define GG_CONTACT gg_contact
#define GG_ALL(x) (x)
#define GG_ABS(x) fabs(x)
#define GG_SQRT(x) sqrt(x)
#define GG_IF_LESS(a, b, yes, no) ((a) < (b) ? (yes) : (no))
#include "common/collision_of.h"

GG_INLINE void gg_kick(gg_rule rule, const gg_contact *c, gg_vec k, gg_vec J, gg_vec *c1, gg_vec *s1, gg_vec *c2,
                       gg_vec *s2)
{
  gg_kick_centres(c->im1, c->im2, J, c1, c2);
  if (rule != GG_SMOOTH) gg_kick_spins(c->ik1, c->ik2, k, J, s1, s2);
}

/* Sums from which the energy that collisions destroy follows, for one collision or many of a kind. */
typedef struct gg_loss_terms {
  double Jg, Jn2, J2; /* J.g, J_n^2, J.J */
} gg_loss_terms;

/* Energy (translation and rotation) that collisions destroy, >= 0 for |e|, |beta| <= 1: from the impulse, so that it
 * holds for sticking and sliding and for any e alike. Equals (1/2) m_r (1-e^2) g_n^2 + (1/2) m_t (1-beta^2) g_t^2. */
GG_INLINE double gg_loss_of_terms(const gg_contact *c, gg_loss_terms t)
{
  return t.Jg - 0.5 * (gg_inverse_mr(c) * t.Jn2 + gg_inverse_mt(c) * (t.J2 - t.Jn2));
}

GG_INLINE double gg_energy_loss(const gg_contact *c, gg_vec k, gg_vec g, gg_vec J)
{
  double Jn = gg_dot(k, J);
  return gg_loss_of_terms(c, (gg_loss_terms){.Jg = gg_dot(J, g), .Jn2 = Jn * Jn, .J2 = gg_dot(J, J)});
}

/* A collision with kicks: the energy that its coefficients destroy, and the energy that its kicks give. */
typedef struct gg_kicked_loss {
  double loss, given;
} gg_kicked_loss;
GG_INLINE gg_kicked_loss gg_kicked_energy_loss(const gg_contact *c, gg_vec k, gg_vec g, gg_vec J)
{
  const double given = gg_kick_energy(c, k, g, gg_dot(k, g), J, gg_dot(k, J));
  return (gg_kicked_loss){gg_energy_loss(c, k, g, J) + given, given};
}

/* Collisional stress: sigma k J. */
GG_INLINE void gg_add_stress(double stress[3][3], double sigma, gg_vec k, gg_vec J)
{
  stress[0][0] += sigma * k.x * J.x;
  stress[1][1] += sigma * k.y * J.y;
  stress[2][2] += sigma * k.z * J.z;
  stress[0][1] += sigma * k.x * J.y;
  stress[1][0] += sigma * k.y * J.x;
}

#endif
