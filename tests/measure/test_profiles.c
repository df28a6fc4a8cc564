/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Profiles: planted flow, temperature and spin are recovered slab by slab, planted impulses as the stress on the
 * walls; for walls that are alike the curves are those of the flow and its image, also those of the walls' stress. A
 * Couette gas is antisymmetric, slips at its walls, exerts its own stress on them, and contains all of its grains. */
#include <stdio.h>

#include "curve_test.h"
#include "graingas.h"

static void planted(gg_snapshot *s, gg_rng *r, int sample)
{
  (void)sample;
  const double *L = s->model->box;
  for (size_t i = 0; i < s->n; i++) {
    for (int a = 0; a < 3; a++) s->r[a][i] = L[a] * gg_rng_uniform(r);
    double y = s->r[1][i] / L[1];
    for (int a = 0; a < 3; a++) {
      s->c[a][i] = sqrt(1 + y) * gg_common_rng_normal(r);
      s->s[a][i] = sqrt(0.5) * gg_common_rng_normal(r);
    }
    s->c[0][i] += 3 * y - 1;
    s->s[2][i] += y;
  }
}

static double flow(double y, const void *context)
{
  return 3 * y / *(const double *)context - 1;
}
static double warmth(double y, const void *context)
{
  return 1 + y / *(const double *)context;
}
static double turning(double y, const void *context)
{
  return 2 * y / *(const double *)context;
}
static double level(double y, const void *context)
{
  (void)y;
  return *(const double *)context;
}

static void planted_profiles(void **state)
{
  (void)state;
  gg_model m = ct_model(GG_COUETTE, 0.2, 0, 4000, 1);
  m.gravity[1] = -1; /* below differs from above: nothing is folded */
  gg_curves list = ct_curves(&gg_measure_profiles, &m, 64, planted, 91);
  double L = m.box[1], theta = 0.4 * 0.5, phi = 0.2;
  const struct {
    const char *name;
    double (*f)(double, const void *);
    const double *context;
  } cases[] = {{"profile_velocity", flow, &L},
               {"profile_temperature", warmth, &L},
               {"profile_spin_z", turning, &L},
               {"profile_rotational_temperature", level, &theta},
               {"profile_solid_fraction", level, &phi}};
  for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
    const gg_curve *c = ct_find(&list, cases[k].name);
    double chi2 = ct_chi2(c, 0, c->n, cases[k].f, cases[k].context);
    assert_true(chi2 > 0.4 && chi2 < 2);
    assert_true(c->error[5] < 0.02);
    assert_int_equal(c->n, 2 * round(L)); /* pairs of slabs, each half a diameter thick */
    assert_false(c->folded);
  }
  gg_curve_number p = ct_number(ct_find(&list, "profile_velocity"), "slip_upper");
  ct_expect("slip", p.value, p.error, m.surface[1].velocity.x - (3 * (L - 0.5) / L - 1), 0.1);
  p = ct_number(ct_find(&list, "profile_velocity"), "slope_middle");
  ct_expect("slope", p.value, p.error, 3 / L, 0.02);
  p = ct_number(ct_find(&list, "profile_temperature"), "middle");
  ct_expect("T of the middle", p.value, p.error, warmth(0.5 * L, &L), 0.04);
  gg_measure_curves_clear(&list);
}

static double centred(double y, const void *context)
{
  return 3 * (y / *(const double *)context - 0.5);
}
static double twice_centred(double y, const void *context)
{
  return 2 * (y / *(const double *)context - 0.5);
}

/* The same grains between walls that are alike. Half a turn keeps the part of the flow that is odd about the middle,
 * and the even part of the spin; a mirror the reverse. Temperatures are about the mean of both halves, from which
 * each differs by the part that was folded away: 1/2, for the spin y - 1/2. */
static void folded_profiles(void **state)
{
  (void)state;
  for (int turned = 0; turned < 2; turned++) {
    gg_model m = ct_model(turned ? GG_COUETTE : GG_POISEUILLE, 0.2, 0, 4000, 1);
    gg_curves list = ct_curves(&gg_measure_profiles, &m, 96, planted, 91);
    double L = m.box[1], half = 0.5, one = 1, T = 1.5 + 0.25 / 3, phi = 0.2;
    const struct {
      const char *name;
      double (*f)(double, const void *), sign;
      const double *context;
    } turn[] = {{"profile_velocity", centred, -1, &L},
                {"profile_spin_z", level, 1, &one},
                {"profile_temperature", level, 1, &T},
                {"profile_solid_fraction", level, 1, &phi}},
      mirror[] = {{"profile_velocity", level, 1, &half},
                  {"profile_spin_z", twice_centred, -1, &L},
                  {"profile_solid_fraction", level, 1, &phi}};
    for (size_t k = 0; k < (turned ? sizeof turn / sizeof *turn : sizeof mirror / sizeof *mirror); k++) {
      const gg_curve *c = ct_find(&list, (turned ? turn : mirror)[k].name);
      double chi2 = ct_chi2(c, 0, c->n, (turned ? turn : mirror)[k].f, (turned ? turn : mirror)[k].context);
      assert_true(chi2 > 0.4 && chi2 < 2);
      assert_true(c->folded && c->error[5] < 0.02);
      for (size_t i = 0; i < c->n; i++) {
        double sign = (turned ? turn : mirror)[k].sign;
        assert_true(fabs(c->value[i] - sign * c->value[c->n - 1 - i]) < 1e-12);
        assert_true(fabs(c->error[i] / c->error[c->n - 1 - i] - 1) < 1e-6);
      }
    }
    gg_measure_curves_clear(&list);
  }
}

/* The whole gas oscillates along the walls, with a memory of a third of the window: blocks contain next to no
 * information about it, and errors that include it are guesses (for unfolded velocities too small by four on
 * average). The oscillation is odd, and folded profiles do not contain it. */
static double carried;

static void wandering(gg_snapshot *s, gg_rng *r, int sample)
{
  enum { MEMORY = 40 };
  const double *L = s->model->box, rho = exp(-1.0 / MEMORY);
  carried = sample == 0 ? gg_common_rng_normal(r) : rho * carried + sqrt(1 - rho * rho) * gg_common_rng_normal(r);
  for (size_t i = 0; i < s->n; i++) {
    for (int a = 0; a < 3; a++) s->r[a][i] = L[a] * gg_rng_uniform(r);
    for (int a = 0; a < 3; a++) s->c[a][i] = gg_common_rng_normal(r);
    s->c[0][i] += 3 * (s->r[1][i] / L[1] - 0.5) + carried;
  }
}

static void errors_where_the_gas_wanders(void **state)
{
  (void)state;
  enum { REPEATS = 32, SAMPLES = 124 };
  double chi2[2] = {0}; /* unfolded, folded */
  for (int folded = 0; folded < 2; folded++)
    for (uint64_t k = 0; k < REPEATS; k++) {
      gg_model m = ct_model(GG_COUETTE, 0.2, -1, 400, 1);
      if (!folded) m.gravity[1] = -1;
      gg_curves list = ct_curves(&gg_measure_profiles, &m, SAMPLES, wandering, 200 + k);
      const gg_curve *c = ct_find(&list, "profile_velocity");
      for (size_t i = 0; i < c->n; i++)
        chi2[folded] += pow((c->value[i] - centred(c->x[i], &m.box[1])) / c->error[i], 2) / (REPEATS * (double)c->n);
      gg_measure_curves_clear(&list);
    }
  print_message("# chi^2/points: %.2f folded, %.2f unfolded\n", chi2[1], chi2[0]);
  assert_true(fabs(chi2[1] - 1.15) < 0.25 && chi2[0] > 2); /* 15 blocks make 15/13 */
}

/* Walls that receive known impulses in known times: the stress is their sum over area and time, at any lengths of
 * the intervals; data from before averaging are forgotten, and two intervals may belong to one snapshot. `noise`:
 * relative scatter of the impulses of an interval. */
static gg_curves pushed(const gg_model *m, int samples, double noise)
{
  static const double P[2][3] = {{0.3, -0.7, 0.1}, {-0.3, 0.7, 0.2}}; /* force on each wall over its area */
  gg_rng r = gg_common_rng_seed(92, 0);
  gg_snapshot s;
  gg_bins bins;
  void *self = gg_measure_profiles.create(m, NULL);
  assert_int_equal(gg_measure_snapshot_init(&s, m, true, NULL), GG_OK);
  assert_int_equal(gg_statistics_bins_init(&bins, gg_measure_profiles.curves->bins(self), NULL), GG_OK);
  gg_collision_sums t = {.surface = {{.impulse = {1e6, 1e6, 1e6}}, {.impulse = {1e6, 1e6, 1e6}}}};
  gg_measure_profiles.curves->add_interval(self, &(gg_interval){m, &t, 1e3, 1});
  gg_measure_profiles.restart(self);
  for (int k = 0; k < 2 * samples; k++) {
    double time = 0.5 + 0.1 * (k % 7);
    for (int wall = 0; wall < 2; wall++)
      for (int a = 0; a < 3; a++)
        t.surface[wall].impulse[a] = P[wall][a] * m->box[0] * m->box[2] * time * (1 + noise * gg_common_rng_normal(&r));
    gg_measure_profiles.curves->add_interval(self, &(gg_interval){m, &t, time, 1});
    if (k % 2 == 0) continue;
    gg_measure_profiles.curves->add_snapshot(self, &s, gg_statistics_bins_sample(&bins));
    gg_statistics_bins_commit(&bins);
  }
  const gg_bins *list[] = {&bins};
  gg_curves curves = {.model = m};
  assert_int_equal(
      gg_measure_curves_estimate(list, 1, gg_measure_profiles.curves->of_bins, self, "profiles", 0, &curves, NULL),
      GG_OK);
  gg_statistics_bins_clear(&bins);
  gg_measure_snapshot_clear(&s);
  gg_measure_profiles.destroy(self);
  return curves;
}

static void wall_stress(void **state)
{
  (void)state;
  gg_model m = ct_model(GG_COUETTE, 0.2, 0, 200, 1);
  static const struct {
    const char *name;
    double P;
  } walls[] = {
      {"wall_P_yy_lower", 0.7}, {"wall_P_yx_lower", -0.3}, {"wall_P_yy_upper", 0.7}, {"wall_P_yx_upper", -0.3}};
  for (int noisy = 0; noisy < 2; noisy++) {
    gg_curves list = pushed(&m, noisy ? 3200 : 48, noisy ? 0.5 : 0);
    for (int k = 0; k < 4; k++) {
      gg_curve_number n = ct_number(ct_find(&list, "profile_velocity"), walls[k].name);
      double P = m.stress_unit * walls[k].P;
      if (!noisy) assert_true(fabs(n.value - P) < 1e-12 && n.error < 1e-12);
      if (!noisy) continue;
      ct_expect(walls[k].name, n.value, n.error, P, 0.03 * fabs(P));
      double scatter = 0.5 * fabs(P) / sqrt(2 * 6400) * sqrt(1.06); /* of both walls; unequal intervals: <t^2>/<t>^2 */
      assert_true(fabs(n.error / scatter - 1) < 0.5);               /* 16 to 32 blocks, and chance correlations */
    }
    gg_measure_curves_clear(&list);
  }
}

static void couette_gas_agrees_with_its_walls(void **state)
{
  (void)state;
  gg_scene s = gg_scene_defaults();
  s.engine = GG_MD, s.flow = GG_COUETTE, s.phi = 0.1, s.particles = 500;
  for (int q = 0; q < GG_PAIRS; q++) s.collision.e[q] = 0.95, s.collision.beta[q] = 0;
  s.run.collisions = 8000, s.run.warmup = 1500; /* blocks longer than the memory of the momentum of the box */
  s.measure |= GG_MEASURE_PROFILES;
  gg_result *r = ct_run(s);
  const gg_curve *u = ct_find(&r->curves, "profile_velocity"), *phi = ct_find(&r->curves, "profile_solid_fraction");
  double mean = 0, odd = 0, variance = 0;
  for (size_t i = 0; i < phi->n; i++) mean += phi->value[i] / (double)phi->n;
  assert_true(fabs(mean - 0.1) < 1e-12);
  size_t n = u->n;
  for (size_t i = 2; i < n / 2; i++) {
    odd += u->value[i] + u->value[n - 1 - i];
    variance += pow(u->error[i], 2) + pow(u->error[n - 1 - i], 2);
  }
  print_message("# u(y) + u(L - y): %.4f, errors %.4f; u from %.3f to %.3f, walls at +-%.3f\n", odd, sqrt(variance),
                u->value[2], u->value[n - 3], r->model.surface[1].velocity.x);
  assert_true(u->value[n - 3] > 10 * u->error[n - 3] && u->value[2] < -10 * u->error[2]);
  gg_curve_number lower = ct_number(u, "slip_lower"), upper = ct_number(u, "slip_upper");
  print_message("# slip %.3f +- %.3f and %.3f +- %.3f\n", lower.value, lower.error, upper.value, upper.error);
  assert_true(upper.value > 4 * upper.error && lower.value < -4 * lower.error);
  assert_true(fabs(upper.value + lower.value) < 4 * hypot(upper.error, lower.error));
  /* The stress of the gas averages to that of the walls, but for the layer d/2 at each wall that only contacts with
   * it cross: P_bulk = P_wall (1 - d/L_y). P_yx is the flux along y of momentum along x; rough grains next to a wall
   * rotate, and P_xy differs. */
  static const char *const side[] = {"lower", "upper"};
  for (int k = 0; k < 4; k++) {
    char name[32];
    snprintf(name, sizeof name, "wall_P_%s_%s", k / 2 ? "yx" : "yy", side[k % 2]);
    gg_curve_number p = ct_number(u, name);
    const gg_estimate *bulk = &r->value[k / 2 ? GG_Q_P_YX : GG_Q_P_YY];
    double share = 1 - 1 / r->model.box[1];
    ct_expect(name, p.value * share, hypot(p.error * share, bulk->error), bulk->mean, 0.1 * fabs(bulk->mean));
  }
  gg_result_free(r);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(planted_profiles),
      cmocka_unit_test(folded_profiles),
      cmocka_unit_test(errors_where_the_gas_wanders),
      cmocka_unit_test(wall_stress),
      cmocka_unit_test(couette_gas_agrees_with_its_walls),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
