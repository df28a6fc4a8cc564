/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Proves: runs that stop themselves, once their errors are as small as asked, state errors that are true: over many
 * seeds means scatter as much as their errors say, and as little as was asked. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>
#include <math.h>

#include "graingas.h"
#include "run/run.h"
#include "scene/scene.h"

enum { SEEDS = 100 };
#define ASKED 0.006

/* Standard deviation of (x - mean)/error over seeds, and of x itself relative to its mean. */
static void scatter(const double *x, const double *error, double *of_z, double *relative)
{
  double mean = 0, z2 = 0, x2 = 0;
  for (int i = 0; i < SEEDS; i++) mean += x[i] / SEEDS;
  for (int i = 0; i < SEEDS; i++) {
    double d = x[i] - mean;
    z2 += d * d / (error[i] * error[i]) / (SEEDS - 1);
    x2 += d * d / (SEEDS - 1);
  }
  *of_z = sqrt(z2);
  *relative = sqrt(x2) / fabs(mean);
}

static void errors_are_true(void **state)
{
  (void)state;
  static const gg_quantity quantities[] = {GG_Q_TEMPERATURE, GG_Q_SHEAR_VISCOSITY, GG_Q_TEMPERATURE_RATIO};
  double x[3][SEEDS], error[3][SEEDS];
  for (int seed = 0; seed < SEEDS; seed++) {
    gg_scene s = gg_scene_defaults();
    s.engine = GG_DSMC, s.phi = 0.05, s.run.relative_error = ASKED, s.run.seed = (uint64_t)seed + 1;
    s.collision.e[0] = 0.8, s.collision.beta[0] = 0;
    gg_result *r = NULL;
    gg_error err = {0};
    assert_int_equal(gg_run_scene(&s, NULL, 1, NULL, &r, &err), GG_OK);
    for (int k = 0; k < 3; k++) {
      x[k][seed] = r->value[quantities[k]].mean;
      error[k][seed] = r->value[quantities[k]].error;
    }
    gg_result_free(r);
  }
  for (int k = 0; k < 3; k++) {
    double of_z, relative;
    scatter(x[k], error[k], &of_z, &relative);
    print_message("# %s: z scatters by %.2f, runs by %.4f\n", gg_common_quantity_name(quantities[k]), of_z, relative);
    const double four_errors = 4 / sqrt(2.0 * SEEDS);
    assert_true(fabs(of_z - 1) < four_errors);
    assert_true(relative < ASKED * (1 + four_errors));
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test(errors_are_true)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
