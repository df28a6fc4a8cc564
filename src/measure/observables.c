#include "measure/observable.h"

#define PLUG_IN(FLAG, word, description) &gg_##word,
const gg_observable *const gg_observables[] = {GG_OBSERVABLES(PLUG_IN) NULL};

const gg_quantity gg_history_quantities[GG_N_HISTORY] = {
    GG_Q_TEMPERATURE,
    GG_Q_ROTATIONAL_TEMPERATURE,
    GG_Q_TEMPERATURE_RATIO,
    GG_Q_PRESSURE,
    GG_Q_P_XY,
    GG_Q_SPIN_Z,
    GG_Q_COLLISION_RATE,
    GG_Q_A2,
    GG_Q_COS2_PSI,
};
