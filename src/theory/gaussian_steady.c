/* The steady state of uniform shear for anisotropic Gaussians: zero of the production terms of gaussian_moments.c plus
 * streaming. The unknowns are M = L L^T and Theta = L L^T by the logarithms of the diagonal of L, so that every trial
 * state is a distribution; and the mean spins, which vanish in the Boltzmann limit. */
#include <gsl/gsl_errno.h>
#include <gsl/gsl_multiroots.h>
#include <math.h>

#include "theory/answer.h"
#include "theory/gaussian_moments.h"
#include "theory/lun1991.h"

enum { PER_TENSOR = 4, MAX_STEPS = 200, MAX_ATTEMPTS = 4, RELAXATION_STEPS = 100 };

/* Residual aimed at; step of relaxation, in the same times. */
static const double converged = 1e-13, relaxation_step = 0.3;

typedef struct closure {
  const gg_model *model;
  double T; /* scale of the temperature, from the starting guess */
} closure;

static gg_tensor unpack_tensor(const gsl_vector *x, size_t at, double scale)
{
  double lx = exp(gsl_vector_get(x, at)), ly = exp(gsl_vector_get(x, at + 1)), lz = exp(gsl_vector_get(x, at + 3));
  double off = gsl_vector_get(x, at + 2) * ly, xy = scale * lx * off;
  return (gg_tensor){{{scale * lx * lx, xy, 0}, {xy, scale * (off * off + ly * ly), 0}, {0, 0, scale * lz * lz}}};
}

static void pack_tensor(gg_tensor A, double scale, gsl_vector *x, size_t at)
{
  double xx = A.at[0][0] / scale, xy = A.at[0][1] / scale, zz = A.at[2][2] / scale;
  double ly2 = A.at[1][1] / scale - xy * xy / xx;
  gsl_vector_set(x, at, 0.5 * log(xx));
  gsl_vector_set(x, at + 1, 0.5 * log(ly2));
  gsl_vector_set(x, at + 2, xy / sqrt(xx * ly2));
  gsl_vector_set(x, at + 3, 0.5 * log(zz));
}

static void unpack(const closure *c, const gsl_vector *x, gg_gaussian *state)
{
  size_t at = 0;
  for (int i = 0; i < c->model->n_species; i++) {
    double scale = c->T / c->model->mass[i];
    state[i] = (gg_gaussian){.M = unpack_tensor(x, at, scale)};
    at += PER_TENSOR;
    if (!gg_species_spins(c->model, i)) continue;
    state[i].Theta = unpack_tensor(x, at, scale);
    at += PER_TENSOR;
    if (!c->model->boltzmann) state[i].spin = gsl_vector_get(x, at++) * c->model->diameter[i] / 2;
  }
}

static void pack(const closure *c, const gg_gaussian *state, gsl_vector *x)
{
  size_t at = 0;
  for (int i = 0; i < c->model->n_species; i++) {
    double scale = c->T / c->model->mass[i];
    pack_tensor(state[i].M, scale, x, at);
    at += PER_TENSOR;
    if (!gg_species_spins(c->model, i)) continue;
    pack_tensor(state[i].Theta, scale, x, at);
    at += PER_TENSOR;
    if (!c->model->boltzmann) gsl_vector_set(x, at++, state[i].spin * 2 / c->model->diameter[i]);
  }
}

/* Share of the spin that a collision can change, by the pair with most grip: weakly rough grains exchange little, and
 * their equations are counted in that measure. */
static double grip_of(const gg_model *m, int i)
{
  double grip = 0;
  for (int j = 0; j < m->n_species; j++) grip = fmax(grip, m->contact[i][j].jt * m->contact[i][j].ik1);
  return grip;
}

static void scale_tensor(gg_tensor *A, double factor)
{
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++) A->at[i][j] *= factor;
}

/* d/dt of all moments, streaming included, per mean free time or shear time, whichever is shorter (of spins: per time
 * in which collisions change them). */
static void production(const gg_model *m, const gg_gaussian *state, gg_gaussian change[GG_MAX_SPECIES])
{
  gg_gaussian_rates r;
  gg_gaussian_rates_at(m, state, &r);
  for (int i = 0; i < m->n_species; i++) {
    double xy = state[i].M.at[0][1], yy = state[i].M.at[1][1];
    change[i] = r.change[i];
    change[i].M.at[0][0] -= 2 * m->shear_rate * xy;
    change[i].M.at[0][1] -= m->shear_rate * yy;
    change[i].M.at[1][0] -= m->shear_rate * yy;
    double time = 1 / (r.frequency[i] + 3 * m->shear_rate);
    scale_tensor(&change[i].M, time);
    if (!gg_species_spins(m, i)) continue;
    time /= grip_of(m, i);
    scale_tensor(&change[i].Theta, time);
    change[i].spin *= time;
  }
}

/* Trace and deviations apart: energy is the slow equation. */
static void put_tensor(gg_tensor A, double unit, gsl_vector *f, size_t at)
{
  gsl_vector_set(f, at, gg_trace(A) / unit);
  gsl_vector_set(f, at + 1, (A.at[1][1] - A.at[0][0]) / unit);
  gsl_vector_set(f, at + 2, (A.at[2][2] - A.at[0][0]) / unit);
  gsl_vector_set(f, at + 3, A.at[0][1] / unit);
}

/* The moment equations, in units of T, theta and the spin of rolling. */
static int residual(const gsl_vector *x, void *params, gsl_vector *f)
{
  const closure *c = params;
  gg_gaussian state[GG_MAX_SPECIES], change[GG_MAX_SPECIES];
  unpack(c, x, state);
  production(c->model, state, change);
  size_t at = 0;
  for (int i = 0; i < c->model->n_species; i++) {
    put_tensor(change[i].M, gg_trace(state[i].M) / 3, f, at);
    at += PER_TENSOR;
    if (!gg_species_spins(c->model, i)) continue;
    put_tensor(change[i].Theta, gg_trace(state[i].Theta) / 3, f, at);
    at += PER_TENSOR;
    if (!c->model->boltzmann) gsl_vector_set(f, at++, change[i].spin * 2 / c->model->diameter[i]);
  }
  for (size_t i = 0; i < f->size; i++)
    if (!isfinite(gsl_vector_get(f, i))) return GSL_EBADFUNC;
  return GSL_SUCCESS;
}

/* Isotropic Gaussians at the temperature that Lun's theory gives grains of species 1, with his spins. */
static void start(closure *c, gsl_vector *x)
{
  const gg_model *m = c->model;
  gg_grain grain = gg_grain_of(m);
  double ratio = gg_lun_ratio(grain);
  gg_lun_functions lun = gg_lun_functions_at((gg_lun_state){m->density, m->phi, m->chi[0], grain, ratio});
  c->T = lun.f2 / lun.f5;
  double mass = 0;
  for (int i = 0; i < m->n_species; i++) mass += gg_fraction(m, i) * m->mass[i];
  c->T *= mass;
  if (!(c->T > 0 && isfinite(c->T))) c->T = m->temperature0;
  gg_gaussian state[GG_MAX_SPECIES];
  for (int i = 0; i < m->n_species; i++) {
    double T = c->T / m->mass[i], theta = T * fmax(ratio, 1e-6) / m->inertia[i];
    state[i].M = (gg_tensor){{{T, 0, 0}, {0, T, 0}, {0, 0, T}}};
    state[i].Theta = (gg_tensor){{{theta, 0, 0}, {0, theta, 0}, {0, 0, theta}}};
    state[i].spin = m->boltzmann ? 0 : -m->shear_rate * m->diameter[i] / 4;
  }
  pack(c, state, x);
}

/* Let the moments relax, as they would in the gas. */
static void relax(const closure *c, gsl_vector *x, int steps)
{
  gg_gaussian state[GG_MAX_SPECIES], change[GG_MAX_SPECIES];
  unpack(c, x, state);
  for (int step = 0; step < steps; step++) {
    production(c->model, state, change);
    for (int i = 0; i < c->model->n_species; i++) {
      for (int a = 0; a < 9; a++) {
        state[i].M.at[a / 3][a % 3] += relaxation_step * change[i].M.at[a / 3][a % 3];
        state[i].Theta.at[a / 3][a % 3] += relaxation_step * change[i].Theta.at[a / 3][a % 3];
      }
      state[i].spin += relaxation_step * change[i].spin;
    }
  }
  pack(c, state, x);
}

static double largest(const gsl_vector *f)
{
  double most = 0;
  for (size_t i = 0; i < f->size; i++) most = fmax(most, fabs(gsl_vector_get(f, i)));
  return most;
}

/* Powell's method from x to where it converges or stalls; the residual left. */
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

static size_t unknowns(const gg_model *m)
{
  size_t n = 0, mean_spin = m->boltzmann ? 0 : 1;
  for (int i = 0; i < m->n_species; i++) n += PER_TENSOR + (gg_species_spins(m, i) ? PER_TENSOR + mean_spin : 0);
  return n;
}

double gg_gaussian_steady(const gg_model *model, gg_gaussian *state)
{
  closure c = {.model = model};
  size_t size = unknowns(model);
  gsl_multiroot_function f = {residual, size, &c};
  gsl_multiroot_fsolver *solver = gsl_multiroot_fsolver_alloc(gsl_multiroot_fsolver_hybrids, size);
  gsl_vector *x = gsl_vector_alloc(size);
  double left = NAN;
  if (solver && x) {
    start(&c, x);
    left = improve(solver, &f, x);
    /* A stall close by is a stale Jacobian: go on from there. Far away the start was too far off: relax first. */
    for (int attempt = 1; attempt <= MAX_ATTEMPTS && !(left < converged); attempt++) {
      if (!(left < 1e-3)) start(&c, x), relax(&c, x, attempt * RELAXATION_STEPS);
      left = improve(solver, &f, x);
    }
    unpack(&c, x, state);
  }
  if (x) gsl_vector_free(x);
  if (solver) gsl_multiroot_fsolver_free(solver);
  return left;
}
