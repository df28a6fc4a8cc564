/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Haff's law: temperature and collisions in time. */
#ifndef GG_HAFF1983_H
#define GG_HAFF1983_H

#include "theory/theory.h"

/* Temperature of a gas that cools freely from T0 with the initial cooling rate zeta0 = -(dT/dt)/T: T0/(1 + zeta0
 * t/2)^2. */
double gg_theory_haff_temperature(double T0, double zeta0, double t);

/* Collisions per grain up to time t, for the initial collision rate nu0. */
double gg_theory_haff_collisions(double nu0, double zeta0, double t);

#endif
