/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Enskog Monte Carlo across a periodic channel, where a gas starts with a transverse wave.
 * Identities: the start has the amplitude of the scene and no momentum; collisions conserve momentum and energy, the
 * Gaussian thermostat the energy, to rounding; a stopped and restored engine continues bit for bit; vector kernels have
 * the bits of the plain path, and so has any number of threads; velocities are scaled exactly.
 * Limits: without collisions the wave decays as a Gaussian. A uniform gas has the pressure, stress, collision rate,
 * temperature and fourth cumulant of the homogeneous engine, elastic, cooled or heated. */
#include "common/shear_wave.h"
#include "dsmc/walls/channel.h"
#include "lab.h"

enum { N = 20000 };

static gg_scene scene_of(gg_flow flow, gg_thermostat thermostat, double phi, double e, double wave)
{
  gg_scene s = lab_scene(flow, phi, e, -1, N);
  s.thermostat = thermostat;
  s.particles = (int64_t)(6 * fmax(phi, 1e-6) / M_PI * 12 * 12 * 12);
  s.start.wave = wave, s.run.duration = 1;
  return s;
}

static const struct gas {
  gg_flow flow;
  gg_thermostat thermostat;
  double phi, e;
} gases[] = {{GG_EQUILIBRIUM, GG_NO_THERMOSTAT, 0.1, 1},
             {GG_EQUILIBRIUM, GG_NO_THERMOSTAT, 0.3, 1},
             {GG_HCS, GG_NO_THERMOSTAT, 0.2, 0.8},
             {GG_HSS, GG_GAUSSIAN, 0.2, 0.95},
             {GG_HSS, GG_WHITE_NOISE, 0.2, 0.8}};
enum { GASES = sizeof gases / sizeof *gases };

static gg_model model_of(int k, double wave)
{
  const gg_scene s = scene_of(gases[k].flow, gases[k].thermostat, gases[k].phi, gases[k].e, wave);
  return lab_model(&s);
}

typedef struct view {
  const gg_model *m;
  gg_wave_sums wave;
  double momentum[3], energy;
} view;

static void add_grains(void *context, const gg_chunk *k)
{
  view *v = context;
  for (size_t i = 0; i < k->n; i++) {
    assert_true(k->r[1][i] >= 0 && k->r[1][i] <= v->m->box[1]);
    gg_wave_add(&v->wave, 1, gg_wave_profile(v->m, k->r[1][i]), k->c[0][i]);
    for (int a = 0; a < 3; a++) v->momentum[a] += k->c[a][i], v->energy += 0.5 * k->c[a][i] * k->c[a][i];
  }
}

static view view_of(gg_engine *g, const gg_model *m)
{
  view v = {.m = m};
  g->ops->snapshot(g, true, add_grains, &v);
  return v;
}

static double advance(gg_engine *g, double dt, uint64_t collisions)
{
  double elapsed = 0;
  gg_error err = {0};
  if (g->ops->advance(g, dt, collisions, &elapsed, &err) != GG_OK) fail_msg("%s", err.message);
  return elapsed;
}

static void momentum_and_energy_are_conserved(void **state)
{
  (void)state;
  for (int k = 0; k < GASES; k++) {
    gg_model m = model_of(k, 0.3);
    gg_engine *g = lab_engine(&m, 3);
    const view before = view_of(g, &m);
    assert_true(fabs(gg_wave_amplitude(&before.wave) / (0.3 * sqrt(2 * m.temperature0)) - 1) < 1e-12);
    advance(g, INFINITY, (uint64_t)(10 * m.n));
    const view after = view_of(g, &m);
    gg_collision_sums t;
    g->ops->take_sums(g, &t);
    const double scale = sqrt(2 * after.energy * (double)m.n), lost = gases[k].flow == GG_HSS ? 0 : t.loss[GG_11];
    for (int a = 0; a < 3; a++) assert_true(fabs(before.momentum[a]) < 1e-11 * scale);
    for (int a = 0; a < 3; a++) assert_true(fabs(after.momentum[a]) < 1e-11 * scale);
    assert_true(t.loss[GG_11] > 0 || m.elastic);
    if (gases[k].thermostat != GG_WHITE_NOISE)
      assert_true(fabs(after.energy + lost - before.energy) < 1e-11 * before.energy);
    g->ops->destroy(g);
  }
}

/* a(t) = a(0) exp(-k^2 T t^2/2m) without collisions: here a grain collides once in 200 decay times. */
static void a_free_wave_decays_as_a_gaussian(void **state)
{
  (void)state;
  gg_scene s = scene_of(GG_EQUILIBRIUM, GG_NO_THERMOSTAT, 4e-5, 1, 0.5);
  s.particles = 2, s.dsmc.particles = 400000;
  gg_model m = lab_model(&s);
  gg_engine *g = lab_engine(&m, 5);
  const view first = view_of(g, &m);
  const double start = gg_wave_amplitude(&first.wave);
  double t = 0;
  const double k = gg_wave_number(&m), T = m.temperature0, error = sqrt(2 * T / (double)m.n) / start;
  for (int step = 0; step < 8; step++) {
    t += advance(g, 0.3 / (k * sqrt(T)), UINT64_MAX);
    const view v = view_of(g, &m);
    const double is = gg_wave_amplitude(&v.wave) / start, expected = exp(-k * k * T * t * t / 2);
    printf("# kvt = %.2f: %.4f, expected %.4f +- %.4f\n", k * sqrt(T) * t, is, expected, error);
    assert_true(fabs(is - expected) < 4.5 * error);
  }
  const gg_engine_state at = gg_engine_state_of(g);
  assert_true(2 * (double)at.collisions < 0.01 * (double)m.n);
  g->ops->destroy(g);
}

static bool by_chance(void *context)
{
  return gg_rng_uniform(context) < 0.5;
}

static void stopped_runs_end_as_uninterrupted_ones(void **state)
{
  (void)state;
  for (int k = 0; k < GASES; k++) {
    gg_model m = model_of(k, 0.3);
    gg_rng rng = gg_common_rng_seed(1, 0);
    gg_stop stop = {by_chance, &rng};
    gg_error err;
    double gone;
    gg_engine *straight = lab_engine(&m, 8);
    m.stop = &stop;
    gg_engine *cut = lab_engine(&m, 8);
    const double whole = advance(straight, INFINITY, (uint64_t)(3 * m.n));
    gg_status status = cut->ops->advance(cut, INFINITY, (uint64_t)(3 * m.n), &gone, &err);
    int stops = 0;
    for (; status != GG_OK; stops++) {
      gg_archive a = {0};
      assert_int_equal(status, GG_INTERRUPTED);
      assert_int_equal(cut->ops->save(cut, &a, &err), GG_OK);
      view_of(cut, &m);
      cut->ops->destroy(cut);
      assert_int_equal(gg_dsmc_ops.restore(&m, &a, &cut, &err), GG_OK);
      gg_base_archive_clear(&a);
      status = cut->ops->go_on(cut, &gone, &err);
    }
    assert_true(stops > 2 && gone == whole);
    lab_same_archive(straight, cut);
    straight->ops->destroy(straight);
    cut->ops->destroy(cut);
  }
}

static void instructions_and_threads_leave_the_plain_bits(void **state)
{
  (void)state;
  for (int k = 0; k < GASES; k++) {
    gg_model m = model_of(k, 0.3);
    gg_engine *plain = lab_engine(&m, 4);
    const gg_dsmc_channel *d = (gg_dsmc_channel *)plain;
    ((gg_dsmc_channel *)plain)->plain = true;
    assert_true(d->slabs >= 4 && d->slabs % 2 == 0 && d->cells.block == 0);
    advance(plain, INFINITY, (uint64_t)(5 * m.n));
    for (gg_instructions set = 0; set < GG_INSTRUCTION_SETS; set++) {
      if (!gg_simd_instructions_run_here(set)) continue;
      gg_engine *fast = lab_engine(&m, 4);
      ((gg_dsmc_channel *)fast)->collide = gg_dsmc_channel_collide_of[set];
      fast->ops->threads(fast, 1 + (int)set % 3);
      advance(fast, INFINITY, (uint64_t)(5 * m.n));
      lab_same_archive(fast, plain);
      fast->ops->destroy(fast);
    }
    plain->ops->destroy(plain);
  }
}

/* Velocities times 2^power and times over it, exactly; with a thermostat not at all. */
static void velocities_are_scaled(void **state)
{
  (void)state;
  gg_model m = model_of(2, 0.3), heated = model_of(3, 0.3);
  gg_engine *one = lab_engine(&m, 4), *two = lab_engine(&m, 4), *three = lab_engine(&heated, 4);
  advance(one, 3, UINT64_MAX), advance(two, 3, UINT64_MAX);
  assert_int_equal(two->ops->rescale(two, 2, NULL), GG_OK);
  advance(one, 2, UINT64_MAX), advance(two, 0.5, UINT64_MAX);
  const view a = view_of(one, &m), b = view_of(two, &m);
  assert_true(b.energy == 16 * a.energy && b.wave.momentum == 4 * a.wave.momentum);
  assert_int_equal(gg_engine_state_of(one).collisions, gg_engine_state_of(two).collisions);
  assert_int_equal(three->ops->rescale(three, 2, NULL), GG_BAD_INPUT);
  one->ops->destroy(one), two->ops->destroy(two), three->ops->destroy(three);
}

/* Means of a uniform gas, whose wave is too small to matter, beside those of the homogeneous engine. With the Gaussian
 * thermostat shear waves grow in a long box of lossy grains: here they do not. */
static void compare(const struct gas *gas, double sight)
{
  gg_scene s = scene_of(gas->flow, gas->thermostat, gas->phi, gas->e, 1e-9);
  gg_model m[2];
  lab_flow f[2];
  m[1] = lab_model(&s);
  s.start.wave = 0;
  m[0] = lab_model(&s);
  assert_true(m[0].homogeneous && !m[1].homogeneous);
  for (int k = 0; k < 2; k++) {
    memset(&f[k], 0, sizeof f[k]);
    gg_engine *g = lab_engine(&m[k], 11);
    gg_error err = {0};
    double elapsed;
    assert_int_equal(g->ops->advance(g, INFINITY, (uint64_t)(10 * m[k].n), &elapsed, &err), GG_OK);
    for (int b = 0; b < 40; b++) {
      gg_collision_sums t;
      lab_view sum = {0};
      double time = 0, stress = 0;
      g->ops->take_sums(g, &t);
      for (int i = 0; i < 4; i++) {
        assert_int_equal(g->ops->advance(g, INFINITY, (uint64_t)(m[k].n / 2), &elapsed, &err), GG_OK);
        g->ops->snapshot(g, false, lab_add_chunk, &sum);
        time += elapsed;
      }
      g->ops->take_sums(g, &t);
      for (int a = 0; a < 3; a++) stress += t.stress[GG_11][a][a] / 3;
      const double T = lab_temperature(&sum);
      lab_add(&f[k].T, T);
      lab_add(&f[k].p, m[k].density * T + stress / (m[k].volume * time));
      lab_add(&f[k].N2, t.stress[GG_11][1][1] / (3 * stress));
      lab_add(&f[k].rate, 2 * (double)t.collisions[GG_11] / ((double)m[k].n * time));
      lab_add(&f[k].loss, t.loss[GG_11] / time);
      lab_add(&f[k].a2, 3 + sum.c4 / sum.n / (5 * T * T)); /* kurtosis and 3: it does not vanish */
    }
    g->ops->destroy(g);
  }
  printf("# phi = %g, e = %g\n", gas->phi, gas->e);
  if (gas->thermostat == GG_WHITE_NOISE)
    lab_expect("temperature", &f[1].T, lab_value(&f[0].T), lab_error(&f[0].T), sight);
  else /* constant */
    assert_true(fabs(lab_value(&f[1].T) / lab_value(&f[0].T) - 1) < 1. / N);
  lab_expect("pressure", &f[1].p, lab_value(&f[0].p), lab_error(&f[0].p), sight);
  lab_expect("part of P_yy", &f[1].N2, lab_value(&f[0].N2), lab_error(&f[0].N2), sight);
  lab_expect("collision rate", &f[1].rate, lab_value(&f[0].rate), lab_error(&f[0].rate), sight);
  if (gas->e < 1) lab_expect("loss", &f[1].loss, lab_value(&f[0].loss), lab_error(&f[0].loss), 2 * sight);
  lab_expect("kurtosis", &f[1].a2, lab_value(&f[0].a2), lab_error(&f[0].a2), sight);
}

static void a_uniform_gas_is_that_of_the_homogeneous_engine(void **state)
{
  (void)state;
  for (int k = 0; k < GASES; k++)
    if (gases[k].flow != GG_HCS) compare(&gases[k], 0.01);
}

static void other_gases_are_rejected(void **state)
{
  (void)state;
  gg_engine *g;
  gg_error err = {0};
  gg_model m = model_of(0, 0.3);
  m.rule = GG_ROUGH;
  assert_int_equal(gg_dsmc_ops.create(&m, 1, 0, &g, &err), GG_BAD_INPUT);
  assert_non_null(strstr(err.message, "smooth"));
  m = model_of(0, 0.3), m.box[1] = 1.9;
  assert_int_equal(gg_dsmc_ops.create(&m, 1, 0, &g, &err), GG_BAD_INPUT);
  m = model_of(0, 0.3), m.single = true;
  assert_int_equal(gg_dsmc_ops.create(&m, 1, 0, &g, &err), GG_BAD_INPUT);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(momentum_and_energy_are_conserved),
      cmocka_unit_test(a_free_wave_decays_as_a_gaussian),
      cmocka_unit_test(stopped_runs_end_as_uninterrupted_ones),
      cmocka_unit_test(instructions_and_threads_leave_the_plain_bits),
      cmocka_unit_test(velocities_are_scaled),
      cmocka_unit_test(a_uniform_gas_is_that_of_the_homogeneous_engine),
      cmocka_unit_test(other_gases_are_rejected),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
