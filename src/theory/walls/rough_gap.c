/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "theory/walls/rough_gap.h"

#include <math.h>

#include "theory/answer.h"
#include "theory/walls/rough_wall.h"

static const double tolerance = 1e-6; /* of the residual: balances close to 1e-8 */

typedef struct rough_gap {
  gg_gap *gap;
  gg_rough_fluid *gas;
} rough_gap;

static double temperature(double logarithm)
{
  return exp(fmin(fmax(logarithm, -200), 200));
}

static gg_rough_state state_of(const gg_gap *g, const double v[])
{
  return (gg_rough_state){.P = fmax(v[GG_GAP_P], 1e-9 * g->P),
                          .tau = v[GG_GAP_TAU],
                          .T = temperature(v[GG_GAP_LOG_T]),
                          .theta = temperature(v[GG_ROUGH_LOG_THETA]),
                          .omega = v[GG_ROUGH_OMEGA]};
}

static bool local_at(const gg_gap *g, gg_rough_fluid *gas, const double v[], gg_rough_local *at)
{
  const gg_rough_state s = state_of(g, v);
  return gas->local(gas, &s, at);
}

static double heat_of(const double v[])
{
  return v[GG_GAP_E] - v[GG_GAP_TAU] * v[GG_GAP_U];
}
static double rotational_heat_of(const double v[])
{
  return v[GG_ROUGH_R] - v[GG_ROUGH_M] * v[GG_ROUGH_OMEGA];
}

static void slope(void *self, const double v[], double f[])
{
  const rough_gap *r = self;
  const double *gravity = r->gap->model->gravity, q[2] = {heat_of(v), rotational_heat_of(v)};
  gg_rough_local at;
  if (!local_at(r->gap, r->gas, v, &at)) r->gap->outside = true;
  f[GG_GAP_P] = at.gas.n * gravity[1], f[GG_GAP_TAU] = at.gas.n * gravity[0], f[GG_GAP_N] = at.gas.n;
  f[GG_GAP_U] = at.gas.shear;
  f[GG_GAP_E] = at.gas.n * gravity[0] * v[GG_GAP_U] + at.gain[0];
  f[GG_ROUGH_R] = at.gain[1];
  f[GG_ROUGH_M] = at.torque;
  f[GG_ROUGH_OMEGA] = -v[GG_ROUGH_M] / at.turning;
  const double det = at.heat[0][0] * at.heat[1][1] - at.heat[0][1] * at.heat[1][0];
  f[GG_GAP_LOG_T] = -(at.heat[1][1] * q[0] - at.heat[0][1] * q[1]) / det / temperature(v[GG_GAP_LOG_T]);
  f[GG_ROUGH_LOG_THETA] = -(at.heat[0][0] * q[1] - at.heat[1][0] * q[0]) / det / temperature(v[GG_ROUGH_LOG_THETA]);
}

/* Grains in layers at a wall, per area, lose spin in contacts as those of the gas do: what they keep of the couple that
 * the gas takes from the wall, and the heat that they make of it. */
typedef struct layer {
  double grains, couple, energy[2];
} layer;

static layer layer_of(const gg_rough_local *at, double omega)
{
  const double grains = gg_theory_wall_layer(at->gas.phi), part = grains / at->gas.n, couple = part * at->torque;
  return (layer){grains, couple, {part * at->slides[0], couple * omega + part * at->slides[1]}};
}

static void at_wall(rough_gap *r, const gg_surface *wall, const double v[], double left[5])
{
  gg_gap *g = r->gap;
  gg_rough_local at;
  local_at(g, r->gas, v, &at);
  const double s = wall->side, G = v[GG_GAP_U] - wall->velocity.x, speed = sqrt(g->T);
  const double energy = g->P * speed;
  const layer held = layer_of(&at, v[GG_ROUGH_OMEGA]);
  const gg_rough_arrival in = {.centres = {.gas = &at.gas,
                                           .P = v[GG_GAP_P],
                                           .T = temperature(v[GG_GAP_LOG_T]),
                                           .slip = G,
                                           .shear = s * v[GG_GAP_TAU],
                                           .heat = s * heat_of(v)},
                               .K = r->gas->grain.K,
                               .theta = temperature(v[GG_ROUGH_LOG_THETA]),
                               .omega = v[GG_ROUGH_OMEGA],
                               .couple = s * v[GG_ROUGH_M],
                               .heat = s * rotational_heat_of(v)};
  const gg_rough_takes takes = gg_theory_rough_wall_takes(wall, &in);
  left[0] = s > 0 && !gg_theory_walls_grip(g->model) ? v[GG_GAP_U] / speed : (in.centres.shear - takes.momentum) / g->P;
  left[1] = (in.couple + held.couple - takes.couple) / g->P;
  left[2] = (in.centres.heat + in.centres.shear * G + held.energy[0] - takes.translation) / energy;
  left[3] = (s * v[GG_ROUGH_R] + held.energy[1] - takes.rotation) / energy;
  left[4] = (v[GG_GAP_N] - (s > 0 ? g->grains - held.grains : held.grains)) / g->grains;
}

static void lower(void *self, const double v[], double left[])
{
  rough_gap *r = self;
  at_wall(r, &r->gap->model->surface[0], v, left);
}
static void upper(void *self, const double v[], double left[])
{
  rough_gap *r = self;
  at_wall(r, &r->gap->model->surface[1], v, left);
}

/* theta/T of a uniform gas whose spins exchange energy with translation and with thermal walls. */
static double start_ratio(const gg_gap *g, const gg_rough_fluid *gas)
{
  const gg_model *m = &gas->density.model;
  const double width = g->high - g->low, n = g->grains / width, J = g->P / sqrt(2 * M_PI * g->T);
  gg_lun_state s = {n, m->boltzmann ? 0 : n * M_PI / 6, m->chi[0], gas->grain, 0};
  const double gain = gg_theory_lun_functions_at(s).f5r;
  s.ratio = 1;
  const double fall = gain - gg_theory_lun_functions_at(s).f5r, contacts = width * g->T * sqrt(g->T);
  double brings = contacts * gain, takes = contacts * fall;
  for (int w = 0; w < 2; w++) {
    const gg_surface *wall = &g->model->surface[w];
    brings += 1.5 * J * wall->accommodation * wall->temperature, takes += 1.5 * J * wall->accommodation * g->T;
  }
  return brings / takes;
}

/* From the flow of grains that roll. */
static void start(gg_gap_flow *flow, const gg_rough_fluid *gas)
{
  gg_boundary_solution *s = &flow->solution;
  const double ratio = start_ratio(&flow->gap, gas);
  for (int i = 0; i < s->points; i++) {
    double *v = s->v[i];
    v[GG_ROUGH_LOG_THETA] = v[GG_GAP_LOG_T] + log(ratio);
    v[GG_ROUGH_OMEGA] = flow->gap.model->boltzmann ? 0 : -0.5 * s->f[i][GG_GAP_U];
    v[GG_ROUGH_R] = v[GG_ROUGH_M] = 0;
  }
}

gg_rough_height gg_theory_rough_gap_at(const gg_gap_flow *flow, double y)
{
  const gg_gap *g = &flow->gap;
  double v[GG_ROUGH_FUNCTIONS];
  gg_theory_boundary_at(&flow->solution, GG_ROUGH_FUNCTIONS, y, v, NULL);
  gg_rough_height at = {
      .state = state_of(g, v), .u = v[GG_GAP_U], .heat = {heat_of(v), rotational_heat_of(v)}, .couple = v[GG_ROUGH_M]};
  flow->rough->local(flow->rough, &at.state, &at.local);
  at.density = g->model->boltzmann ? at.local.gas.n : at.local.gas.phi; /* points: n over its mean */
  at.P_xy = at.state.tau - (g->model->boltzmann ? 0 : at.local.torque);
  return at;
}

/* Wall stress and heat, and the share of layers at the wall in the sums. */
static void put_wall(gg_gap_flow *flow, int w)
{
  gg_gap *g = &flow->gap;
  const double *gravity = g->model->gravity;
  const gg_surface *wall = &g->model->surface[w];
  const double *v = flow->solution.v[w ? flow->solution.points - 1 : 0], s = wall->side;
  gg_gap_wall *to = &flow->wall[w];
  gg_rough_local at;
  local_at(g, flow->rough, v, &at);
  const layer held = layer_of(&at, v[GG_ROUGH_OMEGA]);
  const double grains = held.grains, theta = temperature(v[GG_ROUGH_LOG_THETA]), made = held.energy[0] + held.energy[1];
  to->gas = at.gas, to->slip = v[GG_GAP_U] - wall->velocity.x, to->T = temperature(v[GG_GAP_LOG_T]);
  to->P = v[GG_GAP_P] + s * grains * gravity[1], to->tau = v[GG_GAP_TAU] + s * grains * gravity[0];
  to->heat = s * (heat_of(v) + v[GG_ROUGH_R] + to->tau * to->slip) + made;
  flow->loss -= made;
  flow->temperature += grains * to->T, flow->theta += grains * theta;
  flow->work += grains * gravity[0] * v[GG_GAP_U] - s * to->tau * wall->velocity.x;
}

static void add_slice(gg_gap_flow *flow, double y, double part)
{
  const gg_rough_height at = gg_theory_rough_gap_at(flow, y);
  const double grains = part * at.local.gas.n;
  flow->loss -= part * (at.local.gain[0] + at.local.gain[1]);
  flow->work += grains * flow->gap.model->gravity[0] * at.u;
  flow->normal += part * at.state.P, flow->shear += part * at.state.tau;
  flow->temperature += grains * at.state.T, flow->theta += grains * at.state.theta;
}

static void put_sums(gg_gap_flow *flow)
{
  gg_theory_gap_integrate(flow, add_slice);
  for (int w = 0; w < 2; w++) put_wall(flow, w);
  if (flow->gap.model->elastic_grains) flow->loss = 0; /* not its rounding */
  flow->temperature /= flow->gap.grains, flow->theta /= flow->gap.grains;
}

gg_status gg_theory_rough_gap_solve(const gg_model *m, gg_rough_fluid *gas, const char *theory, gg_gap_flow *flow,
                                    gg_error *err)
{
  gg_gap *g = &flow->gap;
  if (!flow->rough) {
    GG_TRY(gg_theory_gap_solve(m, (gg_gap_gas){gg_theory_rough_fluid_rolling, gas}, theory, flow, err));
    start(flow, gas);
  }
  rough_gap r = {g, gas};
  const double speed = sqrt(g->T) + fabs(m->surface[1].velocity.x), energy = g->P * speed;
  gg_boundary_problem problem = {.n = GG_ROUGH_FUNCTIONS,
                                 .n_lower = 5,
                                 .tolerance = tolerance,
                                 .self = &r,
                                 .stop = m->stop,
                                 .outside = &g->outside,
                                 .slope = slope,
                                 .lower = lower,
                                 .upper = upper,
                                 .scale = {[GG_GAP_LOG_T] = 1,
                                           [GG_GAP_U] = speed,
                                           [GG_GAP_E] = energy,
                                           [GG_GAP_TAU] = g->P,
                                           [GG_GAP_P] = g->P,
                                           [GG_GAP_N] = g->grains,
                                           [GG_ROUGH_LOG_THETA] = 1,
                                           [GG_ROUGH_OMEGA] = speed,
                                           [GG_ROUGH_R] = energy,
                                           [GG_ROUGH_M] = g->P}};
  gg_error why;
  if (gg_theory_boundary_solve(&problem, &flow->solution, &why) != GG_OK)
    return gg_theory_reject(err, theory, "has no solution here: %s", why.message);
  g->outside = false;
  for (int i = 0; i < flow->solution.points; i++) {
    double f[GG_ROUGH_FUNCTIONS];
    slope(&r, flow->solution.v[i], f);
    g->outside |= !(flow->solution.v[i][GG_GAP_P] > 0);
  }
  if (g->outside) return gg_theory_reject(err, theory, "has no solution here: the gas packs beyond its contact value");
  flow->rough = gas;
  put_sums(flow);
  return GG_OK;
}
