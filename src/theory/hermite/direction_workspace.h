/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Workspace of the operator for one direction. Rotated functions are those of the frame of the collision, which
 * differs between species. */
#ifndef GG_DIRECTION_WORKSPACE_H
#define GG_DIRECTION_WORKSPACE_H

#include "theory/hermite/contact_integral.h"
#include "theory/hermite/product.h"

/* A species in the frame of direction k. */
typedef struct gg_hermite_view {
  gg_hermite_frame frame;
  double marginal[GG_HERMITE_MOST_DEGREE / 2 + 1]; /* t_(2l,0,0): the distribution of normal velocities */
  double *D;                                       /* n_rotated x wide: Ho_s(c) = sum_q D_qs Ho_q(c') */
  double *t;                                       /* coefficients in the rotated frame */
  double *damped;                                  /* by Q, (j,p): sum_q Z_Qq t_jpq */
} gg_hermite_view;

struct gg_hermite_workspace {
  int wide, pairs, box; /* n padded; (P,Q) padded; (N + 1)^2 */
  int n_views;
  gg_hermite_view view[GG_MAX_SPECIES];
  double *q;          /* values of the rotated tests */
  double *K, *E;      /* for one Q, by (j,p): W of its (J,P), and the derivative of `damped` with respect to each a_s */
  double *X;          /* n_rotated x wide: derivatives of q */
  double *V, *VX, *S; /* for the partner: see derivative.c */
  double *back;       /* n x (N/2 + 1): S in the frame at rest */
  double *work;
};

static inline int gg_hermite_degree(gg_hermite_index index)
{
  return index.r[0] + index.r[1] + index.r[2];
}

/* Set the views of every species along k. */
void gg_hermite_set_views(gg_hermite_operator *op, int n_species, gg_hermite_state *state, const double k[3]);

/* Number of rows (P,Q) of products with the partner. */
int gg_hermite_partner_rows(int N);

/* Derivatives of all rotated tests of a species with respect to its own a_s: workspace->X. W is not changed. */
void gg_hermite_differentiate_own(const gg_hermite_operator *op, const gg_hermite_view *own);

/* Derivatives with respect to the a_s of the partner, for the flux added last: added to a block of the Jacobian. */
void gg_hermite_differentiate_partner(const gg_hermite_operator *op, const gg_hermite_view *own,
                                      const gg_hermite_view *partner, double weight, double *jacobian, size_t stride);

#endif
