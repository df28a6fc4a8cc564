/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The steady state of uniform shear for anisotropic Gaussians: zero of the production terms of gaussian_moments.c
 * plus streaming. The unknowns are M = L L^T and Theta = L L^T by the logarithms of the diagonal of L, so that every
 * trial state is a distribution; and the mean spins, unless they are negligible beside thermal ones. The solver
 * differentiates with steps proportional to an unknown: each unknown is shifted by 1, so that none is near 0. */
#include <gsl/gsl_errno.h>
#include <gsl/gsl_multiroots.h>
#include <math.h>
#include <string.h>

#include "theory/answer.h"
#include "theory/gaussian_moments.h"
#include "theory/lun1991.h"
#include "theory/relaxation.h"
#include "theory/two_maxwellian.h"

enum { PER_TENSOR = 4, MAX_STEPS = 200, MAX_ATTEMPTS = 4, RELAXATION_STEPS = 100 };

/* Target of the residual; a residual that is close to it; step of relaxation, in the same times. */
static const double converged = 1e-13, nearby = 1e-5, relaxation_step = 0.3;

/* Distance in ln T within which a steady state counts as the one that a gas in a bath reaches. Processor time for
 * following the gas. */
static const double near_by = 0.1, seconds_to_follow = 0.3;

/* Weight of relative residuals, of the balance of energy and of shear stresses. Nearly elastic grains are sheared
 * slowly: with s the ratio of the shear rate to the collision rate these equations are, in units of T, of order s^2
 * and s. */
static const double relative = 1e-3;

/* Thermal speed, in units of the shear rate times the diameter, above which the effect of mean spins on collisions
 * is lost in rounding: the mean spins stay those of rolling. (0 in the Boltzmann limit, where the thermal speed is
 * infinite, for independent velocities and spins; see GG_ROLLING_PHI.) */
static const double fast = 1e8;

typedef struct closure {
  const gg_model *model;
  double T, ratio, shear; /* of the start: temperature, theta/T, -P_xy/p */
  int most;               /* most numerous species: its equation of energy is replaced by that of all */
  bool turns;             /* mean spins are unknowns */
  double off_unit;        /* unit of off-diagonal elements: between their size and 1 */
  double spin_unit;       /* unit of mean spins relative to rolling: between rolling and thermal spins */
} closure;

static double unknown(const gsl_vector *x, size_t at)
{
  return gsl_vector_get(x, at) - 1;
}

static void set_unknown(gsl_vector *x, size_t at, double value)
{
  gsl_vector_set(x, at, 1 + value);
}

static gg_tensor unpack_tensor(const closure *c, const gsl_vector *x, size_t at, double scale)
{
  double lx = exp(unknown(x, at)), ly = exp(unknown(x, at + 1)), lz = exp(unknown(x, at + 3));
  double off = c->off_unit * unknown(x, at + 2) * ly, xy = scale * lx * off;
  return (gg_tensor){{{scale * lx * lx, xy, 0}, {xy, scale * (off * off + ly * ly), 0}, {0, 0, scale * lz * lz}}};
}

static void pack_tensor(const closure *c, gg_tensor A, double scale, gsl_vector *x, size_t at)
{
  double xx = A.at[0][0] / scale, xy = A.at[0][1] / scale, zz = A.at[2][2] / scale;
  double ly2 = A.at[1][1] / scale - xy * xy / xx;
  set_unknown(x, at, 0.5 * log(xx));
  set_unknown(x, at + 1, 0.5 * log(ly2));
  set_unknown(x, at + 2, xy / sqrt(xx * ly2) / c->off_unit);
  set_unknown(x, at + 3, 0.5 * log(zz));
}

/* Mean spin of grains that roll with the flow: a unit, also in the Boltzmann limit. */
static double rolling(const gg_model *m, int i)
{
  return -m->shear_rate * m->diameter[i] / 4;
}

static void unpack(const closure *c, const gsl_vector *x, gg_gaussian *state)
{
  size_t at = 0;
  for (int i = 0; i < c->model->n_species; i++) {
    double scale = c->T / c->model->mass[i];
    state[i] = (gg_gaussian){.M = unpack_tensor(c, x, at, scale)};
    at += PER_TENSOR;
    if (!gg_theory_species_spins(c->model, i)) continue;
    state[i].Theta = unpack_tensor(c, x, at, scale);
    at += PER_TENSOR;
    if (!c->model->boltzmann) state[i].spin = rolling(c->model, i);
    if (c->turns) state[i].spin += unknown(x, at++) * c->spin_unit;
  }
}

static void pack(const closure *c, const gg_gaussian *state, gsl_vector *x)
{
  size_t at = 0;
  for (int i = 0; i < c->model->n_species; i++) {
    double scale = c->T / c->model->mass[i];
    pack_tensor(c, state[i].M, scale, x, at);
    at += PER_TENSOR;
    if (!gg_theory_species_spins(c->model, i)) continue;
    pack_tensor(c, state[i].Theta, scale, x, at);
    at += PER_TENSOR;
    if (c->turns) set_unknown(x, at++, (state[i].spin - rolling(c->model, i)) / c->spin_unit);
  }
}

/* Fraction of the spin that a collision can change, for the pair with the strongest coupling: the equations of
 * weakly rough grains, which exchange little, have this unit. */
static double grip_of(const gg_model *m, int i)
{
  double grip = 0;
  for (int j = 0; j < m->n_species; j++) {
    const gg_contact *c = &m->contact[i][j];
    grip = fmax(grip, fmin(c->jt, c->mu * c->jn) * c->ik1);
  }
  return grip;
}

static void scale_tensor(gg_tensor *A, double factor)
{
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++) A->at[i][j] *= factor;
}

/* Mean free time, shear time or time of the bath: the shortest. */
static double time_of(const gg_model *m, const gg_gaussian_rates *r, int i)
{
  return 1 / (r->frequency[i] + 3 * m->shear_rate + fabs(m->bath.drag[i]) + m->bath.spin_drag[i]);
}

/* d/dt of all moments, streaming included, per that time (spins: per time in which collisions change them); the
 * excess of the work of shear over the loss, relative to the loss; and for each species the shear in that time. */
typedef struct gg_production {
  gg_gaussian change[GG_MAX_SPECIES];
  double excess, shear[GG_MAX_SPECIES];
} gg_production;

static void production(const gg_model *m, const gg_gaussian *state, gg_production *p)
{
  gg_gaussian_rates r;
  gg_gaussian *change = p->change;
  double flow[2];
  gg_theory_gaussian_changes_at(m, state, &r, flow);
  double stress = r.Pc.at[1][0];
  for (int i = 0; i < m->n_species; i++) {
    change[i] = r.change[i];
    stress += m->density * gg_theory_fraction(m, i) * m->mass[i] * state[i].M.at[0][1];
    double time = time_of(m, &r, i);
    p->shear[i] = 3 * m->shear_rate * time;
    scale_tensor(&change[i].M, time);
    if (!gg_theory_species_spins(m, i)) continue;
    time /= grip_of(m, i);
    scale_tensor(&change[i].Theta, time);
    change[i].spin *= time;
  }
  p->excess = (flow[0] - m->shear_rate * stress) / (flow[1] + r.loss) - 1;
}

/* Trace and deviations separately: energy has the slow equation. `shear`: drives the last component. */
static void put_tensor(gg_tensor A, double unit, double shear, gsl_vector *f, size_t at)
{
  gsl_vector_set(f, at, gg_tensor_trace(A) / unit);
  gsl_vector_set(f, at + 1, (A.at[1][1] - A.at[0][0]) / unit);
  gsl_vector_set(f, at + 2, (A.at[2][2] - A.at[0][0]) / unit);
  gsl_vector_set(f, at + 3, relative * A.at[0][1] / (unit * shear));
}

/* The moment equations, in units of T, theta and the spin of rolling. The loss of energy is negligible beside the
 * energy that nearly elastic grains exchange: it comes from one equation for all of them. */
static int residual(const gsl_vector *x, void *params, gsl_vector *f)
{
  const closure *c = params;
  gg_gaussian state[GG_MAX_SPECIES];
  gg_production p;
  if (gg_stop_asked(c->model->stop)) return GSL_EBADFUNC;
  unpack(c, x, state);
  production(c->model, state, &p);
  const gg_gaussian *change = p.change;
  size_t at = 0;
  for (int i = 0; i < c->model->n_species; i++) {
    put_tensor(change[i].M, gg_tensor_trace(state[i].M) / 3, p.shear[i], f, at);
    if (i == c->most) gsl_vector_set(f, at, relative * p.excess);
    at += PER_TENSOR;
    if (!gg_theory_species_spins(c->model, i)) continue;
    put_tensor(change[i].Theta, gg_tensor_trace(state[i].Theta) / 3, p.shear[i], f, at);
    at += PER_TENSOR;
    if (c->turns) gsl_vector_set(f, at++, relative * change[i].spin / rolling(c->model, i));
  }
  for (size_t i = 0; i < f->size; i++)
    if (!isfinite(gsl_vector_get(f, i))) return GSL_EBADFUNC;
  return GSL_SUCCESS;
}

/* Grains of species 1, with friction as the constant beta that exchanges as much. */
static gg_grain grain_of(const gg_model *m, double *ratio)
{
  gg_grain grain = gg_theory_grain_of(m);
  const double mu = m->contact[0][0].mu;
  *ratio = isinf(mu) || grain.eta2 == 0 ? gg_theory_lun_ratio(grain) : gg_theory_ratio_driven(grain, mu);
  if (isfinite(mu)) grain.eta2 = gg_theory_mean_grip(grain, mu, *ratio);
  return grain;
}

/* Scales from Lun's theory of grains of species 1: the work of his shear stress about equals the loss. */
static closure closure_of(const gg_model *m)
{
  closure c = {.model = m};
  double ratio, mass = 0;
  const gg_grain grain = grain_of(m, &ratio);
  gg_lun_functions lun = gg_theory_lun_functions_at((gg_lun_state){m->density, m->phi, m->chi[0], grain, ratio});
  for (int i = 0; i < m->n_species; i++) {
    mass += gg_theory_fraction(m, i) * m->mass[i];
    if (m->fraction[i] > m->fraction[c.most]) c.most = i;
  }
  c.T = mass * lun.f2 / lun.f5;
  if (m->bath.on || !(c.T > 0 && isfinite(c.T))) c.T = m->temperature0;
  double thermal = sqrt(c.T / mass), rate = m->shear_rate * m->diameter[0];
  c.ratio = fmax(ratio, 1e-6);
  c.shear =
      fmin(fabs(lun.f2_kinetic) * m->shear_rate / (m->density * thermal), 0.5); /* < 0 for dense gases of small e */
  c.turns = !m->boltzmann && thermal < fast * rate;
  c.off_unit = sqrt(c.shear);
  c.spin_unit = sqrt(thermal * rate);
  return c;
}

/* Gaussians at that temperature, with that shear stress; spins isotropic, rolling with the flow. */
static void start(const closure *c, gsl_vector *x)
{
  const gg_model *m = c->model;
  gg_gaussian state[GG_MAX_SPECIES];
  for (int i = 0; i < m->n_species; i++) {
    double T = c->T / m->mass[i], xy = -c->shear * T, theta = T * c->ratio / m->inertia[i];
    state[i].M = (gg_tensor){{{T, xy, 0}, {xy, T, 0}, {0, 0, T}}};
    state[i].Theta = (gg_tensor){{{theta, 0, 0}, {0, theta, 0}, {0, 0, theta}}};
    state[i].spin = m->boltzmann ? 0 : rolling(m, i);
  }
  pack(c, state, x);
}

/* Scale all temperatures by a tenth of the excess of the work of shear over the loss. */
static void follow_energy(const gg_model *m, double excess, gg_gaussian state[])
{
  double factor = exp(0.1 * fmin(fmax(log(fmax(1 + excess, 1e-3)), -3), 3));
  for (int i = 0; i < m->n_species; i++) {
    scale_tensor(&state[i].M, factor);
    scale_tensor(&state[i].Theta, factor);
  }
}

/* Let the moments relax as in the gas, but with a faster energy, which would need many collisions. */
static void relax(const closure *c, gsl_vector *x, int steps)
{
  gg_gaussian state[GG_MAX_SPECIES];
  gg_production p;
  const gg_gaussian *change = p.change;
  unpack(c, x, state);
  for (int step = 0; step < steps && !gg_stop_asked(c->model->stop); step++) {
    production(c->model, state, &p);
    if (!isfinite(p.excess)) break;
    for (int i = 0; i < c->model->n_species; i++) {
      for (int a = 0; a < 9; a++) {
        state[i].M.at[a / 3][a % 3] += relaxation_step * change[i].M.at[a / 3][a % 3];
        state[i].Theta.at[a / 3][a % 3] += relaxation_step * change[i].Theta.at[a / 3][a % 3];
      }
      state[i].spin += relaxation_step * change[i].spin;
    }
    follow_energy(c->model, p.excess, state);
  }
  pack(c, state, x);
}

static double largest(const gsl_vector *f)
{
  double most = 0;
  for (size_t i = 0; i < f->size; i++) most = fmax(most, fabs(gsl_vector_get(f, i)));
  return most;
}

/* Powell's method from x until it converges or stalls; returns the remaining residual. */
static double improve(gsl_multiroot_fsolver *solver, gsl_multiroot_function *f, gsl_vector *x)
{
  int status = gsl_multiroot_fsolver_set(solver, f, x);
  if (status != GSL_SUCCESS) return INFINITY;
  for (int step = 0; step < MAX_STEPS && status == GSL_SUCCESS; step++) {
    if (largest(solver->f) < converged) break;
    status = gsl_multiroot_fsolver_iterate(solver);
  }
  gsl_vector_memcpy(x, solver->x);
  return largest(solver->f);
}

static size_t unknowns(const closure *c)
{
  const gg_model *m = c->model;
  size_t n = 0, mean_spin = c->turns ? 1 : 0;
  for (int i = 0; i < m->n_species; i++) n += PER_TENSOR + (gg_theory_species_spins(m, i) ? PER_TENSOR + mean_spin : 0);
  return n;
}

static double temperature_of(const gg_model *m, const gg_gaussian state[])
{
  double T = 0;
  for (int i = 0; i < m->n_species; i++) T += gg_theory_fraction(m, i) * m->mass[i] * gg_tensor_trace(state[i].M) / 3;
  return T;
}

/* The steady state next to the present one, into x; returns its residual. INFINITY if the gas does not approach it:
 * the state is unstable, or another one. */
static double solve_nearby(const closure *c, gsl_multiroot_fsolver *solver, gsl_multiroot_function *f,
                           const gg_gaussian before[], const gg_gaussian now[], gsl_vector *x)
{
  gg_gaussian found[GG_MAX_SPECIES];
  pack(c, now, x);
  const double left = improve(solver, f, x);
  unpack(c, x, found);
  const double T = temperature_of(c->model, found), to_go = fabs(log(T / temperature_of(c->model, now)));
  return to_go < near_by && to_go <= fabs(log(T / temperature_of(c->model, before))) ? left : INFINITY;
}

static double slowest_drag(const gg_model *m)
{
  double drag = INFINITY;
  for (int i = 0; i < m->n_species; i++) drag = fmin(drag, fabs(m->bath.drag[i]));
  return drag;
}

/* Grains of constant beta whose tangential impulses are about those of friction: quick to follow. */
static gg_model without_sliding(const gg_model *m)
{
  gg_model like = *m;
  for (int i = 0; i < m->n_species; i++)
    for (int j = 0; j < m->n_species; j++) {
      gg_contact *c = &like.contact[i][j];
      c->jt = fmin(c->jt, c->mu * c->jn), c->mu = INFINITY;
      like.beta[gg_pair(i, j)] = c->jt * gg_inverse_mt(c) - 1;
    }
  like.rule = GG_ROUGH;
  return like;
}

/* The moments in time from the start of the scene up to a steady state; at first until all but the temperature has
 * forgotten the start. If relaxation is long beside the collision time, the allowed work ends before: then x has a
 * remainder that depends on the energy alone. */
static double follow(const closure *c, gsl_multiroot_fsolver *solver, gsl_multiroot_function *f, gsl_vector *x)
{
  const double forgetting = 10, drag = slowest_drag(c->model);
  gg_relaxing gas = {.work = seconds_to_follow, .stop = c->model->stop};
  double stretch = 1 / c->model->shear_rate, time = 0, left = INFINITY;
  gg_theory_gaussian_start(c->model, gas.of);
  for (; gas.work > 0 && !(left < converged) && !gg_stop_asked(gas.stop); stretch *= 1.5) {
    gg_gaussian before[GG_MAX_SPECIES];
    memcpy(before, gas.of, sizeof before);
    gg_theory_gaussian_relax(c->model, stretch, &gas);
    time += stretch;
    const double change = log(temperature_of(c->model, gas.of) / temperature_of(c->model, before));
    if (fabs(change) < near_by && gas.collisions + 2 * drag * time > forgetting)
      left = solve_nearby(c, solver, f, before, gas.of, x);
  }
  if (!(left < converged)) pack(c, gas.of, x);
  return left;
}

/* The state that a gas in a bath reaches, into x: of several states the right one. With friction the state of the like
 * gas without sliding, from which the equations are solved. */
static double follow_in_bath(closure *c, gsl_multiroot_fsolver *solver, gsl_multiroot_function *f, gsl_vector *x)
{
  const gg_model *m = c->model, like = without_sliding(m);
  if (m->rule != GG_FRICTIONAL) return follow(c, solver, f, x);
  c->model = &like;
  follow(c, solver, f, x);
  c->model = m;
  return INFINITY;
}

double gg_theory_gaussian_steady(const gg_model *model, gg_gaussian *state)
{
  closure c = closure_of(model);
  size_t size = unknowns(&c);
  gsl_multiroot_function f = {residual, size, &c};
  gsl_multiroot_fsolver *solver = gsl_multiroot_fsolver_alloc(gsl_multiroot_fsolver_hybrids, size);
  gsl_vector *x = gsl_vector_alloc(size);
  double left = NAN;
  if (solver && x) {
    start(&c, x);
    left = INFINITY;
    if (model->bath.on) left = follow_in_bath(&c, solver, &f, x);
    if (!(left < converged)) left = improve(solver, &f, x);
    /* A stall close to the solution is a stale Jacobian: continue from there. A stall far away means that the start
     * was too far off: relax first; in a bath also near a state that almost exists, which the gas may leave slowly. */
    for (int attempt = 1; attempt <= MAX_ATTEMPTS && !(left < converged); attempt++) {
      if (model->bath.on)
        relax(&c, x, (model->rule == GG_FRICTIONAL ? 1 : 10) * attempt * RELAXATION_STEPS);
      else if (!(left < nearby))
        start(&c, x), relax(&c, x, attempt * RELAXATION_STEPS);
      left = improve(solver, &f, x);
    }
    unpack(&c, x, state);
  }
  if (x) gsl_vector_free(x);
  if (solver) gsl_multiroot_fsolver_free(solver);
  return left;
}
