/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Collisions of frictional grains on Hermite functions: the closed operator where no contact slides, degree 2 as in the
 * Gaussian closure and in two Maxwellians, and solutions against Monte Carlo runs. */
#include "theory_test.h"

#include "theory/hermite/contact_integral.h"
#include "theory/rough/friction.h"
#include "theory/rough/friction_points.h"
#include "theory/rough/steady.h"
#include "theory/rough/turn.h"
#include "theory/two_maxwellian.h"

static const double inertia = 0.4;

static const gg_rough_weight skewed = {
    .L = {{1.2, 0, 0}, {-0.4, 0.8, 0}, {0, 0, 0.9}}, .S = {{0.7, 0, 0}, {0.2, 0.5, 0}, {0, 0, 0.6}}, .spin = -0.3};

static gg_rough_gas gas_of(double e, double beta, double mu, double shear)
{
  gg_contact c = gg_common_contact_make((gg_partner){1, inertia}, (gg_partner){1, inertia}, e, beta, mu);
  return (gg_rough_gas){.frequency = 1, .eta1 = c.jn, .eta2 = c.jt, .mu = mu, .K = inertia, .shear = shear};
}

static gg_rough_relative relative_of(const gg_rough_gas *gas, const gg_rough_weight *w, int degree, bool one_direction)
{
  gg_rough_relative r;
  gg_error err;
  if (gg_rough_relative_make(&r, gas, w, degree, one_direction, &err) != GG_OK) fail_msg("%s", err.message);
  return r;
}

static double largest_difference(const gg_rough_relative *a, const gg_rough_relative *b, double *largest)
{
  double most = 0;
  *largest = 0;
  for (int R = 0; R < a->f.n; R++)
    for (int S = 0; S < a->f.n; S++) {
      const double one = gg_rough_relative_at(a, R, S), two = gg_rough_relative_at(b, R, S);
      assert_true(isfinite(one) && isfinite(two)); /* fmax leaves out NaN */
      most = fmax(most, fabs(one - two)), *largest = fmax(*largest, fabs(one));
    }
  for (int S = 0; S < a->f.n; S++) {
    most = fmax(most, fabs(a->rate[S] - b->rate[S]));
    for (int i = 0; i < 9; i++) most = fmax(most, fabs(a->J[i / 3][i % 3][S] - b->J[i / 3][i % 3][S]));
  }
  return most;
}

/* Along one direction, element by element: isotropic (exact) and skewed weights with a mean spin. With the larger mu
 * the angle at which contacts begin to slide rounds to pi/2, and the powers of their impulse overflow. */
static void sticks_without_end_of_friction(void **state)
{
  (void)state;
  gg_rough_weight isotropic = {.spin = 0};
  for (int i = 0; i < 3; i++) isotropic.L[i][i] = 1, isotropic.S[i][i] = 1.3;
  for (int i = 0; i < 4; i++) {
    const bool skew = i % 2;
    const double mu = i < 2 ? 1e13 : 1e200;
    const gg_rough_weight *w = skew ? &skewed : &isotropic;
    const gg_rough_gas slides = gas_of(0.7, -0.2, mu, 0), sticks = gas_of(0.7, -0.2, INFINITY, 0);
    gg_rough_relative a = relative_of(&slides, w, 4, true), b = relative_of(&sticks, w, 4, true);
    double largest;
    const double most = largest_difference(&a, &b, &largest);
    assert_true(largest > 5);
    if (!(most < (skew ? 3e-6 : 1e-9))) fail_msg("skewed %d, mu %g: %g of %g", skew, mu, most, largest);
    gg_rough_relative_clear(&a);
    gg_rough_relative_clear(&b);
  }
}

/* All directions, with flow between the centres, by the rule in k of the closed operator. */
static void sticks_in_all_directions(void **state)
{
  (void)state;
  enum { POLAR = 8, AZIMUTH = 12 };
  const gg_rough_gas slides = gas_of(0.7, -0.2, 1e9, 0.8), sticks = gas_of(0.7, -0.2, INFINITY, 0.8);
  gg_rough_relative a = relative_of(&slides, &skewed, 3, false), b = relative_of(&sticks, &skewed, 3, false);
  gg_rough_friction *friction;
  gg_error err;
  double largest;
  /* The operator's own rule is coarse: a half percent for a weight that is as skewed as this. */
  const double coarse = largest_difference(&a, &b, &largest);
  assert_true(coarse < 0.007 * largest);
  memset(a.W, 0, (size_t)(a.f.n * a.f.n) * sizeof *a.W);
  memset(a.rate, 0, 10 * (size_t)a.f.n * sizeof *a.rate);
  gg_rough_sums sums = {a.W, a.rate, a.J};
  double z[POLAR], w[POLAR];
  assert_int_equal(gg_hermite_legendre_rule(POLAR, z, w, &err), GG_OK);
  assert_int_equal(gg_rough_friction_make(&friction, &a.f, false, &err), GG_OK);
  for (int n = 0; n < POLAR / 2 * AZIMUTH; n++) {
    const int i = POLAR / 2 + n / AZIMUTH;
    const double kz = 2 * z[i] - 1, angle = M_PI * (n % AZIMUTH + 0.5) / AZIMUTH, s = sqrt(1 - kz * kz);
    const double k[3] = {s * cos(angle), s * sin(angle), kz}, solid_angle = 8 * w[i] * M_PI / AZIMUTH;
    assert_int_equal(gg_rough_friction_add(friction, &slides, &skewed, k, solid_angle, &sums, &err), GG_OK);
  }
  gg_rough_friction_free(friction);
  const double most = largest_difference(&a, &b, &largest);
  if (!(most < 2e-6 * largest)) fail_msg("%g of %g", most, largest);
  gg_rough_relative_clear(&a);
  gg_rough_relative_clear(&b);
}

/* A rotation and its inverse leave all as it was; of degree 1 it is the rotation itself. */
static void turns_and_returns(void **state)
{
  (void)state;
  enum { DEGREE = 5 };
  gg_rough_functions f;
  gg_rough_turn turn;
  gg_error err;
  assert_int_equal(gg_rough_functions_make(&f, DEGREE, &err), GG_OK);
  assert_int_equal(gg_rough_turn_make(&turn, &f, &err), GG_OK);
  const gg_rough_gas gas = gas_of(0.8, 0.3, 0.2, 0.5);
  const double k[3] = {0.48, 0.6, 0.64};
  const gg_rough_frame frame = gg_rough_frame_of(&gas, &skewed, k);
  double back[GG_ROUGH_AXES][GG_ROUGH_AXES], *x = calloc((size_t)f.n, sizeof *x);
  for (int i = 0; i < 36; i++) back[i / 6][i % 6] = frame.Y[i % 6][i / 6];
  for (int q = 0; q < f.n; q++) x[q] = sin(q + 1.);
  gg_rough_turn_set(&turn, frame.Y);
  gg_rough_turn_rows(&turn, x, 1);
  for (int z = 0; z < GG_ROUGH_AXES; z++) {
    double expected = 0;
    for (int y = 0; y < GG_ROUGH_AXES; y++) expected += frame.Y[y][z] * sin(f.up[0][y] + 1.);
    assert_close(x[f.up[0][z]], expected, 1e-12);
  }
  gg_rough_turn_set(&turn, (const double(*)[GG_ROUGH_AXES])back);
  gg_rough_turn_rows(&turn, x, 1);
  for (int q = 0; q < f.n; q++) assert_true(fabs(x[q] - sin(q + 1.)) < 1e-12);
  free(x);
  gg_rough_turn_clear(&turn);
  gg_rough_functions_clear(&f);
}

/* Degree 2 at rest: the ratio of two Maxwellians. */
static void degree_two_is_two_maxwellians(void **state)
{
  (void)state;
  gg_rough_gas gas = gas_of(0.8, 0.2, 0.15, 0);
  gg_grain grain = {gas.eta1, gas.eta2, gas.K};
  const double ratio = gg_theory_ratio_driven(grain, gas.mu);
  gg_rough_steady s = {.choice = {.width = 1, .spin_width = 1}, .gas = gas};
  for (int i = 0; i < 3; i++) s.weight.S[i][i] = sqrt(ratio / inertia);
  gg_model m = model_for(GG_HSS, 0, 0.8, 0.2);
  const gg_heating heating = gg_theory_heating_of(&m);
  double x;
  gg_error err;
  if (gg_rough_isotropic_solve(&s, 2, &heating, &x, &err) != GG_OK) fail_msg("%s", err.message);
  for (int q = 1; q < s.form.n; q++) assert_true(fabs(s.a[q]) < 1e-9);
  gg_rough_steady_clear(&s);
}

static gg_theory_answer solved(gg_flow flow, double phi, double e, double beta, double mu)
{
  gg_scene s = scene_of(flow, phi, e, beta);
  for (int p = 0; p < GG_PAIRS; p++) s.collision.mu[p] = mu;
  if (flow == GG_HSS) s.thermostat = GG_WHITE_NOISE;
  if (flow == GG_SMALL_SHEAR) s.thermostat = GG_GAUSSIAN;
  gg_model m = model_of(&s);
  return answer_of(&gg_theory_enskog_hermite, &m);
}

/* Within 2.5 errors, its own and that of the run; its own error is no larger than it says in the documents. */
static void check_run(const char *what, double value, double error, double run, double error_of_run, double most)
{
  if (!(fabs(value - run) < 2.5 * hypot(error, error_of_run)))
    fail_msg("%s %.8g +- %.2g, run %.8g +- %.2g", what, value, error, run, error_of_run);
  if (!(error < most * fabs(value))) fail_msg("%s: error %.2g of %.3g", what, error, value);
}

/* dsmc with 20 000 grains: T, theta/T, -P_xy with standard errors; made by another program of the same equation. */
static void sheared_grains(void **state)
{
  (void)state;
  static const struct {
    double phi, e, beta, mu, run[3], error[3];
  } known[] = {
      {0, 0.9, 0, 0.1, {0.09527, 0.109225, 0.044746}, {2e-5, 1.1e-5, 1.3e-5}},
      {0.3, 0.9, 0.5, 0.5, {0.39556, 0.42925, 0.30216}, {1e-4, 6e-5, 8e-5}},
      {0.5, 0.7, 0.5, 0.3, {0.13972, 0.36644, 0.7757}, {3e-5, 8e-5, 2e-4}},
  };
  for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
    gg_theory_answer a = solved(GG_USF, known[i].phi, known[i].e, known[i].beta, known[i].mu);
    const gg_quantity q[] = {GG_Q_TEMPERATURE, GG_Q_TEMPERATURE_RATIO, GG_Q_P_XY};
    for (int k = 0; k < 3; k++)
      check_run("sheared", fabs(a.value[q[k]]), a.error[q[k]], known[i].run[k], known[i].error[k], 0.004);
  }
}

/* Heated by white noise: theta/T and kurtosis of the spins. */
static void heated_grains(void **state)
{
  (void)state;
  static const struct {
    double e, beta, mu, ratio, ratio_error, kurtosis, kurtosis_error;
  } known[] = {{0.9, 0, 0.01, 0.012141, 1e-5, 3.0256, 0.0013},
               {0.9, 1, 0.5, 0.52260, 2.4e-4, 3.0979, 0.0010},
               {0.5, 0.5, 0.5, 0.32862, 1.7e-4, 3.1008, 0.0016}};
  for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
    gg_theory_answer a = solved(GG_HSS, 0, known[i].e, known[i].beta, known[i].mu);
    check_run("theta/T", a.value[GG_Q_TEMPERATURE_RATIO], a.error[GG_Q_TEMPERATURE_RATIO], known[i].ratio,
              known[i].ratio_error, 5e-4);
    check_run("kurtosis", a.value[GG_Q_KURTOSIS_WX], a.error[GG_Q_KURTOSIS_WX], known[i].kurtosis,
              known[i].kurtosis_error, 0.002);
  }
}

/* dsmc with 10 000 grains, Gaussian thermostat, shear rates up to 0.03, extrapolated to none. */
static void heated_grains_under_slow_shear(void **state)
{
  (void)state;
  static const struct {
    double phi, e, beta, mu, run, error;
  } known[] = {{0.2, 0.9, 0.2, 0.2, 2.7609, 0.0065}, {0.3, 0.7, -0.5, 0.5, 4.1761, 0.0094}};
  for (size_t i = 0; i < 2; i++) {
    gg_theory_answer a = solved(GG_SMALL_SHEAR, known[i].phi, known[i].e, known[i].beta, known[i].mu);
    check_run("viscosity", a.value[GG_Q_VISCOSITY_REDUCED], a.error[GG_Q_VISCOSITY_REDUCED], known[i].run,
              known[i].error, 0.008);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(sticks_without_end_of_friction),
      cmocka_unit_test(sticks_in_all_directions),
      cmocka_unit_test(turns_and_returns),
      cmocka_unit_test(degree_two_is_two_maxwellians),
      cmocka_unit_test(sheared_grains),
      cmocka_unit_test(heated_grains),
      cmocka_unit_test(heated_grains_under_slow_shear),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
