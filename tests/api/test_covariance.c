/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Covariances of the means of a run: those of a quantity with itself and with its parts, and against many seeds. */
#include "api_test.h"

#define CHEAP "{flow: usf, engine: dsmc, phi: 0.1, dsmc: {particles: 100}, run: {collisions: 1000, seed: %d}}"
enum { SEEDS = 200, N = 3 };

static gg_result *run_of(const char *yaml, const char *output)
{
  gg_error err;
  gg_scene *s = scene_of(yaml);
  gg_result *r = NULL;
  assert_ok(gg_run(s, &(gg_run_options){.size = sizeof(gg_run_options), .output = output}, &r, &err));
  gg_scene_free(s);
  return r;
}

static double covariance(const gg_result *r, const char *one, const char *other)
{
  gg_error err;
  double found = 0;
  assert_ok(gg_result_covariance(r, one, other, &found, &err));
  return found;
}

/* The covariance of a mean with itself is its squared error. Covariances are symmetric and within the errors, and eta =
 * |P_xy|/gamma has that of P_xy. */
static void covariances_meet_their_identities(void **state)
{
  (void)state;
  gg_error err;
  char yaml[200];
  snprintf(yaml, sizeof yaml, CHEAP, 1);
  gg_result *r = run_of(yaml, NULL);
  gg_measurement a, b;
  int pairs = 0;
  for (size_t i = 0; gg_result_at(r, i, &a, NULL) == GG_OK; i++)
    for (size_t j = 0; !isnan(a.mean) && gg_result_at(r, j, &b, NULL) == GG_OK; j++) {
      if (isnan(b.mean)) continue;
      const double both = covariance(r, a.name, b.name);
      assert_true(fabs(both) <= a.error * b.error * (1 + 1e-12) && both == covariance(r, b.name, a.name));
      if (i == j) assert_true(both == a.error * a.error);
      pairs++;
    }
  assert_true(pairs > 200);
  double eta, P_xy;
  assert_ok(gg_result_get(r, "shear_viscosity", NULL, &eta, &err));
  assert_ok(gg_result_get(r, "P_xy", NULL, &P_xy, &err));
  assert_true(fabs(covariance(r, "shear_viscosity", "P_xy") / (eta * P_xy) + 1) < 1e-6);
  gg_result_free(r);
}

/* Files of runs and comparisons keep the covariances, also when they are read and written again. */
static void files_keep_covariances(void **state)
{
  (void)state;
  gg_error err;
  char yaml[200];
  snprintf(yaml, sizeof yaml, CHEAP, 2);
  gg_result *r = run_of(yaml, "t_covariance.h5"), *back = NULL, *twice = NULL;
  assert_ok(gg_result_read("t_covariance.h5", &back, &err));
  assert_ok(gg_result_write(back, "t_again.h5", NULL, NULL, &err));
  assert_ok(gg_result_read("t_again.h5", &twice, &err));
  const double here = covariance(r, "P_xy", "pressure");
  assert_true(here == covariance(back, "P_xy", "pressure") && here == covariance(twice, "P_xy", "pressure"));
  gg_scene *s = scene_of("{flow: usf, phi: 0.05, particles: 100, collision: {beta: 0}, run: {collisions: 300}}");
  gg_comparison *c = NULL, *read = NULL;
  gg_status status = gg_compare(s, &(gg_run_options){.size = sizeof(gg_run_options), .output = "t_both.h5"}, &c, &err);
  assert_true(status == GG_OK || status == GG_FAILED);
  assert_ok(gg_comparison_read("t_both.h5", &read, &err));
  const double md = covariance(gg_comparison_result(c, "md"), "temperature", "pressure"),
               dsmc = covariance(gg_comparison_result(c, "dsmc"), "temperature", "pressure");
  assert_true(md > 0 && dsmc > 0 && md != dsmc);
  assert_true(md == covariance(gg_comparison_result(read, "md"), "temperature", "pressure"));
  assert_true(dsmc == covariance(gg_comparison_result(read, "dsmc"), "temperature", "pressure"));
  gg_comparison_free(c);
  gg_comparison_free(read);
  gg_result_free(r);
  gg_result_free(back);
  gg_result_free(twice);
  gg_scene_free(s);
}

/* A missing covariance is NaN, with the reason. */
static void a_missing_covariance_has_a_reason(void **state)
{
  (void)state;
  gg_error err;
  char yaml[200];
  double found = 1;
  snprintf(yaml, sizeof yaml, CHEAP, 3);
  gg_result *r = run_of(yaml, NULL);
  assert_refused(gg_result_covariance(r, "P_xy", "spin_z", &found, &err), "smooth");
  assert_true(isnan(found));
  found = 1;
  assert_refused(gg_result_covariance(r, "P_xz", "P_xy", &found, &err), "no quantity called 'P_xz'");
  assert_true(isnan(found));
  assert_refused(gg_result_covariance(r, "P_xy", NULL, &found, &err), "other");
  assert_refused(gg_result_covariance(r, "P_xy", "P_xy", NULL, &err), "covariance");
  gg_result_free(r);
}

/* The standard error of -P_xy/p and of p/T from the covariances of one run each: the mean square of deviation over
 * error is 1, and of independent means it would not be. The covariance is that
 * over the seeds, as well as the variances are. */
static void many_seeds(void **state)
{
  (void)state;
  static const char *const name[N] = {"P_xy", "pressure", "temperature"};
  static double mean[SEEDS][N], found[SEEDS][N][N];
  double centre[N] = {0}, seen[N][N] = {{0}}, claimed[N][N] = {{0}};
  gg_error err;
  for (int s = 0; s < SEEDS; s++) {
    char yaml[200];
    snprintf(yaml, sizeof yaml, CHEAP, s + 1);
    gg_result *r = run_of(yaml, NULL);
    for (int i = 0; i < N; i++) {
      assert_ok(gg_result_get(r, name[i], &mean[s][i], NULL, &err));
      centre[i] += mean[s][i] / SEEDS;
      for (int j = 0; j < N; j++) found[s][i][j] = covariance(r, name[i], name[j]);
    }
    gg_result_free(r);
  }
  for (int s = 0; s < SEEDS; s++)
    for (int i = 0; i < N; i++)
      for (int j = 0; j < N; j++) {
        seen[i][j] += (mean[s][i] - centre[i]) * (mean[s][j] - centre[j]) / (SEEDS - 1);
        claimed[i][j] += found[s][i][j] / SEEDS;
      }
  for (int k = 0; k < 2; k++) {
    const int a = k, b = k + 1;
    double z2 = 0, independent = 0;
    for (int s = 0; s < SEEDS; s++) {
      const double x = mean[s][a], y = mean[s][b], deviation = x / y / (centre[a] / centre[b]) - 1;
      const double apart = found[s][a][a] / (x * x) + found[s][b][b] / (y * y);
      z2 += deviation * deviation / (apart - 2 * found[s][a][b] / (x * y)) / (SEEDS - 1);
      independent += deviation * deviation / apart / (SEEDS - 1);
    }
    const double r = seen[a][b] / sqrt(seen[a][a] * seen[b][b]),
                 ours = claimed[a][b] / sqrt(claimed[a][a] * claimed[b][b]);
    print_message("# %s/%s: z^2 %.3f (independent: %.3f); coefficient %.4f, over seeds %.4f; variances %.3f %.3f\n",
                  name[a], name[b], z2, independent, ours, r, claimed[a][a] / seen[a][a], claimed[b][b] / seen[b][b]);
    assert_true(fabs(z2 - 1) < 0.15 + 4 * sqrt(2.0 / SEEDS) && independent < 0.4);
    assert_true(fabs(claimed[a][b] / seen[a][b] - 1) < 0.15 + 4 * sqrt(2.0 / SEEDS));
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test(covariances_meet_their_identities),
                                     cmocka_unit_test(files_keep_covariances),
                                     cmocka_unit_test(a_missing_covariance_has_a_reason), cmocka_unit_test(many_seeds)};
  return cmocka_run_group_tests(tests, enter_folder, leave_folder);
}
