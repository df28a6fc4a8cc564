/* What the operator needs for one direction. Rotated functions are those of the frame of the collision. */
#ifndef GG_HERMITE_ROOM_H
#define GG_HERMITE_ROOM_H

#include "theory/hermite/operator.h"
#include "theory/hermite/product.h"

struct gg_hermite_room {
  int wide, pairs, box; /* n padded; (P,Q) padded; (N + 1)^2 */
  double *D;            /* n_rotated x wide: Ho_s(c) = sum_q D_qs Ho_q(c') */
  double *t;            /* coefficients in the rotated frame */
  double *damped;       /* by Q, (j,p): sum_q Z_Qq t_jpq */
  double *q;            /* what rotated tests give */
  double *K, *E;        /* of one Q, by (j,p): W of its (J,P), and what `damped` is to each a_s */
  double *X;            /* n_rotated x wide: derivatives of q */
  double *V, *VX, *S;   /* of the partner: see derivative.c */
  double *work;
};

static inline int gg_hermite_degree(gg_hermite_index index)
{
  return index.r[0] + index.r[1] + index.r[2];
}

/* Derivatives of all rotated tests with respect to the a_s: room->X. */
void gg_hermite_differentiate(const gg_hermite_operator *op);

#endif
