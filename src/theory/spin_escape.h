/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Free cooling with Coulomb friction has no steady state. A grain that spins fast slides in every contact, where
 * friction takes no more from a faster spin: ds/dt = -pi^2 (mu eta_1/K) n chi (T + T_f)/2, with T_f of its own
 * velocity. T falls as t^-2, so that the sum of what friction can still take is finite. Faster grains spin for ever,
 * and theta/T then grows as exp(zeta t). Before grains escape, the gas is in a metastable state.
 * docs/explanation/free_cooling_with_friction.md has the numbers. */
#ifndef GG_SPIN_ESCAPE_H
#define GG_SPIN_ESCAPE_H

#include "theory/answer.h"

/* True in free cooling with finite friction. */
bool gg_theory_is_metastable(const gg_model *model);

/* Fraction of grains that escape friction per collision a grain, from the metastable state of one species,
 * independent of the density; within a factor of two of Monte Carlo up to mu = 0.8. 0: friction stops every grain; NaN:
 * there is no metastable state, or the rate is unknown (mixtures, laws of restitution). */
double gg_theory_spin_escape(const gg_model *model);

/* A theory that takes the metastable state for a steady one answers where grains seldom escape. GG_OK for gases that
 * are not metastable; GG_BAD_INPUT with the reason where more than GG_MOST_ESCAPES escape. */
#define GG_MOST_ESCAPES 1e-5
gg_status gg_theory_require_lasting(const gg_model *model, const char *theory, gg_error *err);

/* The remark on an answer for the metastable state, for gg_theory.beyond; NULL for other gases. */
const char *gg_theory_beyond_metastable(const gg_model *model);

#endif
