#ifndef GG_GRAD_H
#define GG_GRAD_H

#include "theory/answer.h"

/* Dilute shear of a smooth binary mixture, in the name of the theory that asks. */
gg_status gg_theory_grad_mixture(const gg_model *model, const char *theory, gg_theory_answer *answer, gg_error *err);

#endif
