/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Proves: errors of profiles between walls are true where a dense core wanders slowly: over seeds the profiles scatter
 * as much as is stated. Without the modes across the gap, and without folding, velocities scattered by some six errors.
 * A window that is too short for the slowest of these modes is not called steady. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>
#include <math.h>
#include <string.h>

#include "graingas.h"
#include "run/run.h"
#include "scene/scene.h"

enum { SEEDS = 16, MOST = 80 };

static gg_result *wide_gap(double collisions, uint64_t seed)
{
  gg_scene s = gg_scene_defaults();
  s.engine = GG_MD, s.flow = GG_COUETTE, s.phi = 0.3, s.particles = 300, s.aspect[1] = 3;
  s.collision.e[0] = 0.7, s.collision.beta[0] = -1;
  s.run.collisions = collisions, s.run.warmup = 600, s.run.seed = seed;
  s.measure |= GG_MEASURE_PROFILES;
  gg_result *r = NULL;
  gg_error err = {0};
  if (gg_run_scene(&s, NULL, 1, NULL, &r, &err) != GG_OK) fail_msg("%s", err.message);
  return r;
}

static void true_errors(void **state)
{
  (void)state;
  static const char *const names[] = {"profile_solid_fraction", "profile_velocity", "profile_temperature"};
  static double sum[3][MOST], squares[3][MOST], errors[3][MOST];
  size_t n = 0;
  for (int seed = 1; seed <= SEEDS; seed++) {
    gg_result *r = wide_gap(4000, (uint64_t)seed);
    for (int k = 0; k < 3; k++) {
      const gg_curve *c = NULL;
      for (int i = 0; i < r->curves.n; i++)
        if (strcmp(r->curves.curve[i].name, names[k]) == 0) c = &r->curves.curve[i];
      assert_non_null(c);
      n = c->n;
      for (size_t i = 0; i < n; i++) {
        sum[k][i] += c->value[i], squares[k][i] += c->value[i] * c->value[i];
        errors[k][i] += c->error[i] * c->error[i];
      }
    }
    gg_result_free(r);
  }
  for (int k = 0; k < 3; k++) {
    double z2 = 0, points = 0;
    for (size_t i = 2; i + 2 < n; i++, points++) /* the outermost slabs hold few grains */
      z2 += (squares[k][i] - sum[k][i] * sum[k][i] / SEEDS) / (SEEDS - 1) / (errors[k][i] / SEEDS);
    z2 /= points;
    print_message("# %s: variance over seeds over error^2 %.2f\n", names[k], z2);
    const double four_errors = 4 * sqrt(2.0 / (SEEDS - 1)); /* as if all points moved together */
    assert_true(z2 > 0.4 && z2 < 1 + four_errors);
  }
}

static void a_window_shorter_than_the_slow_modes_is_not_steady(void **state)
{
  (void)state;
  gg_result *r = wide_gap(2100, 1);
  print_message("# %s\n", r->steadiness_text);
  assert_int_equal(r->steadiness, GG_NOT_STEADY);
  gg_result_free(r);
}

int main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test(true_errors),
                                     cmocka_unit_test(a_window_shorter_than_the_slow_modes_is_not_steady)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
