/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The decay of a transverse wave: planted grains whose wave decays by a known viscosity give this viscosity, at
 * constant temperature, in a gas that cools and is rescaled on the way, with a Gaussian thermostat and in a bath; the
 * curve is the planted amplitude. The wave of an elastic gas decays by Enskog's viscosity, dilute and dense, in Monte
 * Carlo and in md, and in Monte Carlo that of a gas heated by white noise and of a cooling one by theirs; a run that is
 * resumed has the same bits. A run too short for the fit says so; energy is balanced while a wave grows. Daily md of
 * the elastic gas and Monte Carlo of the cooling one run, the others nightly. */
#include "common/shear_wave.h"
#include "curve_test.h"
#include "graingas.h"
#include "theory/theory.h"

enum { PLACES = 500, GRAINS = 2 * PLACES, STEPS = 100 };
#define ETA 1.7

enum planted { CONSTANT, COOLING, SCALED, N_PLANTED };

static gg_model planted_model(enum planted kind)
{
  gg_scene s = gg_scene_defaults();
  s.flow = kind == CONSTANT ? GG_EQUILIBRIUM : kind == COOLING ? GG_HCS : GG_HSS;
  s.thermostat = kind == SCALED ? GG_GAUSSIAN : GG_NO_THERMOSTAT;
  for (int q = 0; q < GG_PAIRS; q++) s.collision.e[q] = kind == CONSTANT ? 1 : 0.9;
  s.phi = 0.1, s.particles = GRAINS, s.start.wave = 0.3, s.run.duration = 1;
  gg_model m;
  assert_int_equal(gg_scene_model_make(&s, GG_MD, &m, NULL), GG_OK);
  assert_null(gg_measure_shear_wave.refuses(&m));
  return m;
}

/* A row of grains at equal distances along y, at each place two of opposite velocities about the wave. */
static void row_of(const gg_model *m, void *self, double a, double T, double elapsed, double factor, double loss,
                   double *row)
{
  static double r[3][GRAINS], c[3][GRAINS];
  const gg_observable *o = &gg_measure_shear_wave;
  gg_rng rng = gg_common_rng_seed(9, 0);
  double square = 0;
  for (int i = 0; i < GRAINS; i++) {
    r[1][i] = (i / 2 + 0.5) / PLACES * m->box[1];
    for (int k = 0; k < 3; k++) c[k][i] = i % 2 ? -c[k][i - 1] : gg_common_rng_normal(&rng);
    for (int k = 0; k < 3; k++) square += c[k][i] * c[k][i];
  }
  for (int i = 0; i < GRAINS; i++)
    for (int k = 0; k < 3; k++)
      c[k][i] = c[k][i] * sqrt(3 * GRAINS * T / square) + (k ? 0 : a * gg_wave_profile(m, r[1][i]));
  const gg_chunk chunk = {.n = GRAINS, .r = {r[0], r[1], r[2]}, .c = {c[0], c[1], c[2]}};
  gg_collision_sums sums = {.loss = {loss}};
  const gg_interval in = {m, &sums, elapsed, factor};
  o->rows->begin(self);
  o->rows->add_chunk(self, &chunk);
  o->rows->finish(self, &in, row);
}

/* eta* of the planted wave, from a(0) on; `list` gets the curves, `row` the last row. */
static double plant(enum planted kind, const gg_model *m, double a0, gg_curves *list, double row[8])
{
  const gg_observable *o = &gg_measure_shear_wave;
  const double k = gg_wave_number(m), q = ETA * k * k / gg_common_model_nu0(m, 1), T0 = m->temperature0;
  const double end = 3 / (q * sqrt(T0)), tau = end / log(21); /* Haff's: T falls by a factor of 441 */
  double before = 0, scaled = 1, gone = 0;
  void *self = o->create(m, NULL);
  gg_bins bins;
  assert_int_equal(gg_statistics_bins_init(&bins, o->curves->bins(self), NULL), GG_OK);
  bins.whole = o->curves->of_transient(self);
  for (int j = 0; j <= STEPS; j++) {
    const double t = kind == COOLING ? tau * expm1(log(21) * j / STEPS) : end * j / STEPS;
    const double T = kind == COOLING ? T0 / ((1 + t / tau) * (1 + t / tau)) : T0;
    const double s = kind == COOLING ? tau * sqrt(T0) * log1p(t / tau) : t * sqrt(T0);
    const double growth = kind == SCALED ? 0.01 * t : 0;
    const double a = a0 * exp(growth - q * s), energy = GRAINS * (3 * T + a * a / 2), step = t - gone;
    const double loss = kind == SCALED ? (energy + before) / 2 * 0.01 * step - (energy - before) / 2 : 0;
    const double factor = kind == COOLING && j % 30 == 29 ? 4 : 1;
    scaled *= factor;
    if (j) o->curves->add_snapshot(self, NULL, gg_statistics_bins_sample(&bins));
    row_of(m, self, a * scaled, T * scaled * scaled, step / scaled, factor, loss, row);
    if (j == 0) {
      o->restart(self);
      o->curves->add_snapshot(self, NULL, gg_statistics_bins_sample(&bins));
    }
    before = energy, gone = t;
  }
  gg_statistics_bins_commit(&bins);
  const gg_bins *one = &bins;
  assert_int_equal(gg_measure_curves_estimate(&one, 1, o->curves->of_bins, self, o->name, 0, list, NULL), GG_OK);
  gg_statistics_bins_clear(&bins);
  o->destroy(self);
  return o->rows->derived[0].of(row, m);
}

static void planted_waves_have_their_viscosity(void **state)
{
  (void)state;
  for (enum planted kind = 0; kind < N_PLANTED; kind++) {
    const gg_model m = planted_model(kind);
    gg_curves list = {.model = &m};
    double row[8];
    const double eta = plant(kind, &m, 0.3, &list, row);
    print_message("# planted %d: %.6f, expected %.6f\n", (int)kind, eta, ETA);
    assert_true(fabs(eta / ETA - 1) < 3e-4);
    const gg_curve *c = ct_find(&list, "shear_wave"), *of_time = ct_find(&list, "viscosity_of_wave");
    assert_int_equal(c->n, STEPS);
    assert_true(c->x[0] == 0 && fabs(c->value[0] - 0.3) < 1e-9);
    for (size_t i = 0; i < c->n; i++) assert_true(fabs(c->value[i] / c->reference[i] - 1) < 3e-3);
    assert_true(isnan(of_time->value[0]) && fabs(of_time->value[STEPS - 1] / ETA - 1) < 3e-4);
    assert_true(fabs(ct_number(c, "wavelength").value - m.box[1]) < 1e-12);
    gg_measure_curves_clear(&list);
  }
}

/* Noise may reverse a small wave in one replica. Its rows count, too: means over replicas would be biased without them.
 */
static void rows_are_linear_in_the_wave(void **state)
{
  (void)state;
  const gg_model m = planted_model(CONSTANT);
  gg_curves list = {.model = &m};
  double up[8], down[8];
  plant(CONSTANT, &m, 0.3, &list, up);
  plant(CONSTANT, &m, -0.3, &list, down);
  for (int k = 0; k < 2; k++) assert_true(up[k] > 0.01 && fabs(up[k] + down[k]) < 1e-9 * up[k]);
  gg_measure_curves_clear(&list);
}

static gg_scene wave_scene(gg_engine_kind engine, gg_flow flow, gg_thermostat thermostat, double phi, double e)
{
  gg_scene s = gg_scene_defaults();
  s.engine = engine, s.flow = flow, s.thermostat = thermostat, s.phi = phi, s.start.wave = 0.3;
  for (int q = 0; q < GG_PAIRS; q++) s.collision.e[q] = e;
  s.measure |= GG_MEASURE_SHEAR_WAVE;
  s.run.replicas = 8;
  return s;
}

/* Within four errors, which are at most `sight`, and `uncertainty` of the reference and of the wave's finite length. */
static void expect(const gg_scene *s, double expected, double sight, double uncertainty)
{
  gg_result *r = ct_run(*s);
  const gg_estimate *is = &r->value[GG_Q_VISCOSITY_REDUCED];
  print_message("# %s, phi = %g, e = %g: %.4f +- %.4f, expected %.4f\n", r->engine, s->phi, s->collision.e[0], is->mean,
                is->error, expected);
  assert_true(is->error > 0 && is->error < sight * expected);
  assert_true(fabs(is->mean - expected) < 4 * is->error + uncertainty * expected);
  gg_result_free(r);
}

static double theory_of(const gg_scene *s, const char *name)
{
  gg_model m;
  gg_theory_answer a;
  assert_int_equal(gg_scene_model_for_theories(s, &m, NULL), GG_OK);
  assert_int_equal(gg_theory_evaluate(gg_theory_find(name), &m, &a, NULL), GG_OK);
  return a.value[GG_Q_VISCOSITY_REDUCED];
}

static void elastic_waves_decay_by_enskogs_viscosity(void **state)
{
  (void)state;
  gg_scene s = wave_scene(GG_DSMC, GG_HCS, GG_NO_THERMOSTAT, 0.1, 1);
  s.particles = 2000, s.dsmc.particles = 40000, s.aspect[1] = 2.5, s.run.duration = 100;
  if (getenv("NIGHTLY")) {
    expect(&s, theory_of(&s, "enskog_hermite"), 0.02, 0.007);
    s.phi = 0.3, s.aspect[1] = 1, s.run.duration = 13;
    expect(&s, theory_of(&s, "enskog_hermite"), 0.025, 0.007);
  }
  s = wave_scene(GG_MD, GG_HCS, GG_NO_THERMOSTAT, 0.1, 1);
  s.particles = 2000, s.aspect[1] = 1.6, s.run.duration = 55, s.run.replicas = 16, s.start.wave = 0.5;
  expect(&s, theory_of(&s, "enskog_hermite"), 0.035, 0.012);
}

static void heated_and_cooling_waves_decay_by_their_viscosity(void **state)
{
  (void)state;
  gg_scene s = wave_scene(GG_DSMC, GG_HSS, GG_WHITE_NOISE, 0.3, 0.8);
  s.particles = 2000, s.dsmc.particles = 40000, s.run.duration = 12, s.start.wave = 0.5;
  if (getenv("NIGHTLY")) expect(&s, theory_of(&s, "enskog_hermite"), 0.03, 0.01);
  s = wave_scene(GG_DSMC, GG_HCS, GG_NO_THERMOSTAT, 0.3, 0.9);
  s.particles = 573, s.dsmc.particles = 40000, s.run.duration = 15;
  expect(&s, theory_of(&s, "enskog_hermite"), 0.03, 0.01);
  s.flow = GG_HSS, s.thermostat = GG_GAUSSIAN, s.run.duration = 6;
  if (getenv("NIGHTLY")) expect(&s, theory_of(&s, "enskog_hermite"), 0.03, 0.01);
}

static void other_gases_have_none(void **state)
{
  (void)state;
  gg_scene s = wave_scene(GG_MD, GG_HCS, GG_NO_THERMOSTAT, 0.1, 0.9);
  gg_model m;
  s.run.duration = 10, s.start.wave = 0;
  assert_int_equal(gg_scene_model_make(&s, GG_MD, &m, NULL), GG_OK);
  assert_non_null(strstr(gg_measure_shear_wave.refuses(&m), "start.wave"));
  s.start.wave = 0.3, s.collision.beta[0] = 0;
  assert_int_equal(gg_scene_model_make(&s, GG_MD, &m, NULL), GG_OK);
  assert_non_null(strstr(gg_measure_shear_wave.refuses(&m), "smooth"));
  s.collision.beta[0] = -1, s.flow = GG_HSS, s.thermostat = GG_BATH;
  assert_int_equal(gg_scene_model_make(&s, GG_MD, &m, NULL), GG_OK);
  assert_non_null(strstr(gg_measure_shear_wave.refuses(&m), "drag"));
  s.run.duration = GG_AUTO; /* a mean over time has no start */
  assert_int_equal(gg_scene_model_make(&s, GG_MD, &m, NULL), GG_OK);
  assert_true(m.wave == 0);
}

static bool warns(const gg_result *r, const char *words)
{
  for (size_t i = 0; i < r->warnings.n; i++)
    if (strstr(r->warnings.text[i], words)) return true;
  return false;
}

static void a_run_too_short_for_the_fit_says_so(void **state)
{
  (void)state;
  gg_scene s = wave_scene(GG_DSMC, GG_HCS, GG_NO_THERMOSTAT, 0.1, 1);
  s.particles = 1000, s.dsmc.particles = 1000, s.run.duration = 3, s.run.replicas = 2;
  gg_result *r = ct_run(s);
  assert_true(isnan(r->value[GG_Q_VISCOSITY_REDUCED].mean));
  assert_non_null(strstr(r->value[GG_Q_VISCOSITY_REDUCED].reason, "first 10 collisions a grain; give run.duration"));
  assert_true(warns(r, "viscosity_reduced: too short"));
  gg_result_free(r);
  s.run.duration = 15;
  r = ct_run(s);
  assert_true(isfinite(r->value[GG_Q_VISCOSITY_REDUCED].mean));
  assert_false(warns(r, "viscosity_reduced"));
  gg_result_free(r);
}

/* A given gaussian_rate feeds the wave, too, which grows without end: so does the power of the thermostat within each
 * sample, by 5 % of the losses at its end. */
static void energy_is_balanced_while_a_wave_grows(void **state)
{
  (void)state;
  gg_scene s = wave_scene(GG_DSMC, GG_HSS, GG_GAUSSIAN, 0.1, 0.7);
  s.gaussian_rate = 0.2, s.aspect[1] = 3.6, s.particles = 1000, s.dsmc.particles = 4000, s.run.duration = 60,
  s.run.replicas = 4;
  gg_result *r = ct_run(s);
  const gg_estimate *balance = &r->value[GG_Q_ENERGY_BALANCE];
  print_message("# energy balance %.5f +- %.5f at T = %.3g\n", balance->mean, balance->error,
                r->value[GG_Q_TEMPERATURE].mean);
  assert_true(r->value[GG_Q_TEMPERATURE].mean > 50 && balance->error < 0.003);
  assert_true(fabs(balance->mean - 1) < 4 * balance->error + 0.001);
  gg_result_free(r);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(planted_waves_have_their_viscosity),
      cmocka_unit_test(rows_are_linear_in_the_wave),
      cmocka_unit_test(elastic_waves_decay_by_enskogs_viscosity),
      cmocka_unit_test(heated_and_cooling_waves_decay_by_their_viscosity),
      cmocka_unit_test(other_gases_have_none),
      cmocka_unit_test(a_run_too_short_for_the_fit_says_so),
      cmocka_unit_test(energy_is_balanced_while_a_wave_grows),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
