/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Cooling state of a smooth binary mixture and its viscosity, for theories and tests. */
#ifndef GG_GARZO_MONTANERO2003_H
#define GG_GARZO_MONTANERO2003_H

#include "theory/mixture.h"

/* The fourth-moment equations linear in c, or divided by 1 + c_i/2 before they are linearised. */
typedef enum gg_linearisation { GG_LINEAR, GG_DIVIDED } gg_linearisation;

typedef struct gg_mixture_state {
  double a[GG_BINARY], c[GG_BINARY]; /* T_i/m_i; fourth cumulants */
  double zeta;                       /* common cooling rate; NaN if there is none */
} gg_mixture_state;
gg_mixture_state gg_theory_mixture_cooling(const gg_model *model, gg_linearisation how, double T);

/* Shear viscosity; share: 1/2 cooling, 1 heated. */
typedef struct gg_mixture_viscosity {
  double kinetic, total;
} gg_mixture_viscosity;
gg_mixture_viscosity gg_theory_mixture_viscosity_of(const gg_model *model, const gg_mixture_state *state, double share);

#endif
