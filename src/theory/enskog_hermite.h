/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Answers of the solver of Enskog's equation without random numbers (enskog_hermite.c), state by state. */
#ifndef GG_ENSKOG_HERMITE_H
#define GG_ENSKOG_HERMITE_H

#include "theory/hermite/component.h"
#include "theory/theory.h"

/* Steady shear of smooth grains; and the highest degree that is solved for so many species (0: too many). */
gg_status gg_hermite_shear_answer(const gg_model *model, gg_theory_answer *answer, gg_error *err);
int gg_hermite_shear_last_degree(int n_species);

/* Heat flux of one species of smooth grains that cools: the three conductivities alone. */
gg_status gg_theory_enskog_hermite_conduct(const gg_model *model, gg_theory_answer *answer, gg_error *err);

/* Several species of smooth grains, cooling or heated. */
gg_status gg_hermite_mixture_answer(const gg_model *model, gg_theory_answer *answer, gg_error *err);

/* Rough or frictional grains of one species: steady uniform shear, free cooling or heated translation. */
gg_status gg_rough_answer(const gg_model *model, gg_theory_answer *answer, gg_error *err);

/* Components of velocity and spin (1) of the last three approximations, the last first. */
typedef struct gg_rough_marginals {
  gg_hermite_component of[3][2][3];
} gg_rough_marginals;
gg_status gg_rough_marginals_of(const gg_model *model, gg_rough_marginals *marginals, gg_error *err);

/* The distributions themselves, under the names and at the abscissae of the observables that measure them: those in
 * `measure` (GG_MEASURE_...) that the solution has: velocity_distributions, and in isotropic states sonine.
 * GG_BAD_INPUT with the reason where the solution has none, or fails. */
gg_status gg_hermite_curves(const gg_model *model, unsigned measure, gg_curves *list, gg_error *err);

#endif
