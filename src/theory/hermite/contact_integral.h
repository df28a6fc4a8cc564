/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The frame of a collision: normal along L^T k; tangent in the plane of that and L^-1 k; binormal. */
#ifndef GG_HERMITE_CONTACT_H
#define GG_HERMITE_CONTACT_H

#include "theory/hermite/operator.h"

/* The frame of one grain. The three axes are rows. */
typedef struct gg_hermite_frame {
  double axis[3][3];
  double s;      /* |L^T k| */
  double b0, b1; /* L^-1 k along normal and tangent */
} gg_hermite_frame;

gg_hermite_frame gg_hermite_frame_at(double L[3][3], const double k[3]);

gg_hermite_contact gg_hermite_contact_of(const gg_hermite_impact *impact, const gg_hermite_frame *grain,
                                         const gg_hermite_frame *partner, const double k[3]);

/* B = L^-1 A, L lower triangular. */
void gg_hermite_left_divide(double L[3][3], double A[3][3], double B[3][3]);

#endif
