/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Navier-Stokes hydrodynamics of granular gases between walls: newtonian_gas.h; rough grains: rough_fluid.h. */
#include "theory/answer.h"
#include "theory/theory_list.h"
#include "theory/walls/rough_gap.h"

static const char name[] = "navier_stokes";

static gg_status gas_of(const gg_model *m, double low, double high, void *memory, gg_gap_gas *gas, gg_error *err)
{
  (void)low, (void)high, (void)err;
  gg_theory_newtonian_gas_make(m, memory);
  *gas = (gg_gap_gas){gg_theory_newtonian_gas_local, memory};
  return GG_OK;
}

static gg_status flow_of(const gg_model *m, void *memory, gg_gap_flow *flow, gg_error *err)
{
  gg_gap_gas gas;
  if (m->rule != GG_SMOOTH) {
    gg_theory_rough_fluid_make(m, memory);
    return gg_theory_rough_gap_solve(m, memory, name, flow, err);
  }
  GG_TRY(gas_of(m, 0, 0, memory, &gas, err));
  return gg_theory_gap_solve(m, gas, name, flow, err);
}

static const gg_gap_theory theory = {name, true, sizeof(gg_rough_fluid), flow_of, gas_of};

const gg_theory gg_theory_navier_stokes = {
    .name = name,
    .flows = GG_FLOW_BIT(GG_COUETTE) | GG_FLOW_BIT(GG_POISEUILLE) | GG_FLOW_BIT(GG_CHUTE) | GG_FLOW_BIT(GG_FOURIER),
    .title = "Hydrodynamics between walls",
    .citation = "Coefficients: V. Garzo, A. Santos and J.M. Montanero, Physica A 376 (2007) 94; rough grains: C.K.K. "
                "Lun, J. Fluid Mech. 233 (1991) 539; walls: J.C. Maxwell, Phil. Trans. 170 (1879) 231",
    .answers =
        "temperature rotational_temperature temperature_ratio P_yy P_yx dissipation wall_dissipation wall_heat_flux "
        "wall_friction energy_balance",
    .assumptions =
        "Spheres of one species between flat walls, smooth or of constant beta, in steady flow without layers or "
        "waves: balances of mass, momentum, energy and spin, to first order in gradients, with the transport "
        "coefficients of "
        "the cooling gas (rough: lun1991), and half-range conditions at walls. Kn up to 0.3; e near 1.",
    .gap = &theory,
};

static const char name_noise_free[] = "navier_stokes_hermite";

static gg_status noise_free_gas_of(const gg_model *m, double low, double high, void *memory, gg_gap_gas *gas,
                                   gg_error *err)
{
  (void)low, (void)high;
  gg_newtonian_gas *g = memory;
  gg_error why = {0};
  gg_theory_newtonian_gas_make(m, g);
  const gg_status status = gg_theory_noise_free_gas_make(m, &g->series, &why);
  if (status != GG_OK) return gg_theory_reject(err, name_noise_free, "has no coefficients here: %s", why.message);
  g->noise_free = true;
  *gas = (gg_gap_gas){gg_theory_newtonian_gas_local, g};
  return GG_OK;
}

static gg_status noise_free_flow_of(const gg_model *m, void *memory, gg_gap_flow *flow, gg_error *err)
{
  gg_gap_gas gas;
  GG_TRY(noise_free_gas_of(m, 0, 0, memory, &gas, err));
  return gg_theory_gap_solve(m, gas, name_noise_free, flow, err);
}

static const gg_gap_theory noise_free = {name_noise_free, false, sizeof(gg_newtonian_gas), noise_free_flow_of,
                                         noise_free_gas_of};

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
};
