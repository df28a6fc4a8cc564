/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Between collisions dC/dt = -A C and df/dt = D laplacian f:
 *   R_r = < -sum_ij B_ij c_j d_i psi_r + D sum_ij G_ij d_i d_j psi_r >,   B = L^-1 A L,   G = (L L^T)^-1.
 * On psi_m, d_i and c_j are sums of two:
 *   d_i psi_m = (1 - decay) sqrt(m_i) psi_(m-e_i) - decay sqrt(m_i + 1) psi_(m+e_i),
 *   c_j psi_m = sqrt(m_j) psi_(m-e_j) + sqrt(m_j + 1) psi_(m+e_j). */
#include <math.h>

#include "theory/hermite/contact_integral.h"
#include "theory/hermite/direction_workspace.h"

/* A sum of tests. */
enum { MOST_TERMS = 4 };
typedef struct gg_tests {
  int n;
  double decay;
  struct {
    double amount;
    int m[3];
  } term[MOST_TERMS];
} gg_tests;

/* Both operators: `down` sqrt(m_i) psi_(m-e_i) + `up` sqrt(m_i + 1) psi_(m+e_i) of each term. */
static gg_tests ladder(gg_tests of, int i, double down, double up)
{
  gg_tests to = {.decay = of.decay};
  for (int k = 0; k < of.n; k++) {
    int m = of.term[k].m[i];
    for (int step = -1; step <= 1; step += 2) {
      double amount = of.term[k].amount * (step < 0 ? down * sqrt(m) : up * sqrt(m + 1));
      if (amount == 0) continue;
      to.term[to.n] = of.term[k];
      to.term[to.n].amount = amount;
      to.term[to.n++].m[i] += step;
    }
  }
  return to;
}

static gg_tests derivative(gg_tests of, int i)
{
  return ladder(of, i, 1 - of.decay, -of.decay);
}

/* < psi_m Ho_s >, psi_m itself for tests that do not decay. */
static double overlap(const gg_hermite_operator *op, double decay, const int m[3], const int s[3])
{
  double product = 1;
  for (int i = 0; i < 3; i++) {
    if ((m[i] - s[i]) % 2) return 0;
    product *= decay > 0 ? op->overlap[m[i] * (op->basis.degree + 1) + s[i]] : m[i] == s[i];
  }
  return product;
}

static void add(const gg_hermite_operator *op, const gg_tests *t, double factor, const double *a, double *R,
                double *row)
{
  const gg_hermite_basis *b = &op->basis;
  for (int k = 0; k < t->n && factor != 0; k++) {
    const int *m = t->term[k].m;
    const double amount = factor * t->term[k].amount;
    if (m[2] % 2) continue; /* functions are even in z */
    if (!(t->decay > 0)) {  /* orthonormal: one function alone */
      const int s = gg_hermite_place(b, m[0], m[1], m[2]);
      if (s < 0) continue;
      *R += amount * a[s];
      if (row) row[s] += amount;
      continue;
    }
    const double *x = op->overlap + m[0] * (b->degree + 1), *y = op->overlap + m[1] * (b->degree + 1),
                 *z = op->overlap + m[2] * (b->degree + 1);
    double sum = *R;
    int s = 0; /* functions as the basis numbers them: by degree, z, y; x and y have one parity, that of the term */
    for (int degree = 0; degree <= b->degree; degree += 2)
      for (int k_z = 0; k_z <= degree; s += degree - k_z + 1, k_z += 2)
        for (int k_y = m[0] & 1; k_y <= degree - k_z; k_y += 2) {
          const double value = x[degree - k_z - k_y] * y[k_y] * z[k_z] * amount;
          sum += value * a[s + k_y];
          if (row) row[s + k_y] += value;
        }
    *R = sum;
  }
}

/* B = L^-1 A L, in which drag stays drag, and G = L^-T L^-1 */
static void frame(const gg_hermite_gas *gas, int species, double L[3][3], double B[3][3], double G[3][3])
{
  double one[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  double AL[3][3], inverse[3][3];
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++)
      AL[i][j] = gas->stream[i][0] * L[0][j] + gas->stream[i][1] * L[1][j] + gas->stream[i][2] * L[2][j];
  gg_hermite_left_divide(L, AL, B);
  for (int i = 0; i < 3; i++) B[i][i] += gas->drag[species];
  gg_hermite_left_divide(L, one, inverse); /* d/dC_a = sum_i inverse_ia d_i */
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++)
      G[i][j] = inverse[i][0] * inverse[j][0] + inverse[i][1] * inverse[j][1] + inverse[i][2] * inverse[j][2];
}

void gg_hermite_add_streaming(const gg_hermite_operator *op, const gg_hermite_gas *gas, int species,
                              gg_hermite_state *state, double *R, double *jacobian, size_t stride)
{
  const gg_hermite_basis *b = &op->basis;
  double B[3][3], G[3][3], *a = state->a;
  frame(gas, species, state->L, B, G);
  for (int r = 1; r < b->n; r++) {
    const int *m = b->function[r].r;
    double *row = jacobian ? jacobian + (size_t)r * stride : NULL;
    gg_tests psi = {.n = 1, .term = {{1, {m[0], m[1], m[2]}}}};
    psi.decay = gg_hermite_degree(b->function[r]) > 2 ? op->decay : 0;
    for (int i = 0; i < 3; i++)
      for (int j = 0; j < 3; j++) {
        gg_tests d = derivative(psi, i);
        gg_tests streamed = ladder(d, j, 1, 1), spread = derivative(d, j);
        add(op, &streamed, -B[i][j], a, R + r, row);
        add(op, &spread, gas->diffusion[species] * G[i][j], a, R + r, row);
      }
  }
}

double gg_hermite_test_overlap(const gg_hermite_operator *op, int r, int s)
{
  const gg_hermite_index *function = op->basis.function;
  return overlap(op, gg_hermite_degree(function[r]) > 2 ? op->decay : 0, function[r].r, function[s].r);
}
