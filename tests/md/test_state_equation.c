/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Proves: the pressure of elastic grains at phi = 0.1 ... 0.45 is within four standard errors (below 0.1 %) of the
 * accurate equation of state (phi = 0.2 and 0.4 nightly). The mean free time is within four counting errors of the one
 * that follows from it, 1/(4 n chi sqrt(pi T/m)): 0.1302 at n = 0.5 (Lue, J. Chem. Phys. 122 (2005) 044513, has
 * 0.1303).
 *
 * Z is estimated as 1 + (N-1)/N x sum(sigma k.J)/(3 N T t) with 3 N T = sum m v^2; the factor (N-1)/N is there because
 * with zero total momentum there are 3(N-1) degrees of freedom. Errors are from blocks. */
#include <stdlib.h>

#include "md_test.h"

#include "common/contact_value.h"

enum { N = 4000, BLOCKS = 40 };

static void pressure_at(double phi)
{
  gg_model m = md_model((md_case){GG_EQUILIBRIUM, N, phi, 1, -1, INFINITY, {0}});
  gg_md *e = md_create(&m, 17);
  gg_collision_sums t;
  double sum = 0, squares = 0;
  md_collide(e, N * 50);
  gg_md_ops.take_sums(&e->base, &t);
  for (int b = 0; b < BLOCKS; b++) {
    double time = md_collide(e, N * 12);
    gg_md_ops.take_sums(&e->base, &t);
    double virial = t.stress[0][0][0] + t.stress[0][1][1] + t.stress[0][2][2];
    double Z = 1 + (N - 1.0) / N * virial / (3 * N * m.temperature0 * time);
    sum += Z, squares += Z * Z;
  }
  double Z = sum / BLOCKS, error = sqrt((squares / BLOCKS - Z * Z) / (BLOCKS - 1));
  double exact = gg_common_compressibility(GG_KOLAFA, phi);
  print_message("# phi %.2f: Z = %.5f +- %.5f, equation of state %.5f\n", phi, Z, error, exact);
  assert_true(error < 0.001 * exact);
  if (!(fabs(Z - exact) < 4 * error)) fail_msg("phi %g: Z = %.5f +- %.5f, not %.5f", phi, Z, error, exact);
  md_destroy(e);
}

static void pressure_has_the_equation_of_state(void **state)
{
  (void)state;
  static const double phis[] = {0.1, 0.2, 0.3, 0.4, 0.45};
  for (int k = 0; k < 5; k++)
    if (getenv("NIGHTLY") || k % 2 == 0) pressure_at(phis[k]);
}

static void mean_free_time_has_its_value(void **state)
{
  (void)state;
  const double phi = 0.5 * M_PI / 6, chi = (gg_common_compressibility(GG_KOLAFA, phi) - 1) / (4 * phi);
  const double exact = 1 / (4 * 0.5 * chi * sqrt(M_PI)) * sqrt((N - 1.0) / N); /* 3(N-1) degrees of freedom */
  gg_model m = md_model((md_case){GG_EQUILIBRIUM, N, phi, 1, -1, INFINITY, {0}});
  gg_md *e = md_create(&m, 19);
  md_collide(e, N * 20);
  uint64_t collisions = N * 500;
  double time = md_collide(e, collisions), t = time * N / (2 * (double)collisions) * sqrt(m.temperature0);
  print_message("# mean free time %.5f, equation of state %.5f\n", t, exact);
  assert_true(fabs(t - exact) < 4 / sqrt((double)collisions) * exact);
  md_destroy(e);
}

int main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test(pressure_has_the_equation_of_state),
                                     cmocka_unit_test(mean_free_time_has_its_value)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
