/* What a steady shear flow of smooth grains answers. */
#ifndef GG_HERMITE_SHEAR_ANSWER_H
#define GG_HERMITE_SHEAR_ANSWER_H

#include "theory/theory.h"

gg_status gg_hermite_shear_answer(const gg_model *model, gg_theory_answer *answer, gg_error *err);

/* The degree up to which so many species are solved; 0: they are too many. */
int gg_hermite_shear_last_degree(int n_species);

#endif
