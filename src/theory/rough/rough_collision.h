/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One direction k of collision, for the pair's relative motion. With d = (c1 - c2)/sqrt 2 and p = (o1 + o2)/sqrt 2,
 * standard normal under the weight, a collision is a linear map z -> M z + b of z = (d, p), and does not change v =
 * (c1 + c2)/sqrt 2 and m = (o1 - o2)/sqrt 2. */
#ifndef GG_ROUGH_COLLISION_H
#define GG_ROUGH_COLLISION_H

#include "base/cancellation.h"
#include "theory/rough/functions.h"

/* The Gaussian of the expansion: C = L c, s = spin z + S o, lower triangular. */
typedef struct gg_rough_weight {
  double L[3][3], S[3][3], spin;
} gg_rough_weight;

/* The gas: collision rule, frequency, shear. */
typedef struct gg_rough_gas {
  double frequency;    /* n chi sigma^2 */
  double eta1, eta2;   /* J = eta2 g + (eta1 - eta2) k g_n */
  double mu;           /* friction, |J_t| <= mu |J_n|; INFINITY: constant beta */
  double K;            /* 4I/(m d^2) */
  double shear;        /* sigma times shear rate: the flow between two centres; 0 in the Boltzmann limit */
  const gg_stop *stop; /* borrowed from the model: no physics */
} gg_rough_gas;

typedef struct gg_rough_collision {
  double M[GG_ROUGH_AXES][GG_ROUGH_AXES], b[GG_ROUGH_AXES];
  double J[3][GG_ROUGH_AXES], J0[3]; /* impulse: J z + J0 */
  double normal[3];                  /* u = normal . d, standard normal */
  double s, u0;                      /* g_n = s (u - u0) */
} gg_rough_collision;

gg_rough_collision gg_rough_collision_at(const gg_rough_gas *gas, const gg_rough_weight *weight, const double k[3]);

/* Contact velocity g = G z + m along three axes, and what a unit impulse along each of them does: z' = z + B J. */
typedef struct gg_rough_contact {
  double G[3][GG_ROUGH_AXES], m[3], B[3][GG_ROUGH_AXES];
} gg_rough_contact;

gg_rough_contact gg_rough_contact_at(const gg_rough_gas *gas, const gg_rough_weight *weight, const double k[3],
                                     const double axis[3][3]);

/* x = A^-1 x, A lower triangular. */
void gg_rough_divide(const double A[3][3], double x[3]);

/* moment[m] = < g_n He_m(u)/sqrt(m!) > over u > u0, m up to `most`. */
void gg_rough_flux(const gg_rough_collision *c, int most, double *moment);

#endif
