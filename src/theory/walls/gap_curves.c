/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Profiles of a solved flow, under the names and at the heights of `profiles` and `fluxes` (measure/profiles.c,
 * measure/flux_profiles.c). Slabs whose middle no centre reaches have no values. */
#include <math.h>
#include <stdio.h>

#include "base/memory.h"
#include "measure/gap_slabs.h"
#include "theory/walls/gap.h"

static const struct {
  const char *name, *panel, *label, *unit;
  unsigned measure;
  gg_quantity like; /* of fluxes: a quantity of the same unit */
} table[GG_GAP_PROFILES] = {
    [GG_GAP_SOLID_FRACTION] = {"profile_solid_fraction", "solid fraction", "φ", "1", GG_MEASURE_PROFILES, 0},
    [GG_GAP_VELOCITY] = {"profile_velocity", "flow velocity", "u_x", "velocity", GG_MEASURE_PROFILES, 0},
    [GG_GAP_TEMPERATURE] = {"profile_temperature", "temperature", "T", "temperature", GG_MEASURE_PROFILES, 0},
    [GG_GAP_ROTATIONAL_TEMPERATURE] = {"profile_rotational_temperature", "temperature", "θ", "temperature",
                                       GG_MEASURE_PROFILES, 0},
    [GG_GAP_SPIN] = {"profile_spin_z", "spin", "ω_z", "spin", GG_MEASURE_PROFILES, 0},
    [GG_GAP_P_XX] = {"profile_P_xx", "P_{xx}", "P_{xx}", NULL, GG_MEASURE_FLUXES, GG_Q_PRESSURE},
    [GG_GAP_P_YY] = {"profile_P_yy", "P_{yy}", "P_{yy}", NULL, GG_MEASURE_FLUXES, GG_Q_PRESSURE},
    [GG_GAP_P_ZZ] = {"profile_P_zz", "P_{zz}", "P_{zz}", NULL, GG_MEASURE_FLUXES, GG_Q_PRESSURE},
    [GG_GAP_P_XY] = {"profile_P_xy", "P_{xy}", "P_{xy}", NULL, GG_MEASURE_FLUXES, GG_Q_PRESSURE},
    [GG_GAP_P_YX] = {"profile_P_yx", "P_{yx}", "P_{yx}", NULL, GG_MEASURE_FLUXES, GG_Q_PRESSURE},
    [GG_GAP_HEAT] = {"profile_q_y", "q_y", "q_y", NULL, GG_MEASURE_FLUXES, GG_Q_WALL_HEAT_FLUX},
    [GG_GAP_ROTATIONAL_HEAT] = {"profile_q_y_rotational", "q_y^r", "q_y^r", NULL, GG_MEASURE_FLUXES,
                                GG_Q_WALL_HEAT_FLUX},
    [GG_GAP_COUPLE_STRESS] = {"profile_M_yz", "M_{yz}", "M_{yz}", NULL, GG_MEASURE_FLUXES, GG_Q_PRESSURE},
};

/* The numbers of profiles: slip, jump, stress on walls; of fluxes the heat through walls. */
static void put_numbers(const gg_gap_flow *flow, gg_gap_profile p, gg_curve *c)
{
  const gg_model *m = flow->gap.model;
  for (int w = 0; w < 2; w++) {
    const gg_surface *wall = &m->surface[w];
    const gg_gap_wall *at = &flow->wall[w];
    const struct {
      gg_gap_profile p;
      const char *what;
      double value;
      const char *unit;
      bool given;
    } number[] = {
        {GG_GAP_VELOCITY, "slip", -at->slip, gg_measure_curve_unit(m, "velocity"), true},
        {GG_GAP_VELOCITY, "wall_P_yy", m->stress_unit * at->P, gg_common_quantity_unit(GG_Q_PRESSURE, m), true},
        {GG_GAP_VELOCITY, "wall_P_yx", m->stress_unit * at->tau, gg_common_quantity_unit(GG_Q_PRESSURE, m), true},
        {GG_GAP_TEMPERATURE, "temperature_jump", wall->temperature - at->T, gg_measure_curve_unit(m, "temperature"),
         wall->accommodation > 0},
        {GG_GAP_HEAT, "wall_q_y", wall->side * m->stress_unit * at->heat, gg_common_quantity_unit(GG_Q_WALL_HEAT_FLUX, m),
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

static void put(const gg_gap_flow *flow, gg_gap_profile p, gg_curves *list)
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
    double value[GG_GAP_PROFILES];
    c->x[i] = ((double)i + 0.5) * m->box[1] / slabs;
    c->value[i] = c->error[i] = NAN;
    if (c->x[i] < g->low || c->x[i] > g->high) continue;
    flow->profiles(flow, c->x[i], value);
    c->value[i] = value[p];
    c->error[i] = fabs(c->value[i]) * flow->solution.residual;
  }
  put_numbers(flow, p, c);
}

typedef struct request {
  unsigned measure;
  gg_curves *list;
} request;

static bool of_spins(int p)
{
  return p == GG_GAP_ROTATIONAL_TEMPERATURE || p == GG_GAP_SPIN || p == GG_GAP_ROTATIONAL_HEAT ||
         p == GG_GAP_COUPLE_STRESS;
}

static void draw(const gg_gap_flow *flow, void *to)
{
  const request *r = to;
  for (int p = 0; p < GG_GAP_PROFILES; p++)
    if (r->measure & table[p].measure && (flow->rough || !of_spins(p))) put(flow, (gg_gap_profile)p, r->list);
}

gg_status gg_theory_gap_curves(const gg_gap_theory *theory, const gg_model *m, unsigned measure, gg_curves *list,
                               gg_error *err)
{
  request r = {measure, list};
  if (!(measure & (GG_MEASURE_PROFILES | GG_MEASURE_FLUXES))) return GG_OK;
  GG_TRY(gg_theory_gap_with_flow(theory, m, draw, &r, err));
  return list->failed ? gg_base_out_of_memory(err) : GG_OK;
}
