/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Proves: where a run stops by an error, the mean square of deviations over stated errors is 1, for errors that take
 * 40, 80 and 160 correlation times (before the estimate's own doubt and its being picked were allowed for: 1.2); and
 * such a run is not much longer than that takes. The runs are whole ones, of the product's own loop, on an engine whose
 * mean and correlation time are known. 160 correlation times nightly. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>
#include <math.h>
#include <stdlib.h>

#include "fake_engine.h"
#include "graingas.h"
#include "run/run.h"

enum { RUNS = 700, MEMORY = 10 }; /* decay time of the noise, collisions a grain */

/* One run: its deviation in errors, squared; its averaging, in collisions a grain. */
static double run_of(const gg_scene *scene, double *length)
{
  gg_result *r = NULL;
  gg_error err;
  if (gg_run_scene(scene, NULL, 1, NULL, &r, &err) != GG_OK) fail_msg("%s", err.message);
  const gg_estimate *T = &r->value[GG_Q_TEMPERATURE];
  double z = (T->mean - fake.T) / T->error;
  assert_true(T->error <= scene->run.until[GG_Q_TEMPERATURE] * T->mean);
  *length += 2 * (double)r->averaging.collisions / (double)scene->particles;
  gg_result_free(r);
  return z * z;
}

static void errors_at_the_end(void **state)
{
  (void)state;
  double all = 0;
  const int most = getenv("NIGHTLY") ? 160 : 80, lengths = most == 160 ? 3 : 2;
  for (int need = 40; need <= most; need *= 2) {
    gg_scene s = planted_scene(-1);
    s.particles = 8;
    s.run.until[GG_Q_TEMPERATURE] = fake.noise * sqrt(2.0 / need);
    double z2 = 0, length = 0;
    for (int k = 0; k < RUNS; k++) {
      s.run.seed = 1000 * (uint64_t)need + (uint64_t)k;
      z2 += run_of(&s, &length) / RUNS;
    }
    length /= (double)need * MEMORY * RUNS;
    print_message("# %d correlation times needed: z^2 %.3f, %.2f times as long\n", need, z2, length);
    assert_true(need < 80 || length < 2.6);
    all += z2 / lengths;
  }
  assert_true(fabs(all - 1) < (lengths == 3 ? 0.13 : 0.16)); /* four standard errors of so many runs */
}

int main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test(errors_at_the_end)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
