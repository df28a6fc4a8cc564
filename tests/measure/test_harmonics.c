/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Proves: of a stress and a temperature that are given harmonics of the strain, the numbers are those harmonics, with
 * grains sampled at the ends of steps and collisions as means over steps; errors are those of the replicas. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "measure/harmonics.h"

enum { STEPS = 20, REPLICAS = 3 };

static const gg_curve_number *number(const gg_curve *c, const char *name)
{
  for (int k = 0; k < c->n_numbers; k++)
    if (strcmp(c->number[k].name, name) == 0) return &c->number[k];
  fail_msg("there is no %s", name);
  return NULL;
}

static void expect(const gg_curve *c, const char *name, double mean, double error)
{
  const gg_curve_number *n = number(c, name);
  if (!(fabs(n->value - mean) < 1e-12 && fabs(n->error - error) < 0.02 * error + 1e-12))
    fail_msg("%s is %.15g +- %g, expected %.15g +- %g", name, n->value, n->error, mean, error);
}

/* Mean of cos(h a + phase) over the step that ends at a. */
static double mean_over_step(int h, double a, double phase)
{
  const double step = 2 * M_PI / STEPS;
  return (sin(h * a + phase) - sin(h * (a - step) + phase)) / (h * step);
}

static void given_harmonics(void **state)
{
  (void)state;
  const double strain_1 = 1.5, G1 = 0.3, G2 = 0.7, third = 0.2;
  static double room[3 * (REPLICAS + 1) * STEPS], strain[STEPS];
  gg_cycle of[REPLICAS + 1];
  gg_model m = {.flow = GG_USF, .shear_rate = 1, .stress_unit = 1, .n_species = 1};
  for (int i = 0; i <= REPLICAS; i++) {
    const double size = i < REPLICAS ? 1 + 0.1 * (i - 1) : 1; /* replicas differ by a tenth, the theory is their mean */
    of[i] = (gg_cycle){room + 3 * i * STEPS, room + (3 * i + 1) * STEPS, room + (3 * i + 2) * STEPS};
    for (int j = 0; j < STEPS; j++) {
      const double a = 2 * M_PI * (j + 1) / STEPS;
      strain[j] = strain_1 * cos(a);
      /* sigma = G' strain - G'' strain_1 sin: the kinetic part has G', the collisional one the rest. */
      of[i].kinetic[j] = -size * G1 * strain[j];
      const double rest = mean_over_step(1, a, M_PI / 2) * G2 * strain_1 + mean_over_step(3, a, 0.4) * third;
      of[i].collisional[j] = -size * rest;
      of[i].T[j] = 2 + size * 0.5 * cos(2 * a - 0.3);
      if (i == REPLICAS) of[i].kinetic[j] -= G2 * strain_1 * cos(a + M_PI / 2) + third * cos(3 * a + 0.4);
      if (i == REPLICAS) of[i].collisional[j] = 0;
    }
  }
  const gg_oscillation o = {&m, "theory", STEPS, 4, 2 * M_PI, strain, REPLICAS, of};
  gg_curves list = {.model = &m};
  gg_error err = {0};
  assert_int_equal(gg_measure_harmonics(&o, &list, &err), GG_OK);
  assert_int_equal(list.n, 2);
  const double spread =
      0.1 / sqrt(3) * 1.875; /* of 0.9, 1, 1.1, and Student's factor of three numbers, 1 + 1/2 + 3/8 */
  const gg_curve *stress = &list.curve[0], *T = &list.curve[1];
  const double amplitude = strain_1 * hypot(G1, G2);
  expect(stress, "storage_modulus", G1, G1 * spread);
  expect(stress, "loss_modulus", G2, G2 * spread);
  expect(stress, "stress_amplitude", amplitude, amplitude * spread);
  expect(stress, "stress_phase", atan2(G2, G1), 0);
  expect(stress, "third_harmonic", third / amplitude, 0);
  expect(T, "mean_temperature", 2, 0);
  expect(T, "temperature_amplitude", 0.25, 0.25 * spread);
  expect(T, "temperature_phase", -0.3, 0);
  assert_true(fabs(number(stress, "strain_amplitude")->value - strain_1) < 1e-12);
  assert_true(fabs(number(stress, "loss_modulus_of_closure")->value - G2) < 1e-12);
  assert_true(fabs(number(stress, "third_harmonic_of_closure")->value - third / amplitude) < 1e-12);
  assert_int_equal(stress->n, STEPS + 1);
  assert_true(stress->x[0] == stress->x[STEPS] && stress->value[0] == stress->value[STEPS]); /* a closed loop */
  assert_true(fabs(T->x[STEPS] - 2 * M_PI) < 1e-12 && fabs(T->reference[1] - of[REPLICAS].T[0]) < 1e-12);
  gg_measure_curves_clear(&list);
}

int main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test(given_harmonics)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
