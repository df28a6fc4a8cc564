/* The frame of a collision: normal along L^T k; tangent in the plane of that and L^-1 k; binormal. */
#ifndef GG_HERMITE_CONTACT_H
#define GG_HERMITE_CONTACT_H

#include "theory/hermite/flux.h"

/* shear: sigma times shear rate. The three axes are rows. */
gg_hermite_contact gg_hermite_contact_at(double eta, double shear, double L[3][3], const double k[3],
                                         double axis[3][3]);

/* B = L^-1 A, L lower triangular. */
void gg_hermite_left_divide(double L[3][3], double A[3][3], double B[3][3]);

#endif
