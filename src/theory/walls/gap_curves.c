/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Profiles of a solved flow, under the names and at the heights of `profiles` and `fluxes` (measure/profiles.c,
 * measure/flux_profiles.c). Slabs whose middle no centre reaches have no values. */
#include <math.h>
#include <stdio.h>

#include "common/contact_value.h"
#include "measure/gap_slabs.h"
#include "theory/walls/rough_gap.h"

typedef enum profile {
  SOLID_FRACTION,
  VELOCITY,
  TEMPERATURE,
  P_XX,
  P_YY,
  P_ZZ,
  P_XY,
  P_YX,
  HEAT,
  THETA, /* from here on of rough grains */
  RATIO,
  SPIN,
  ROTATIONAL_HEAT,
  COUPLE_STRESS,
  N_PROFILES
} profile;

static const struct {
  const char *name, *panel, *label, *unit;
  unsigned measure;
  gg_quantity like; /* of fluxes: a quantity of the same unit */
} table[N_PROFILES] = {
    [SOLID_FRACTION] = {"profile_solid_fraction", "solid fraction", "φ", "1", GG_MEASURE_PROFILES, 0},
    [VELOCITY] = {"profile_velocity", "flow velocity", "u_x", "velocity", GG_MEASURE_PROFILES, 0},
    [TEMPERATURE] = {"profile_temperature", "temperature", "T", "temperature", GG_MEASURE_PROFILES, 0},
    [P_XX] = {"profile_P_xx", "P_{xx}", "P_{xx}", NULL, GG_MEASURE_FLUXES, GG_Q_PRESSURE},
    [P_YY] = {"profile_P_yy", "P_{yy}", "P_{yy}", NULL, GG_MEASURE_FLUXES, GG_Q_PRESSURE},
    [P_ZZ] = {"profile_P_zz", "P_{zz}", "P_{zz}", NULL, GG_MEASURE_FLUXES, GG_Q_PRESSURE},
    [P_XY] = {"profile_P_xy", "P_{xy}", "P_{xy}", NULL, GG_MEASURE_FLUXES, GG_Q_PRESSURE},
    [P_YX] = {"profile_P_yx", "P_{yx}", "P_{yx}", NULL, GG_MEASURE_FLUXES, GG_Q_PRESSURE},
    [HEAT] = {"profile_q_y", "q_y", "q_y", NULL, GG_MEASURE_FLUXES, GG_Q_WALL_HEAT_FLUX},
    [THETA] = {"profile_rotational_temperature", "temperature", "θ", "temperature", GG_MEASURE_PROFILES, 0},
    [RATIO] = {"profile_temperature_ratio", "ratio of temperatures", "θ/T", "1", GG_MEASURE_PROFILES, 0},
    [SPIN] = {"profile_spin_z", "spin", "ω_z", "spin", GG_MEASURE_PROFILES, 0},
    [ROTATIONAL_HEAT] = {"profile_q_y_rotational", "q_y^r", "q_y^r", NULL, GG_MEASURE_FLUXES, GG_Q_WALL_HEAT_FLUX},
    [COUPLE_STRESS] = {"profile_M_yz", "M_{yz}", "M_{yz}", NULL, GG_MEASURE_FLUXES, GG_Q_PRESSURE},
};

static double value_of(const gg_gap *g, profile p, const double v[])
{
  const double unit = g->model->stress_unit;
  gg_gap_local at;
  g->gas.local(g->gas.self, v[GG_GAP_P], v[GG_GAP_TAU], exp(v[GG_GAP_LOG_T]), &at);
  switch (p) {
  case SOLID_FRACTION: return g->model->boltzmann ? at.n : at.phi; /* points: n over its mean */
  case VELOCITY: return v[GG_GAP_U];
  case TEMPERATURE: return exp(v[GG_GAP_LOG_T]);
  case P_XX: return unit * (v[GG_GAP_P] + at.xx);
  case P_YY: return unit * v[GG_GAP_P];
  case P_ZZ: return unit * (v[GG_GAP_P] + at.zz);
  case P_XY:
  case P_YX: return unit * v[GG_GAP_TAU];
  default: return unit * (v[GG_GAP_E] - v[GG_GAP_TAU] * v[GG_GAP_U]);
  }
}

static double rough_value_of(const gg_gap_flow *flow, profile p, double y)
{
  const double unit = flow->gap.model->stress_unit;
  const gg_rough_height at = gg_theory_rough_gap_at(flow, y);
  switch (p) {
  case SOLID_FRACTION: return at.density;
  case VELOCITY: return at.u;
  case TEMPERATURE: return at.state.T;
  case THETA: return at.state.theta;
  case RATIO: return at.state.theta / at.state.T;
  case SPIN: return at.state.omega;
  case P_XX: return unit * (at.state.P + at.local.gas.xx);
  case P_YY: return unit * at.state.P;
  case P_ZZ: return unit * (at.state.P + at.local.gas.zz);
  case P_XY: return unit * at.P_xy;
  case P_YX: return unit * at.state.tau;
  case HEAT: return unit * at.heat[0];
  case ROTATIONAL_HEAT: return unit * at.heat[1];
  default: return unit * at.couple;
  }
}

/* The numbers of profiles: slip, jump, stress on walls; of fluxes the heat through walls. */
static void put_numbers(const gg_gap_flow *flow, profile p, gg_curve *c)
{
  const gg_model *m = flow->gap.model;
  for (int w = 0; w < 2; w++) {
    const gg_surface *wall = &m->surface[w];
    const gg_gap_wall *at = &flow->wall[w];
    const struct {
      profile p;
      const char *what;
      double value;
      const char *unit;
      bool given;
    } number[] = {
        {VELOCITY, "slip", 0 - at->slip, gg_measure_curve_unit(m, "velocity"), true},
        {VELOCITY, "wall_P_yy", m->stress_unit * at->P, gg_common_quantity_unit(GG_Q_PRESSURE, m), true},
        {VELOCITY, "wall_P_yx", m->stress_unit * at->tau, gg_common_quantity_unit(GG_Q_PRESSURE, m), true},
        {TEMPERATURE, "temperature_jump", wall->temperature - at->T, gg_measure_curve_unit(m, "temperature"),
         wall->accommodation > 0},
        {HEAT, "wall_q_y", wall->side * m->stress_unit * at->heat, gg_common_quantity_unit(GG_Q_WALL_HEAT_FLUX, m),
         true},
    };
    for (size_t k = 0; k < sizeof number / sizeof *number; k++) {
      char name[40];
      if (number[k].p != p || !number[k].given) continue;
      snprintf(name, sizeof name, "%s_%s", number[k].what, wall->word);
      gg_measure_curve_put_number(c, name, number[k].value, number[k].unit);
    }
  }
}

/* Layers at walls that hydrodynamics does not have: half-range conditions stand for some 2.5 mean free paths, and dense
 * grains are ordered within 2 diameters. Comparisons with measured profiles leave them out. */
static void put_core(const gg_gap_flow *flow, gg_curve *c)
{
  const gg_model *m = flow->gap.model;
  double edge[2];
  for (int w = 0; w < 2; w++) {
    const gg_gap_local *gas = &flow->wall[w].gas;
    const double chi = m->boltzmann ? 1 : gg_common_contact_value_of(m->contact_value, gas->phi);
    const double layer = fmax(2.5 / (sqrt(2) * M_PI * gas->n * chi), m->boltzmann ? 0 : 2);
    edge[w] = w ? flow->gap.high - layer : flow->gap.low + layer;
  }
  gg_measure_curve_put_setting(c, "core_from", edge[0], c->x_unit);
  gg_measure_curve_put_setting(c, "core_to", edge[1], c->x_unit);
}

static void put(const gg_gap_flow *flow, profile p, gg_curves *list)
{
  const gg_gap *g = &flow->gap;
  const gg_model *m = g->model;
  const int slabs = gg_measure_gap_slabs(m);
  list->group = table[p].unit ? "profiles" : "fluxes";
  gg_curve *c = gg_measure_curve_add(list, (size_t)slabs, table[p].name, table[p].panel, table[p].label);
  gg_measure_curve_axes(c, "y", gg_measure_curve_unit(m, "length"), table[p].label,
                        table[p].unit ? gg_measure_curve_unit(m, table[p].unit)
                                      : gg_common_quantity_unit(table[p].like, m));
  for (size_t i = 0; i < c->n; i++) {
    double v[GG_GAP_FUNCTIONS];
    c->x[i] = ((double)i + 0.5) * m->box[1] / slabs;
    c->value[i] = c->error[i] = NAN;
    if (c->x[i] < g->low || c->x[i] > g->high) continue;
    gg_theory_boundary_at(&flow->solution, GG_GAP_FUNCTIONS, c->x[i], v, NULL);
    c->value[i] = flow->rough ? rough_value_of(flow, p, c->x[i]) : value_of(g, p, v);
    c->error[i] = fabs(c->value[i]) * flow->solution.residual;
  }
  if (table[p].unit) gg_measure_gap_middle(m, c, p == VELOCITY);
  put_numbers(flow, p, c);
  put_core(flow, c);
}

void gg_theory_gap_profiles(const gg_gap_flow *flow, unsigned measure, gg_curves *list)
{
  const int end = flow->rough ? N_PROFILES : THETA;
  for (int p = 0; p < end; p++)
    if (measure & table[p].measure) put(flow, (profile)p, list);
}
