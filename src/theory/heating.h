/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Heating that balances the loss of energy by collisions in a homogeneous state, at T = 1, with one unknown x:
 * velocities that grow at the rate x (in the scaled frame of a cooling gas, or by a Gaussian thermostat); the
 * diffusion x of white noise; or a bath: at its steady temperature, which is 1/x^2 in units of the state's, drag is
 * x times and diffusion x^3 times that at T = 1. */
#ifndef GG_HEATING_H
#define GG_HEATING_H

#include "common/model.h"

typedef enum gg_heating_kind {
  GG_HEATING_COOLS,
  GG_HEATING_STRETCHES,
  GG_HEATING_NOISE,
  GG_HEATING_BATH
} gg_heating_kind;

typedef struct gg_heating {
  gg_heating_kind kind;
  const gg_bath *bath;
  double guess; /* initial value of x */
} gg_heating;
gg_heating gg_theory_heating_of(const gg_model *model);

/* Rates of a species: dC/dt = -drag C and df/dt = diffusion laplacian f; the same for spins (surface velocities). */
typedef struct gg_heating_rates {
  double drag, diffusion, spin_drag, spin_diffusion;
} gg_heating_rates;
gg_heating_rates gg_theory_heating_at(const gg_heating *heating, int species, double x);
/* Derivatives of the rates with respect to x. */
gg_heating_rates gg_theory_heating_slopes(const gg_heating *heating, int species, double x);

/* Relative size of a step of x: over x in a bath, else over this collision rate. */
double gg_theory_heating_step(const gg_heating *heating, double x, double step, double rate);

/* The temperature of the solution in a bath; else `otherwise`. */
static inline double gg_theory_heating_temperature(const gg_heating *heating, double x, double otherwise)
{
  return heating->kind == GG_HEATING_BATH ? 1 / (x * x) : otherwise;
}

#endif
