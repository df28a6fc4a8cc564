/* What observables ask of a model; each is the reason to refuse it, or NULL where the model has it. */
#ifndef GG_NEEDS_H
#define GG_NEEDS_H

#include "common/model.h"

const char *gg_measure_needs_positions(const gg_model *model);
/* The same gas everywhere: no walls. */
const char *gg_measure_needs_homogeneity(const gg_model *model);
/* Both. */
const char *gg_measure_needs_bulk(const gg_model *model);

#endif
