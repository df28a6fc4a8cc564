/* Observables that the user's program brings (graingas.h, "Extension"): all those of a scene behind one of ours. */
#ifndef GG_OWN_H
#define GG_OWN_H

#include "measure/observable.h"

/* The plug-in for what the model has; NULL without any. */
const gg_observable *gg_measure_user_observables(const gg_model *model);

#endif
