/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A cooling gas that is followed in time: grains that keep a known fraction of their velocity have the planted
 * functions of two times, in replicas whose velocities are rescaled on the way. In both engines the autocorrelation
 * depends on the number of collisions since the waiting time alone, and in time decays the slower the later it begins;
 * the displacement grows as the logarithm of time, with the D of a run in its scaled state; that of Monte Carlo is the
 * theory's. */
#include "curve_test.h"
#include "graingas.h"

#define STEP 0.2  /* collisions per grain */
#define KEEP 0.9  /* of a velocity in a step */
#define FALL 0.98 /* of v_0 in a step */
enum { REPLICAS = 8, STEPS = 400, GRAINS = 400 };

static gg_model followed(gg_engine_kind engine, int64_t n, double e, double phi)
{
  gg_scene s = gg_scene_defaults();
  s.engine = engine, s.flow = GG_HCS, s.phi = phi, s.particles = n, s.run.duration = 100;
  for (int q = 0; q < GG_PAIRS; q++) s.collision.e[q] = e;
  gg_model m;
  assert_int_equal(gg_scene_model_make(&s, engine, &m, NULL), GG_OK);
  return m;
}

/* Positions follow the velocities, which are u v_0 of u with variance T_0; the engine's are `scaled` times those. */
static void walk(gg_snapshot *s, gg_rng *r, double *u, int step, double v, double scaled, double path)
{
  const double *L = s->model->box, T0 = s->model->temperature0;
  s->elapsed = step ? path * (1 - FALL) / log(1 / FALL) / v / scaled : 0;
  for (size_t i = 0; i < 3 * s->n; i++) {
    double *x = &s->r[i % 3][i / 3], *c = &s->c[i % 3][i / 3];
    if (step == 0) {
      *x = L[i % 3] * gg_rng_uniform(r), u[i] = sqrt(T0) * gg_common_rng_normal(r);
    } else {
      *x += u[i] * path, *x -= L[i % 3] * floor(*x / L[i % 3]);
      u[i] = KEEP * u[i] + sqrt((1 - KEEP * KEEP) * T0) * gg_common_rng_normal(r);
    }
    *c = u[i] * v * scaled;
  }
}

static void replica(const gg_observable *o, const gg_model *m, gg_bins *bins, void *self, uint64_t seed)
{
  gg_snapshot s;
  gg_rng r = gg_common_rng_seed(seed, 0);
  static double u[3 * GRAINS];
  const double path = STEP / gg_common_model_collision_rate(m, m->temperature0);
  double v = 1, scaled = 1;
  assert_int_equal(gg_measure_snapshot_init(&s, m, true, NULL), GG_OK);
  assert_int_equal(gg_statistics_bins_init(bins, o->curves->bins(self), NULL), GG_OK);
  bins->whole = o->curves->of_transient(self);
  assert_true(bins->whole);
  for (size_t i = 0; i < s.n; i++) s.id[i] = (int64_t)((i * 7919 + 5) % s.n);
  o->restart(self);
  for (int k = 0; k <= STEPS; k++) {
    if (k) v *= FALL;
    if (k % 30 == 29) o->rescaled(self, 2), scaled *= 2;
    walk(&s, &r, u, k, v, scaled, path);
    o->curves->add_snapshot(self, &s, gg_statistics_bins_sample(bins));
    gg_statistics_bins_commit(bins);
  }
  gg_measure_snapshot_clear(&s);
}

static double kept(double collisions, const void *context)
{
  (void)context;
  return pow(KEEP, collisions / STEP);
}

static void known_walkers_have_known_functions_of_two_times(void **state)
{
  (void)state;
  const gg_observable *o = &gg_measure_diffusion;
  gg_model m = followed(GG_MD, GRAINS, 0.9, 0.1);
  assert_null(o->refuses(&m));
  gg_bins bins[REPLICAS];
  const gg_bins *list[REPLICAS];
  void *self = o->create(&m, NULL);
  for (int k = 0; k < REPLICAS; k++) replica(o, &m, &bins[k], self, 100 + (uint64_t)k), list[k] = &bins[k];
  gg_curves c = {.model = &m};
  assert_int_equal(gg_measure_curves_estimate(list, REPLICAS, o->curves->of_bins, self, o->name, 0, &c, NULL), GG_OK);
  static const char *const names[] = {"autocorrelation_collisions_0", "autocorrelation_collisions_5",
                                      "autocorrelation_collisions_20"};
  for (int k = 0; k < 3; k++) assert_true(ct_chi2(ct_find(&c, names[k]), 1, 24, kept, NULL) < 2.5);
  /* 25 steps of waiting, and so many of the lag: times of a sum of 1/v. */
  const gg_curve *in_time = ct_find(&c, "autocorrelation_from_5"), *by = ct_find(&c, names[1]);
  const double unit = STEP / gg_common_model_collision_rate(&m, m.temperature0);
  const double wait = ct_number(in_time, "waiting_time").value,
               steps = log(1 + wait / unit * log(1 / FALL)) / log(1 / FALL);
  double expected;
  assert_true(steps > 24.5 && steps < 27);
  for (size_t i = 4; i < 24; i++) { /* later lags are means over wider bins */
    const double lag = by->x[i] / STEP;
    expected = unit / log(1 / FALL) * pow(FALL, -steps) * (pow(FALL, -lag) - 1);
    assert_true(fabs(in_time->x[i] / expected - 1) < 0.03);
  }
  const double D = unit * sqrt(m.temperature0) * (0.5 + KEEP / (1 - KEEP)) * sqrt(m.temperature0);
  gg_curve_number is = ct_number(ct_find(&c, "displacement_collisions_0"), "diffusion_einstein");
  ct_expect("D of the walkers", is.value, is.error, D, 0.3 * D);
  gg_measure_curves_clear(&c);
  for (int k = 0; k < REPLICAS; k++) gg_statistics_bins_clear(&bins[k]);
  o->destroy(self);
}

static gg_result *cool(gg_engine_kind engine, double duration, double collisions, uint64_t seed)
{
  gg_scene s = gg_scene_defaults();
  s.engine = engine, s.flow = GG_HCS, s.phi = 0.05, s.particles = 1000;
  for (int q = 0; q < GG_PAIRS; q++) s.collision.e[q] = 0.8;
  s.dsmc.particles = 2000, s.run.seed = seed;
  s.measure |= GG_MEASURE_DIFFUSION;
  if (duration > 0)
    s.run.duration = duration, s.run.replicas = 8;
  else
    s.run.collisions = collisions;
  return ct_run(s);
}

/* Value of a curve at x, between its points. */
static double at(const gg_curve *c, double x, double *error)
{
  for (size_t i = 0; i + 1 < c->n; i++)
    if (c->x[i] <= x && x < c->x[i + 1]) {
      const double w = (x - c->x[i]) / (c->x[i + 1] - c->x[i]);
      *error = fmax(c->error[i], c->error[i + 1]);
      return (1 - w) * c->value[i] + w * c->value[i + 1];
    }
  fail_msg("%s does not reach %g", c->name, x);
  return NAN;
}

static void engine_ages(gg_engine_kind engine)
{
  gg_result *r = cool(engine, 4000, 0, 5), *steady = cool(engine, 0, 600, 6);
  double error[3], A[3], late, before;
  static const char *const waits[] = {"5", "10", "20"};
  for (int k = 0; k < 3; k++) {
    char name[64];
    snprintf(name, sizeof name, "autocorrelation_collisions_%s", waits[k]);
    A[k] = at(ct_find(&r->curves, name), 2, &error[k]);
  }
  ct_expect("A after two collisions, 5, 20", A[0], hypot(error[0], error[2]), A[2], 0.15);
  ct_expect("A after two collisions, 10, 20", A[1], hypot(error[1], error[2]), A[2], 0.15);
  before = at(ct_find(&r->curves, "autocorrelation_from_5"), 5, &error[0]);
  late = at(ct_find(&r->curves, "autocorrelation_from_20"), 5, &error[1]);
  print_message("# after the same time: %.3f(%.0f), %.3f(%.0f)\n", before, 1e3 * error[0], late, 1e3 * error[1]);
  assert_true(late - before > 0.2 && late - before > 10 * hypot(error[0], error[1]));
  /* <Dr^2> = a + b ln t: equal steps of ln t, of Haff's T, add equal parts. */
  const gg_curve *d = ct_find(&r->curves, "displacement_from_0");
  double grown[3];
  for (int k = 0; k < 3; k++) grown[k] = at(d, 160 * pow(4, k), &error[k]);
  ct_expect("logarithmic growth", grown[2] - grown[1], 0.08 * (grown[1] - grown[0]), grown[1] - grown[0],
            0.4 * (grown[1] - grown[0]));
  gg_curve_number is = ct_number(ct_find(&r->curves, "displacement_collisions_0"), "diffusion_einstein");
  double D = 0, variance = 0, theory = NAN;
  for (int a = 0; a < 3; a++) {
    char name[64];
    snprintf(name, sizeof name, "displacement_squared_%c", "xyz"[a]);
    gg_curve_number one = ct_number(ct_find(&steady->curves, name), "diffusion_einstein");
    D += one.value / 3, variance += one.error * one.error / 9;
    snprintf(name, sizeof name, "velocity_autocorrelation_C%c", "xyz"[a]);
    theory = ct_number(ct_find(&steady->curves, name), "diffusion_first_sonine").value;
  }
  ct_expect("D, followed and in its scaled state", is.value, hypot(is.error, sqrt(variance)), D, 0.2 * D);
  /* 6 T/(m nu (1 + e)^2), nu the collision rate: with the losses of Maxwellians. */
  const double n = 0.05 * 6 / M_PI, chi = (1 - 0.025) / pow(0.95, 3), T = 0.5;
  const double sonine = 6 * T / (4 * n * chi * sqrt(M_PI * T) * 1.8 * 1.8);
  assert_true(fabs(theory / sonine - 1) < 0.01);
  if (engine == GG_DSMC) ct_expect("D of theory", is.value, hypot(is.error, 0.01 * sonine), sonine, 0.1 * sonine);
  gg_result_free(r);
  gg_result_free(steady);
}

static void monte_carlo_ages_by_collisions(void **state)
{
  (void)state;
  engine_ages(GG_DSMC);
}

static void molecular_dynamics_ages_by_collisions(void **state)
{
  (void)state;
  engine_ages(GG_MD);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(known_walkers_have_known_functions_of_two_times),
      cmocka_unit_test(monte_carlo_ages_by_collisions),
      cmocka_unit_test(molecular_dynamics_ages_by_collisions),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
