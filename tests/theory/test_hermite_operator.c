/* Enskog's collision operator on Hermite functions: identities that hold whatever f is, and brute force. */
#include "theory_test.h"

#include "theory/gaussian_moments.h"
#include "theory/hermite/contact.h"
#include "theory/hermite/newton.h"
#include "theory/hermite/room.h"

enum { MOST = 40 };

/* An anisotropic Gaussian, and coefficients of no symmetry beyond that of z. */
static double L[3][3] = {{1.2, 0, 0}, {-0.4, 0.8, 0}, {0, 0, 0.9}};

static void some_coefficients(const gg_hermite_basis *b, double *a)
{
  a[0] = 1;
  for (int r = 1; r < b->n; r++) a[r] = 0.1 * sin(3. * r) / (1 + gg_hermite_degree(b->function[r]));
}

static gg_hermite_operator make(int degree, double decay)
{
  gg_hermite_operator op;
  gg_error err;
  if (gg_hermite_operator_make(&op, degree, decay, false, &err) != GG_OK) fail_msg("%s", err.message);
  return op;
}

/* f at e = 1 and rest: a Maxwellian is left alone. */
static void maxwellian_is_a_fixed_point(void **state)
{
  (void)state;
  for (int k = 0; k < 2; k++) {
    gg_hermite_operator op = make(8, 0.15 * k);
    double one[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, a[100] = {1}, R[100];
    gg_hermite_gas gas = {.frequency = 1, .eta = 1};
    gg_hermite_operator_at(&op, &gas, one, a, R, NULL);
    for (int r = 1; r < op.basis.n; r++)
      if (!(fabs(R[r]) < 1e-12)) fail_msg("R_%d = %g", r, R[r]);
    gg_hermite_operator_clear(&op);
  }
}

/* Elastic collisions keep the energy of any f: the trace of d<C C>/dt. */
static void elastic_collisions_keep_energy(void **state)
{
  (void)state;
  gg_hermite_operator op = make(6, 0.15);
  double a[MOST], R[MOST], trace = 0, size = 0;
  some_coefficients(&op.basis, a);
  gg_hermite_gas gas = {.frequency = 1, .eta = 1};
  gg_hermite_operator_at(&op, &gas, L, a, R, NULL);
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++)
      for (int x = 0; x < 3; x++) {
        int r[3] = {0, 0, 0};
        r[i]++, r[j]++;
        int place = gg_hermite_place(&op.basis, r[0], r[1], r[2]);
        if (place >= 0) trace += L[x][i] * L[x][j] * R[place] * (i == j ? sqrt(2) : 1), size += fabs(R[place]);
      }
  assert_true(size > 0.01);
  assert_true(fabs(trace) < 1e-12 * size);
  gg_hermite_operator_clear(&op);
}

/* The derivative of every R by every a, by differences. */
static void jacobian_is_the_derivative(void **state)
{
  (void)state;
  gg_hermite_operator op = make(4, 0.15);
  enum { N = 14 };
  double a[N], R[N], J[N * N], up[N], down[N];
  gg_hermite_gas gas = {.frequency = 0.7, .eta = 0.8, .shear = 0.9, .stream = {{0, 0.9, 0}}, .diffusion = 0.1};
  assert_int_equal(op.basis.n, N);
  some_coefficients(&op.basis, a);
  gg_hermite_operator_at(&op, &gas, L, a, R, J);
  for (int s = 1; s < N; s++) {
    double keep = a[s], h = 1e-4;
    a[s] = keep + h, gg_hermite_operator_at(&op, &gas, L, a, up, NULL);
    a[s] = keep - h, gg_hermite_operator_at(&op, &gas, L, a, down, NULL);
    a[s] = keep;
    for (int r = 1; r < N; r++) { /* quadratic in a: central differences are exact */
      double slope = (up[r] - down[r]) / (2 * h);
      if (!(fabs(slope - J[r * N + s]) < 1e-9)) fail_msg("dR_%d/da_%d = %.12g, not %.12g", r, s, J[r * N + s], slope);
    }
  }
  gg_hermite_operator_clear(&op);
}

/* psi_r at c, decaying if its degree is above 2. */
static double test_function(const gg_hermite_operator *op, int r, const double c[3])
{
  double product = 1, value[GG_HERMITE_MOST_DEGREE + 1];
  for (int i = 0; i < 3; i++) {
    gg_hermite_values(op->basis.degree, c[i], value);
    product *= value[op->basis.function[r].r[i]];
  }
  double decay = gg_hermite_degree(op->basis.function[r]) > 2 ? op->decay : 0;
  return product * exp(-decay * (c[0] * c[0] + c[1] * c[1] + c[2] * c[2]) / 2);
}

static double expansion(const gg_hermite_operator *op, const double *a, const double c[3])
{
  double sum = 0;
  for (int r = 0; r < op->basis.n; r++) {
    double product = a[r], value[GG_HERMITE_MOST_DEGREE + 1];
    for (int i = 0; i < 3; i++)
      gg_hermite_values(op->basis.degree, c[i], value), product *= value[op->basis.function[r].r[i]];
    sum += product;
  }
  return sum;
}

static void combine(double axis[3][3], double x, double y, double z, double c[3])
{
  for (int i = 0; i < 3; i++) c[i] = x * axis[0][i] + y * axis[1][i] + z * axis[2][i];
}

/* The same integral over both velocities, point by point, in the frame at rest: nothing rotated, nothing factored. */
static void brute_force(const gg_hermite_operator *op, const gg_hermite_gas *gas, const double *a, double *R)
{
  enum { U = 40, V = 14 };
  double u[U], wu[U], x[V], w[V], axis[3][3], *k = op->direction[0], b[3][3] = {{k[0]}, {k[1]}, {k[2]}}, image[3][3];
  gg_error err;
  assert_int_equal(gg_legendre_rule(U, u, wu, &err), GG_OK);
  assert_int_equal(gg_hermite_rule(V, x, w, &err), GG_OK);
  gg_hermite_contact c = gg_hermite_contact_at(gas->eta, gas->shear, L, k, axis);
  gg_hermite_left_divide(L, b, image);
  for (int i = 0; i < U; i++)
    for (int j = 0; j < V; j++) {
      double at = c.u0 + (12 - c.u0) * u[i], x1 = (x[j] + at) / sqrt(2), x2 = (x[j] - at) / sqrt(2);
      double g = sqrt(2) * c.s * (at - c.u0), partner = 0, c1[3], after[3], c2[3];
      double weight = (12 - c.u0) * wu[i] * exp(-at * at / 2) / sqrt(2 * M_PI) * w[j] * g;
      for (int y = 0; y < V; y++)
        for (int z = 0; z < V; z++) combine(axis, x2, x[y], x[z], c2), partner += w[y] * w[z] * expansion(op, a, c2);
      for (int y = 0; y < V; y++)
        for (int z = 0; z < V; z++) {
          combine(axis, x1, x[y], x[z], c1);
          for (int q = 0; q < 3; q++) after[q] = c1[q] - gas->eta * g * image[q][0];
          double share = weight * partner * w[y] * w[z] * expansion(op, a, c1);
          for (int r = 1; r < op->basis.n; r++)
            R[r] += op->weight[0] * share * (test_function(op, r, after) - test_function(op, r, c1));
        }
    }
}

static void against_brute_force(void **state)
{
  (void)state;
  for (int decays = 0; decays < 2; decays++) {
    gg_hermite_operator op = make(4, 0.15 * decays);
    double a[14], R[14], brute[14] = {0};
    some_coefficients(&op.basis, a);
    op.n_directions = 1;
    double k[3] = {0.48, 0.6, 0.64};
    memcpy(op.direction[0], k, sizeof k);
    gg_hermite_gas gas = {.frequency = 1, .eta = 0.75, .shear = 1.3};
    gg_hermite_operator_at(&op, &gas, L, a, R, NULL);
    brute_force(&op, &gas, a, brute);
    for (int r = 1; r < 14; r++)
      if (!(fabs(R[r] - brute[r]) < 1e-9)) fail_msg("decay %d: R_%d = %.12g, not %.12g", decays, r, R[r], brute[r]);
    gg_hermite_operator_clear(&op);
  }
}

/* Degree 2 is the anisotropic Gaussian of moment closures, by other integrals. */
static void degree_two_is_the_gaussian_closure(void **state)
{
  (void)state;
  for (int i = 0; i < 3; i++) {
    gg_model m = model_for(GG_USF, 0.2 * i, 0.6, -1);
    gg_gaussian g[GG_MAX_SPECIES];
    assert_true(gg_gaussian_steady(&m, g) < 1e-9);
    gg_hermite_operator op = make(2, 0);
    double a[5] = {1}, M[3][3], wrong[3][3];
    gg_hermite_state s = {.width = 1, .a = a};
    gg_error err;
    gg_hermite_gas gas = {.frequency = m.density * m.chi[0], .eta = 0.8, .shear = m.boltzmann ? 0 : m.shear_rate};
    gas.stream[0][1] = m.shear_rate;
    memcpy(wrong, g[0].M.at, sizeof wrong);
    wrong[0][0] *= 1.2, wrong[0][1] *= 0.9, wrong[1][0] *= 0.9;
    assert_true(gg_hermite_cholesky(wrong, s.L));
    assert_int_equal(gg_hermite_newton(&op, &gas, &s, &err), GG_OK);
    gg_hermite_second_moments(&op.basis, &s, M);
    for (int x = 0; x < 3; x++)
      for (int y = 0; y < 3; y++) assert_close(M[x][y], g[0].M.at[x][y], 1e-7);
    gg_hermite_operator_clear(&op);
  }
}

/* Another Gaussian, the same distribution. */
static void expansions_keep_their_moments(void **state)
{
  (void)state;
  gg_hermite_operator op = make(6, 0);
  double a[MOST], before[3][3], after[3][3], other[3][3] = {{1.1, 0, 0}, {0.3, 1, 0}, {0, 0, 1.3}};
  gg_hermite_state s = {.width = 1, .a = a};
  gg_error err;
  memcpy(s.L, L, sizeof s.L);
  some_coefficients(&op.basis, a);
  gg_hermite_second_moments(&op.basis, &s, before);
  assert_int_equal(gg_hermite_expand_anew(&op.basis, &s, other, &err), GG_OK);
  gg_hermite_second_moments(&op.basis, &s, after);
  for (int i = 0; i < 9; i++) assert_close(1 + after[i / 3][i % 3], 1 + before[i / 3][i % 3], 1e-12);
  assert_int_equal(gg_hermite_expand_anew(&op.basis, &s, L, &err), GG_OK);
  double same[MOST];
  some_coefficients(&op.basis, same);
  for (int r = 0; r < op.basis.n; r++) assert_true(fabs(a[r] - same[r]) < 1e-11);
  gg_hermite_operator_clear(&op);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(maxwellian_is_a_fixed_point),        cmocka_unit_test(elastic_collisions_keep_energy),
      cmocka_unit_test(jacobian_is_the_derivative),         cmocka_unit_test(against_brute_force),
      cmocka_unit_test(degree_two_is_the_gaussian_closure), cmocka_unit_test(expansions_keep_their_moments),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
