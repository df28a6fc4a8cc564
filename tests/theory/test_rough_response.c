/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Linear response of rough grains: collisions along one direction are those of the general operator; for smooth
 * grains, whose spins have no effect, heat flux and viscosity are known, also dense. */
#include "theory_test.h"

#include <stdlib.h>

#include "theory/hermite/heat.h"
#include "theory/hermite/viscosity.h"
#include "theory/rough/one_direction.h"
#include "theory/rough/response.h"

static const gg_rough_choice choice = {
    .width = GG_HERMITE_WIDTH, .spin_width = 1.3, .decay = GG_HERMITE_DECAY, .spin_decay = 0.1, .extra = 2};

static gg_rough_weight isotropic(double width, double ratio)
{
  gg_rough_weight w = {.spin = 0};
  for (int i = 0; i < 3; i++) w.L[i][i] = sqrt(width), w.S[i][i] = sqrt(ratio);
  return w;
}

/* Tests of degree 2 decay here, not in the general operator. */
static void one_direction_is_the_operator(void **state)
{
  (void)state;
  const gg_rough_gas gas = {.frequency = 1, .eta1 = 0.8, .eta2 = 0.3, .mu = INFINITY, .K = 0.4};
  const gg_rough_weight w = isotropic(1.1, 1.7);
  const gg_rough_choice slow = {.width = 1.1, .spin_width = 1.7, .decay = 0.04, .spin_decay = 0.03};
  gg_rough_relative relative;
  gg_rough_form form;
  gg_rough_direction d;
  gg_error err;
  double largest = 0;
  assert_int_equal(gg_rough_relative_isotropic(&relative, &gas, &w, 12, &err), GG_OK);
  assert_int_equal(gg_rough_form_make(&form, &relative, 4, false, &slow, &err), GG_OK);
  assert_int_equal(gg_rough_direction_make(&d, &gas, &w, &slow, 4, 5, &err), GG_OK);
  for (int p = 0; p < form.n_pairs; p++)
    for (int r = 1; r < form.n; r++) {
      const int *test = relative.f.function[form.function[r]].r,
                *one = relative.f.function[form.function[form.pair[p].one]].r,
                *two = relative.f.function[form.function[form.pair[p].two]].r;
      if (gg_rough_degree(relative.f.function[form.function[r]]) <= 2) continue;
      const gg_rough_term term = gg_rough_term_of(two, 1);
      double sum = gg_rough_direction_sum(&d, test, one, false, &term, 1);
      if (form.pair[p].one != form.pair[p].two) sum += gg_rough_direction_sum(&d, test, one, true, &term, 1);
      const double right = form.B[(size_t)p * (size_t)form.n + (size_t)r];
      largest = fmax(largest, fabs(right));
      if (!(fabs(sum - right) < 1e-5)) fail_msg("pair %d test %d: %.12g, not %.12g", p, r, sum, right);
    }
  assert_true(largest > 1);
  gg_rough_direction_clear(&d);
  gg_rough_form_clear(&form);
  gg_rough_relative_clear(&relative);
}

/* A cooling state of smooth grains, with uncoupled spins. */
static gg_rough_steady spinning(const gg_hermite_isotropic *h, int degree)
{
  static const gg_heating cools = {.kind = GG_HEATING_COOLS};
  gg_rough_steady s = {.choice = choice,
                       .gas = {.frequency = 0.9, .eta1 = 0.95, .eta2 = 0.2143, .mu = INFINITY, .K = 0.4},
                       .weight = isotropic(1.1, 2.8)};
  gg_error err;
  double x;
  if (gg_rough_isotropic_solve(&s, degree, &cools, &x, &err) != GG_OK) fail_msg("%s", err.message);
  s.gas.eta1 = h->gas.impact[0][0].eta, s.gas.eta2 = 0;
  s.choice.spin_decay = 0; /* tests without spins have no response of spins */
  for (int q = 0; q < s.form.n; q++) {
    const int *r = s.relative.f.function[s.form.function[q]].r;
    s.a[q] = r[3] + r[4] + r[5] ? 0 : h->state.a[gg_hermite_place(&h->op.basis, r[0], r[1], r[2])];
  }
  s.stream = (gg_rough_stream){.spin = -0.3}; /* no effect */
  for (int i = 0; i < 3; i++) s.stream.velocity[i][i] = -h->cooling_rate / 2;
  return s;
}

static const gg_hermite_density densities[] = {{0, 0}, {1.1, 1.6}};
static const gg_heating cools = {.kind = GG_HEATING_COOLS};

/* The same functions, by another method of integration. Daily a dilute gas that is elastic and a dense one that is not.
 */
static void smooth_grains_conduct(void **state)
{
  (void)state;
  for (int k = 0; k < 4; k += getenv("NIGHTLY") ? 1 : 3) {
    const gg_hermite_density d = densities[k / 2];
    gg_hermite_isotropic h;
    gg_hermite_heat smooth;
    gg_rough_heat heat;
    gg_error err;
    assert_int_equal(gg_hermite_isotropic_solve(&h, 8, 0.9, k % 2 ? 0.85 : 1, &cools, &err), GG_OK);
    gg_rough_steady s = spinning(&h, 8);
    assert_int_equal(gg_hermite_heat_of(&h, d, &smooth, &err), GG_OK);
    assert_int_equal(gg_rough_heat_of(&s, d, &heat, &err), GG_OK);
    assert_close(heat.conductivity_kinetic[0], smooth.conductivity_kinetic, 1e-9);
    assert_close(heat.conductivity[0], smooth.conductivity, 1e-9);
    if (k % 2) assert_close(heat.diffusive[0], smooth.diffusive, 1e-8);
    gg_rough_steady_clear(&s);
    gg_hermite_isotropic_end(&h);
  }
}

/* Tests of degree 2 decay here, not there, so that series differ by the omitted terms. Collisional transfer is
 * exact: a fraction of the kinetic stress, and of the rate of collisions. */
static void smooth_grains_flow(void **state)
{
  (void)state;
  for (int k = 0; k < 4; k += getenv("NIGHTLY") ? 1 : 3) {
    const double y = densities[k / 2].phi_chi, eta = k % 2 ? 0.85 : 1;
    gg_hermite_isotropic h;
    gg_hermite_viscosity smooth;
    gg_hermite_sums sums;
    gg_rough_viscosity v;
    gg_error err;
    assert_int_equal(gg_hermite_isotropic_solve(&h, 8, 0.9, eta, &cools, &err), GG_OK);
    gg_rough_steady s = spinning(&h, 8);
    h.gas.impact[0][0].sigma = 6 / M_PI * y / 0.9;
    assert_int_equal(gg_hermite_viscosity_of(&h.gas, &h.state, 8, y > 0, h.cooling_rate / 2, &smooth, &err), GG_OK);
    assert_int_equal(gg_rough_viscosity_of(&s, y, 1, &v, &err), GG_OK);
    assert_close(v.kinetic, smooth.kinetic, 5e-4);
    gg_hermite_sums_at(&h.op, &h.gas, &h.state, &sums);
    const double reach = 6 / M_PI * y / 0.9, carried = eta * reach * reach * sums.rate / 15;
    assert_close(v.total, v.kinetic * (1 + 1.6 * eta * y) + carried, 1e-9);
    gg_rough_steady_clear(&s);
    gg_hermite_isotropic_end(&h);
  }
}

/* By the operator of all directions, which friction has as well, and by collisions along one: the same products of
 * functions, and the same plain tests. */
static void slow_shear_is_the_response(void **state)
{
  (void)state;
  static const gg_heating stretches = {.kind = GG_HEATING_STRETCHES};
  const double rate = 1e-4, y = 1.1, reach = 6 / M_PI * y / 0.9;
  gg_rough_steady s = {.choice = {.width = 1, .spin_width = 1, .extra = 4},
                       .gas = {.frequency = 0.9, .eta1 = 0.9, .eta2 = 0.25, .mu = INFINITY, .K = 0.4},
                       .weight = isotropic(1, 0.7)};
  gg_rough_viscosity v;
  gg_error err;
  double x, M[3][3], transferred = 0;
  if (gg_rough_isotropic_solve(&s, 4, &stretches, &x, &err) != GG_OK) fail_msg("%s", err.message);
  gg_rough_steady slow = {.choice = s.choice, .gas = s.gas, .stream = s.stream};
  slow.stream.velocity[0][1] = rate, slow.gas.shear = reach * rate;
  assert_int_equal(gg_rough_viscosity_of(&s, y, 1, &v, &err), GG_OK);
  if (gg_rough_slow_shear_solve(&slow, &s, -s.stream.velocity[0][0], &err) != GG_OK) fail_msg("%s", err.message);
  gg_rough_covariance(&slow.form, &slow.relative.f, &slow.weight, slow.a, false, M);
  for (int i = 0; i < 2; i++) /* symmetric part: the mean spin differs from half the vorticity here */
    transferred += reach / 4 * slow.gas.frequency *
                   gg_rough_pair_mean(&slow.form, &slow.relative, slow.relative.J[i][1 - i], slow.a);
  assert_close(-M[0][1] / rate, v.kinetic, 1e-6);
  assert_close(-(M[0][1] + transferred) / rate, v.total, 1e-6);
  gg_rough_steady_clear(&slow);
  gg_rough_steady_clear(&s);
}

int main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test(one_direction_is_the_operator),
                                     cmocka_unit_test(smooth_grains_conduct), cmocka_unit_test(smooth_grains_flow),
                                     cmocka_unit_test(slow_shear_is_the_response)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
