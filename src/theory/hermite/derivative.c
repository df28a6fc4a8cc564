/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The Jacobian of one direction: derivatives of a test with respect to the a_s of the grain itself, and to those of
 * its partner, which enter by the marginal alone. */
#include <string.h>

#include "theory/hermite/direction_workspace.h"

/* K and E for one Q: for each (j,p), W of all (J,P), and sum_q Z_Qq D_jpq,s. Ordered by j + p; upto[d]: number of
 * pairs up to j + p = d, from which functions of degree d are made. */
static void factors_of(const gg_hermite_operator *op, const gg_hermite_view *own, int Q, int tests, int tall,
                       int upto[])
{
  const gg_hermite_basis *b = &op->basis;
  const gg_hermite_workspace *r = op->workspace;
  const gg_hermite_flux *f = &op->flux;
  int depth = 0, from = b->rotated_from[Q];
  for (int m = Q % 2; m <= b->degree; m += 2) {
    for (int j = 0; j <= m; j++, depth++) {
      double *E = r->E + (size_t)depth * (size_t)r->wide, *K = r->K + depth * tall;
      memset(E, 0, (size_t)r->wide * sizeof *E);
      for (int q = Q % 2; q <= b->degree - m; q += 2) {
        const double z = f->Z[Q * f->trials + q];
        const double *D = own->D + (size_t)gg_hermite_rotated_place(b, j, m - j, q) * (size_t)r->wide;
        for (int s = b->from[m + q]; s < b->from[m + q + 1]; s++) E[s] = z * D[s];
      }
      for (int i = 0; i < tall; i++)
        K[i] = i < tests ? gg_hermite_W(f, b->rotated[from + i].r[0], b->rotated[from + i].r[1], j, m - j) : 0;
    }
    upto[m] = upto[m + 1] = depth;
  }
}

/* X = K^T E for the tests of one Q. Rows beyond them belong to the next Q, which overwrites them. */
static void own_derivatives(const gg_hermite_operator *op, const gg_hermite_view *own, int Q)
{
  const gg_hermite_basis *b = &op->basis;
  const gg_hermite_workspace *r = op->workspace;
  int from = b->rotated_from[Q], tests = b->rotated_from[Q + 1] - from, upto[GG_HERMITE_MOST_DEGREE + 2] = {0};
  int tall = gg_padded(tests, GG_PRODUCT_ROWS);
  factors_of(op, own, Q, tests, tall, upto);
  double *X = r->X + (size_t)from * (size_t)r->wide;
  memset(X, 0, (size_t)tall * (size_t)r->wide * sizeof *X);
  for (int s = 0; s < r->wide; s += GG_PRODUCT_COLUMNS) {
    int last = s + GG_PRODUCT_COLUMNS > b->n ? b->n - 1 : s + GG_PRODUCT_COLUMNS - 1;
    int depth = upto[gg_hermite_degree(b->function[last])];
    gg_hermite_product_add(tall, GG_PRODUCT_COLUMNS, depth, r->K, tall, r->E + s, r->wide, X + s, r->wide);
  }
}

/* Rows (P,Q) of V: those of even P + Q first, in its order. */
static int odd_rows(int N)
{
  return gg_padded((N / 2 + 1) * (N / 2 + 1), GG_PRODUCT_ROWS);
}

int gg_hermite_partner_rows(int N)
{
  return odd_rows(N) + gg_padded(N / 2 * (N / 2 + 1), GG_PRODUCT_ROWS);
}

static int row_of(int N, int P, int Q)
{
  int half = (P + Q) / 2;
  return P + ((P + Q) % 2 ? odd_rows(N) + half * (half + 1) : half * half);
}

/* P + Q of the first row of a tile; more than N in the padding. */
static int least_sum(int N, int row)
{
  int odd = row >= odd_rows(N), sum = odd;
  while (row_of(N, sum, 0) < row) sum += 2;
  return sum;
}

/* V[(P,Q)] = sum_p Y[P,p] damped[Q][j,p], for one u and j */
static void along_tangent(const gg_hermite_operator *op, const gg_hermite_view *own, const double *Y, int j,
                          double sign, double *V)
{
  int N = op->basis.degree, trials = op->flux.trials;
  for (int Q = 0; Q <= N; Q++)
    for (int P = 0; P <= N - Q; P++) {
      const double *t = own->damped + Q * op->workspace->box + j * (N + 1);
      double sum = 0;
      for (int p = (j + Q) % 2; p <= N - j; p += 2) sum += Y[P * trials + p] * t[p];
      V[row_of(N, P, Q)] = sign * sum;
    }
}

/* VX += V^T X, for the existing tests: J + P + Q even and up to N. */
static void multiply(const gg_hermite_operator *op, int depth, const double *X)
{
  const gg_hermite_workspace *r = op->workspace;
  const gg_hermite_flux *f = &op->flux;
  for (int row = 0; row < r->pairs; row += GG_PRODUCT_ROWS) {
    int rest = op->basis.degree - least_sum(op->basis.degree, row), from = gg_hermite_X_column(f, rest % 2);
    int columns = gg_padded((rest / 2 + 1) * f->halves, GG_PRODUCT_COLUMNS);
    if (rest >= 0)
      gg_hermite_product_add(GG_PRODUCT_ROWS, columns, depth, r->V + row, r->pairs, X + from, f->width_X,
                             r->VX + row * f->width_X + from, f->width_X);
  }
}

/* S[(J,P,Q),l] = sum_ij V[(i,j),(P,Q)] X[(i,j),(J,l)], minus the same of the loss. */
static void partner_derivatives(const gg_hermite_operator *op, const gg_hermite_view *own)
{
  const gg_hermite_basis *b = &op->basis;
  const gg_hermite_workspace *r = op->workspace;
  const gg_hermite_flux *f = &op->flux;
  int N = b->degree, half = f->halves, rows = f->n_u * (N + 1);
  memset(r->VX, 0, (size_t)(r->pairs * f->width_X) * sizeof *r->VX);
  for (int j = 0; j <= N; j++) along_tangent(op, own, f->Z, j, -1, r->V + (size_t)j * (size_t)r->pairs);
  multiply(op, N + 1, f->loss);
  for (int i = 0; i < rows; i++)
    along_tangent(op, own, f->Y + i / (N + 1) * f->width_Y, i % (N + 1), 1, r->V + (size_t)i * (size_t)r->pairs);
  multiply(op, rows, f->X);
  for (int i = 0; i < b->n_rotated; i++) {
    const int *test = b->rotated[i].r;
    const double *VX = r->VX + (size_t)row_of(N, test[1], test[2]) * (size_t)f->width_X;
    memcpy(r->S + i * half, VX + gg_hermite_X_column(f, test[0]), (size_t)half * sizeof *r->S);
  }
}

/* Replace the rows of tests of degree 2, which do not decay. */
static void low_own_derivatives(const gg_hermite_operator *op, const gg_hermite_view *own, int i)
{
  const gg_hermite_basis *b = &op->basis;
  const gg_hermite_workspace *r = op->workspace;
  int N = b->degree, J = b->rotated[i].r[0], P = b->rotated[i].r[1], Q = b->rotated[i].r[2];
  double *X = r->X + (size_t)i * (size_t)r->wide;
  memset(X, 0, (size_t)r->wide * sizeof *X);
  for (int j = 0; j <= N - Q; j++)
    for (int p = (j + Q) % 2; p <= N - Q - j; p += 2) {
      const double W = gg_hermite_W(&op->low, J, P, j, p);
      const double *D = own->D + (size_t)gg_hermite_rotated_place(b, j, p, Q) * (size_t)r->wide;
      for (int s = 0; s < r->wide; s++) X[s] += W * D[s];
    }
}

static void low_partner_derivatives(const gg_hermite_operator *op, const gg_hermite_view *own, int i)
{
  const gg_hermite_basis *b = &op->basis;
  const gg_hermite_flux *f = &op->low;
  int N = b->degree, J = b->rotated[i].r[0], P = b->rotated[i].r[1], Q = b->rotated[i].r[2];
  double *S = op->workspace->S + i * f->halves;
  memset(S, 0, (size_t)f->halves * sizeof *S);
  for (int j = 0; j <= N - Q; j++)
    for (int p = (j + Q) % 2; p <= N - Q - j; p += 2) {
      double t = own->t[gg_hermite_rotated_place(b, j, p, Q)];
      for (int u = -1; u < f->n_u; u++) { /* -1: the loss */
        const double *row = u < 0 ? f->loss + j * f->width_X : f->X + (u * f->trials + j) * f->width_X;
        double V = (u < 0 ? -f->Z[P * f->trials + p] : f->Y[u * f->width_Y + P * f->trials + p]) * t;
        for (int l = 0; l < f->halves; l++) S[l] += V * row[gg_hermite_X_column(f, J) + l];
      }
    }
}

void gg_hermite_differentiate_own(const gg_hermite_operator *op, const gg_hermite_view *own)
{
  const gg_hermite_basis *b = &op->basis;
  for (int Q = 0; Q <= b->degree; Q++) own_derivatives(op, own, Q);
  for (int i = 0; i < b->n_rotated; i++)
    if (gg_hermite_degree(b->rotated[i]) <= 2) low_own_derivatives(op, own, i);
}

/* D^T S of the grain, then times the rows of the partner's D that are its marginal. */
void gg_hermite_differentiate_partner(const gg_hermite_operator *op, const gg_hermite_view *own,
                                      const gg_hermite_view *partner, double weight, double *jacobian, size_t stride)
{
  const gg_hermite_basis *b = &op->basis;
  const gg_hermite_workspace *r = op->workspace;
  int half = op->flux.halves;
  partner_derivatives(op, own);
  memset(r->back, 0, (size_t)(b->n * half) * sizeof *r->back);
  for (int i = 0; i < b->n_rotated; i++) {
    const double *D = own->D + (size_t)i * (size_t)r->wide, *S = r->S + i * half;
    int degree = gg_hermite_degree(b->rotated[i]);
    if (degree <= 2) low_partner_derivatives(op, own, i);
    for (int s = b->from[degree]; s < b->from[degree + 1]; s++)
      for (int l = 0; l < half; l++) r->back[s * half + l] += D[s] * S[l];
  }
  for (int l = 0; l < half; l++) {
    const double *D = partner->D + (size_t)gg_hermite_rotated_place(b, 2 * l, 0, 0) * (size_t)r->wide;
    for (int i = 0; i < b->n; i++) { /* of degree 2 l alone */
      double d = weight * r->back[i * half + l], *restrict row = jacobian + (size_t)i * stride;
      for (int s = b->from[2 * l]; s < b->from[2 * l + 1]; s++) row[s] += d * D[s];
    }
  }
}
