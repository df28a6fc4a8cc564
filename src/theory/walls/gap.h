/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Steady flow of one species of smooth grains across the gap between flat walls, by the balances of a hydrodynamic
 * theory. Centres are between y = 1/2 and L - 1/2 (phi = 0: 0 and L). Model units, m = d = 1; per volume
 *   P' = n g_y,   tau' = n g_x,   E' = n g_x u - loss,   N' = n,   q = E - tau u,
 *   q = -kappa T' - mu n',   P = P_yy, tau = P_yx, N: grains per area up to y, layers at the lower wall included.
 * The gas closes them: n, u', kappa, mu and the loss from P, tau and T. */
#ifndef GG_THEORY_GAP_H
#define GG_THEORY_GAP_H

#include "theory/theory.h"
#include "theory/walls/boundary_problem.h"

/* Unknown functions of y. */
enum { GG_GAP_LOG_T, GG_GAP_U, GG_GAP_E, GG_GAP_TAU, GG_GAP_P, GG_GAP_N, GG_GAP_FUNCTIONS };

/* The gas at one height. */
typedef struct gg_gap_local {
  double n, phi, shear; /* number density, solid fraction, du/dy */
  double n_P, n_T;      /* derivatives of n(P, T) */
  double kappa, mu;     /* heat flux -kappa T' - mu n' */
  double loss;          /* energy per volume and time */
  double Txx, Tyy, Tzz; /* <C_a^2> of grains that arrive at a wall */
  double xx, zz;        /* P_xx - P_yy, P_zz - P_yy */
  double carried_x;     /* carried heat flux along x, over the heat flux along y */
} gg_gap_local;

/* A gas: what closes the balances. `local` returns false outside its densities. */
typedef struct gg_gap_gas {
  bool (*local)(void *self, double P, double tau, double T, gg_gap_local *at);
  void *self;
} gg_gap_gas;

typedef struct gg_gap {
  const gg_model *model;
  gg_gap_gas gas;
  double low, high; /* where centres begin and end */
  double grains;    /* per area */
  double T, P;      /* of the start: units */
  bool outside;     /* a last state was outside the densities of the gas */
} gg_gap;

/* The gas at a wall, and its action on the wall. */
typedef struct gg_gap_wall {
  double P, tau; /* stress on the wall, layers of grains at it included */
  double heat;   /* that the wall takes, as it moves with it */
  double slip;   /* velocity of the gas, continued to the wall, minus that of the wall */
  double T;      /* temperature of the gas, likewise */
  double layer;  /* grains per area in layers at the wall */
  gg_gap_local gas;
} gg_gap_wall;

typedef struct gg_gap_flow {
  gg_gap gap;
  gg_gap_wall wall[2];  /* lower, upper */
  double work, loss;    /* per area: of walls and gravity; of collisions */
  double temperature;   /* mean over grains */
  double normal, shear; /* integrals of P_yy and P_yx over y */
  gg_boundary_solution solution;
} gg_gap_flow;

/* Why no theory of this kind describes the scene: GG_BAD_INPUT with the reason. */
gg_status gg_theory_gap_check(const gg_model *model, const char *theory, gg_error *err);

/* Mean free path at the mean density over the width that centres have. */
double gg_theory_gap_knudsen(const gg_model *model);

/* The flow, from a uniform start, or if *flow has a solution from that. GG_BAD_INPUT with the reason where no steady
 * state exists; GG_FAILED without convergence. */
gg_status gg_theory_gap_solve(const gg_model *model, gg_gap_gas gas, const char *theory, gg_gap_flow *flow,
                              gg_error *err);

/* Why the theory errs in this flow: Kn, slip, normal stress differences, heat; "" where none applies. */
void gg_theory_gap_remark(const gg_gap_flow *flow, double Kn, char text[GG_THEORY_REMARK]);

/* A theory of this kind: bytes of its gas, and the flow of a model that passes the check. */
typedef struct gg_gap_theory {
  const char *name;
  size_t size;
  gg_status (*flow_of)(const gg_model *model, void *gas, gg_gap_flow *flow, gg_error *err);
  /* The gas for number densities from low to high. */
  gg_status (*gas_of)(const gg_model *model, double low, double high, void *memory, gg_gap_gas *gas, gg_error *err);
} gg_gap_theory;

/* For gg_theory.evaluate: numbers of the flow under the common names. */
gg_status gg_theory_gap_evaluate(const gg_gap_theory *theory, const gg_model *model, gg_theory_answer *answer,
                                 gg_error *err);

/* For gg_theory.curves: profiles, as `profiles` and `fluxes` measure them. */
gg_status gg_theory_gap_curves(const gg_gap_theory *theory, const gg_model *model, unsigned measure, gg_curves *list,
                               gg_error *err);

/* For gg_theory.fluxes. */
gg_status gg_theory_gap_fluxes(const gg_gap_theory *theory, const gg_model *model, size_t n, const gg_gap_state *state,
                               gg_gap_fluxes *fluxes, gg_error *err);

/* Pass the flow to a function, and free it. */
typedef void gg_gap_use(const gg_gap_flow *flow, void *to);
gg_status gg_theory_gap_with_flow(const gg_gap_theory *theory, const gg_model *model, gg_gap_use *use, void *to,
                                  gg_error *err);

#endif
