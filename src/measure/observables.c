#include "measure/observable.h"

const gg_observable *const gg_observables[] = {&gg_rheology, NULL};
