/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Collisions of rough grains on Hermite functions of velocity and spin: identities, brute force, and degree 2, which
 * is known from the Gaussian closure and two Maxwellians. */
#include "theory_test.h"

#include <stdlib.h>

#include "common/collision.h"
#include "theory/gaussian_moments.h"
#include "theory/hermite/overlap.h"
#include "theory/rough/steady.h"
#include "theory/two_maxwellian.h"

static const gg_rough_choice moments = {.width = 1, .spin_width = 1};
static const double inertia = 0.4;

typedef struct fixture {
  gg_rough_relative relative;
  gg_rough_form form;
} fixture;

static fixture make(const gg_rough_gas *gas, const gg_rough_weight *weight, int degree, bool one_direction)
{
  fixture x;
  gg_error err;
  if (gg_rough_relative_make(&x.relative, gas, weight, degree, one_direction, &err) != GG_OK)
    fail_msg("%s", err.message);
  if (gg_rough_form_make(&x.form, &x.relative, degree, false, &moments, &err) != GG_OK) fail_msg("%s", err.message);
  return x;
}

static void clear(fixture *x)
{
  gg_rough_relative_clear(&x->relative);
  gg_rough_form_clear(&x->form);
}

static gg_rough_gas gas_of(double e, double beta, double shear)
{
  gg_contact c = gg_common_contact_make((gg_partner){1, inertia}, (gg_partner){1, inertia}, e, beta, INFINITY);
  return (gg_rough_gas){1, c.jn, c.jt, INFINITY, inertia, shear, NULL};
}

static gg_rough_weight isotropic(double ratio)
{
  gg_rough_weight w = {.spin = 0};
  for (int i = 0; i < 3; i++) w.L[i][i] = 1, w.S[i][i] = sqrt(ratio / inertia);
  return w;
}

static const gg_rough_weight skewed = {
    .L = {{1.2, 0, 0}, {-0.4, 0.8, 0}, {0, 0, 0.9}}, .S = {{0.7, 0, 0}, {0.2, 0.5, 0}, {0, 0, 0.6}}, .spin = -0.3};

static double some(int q)
{
  return q == 0 ? 1 : 0.1 * sin(3. * q);
}

/* Perfectly rough and elastic: Maxwellians of equal temperatures are fixed points. */
static void maxwellian_is_a_fixed_point(void **state)
{
  (void)state;
  gg_rough_gas gas = gas_of(1, 1, 0);
  gg_rough_weight w = isotropic(1);
  fixture x = make(&gas, &w, 5, false);
  for (int r = 1; r < x.form.n; r++)
    if (!(fabs(x.form.B[r]) < 1e-12)) fail_msg("R_%d = %g", r, x.form.B[r]); /* the pair (0, 0) comes first */
  clear(&x);
}

static int spins(const fixture *x, int q)
{
  const int *r = x->relative.f.function[x->form.function[q]].r;
  return r[3] + r[4] + r[5];
}

/* Detailed balance: about Maxwellians the linear operator is symmetric, but for the sign that spins change with time
 * (velocities are even); and no mode grows. */
static void elastic_operator_is_symmetric(void **state)
{
  (void)state;
  gg_rough_gas gas = gas_of(1, 1, 0);
  gg_rough_weight w = isotropic(1);
  fixture x = make(&gas, &w, 4, false);
  size_t n = (size_t)x.form.n;
  double *a = calloc(n, sizeof *a), *R = calloc(n, sizeof *R), *J = calloc(n * n, sizeof *J), largest = 0;
  a[0] = 1;
  gg_rough_form_add(&x.form, 1, a, R, J);
  for (size_t r = 1; r < n; r++) {
    assert_true(J[r * n + r] < 1e-12);
    for (size_t q = 1; q < r; q++) {
      largest = fmax(largest, fabs(J[r * n + q]));
      double other = J[q * n + r] * ((spins(&x, (int)r) + spins(&x, (int)q)) % 2 ? -1 : 1);
      if (!(fabs(J[r * n + q] - other) < 1e-5)) fail_msg("%zu %zu: %g, not %g", r, q, J[r * n + q], other);
    }
  }
  assert_true(largest > 0.1);
  free(a), free(R), free(J);
  clear(&x);
}

/* 2 x the translational and rotational energy, from R; elastic perfectly rough collisions keep it, for any f. */
static void elastic_collisions_keep_energy(void **state)
{
  (void)state;
  gg_rough_gas gas = gas_of(1, 1, 0);
  fixture x = make(&gas, &skewed, 4, false);
  double a[60], R[60] = {0}, energy = 0, size = 0;
  assert_int_equal(x.form.n, 60);
  for (int q = 0; q < x.form.n; q++) a[q] = some(q);
  gg_rough_form_add(&x.form, 1, a, R, NULL);
  for (int k = 0; k < 2; k++)
    for (int i = 0; i < 3; i++)
      for (int j = 0; j < 3; j++) {
        gg_rough_index index = {{0}};
        index.r[3 * k + i]++, index.r[3 * k + j]++;
        int q = x.form.unknown[gg_rough_place(&x.relative.f, index.r)];
        for (int c = 0; c < 3 && q >= 0; c++) {
          double factor = k ? inertia * skewed.S[c][i] * skewed.S[c][j] : skewed.L[c][i] * skewed.L[c][j];
          energy += factor * R[q] * (i == j ? sqrt(2) : 1), size += fabs(factor * R[q]);
        }
      }
  int mean = x.form.unknown[x.relative.f.up[0][5]]; /* the spins' mean, about which the second moment is taken */
  energy += 2 * inertia * skewed.spin * skewed.S[2][2] * R[mean];
  assert_true(size > 0.01);
  assert_true(fabs(energy) < 1e-12 * size);
  clear(&x);
}

/* Degree 2 about any Gaussian: production of moments, collision rate and stress of the Gaussian closure. */
static void degree_two_is_the_gaussian_closure(void **state)
{
  (void)state;
  gg_model m = model_for(GG_USF, 0.3, 0.8, 0.3);
  gg_contact c = m.contact[0][0];
  gg_rough_gas gas = {m.density * m.chi[0], c.jn, c.jt, INFINITY, m.inertia[0], m.shear_rate, NULL};
  gg_gaussian g[GG_MAX_SPECIES] = {{.spin = skewed.spin}};
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++)
      for (int k = 0; k < 3; k++) {
        g[0].M.at[i][j] += skewed.L[i][k] * skewed.L[j][k];
        g[0].Theta.at[i][j] += skewed.S[i][k] * skewed.S[j][k];
      }
  gg_gaussian_rates r;
  gg_theory_gaussian_rates_at(&m, g, &r);
  fixture x = make(&gas, &skewed, 2, false);
  double a[10] = {1}, R[10] = {0};
  assert_int_equal(x.form.n, 10);
  gg_rough_form_add(&x.form, gas.frequency, a, R, NULL);
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++) {
      double velocity = 0, spin = 0;
      for (int k = 0; k < 3; k++)
        for (int l = 0; l < 3; l++) {
          gg_rough_index v = {{0}}, s = {{0}};
          v.r[k]++, v.r[l]++, s.r[3 + k]++, s.r[3 + l]++;
          int p = x.form.unknown[gg_rough_place(&x.relative.f, v.r)],
              q = x.form.unknown[gg_rough_place(&x.relative.f, s.r)];
          double factor = k == l ? sqrt(2) : 1;
          if (p >= 0) velocity += skewed.L[i][k] * skewed.L[j][l] * factor * R[p];
          if (q >= 0) spin += skewed.S[i][k] * skewed.S[j][l] * factor * R[q];
        }
      assert_close(velocity, r.change[0].M.at[i][j], 1e-5);
      assert_close(spin, r.change[0].Theta.at[i][j], 1e-5);
      if ((i == 2) == (j == 2)) {
        double P = m.density * gas.frequency / 2 * gg_rough_pair_mean(&x.form, &x.relative, x.relative.J[i][j], a);
        assert_close(P, r.Pc.at[i][j], 1e-5);
      }
    }
  assert_close(skewed.S[2][2] * R[x.form.unknown[x.relative.f.up[0][5]]], r.change[0].spin, 1e-5);
  assert_close(gas.frequency * gg_rough_pair_mean(&x.form, &x.relative, x.relative.rate, a), r.frequency[0], 1e-5);
  clear(&x);
}

/* Degree 2 of a cooling gas: the ratio and the cooling rate of two Maxwellians. */
static void degree_two_cools_like_two_maxwellians(void **state)
{
  (void)state;
  gg_rough_gas gas = gas_of(0.8, 0.2, 0);
  gg_grain grain = {gas.eta1, gas.eta2, gas.K};
  double ratio = gg_theory_ratio_cooling(grain, INFINITY), growth;
  gg_rough_steady s = {.choice = moments, .gas = gas, .weight = isotropic(ratio)};
  const gg_heating cools = {.kind = GG_HEATING_COOLS};
  gg_error err;
  assert_int_equal(gg_rough_isotropic_solve(&s, 2, &cools, &growth, &err), GG_OK);
  for (int q = 1; q < s.form.n; q++) assert_true(fabs(s.a[q]) < 1e-9);
  assert_close(2 * growth, -4 * sqrt(M_PI) / 3 * gg_theory_exchange_at(grain, INFINITY, ratio).translation, 1e-10);
  gg_rough_steady_clear(&s);
}

/* For an isotropic weight the product equals the matrix. */
static void isotropic_weights_factor(void **state)
{
  (void)state;
  gg_rough_gas gas = gas_of(0.7, -0.3, 0);
  gg_rough_weight w = isotropic(0.6);
  gg_rough_relative plain, product;
  gg_error err;
  assert_int_equal(gg_rough_relative_make(&plain, &gas, &w, 5, true, &err), GG_OK);
  assert_int_equal(gg_rough_relative_isotropic(&product, &gas, &w, 5, &err), GG_OK);
  double largest = 0;
  for (int R = 1; R < plain.f.n; R++)
    for (int S = 0; S < plain.f.n; S++) {
      double one = gg_rough_relative_at(&plain, R, S), two = gg_rough_relative_at(&product, R, S);
      if (!(fabs(one - two) < 1e-10 * (1 + fabs(one)))) fail_msg("W_%d,%d = %.12g, not %.12g", R, S, two, one);
      largest = fmax(largest, fabs(one));
    }
  assert_true(largest > 1);
  for (int S = 0; S < plain.f.n; S++) {
    assert_true(fabs(plain.rate[S] - product.rate[S]) < 1e-11);
    assert_true(fabs(plain.J[2][2][S] - product.J[2][2][S]) < 1e-11);
  }
  gg_rough_relative_clear(&plain);
  gg_rough_relative_clear(&product);
}

/* Brute force, one direction: the collision rule itself on a grid of pairs. */
enum { AXES = 11, POINTS = 3, APPROACH = 20 };

typedef struct grid {
  double x[POINTS], w[POINTS], u[APPROACH], wu[APPROACH];
} grid;

/* Ho_r of one grain. */
static double function_at(const gg_rough_index *index, double value[6][4])
{
  double product = 1;
  for (int i = 0; i < 6; i++) product *= value[i][index->r[i]];
  return product;
}

static void values_at(const double x[6], double value[6][4])
{
  for (int i = 0; i < 6; i++) {
    value[i][0] = 1, value[i][1] = x[i];
    value[i][2] = (x[i] * x[i] - 1) / sqrt(2), value[i][3] = (x[i] * x[i] - 3) * x[i] / sqrt(6);
  }
}

/* f1 f2 over the weights, products of degree up to 3. */
static double pair_density(const fixture *x, double one[6][4], double two[6][4])
{
  double part[2][4] = {{0}}, sum = 0;
  for (int q = 0; q < x->form.n; q++) {
    const gg_rough_index *index = &x->relative.f.function[x->form.function[q]];
    int degree = gg_rough_degree(*index);
    part[0][degree] += some(q) * function_at(index, one);
    part[1][degree] += some(q) * function_at(index, two);
  }
  for (int k = 0; k <= 3; k++)
    for (int l = 0; k + l <= 3; l++) sum += part[0][k] * part[1][l];
  return sum;
}

static void standard(gg_vec C, gg_vec s, double x[6])
{
  double y[6] = {C.x, C.y, C.z, s.x, s.y, s.z - skewed.spin};
  for (int k = 0; k < 2; k++) {
    const double(*A)[3] = k ? skewed.S : skewed.L;
    for (int i = 0; i < 3; i++) {
      x[3 * k + i] = y[3 * k + i];
      for (int j = 0; j < i; j++) x[3 * k + i] -= A[i][j] * x[3 * k + j];
      x[3 * k + i] /= A[i][i];
    }
  }
}

static gg_vec stretched(const double A[3][3], const double *x, double z)
{
  double y[3];
  for (int i = 0; i < 3; i++) y[i] = A[i][0] * x[0] + A[i][1] * x[1] + A[i][2] * x[2];
  return (gg_vec){y[0], y[1], y[2] + z};
}

/* k = z, for which L^T k is along z as well: the third coordinate of d is the normal one. */
static void add_pair(const fixture *x, const gg_contact *contact, const double d[3], const double rest[9], double w,
                     double *R)
{
  double one[6], two[6], value[6][4], other[6][4], after[6][4];
  for (int i = 0; i < 3; i++) {
    one[i] = (rest[i] + d[i]) * M_SQRT1_2, two[i] = (rest[i] - d[i]) * M_SQRT1_2;
    one[3 + i] = (rest[3 + i] + rest[6 + i]) * M_SQRT1_2, two[3 + i] = (rest[3 + i] - rest[6 + i]) * M_SQRT1_2;
  }
  gg_vec k = {0, 0, 1}, C1 = stretched(skewed.L, one, 0), C2 = stretched(skewed.L, two, 0);
  gg_vec s1 = stretched(skewed.S, one + 3, skewed.spin), s2 = stretched(skewed.S, two + 3, skewed.spin);
  values_at(one, value), values_at(two, other);
  gg_vec g = gg_contact_velocity(GG_ROUGH, k, gg_sub(C1, C2), s1, s2);
  double gn = gg_dot(k, g);
  w *= gn * pair_density(x, value, other);
  gg_kick(GG_ROUGH, contact, k, gg_impulse(GG_ROUGH, contact, k, g, gn), &C1, &s1, &C2, &s2);
  standard(C1, s1, one);
  values_at(one, after);
  for (int r = 1; r < x->form.n; r++) {
    const gg_rough_index *index = &x->relative.f.function[x->form.function[r]];
    if (gg_rough_degree(*index) <= 2) R[r] += w * (function_at(index, after) - function_at(index, value));
  }
}

static void brute_force(void **state)
{
  (void)state;
  gg_contact contact = gg_common_contact_make((gg_partner){1, inertia}, (gg_partner){1, inertia}, 0.7, 0.4, INFINITY);
  gg_rough_gas gas = gas_of(0.7, 0.4, 0);
  fixture x = make(&gas, &skewed, 3, true);
  double a[22], R[22] = {0}, plain[22] = {0};
  assert_int_equal(x.form.n, 22);
  for (int q = 0; q < x.form.n; q++) a[q] = some(q);
  gg_rough_form_add(&x.form, 1, a, R, NULL);
  grid g;
  gg_error err;
  assert_int_equal(gg_hermite_rule(POINTS, g.x, g.w, &err), GG_OK);
  assert_int_equal(gg_hermite_legendre_rule(APPROACH, g.u, g.wu, &err), GG_OK);
  int many = 1;
  double largest = 0;
  for (int i = 0; i < AXES; i++) many *= POINTS;
  for (int p = 0; p < many; p++) {
    double at[AXES], w = 4 * M_PI;
    for (int i = 0, code = p; i < AXES; i++, code /= POINTS) at[i] = g.x[code % POINTS], w *= g.w[code % POINTS];
    for (int u = 0; u < APPROACH; u++) {
      double d[3] = {at[9], at[10], 9 * g.u[u]};
      add_pair(&x, &contact, d, at, w * 9 * g.wu[u] * exp(-d[2] * d[2] / 2) / sqrt(2 * M_PI), plain);
    }
  }
  for (int r = 1; r < x.form.n; r++) {
    if (gg_rough_degree(x.relative.f.function[x.form.function[r]]) > 2) continue;
    if (!(fabs(R[r] - plain[r]) < 1e-8)) fail_msg("R_%d = %.12g, brute force %.12g", r, R[r], plain[r]);
    largest = fmax(largest, fabs(plain[r]));
  }
  assert_true(largest > 0.1);
  clear(&x);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(maxwellian_is_a_fixed_point),
      cmocka_unit_test(elastic_operator_is_symmetric),
      cmocka_unit_test(elastic_collisions_keep_energy),
      cmocka_unit_test(degree_two_is_the_gaussian_closure),
      cmocka_unit_test(degree_two_cools_like_two_maxwellians),
      cmocka_unit_test(brute_force),
      cmocka_unit_test(isotropic_weights_factor),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
