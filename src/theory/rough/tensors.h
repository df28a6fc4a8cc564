/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Functions of C and s that rotate as a vector (of a gradient) or a symmetric tensor without trace (of a rate of
 * strain) and are odd or even under reflection; s is an axial vector. In creation operators a of velocities and b of
 * spins, with scalars (a.a)^i (b.b)^j (a.b)^2k in front:
 *   a_c,  b_c (a.b),  (b x a)_c;    E:aa,  E:bb,  E:ab (a.b),  E:a(b x a),  E:b(b x a) (a.b).
 * There are no others. About the axis z of a collision there are several components: c = z, and x, to which y is
 * equivalent; E = zz - 1/3, xz and xy, each with an equivalent one. */
#ifndef GG_ROUGH_TENSORS_H
#define GG_ROUGH_TENSORS_H

#include "theory/rough/functions.h"

enum { GG_ROUGH_COMPONENTS = 3 };

typedef struct gg_rough_tensors {
  int rank, components,
      n; /* 1 or 2; number of components that differ; of functions. The first is of least degree: C, or CC */
  double share[GG_ROUGH_COMPONENTS]; /* weight in an average over all components */
  /* Components by their Hermite functions: `place` among those of `f`, and coefficients by rows. */
  int many[GG_ROUGH_COMPONENTS], *place[GG_ROUGH_COMPONENTS];
  double *of[GG_ROUGH_COMPONENTS];
} gg_rough_tensors;

/* All functions up to a degree. */
gg_status gg_rough_tensors_make(gg_rough_tensors *t, const gg_rough_functions *f, int rank, int degree, gg_error *err);
void gg_rough_tensors_clear(gg_rough_tensors *t);

/* E of a component. */
void gg_rough_tensors_unit(int component, double E[3][3]);

#endif
