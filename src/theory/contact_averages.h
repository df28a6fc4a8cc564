/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Averages over the contacts of two species whose velocities and spins are Gaussian,
 *   f_i = n_i N(C; 0, M_i) N(s; s_i z, Theta_i),
 * for one direction k from grain 1 to grain 2, weighted with the rate of collisions u+ = max(k.g, 0), g the contact
 * velocity: how often grains collide, and what momentum, energy and spin a collision carries over. Constant beta
 * (contact_averages.c) is exact, with an e that depends on the normal speed a quadrature over that speed; Coulomb
 * friction (contact_friction.c) is a quadrature to about 1e-6, with coefficients that depend on the normal speed
 * another one (contact_speed.c). Spins are surface velocities s = (d/2) omega. */
#ifndef GG_CONTACT_AVERAGES_H
#define GG_CONTACT_AVERAGES_H

#include "common/collision.h"
#include "common/laws/speed_laws.h"
#include "theory/tensor.h"

typedef struct gg_gaussian {
  gg_tensor M;     /* <C C> */
  gg_tensor Theta; /* covariance of s */
  double spin;     /* mean of s_z */
} gg_gaussian;

/* A pair of species: grain 1 of one, grain 2 of the other. */
typedef struct gg_contact_pair {
  const gg_gaussian *one, *two;
  const gg_contact *contact;
  double shear;          /* sigma * shear rate; 0 in the Boltzmann limit */
  double loss_n, loss_t; /* energy lost over g_n^2, and over g_t^2 where the contact does not slide */
  const gg_speed_law *law[GG_N_COEFFICIENTS]; /* of the normal speed, in place of `contact`; NULL: constant */
  double speed_unit;                          /* a speed in their units over that of the velocities */
} gg_contact_pair;

/* <u+ ...> of the impulse J and of its torque k x J. The torque is kept separately: the normal impulse, much the
 * larger one for weakly rough grains, does not contribute to it. */
typedef struct gg_contact_average {
  double rate;         /* <u+> */
  double loss;         /* <u+ energy lost>, a sum of positive terms */
  gg_vec J, kJ;        /* <u+ J>, <u+ k x J> */
  gg_tensor JC, JJ;    /* <u+ J C_1^T>, <u+ J J^T> */
  gg_tensor kJs, kJkJ; /* <u+ (k x J) s_1^T>, <u+ (k x J)(k x J)^T> */
} gg_contact_average;

gg_contact_average gg_theory_contact_average(const gg_contact_pair *pair, gg_vec k);

/* Sums over contacts of one direction, <u+ ...>, in axes k, t1, t2 with two tangents: g is Gaussian with mean m and
 * covariance S. */
typedef struct gg_local_sums {
  double rate, loss, J[3];
  gg_tensor Jg, JJ;
} gg_local_sums;

/* contact_speed.c: with coefficients that depend on the normal speed, by quadratures over it and over the direction of
 * g_t. */
void gg_theory_contact_sums_by_speed(const gg_contact_pair *pair, const double m[3], const gg_tensor *S,
                                     gg_local_sums *sums);
/* The speeds from `from` to `to` in panels without a step of a law within: their ends from the first on, at most
 * GG_SPEED_PANELS; returns how many panels. */
enum { GG_SPEED_PANELS = 16 * (1 + 3 * GG_LAW_STEPS) };
int gg_theory_speed_panels(const gg_contact_pair *pair, double to, int panels, double end[GG_SPEED_PANELS + 1]);
/* Gauss's rule of six points on a panel. */
void gg_theory_panel_point(double from, double to, int a, double *u, double *weight);
/* A coefficient at the normal speed u, `constant` if it has no law. */
static inline double gg_theory_coefficient_at(const gg_contact_pair *p, gg_contact_coefficient of, double constant,
                                              double u)
{
  return p->law[of] ? gg_common_speed_law_value(p->law[of], p->speed_unit * u, NULL) : constant;
}

/* contact_friction.c: the same for a finite friction coefficient. */
gg_contact_average gg_theory_contact_average_frictional(const gg_contact_pair *pair, gg_vec k);

/* Mean of g: -sigma rate k_y x - k x (s_1 + s_2). */
static inline gg_vec gg_theory_contact_velocity(const gg_contact_pair *p, gg_vec k)
{
  gg_vec mean = {-p->shear * k.y, 0, 0}, spin = {0, 0, p->one->spin + p->two->spin};
  return p->contact->jt > 0 ? gg_sub(mean, gg_cross(k, spin)) : mean;
}

/* M_1 + M_2 + X (Theta_1 + Theta_2) X^T with X v = k x v. */
static inline gg_tensor gg_theory_contact_covariance(const gg_contact_pair *p, gg_vec k)
{
  gg_tensor X = gg_tensor_cross(k), S = gg_tensor_plus(p->one->M, 1, p->two->M);
  if (p->contact->jt == 0) return S;
  gg_tensor spins = gg_tensor_plus(p->one->Theta, 1, p->two->Theta);
  return gg_tensor_plus(S, -1, gg_tensor_product(gg_tensor_product(X, spins), X)); /* X^T = -X */
}

#endif
