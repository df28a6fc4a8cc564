/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "theory/walls/gap.h"

#include <math.h>
#include <stdlib.h>

#include "base/memory.h"
#include "common/contact_value.h"
#include "common/surface/shapes.h"
#include "measure/wall_modes.h"
#include "theory/answer.h"
#include "theory/walls/wall_condition.h"

/* Knudsen number above which no hydrodynamics describes the gap; points of the start; residual, with which balances
 * close to 1e-8. */
static const double most_knudsen = 0.3, tolerance = 1e-6, rounding = 1e-12; /* of the drag, to the pressure */
enum { START_POINTS = 41 };

static double half_diameter(const gg_model *m)
{
  return m->boltzmann ? 0 : 0.5;
}

static double grains_per_area(const gg_model *m)
{
  return m->density * m->box[1];
}

double gg_theory_gap_knudsen(const gg_model *m)
{
  const double width = m->box[1] - 2 * half_diameter(m), n = grains_per_area(m) / width;
  const double chi = m->boltzmann ? 1 : gg_common_contact_value_of(m->contact_value, n * M_PI / 6);
  return 1 / (sqrt(2) * M_PI * n * chi * width);
}

static gg_status check_walls(const gg_model *m, const char *theory, gg_error *err)
{
  if (m->n_surfaces != 2)
    return gg_theory_reject(err, theory, "describes gaps between two walls; this scene has an open top");
  bool grips = false;
  for (int w = 0; w < 2; w++) {
    if (gg_surface_height(&m->surface[w]) > 0)
      return gg_theory_reject(err, theory, "describes flat walls; walls of this scene have ridges");
    grips |= gg_theory_wall_grips(&m->surface[w]);
  }
  if (!grips && m->flow != GG_FOURIER)
    return gg_theory_reject(err, theory,
                            "describes steady flow; walls of this scene (beta_w = -1) take no momentum along x");
  return GG_OK;
}

static gg_status check_rough(const gg_model *m, const char *theory, gg_error *err)
{
  GG_TRY(gg_theory_require_constant_beta(m, theory, err));
  for (int w = 0; w < m->n_surfaces; w++) {
    const gg_contact *c = &m->surface[w].contact[0];
    if (m->surface[w].accommodation < 1 && c->jt > 0 && isfinite(c->mu))
      return gg_theory_reject(err, theory,
                              "describes rough grains between walls of constant beta; walls have friction");
  }
  return GG_OK;
}

gg_status gg_theory_gap_check(const gg_model *m, const char *theory, bool rough, gg_error *err)
{
  GG_TRY(gg_theory_require_one_species(m, theory, err));
  GG_TRY(rough ? check_rough(m, theory, err) : gg_theory_require_smooth(m, theory, err));
  GG_TRY(check_walls(m, theory, err));
  if (m->gravity[2] != 0) return gg_theory_reject(err, theory, "has no gravity along z; this scene has");
  const double mean = grains_per_area(m) / (m->box[1] - 2 * half_diameter(m)) * M_PI / 6;
  const double most = gg_common_contact_value_limit(m->contact_value);
  if (!m->boltzmann && !(mean < most))
    return gg_theory_reject(err, theory, "describes gases up to phi = %g; between these walls centres have %.3g", most,
                            mean);
  const double knudsen = gg_theory_gap_knudsen(m);
  if (knudsen > most_knudsen)
    return gg_theory_reject(err, theory, "describes gaps of many mean free paths, Kn up to %g; here Kn = %.3g",
                            most_knudsen, knudsen);
  return GG_OK;
}

static bool local_at(gg_gap *g, const double v[], gg_gap_local *at)
{
  const double P = fmax(v[GG_GAP_P], 1e-9 * g->P), T = exp(fmin(fmax(v[GG_GAP_LOG_T], -200), 200));
  return g->gas.local(g->gas.self, P, v[GG_GAP_TAU], T, at);
}

static void slope(void *self, const double v[], double f[])
{
  gg_gap *g = self;
  gg_gap_local at;
  if (!local_at(g, v, &at)) g->outside = true;
  const double T = exp(v[GG_GAP_LOG_T]), q = v[GG_GAP_E] - v[GG_GAP_TAU] * v[GG_GAP_U];
  const double *gravity = g->model->gravity;
  f[GG_GAP_P] = at.n * gravity[1], f[GG_GAP_TAU] = at.n * gravity[0], f[GG_GAP_N] = at.n;
  f[GG_GAP_U] = at.shear;
  f[GG_GAP_E] = at.n * gravity[0] * v[GG_GAP_U] - at.loss;
  const double turn = f[GG_GAP_TAU] - v[GG_GAP_TAU] / v[GG_GAP_P] * f[GG_GAP_P];
  const double at_T = at.n_P * f[GG_GAP_P] + at.n_tau * turn; /* dn/dy but for the part of T' */
  f[GG_GAP_LOG_T] = -(q + at.mu * at_T) / ((at.kappa + at.mu * at.n_T) * T);
}

/* The gas that reaches a wall, and what the wall takes from it. */
typedef struct meeting {
  gg_gap_local at;
  gg_arrival in;
  gg_wall_takes takes;
} meeting;

static void meet(gg_gap *g, const gg_surface *wall, const double v[], meeting *to)
{
  local_at(g, v, &to->at);
  const double s = wall->side, q = v[GG_GAP_E] - v[GG_GAP_TAU] * v[GG_GAP_U];
  to->in = (gg_arrival){.gas = &to->at,
                        .P = v[GG_GAP_P],
                        .T = exp(v[GG_GAP_LOG_T]),
                        .slip = v[GG_GAP_U] - wall->velocity.x,
                        .shear = s * v[GG_GAP_TAU],
                        .heat = s * q,
                        .along = to->at.carried_x * q};
  to->takes = gg_theory_wall_takes(wall, &to->in);
}

static void at_wall(gg_gap *g, const gg_surface *wall, const double v[], double left[3])
{
  meeting m;
  meet(g, wall, v, &m);
  const double s = wall->side, layer = m.takes.grains;
  left[0] =
      s > 0 && !gg_theory_walls_grip(g->model) ? v[GG_GAP_U] / sqrt(g->T) : (m.in.shear - m.takes.momentum) / g->P;
  left[1] = (m.in.heat + m.in.shear * m.in.slip - m.takes.energy) / (g->P * sqrt(g->T));
  left[2] = (v[GG_GAP_N] - (s > 0 ? g->grains - layer : layer)) / g->grains;
}

static void lower(void *self, const double v[], double left[])
{
  gg_gap *g = self;
  at_wall(g, &g->model->surface[0], v, left);
}
static void upper(void *self, const double v[], double left[])
{
  gg_gap *g = self;
  at_wall(g, &g->model->surface[1], v, left);
}

/* A uniform gas for the start: pressure, viscosity and loss per volume of the mean density at temperature 1. */
typedef struct uniform {
  const gg_gap *g;
  double n, P, viscosity, loss, width;
} uniform;

static const double start_slip = 0.8; /* velocity of the gas at a wall over that of the wall */

static double shear_of(const uniform *x)
{
  const gg_surface *s = x->g->model->surface;
  return start_slip * (s[1].velocity.x - s[0].velocity.x) / x->width;
}

/* Work of walls and gravity less what collisions and walls take, per area, at temperature exp(log_T). */
static double excess(double log_T, void *self)
{
  const uniform *x = self;
  const gg_model *m = x->g->model;
  const double root = exp(0.5 * log_T), T = root * root, shear = shear_of(x), force = x->n * m->gravity[0];
  double sum = x->viscosity * root * shear * shear * x->width / start_slip - x->loss * T * root * x->width;
  sum += force * force * x->width * x->width * x->width / (12 * x->viscosity * root);
  for (int w = 0; w < 2; w++) {
    const gg_surface *s = &m->surface[w];
    const double e = s->contact[0].jn - 1, beta = s->contact[0].jt - 1, a = s->accommodation;
    const double J = x->P * root / sqrt(2 * M_PI);
    const double takes =
        1 - e * e + (isinf(s->contact[0].mu) || s->contact[0].jt == 0 ? 1 - beta * beta : fmin(1, s->contact[0].mu));
    sum -= J * (2 * a * (T - s->temperature) + (1 - a) * takes * T);
  }
  return sum;
}

static uniform uniform_of(gg_gap *g)
{
  uniform x = {.g = g, .width = g->high - g->low};
  gg_gap_local at;
  double low = 1e-9, high = 1e9;
  x.n = g->grains / x.width;
  for (int k = 0; k < 100; k++) { /* the pressure of this density: n grows with P/T */
    x.P = sqrt(low * high);
    g->gas.local(g->gas.self, x.P, -1e-6 * x.P, 1, &at);
    *(at.n < x.n ? &low : &high) = x.P;
  }
  x.viscosity = 1e-6 * x.P / at.shear, x.loss = at.loss;
  return x;
}

static gg_status start(gg_gap_flow *flow, const char *theory, gg_error *err)
{
  gg_gap *g = &flow->gap;
  gg_boundary_solution *s = &flow->solution;
  const gg_model *m = g->model;
  uniform x = uniform_of(g);
  const double least = -60, most = 60;
  if (excess(least, &x) <= 0)
    return gg_theory_reject(err, theory, "describes a steady state; nothing keeps the grains of this scene warm");
  if (excess(most, &x) >= 0)
    return gg_theory_reject(err, theory, "describes a steady state; nothing takes the heat of this scene away");
  g->T = exp(gg_theory_root_between(excess, &x, least, most)), g->P = x.P * g->T;
  const double shear = shear_of(&x), middle = 0.5 * (g->low + g->high);
  s->points = START_POINTS;
  for (int i = 0; i < s->points; i++) {
    const double y = s->y[i] = g->low + x.width * i / (s->points - 1), height = y - middle;
    double *v = s->v[i];
    v[GG_GAP_LOG_T] = log(g->T), v[GG_GAP_U] = shear * height;
    v[GG_GAP_TAU] = -x.viscosity * sqrt(g->T) * shear + x.n * m->gravity[0] * height;
    v[GG_GAP_P] = g->P * exp(x.n * m->gravity[1] * height / g->P);
    v[GG_GAP_E] = v[GG_GAP_TAU] * v[GG_GAP_U], v[GG_GAP_N] = x.n * (y - g->low);
  }
  return GG_OK;
}

static void put_wall(gg_gap_flow *flow, int w)
{
  gg_gap *g = &flow->gap;
  const double *gravity = g->model->gravity;
  const gg_surface *wall = &g->model->surface[w];
  const double *v = flow->solution.v[w ? flow->solution.points - 1 : 0], s = wall->side;
  meeting m;
  meet(g, wall, v, &m);
  gg_gap_wall *to = &flow->wall[w];
  *to = (gg_gap_wall){.P = m.in.P + s * m.takes.grains * gravity[1],
                      .tau = v[GG_GAP_TAU] + s * m.takes.grains * gravity[0],
                      .slip = m.in.slip,
                      .T = m.in.T,
                      .grains = m.takes.grains,
                      .warmth = m.takes.warmth,
                      .loss = m.takes.loss,
                      .gas = m.at};
  to->heat = m.in.heat + s * to->tau * to->slip - to->loss;
}

void gg_theory_gap_integrate(gg_gap_flow *flow, gg_gap_add *add)
{
  static const double place[] = {-0.774596669241483377, 0, 0.774596669241483377}, weight[] = {5. / 18, 4. / 9, 5. / 18};
  const gg_boundary_solution *s = &flow->solution;
  flow->work = flow->loss = flow->normal = flow->shear = flow->temperature = flow->theta = 0;
  for (int i = 0; i + 1 < s->points; i++)
    for (int k = 0; k < 3; k++) {
      const double h = s->y[i + 1] - s->y[i];
      add(flow, s->y[i] + 0.5 * h * (1 + place[k]), h * weight[k]);
    }
}

static void add_slice(gg_gap_flow *flow, double y, double part)
{
  double v[GG_GAP_FUNCTIONS];
  gg_gap_local at;
  gg_theory_boundary_at(&flow->solution, GG_GAP_FUNCTIONS, y, v, NULL);
  local_at(&flow->gap, v, &at);
  flow->loss += part * at.loss;
  flow->work += part * at.n * flow->gap.model->gravity[0] * v[GG_GAP_U];
  flow->normal += part * v[GG_GAP_P], flow->shear += part * v[GG_GAP_TAU];
  flow->temperature += part * at.n * exp(v[GG_GAP_LOG_T]);
}

static void put_sums(gg_gap_flow *flow)
{
  gg_gap *g = &flow->gap;
  gg_theory_gap_integrate(flow, add_slice);
  for (int w = 0; w < 2; w++) {
    const gg_gap_wall *wall = &flow->wall[w];
    const gg_surface *surface = &g->model->surface[w];
    flow->temperature += wall->warmth, flow->loss += wall->loss;
    flow->work += wall->grains * g->model->gravity[0] * (wall->slip + surface->velocity.x);
    flow->work -= surface->side * wall->tau * surface->velocity.x;
  }
  flow->temperature /= g->grains;
}

static bool is_within(gg_gap *g, const gg_boundary_solution *s)
{
  g->outside = false;
  for (int i = 0; i < s->points; i++) {
    double f[GG_GAP_FUNCTIONS];
    slope(g, s->v[i], f);
    if (!(s->v[i][GG_GAP_P] > 0)) return false;
  }
  return !g->outside;
}

gg_status gg_theory_gap_solve(const gg_model *m, gg_gap_gas gas, const char *theory, gg_gap_flow *flow, gg_error *err)
{
  gg_gap *g = &flow->gap;
  const double edge = half_diameter(m);
  const double T = g->T, P = g->P;
  *g = (gg_gap){.model = m, .gas = gas, .low = edge, .high = m->box[1] - edge, .grains = grains_per_area(m)};
  g->T = T, g->P = P;
  if (flow->solution.points == 0) GG_TRY(start(flow, theory, err));
  const double speed = sqrt(g->T) + fabs(m->surface[1].velocity.x);
  gg_boundary_problem problem = {.n = GG_GAP_FUNCTIONS,
                                 .n_lower = 3,
                                 .tolerance = tolerance,
                                 .self = g,
                                 .stop = m->stop,
                                 .outside = &g->outside,
                                 .slope = slope,
                                 .lower = lower,
                                 .upper = upper,
                                 .scale = {[GG_GAP_LOG_T] = 1,
                                           [GG_GAP_U] = speed,
                                           [GG_GAP_E] = g->P * speed,
                                           [GG_GAP_TAU] = g->P,
                                           [GG_GAP_P] = g->P,
                                           [GG_GAP_N] = g->grains}};
  gg_error why;
  if (gg_theory_boundary_solve(&problem, &flow->solution, &why) != GG_OK)
    return gg_theory_reject(err, theory, "has no solution here: %s", why.message);
  if (!is_within(g, &flow->solution))
    return gg_theory_reject(err, theory, "has no solution here: the gas packs beyond its contact value");
  for (int w = 0; w < 2; w++) put_wall(flow, w);
  put_sums(flow);
  return GG_OK;
}

/* Direction along x of the force of the gas on a wall that counts as friction (measure/rheology.c). */
static double drag_of(const gg_model *m, const gg_surface *wall)
{
  const double ahead = wall->velocity.x != 0 ? -wall->velocity.x : m->gravity[0];
  return ahead > 0 ? 1 : -1;
}

static void put_numbers(const gg_gap_flow *flow, gg_theory_answer *a)
{
  const gg_model *m = flow->gap.model;
  const gg_gap_wall *w = flow->wall;
  const double per_volume = m->stress_unit / m->box[1];
  double drag = 0, push = 0, D_wall = 0;
  for (int k = 0; k < 2; k++) {
    const gg_surface *wall = &m->surface[k];
    drag += drag_of(m, wall) * wall->side * w[k].tau, push += w[k].P, D_wall += w[k].heat;
  }
  gg_theory_gap_remark(flow, gg_theory_gap_knudsen(m), a->remark);
  a->value[GG_Q_TEMPERATURE] = flow->temperature;
  if (flow->rough) {
    a->value[GG_Q_ROTATIONAL_TEMPERATURE] = flow->theta;
    a->value[GG_Q_TEMPERATURE_RATIO] = flow->theta / flow->temperature;
  }
  a->value[GG_Q_P_YY] = per_volume * flow->normal, a->value[GG_Q_P_YX] = per_volume * flow->shear;
  a->value[GG_Q_WALL_FRICTION] = fabs(drag) > rounding * push ? drag / push : 0;
  if (flow->loss > 0) a->value[GG_Q_DISSIPATION] = per_volume * flow->loss;
  a->value[GG_Q_WALL_DISSIPATION] = per_volume * D_wall;
  if (gg_wall_symmetry_of(m) == GG_NO_SYMMETRY)
    a->value[GG_Q_WALL_HEAT_FLUX] = 0.5 * m->stress_unit * (w[1].heat - w[0].heat);
  if (flow->loss > 0)
    a->value[GG_Q_ENERGY_BALANCE] =
        gg_model_has_thermal_walls(m) ? (flow->work - D_wall) / flow->loss : flow->work / (flow->loss + D_wall);
}

gg_status gg_theory_gap_with_flow(const gg_gap_theory *theory, const gg_model *m, gg_gap_use *use, void *to,
                                  gg_error *err)
{
  GG_TRY(gg_theory_gap_check(m, theory->name, theory->rough && m->rule != GG_SMOOTH, err));
  void *gas = gg_base_array_new(1, theory->size, err);
  gg_gap_flow *flow = gg_base_array_new(1, sizeof *flow, err);
  const gg_status status = gas && flow ? theory->flow_of(m, gas, flow, err) : GG_FAILED;
  if (status == GG_OK) use(flow, to);
  free(gas), free(flow);
  return status;
}

typedef struct request {
  gg_theory_answer *answer;
  unsigned measure;
  gg_curves *list;
} request;

static void put(const gg_gap_flow *flow, void *to)
{
  const request *r = to;
  if (r->answer) put_numbers(flow, r->answer);
  if (r->list) gg_theory_gap_profiles(flow, r->measure, r->list);
}

gg_status gg_theory_gap_answer(const gg_gap_theory *theory, const gg_model *m, gg_theory_answer *answer,
                               unsigned measure, gg_curves *list, gg_error *err)
{
  request r = {answer, measure, list};
  if (!answer && !(measure & (GG_MEASURE_PROFILES | GG_MEASURE_FLUXES))) return GG_OK;
  GG_TRY(gg_theory_gap_with_flow(theory, m, put, &r, err));
  return list && list->failed ? gg_base_out_of_memory(err) : GG_OK;
}
