/* Enskog's equation of mixtures of smooth grains, cooling or heated, solved without random numbers: the part of
 * enskog_hermite that has several species. */
#ifndef GG_HERMITE_MIXTURE_ANSWER_H
#define GG_HERMITE_MIXTURE_ANSWER_H

#include "theory/theory.h"

gg_status gg_hermite_mixture_answer(const gg_model *model, gg_theory_answer *answer, gg_error *err);

#endif
