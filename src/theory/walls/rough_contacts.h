/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Production of moments by contacts of rough grains at T = 1, n chi = 1, whose velocities are Gaussian about a flow of
 * shear rate a, and whose spins are isotropic about those of rolling: the integrals of gaussian_moments.h as
 * polynomials of degree 4 in a and in the deviator of <CC>, fitted over the states of sheared gases to about 1e-3. They
 * are linear in theta, and the same at all densities. */
#ifndef GG_ROUGH_CONTACTS_H
#define GG_ROUGH_CONTACTS_H

#include "theory/theory.h"

/* d<C_a C_b>/dt, collisional stress over n^2 chi, energy lost over n^2 chi, and d<s_z>/dt. */
enum {
  GG_CONTACT_XX,
  GG_CONTACT_YY,
  GG_CONTACT_ZZ,
  GG_CONTACT_P_XX,
  GG_CONTACT_P_YY,
  GG_CONTACT_P_ZZ,
  GG_CONTACT_LOSS,
  GG_CONTACT_XY, /* from here on odd in a */
  GG_CONTACT_P_YX,
  GG_CONTACT_SPIN,
  GG_CONTACT_FUNCTIONS,
  GG_CONTACT_EVEN = GG_CONTACT_XY,
  GG_CONTACT_MONOMIALS = 38
};

typedef double gg_contact_series[GG_CONTACT_FUNCTIONS][GG_CONTACT_MONOMIALS];

typedef struct gg_rough_contacts {
  gg_contact_series smooth, spins; /* the sum smooth + theta/T spins */
} gg_rough_contacts;

typedef struct gg_contact_point {
  double xx, yy, xy, a; /* <CC> - 1; shear rate */
} gg_contact_point;

gg_status gg_theory_rough_contacts_make(const gg_model *model, gg_rough_contacts *contacts, gg_error *err);
/* The series at theta/T, and its values. */
void gg_theory_rough_contacts_at(const gg_rough_contacts *contacts, double ratio, gg_contact_series series);
void gg_theory_rough_contacts_value(const gg_contact_series series, gg_contact_point point,
                                    double value[GG_CONTACT_FUNCTIONS]);
/* The integrals themselves; the model has n = chi = 1 (gg_theory_rough_contacts_model), and gets the
 * shear rate of the point. */
void gg_theory_rough_contacts_integral(gg_model *model, gg_contact_point point, double ratio,
                                       double value[GG_CONTACT_FUNCTIONS]);
void gg_theory_rough_contacts_model(const gg_model *model, gg_model *one);

#endif
