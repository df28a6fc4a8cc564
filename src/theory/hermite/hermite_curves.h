/* The distributions themselves, under the names and at the abscissae of the observables that measure them. */
#ifndef GG_HERMITE_CURVES_H
#define GG_HERMITE_CURVES_H

#include "measure/curve.h"

/* Curves of those observables in `measure` (GG_MEASURE_...) that the solution has: velocity_distributions, and of
 * isotropic states sonine. GG_BAD_INPUT with the reason where the solution has none, or fails. */
gg_status gg_hermite_curves(const gg_model *model, unsigned measure, gg_curves *list, gg_error *err);

#endif
