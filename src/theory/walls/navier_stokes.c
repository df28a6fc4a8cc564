/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Navier-Stokes hydrodynamics of granular gases: coefficients of the cooling gas at the local density,
 *   eta = c_0 sqrt(T) eta*,  kappa = 15/4 c_0 sqrt(T) kappa*,  mu = 15/4 c_0 T^(3/2) mu*     (times 1/n),
 *   loss = 3/2 n T zeta* n sqrt(T)/c_0,   P = n T Z,   c_0 = 5/(16 sqrt(pi)),
 * reduced as in quantities.md. The stress is Newtonian: tau = -eta u', P_xx = P_yy = P_zz. */
#include <math.h>
#include <stdlib.h>

#include "base/memory.h"
#include "common/contact_value.h"
#include "theory/answer.h"
#include "theory/range.h"
#include "theory/theory_list.h"
#include "theory/walls/gap.h"

static const char name[] = "navier_stokes";

typedef struct newtonian {
  gg_model model; /* the cooling gas at a density */
  gg_theory_answer answer;
  double most; /* solid fraction up to which the contact value is used */
} newtonian;

static void set_density(gg_model *m, double n)
{
  if (m->boltzmann) return;
  m->density = m->number_density[0] = n, m->phi = n * M_PI / 6;
  gg_common_model_set_pairs(m);
}

static double Z_of(const gg_model *m)
{
  return 1 + 2 * (1 + m->e[0]) * gg_theory_phi_chi(m);
}

/* The density at which n Z = x, by Newton's method: n Z is convex in n. */
static bool find_density(newtonian *g, double x)
{
  const double most = g->most * 6 / M_PI;
  gg_model *m = &g->model;
  if (m->boltzmann) {
    m->density = x;
    return true;
  }
  double n = fmin(x, most);
  for (int k = 0; k < 60; k++) {
    set_density(m, n);
    const double Z = Z_of(m), slope = 1 + (Z - 1) * (2 + m->chi_slope), step = (x - n * Z) / slope;
    n = fmin(n + step, most);
    if (fabs(step) <= 1e-15 * n || (n == most && step > 0)) break;
  }
  set_density(m, n);
  return n < most;
}

static bool local(void *self, double P, double tau, double T, gg_gap_local *at)
{
  newtonian *g = self;
  const gg_model *m = &g->model;
  const double *v = g->answer.value, c0 = 5 / (16 * sqrt(M_PI)), root = sqrt(T);
  const bool within = find_density(g, P / T);
  gg_theory_garzo_santos_montanero2007.evaluate(m, &g->answer, NULL);
  const double n = m->density, slope = m->boltzmann ? 1 : 1 + (Z_of(m) - 1) * (2 + m->chi_slope);
  const double viscosity = c0 * root * v[GG_Q_VISCOSITY_REDUCED];
  *at = (gg_gap_local){
      .n = n,
      .phi = m->phi,
      .shear = -tau / viscosity,
      .n_P = 1 / (T * slope),
      .n_T = -P / (T * T * slope),
      .kappa = 3.75 * c0 * root * v[GG_Q_THERMAL_CONDUCTIVITY_REDUCED],
      .mu = 3.75 * c0 * root * T * v[GG_Q_DIFFUSIVE_HEAT_CONDUCTIVITY_REDUCED] / n,
      .loss = 1.5 * n * n * T * root * v[GG_Q_COOLING_RATE] / c0,
      .Txx = T,
      .Tyy = T,
      .Tzz = T,
  };
  return within;
}

static void make(const gg_model *m, newtonian *g)
{
  g->model = *m;
  g->model.flow = GG_HCS, g->model.temperature0 = 1, g->model.rule = GG_SMOOTH;
  g->most = gg_common_contact_value_limit(m->contact_value);
}

/* Solve for the flow, and pass it on. */
typedef struct request {
  gg_theory_answer *answer; /* NULL: curves of `measure` into the list */
  unsigned measure;
  gg_curves *list;
} request;

static gg_status solve(const gg_model *m, const request *to, gg_error *err)
{
  GG_TRY(gg_theory_gap_check(m, name, err));
  newtonian *gas = gg_base_array_new(1, sizeof *gas, err);
  gg_gap_flow *flow = gg_base_array_new(1, sizeof *flow, err);
  gg_status status = gas && flow ? GG_OK : GG_FAILED;
  if (status == GG_OK) {
    make(m, gas);
    status = gg_theory_gap_solve(m, (gg_gap_gas){local, gas}, name, flow, err);
  }
  if (status == GG_OK && to->answer) gg_theory_gap_answer(flow, to->answer);
  if (status == GG_OK && to->list) status = gg_theory_gap_curves(flow, to->measure, to->list, err);
  free(gas), free(flow);
  return status;
}

static gg_status evaluate(const gg_model *m, gg_theory_answer *a, gg_error *err)
{
  return solve(m, &(request){.answer = a}, err);
}

static gg_status curves(const gg_model *m, unsigned measure, gg_curves *list, gg_error *err)
{
  if (!(measure & (GG_MEASURE_PROFILES | GG_MEASURE_FLUXES))) return GG_OK;
  return solve(m, &(request){.measure = measure, .list = list}, err);
}

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
    .evaluate = evaluate,
    .beyond = beyond,
    .curves = curves,
};
