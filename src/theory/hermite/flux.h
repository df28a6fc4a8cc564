/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The integrals of one collision direction k. The pair's velocities along the normal, x1 and x2, are standard normal
 * under the weight, of widths s1 and s2; with S^2 = s1^2 + s2^2, so are u = (s1 x1 - s2 x2)/S and v = (s2 x1 + s1
 * x2)/S. g = S (u - u0) is the approach velocity. Grains that approach (u > u0) leave with x1' = x1 - eta g b0 along
 * the normal and y1' = y1 - eta g b1 along the tangent:
 *   W[(J,j),(P,p)] = frequency < g [psi_J(x1') psi_P(y1') - psi_J(x1) psi_P(y1)] Ho_j(x1) Ho_p(y1)
 *                                sum_l marginal_l Ho_2l(x2) >,
 * summed over the partner's species. The factor along the binormal z is separate: Z_Qq = < psi_Q(z) Ho_q(z) >. */
#ifndef GG_HERMITE_FLUX_H
#define GG_HERMITE_FLUX_H

#include <stdbool.h>

#include "theory/hermite/basis.h"
#include "theory/hermite/overlap.h"

typedef struct gg_hermite_contact {
  double frequency;
  double eta;        /* the fraction of g that the grain loses; (1+e)/2 among equals */
  double S;          /* width of g */
  double own, other; /* s1/S, s2/S */
  double b0, b1;     /* L^-1 k of the grain along normal and tangent */
  double u0;         /* flow between the centres, in units of S */
} gg_hermite_contact;

typedef struct gg_hermite_flux {
  int tests;  /* per axis: Ho_0 ... */
  int trials; /* N + 1 */
  int halves; /* for the partner: N/2 + 1 */
  gg_hermite_overlap tangential;
  int n_u, n_v;
  double *u, *wu, *v, *wv;           /* quadrature */
  double *Z;                         /* by Q, columns q */
  double *X, *loss;                  /* by (i,j) at u_i, columns (J,l), even J first; the loss by j, summed over u */
  double *along;                     /* X with the partner contracted, by i, columns (J,j) */
  double *Y;                         /* by i, columns (P,p) */
  double *W;                         /* by (J,j), columns (P,p) */
  double *columns, *points;          /* scratch for one u; on the heap, because threads with small stacks run this */
  int odd_X;                         /* where columns of odd J begin */
  int width_X, width_along, width_Y; /* lengths of rows, padded for products */
} gg_hermite_flux;

/* Trials up to degree N, tests up to `tests` - 1 an axis, with this decay. */
gg_status gg_hermite_flux_make(gg_hermite_flux *flux, int N, int tests, double decay, gg_error *err);
void gg_hermite_flux_clear(gg_hermite_flux *flux);

/* Add to W, and make Y; with `partner` also X and the loss of every l, from which derivatives follow. */
void gg_hermite_flux_begin(gg_hermite_flux *flux); /* W = 0 */
void gg_hermite_flux_add(gg_hermite_flux *flux, const gg_hermite_contact *contact, const double *marginal,
                         bool partner);

/* First column of X of a test J. */
static inline int gg_hermite_X_column(const gg_hermite_flux *f, int J)
{
  return (J % 2 ? f->odd_X : 0) + J / 2 * f->halves;
}

static inline double gg_hermite_W(const gg_hermite_flux *f, int J, int P, int j, int p)
{
  return f->W[(J * f->trials + j) * f->width_Y + P * f->trials + p];
}

/* frequency <g^power> of both partners by their marginals, power 0 .. 3. */
void gg_hermite_flux_powers(const gg_hermite_flux *flux, const gg_hermite_contact *contact, const double *own,
                            const double *other, double power[4]);

#endif
