/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Functions that all theories share: guards that reject a scene with a reason, and reports of stress, temperatures
 * and collisions under the common names. Theories work per volume with m = d = 1 (model units); the reports convert. */
#ifndef GG_ANSWER_H
#define GG_ANSWER_H

#include "theory/theory.h"

/* Solid fraction up to which a dilute (Boltzmann) theory still answers: collisional transfer is some 15 % there. */
#define GG_DILUTE_PHI 0.05

/* Solid fraction above which the mean spin is mostly that of rolling with the flow, near -rate/2. Collisions of an
 * anisotropic f correlate spins with stress, <C_i C_j Omega_k>, and streaming turns that into a mean spin, a
 * fraction of thermal ones: about -6e-4/phi of the shear rate at e = 0.7, beta = -0.5 (Monte Carlo: -0.596(2),
 * -0.662(5), -1.17(3), -601(23) at phi = 0.01, 0.005, 0.001, 1e-6). Closures of independent velocities and spins
 * omit it. */
#define GG_ROLLING_PHI 0.01

/* Guards: GG_OK, or GG_BAD_INPUT with "<theory> describes ...; this scene is ...". */
gg_status gg_theory_reject(gg_error *err, const char *theory, const char *format, ...) GG_PRINTF(3, 4);
gg_status gg_theory_require_steady_shear(const gg_model *model, const char *theory, gg_error *err);
gg_status gg_theory_require_one_species(const gg_model *model, const char *theory, gg_error *err);
gg_status gg_theory_require_at_most_two_species(const gg_model *model, const char *theory, gg_error *err);
gg_status gg_theory_require_smooth(const gg_model *model, const char *theory, gg_error *err);
gg_status gg_theory_require_constant_beta(const gg_model *model, const char *theory, gg_error *err);
/* True if every collision loses so little of its energy (10^-6) that rounding may hide a steady state. */
bool gg_theory_is_nearly_elastic(const gg_model *model);
gg_status gg_theory_require_dilute(const gg_model *model, const char *theory, gg_error *err);

/* The collision rule of one species of unit mass: J = 2 m eta_1 ... in the notation of Lun (1991). */
typedef struct gg_grain {
  double eta1; /* (1+e)/2 */
  double eta2; /* (1+beta)K/(2(1+K)); 0 if smooth */
  double K;    /* 4I/(m d^2) */
} gg_grain;
gg_grain gg_theory_grain_of(const gg_model *model);

/* Enskog's small parameter phi chi, nothing in the Boltzmann limit. */
double gg_theory_phi_chi(const gg_model *model);

/* Stress per volume; a collisional part that a dilute theory neglects is NaN throughout. */
typedef struct gg_stress {
  double xx, yy, zz, xy, yx;
} gg_stress;
#define GG_STRESS_NEGLECTED ((gg_stress){NAN, NAN, NAN, NAN, NAN})

/* Total, kinetic and collisional stress, pressure, Z, N1, N2, and under shear the viscosity. */
void gg_theory_answer_stress(const gg_model *model, double T, gg_stress kinetic, gg_stress collisional,
                             gg_theory_answer *a);

/* Pressure and Z of a homogeneous state, from its kinetic and collisional parts per volume. */
void gg_theory_answer_pressure(const gg_model *model, double T, double kinetic, double collisional,
                               gg_theory_answer *a);

/* T, and for grains that spin theta = ratio T. */
void gg_theory_answer_temperature(const gg_model *model, double T, double ratio, gg_theory_answer *a);

/* The mean spin of a theory with spins independent of velocities: for rough grains, from GG_ROLLING_PHI on. */
void gg_theory_answer_rolling(const gg_model *model, double spin, gg_theory_answer *a);

/* Collision rate, mean free path and Knudsen number of Maxwellians at T (partial temperatures T_i for a mixture). */
void gg_theory_answer_collisions(const gg_model *model, const double T[], gg_theory_answer *a);
void gg_theory_answer_collisions_one(const gg_model *model, double T, gg_theory_answer *a);

/* Bulk viscosity of smooth grains, in eta_0, from collisional transfer; share: collision rate over that of
 * Maxwellians. This solves Enskog's equation exactly: an isotropic f of the same T has the same pressure. */
double gg_theory_bulk_viscosity(const gg_model *model, double share);

/* Box lengths above which shear modes and the heat mode of free cooling grow, from the coefficients and the cooling
 * rate of the answer, with their errors; ratio: theta/T, 0 for smooth grains. Modes of wave number k are marginal at
 *   shear: zeta/2 = eta k^2/(n m),   heat: (1 + r) zeta (C_chi - C_p/2) = 2/(3n) (kappa C_p - mu n/T) k^2
 * where the pressure is uniform and so dT/T = -C_p dn/n, C_p = 1 + d ln Z/d ln phi, C_chi = 1 + d ln chi/d ln phi:
 * J.J. Brey, J.W. Dufty, C.S. Kim & A. Santos, Phys. Rev. E 58 (1998) 4638; V. Garzo, Phys. Rev. E 72 (2005) 021106. */
void gg_theory_answer_critical_lengths(const gg_model *model, double ratio, gg_theory_answer *a);

/* Mole fraction x_i = n_i/n. */
double gg_theory_fraction(const gg_model *model, int species);

/* Collision rates and free paths of Maxwellian gases, by pairs of species. */

/* Collisions with grains of species j that one grain of species i has per unit time, at partial temperatures T. */
double gg_theory_pair_collision_rate(const gg_model *model, int i, int j, const double T[]);

/* Mean peculiar speed of species i, and its mean free path. */
double gg_theory_mean_speed(const gg_model *model, int i, const double T[]);
double gg_theory_mean_free_path(const gg_model *model, int i, const double T[]);

/* Root of f between low and high, where f changes sign, to rounding; NaN if there is none. */
double gg_theory_root_between(double (*f)(double x, void *params), void *params, double low, double high);

#endif
