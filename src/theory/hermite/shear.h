/* Steady uniform shear of smooth grains: degree after degree. */
#ifndef GG_HERMITE_SHEAR_H
#define GG_HERMITE_SHEAR_H

#include "common/model.h"
#include "theory/hermite/state.h"

typedef struct gg_hermite_shear {
  const gg_model *model;
  gg_hermite_gas gas;
  gg_hermite_operator op; /* of the present degree */
  gg_hermite_state state;
} gg_hermite_shear;

/* Begins with the anisotropic Gaussian of the second moments. */
gg_status gg_hermite_shear_begin(gg_hermite_shear *shear, const gg_model *model, gg_error *err);
void gg_hermite_shear_end(gg_hermite_shear *shear);

/* The steady state at this degree (even, from 4 on; not below that of the last call). */
gg_status gg_hermite_shear_solve(gg_hermite_shear *shear, int degree, gg_error *err);

#endif
