/* Which thermostat a model has, and how strong: what both engines need to heat alike. */
#ifndef GG_THERMOSTAT_H
#define GG_THERMOSTAT_H

#include "common/model.h"

/* The thermostat in force: that of the scene, or the flow's default where it needs one. */
gg_thermostat gg_common_thermostat_of(const gg_model *model);

/* xi^2 at which white noise balances the collisions of Maxwellians at temperature0 and ratio0. */
double gg_common_thermostat_noise(const gg_model *model);

#endif
