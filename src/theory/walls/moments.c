/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Non-Newtonian hydrodynamics of granular gases between walls: the stress of the Gaussian closure at the local shear
 * rate, with the heat flux of 13 moments (gaussian_table.h). It starts from the flow of navier_stokes. */
#include <math.h>

#include "common/contact_value.h"
#include "theory/theory_list.h"
#include "theory/walls/gaussian_table.h"

static const char name[] = "moments";

/* Densities of the table, over those of the Newtonian flow. */
static const double below = 0.4, above = 1.7;

static void densities(const gg_gap_flow *flow, double *low, double *high)
{
  const gg_boundary_solution *s = &flow->solution;
  const gg_model *m = flow->gap.model;
  *low = *high = 1;
  for (int i = 0; i < s->points && !m->boltzmann; i++) {
    const double n = s->f[i][GG_GAP_N];
    *low = i ? fmin(*low, n) : n, *high = i ? fmax(*high, n) : n;
  }
  if (m->boltzmann) return;
  *low *= below, *high = fmin(*high * above, gg_common_contact_value_limit(m->contact_value) * 6 / M_PI);
}

static gg_status flow_of(const gg_model *m, void *memory, gg_gap_flow *flow, gg_error *err)
{
  gg_gaussian_table *table = memory;
  double low, high;
  gg_theory_newtonian_gas_make(m, &table->gas);
  GG_TRY(gg_theory_gap_solve(m, (gg_gap_gas){gg_theory_newtonian_gas_local, &table->gas}, name, flow, err));
  densities(flow, &low, &high);
  GG_TRY(gg_theory_gaussian_table_make(m, low, high, table, err));
  return gg_theory_gap_solve(m, (gg_gap_gas){gg_theory_gaussian_table_local, table}, name, flow, err);
}

static gg_status gas_of(const gg_model *m, double low, double high, void *memory, gg_gap_gas *gas, gg_error *err)
{
  *gas = (gg_gap_gas){gg_theory_gaussian_table_local, memory};
  return gg_theory_gaussian_table_make(m, low, high, memory, err);
}

static const gg_gap_theory theory = {name, sizeof(gg_gaussian_table), flow_of, gas_of};

static gg_status evaluate(const gg_model *m, gg_theory_answer *a, gg_error *err)
{
  return gg_theory_gap_evaluate(&theory, m, a, err);
}

static gg_status curves(const gg_model *m, unsigned measure, gg_curves *list, gg_error *err)
{
  return gg_theory_gap_curves(&theory, m, measure, list, err);
}

static gg_status fluxes(const gg_model *m, size_t n, const gg_gap_state *state, gg_gap_fluxes *to, gg_error *err)
{
  return gg_theory_gap_fluxes(&theory, m, n, state, to, err);
}

const gg_theory gg_theory_moments = {
    .name = name,
    .flows = GG_FLOW_BIT(GG_COUETTE) | GG_FLOW_BIT(GG_POISEUILLE) | GG_FLOW_BIT(GG_CHUTE) | GG_FLOW_BIT(GG_FOURIER),
    .title = "Non-Newtonian hydrodynamics of smooth grains between walls",
    .citation = "Stress: J.T. Jenkins and M.W. Richman, J. Fluid Mech. 192 (1988) 313; heat flux: H. Grad, Commun. "
                "Pure Appl. Math. 2 (1949) 331; H. Struchtrup and M. Torrilhon, Phys. Fluids 15 (2003) 2668",
    .answers = "temperature P_yy P_yx dissipation wall_dissipation wall_heat_flux wall_friction energy_balance",
    .assumptions = "As navier_stokes, but with the stress of the Gaussian closure at the local shear rate and a heat "
                   "flux of 13 moments, two factors of which were chosen by comparison with Monte Carlo. Kn up to 0.3, "
                   "e from 0.7; best where shear heats the gas.",
    .evaluate = evaluate,
    .curves = curves,
    .fluxes = fluxes,
};
