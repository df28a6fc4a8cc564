/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "theory/hermite/viscosity.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "theory/hermite/direction_workspace.h"
#include "theory/linear_solve.h"

/* Shear rate of the central difference, in units in which T = m = 1. */
static const double small = 1e-3;

/* `all` coefficients, of one species after another. */
typedef struct gg_response {
  gg_hermite_operator op;
  const gg_hermite_gas *gas;
  gg_hermite_state *base, state[GG_MAX_SPECIES]; /* f0; and with the response, in `a` */
  bool transfer;
  int all, n, *function; /* those odd in x and in y */
  double *R, *other, *jacobian, *a;
} gg_response;

static gg_status make(gg_response *r, int degree, gg_error *err)
{
  GG_TRY(gg_hermite_operator_make(&r->op, degree, GG_HERMITE_DECAY, false, err));
  GG_TRY(gg_hermite_operator_hold(&r->op, r->gas->n_species, err));
  const gg_hermite_basis *b = &r->op.basis;
  r->all = r->gas->n_species * b->n;
  size_t n = (size_t)r->all;
  r->function = malloc(n * sizeof *r->function);
  r->R = calloc(n * n + 3 * n, sizeof *r->R);
  if (!r->function || !r->R) return gg_base_out_of_memory(err);
  r->other = r->R + n, r->a = r->other + n, r->jacobian = r->a + n;
  for (int i = 0; i < r->gas->n_species; i++) {
    r->state[i] = r->base[i];
    r->state[i].a = r->a + i * b->n;
  }
  for (int i = 0; i < r->all; i++)
    if (b->function[i % b->n].r[0] % 2) r->function[r->n++] = i;
  return GG_OK;
}

static void clear(gg_response *r)
{
  gg_hermite_operator_clear(&r->op);
  free(r->function);
  free(r->R);
}

static gg_hermite_gas sheared(const gg_response *r, double rate)
{
  gg_hermite_gas gas = *r->gas;
  gas.stream[0][1] = rate;
  for (int i = 0; i < gas.n_species; i++)
    for (int j = 0; j < gas.n_species; j++) gas.impact[i][j].shear = r->transfer ? rate * gas.impact[i][j].sigma : 0;
  return gas;
}

/* The source term of the shear: half the difference of R at the two signs of the shear rate, over the shear rate. */
static bool source(gg_response *r)
{
  for (int sign = -1; sign <= 1; sign += 2) {
    gg_hermite_gas gas = sheared(r, sign * small);
    if (!gg_hermite_operator_at(&r->op, &gas, r->base, sign < 0 ? r->other : r->R, NULL)) return false;
  }
  for (int i = 0; i < r->all; i++) r->R[i] = (r->R[i] - r->other[i]) / (2 * small);
  return true;
}

/* d<psi_r>/dt of f1 itself as it decays: sum_s < psi_r Ho_s > a_s. */
static double overlap(const gg_response *r, int i, int j)
{
  const gg_hermite_basis *b = &r->op.basis;
  if (i / b->n != j / b->n) return 0;
  return gg_hermite_test_overlap(&r->op, i % b->n, j % b->n);
}

/* (J - fading) f1 = -source */
static bool solve(gg_response *r, double fading)
{
  const size_t n = (size_t)r->n;
  double *J = gg_theory_linear_new(n), *x = J ? J + n * n : NULL;
  for (size_t i = 0; J && i < n; i++) {
    x[i] = -r->R[r->function[i]];
    for (size_t j = 0; j < n; j++) {
      int row = r->function[i], column = r->function[j];
      double value = r->jacobian[(size_t)row * (size_t)r->all + (size_t)column];
      J[i * n + j] = value - fading * overlap(r, row, column);
    }
  }
  const bool solved = J && gg_theory_linear_solve(n, J);
  for (size_t i = 0; solved && i < n; i++) r->R[r->function[i]] = x[i];
  free(J);
  return solved;
}

/* f0 + rate f1, f1 in R. */
static void respond(gg_response *r, double rate)
{
  int n = r->op.basis.n;
  for (int i = 0; i < r->all; i++) r->a[i] = r->base[i / n].a[i % n];
  for (int i = 0; i < r->n; i++) r->a[r->function[i]] = rate * r->R[r->function[i]];
}

/* Collisional transfer of momentum, by the same difference: f0 and the flow between centres both change sign. */
static double transfer(gg_response *r)
{
  gg_hermite_sums sums[2];
  if (!r->transfer) return 0;
  for (int k = 0; k < 2; k++) {
    double rate = k ? small : -small;
    gg_hermite_gas gas = sheared(r, rate);
    respond(r, rate);
    gg_hermite_sums_at(&r->op, &gas, r->state, &sums[k]);
  }
  return (sums[1].transfer[0][1] - sums[0].transfer[0][1]) / (2 * small);
}

static double kinetic(const gg_response *r)
{
  const gg_hermite_basis *b = &r->op.basis;
  double sum = 0;
  for (int i = 0; i < r->gas->n_species; i++) {
    double(*L)[3] = r->base[i].L, xy = r->R[i * b->n + gg_hermite_place(b, 1, 1, 0)];
    sum -= r->gas->fraction[i] * r->gas->mass[i] * xy * L[0][0] * L[1][1];
  }
  return sum;
}

gg_status gg_hermite_viscosity_of(const gg_hermite_gas *gas, gg_hermite_state *state, int degree, bool transfers,
                                  double fading, gg_hermite_viscosity *v, gg_error *err)
{
  gg_response r = {.gas = gas, .base = state, .transfer = transfers};
  gg_status status = make(&r, degree, err);
  if (status == GG_OK) {
    gg_base_gsl_enter();
    const bool whole = gg_hermite_operator_at(&r.op, gas, state, r.other, r.jacobian) && source(&r);
    if (!whole || !solve(&r, fading)) status = gg_base_fail(err, GG_FAILED, "no linear response was found");
    gg_base_gsl_leave();
  }
  if (status == GG_OK) v->kinetic = kinetic(&r), v->total = v->kinetic - transfer(&r);
  clear(&r);
  return status;
}
