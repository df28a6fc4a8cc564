/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The observables there are, a line each: the one place where they are named and described. The flags of a scene's
 * `measure`, the words that a scene may give it, and the table of plug-ins (measure/observable.c) are made from
 * it. */
#ifndef GG_OBSERVABLES_H
#define GG_OBSERVABLES_H

/* X(FLAG, word, description). rheology stays first: it decides when a run is steady. */
#define GG_OBSERVABLES(X)                                                                                              \
  X(RHEOLOGY, rheology, "temperatures, spin, stress, collision rate, free path, velocity moments")                     \
  X(VELOCITY_DISTRIBUTIONS, velocity_distributions,                                                                    \
    "distributions of the components of C and Omega, with their tails")                                                \
  X(LOCAL_DISTRIBUTIONS, local_distributions, "distributions of C_x and Omega_z by the local density")                 \
  X(ORIENTATION, orientation, "angle between peculiar velocity and spin")                                              \
  X(SONINE, sonine, "deviation of speeds from a Maxwellian")                                                           \
  X(PAIR_CORRELATION, pair_correlation, "g(r) from contact outwards")                                                  \
  X(VELOCITY_CORRELATIONS, velocity_correlations, "velocity correlations of pairs over their distance")                \
  X(LOCAL_VELOCITY_CORRELATIONS, local_velocity_correlations,                                                          \
    "velocity correlations of pairs, velocities relative to cell means")                                               \
  X(STRUCTURE, structure, "structure factor and velocity spectra")                                                     \
  X(CELLS, cells, "local density, shear rate, temperatures and spin")                                                  \
  X(PROFILES, profiles, "density, flow, temperatures and spin across the gap between walls")                           \
  X(FLUXES, fluxes, "stress, heat flux and balance of energy across the gap between walls")                            \
  X(SLAB_DISTRIBUTIONS, slab_distributions, "distributions of C and Omega by height between walls")                    \
  X(DIFFUSION, diffusion, "velocity autocorrelation, mean-square displacement, self-diffusion")                        \
  X(VISCOSITY, viscosity, "eta* of cooling and heated gases by linear response; comes with flow: small_shear")         \
  X(SHEAR_WAVE, shear_wave, "eta* from the decay of a transverse wave; comes with start.wave")                         \
  X(CONDUCTIVITY, conductivity, "kappa* and mu* of grains that cool or rest, by Green-Kubo integrals")                 \
  X(HELFAND, helfand, "viscosities and conductivity of elastic grains at rest, by Helfand moments")                    \
  X(COLLISIONS, collisions, "free paths, times between collisions, angles of contact")                                 \
  X(IMPACT_SPEED, impact_speed, "normal relative speed of collisions")

#define GG_OBSERVABLE_ID(FLAG, word, description) GG_OBSERVABLE_##FLAG,
enum { GG_OBSERVABLES(GG_OBSERVABLE_ID) GG_N_OBSERVABLES };
#undef GG_OBSERVABLE_ID

/* Observables requested under `measure` of a scene: a sum of these. */
#define GG_OBSERVABLE_FLAG(FLAG, word, description) GG_MEASURE_##FLAG = 1u << GG_OBSERVABLE_##FLAG,
enum { GG_OBSERVABLES(GG_OBSERVABLE_FLAG) };
#undef GG_OBSERVABLE_FLAG

#endif
