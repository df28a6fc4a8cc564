#include "measure/observable.h"

const gg_observable *const gg_observables[] = {
    &gg_rheology, /* stays first: it tells when a run is steady */
    &gg_velocity_distributions,
    &gg_local_distributions,
    &gg_orientation,
    &gg_sonine,
    &gg_pair_correlation,
    &gg_velocity_correlations,
    &gg_structure,
    &gg_cells,
    &gg_profiles,
    &gg_diffusion,
    &gg_viscosity,
    &gg_collisions,
    NULL,
};

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
