/* Enskog's equation of rough grains of constant beta, solved without random numbers: the part of enskog_hermite that
 * has spins. */
#ifndef GG_ROUGH_ANSWER_H
#define GG_ROUGH_ANSWER_H

#include "theory/theory.h"

/* Steady uniform shear, free cooling or heated translation of one species. */
gg_status gg_rough_answer(const gg_model *model, gg_theory_answer *answer, gg_error *err);

#endif
