/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Enskog's collision operator on Hermite functions: identities that hold whatever f is, and brute force. */
#include "theory_test.h"

#include "theory/gaussian_moments.h"
#include "theory/hermite/contact_integral.h"
#include "theory/hermite/direction_workspace.h"
#include "theory/hermite/newton.h"

enum { MOST = 40 };

/* An anisotropic Gaussian, and coefficients without symmetry but that of z. */
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
  if (gg_hermite_operator_hold(&op, 2, &err) != GG_OK) fail_msg("%s", err.message);
  return op;
}

static gg_hermite_state state_of(double frame[3][3], double *a)
{
  gg_hermite_state s = {.width = 1, .a = a};
  memcpy(s.L, frame, sizeof s.L);
  return s;
}

/* Two species that differ in everything: masses 1 and m, number fractions x and 1 - x. */
static gg_hermite_gas two_species(double e, double shear)
{
  const double mass[2] = {1, 0.2}, x[2] = {0.3, 0.7}, sigma[2][2] = {{1, 0.8}, {0.8, 0.6}};
  gg_hermite_gas gas = {.n_species = 2};
  for (int i = 0; i < 2; i++) {
    gas.fraction[i] = x[i], gas.mass[i] = mass[i];
    for (int j = 0; j < 2; j++)
      gas.impact[i][j] = (gg_hermite_impact){.frequency = x[j] * sigma[i][j] * sigma[i][j] * (1 + 0.2 * (i != j)),
                                             .eta = (1 + e) * mass[j] / (mass[i] + mass[j]),
                                             .e = e,
                                             .sigma = sigma[i][j],
                                             .shear = sigma[i][j] * shear};
  }
  return gas;
}

/* The Gaussian of the lighter species. */
static double light[3][3] = {{2.1, 0, 0}, {0.3, 1.9, 0}, {0, 0, 2.4}};

/* sum_i x_i m_i <C C>_i from R, its trace: twice the energy. */
static double energy_of(const gg_hermite_basis *b, const gg_hermite_gas *gas, gg_hermite_state *state, const double *R,
                        double *size)
{
  double trace = 0;
  *size = 0;
  for (int k = 0; k < gas->n_species; k++)
    for (int i = 0; i < 3; i++)
      for (int x = 0; x < 3; x++)
        for (int j = 0; j < 3; j++) {
          int r[3] = {0, 0, 0};
          r[i]++, r[j]++;
          int place = gg_hermite_place(b, r[0], r[1], r[2]);
          if (place < 0) continue;
          double share = gas->fraction[k] * gas->mass[k] * R[k * b->n + place];
          trace += state[k].L[x][i] * state[k].L[x][j] * share * (i == j ? sqrt(2) : 1), *size += fabs(share);
        }
  return trace;
}

/* f at e = 1 and rest: Maxwellians of one temperature are fixed points. */
static void maxwellian_is_a_fixed_point(void **state)
{
  (void)state;
  for (int k = 0; k < 2; k++) {
    gg_hermite_operator op = make(8, 0.15 * k);
    double one[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, other[3][3] = {{0}}, a[100] = {1}, R[200];
    gg_hermite_gas gas = two_species(1, 0);
    for (int i = 0; i < 3; i++) other[i][i] = sqrt(1 / gas.mass[1]);
    gg_hermite_state s[2] = {state_of(one, a), state_of(other, a)};
    gg_hermite_operator_at(&op, &gas, s, R, NULL);
    for (int r = 0; r < 2 * op.basis.n; r++)
      if (!(fabs(R[r]) < 3e-12)) fail_msg("R_%d = %g", r, R[r]);
    gg_hermite_operator_clear(&op);
  }
}

/* Elastic collisions keep the energy of any f, and of any two. */
static void elastic_collisions_keep_energy(void **state)
{
  (void)state;
  gg_hermite_operator op = make(6, 0.15);
  double a[MOST], b[MOST], R[2 * MOST], size;
  some_coefficients(&op.basis, a);
  for (int r = 0; r < op.basis.n; r++) b[r] = r == 0 ? 1 : -0.7 * a[r];
  gg_hermite_state s[2] = {state_of(L, a), state_of(light, b)};
  gg_hermite_gas one = gg_hermite_one(1, 1, 0), two = two_species(1, 0);
  const gg_hermite_gas *gas[] = {&one, &two};
  for (int k = 0; k < 2; k++) {
    gg_hermite_operator_at(&op, gas[k], s, R, NULL);
    double trace = energy_of(&op.basis, gas[k], s, R, &size);
    assert_true(size > 0.01);
    assert_true(fabs(trace) < 1e-12 * size);
  }
  gg_hermite_operator_clear(&op);
}

/* The inelastic loss from the sums equals that from the tests of degree 2. */
static void losses_are_those_of_the_sums(void **state)
{
  (void)state;
  gg_hermite_operator op = make(6, 0.15);
  double a[MOST], b[MOST], R[2 * MOST], size;
  some_coefficients(&op.basis, a);
  for (int r = 0; r < op.basis.n; r++) b[r] = r == 0 ? 1 : -0.7 * a[r];
  gg_hermite_state s[2] = {state_of(L, a), state_of(light, b)};
  gg_hermite_gas gas = two_species(0.7, 0);
  gg_hermite_sums sums;
  gg_hermite_operator_at(&op, &gas, s, R, NULL);
  gg_hermite_sums_at(&op, &gas, s, &sums);
  assert_close(-energy_of(&op.basis, &gas, s, R, &size) / 2, sums.loss, 1e-11);
  gg_hermite_operator_clear(&op);
}

/* Two species of the same grains are one. */
static void equal_species_are_one(void **state)
{
  (void)state;
  gg_hermite_operator op = make(6, 0.15);
  double a[MOST], R[MOST], both[2 * MOST];
  some_coefficients(&op.basis, a);
  gg_hermite_state s[2] = {state_of(L, a), state_of(L, a)};
  gg_hermite_gas one = gg_hermite_one(1, 0.8, 0.6), two = one;
  two.n_species = 2;
  for (int i = 0; i < 2; i++)
    for (int j = 0; j < 2; j++) two.impact[i][j] = one.impact[0][0], two.impact[i][j].frequency = j ? 0.3 : 0.7;
  one.stream[0][1] = two.stream[0][1] = 1;
  gg_hermite_operator_at(&op, &one, s, R, NULL);
  gg_hermite_operator_at(&op, &two, s, both, NULL);
  for (int r = 0; r < op.basis.n; r++) {
    assert_true(fabs(both[r] - R[r]) < 1e-12);
    assert_true(fabs(both[op.basis.n + r] - R[r]) < 1e-12);
  }
  gg_hermite_operator_clear(&op);
}

/* The derivative of every R by every a, of either species, by differences. */
static void jacobian_is_the_derivative(void **state)
{
  (void)state;
  gg_hermite_operator op = make(4, 0.15);
  enum { N = 14, ALL = 2 * N };
  double a[ALL], R[ALL], J[ALL * ALL], up[ALL], down[ALL];
  gg_hermite_gas gas = two_species(0.6, 0.9);
  gas.stream[0][1] = 0.9, gas.diffusion[0] = 0.1, gas.drag[1] = 0.4;
  assert_int_equal(op.basis.n, N);
  some_coefficients(&op.basis, a);
  for (int r = 0; r < N; r++) a[N + r] = r == 0 ? 1 : -0.7 * a[r];
  gg_hermite_state x[2] = {state_of(L, a), state_of(light, a + N)};
  gg_hermite_operator_at(&op, &gas, x, R, J);
  for (int s = 0; s < ALL; s++) {
    if (s % N == 0) continue;
    double keep = a[s], h = 1e-4;
    a[s] = keep + h, gg_hermite_operator_at(&op, &gas, x, up, NULL);
    a[s] = keep - h, gg_hermite_operator_at(&op, &gas, x, down, NULL);
    a[s] = keep;
    for (int r = 0; r < ALL; r++) { /* quadratic in a: central differences are exact */
      if (r % N == 0) continue;
      double slope = (up[r] - down[r]) / (2 * h);
      if (!(fabs(slope - J[r * ALL + s]) < 1e-9))
        fail_msg("dR_%d/da_%d = %.12g, not %.12g", r, s, J[r * ALL + s], slope);
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

/* The same integral over both velocities, point by point, in the frame at rest: without rotations, and without
 * factors but that the frames' first axes are the normals. */
static void brute_force(const gg_hermite_operator *op, const gg_hermite_impact *impact, gg_hermite_state *own,
                        gg_hermite_state *other, double *R)
{
  enum { U = 40, V = 14 };
  double u[U], wu[U], x[V], w[V], *k = op->direction[0], b[3][3] = {{k[0]}, {k[1]}, {k[2]}}, image[3][3];
  gg_error err;
  assert_int_equal(gg_hermite_legendre_rule(U, u, wu, &err), GG_OK);
  assert_int_equal(gg_hermite_rule(V, x, w, &err), GG_OK);
  gg_hermite_frame one = gg_hermite_frame_at(own->L, k), two = gg_hermite_frame_at(other->L, k);
  gg_hermite_left_divide(own->L, b, image);
  double S = sqrt(one.s * one.s + two.s * two.s), u0 = impact->shear * k[0] * k[1] / S;
  for (int i = 0; i < U; i++)
    for (int j = 0; j < V; j++) {
      double at = u0 + (12 - u0) * u[i], x1 = (one.s * at + two.s * x[j]) / S, x2 = (one.s * x[j] - two.s * at) / S;
      double g = one.s * x1 - two.s * x2 - impact->shear * k[0] * k[1], partner = 0, c1[3], after[3], c2[3];
      double weight = (12 - u0) * wu[i] * exp(-at * at / 2) / sqrt(2 * M_PI) * w[j] * g * impact->frequency;
      for (int y = 0; y < V; y++)
        for (int z = 0; z < V; z++)
          combine(two.axis, x2, x[y], x[z], c2), partner += w[y] * w[z] * expansion(op, other->a, c2);
      for (int y = 0; y < V; y++)
        for (int z = 0; z < V; z++) {
          combine(one.axis, x1, x[y], x[z], c1);
          for (int q = 0; q < 3; q++) after[q] = c1[q] - impact->eta * g * image[q][0];
          double share = weight * partner * w[y] * w[z] * expansion(op, own->a, c1);
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
    enum { N = 14 };
    double a[2 * N], R[2 * N], brute[2 * N] = {0};
    some_coefficients(&op.basis, a);
    for (int r = 0; r < N; r++) a[N + r] = r == 0 ? 1 : -0.7 * a[r];
    op.n_directions = 1;
    double k[3] = {0.48, 0.6, 0.64};
    memcpy(op.direction[0], k, sizeof k);
    gg_hermite_gas gas = two_species(0.5, 1.3);
    gg_hermite_state s[2] = {state_of(L, a), state_of(light, a + N)};
    gg_hermite_operator_at(&op, &gas, s, R, NULL);
    for (int i = 0; i < 2; i++)
      for (int j = 0; j < 2; j++) brute_force(&op, &gas.impact[i][j], &s[i], &s[j], brute + i * N);
    for (int r = 0; r < 2 * N; r++)
      if (r % N && !(fabs(R[r] - brute[r]) < 1e-9))
        fail_msg("decay %d: R_%d = %.12g, not %.12g", decays, r, R[r], brute[r]);
    gg_hermite_operator_clear(&op);
  }
}

/* Degree 2 is the anisotropic Gaussian of moment closures, by other integrals: one species, and two. */
static void degree_two_is_the_gaussian_closure(void **state)
{
  (void)state;
  for (int i = 0; i < 4; i++) {
    gg_model m = i < 3 ? model_for(GG_USF, 0.2 * i, 0.6, -1) : mixture_for(GG_USF, 0.2, 0.8, -1, 4, 1.5, 2);
    gg_gaussian g[GG_MAX_SPECIES];
    assert_true(gg_theory_gaussian_steady(&m, g) < 1e-9);
    gg_hermite_operator op = make(2, 0);
    double a[10] = {1, 0, 0, 0, 0, 1}, M[3][3], wrong[3][3];
    gg_hermite_state s[2] = {{.width = 1, .a = a}, {.width = 1, .a = a + 5}};
    gg_error err;
    gg_hermite_gas gas = gg_hermite_gas_of(&m);
    assert_int_equal(op.basis.n, 5);
    for (int k = 0; k < m.n_species; k++) {
      memcpy(wrong, g[k].M.at, sizeof wrong);
      wrong[0][0] *= 1.2, wrong[0][1] *= 0.9, wrong[1][0] *= 0.9;
      assert_true(gg_hermite_cholesky(wrong, s[k].L));
    }
    assert_int_equal(gg_hermite_newton(&op, &gas, s, NULL, &err), GG_OK);
    for (int k = 0; k < m.n_species; k++) {
      gg_hermite_second_moments(&op.basis, &s[k], M);
      for (int x = 0; x < 3; x++)
        for (int y = 0; y < 3; y++) assert_close(M[x][y], g[k].M.at[x][y], 1e-7);
    }
    gg_hermite_operator_clear(&op);
  }
}

/* An expansion about another Gaussian is the same distribution. */
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
      cmocka_unit_test(losses_are_those_of_the_sums),       cmocka_unit_test(equal_species_are_one),
      cmocka_unit_test(jacobian_is_the_derivative),         cmocka_unit_test(against_brute_force),
      cmocka_unit_test(degree_two_is_the_gaussian_closure), cmocka_unit_test(expansions_keep_their_moments),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
