/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Navier-Stokes hydrodynamics of granular gases between walls: newtonian_gas.h. */
#include "theory/answer.h"
#include "theory/theory_list.h"
#include "theory/walls/newtonian_gas.h"

static const char name[] = "navier_stokes";

static gg_status flow_of(const gg_model *m, void *gas, gg_gap_flow *flow, gg_error *err)
{
  gg_theory_newtonian_gas_make(m, gas);
  return gg_theory_gap_solve(m, (gg_gap_gas){gg_theory_newtonian_gas_local, gas}, name, flow, err);
}

static const gg_gap_theory theory = {name, sizeof(gg_newtonian_gas), flow_of};

static const char *beyond(const gg_model *m)
{
  if (gg_theory_gap_knudsen(m) > 0.1) return "Knudsen number above 0.1: walls are felt throughout the gap";
  if (m->e[0] < 0.7) return "Navier-Stokes order: stress of grains that lose much is anisotropic";
  return NULL;
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
    .gap = &theory,
    .beyond = beyond,
};

static const char name_noise_free[] = "navier_stokes_hermite";

static gg_status noise_free_flow_of(const gg_model *m, void *memory, gg_gap_flow *flow, gg_error *err)
{
  gg_newtonian_gas *gas = memory;
  gg_error why = {0};
  gg_theory_newtonian_gas_make(m, gas);
  const gg_status status = gg_theory_noise_free_gas_make(m, &gas->series, &why);
  if (status != GG_OK) return gg_theory_reject(err, name_noise_free, "has no coefficients here: %s", why.message);
  gas->noise_free = true;
  return gg_theory_gap_solve(m, (gg_gap_gas){gg_theory_newtonian_gas_local, gas}, name_noise_free, flow, err);
}

static const gg_gap_theory noise_free = {name_noise_free, sizeof(gg_newtonian_gas), noise_free_flow_of};

const gg_theory gg_theory_navier_stokes_hermite = {
    .name = name_noise_free,
    .flows = GG_FLOW_BIT(GG_COUETTE) | GG_FLOW_BIT(GG_POISEUILLE) | GG_FLOW_BIT(GG_CHUTE) | GG_FLOW_BIT(GG_FOURIER),
    .title = "Hydrodynamics of smooth grains between walls, coefficients of Enskog's equation",
    .citation =
        "J.W. Dufty and J.J. Brey, J. Stat. Phys. 109 (2002) 433, for the equations; walls: J.C. Maxwell, Phil. "
        "Trans. 170 (1879) 231",
    .answers = "temperature P_yy P_yx dissipation wall_dissipation wall_heat_flux "
               "wall_friction energy_balance",
    .assumptions = "As navier_stokes, with the transport coefficients of enskog_hermite, which have no Sonine "
                   "approximation: what is left of its error is that of first order in gradients, and of walls.",
    .gap = &noise_free,
    .beyond = beyond,
};
