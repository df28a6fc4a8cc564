/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "theory/hermite/basis.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "simd/clones.h"

static void number_functions(gg_hermite_basis *b)
{
  int N = b->degree;
  for (int degree = 0; degree <= N; degree += 2) {
    b->from[degree] = b->n;
    for (int z = 0; z <= degree; z += 2)
      for (int x = degree - z; x >= 0; x--) {
        int y = degree - z - x;
        b->place[gg_hermite_cell(b, x, y, z)] = b->n;
        b->function[b->n++] = (gg_hermite_index){{x, y, z}};
      }
    b->from[degree + 1] = b->n;
  }
}

static void number_rotated(gg_hermite_basis *b)
{
  int N = b->degree;
  for (int Q = 0; Q <= N; Q++) {
    b->rotated_from[Q] = b->n_rotated;
    for (int P = 0; P <= N - Q; P++)
      for (int J = (P + Q) % 2; J <= N - Q - P; J += 2) {
        b->rotated_place[gg_hermite_cell(b, J, P, Q)] = b->n_rotated;
        b->rotated[b->n_rotated++] = (gg_hermite_index){{J, P, Q}};
      }
  }
  b->rotated_from[N + 1] = b->n_rotated;
}

gg_status gg_hermite_basis_make(gg_hermite_basis *b, int degree, gg_error *err)
{
  size_t cells = (size_t)(degree + 1) * (size_t)(degree + 1) * (size_t)(degree + 1);
  *b = (gg_hermite_basis){.degree = degree};
  b->function = malloc(cells * sizeof *b->function);
  b->rotated = malloc(cells * sizeof *b->rotated);
  b->place = malloc(cells * sizeof *b->place);
  b->rotated_place = malloc(cells * sizeof *b->rotated_place);
  if (!b->function || !b->rotated || !b->place || !b->rotated_place) {
    gg_hermite_basis_clear(b);
    return gg_base_out_of_memory(err);
  }
  for (size_t i = 0; i < cells; i++) b->place[i] = b->rotated_place[i] = -1;
  number_functions(b);
  number_rotated(b);
  return GG_OK;
}

void gg_hermite_basis_clear(gg_hermite_basis *b)
{
  free(b->function);
  free(b->rotated);
  free(b->place);
  free(b->rotated_place);
  *b = (gg_hermite_basis){0};
}

int gg_hermite_place(const gg_hermite_basis *b, int x, int y, int z)
{
  if (x < 0 || y < 0 || z < 0 || x + y + z > b->degree) return -1;
  return b->place[gg_hermite_cell(b, x, y, z)];
}

int gg_hermite_rotated_place(const gg_hermite_basis *b, int J, int P, int Q)
{
  if (J < 0 || P < 0 || Q < 0 || J + P + Q > b->degree) return -1;
  return b->rotated_place[gg_hermite_cell(b, J, P, Q)];
}

/* Table of square roots of 0, 1, ... and their inverses: computing them took most of the solver's time. */
static const double root[] = {0,
                              1,
                              1.4142135623730951,
                              1.7320508075688772,
                              2,
                              2.2360679774997898,
                              2.4494897427831779,
                              2.6457513110645907,
                              2.8284271247461903,
                              3,
                              3.1622776601683795,
                              3.3166247903553998,
                              3.4641016151377544,
                              3.6055512754639891,
                              3.7416573867739413,
                              3.872983346207417,
                              4,
                              4.1231056256176606,
                              4.2426406871192848,
                              4.358898943540674,
                              4.4721359549995796,
                              4.5825756949558398,
                              4.6904157598234297,
                              4.7958315233127191,
                              4.8989794855663558};
static const double inverse_root[] = {0,
                                      1,
                                      0.70710678118654746,
                                      0.57735026918962584,
                                      0.5,
                                      0.44721359549995793,
                                      0.40824829046386307,
                                      0.3779644730092272,
                                      0.35355339059327373,
                                      0.33333333333333331,
                                      0.31622776601683794,
                                      0.30151134457776363,
                                      0.28867513459481292,
                                      0.27735009811261457,
                                      0.2672612419124244,
                                      0.2581988897471611,
                                      0.25,
                                      0.24253562503633297,
                                      0.23570226039551587,
                                      0.22941573387056174,
                                      0.22360679774997896,
                                      0.21821789023599239,
                                      0.21320071635561041,
                                      0.20851441405707477,
                                      0.20412414523193154};

void gg_hermite_values(int degree, double x, double *value)
{
  value[0] = 1;
  if (degree > 0) value[1] = x;
  for (int n = 1; n < degree; n++) value[n + 1] = (x * value[n] - root[n] * value[n - 1]) * inverse_root[n + 1];
}

/* Eight points at once: one at a time, each product would depend on the one before. Vectors are of 256 bits, since gcc
 * 12 keeps wider ones in memory where registers are narrower. */
enum { LANES = 4, VECTORS = 2 };
typedef double lanes __attribute__((vector_size(LANES * sizeof(double))));

GG_CLONES static void values_of_eight(int degree, const double at[VECTORS * LANES], int n, double *value, int stride)
{
  lanes before[VECTORS] = {{0}}, now[VECTORS], x[VECTORS];
  memcpy(x, at, sizeof x);
  for (int i = 0; i < VECTORS; i++) now[i] = before[i] + 1;
  for (int m = 0; m <= degree; m++) {
    double some[VECTORS * LANES];
    memcpy(some, now, sizeof some);
    for (int k = 0; k < n; k++) value[k * stride + m] = some[k];
    for (int i = 0; i < VECTORS; i++) {
      lanes next = (x[i] * now[i] - root[m] * before[i]) * inverse_root[m + 1];
      before[i] = now[i], now[i] = next;
    }
  }
}

void gg_hermite_values_of(int degree, int n, const double *x, double *value, int stride)
{
  enum { ALL = VECTORS * LANES };
  for (int from = 0; from < n; from += ALL) {
    int many = n - from < ALL ? n - from : ALL;
    double some[ALL] = {0};
    for (int k = 0; k < many; k++) some[k] = x[from + k];
    values_of_eight(degree, some, many, value + from * stride, stride);
  }
}

/* Polynomials of one degree n in the rotated frame are numbered by (P, Q), J = n - P - Q. */
static inline int tangential(int n, int P, int Q)
{
  return P * (n + 1) - P * (P - 1) / 2 + Q;
}

static int of_degree(int n)
{
  return (n + 1) * (n + 2) / 2;
}

/* Apply a_i^+ = sum_j axis_j[i] a'_j^+ to the polynomial `from` of degree n: a^+ Ho_n = sqrt(n+1) Ho_(n+1). */
static void raise(int n, double axis[3][3], int i, double scale, const double *from, double *to)
{
  memset(to, 0, (size_t)of_degree(n + 1) * sizeof *to);
  for (int P = 0; P <= n; P++)
    for (int Q = 0; Q <= n - P; Q++) {
      double value = scale * from[tangential(n, P, Q)];
      to[tangential(n + 1, P, Q)] += axis[0][i] * root[n - P - Q + 1] * value;
      to[tangential(n + 1, P + 1, Q)] += axis[1][i] * root[P + 1] * value;
      to[tangential(n + 1, P, Q + 1)] += axis[2][i] * root[Q + 1] * value;
    }
}

/* Within one degree the polynomials of a frame at rest are numbered in the same way, by (x, y). */
size_t gg_hermite_rotation_scratch(int degree)
{
  size_t most = (size_t)of_degree(degree);
  return 2 * most * most;
}

static void store(const gg_hermite_basis *b, int n, const double *level, int wide, double *D)
{
  for (int y = 0; y <= n; y++)
    for (int z = 0; z <= n - y; z += 2) {
      int r = b->place[gg_hermite_cell(b, n - y - z, y, z)];
      const double *row = level + (size_t)tangential(n, y, z) * (size_t)of_degree(n);
      for (int P = 0; P <= n; P++)
        for (int Q = 0; Q <= n - P; Q++) {
          int q = b->rotated_place[gg_hermite_cell(b, n - P - Q, P, Q)];
          D[(size_t)q * (size_t)wide + (size_t)r] = row[tangential(n, P, Q)];
        }
    }
}

void gg_hermite_rotation(const gg_hermite_basis *b, double axis[3][3], int wide, double *D, double *work)
{
  size_t most = (size_t)of_degree(b->degree);
  double *level = work, *next = work + most * most;
  memset(D, 0, (size_t)wide * (size_t)b->n_rotated * sizeof *D);
  level[0] = 1;
  for (int n = 0;; n++) {
    if (n % 2 == 0) store(b, n, level, wide, D);
    if (n == b->degree) break;
    size_t width = (size_t)of_degree(n), wider = (size_t)of_degree(n + 1);
    for (int y = 0; y <= n + 1; y++)
      for (int z = 0; z <= n + 1 - y; z++) { /* one quantum more: along x if there is any, else y, else z */
        int x = n + 1 - y - z, i = x > 0 ? 0 : y > 0 ? 1 : 2;
        int from = tangential(n, y - (i == 1), z - (i == 2)), count = i == 0 ? x : i == 1 ? y : z;
        raise(n, axis, i, 1 / sqrt(count), level + (size_t)from * width,
              next + (size_t)tangential(n + 1, y, z) * wider);
      }
    double *swap = level;
    level = next, next = swap;
  }
}
