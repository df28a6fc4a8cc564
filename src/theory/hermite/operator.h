/* Enskog's collision operator and streaming on an expansion about a Gaussian,
 *   f = n (2 pi)^(-3/2) |L|^-1 exp(-c^2/2) sum_s a_s Ho_s(c),   c = L^-1 C,
 * tested with psi_r = Ho_r(c) exp(-decay c^2/2): R_r = d<psi_r>/dt, and its derivatives with respect to the a_s. Tests
 * of degree 2 do not decay: energy and stress are balanced exactly. */
#ifndef GG_HERMITE_OPERATOR_H
#define GG_HERMITE_OPERATOR_H

#include "theory/hermite/basis.h"
#include "theory/hermite/flux.h"

/* What collides and streams. */
typedef struct gg_hermite_gas {
  double frequency;    /* n chi sigma^2 */
  double eta;          /* (1+e)/2 */
  double shear;        /* sigma times shear rate: the flow between two centres; 0 in the Boltzmann limit */
  double stream[3][3]; /* A of dC/dt = -A C between collisions; A_xy: shear rate */
  double diffusion;    /* D of df/dt = D laplacian f between collisions: white noise */
} gg_hermite_gas;

typedef struct gg_hermite_room gg_hermite_room;

typedef struct gg_hermite_operator {
  gg_hermite_basis basis;
  double decay;
  gg_hermite_flux flux, low; /* for tests that decay; for those of degree 2 */
  double *overlap;           /* < psi_m Ho_s > of an axis, m to N + 2 */
  int n_directions;
  double (*direction)[3], *weight;
  gg_hermite_room *room; /* of one direction */
} gg_hermite_operator;

/* `isotropic`: one direction stands for all, which is right for the isotropic part of R where f and A are isotropic. */
gg_status gg_hermite_operator_make(gg_hermite_operator *op, int degree, double decay, bool isotropic, gg_error *err);
void gg_hermite_operator_clear(gg_hermite_operator *op);

/* R, n long, and where `jacobian` is not NULL, n x n by rows, dR_r/da_s. a_0 is 1, R_0 means nothing. */
void gg_hermite_operator_at(gg_hermite_operator *op, const gg_hermite_gas *gas, double L[3][3], const double *a,
                            double *R, double *jacobian);

/* The share of streaming and diffusion in these, added. */
void gg_hermite_add_streaming(const gg_hermite_operator *op, const gg_hermite_gas *gas, double L[3][3], const double *a,
                              double *R, double *jacobian);

/* Distribution of the velocity along k: s x with x of density exp(-x^2/2)/sqrt(2 pi) sum_l marginal[l] Ho_2l(x); s is
 * returned. */
double gg_hermite_marginal(gg_hermite_operator *op, double L[3][3], const double *a, const double k[3],
                           double *marginal);

/* What collisions do and carry. */
typedef struct gg_hermite_sums {
  double rate;           /* collisions of a grain: frequency int dk <g> */
  double transfer[3][3]; /* collisional stress over n m: (frequency sigma/2) eta int dk k k <g^2> */
  double loss;           /* energy lost per grain and m: frequency (1-e^2)/8 int dk <g^3> */
  double speed;          /* <|C|> */
} gg_hermite_sums;
void gg_hermite_sums_at(gg_hermite_operator *op, const gg_hermite_gas *gas, double sigma, double L[3][3],
                        const double *a, gg_hermite_sums *sums);

#endif
