/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Coefficients by the normal speed in both engines: every collision has the e, beta and mu of its own speed; the loss
 * of a Maxwellian gas with a step; Haff's law of e = 1 - c v^(1/5); constant formulas beside constants; restarts. */
#include "../dsmc/lab.h"

#include <stdbool.h>

#include "scene/scene_reader.h"

static void set(gg_scene *s, const char *key, const char *value)
{
  gg_error err = {0};
  if (gg_scene_override(s, key, value, &err) != GG_OK) fail_msg("%s", err.message);
}

static gg_scene scene_of(gg_engine_kind kind, gg_flow flow, double phi, int64_t n)
{
  gg_scene s = lab_scene(flow, phi, 0.9, -1, n);
  s.engine = kind;
  s.particles = n;
  return s;
}

static gg_model *model_of(const gg_scene *s)
{
  gg_model *m = malloc(sizeof *m);
  gg_error err = {0};
  if (gg_scene_model_make(s, s->engine, m, &err) != GG_OK) fail_msg("%s", err.message);
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

static double temperature(gg_engine *g)
{
  lab_view v = {0};
  g->ops->snapshot(g, false, lab_add_chunk, &v);
  return (v.cc[0][0] + v.cc[1][1] + v.cc[2][2]) / (3 * v.n);
}

/* The law of the tests, stated here once more. */
static double e_of(double v, bool one)
{
  return one ? v < 1 ? 0.9 : 0.6 : 1.2 - 0.2 * v > 0 ? 1.2 - 0.2 * v : 0;
}
static double mu_of(double v)
{
  return 0.4 / (1 + v);
}

typedef struct contacts {
  int n, slid;
  double worst;
} contacts;

/* J_n = m_r (1 + e) g_n, and J_t is at most mu J_n: for unequal masses. */
static void check_contact(void *context, const gg_collision_record *r)
{
  contacts *c = context;
  const double mass[] = {1, 2}, m1 = mass[r->species[0]], m2 = mass[r->species[1]], mr = m1 * m2 / (m1 + m2);
  const bool one = r->species[0] == 0 && r->species[1] == 0;
  const double gn = gg_dot(r->k, r->c12), Jn = gg_dot(r->k, r->J), e = one ? e_of(gn, true) : e_of(gn, false);
  const gg_vec Jt = gg_axpy(-Jn, r->k, r->J);
  const double friction = sqrt(gg_dot(Jt, Jt)) / Jn / mu_of(gn);
  c->n++, c->slid += friction > 1 - 1e-4;
  c->worst = fmax(c->worst, fmax(fabs(Jn / (mr * (1 + e) * gn) - 1), friction - 1));
}

static void every_contact_has_the_coefficients_of_its_speed(void **state)
{
  (void)state;
  for (gg_engine_kind kind = GG_MD; kind <= GG_DSMC; kind++) {
    gg_scene s = scene_of(kind, GG_USF, 0.1, 1000);
    s.n_species = 2;
    s.species[1] = s.species[0];
    s.species[0].fraction = s.species[1].fraction = 0.5, s.species[1].mass = 2;
    set(&s, "collision.e", "{11: 0.9 if v < 1 else 0.6, other: 1.2 - 0.2*v}");
    set(&s, "collision.beta", "0.3");
    set(&s, "collision.mu", "0.4/(1 + v)");
    s.md.contact_time = 0;
    gg_model *m = model_of(&s);
    gg_engine *g = engine_of(m, kind, 1);
    gg_error err = {0};
    gg_engine_state now;
    contacts c = {0};
    assert_int_equal(g->ops->set_callback(g, check_contact, &c, &err), GG_OK);
    advance(g, INFINITY, 5000);
    g->ops->state(g, &now);
    print_message("# %s: %d contacts, %d slide, within %.1e; %d clamped\n", kind == GG_MD ? "md" : "dsmc", c.n, c.slid,
                  c.worst, (int)now.clamped);
    assert_true(c.n >= 5000 && c.slid > 500 && c.slid < c.n - 200);
    assert_true(c.worst < 2e-3); /* kinks of e are within a cell of the table */
    g->ops->destroy(g);
    free(m);
  }
}

/* Loss of the energy of translation of a Maxwellian gas of mass 1 at the temperature T, per collision: speeds at impact
 * fall as g exp(-g^2/(4T)), and the mean square of the tangential velocity of grains that do not spin is 4 T. */
static double loss_at(double T, double (*e)(double v), double (*beta)(double v))
{
  double lost = 0, all = 0;
  for (double y = 0.0005; y < 8; y += 0.001) {
    const double g = y * sqrt(4 * T), weight = y * exp(-y * y), x = e(g);
    const double jt = beta ? 0.5 / 3.5 * (1 + beta(g)) : 0; /* m_t (1 + beta), K = 0.4 */
    lost += weight * (0.25 * (1 - x * x) * g * g + jt * (1 - jt) * 4 * T), all += weight;
  }
  return lost / all;
}

static double step_of_e(double v)
{
  return v < 2 ? 0.9 : 0.6;
}
static double root_of_e(double v)
{
  return 1 - 0.1 * pow(v, 0.2);
}
static double gain_of_e(double v)
{
  return v < 1 ? 1.1 : 0.7;
}
static double step_of_beta(double v)
{
  return v < 2 ? 0.8 : -0.9;
}

/* T a time t later, as long as the gas is Maxwellian. */
static double cooled(const gg_model *m, double T, double t, double (*e)(double v), double (*beta)(double v))
{
  enum { STEPS = 50 };
  for (int k = 0; k < STEPS; k++) {
    const double half = T - 0.5 * t / STEPS * gg_common_model_collision_rate(m, T) / 2 * loss_at(T, e, beta) / 1.5;
    T -= t / STEPS * gg_common_model_collision_rate(m, half) / 2 * loss_at(half, e, beta) / 1.5;
  }
  return T;
}

/* The energy of translation that a Maxwellian gas loses in a fifth of a collision a grain, over a quadrature; before
 * the distribution changes. With beta(v) in a twentieth, before grains spin. */
static void check_loss(gg_engine_kind kind, int64_t n, gg_precision precision, const char *law, double (*e)(double v),
                       double (*beta)(double v))
{
  enum { SEEDS = 12 };
  double sum = 0, squares = 0;
  gg_scene s = scene_of(kind, GG_HSS, kind == GG_MD ? 0.01 : 0, n);
  s.thermostat = GG_BATH, s.bath.drag = 1e-12, s.bath.temperature = 1; /* none that matters */
  s.start.temperature = 1.7;
  s.dsmc.precision = precision;
  if (beta) s.start.rotational_temperature = 0;
  set(&s, beta ? "collision.beta" : "collision.e", law);
  gg_model *m = model_of(&s);
  const double T = m->temperature0, time = (beta ? 0.05 : 0.2) / gg_common_model_collision_rate(m, T),
               last = cooled(m, T, time, e, beta);
  assert_true(fabs(T / 1.7 - 1) < 1e-12);
  for (int seed = 0; seed < SEEDS; seed++) {
    gg_engine *g = engine_of(m, kind, (uint64_t)seed);
    gg_engine_state now;
    const double before = temperature(g);
    advance(g, time, UINT64_MAX);
    g->ops->state(g, &now);
    const double expected = cooled(m, T, now.time, e, beta), x = (temperature(g) - before) / (expected - T);
    sum += x, squares += x * x;
    g->ops->destroy(g);
  }
  const double mean = sum / SEEDS, error = sqrt((squares / SEEDS - mean * mean) / (SEEDS - 1));
  print_message("# %s, %s, %d grains: T from %.3f to %.4f; loss over the quadrature %.4f +- %.4f\n", law,
                kind == GG_MD ? "md" : "dsmc", (int)n, T, last, mean, error);
  assert_true(error < (kind == GG_MD ? 0.03 : 0.012));
  assert_true(fabs(mean - 1) < 4.5 * error + (beta ? 0.02 : 0.004));
  free(m);
}

static double constant_e(double v)
{
  return 0.9 + 0 * v;
}

static void a_step_loses_what_a_quadrature_says(void **state)
{
  (void)state;
  check_loss(GG_DSMC, 80000, GG_DOUBLE, "'0.9 if v < 2 else 0.6'", step_of_e, NULL);
  check_loss(GG_DSMC, 80000, GG_SINGLE, "'0.9 if v < 2 else 0.6'", step_of_e, NULL);
  check_loss(GG_DSMC, 80000, GG_DOUBLE, "{table: [[0, 0.9], [2, 0.9], [2, 0.6]]}", step_of_e, NULL);
  check_loss(GG_DSMC, 80000, GG_DOUBLE, "'1.1 if v < 1 else 0.7'", gain_of_e, NULL);
  check_loss(GG_MD, 4000, GG_DOUBLE, "'0.9 if v < 2 else 0.6'", step_of_e, NULL);
  check_loss(GG_DSMC, 80000, GG_DOUBLE, "'0.8 if v < 2 else -0.9'", constant_e, step_of_beta);
}

/* Haff's law of e = 1 - c v^(1/5): T ~ t^(-5/3) (Schwager & Poeschel, Phys. Rev. E 57 (1998) 650). Over the last factor
 * 8 of time, beside Maxwellians. */
static void haff_in(gg_engine_kind kind, int64_t n)
{
  enum { SEEDS = 6, TIMES = 7 };
  gg_scene s = scene_of(kind, GG_HCS, 0.01, n);
  set(&s, "collision.e", "'1 - 0.1*v^0.2'");
  gg_model *m = model_of(&s);
  const double rate = gg_common_model_collision_rate(m, m->temperature0) / 2 *
                      loss_at(m->temperature0, root_of_e, NULL) / (1.5 * m->temperature0);
  double sum = 0, squares = 0, T[TIMES], expected = m->temperature0, early = 0, at = 0;
  for (int k = 0; k < TIMES; k++) {
    const double end = ldexp(10 / rate, k);
    for (int part = 0; part < 20; part++) expected = cooled(m, expected, (end - at) / 20, root_of_e, NULL);
    at = end;
    if (k == TIMES - 4) early = expected;
  }
  const double maxwellian = log(expected / early) / log(8);
  for (int seed = 0; seed < SEEDS; seed++) {
    gg_engine *g = engine_of(m, kind, (uint64_t)seed);
    for (int k = 0; k < TIMES; k++) {
      gg_engine_state now;
      g->ops->state(g, &now);
      advance(g, ldexp(10 / rate, k) - now.time, UINT64_MAX);
      T[k] = temperature(g);
    }
    const double slope = log(T[TIMES - 1] / T[TIMES - 4]) / log(8);
    sum += slope, squares += slope * slope;
    g->ops->destroy(g);
  }
  const double mean = sum / SEEDS, error = sqrt((squares / SEEDS - mean * mean) / (SEEDS - 1));
  print_message("# %s: T ~ t^%.4f +- %.4f, Maxwellians %.4f, -5/3 = -1.6667\n", kind == GG_MD ? "md" : "dsmc", mean,
                error, maxwellian);
  assert_true(error < 0.02 && fabs(mean - maxwellian) < 4.5 * error + 0.003);
  assert_true(fabs(maxwellian + 5. / 3) < 0.03 && mean - 4 * error > -1.85);
  free(m);
}

static void cooling_follows_haff(void **state)
{
  (void)state;
  haff_in(GG_DSMC, 4000);
  haff_in(GG_MD, 300);
}

/* A formula that is constant but for its form gives the same temperature as the constant, until rounding has grown. */
static double temperature_after(gg_engine_kind kind, int64_t n, const char *key, const char *value)
{
  gg_scene s = scene_of(kind, GG_USF, 0.1, n);
  set(&s, "collision.beta", "0.2"), set(&s, "collision.mu", "0.3");
  set(&s, key, value);
  gg_model *m = model_of(&s);
  gg_engine *g = engine_of(m, kind, 3);
  advance(g, INFINITY, (uint64_t)n);
  const double T = temperature(g);
  g->ops->destroy(g);
  free(m);
  return T;
}

static void constant_formulas_give_the_same_temperature(void **state)
{
  (void)state;
  static const char *const cases[][3] = {{"collision.e", "0.9", "0.9 + 0*v"},
                                         {"collision.beta", "0.2", "0.2 + 0*v"},
                                         {"collision.mu", "0.3", "0.3 + 0*v"}};
  for (gg_engine_kind kind = GG_MD; kind <= GG_DSMC; kind++)
    for (size_t c = 0; c < 3; c++) {
      const int64_t n = kind == GG_DSMC ? 5000 : 500;
      const double T = temperature_after(kind, n, cases[c][0], cases[c][1]),
                   law = temperature_after(kind, n, cases[c][0], cases[c][2]);
      print_message("# %s, %s: T off by %.1e\n", kind == GG_MD ? "md" : "dsmc", cases[c][2], fabs(law / T - 1));
      assert_true(fabs(law / T - 1) < 1e-9);
    }
  gg_scene s = scene_of(GG_MD, GG_USF, 0.1, 500);
  set(&s, "collision.e", "'0.9'");
  assert_false(gg_scene_has_law(&s));
}

static void add_bits(void *context, const gg_chunk *c)
{
  uint64_t *hash = context;
  for (int a = 0; a < 3; a++)
    for (size_t i = 0; i < c->n; i++) {
      uint64_t bits;
      memcpy(&bits, &c->c[a][i], sizeof bits);
      *hash = (*hash ^ bits) * 0x100000001b3u;
    }
}

static void a_restored_run_has_the_same_bits(void **state)
{
  (void)state;
  for (gg_engine_kind kind = GG_MD; kind <= GG_DSMC; kind++)
    for (int frictional = 0; frictional < 2; frictional++) {
      gg_scene s = scene_of(kind, frictional ? GG_USF : GG_HCS, 0.2, 1000);
      set(&s, "collision.e", "'0.9 if v < 0.5 else 1 - 0.3*v^0.2'");
      if (frictional) set(&s, "collision.beta", "0.2"), set(&s, "collision.mu", "0.3 + 0.1*tanh(v)");
      gg_model *m = model_of(&s);
      gg_engine *g = engine_of(m, kind, 2), *back = NULL;
      gg_archive a = {0};
      gg_error err = {0};
      advance(g, INFINITY, 10000);
      assert_int_equal(g->ops->save(g, &a, &err), GG_OK);
      assert_int_equal(g->ops->restore(m, &a, &back, &err), GG_OK);
      advance(g, INFINITY, 10000), advance(back, INFINITY, 10000);
      uint64_t hash[2] = {0};
      g->ops->snapshot(g, false, add_bits, &hash[0]), back->ops->snapshot(back, false, add_bits, &hash[1]);
      assert_true(hash[0] == hash[1] && hash[0] != 0);
      gg_base_archive_clear(&a);
      g->ops->destroy(g), back->ops->destroy(back);
      free(m);
    }
}

int main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test(every_contact_has_the_coefficients_of_its_speed),
                                     cmocka_unit_test(a_step_loses_what_a_quadrature_says),
                                     cmocka_unit_test(cooling_follows_haff),
                                     cmocka_unit_test(constant_formulas_give_the_same_temperature),
                                     cmocka_unit_test(a_restored_run_has_the_same_bits)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
