/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "theory/hermite/flux.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "theory/hermite/basis.h"
#include "theory/hermite/product.h"

/* Limit of integration: beyond it the weight is below 1e-31. */
static const double farthest = 12;

/* Rows of the polynomials of a point; points over v. The workspace is 0 beyond the last polynomial from the start. */
enum { N1 = GG_HERMITE_MOST_DEGREE + 1, STRIDE = 32, POINTS = (3 * GG_HERMITE_MOST_DEGREE + 4) / 2 };

/* All points of the rule over v at one u: weights, and polynomials of both grains and of the test by rows of STRIDE. */
typedef struct gg_points {
  double w[POINTS], x1[POINTS * STRIDE], x2[POINTS * STRIDE], test[POINTS * STRIDE];
} gg_points;

static double *lay_out(gg_hermite_flux *f)
{
  int X = gg_padded(f->trials, GG_PRODUCT_ROWS) * f->width_X;
  double **const part[] = {&f->u,    &f->wu,    &f->v, &f->wv, &f->Z,       &f->X,
                           &f->loss, &f->along, &f->Y, &f->W,  &f->columns, &f->points};
  const int size[] = {f->n_u,
                      f->n_u,
                      f->n_v,
                      f->n_v,
                      f->width_Y,
                      f->n_u * f->trials * f->width_X + X, /* rows are written in fours */
                      X,
                      f->n_u * f->width_along,
                      f->n_u * f->width_Y,
                      f->width_along * f->width_Y,
                      f->n_v * f->width_X,
                      sizeof(gg_points) / sizeof(double)};
  enum { PARTS = sizeof size / sizeof *size };
  size_t total = 0;
  for (int i = 0; i < PARTS; i++) total += (size_t)size[i];
  double *workspace = calloc(total, sizeof *workspace), *at = workspace;
  for (int i = 0; workspace && i < PARTS; at += size[i++]) *part[i] = at;
  return workspace;
}

gg_status gg_hermite_flux_make(gg_hermite_flux *f, int N, int tests, double decay, gg_error *err)
{
  *f = (gg_hermite_flux){
      .tests = tests, .trials = N + 1, .halves = N / 2 + 1, .n_u = 24 + N / 2, .n_v = (3 * N + 4) / 2};
  f->odd_X = gg_padded((tests + 1) / 2 * f->halves, GG_PRODUCT_COLUMNS);
  f->width_X = f->odd_X + gg_padded(tests / 2 * f->halves, GG_PRODUCT_COLUMNS);
  f->width_along = gg_padded(tests * f->trials, GG_PRODUCT_ROWS);
  f->width_Y = gg_padded(tests * f->trials, GG_PRODUCT_COLUMNS);
  gg_status status = lay_out(f) ? GG_OK : gg_base_out_of_memory(err);
  if (status == GG_OK) status = gg_hermite_overlap_make(&f->tangential, tests, N + 1, decay, err);
  if (status == GG_OK) status = gg_hermite_legendre_rule(f->n_u, f->u, f->wu, err);
  if (status == GG_OK) status = gg_hermite_rule(f->n_v, f->v, f->wv, err);
  if (status != GG_OK)
    gg_hermite_flux_clear(f);
  else
    gg_hermite_overlap_at(&f->tangential, 0, f->Z);
  return status;
}

void gg_hermite_flux_clear(gg_hermite_flux *f)
{
  gg_hermite_overlap_clear(&f->tangential);
  free(f->u);
  *f = (gg_hermite_flux){0};
}

/* sum_l marginal_l Ho_2l(x) */
static double density_at(const gg_hermite_flux *f, const double *marginal, double x)
{
  double value[N1], sum = 0;
  gg_hermite_values(f->trials - 1, x, value);
  for (int l = 0; l < f->halves; l++) sum += marginal[l] * value[2 * l];
  return sum;
}

/* A grain at one u as its test is evaluated, displaced: x = x1 - shift = other v + at. exp(-v^2/2 - decay x^2/2) is
 * a Gaussian in v again, and the rule is exact. */
typedef struct gg_sight {
  double at, mean, spread, share;
} gg_sight;

static gg_sight sight_of(const gg_hermite_flux *f, const gg_hermite_contact *c, double u, double shift)
{
  double decay = f->tangential.decay, at = c->own * u - shift, all = 1 + decay * c->other * c->other;
  return (gg_sight){at, -decay * c->other * at / all, 1 / sqrt(all), exp(-decay * at * at / (2 * all)) / sqrt(all)};
}

static void see(const gg_hermite_flux *f, const gg_hermite_contact *c, double u, double shift, double amount,
                gg_points *p)
{
  gg_sight s = sight_of(f, c, u, shift);
  double one[POINTS], two[POINTS], seen[POINTS];
  for (int k = 0; k < f->n_v; k++) {
    double v = s.mean + s.spread * f->v[k];
    p->w[k] = amount * s.share * f->wv[k];
    one[k] = c->own * u + c->other * v;
    two[k] = c->own * v - c->other * u;
    seen[k] = c->other * v + s.at;
  }
  gg_hermite_values_of(f->trials - 1, f->n_v, one, p->x1, STRIDE);
  gg_hermite_values_of(f->trials - 1, f->n_v, two, p->x2, STRIDE);
  gg_hermite_values_of(f->tests - 1, f->n_v, seen, p->test, STRIDE);
}

/* For one u: < psi_J(x) Ho_j(x1) Ho_2l(x2) > over v, times `amount`, added to the rows j of `to`, columns (J,l). */
static void add_normal(const gg_hermite_flux *f, const gg_hermite_contact *c, double u, double shift, double amount,
                       double *to)
{
  gg_points *p = (gg_points *)(void *)f->points;
  double *column = f->columns;
  see(f, c, u, shift, amount, p);
  for (int k = 0; k < f->n_v; k++) {
    double *row = column + k * f->width_X;
    for (int J = 0; J < f->tests; J++) {
      double factor = p->w[k] * p->test[k * STRIDE + J], *at = row + gg_hermite_X_column(f, J);
      for (int l = 0; l < f->halves; l++) at[l] = factor * p->x2[k * STRIDE + 2 * l];
    }
  }
  gg_hermite_product_add(gg_padded(f->trials, GG_PRODUCT_ROWS), f->width_X, f->n_v, p->x1, STRIDE, column, f->width_X,
                         to, f->width_X);
}

/* The same with the partner contracted, by (J,j). */
static void add_contracted(const gg_hermite_flux *f, const gg_hermite_contact *c, double u, double shift, double amount,
                           const double *marginal, double *to)
{
  gg_points *p = (gg_points *)(void *)f->points;
  double sum[STRIDE * STRIDE];
  const int rows = gg_padded(f->tests, GG_PRODUCT_ROWS);
  memset(sum, 0, (size_t)(rows * STRIDE) * sizeof *sum);
  see(f, c, u, shift, amount, p);
  for (int k = 0; k < f->n_v; k++) {
    double density = 0;
    for (int l = 0; l < f->halves; l++) density += marginal[l] * p->x2[k * STRIDE + 2 * l];
    for (int J = 0; J < f->tests; J++) p->test[k * STRIDE + J] *= p->w[k] * density;
  }
  gg_hermite_product_add(rows, gg_padded(f->trials, GG_PRODUCT_COLUMNS), f->n_v, p->test, STRIDE, p->x1, STRIDE, sum,
                         STRIDE);
  for (int J = 0; J < f->tests; J++)
    for (int j = 0; j < f->trials; j++) to[J * f->trials + j] += sum[J * STRIDE + j];
}

/* By (J,j): the partner contracted with its distribution. */
static void contract(const gg_hermite_flux *f, const double *X, const double *marginal, double *along)
{
  for (int J = 0; J < f->tests; J++)
    for (int j = 0; j < f->trials; j++) {
      const double *row = X + j * f->width_X + gg_hermite_X_column(f, J);
      double sum = 0;
      for (int l = 0; l < f->halves; l++) sum += row[l] * marginal[l];
      along[J * f->trials + j] = sum;
    }
}

/* Point i of the rule on (u0, farthest): u, and its weight with the Gaussian's and the frequency. */
static double point(const gg_hermite_flux *f, const gg_hermite_contact *c, int i, double *u)
{
  double from = fmax(c->u0, -farthest), width = fmax(farthest - from, 0);
  *u = from + width * f->u[i];
  return c->frequency * width * f->wu[i] * exp(-*u * *u / 2) / sqrt(2 * M_PI);
}

void gg_hermite_flux_begin(gg_hermite_flux *f)
{
  memset(f->W, 0, (size_t)f->width_along * (size_t)f->width_Y * sizeof *f->W);
}

/* W from `along` and Y, less the loss. */
static void combine(gg_hermite_flux *f, const double *loss)
{
  for (int row = 0; row < f->width_along; row += GG_PRODUCT_ROWS) {
    int P = f->tests - row / f->trials; /* J + P is at most N */
    gg_hermite_product_add(GG_PRODUCT_ROWS, gg_padded(P * f->trials, GG_PRODUCT_COLUMNS), f->n_u, f->along + row,
                           f->width_along, f->Y, f->width_Y, f->W + row * f->width_Y, f->width_Y);
  }
  for (int row = 0; row < f->tests * f->trials; row++)
    for (int k = 0; k < f->width_Y; k++) f->W[row * f->width_Y + k] -= loss[row] * f->Z[k];
}

void gg_hermite_flux_add(gg_hermite_flux *f, const gg_hermite_contact *c, const double *marginal, bool partner)
{
  double loss[N1 * N1] = {0}, u;
  size_t slice = (size_t)f->trials * (size_t)f->width_X;
  memset(f->along, 0, (size_t)(f->n_u * f->width_along) * sizeof *f->along);
  if (partner) memset(f->X, 0, (size_t)f->n_u * slice * sizeof *f->X), memset(f->loss, 0, slice * sizeof *f->loss);
  for (int i = 0; i < f->n_u; i++) {
    double w = point(f, c, i, &u), g = c->S * (u - c->u0), *along = f->along + i * f->width_along;
    if (partner) {
      add_normal(f, c, u, c->eta * g * c->b0, g * w, f->X + (size_t)i * slice);
      add_normal(f, c, u, 0, g * w, f->loss);
      contract(f, f->X + (size_t)i * slice, marginal, along);
    } else {
      add_contracted(f, c, u, c->eta * g * c->b0, g * w, marginal, along);
      add_contracted(f, c, u, 0, g * w, marginal, loss);
    }
    gg_hermite_overlap_at(&f->tangential, -c->eta * g * c->b1, f->Y + i * f->width_Y);
  }
  if (partner) contract(f, f->loss, marginal, loss);
  combine(f, loss);
}

void gg_hermite_flux_powers(const gg_hermite_flux *f, const gg_hermite_contact *c, const double *own,
                            const double *other, double power[4])
{
  memset(power, 0, 4 * sizeof *power);
  for (int i = 0; i < f->n_u; i++) {
    double u, w = point(f, c, i, &u), g = c->S * (u - c->u0), both = 0;
    for (int k = 0; k < f->n_v; k++)
      both += f->wv[k] * density_at(f, own, c->own * u + c->other * f->v[k]) *
              density_at(f, other, c->own * f->v[k] - c->other * u);
    for (int p = 0; p < 4; p++, w *= g) power[p] += w * both;
  }
}
