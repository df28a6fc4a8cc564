/* Curves that a theory has as the limit of a series of approximations. */
#ifndef GG_THEORY_CURVES_H
#define GG_THEORY_CURVES_H

#include "measure/curve.h"

/* The last approximation, with how far each point may be from the limit as its error: the last step, or a tenth of the
 * last two, whichever is more. From x = 0 outwards, a curve ends where it is no longer known: where a distribution
 * (drawn over a logarithmic axis) is not above 0 or not within a quarter of itself, any other not within a quarter of
 * what it has reached. Beyond, its values are NaN; the number "known_from", "known_to" says where that is. `before` and
 * `earlier`: the approximations before, of the same shape; earlier may be NULL. */
void gg_theory_curves_converge(gg_curves *last, const gg_curves *before, const gg_curves *earlier);

#endif
