/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Navier-Stokes hydrodynamics of granular gases between walls: newtonian_gas.h. */
#include "theory/theory_list.h"
#include "theory/walls/newtonian_gas.h"

static const char name[] = "navier_stokes";

static gg_status flow_of(const gg_model *m, void *gas, gg_gap_flow *flow, gg_error *err)
{
  gg_theory_newtonian_gas_make(m, gas);
  return gg_theory_gap_solve(m, (gg_gap_gas){gg_theory_newtonian_gas_local, gas}, name, flow, err);
}

static gg_status gas_of(const gg_model *m, double low, double high, void *memory, gg_gap_gas *gas, gg_error *err)
{
  (void)low, (void)high, (void)err;
  gg_theory_newtonian_gas_make(m, memory);
  *gas = (gg_gap_gas){gg_theory_newtonian_gas_local, memory};
  return GG_OK;
}

static const gg_gap_theory theory = {name, sizeof(gg_newtonian_gas), flow_of, gas_of};

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

const gg_theory gg_theory_navier_stokes = {
    .name = name,
    .flows = GG_FLOW_BIT(GG_COUETTE) | GG_FLOW_BIT(GG_POISEUILLE) | GG_FLOW_BIT(GG_CHUTE) | GG_FLOW_BIT(GG_FOURIER),
    .title = "Hydrodynamics of smooth grains between walls",
    .citation = "Coefficients: V. Garzo, A. Santos and J.M. Montanero, Physica A 376 (2007) 94; walls: J.C. Maxwell, "
                "Phil. Trans. 170 (1879) 231",
    .answers = "temperature P_yy P_yx dissipation wall_dissipation wall_heat_flux "
               "wall_friction energy_balance",
    .assumptions = "Smooth spheres of one species between flat walls, in steady flow without layers or waves: balances "
                   "of mass, momentum and energy with the transport coefficients of the cooling gas, to first order in "
                   "gradients, and half-range conditions at walls. Kn up to 0.3; e near 1.",
    .evaluate = evaluate,
    .curves = curves,
    .fluxes = fluxes,
};
