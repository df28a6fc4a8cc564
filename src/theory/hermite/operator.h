/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Enskog's collision operator and streaming on an expansion about a Gaussian, of each species its own,
 *   f = n (2 pi)^(-3/2) |L|^-1 exp(-c^2/2) sum_s a_s Ho_s(c),   c = L^-1 C,
 * tested with psi_r = Ho_r(c) exp(-decay c^2/2): R_r = d<psi_r>/dt, and its derivatives with respect to the a_s. Tests
 * of degree 2 do not decay: energy and stress are balanced exactly. */
#ifndef GG_HERMITE_OPERATOR_H
#define GG_HERMITE_OPERATOR_H

#include "common/model.h"
#include "theory/hermite/flux.h"
#include "theory/hermite/hermite_state.h"

/* Collision of a grain of one species with those of another. */
typedef struct gg_hermite_impact {
  double frequency; /* n chi sigma^2, n of the other species */
  double eta;       /* the fraction of g_n that it loses: (1+e) m_other/(m + m_other), (1+e)/2 among equals */
  double e;
  double sigma;
  double shear; /* sigma times shear rate: the flow between two centres; 0 in the Boltzmann limit */
  double apart; /* sigma times a third of div u; 0 in the Boltzmann limit */
} gg_hermite_impact;

/* The gas: collisions and streaming. */
typedef struct gg_hermite_gas {
  int n_species;
  const gg_stop *stop; /* borrowed from the model: no physics */
  double fraction[GG_MAX_SPECIES], mass[GG_MAX_SPECIES];
  gg_hermite_impact impact[GG_MAX_SPECIES][GG_MAX_SPECIES]; /* of a grain of the first species */
  double stream[3][3];                                      /* A of dC/dt = -A C between collisions; A_xy: shear rate */
  /* For each species: drag, added to the diagonal of A, and D of df/dt = D laplacian f: white noise. */
  double drag[GG_MAX_SPECIES], diffusion[GG_MAX_SPECIES];
} gg_hermite_gas;

/* The smooth grains of a model, sheared at its rate; and one species of mass 1. */
gg_hermite_gas gg_hermite_gas_of(const gg_model *model);
gg_hermite_gas gg_hermite_one(double frequency, double eta, double shear);

typedef struct gg_hermite_workspace gg_hermite_workspace;

typedef struct gg_hermite_operator {
  gg_hermite_basis basis;
  double decay;
  gg_hermite_flux flux, low; /* for tests that decay; for tests of degree 2 */
  double *overlap;           /* < psi_m Ho_s > of an axis, m to N + 2 */
  int n_directions;
  double (*direction)[3], *weight;
  gg_hermite_workspace *workspace; /* of one direction */
} gg_hermite_operator;

/* `isotropic`: use one direction instead of all. This is right for the isotropic part of R if f and A are isotropic. */
gg_status gg_hermite_operator_make(gg_hermite_operator *op, int degree, double decay, bool isotropic, gg_error *err);
void gg_hermite_operator_clear(gg_hermite_operator *op);

/* Allocate the workspace for so many species; there is one for one species. */
gg_status gg_hermite_operator_hold(gg_hermite_operator *op, int n_species, gg_error *err);

/* R, n of each species one after another, and if `jacobian` is not NULL, by rows of n_species x n, dR_r/da_s. a_0 is
 * 1, R_0 has no meaning. False: gas->stop interrupted the call. */
bool gg_hermite_operator_at(gg_hermite_operator *op, const gg_hermite_gas *gas, gg_hermite_state *state, double *R,
                            double *jacobian);

/* Add streaming and diffusion of one species to R and the Jacobian, whose rows are `stride` apart. */
void gg_hermite_add_streaming(const gg_hermite_operator *op, const gg_hermite_gas *gas, int species,
                              gg_hermite_state *state, double *R, double *jacobian, size_t stride);

/* < psi_r Ho_s > */
double gg_hermite_test_overlap(const gg_hermite_operator *op, int r, int s);

/* Collision sums, means over all grains. */
typedef struct gg_hermite_sums {
  double rate;           /* collisions of a grain: frequency int dk <g> */
  double transfer[3][3]; /* collisional stress over n: m (frequency sigma/2) eta int dk k k <g^2> */
  double loss;           /* energy lost per grain: m frequency eta (1-e)/4 int dk <g^3> */
  double speed;          /* <|C|> */
} gg_hermite_sums;
void gg_hermite_sums_at(gg_hermite_operator *op, const gg_hermite_gas *gas, gg_hermite_state *state,
                        gg_hermite_sums *sums);

#endif
