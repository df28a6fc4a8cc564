/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Kicks at contact and torques, in both engines: every change of the energy is counted; the steady temperature and
 * fourth cumulant of the confined quasi-two-dimensional model in three dimensions; mean spins by torque, drag and
 * friction in closed form; which scenes have no steady state; resumed runs have the same bits. */
#include "../dsmc/lab.h"
#include "common/thermostat.h"
#include "md/parallel/parallel.h"

#include <stdbool.h>

static gg_scene scene_of(gg_engine_kind kind, double phi, double e, double beta, int64_t n)
{
  gg_scene s = lab_scene(GG_HSS, phi, e, beta, n);
  s.engine = kind;
  s.particles = n;
  s.thermostat = GG_INJECTION;
  return s;
}

static void set_kicks(gg_scene *s, double normal, double tangential)
{
  for (int p = 0; p < GG_PAIRS; p++)
    s->collision.kick[GG_NORMAL_KICK][p] = normal * (1 + 0.1 * p),
    s->collision.kick[GG_TANGENTIAL_KICK][p] = tangential;
}

static gg_model model_of(const gg_scene *s)
{
  gg_model m;
  gg_error err = {0};
  if (gg_scene_model_make(s, s->engine, &m, &err) != GG_OK) fail_msg("%s", err.message);
  return m;
}

static gg_engine *engine_of(const gg_model *m, gg_engine_kind kind, uint64_t seed)
{
  gg_engine *g = NULL;
  gg_error err = {0};
  if (gg_common_engine_of(kind)->create(m, seed, 0, &g, &err) != GG_OK) fail_msg("%s", err.message);
  return g;
}

static void advance(gg_engine *g, double dt, uint64_t collisions)
{
  double elapsed;
  gg_error err = {0};
  if (g->ops->advance(g, dt, collisions, &elapsed, &err) != GG_OK) fail_msg("%s", err.message);
}

static lab_view view_of(gg_engine *g)
{
  lab_view v = {0};
  g->ops->snapshot(g, false, lab_add_chunk, &v);
  return v;
}

typedef struct energies {
  const gg_model *m;
  double sum;
} energies;

static void add_energy(void *context, const gg_chunk *k)
{
  energies *e = context;
  for (size_t i = 0; i < k->n; i++) {
    const int s = k->species ? k->species[i] : 0;
    for (int a = 0; a < 3; a++) {
      const double spin = k->s[a] ? k->s[a][i] : 0;
      e->sum += 0.5 * e->m->mass[s] * (k->c[a][i] * k->c[a][i] + e->m->inertia[s] * spin * spin);
    }
  }
}

static double energy_of(const gg_model *m, gg_engine *g)
{
  energies e = {.m = m};
  g->ops->snapshot(g, false, add_energy, &e);
  return e.sum;
}

/* The energy of all grains changes by what kicks give less what collisions destroy, to rounding: for every rule, with
 * one species and two, on the paths of few and of many grains, in both precisions. */
static void check_books(gg_engine_kind kind, gg_scene *s)
{
  const gg_model m = model_of(s);
  gg_engine *g = engine_of(&m, kind, 5);
  gg_collision_sums sums;
  double loss = 0, given = 0;
  assert_true(m.kicks);
  const double before = energy_of(&m, g);
  advance(g, INFINITY, 20 * (uint64_t)m.n);
  g->ops->take_sums(g, &sums);
  for (int p = 0; p < gg_pairs_of(m.n_species); p++) loss += sums.loss[p], given += sums.given[p];
  const double after = energy_of(&m, g), error = after - before - (given - loss);
  assert_true(given > 0.1 * before && loss > 0.1 * before);
  if (fabs(error) > (s->dsmc.precision == GG_SINGLE ? 1e-4 : 1e-10) * (given + loss))
    fail_msg("engine %d, rule %d, %d species: the energy is off by %g of %g", kind, (int)m.rule, m.n_species, error,
             given + loss);
  g->ops->destroy(g);
}

static void energy_is_counted(void **state)
{
  (void)state;
  static const double rules[][2] = {{-1, INFINITY}, {0.3, INFINITY}, {0.2, 0.4}};
  for (int kind = GG_MD; kind <= GG_DSMC; kind++)
    for (int rule = 0; rule < 3; rule++)
      for (int more = 0; more < 4; more++) {
        gg_scene s = scene_of((gg_engine_kind)kind, 0.1, 0.8, rules[rule][0], more % 2 ? 2000 : 400);
        for (int p = 0; p < GG_PAIRS; p++) s.collision.mu[p] = rules[rule][1];
        set_kicks(&s, 0.3, rule == 1 ? -0.2 : 0.4);
        if (more > 1) s.n_species = 2;
        for (int i = 0; i < s.n_species; i++) s.species[i] = (gg_species){0.5, 1 + 0.4 * i, 1 + 2 * i, 0.4, 1, 0};
        if (more == 3) s.dsmc.precision = GG_SINGLE;
        check_books((gg_engine_kind)kind, &s);
      }
}

/* zeta = 0 and d<v^4>/dt = 0 in the first Sonine approximation, linear in a2, for d = 3 and D in units of v_0 =
 * sqrt(2T/m). With x = k.g_12/v_0 and A = (1+e) x/2 + D a collision changes v_1 by -A k. So <x (A^2 - A x)> = 0 and
 * <x Delta(v_1^4 + v_2^4)> = 0 over x > 0. (The model of J.J. Brey, M.I. Garcia de Soria & P. Maynar, Phys. Rev. E
 * 87 (2013) 052201, and V. Garzo, R. Brito & R. Soto, Phys. Rev. E 98 (2018) 052904, in three dimensions.) */
static double energy_residue(double e, double D, double a2)
{
  const double root = sqrt(2 * M_PI);
  return 2 * D * D + root * D * e + e * e - 1 + a2 * (-D * D / 8 + 3. / 16 * (e * e - 1));
}

static double cumulant_of(double e, double D)
{
  const double root = sqrt(2 * M_PI), e2 = e * e, e4 = e2 * e2, D2 = D * D;
  const double zeroth =
      2 * D2 * D2 + 2 * root * D2 * D * e + D2 * (6 * e2 + 7) + root * D * e * (1.5 * e2 + 3.5) + e4 + 3.5 * e2 - 4.5;
  const double first = -D2 * D2 / 8 + D2 * (9 * e2 / 8 + 45. / 16) + root * D * (0.75 * e2 * e + 3.25 * e - 1) +
                       15 * e4 / 16 + 177 * e2 / 32 - 2 * e - 271. / 32;
  return -zeroth / first;
}

static double sonine(double e, double *a2)
{
  double low = 0, high = 1; /* D/v_0 */
  for (int i = 0; i < 60; i++) {
    const double D = 0.5 * (low + high);
    *(energy_residue(e, D, cumulant_of(e, D)) < 0 ? &low : &high) = D;
  }
  *a2 = cumulant_of(e, low);
  return 1 / (2 * low * low); /* T/(m D^2) */
}

enum { LEFT_OUT = 30, BLOCKS = 40 };
static void check_steady(gg_engine_kind kind, double phi, int64_t n, int block, double e, const double T_mc[2],
                         const double a2_mc[2], double allowed)
{
  const double D = 0.1;
  gg_scene s = scene_of(kind, phi, e, -1, n);
  for (int p = 0; p < GG_PAIRS; p++) s.collision.kick[GG_NORMAL_KICK][p] = D;
  const gg_model m = model_of(&s);
  gg_engine *g = engine_of(&m, kind, 3);
  lab_mean T = {0}, c = {0};
  double a2;
  const double expected = sonine(e, &a2);
  advance(g, INFINITY, LEFT_OUT * (uint64_t)n);
  for (int b = 0; b < BLOCKS; b++) {
    double sum = 0, fourth = 0;
    for (int k = 0; k < block; k++) {
      advance(g, INFINITY, (uint64_t)n);
      const lab_view v = view_of(g);
      const double now = lab_temperature(&v);
      sum += now / (1 - 1 / (double)n), fourth += v.c4 / v.n / (15 * now * now) * (1 + 2 / (3 * (double)n)) - 1;
    }
    lab_add(&T, sum / block / (D * D)), lab_add(&c, fourth / block);
  }
  printf("# engine %d, e = %g: T/D^2 %.3f +- %.3f, Sonine %.3f; a2 %.4f +- %.4f, Sonine %.4f\n", kind, e, lab_value(&T),
         lab_error(&T), expected, lab_value(&c), lab_error(&c), a2);
  lab_expect("T/D^2", &T, T_mc[0], T_mc[1] + allowed * T_mc[0], 0.02);
  lab_expect("a2", &c, a2_mc[0], a2_mc[1] + allowed, 0.25);
  assert_true(fabs(lab_value(&T) / expected - 1) < 4e-3 && fabs(lab_value(&c) / a2 - 1) < 0.2);
  g->ops->destroy(g);
}

/* Expected: an independent program, Bird's method in 40 000 grains, each pair of a random pairing a candidate. Enskog's
 * equation has the same T and a2 at any density. `allowed`: 1/N of few grains; correlations of md at phi = 0.01. */
static void steady_temperature_and_cumulant(void **state)
{
  (void)state;
  static const double T8[] = {20.9965, 0.0067}, a8[] = {-0.04053, 0.00012}, T9[] = {81.348, 0.009},
                      a9[] = {-0.0232, 0.0002};
  check_steady(GG_DSMC, 0, 20000, 20, 0.8, T8, a8, 0);
  check_steady(GG_DSMC, 0, 20000, 60, 0.9, T9, a9, 0);
  check_steady(GG_DSMC, 0, 700, 20, 0.8, T8, a8, 1e-3); /* one candidate after another */
  check_steady(GG_MD, 0.01, 2000, 10, 0.8, T8, a8, 1e-3);
}

/* Rare collisions: the drag of the bath alone holds the mean spin, I gamma_r omega = torque. */
static void drag_balances_torque(void **state)
{
  (void)state;
  for (int kind = GG_MD; kind <= GG_DSMC; kind++) {
    gg_scene s = scene_of((gg_engine_kind)kind, 1e-3, 0.9, 0, 2000);
    s.thermostat = GG_BATH;
    s.bath.drag = 3, s.bath.temperature = 0.02, s.bath.rotation = 2, s.species[0].torque = 0.3;
    const gg_model m = model_of(&s);
    gg_engine *g = engine_of(&m, (gg_engine_kind)kind, 3);
    lab_mean omega = {0};
    /* Collisions change spins at (2/3)(1+beta)/(1+K) of their rate. */
    const double friction = 2. / 3 / 1.4 * gg_common_model_collision_rate(&m, 0.02 + 0.01);
    advance(g, 3, UINT64_MAX);
    for (int b = 0; b < 20; b++) {
      advance(g, 2, UINT64_MAX);
      const lab_view v = view_of(g);
      lab_add(&omega, 2 * v.s_mean[2] / v.n);
    }
    lab_expect("omega of drag", &omega, 0.3 / 0.1 / (6 + friction), 5e-4, 0.02);
    g->ops->destroy(g);
  }
}

/* A mean spin that begins with Maxwellians decays by friction at the rate r = nu (2/3)(1+beta)/(1+K), nu the collision
 * rate of a grain; a torque adds to it at the rate N/I. */
static void friction_and_torque_change_the_mean_spin(void **state)
{
  (void)state;
  const double K = 0.4, beta = 0.3, N = 0.5, spin = 8, I = K / 4;
  for (int kind = GG_MD; kind <= GG_DSMC; kind++) {
    lab_mean faster = {0};
    double expected = 0;
    for (int seed = 0; seed < 16; seed++) {
      gg_scene s = scene_of((gg_engine_kind)kind, 0.02, 0.9, beta, 8000);
      s.start.spin = spin, s.start.temperature = 1, s.start.rotational_temperature = 1, s.species[0].torque = N;
      const gg_model m = model_of(&s);
      gg_engine *g = engine_of(&m, (gg_engine_kind)kind, 10 + (uint64_t)seed);
      const double nu = gg_common_model_collision_rate(&m, 1), r = nu * 2 / 3 * (1 + beta) / (1 + K), t = 0.2 / nu;
      const lab_view before = view_of(g);
      const double omega = 2 * before.s_mean[2] / before.n;
      const double elapsed = kind == GG_MD ? t : 0.25 / nu;
      advance(g, elapsed, UINT64_MAX);
      gg_engine_state now;
      g->ops->state(g, &now);
      const lab_view after = view_of(g);
      const double decay = exp(-r * now.time), end = omega * decay + N / I / r * (1 - decay);
      lab_add(&faster, (2 * after.s_mean[2] / after.n - omega) / (end - omega)), expected = 1;
      g->ops->destroy(g);
    }
    lab_expect("change of mean spin", &faster, expected, 2e-3, 0.04);
  }
}

/* Hash of velocities and spins. */
static void add_bits(void *context, const gg_chunk *k)
{
  uint64_t *h = context;
  for (size_t i = 0; i < k->n; i++)
    for (int a = 0; a < 6; a++) {
      const double *of = a < 3 ? k->c[a] : k->s[a - 3];
      uint64_t bits = 0;
      if (of) memcpy(&bits, &of[i], sizeof bits);
      *h = (*h ^ bits) * 0x100000001b3u;
    }
}

static uint64_t bits_of(gg_engine *g)
{
  uint64_t h = 5;
  gg_collision_sums sums;
  g->ops->snapshot(g, false, add_bits, &h);
  g->ops->take_sums(g, &sums);
  for (size_t i = 0; i < sizeof sums; i++) h = (h ^ ((unsigned char *)&sums)[i]) * 0x100000001b3u;
  return h;
}

/* Saved and restored, at times and after collisions, a gas continues with the same bits. */
static void check_resumed(gg_engine_kind kind, const gg_scene *s)
{
  const gg_model m = model_of(s);
  gg_engine *g = engine_of(&m, kind, 9);
  assert_true(m.kicks || m.turns);
  for (int k = 0; k < 4; k++) {
    gg_archive archive = {0};
    gg_engine *back = NULL;
    gg_error err = {0};
    if (k % 2)
      advance(g, 0.3 / gg_common_model_collision_rate(&m, m.temperature0), UINT64_MAX);
    else
      advance(g, INFINITY, 3000);
    assert_int_equal(g->ops->save(g, &archive, &err), GG_OK);
    if (g->ops->restore(&m, &archive, &back, &err) != GG_OK) fail_msg("%s", err.message);
    gg_base_archive_clear(&archive);
    advance(g, INFINITY, 4000);
    advance(back, INFINITY, 4000);
    if (bits_of(g) != bits_of(back)) fail_msg("engine %d, flow %d, rule %d: part %d", kind, s->flow, (int)m.rule, k);
    g->ops->destroy(g);
    g = back;
  }
  g->ops->destroy(g);
}

static void resumed_runs_have_the_same_bits(void **state)
{
  (void)state;
  static const gg_flow flows[] = {GG_HSS, GG_USF, GG_COUETTE};
  static const double rules[][2] = {{0.3, INFINITY}, {0.2, 0.4}};
  for (int kind = GG_MD; kind <= GG_DSMC; kind++)
    for (int f = 0; f < 3; f++)
      for (int rule = 0; rule < 2; rule++)
        for (int kicks = 0; kicks < 2; kicks++) {
          gg_scene s = scene_of((gg_engine_kind)kind, 0.1, 0.8, rules[rule][0], 600);
          s.flow = flows[f];
          if (s.flow != GG_HSS) s.thermostat = GG_NO_THERMOSTAT;
          for (int p = 0; p < GG_PAIRS; p++) s.collision.mu[p] = rules[rule][1];
          if (kicks) set_kicks(&s, 0.3, -0.2);
          s.start.spin = s.flow == GG_COUETTE ? 0 : 3, s.n_species = 1 + kicks;
          for (int i = 0; i < s.n_species; i++) s.species[i] = (gg_species){0.5, 1 + 0.4 * i, 1 + 2 * i, 0.4, 1, 0.2};
          check_resumed((gg_engine_kind)kind, &s);
        }
}

/* A torque alone is no thermostat: it leaves free paths, events for several threads, and no kicks between collisions.
 */
static void a_torque_alone_is_no_bath(void **state)
{
  (void)state;
  gg_scene s = scene_of(GG_MD, 0.2, 0.9, 0, 6000);
  s.species[0].torque = 0.3;
  s.aspect[2] = 4;
  const gg_model m = model_of(&s);
  assert_true(m.turns && !m.bath.on);
  assert_int_equal(gg_common_heat_of(&m), GG_UNHEATED);
  assert_null(gg_md_serial_because(&m));
}

/* Between collisions spins change at the constant rate N/I, to rounding, in md between two snapshots of any distance;
 * in dsmc at the end of each step. Between walls, too. */
static void free_spins_change_at_a_constant_rate(void **state)
{
  (void)state;
  for (int kind = GG_MD; kind <= GG_DSMC; kind++)
    for (int walls = 0; walls < 2; walls++) {
      gg_scene s = scene_of((gg_engine_kind)kind, 1e-9, 0.9, 0, 500);
      if (walls) s.flow = GG_COUETTE, s.thermostat = GG_NO_THERMOSTAT, s.walls.beta = -1;
      s.species[0].torque = 0.3, s.start.temperature = 1;
      const gg_model m = model_of(&s);
      gg_engine *g = engine_of(&m, (gg_engine_kind)kind, 3);
      for (int k = 0; k < 3; k++) {
        const lab_view before = view_of(g);
        gg_engine_state then, now;
        g->ops->state(g, &then);
        advance(g, 0.37, UINT64_MAX);
        g->ops->state(g, &now);
        const lab_view after = view_of(g);
        assert_true(now.collisions == 0 && now.time > then.time);
        const double turned = (after.s_mean[2] - before.s_mean[2]) / after.n,
                     right = m.torque[0] * (now.time - then.time);
        if (fabs(turned - right) > 1e-9 * right) fail_msg("engine %d: %g, expected %g", kind, turned, right);
        assert_true(fabs(after.s_mean[0] - before.s_mean[0]) < 1e-9 * right * after.n);
      }
      g->ops->destroy(g);
    }
}

static bool is_steady_with(double beta, double D, double D_t)
{
  gg_scene s = scene_of(GG_DSMC, 0.1, 0.8, beta, 1000);
  set_kicks(&s, D, D_t);
  return model_of(&s).steady;
}

static bool is_steady(double e, double beta, double rotation, double torque, double D)
{
  gg_scene s = scene_of(GG_DSMC, 0.1, e, beta, 1000);
  if (rotation >= 0) s.thermostat = GG_BATH, s.bath.rotation = rotation;
  s.species[0].torque = torque;
  set_kicks(&s, D, 0);
  return model_of(&s).steady;
}

/* Collisions or drag have to take what kicks and torques give, and friction or the bath has to hold each spin. */
static void steady_states(void **state)
{
  (void)state;
  assert_true(is_steady(0.9, -1, -1, 0, 0.1));
  assert_false(is_steady(1, -1, -1, 0, 0.1));
  assert_true(is_steady(1, -1, 0, 0, 0.1)); /* drag of a bath */
  assert_true(is_steady(0.9, 0, -1, 0.1, 0));
  assert_true(is_steady(1, 0, -1, 0.1, 0));
  assert_false(is_steady(1, 1, -1, 0.1, 0));
  assert_true(is_steady_with(-1, 0, 0.1));
  assert_true(is_steady_with(0, 0.1, 0.1));
  assert_false(is_steady_with(0, 0, 0.1));         /* spins take up the kicks */
  gg_scene hot = scene_of(GG_MD, 0.1, 1, 1, 1000); /* the start of a gas that heats up for ever is of the scale of D */
  set_kicks(&hot, 0.1, 0);
  assert_true(model_of(&hot).temperature0 < 1);
  gg_scene s = scene_of(GG_MD, 0.1, 0.9, -1, 1000);
  s.n_species = 2, s.species[0].fraction = s.species[1].fraction = 0.5;
  s.collision.beta[gg_pair(0, 0)] = 0, s.species[1].torque = 0.1; /* the second species is smooth */
  assert_false(model_of(&s).steady);
  s.thermostat = GG_BATH, s.bath.rotation = 1;
  assert_true(model_of(&s).steady);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(energy_is_counted),
      cmocka_unit_test(steady_temperature_and_cumulant),
      cmocka_unit_test(drag_balances_torque),
      cmocka_unit_test(friction_and_torque_change_the_mean_spin),
      cmocka_unit_test(steady_states),
      cmocka_unit_test(resumed_runs_have_the_same_bits),
      cmocka_unit_test(a_torque_alone_is_no_bath),
      cmocka_unit_test(free_spins_change_at_a_constant_rate),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
