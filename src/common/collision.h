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
 * Every function inlines and takes `rule` as a constant, so that a smooth kernel holds no line of the others. */
#ifndef GG_COLLISION_H
#define GG_COLLISION_H

#include <math.h>

#include "common/vec.h"

typedef enum gg_rule {
  GG_SMOOTH,    /* beta = -1, or mu = 0: no tangential impulse, no spins */
  GG_ROUGH,     /* constant beta */
  GG_FRICTIONAL /* Coulomb: beta_0 while sticking, mu while sliding */
} gg_rule;

/* What two partners of given kinds need at contact; made once by gg_contact_make. Units: mass. */
typedef struct gg_contact {
  double jn;       /* m_r (1+e) */
  double jt;       /* m_t (1+beta); 0 if smooth */
  double mu;       /* friction coefficient; INFINITY: constant beta */
  double im1, im2; /* 1/m_i */
  double ik1, ik2; /* 1/(K_i m_i) */
} gg_contact;

/* One partner; a wall is {INFINITY, any}. */
typedef struct gg_partner {
  double mass, inertia; /* m; K = 4I/(m d^2) */
} gg_partner;

gg_contact gg_contact_make(gg_partner one, gg_partner two, double e, double beta, double mu);

/* The simplest rule that does for these coefficients. */
gg_rule gg_rule_of(double beta, double mu);

GG_INLINE double gg_inverse_mr(const gg_contact *c)
{
  return c->im1 + c->im2;
}
GG_INLINE double gg_inverse_mt(const gg_contact *c)
{
  return (c->im1 + c->im2) + (c->ik1 + c->ik2);
}

/* Relative velocity of the surfaces at contact, g = c12 - k x (s1 + s2). */
GG_INLINE gg_vec gg_contact_velocity(gg_rule rule, gg_vec k, gg_vec c12, gg_vec s1, gg_vec s2)
{
  return rule == GG_SMOOTH ? c12 : gg_sub(c12, gg_cross(k, gg_add(s1, s2)));
}

/* Impulse J on grain 2 (-J on grain 1), from the contact velocity and its normal part gn = k.g. */
GG_INLINE gg_vec gg_impulse(gg_rule rule, const gg_contact *c, gg_vec k, gg_vec g, double gn)
{
  double jn = c->jn * gn;
  if (rule == GG_SMOOTH) return gg_scale(jn, k);
  gg_vec gt = gg_axpy(-gn, k, g);
  double jt = c->jt;
  if (rule == GG_FRICTIONAL) {
    double gt2 = gg_dot(gt, gt), limit = c->mu * fabs(jn);
    if (jt * jt * gt2 > limit * limit) jt = limit / sqrt(gt2); /* sliding; never with gt = 0 */
  }
  return gg_axpy(jt, gt, gg_scale(jn, k));
}

/* Give the impulse to both partners. */
GG_INLINE void gg_kick(gg_rule rule, const gg_contact *c, gg_vec k, gg_vec J, gg_vec *c1, gg_vec *s1, gg_vec *c2,
                       gg_vec *s2)
{
  *c1 = gg_axpy(-c->im1, J, *c1);
  *c2 = gg_axpy(c->im2, J, *c2);
  if (rule == GG_SMOOTH) return;
  gg_vec kJ = gg_cross(k, J);
  *s1 = gg_axpy(-c->ik1, kJ, *s1);
  *s2 = gg_axpy(-c->ik2, kJ, *s2);
}

/* Energy (translation and rotation) that the collision destroys, >= 0 for |e|, |beta| <= 1: from the impulse, so that
 * it holds for sticking and sliding alike. Equals (1/2) m_r (1-e^2) g_n^2 + (1/2) m_t (1-beta^2) g_t^2. */
GG_INLINE double gg_energy_loss(const gg_contact *c, gg_vec k, gg_vec g, gg_vec J)
{
  double Jn = gg_dot(k, J), J2 = gg_dot(J, J), Jt2 = J2 - Jn * Jn;
  return gg_dot(J, g) - 0.5 * (gg_inverse_mr(c) * Jn * Jn + gg_inverse_mt(c) * Jt2);
}

#endif
