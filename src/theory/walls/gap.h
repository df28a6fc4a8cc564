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
  double n_P, n_T;      /* derivatives of n to P and T at constant tau/P, */
  double n_tau;         /* and to tau at constant P and T */
  double kappa, mu;     /* heat flux -kappa T' - mu n' */
  double loss;          /* energy per volume and time */
  double Txx, Tyy, Tzz; /* <C_a^2> of grains that arrive at a wall */
  double xx, zz;        /* P_xx - P_yy, P_zz - P_yy */
  double carried_x;     /* carried heat flux along x, over the heat flux along y */
  double path;          /* length of the layer in which the normal temperature relaxes at walls; 0: none */
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
  double P, tau;               /* stress on the wall, weight of layers included */
  double heat;                 /* that the wall takes, as it moves with it */
  double slip;                 /* velocity of the gas, continued to the wall, minus that of the wall */
  double T;                    /* temperature of the gas, likewise */
  double grains, warmth, loss; /* of layers at the wall (wall_condition.h) */
  gg_gap_local gas;
} gg_gap_wall;

typedef struct gg_gap_flow {
  gg_gap gap;
  gg_gap_wall wall[2];          /* lower, upper */
  double work, loss;            /* per area: of walls and gravity; of collisions */
  double temperature;           /* mean over grains */
  double theta;                 /* likewise, of the spins of rough grains */
  double normal, shear;         /* integrals of P_yy and P_yx over y */
  struct gg_rough_fluid *rough; /* the gas of rough grains (rough_gap.h); NULL: of smooth ones, gap.gas */
  gg_boundary_solution solution;
} gg_gap_flow;

/* Why no theory of this kind describes the scene: GG_BAD_INPUT with the reason. */
gg_status gg_theory_gap_check(const gg_model *model, const char *theory, bool rough, gg_error *err);

/* Mean free path at the mean density over the width that centres have. */
double gg_theory_gap_knudsen(const gg_model *model);

/* The flow, from a uniform start, or if *flow has a solution from that. GG_BAD_INPUT with the reason where no steady
 * state exists; GG_FAILED without convergence. */
gg_status gg_theory_gap_solve(const gg_model *model, gg_gap_gas gas, const char *theory, gg_gap_flow *flow,
                              gg_error *err);

/* Integrals over the gap by Gauss's formula of three points in each interval, none of them one of the collocation:
 * `add` adds a slice at height y, of this thickness, to the sums of *flow, which begin at 0. */
typedef void gg_gap_add(gg_gap_flow *flow, double y, double thickness);
void gg_theory_gap_integrate(gg_gap_flow *flow, gg_gap_add *add);

/* Why the theory errs in this flow: Kn, slip, normal stress differences, heat; "" where none applies. */
void gg_theory_gap_remark(const gg_gap_flow *flow, double Kn, char text[GG_THEORY_REMARK]);

/* A theory of this kind: bytes of its gas, and the flow of a model that passes the check. */
typedef struct gg_gap_theory {
  const char *name;
  bool rough; /* does it describe rough grains, too? */
  size_t size;
  gg_status (*flow_of)(const gg_model *model, void *gas, gg_gap_flow *flow, gg_error *err);
  /* The gas for number densities from low to high. */
  gg_status (*gas_of)(const gg_model *model, double low, double high, void *memory, gg_gap_gas *gas, gg_error *err);
} gg_gap_theory;

/* Answer, numbers of the flow under the common names, and list, its profiles as `profiles` and `fluxes` measure them.
 * Both from one solution; NULL: without these. */
gg_status gg_theory_gap_answer(const gg_gap_theory *theory, const gg_model *model, gg_theory_answer *answer,
                               unsigned measure, gg_curves *list, gg_error *err);

/* Profiles of a flow (gap_curves.c). */
void gg_theory_gap_profiles(const gg_gap_flow *flow, unsigned measure, gg_curves *list);

/* For gg_theory.fluxes. */
gg_status gg_theory_gap_fluxes(const gg_gap_theory *theory, const gg_model *model, size_t n,
                               const gg_local_state *state, gg_local_fluxes *fluxes, gg_error *err);

/* Pass the flow to a function, and free it. */
typedef void gg_gap_use(const gg_gap_flow *flow, void *to);
gg_status gg_theory_gap_with_flow(const gg_gap_theory *theory, const gg_model *model, gg_gap_use *use, void *to,
                                  gg_error *err);

#endif
