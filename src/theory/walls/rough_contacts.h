/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Production by contacts of rough grains at T = 1, n chi = 1, whose velocities are Gaussian about a sheared flow, with
 * spins that roll with it (gaussian_moments.h): polynomials in the deviator of <CC> and in the shear rate a, fitted to
 * the integrals over contacts. They are linear in theta. */
#ifndef GG_ROUGH_CONTACTS_H
#define GG_ROUGH_CONTACTS_H

#include "theory/theory.h"

enum { GG_CONTACT_XX, GG_CONTACT_YY, GG_CONTACT_ZZ, GG_CONTACT_P_XX, GG_CONTACT_P_YY, GG_CONTACT_P_ZZ, GG_CONTACT_SPINS,
       GG_CONTACT_EVEN, /* those below are odd in a */
       GG_CONTACT_XY = GG_CONTACT_EVEN, GG_CONTACT_P_YX, GG_CONTACT_SPIN, GG_CONTACT_FUNCTIONS };
enum { GG_CONTACT_MONOMIALS = 38 };

typedef struct gg_rough_contacts {
  double constant[GG_CONTACT_FUNCTIONS][GG_CONTACT_MONOMIALS], per_ratio[GG_CONTACT_FUNCTIONS][GG_CONTACT_MONOMIALS];
  double off; /* largest error of the fit */
} gg_rough_contacts;

typedef struct gg_rough_point {
  double xx, yy, xy, a; /* of <CC> - 1; shear rate */
} gg_rough_point;

/* false: no memory */
bool gg_theory_rough_contacts_make(const gg_model *model, gg_rough_contacts *c);
/* At theta/T. */
void gg_theory_rough_contacts_at(const gg_rough_contacts *c, double ratio, double coefficient[GG_CONTACT_FUNCTIONS][GG_CONTACT_MONOMIALS]);
void gg_theory_rough_contacts_value(double coefficient[GG_CONTACT_FUNCTIONS][GG_CONTACT_MONOMIALS],
                                    gg_rough_point p, double value[GG_CONTACT_FUNCTIONS]);

#endif
