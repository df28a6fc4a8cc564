/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "theory/hermite/hermite_state.h"

#include <gsl/gsl_integration.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"

enum { N1 = GG_HERMITE_MOST_DEGREE + 1, MOST_POINTS = GG_HERMITE_MOST_DEGREE + 3 };

/* <c_i c_j> = delta_ij + a_(e_i + e_j), times sqrt 2 on the diagonal. */
static double pair_moment(const gg_hermite_basis *b, const double *a, int i, int j)
{
  int r[3] = {0, 0, 0};
  r[i]++, r[j]++;
  int place = gg_hermite_place(b, r[0], r[1], r[2]);
  double value = place < 0 ? 0 : a[place];
  return i == j ? 1 + M_SQRT2 * value : value;
}

void gg_hermite_second_moments(const gg_hermite_basis *b, const gg_hermite_state *s, double M[3][3])
{
  double c[3][3];
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++) c[i][j] = pair_moment(b, s->a, i, j);
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++) {
      M[i][j] = 0;
      for (int k = 0; k <= i; k++)
        for (int l = 0; l <= j; l++) M[i][j] += s->L[i][k] * c[k][l] * s->L[j][l];
    }
}

bool gg_hermite_cholesky(double A[3][3], double L[3][3])
{
  memset(L, 0, 9 * sizeof(double));
  for (int i = 0; i < 3; i++)
    for (int j = 0; j <= i; j++) {
      double sum = A[i][j];
      for (int k = 0; k < j; k++) sum -= L[i][k] * L[j][k];
      if (i == j && !(sum > 0)) return false;
      L[i][j] = i == j ? sqrt(sum) : sum / L[j][j];
    }
  return true;
}

bool gg_hermite_gaussian(double width, double M[3][3], double L[3][3])
{
  double wide[3][3];
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++) wide[i][j] = width * M[i][j];
  return gg_hermite_cholesky(wide, L);
}

/* A Gauss-Hermite rule per axis; `visit` sees c, the weight and the normalised polynomials of each axis. */
typedef struct gg_grid {
  int n, degree;
  double x[MOST_POINTS], w[MOST_POINTS], value[MOST_POINTS][N1];
} gg_grid;

static bool make_grid(gg_grid *g, int degree)
{
  g->n = degree + 2, g->degree = degree;
  gsl_integration_fixed_workspace *rule =
      gsl_integration_fixed_alloc(gsl_integration_fixed_hermite, (size_t)g->n, 0, 0.5, 0, 0);
  if (!rule) return false;
  for (int i = 0; i < g->n; i++) {
    g->x[i] = gsl_integration_fixed_nodes(rule)[i];
    g->w[i] = gsl_integration_fixed_weights(rule)[i] / sqrt(2 * M_PI);
    gg_hermite_values(degree, g->x[i], g->value[i]);
  }
  gsl_integration_fixed_free(rule);
  return true;
}

/* sum_r a_r Ho_r at a point of the grid. */
static double expansion_at(const gg_hermite_basis *b, const gg_grid *g, const double *a, int i, int j, int k)
{
  double sum = 0;
  for (int r = 0; r < b->n; r++) {
    const int *q = b->function[r].r;
    sum += a[r] * g->value[i][q[0]] * g->value[j][q[1]] * g->value[k][q[2]];
  }
  return sum;
}

/* G = L'^-1 L */
static void change_of_frame(double to[3][3], double from[3][3], double G[3][3])
{
  for (int column = 0; column < 3; column++)
    for (int i = 0; i < 3; i++) {
      double x = from[i][column];
      for (int j = 0; j < i; j++) x -= to[i][j] * G[j][column];
      G[i][column] = x / to[i][i];
    }
}

/* Add to every a_r the moment Ho_r(c') of one point. */
static void add_point(const gg_hermite_basis *b, const double c[3], double amount, double *a)
{
  double value[3][N1];
  for (int i = 0; i < 3; i++) gg_hermite_values(b->degree, c[i], value[i]);
  for (int r = 0; r < b->n; r++) {
    const int *q = b->function[r].r;
    a[r] += amount * value[0][q[0]] * value[1][q[1]] * value[2][q[2]];
  }
}

gg_status gg_hermite_expand_anew(const gg_hermite_basis *b, gg_hermite_state *s, double L[3][3], gg_error *err)
{
  gg_grid g;
  double G[3][3], *a = calloc((size_t)b->n, sizeof *a);
  if (!a || !make_grid(&g, b->degree)) {
    free(a);
    return gg_base_out_of_memory(err);
  }
  change_of_frame(L, s->L, G);
  for (int i = 0; i < g.n; i++)
    for (int j = 0; j < g.n; j++)
      for (int k = 0; k < g.n; k++) {
        double w = g.w[i] * g.w[j] * g.w[k] * expansion_at(b, &g, s->a, i, j, k), c[3];
        for (int x = 0; x < 3; x++) c[x] = G[x][0] * g.x[i] + G[x][1] * g.x[j] + G[x][2] * g.x[k];
        add_point(b, c, w, a);
      }
  memcpy(s->a, a, (size_t)b->n * sizeof *a);
  memcpy(s->L, L, sizeof s->L);
  s->a[0] = 1;
  free(a);
  return GG_OK;
}

double gg_hermite_mean(const gg_hermite_basis *b, const gg_hermite_state *s, gg_hermite_function *function)
{
  gg_grid g;
  double sum = 0;
  if (!make_grid(&g, b->degree)) return NAN;
  for (int i = 0; i < g.n; i++)
    for (int j = 0; j < g.n; j++)
      for (int k = 0; k < g.n; k++) {
        double C[3];
        for (int x = 0; x < 3; x++) C[x] = s->L[x][0] * g.x[i] + s->L[x][1] * g.x[j] + s->L[x][2] * g.x[k];
        sum += g.w[i] * g.w[j] * g.w[k] * expansion_at(b, &g, s->a, i, j, k) * function(C);
      }
  return sum;
}

static double fourth_x(const double C[3])
{
  return C[0] * C[0] * C[0] * C[0];
}

static double fourth_y(const double C[3])
{
  return C[1] * C[1] * C[1] * C[1];
}

static double fourth_z(const double C[3])
{
  return C[2] * C[2] * C[2] * C[2];
}

double gg_hermite_fourth_moment(const gg_hermite_basis *b, const gg_hermite_state *s, int axis)
{
  static gg_hermite_function *const fourth[] = {fourth_x, fourth_y, fourth_z};
  return gg_hermite_mean(b, s, fourth[axis]);
}
