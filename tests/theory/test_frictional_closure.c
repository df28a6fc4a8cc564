/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The Gaussian closure with Coulomb friction: limits, steady states everywhere, and near Monte Carlo solutions. */
#include "theory_test.h"

#include "theory/gaussian_moments.h"
#include "theory/two_maxwellian.h"

static gg_model with_friction(gg_model m, double mu)
{
  for (int p = 0; p < GG_PAIRS; p++) m.mu[p] = mu;
  gg_common_model_set_pairs(&m);
  return m;
}

static gg_theory_answer frictional(double phi, double e, double beta, double mu)
{
  gg_model m = with_friction(model_for(GG_USF, phi, e, beta), mu);
  return answer_of(&gg_theory_gaussian_closure, &m);
}

static const gg_quantity told[] = {GG_Q_TEMPERATURE, GG_Q_TEMPERATURE_RATIO, GG_Q_PRESSURE, GG_Q_P_XY,
                                   GG_Q_COLLISION_RATE};
enum { TOLD = sizeof told / sizeof *told };

static double off(const gg_theory_answer *a, const gg_theory_answer *b)
{
  double most = fmax(fabs(a->value[GG_Q_N1] - b->value[GG_Q_N1]), fabs(a->value[GG_Q_N2] - b->value[GG_Q_N2]));
  for (int i = 0; i < TOLD; i++) most = fmax(most, fabs(a->value[told[i]] / b->value[told[i]] - 1));
  return most;
}

/* With more and more friction no contact slides. */
static void sticks_without_end_of_friction(void **state)
{
  (void)state;
  const double phi[] = {0, 0.05, 0.3, 0.5}, e[] = {0.95, 0.8, 0.6}, beta[] = {-0.7, 0, 1};
  for (int i = 0; i < 36; i += 5) {
    gg_theory_answer a = frictional(phi[i % 4], e[i / 4 % 3], beta[i / 12], 1e7);
    gg_theory_answer b = frictional(phi[i % 4], e[i / 4 % 3], beta[i / 12], INFINITY);
    if (!(off(&a, &b) < 1e-6)) fail_msg("phi %g e %g beta %g: %g", phi[i % 4], e[i / 4 % 3], beta[i / 12], off(&a, &b));
  }
}

/* T approaches that of smooth grains in proportion to mu, theta/T approaches 0 so. */
static void is_smooth_without_friction(void **state)
{
  (void)state;
  for (double phi = 0; phi < 0.5; phi += 0.2) {
    gg_model smooth = model_for(GG_USF, phi, 0.8, -1);
    const double T = value_of(&gg_theory_gaussian_closure, &smooth, GG_Q_TEMPERATURE);
    gg_theory_answer small = frictional(phi, 0.8, 0.3, 1e-5), smaller = frictional(phi, 0.8, 0.3, 1e-6);
    assert_close(T / small.value[GG_Q_TEMPERATURE] - 1, 10 * (T / smaller.value[GG_Q_TEMPERATURE] - 1), 0.02);
    assert_true(T / small.value[GG_Q_TEMPERATURE] - 1 > 0);
    assert_close(smaller.value[GG_Q_TEMPERATURE], T, 1e-4);
    assert_close(small.value[GG_Q_TEMPERATURE_RATIO], 10 * smaller.value[GG_Q_TEMPERATURE_RATIO], 1e-3);
  }
}

/* At rest the moments are the two temperatures, whose exchange is known in closed form; one direction is as good as
 * the sphere, which a hardly noticeable mean spin demands. */
static void exchanges_as_two_maxwellians(void **state)
{
  (void)state;
  const double mu[] = {0.02, 0.2, 2}, ratio[] = {0.01, 0.4, 3};
  for (int i = 0; i < 9; i++) {
    gg_model m = with_friction(model_for(GG_HCS, 0.2, 0.8, 0.3), mu[i / 3]);
    const double r = ratio[i % 3], K = 0.4;
    gg_gaussian s[1] = {
        {.M = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, .Theta = {{{r / K, 0, 0}, {0, r / K, 0}, {0, 0, r / K}}}}};
    const gg_exchange x = gg_theory_exchange_at(gg_theory_grain_of(&m), mu[i / 3], r);
    for (int sphere = 0; sphere < 2; sphere++) {
      gg_gaussian_rates at;
      s[0].spin = sphere ? 1e-12 : 0;
      gg_theory_gaussian_rates_at(&m, s, &at);
      assert_close(gg_tensor_trace(at.change[0].M), at.frequency[0] * x.translation, 1e-6);
      assert_close(K * gg_tensor_trace(at.change[0].Theta), at.frequency[0] * x.rotation, 1e-5);
      assert_close(2 * at.loss / m.density, -at.frequency[0] * (x.translation + x.rotation), 1e-6);
    }
  }
}

/* A number between a and b that looks random. */
static double between(double a, double b, int i, int which)
{
  return a + (b - a) * fmod((i + 1) * (which == 0   ? 0.7548776662
                                       : which == 1 ? 0.5698402910
                                                    : 0.6180339887 * which),
                            1);
}

static void is_steady_everywhere(void **state)
{
  (void)state;
  for (int i = 0; i < 15; i++) {
    const double phi = i % 4 == 0 ? 0 : between(0.001, 0.6, i, 0), e = between(0.3, 0.9999, i, 1);
    const double beta = between(-0.99, 1, i, 1.3), mu = exp(between(log(1e-4), log(1e3), i, 2.1));
    gg_model m = i % 3 ? model_for(GG_USF, phi, e, beta) : mixture_for(GG_USF, phi, e, beta, 8, 1.5, 1);
    m = with_friction(m, mu);
    gg_gaussian s[2];
    const double left = gg_theory_gaussian_steady(&m, s);
    if (!(left < 1e-9)) fail_msg("phi %g e %g beta %g mu %g: residual %g", phi, e, beta, mu, left);
  }
}

/* Two equal species are one, with a coefficient by pair; and without friction between unlike ones they are not. */
static void equal_species(void **state)
{
  (void)state;
  gg_theory_answer one = frictional(0.2, 0.8, 0.2, 0.3);
  gg_model m = with_friction(mixture_for(GG_USF, 0.2, 0.8, 0.2, 1, 1, 0.5), 0.3);
  gg_theory_answer two = answer_of(&gg_theory_gaussian_closure, &m);
  assert_true(off(&two, &one) < 1e-8);
  assert_close(two.value[GG_Q_SPIN_Z], one.value[GG_Q_SPIN_Z], 1e-8);
  m.mu[gg_pair(0, 1)] = INFINITY;
  gg_common_model_set_pairs(&m);
  two = answer_of(&gg_theory_gaussian_closure, &m);
  assert_true(off(&two, &one) > 0.01);
}

/* dsmc, 20 000 grains: T, theta/T, -P_xy; deviations of a Gaussian closure made independently, in 1e-4. */
static void against_enskog_simulations(void **state)
{
  (void)state;
  static const struct {
    double phi, e, beta, mu, T, ratio, stress, less[3];
  } known[] = {
      {0, 0.9, 0, 0.1, 0.09527, 0.109225, 0.044746, {201, 215, 199}},
      {0, 0.7, 0.5, 0.5, 0.025630, 0.37545, 0.015248, {450, 333, 448}},
      {0.1, 0.5, 0.3, 0.3, 0.49138, 0.27697, 0.046422, {248, 221, 200}},
      {0.3, 0.9, 0.5, 0.5, 0.39556, 0.42925, 0.30216, {153, 175, 148}},
      {0.5, 0.9, 0, 0.1, 0.40195, 0.11923, 1.2969, {28, 323, 30}},
  };
  for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
    gg_theory_answer a = frictional(known[i].phi, known[i].e, known[i].beta, known[i].mu);
    assert_close(a.value[GG_Q_TEMPERATURE] / known[i].T, 1 + 1e-4 * known[i].less[0], 1e-4);
    assert_close(a.value[GG_Q_TEMPERATURE_RATIO] / known[i].ratio, 1 + 1e-4 * known[i].less[1], 1e-4);
    assert_close(-a.value[GG_Q_P_XY] / known[i].stress, 1 + 1e-4 * known[i].less[2], 1e-4);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(sticks_without_end_of_friction),
      cmocka_unit_test(is_smooth_without_friction),
      cmocka_unit_test(exchanges_as_two_maxwellians),
      cmocka_unit_test(is_steady_everywhere),
      cmocka_unit_test(equal_species),
      cmocka_unit_test(against_enskog_simulations),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
