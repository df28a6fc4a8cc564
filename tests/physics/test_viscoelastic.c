/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A gas of viscoelastic grains: Haff's law T ~ t^(-5/3) in both engines, md beside dsmc in shear, no inelastic
 * collapse, and restarts. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "common/engine.h"
#include "common/laws/laws.h"
#include "run/run.h"
#include "run/z_scores.h"
#include "scene/model_of_scene.h"

static gg_scene scene_of(gg_flow flow, double phi, double e, int64_t n)
{
  gg_scene s = gg_scene_defaults();
  s.flow = flow;
  s.phi = phi;
  s.particles = n;
  s.collision.e[0] = e;
  s.collision.law = GG_LAW_VISCOELASTIC;
  return s;
}

static gg_model model_of(const gg_scene *s, gg_engine_kind kind)
{
  gg_model m;
  gg_error err;
  if (gg_scene_model_make(s, kind, &m, &err) != GG_OK) fail_msg("%s", err.message);
  return m;
}

static gg_engine *engine_of(const gg_model *m, gg_engine_kind kind, uint64_t seed)
{
  gg_engine *g = NULL;
  gg_error err;
  if (gg_common_engine_of(kind)->create(m, seed, 0, &g, &err) != GG_OK) fail_msg("%s", err.message);
  return g;
}

static void advance(gg_engine *g, double dt, uint64_t collisions)
{
  double elapsed;
  gg_error err;
  if (g->ops->advance(g, dt, collisions, &elapsed, &err) != GG_OK) fail_msg("%s", err.message);
}

static void add_squares(void *context, const gg_chunk *c)
{
  double *sum = context;
  for (size_t i = 0; i < c->n; i++)
    for (int a = 0; a < 3; a++) sum[0] += c->c[a][i] * c->c[a][i], sum[1] += 1;
}

static double temperature(gg_engine *g)
{
  double sum[2] = {0};
  g->ops->snapshot(g, false, add_squares, sum);
  return sum[0] / sum[1];
}

/* d ln T/dt of Maxwellians: a collision of two grains of mass 1 loses (1 - e^2) g^2/4, and speeds at impact fall as g
 * exp(-g^2/(4T)). */
static double cooling_rate(const gg_model *m, double T)
{
  double lost = 0, all = 0;
  for (double y = 0.0025; y < 8; y += 0.005) { /* g/sqrt(4T) */
    double g = y * sqrt(4 * T), e = gg_common_law_at(&m->law, g, 0, 0, NULL), weight = y * exp(-y * y);
    lost += weight * 0.25 * (1 - e * e) * g * g, all += weight;
  }
  return gg_common_model_collision_rate(m, T) / 2 * (lost / all) / (1.5 * T);
}

/* T at `first` and after each factor 2 of time from there on: as cooling_rate has it, and of an engine. */
enum { TIMES = 7, SEEDS = 8 };
static void theory(const gg_model *m, double first, double T[TIMES])
{
  double now = m->temperature0, t = 0;
  for (int k = 0; k < TIMES; k++) {
    const double end = ldexp(first, k);
    for (double dt; t < end; t = dt < end - t ? t + dt : end) {
      dt = 0.01 / cooling_rate(m, now);
      const double step = fmin(dt, end - t), middle = now * exp(-0.5 * step * cooling_rate(m, now));
      now *= exp(-step * cooling_rate(m, middle));
    }
    T[k] = now;
  }
}

static void simulated(const gg_model *m, gg_engine_kind kind, uint64_t seed, double first, double T[TIMES])
{
  gg_engine *g = engine_of(m, kind, seed);
  for (int k = 0; k < TIMES; k++) {
    gg_engine_state now;
    g->ops->state(g, &now); /* dsmc may have gone a little further than it was asked to */
    advance(g, ldexp(first, k) - now.time, UINT64_MAX);
    T[k] = temperature(g);
  }
  g->ops->destroy(g);
}

/* Over the last factor 8 of time. */
static double exponent(const double T[TIMES])
{
  return log(T[TIMES - 1] / T[TIMES - 4]) / log(8);
}

/* T ~ t^(-5/3): 2 of constant e is far off; what is left of the beginning, and of the series of e, is what Maxwellians
 * have, too, whose T the simulated one follows within what Sonine corrections come to, 0.5 %. */
static void haff_in(gg_engine_kind kind, int64_t n)
{
  gg_scene s = scene_of(GG_HCS, 0.01, 0.9, n);
  s.dsmc.particles = n;
  gg_model m = model_of(&s, kind);
  const double first = 10 / cooling_rate(&m, m.temperature0);
  double expected[TIMES], sum = 0, squares = 0, last = 0, last_squares = 0;
  theory(&m, first, expected);
  for (int seed = 0; seed < SEEDS; seed++) {
    double T[TIMES];
    simulated(&m, kind, (uint64_t)seed, first, T);
    sum += exponent(T), squares += exponent(T) * exponent(T);
    const double off = log(T[TIMES - 1] / expected[TIMES - 1]);
    last += off / SEEDS, last_squares += off * off / SEEDS;
  }
  const double mean = sum / SEEDS, error = sqrt((squares / SEEDS - mean * mean) / (SEEDS - 1));
  const double last_error = sqrt((last_squares - last * last) / (SEEDS - 1));
  print_message("# %s: T ~ t^%.4f +- %.4f, Maxwellians %.4f, -5/3 = -1.6667; T over theirs at the end %.4f +- %.4f\n",
                kind == GG_MD ? "md" : "dsmc", mean, error, exponent(expected), exp(last), last_error);
  assert_true(error < 0.01);
  assert_true(fabs(mean - exponent(expected)) < 4.5 * error + 0.003);
  assert_true(fabs(exponent(expected) + 5. / 3) < 0.03 && mean - 8 * error > -1.8);
  assert_true(fabs(exp(last) - 1) < 4.5 * last_error + 0.012);
}

static void cooling_follows_haff_for_viscoelastic_grains(void **state)
{
  (void)state;
  haff_in(GG_DSMC, 20000);
  haff_in(GG_MD, 1000);
}

static const gg_quantity compared[] = {GG_Q_TEMPERATURE,    GG_Q_PRESSURE, GG_Q_SHEAR_VISCOSITY,
                                       GG_Q_COLLISION_RATE, GG_Q_N1,       GG_Q_TEMPERATURE_RATIO};

static gg_comparison compare(const gg_scene *s)
{
  gg_comparison c;
  gg_error err;
  if (gg_run_compare_scene(s, NULL, 1, NULL, &c, &err) != GG_OK) fail_msg("%s", err.message);
  return c;
}

/* The work of shear is the energy that collisions dissipate. */
static void check_balance(const gg_comparison *c)
{
  for (int k = 0; k < 2; k++) {
    const gg_estimate *balance = &c->by_engine[k]->value[GG_Q_ENERGY_BALANCE];
    print_message("# energy balance %.5f +- %.5f\n", balance->mean, balance->error);
    assert_true(fabs(balance->mean - 1) < 5 * balance->error + 2e-3);
  }
}

/* Sheared, md beside dsmc: the same where the gas is dilute. */
static void dilute_at(double beta, double mu)
{
  gg_scene s = scene_of(GG_USF, 0.01, 0.8, 1000);
  s.collision.beta[0] = beta, s.collision.mu[0] = mu;
  s.run.relative_error = 0.01;
  gg_comparison c = compare(&s);
  const gg_result *md = c.by_engine[GG_MD], *dsmc = c.by_engine[GG_DSMC];
  for (int k = 0; k < (md->model.rule == GG_SMOOTH ? 5 : 6); k++) {
    const gg_estimate *a = &md->value[compared[k]], *b = &dsmc->value[compared[k]];
    print_message("# phi 0.01, %s: md %.5g +- %.2g, dsmc %.5g +- %.2g, z = %.1f\n",
                  gg_common_quantity_name(compared[k]), a->mean, a->error, b->mean, b->error, gg_run_z_score(a, b));
    assert_true(fabs(gg_run_z_score(a, b)) < 4);
  }
  check_balance(&c);
  for (int k = 0; k < c.n_theories; k++) assert_false(c.theory[k].applies);
  gg_run_comparison_clear(&c);
}

/* ln(md/dsmc), and its error. */
static double ratio(const gg_comparison *c, gg_quantity q, double *error)
{
  const gg_estimate *a = &c->by_engine[GG_MD]->value[q], *b = &c->by_engine[GG_DSMC]->value[q];
  print_message("# phi 0.30, %s: md %.5g +- %.2g, dsmc %.5g +- %.2g, z = %.1f\n", gg_common_quantity_name(q), a->mean,
                a->error, b->mean, b->error, gg_run_z_score(a, b));
  *error = hypot(a->error / a->mean, b->error / b->mean);
  return log(a->mean / b->mean);
}

/* At phi = 0.3 velocity correlations set them apart, by 5 % in the viscosity: as far as they do with the constant e
 * that the law has at the mean speed of impact. */
static void dense(void)
{
  gg_scene s = scene_of(GG_USF, 0.3, 0.8, 1000);
  s.run.relative_error = 0.01;
  gg_comparison by_law = compare(&s);
  gg_model m = by_law.by_engine[GG_MD]->model;
  gg_common_model_at(&m, by_law.by_engine[GG_MD]->value[GG_Q_TEMPERATURE].mean);
  s.collision.law = GG_LAW_CONSTANT;
  s.collision.e[0] = m.e[0];
  print_message("# phi 0.30: then with a constant e of %.4f\n", m.e[0]);
  gg_comparison constant = compare(&s);
  for (int k = 0; k < 4; k++) {
    double error[2], apart = ratio(&by_law, compared[k], &error[0]) - ratio(&constant, compared[k], &error[1]);
    assert_true(fabs(apart) < 4 * hypot(error[0], error[1]));
  }
  check_balance(&by_law);
  gg_run_comparison_clear(&by_law), gg_run_comparison_clear(&constant);
}

static void engines_agree_on_sheared_viscoelastic_grains(void **state)
{
  (void)state;
  dilute_at(-1, INFINITY);
  dilute_at(0.2, 0.3);
  dense();
}

/* Collisions of a grain that follow its last by less than a millionth of a mean free time. */
typedef struct crowd {
  double soon;
  uint64_t crowded;
} crowd;
static void count_crowded(void *context, const gg_collision_record *c)
{
  crowd *x = context;
  x->crowded += c->since[0] < x->soon && c->since[1] < x->soon;
}

static uint64_t crowded(gg_law_kind law)
{
  gg_scene s = scene_of(GG_HCS, 0.3, 0.1, 1000);
  s.collision.law = law;
  s.md.contact_time = 0;
  gg_model m = model_of(&s, GG_MD);
  gg_engine *g = engine_of(&m, GG_MD, 1);
  gg_error err;
  crowd x = {.soon = 1e-6 / gg_common_model_collision_rate(&m, m.temperature0)};
  assert_int_equal(g->ops->set_callback(g, count_crowded, &x, &err), GG_OK);
  advance(g, INFINITY, 100000);
  g->ops->destroy(g);
  return x.crowded;
}

/* Inelastic collapse: grains of e = 0.1 come to collide without end in finite time. With the law slow collisions lose
 * nothing, whatever fast ones do, and it does not happen. */
static void no_collapse(void **state)
{
  (void)state;
  uint64_t constant = crowded(GG_LAW_CONSTANT), with_law = crowded(GG_LAW_VISCOELASTIC);
  print_message("# within 1e-6 mean free times: constant e %d of 100000, viscoelastic %d\n", (int)constant,
                (int)with_law);
  assert_true(constant > 1000);
  assert_true(with_law < 20);
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

/* A run that is saved and restored continues bit for bit. */
static void a_restored_run_has_the_same_bits(void **state)
{
  (void)state;
  for (gg_engine_kind kind = GG_MD; kind <= GG_DSMC; kind++)
    for (int rough = 0; rough < 2; rough++) {
      gg_scene s = scene_of(rough ? GG_USF : GG_HCS, 0.2, 0.7, 1000);
      if (rough) s.collision.beta[0] = 0.2, s.collision.mu[0] = 0.3;
      gg_model m = model_of(&s, kind);
      gg_engine *g = engine_of(&m, kind, 2), *back = NULL;
      gg_archive a = {0};
      gg_error err;
      advance(g, INFINITY, 20000);
      assert_int_equal(g->ops->save(g, &a, &err), GG_OK);
      assert_int_equal(g->ops->restore(&m, &a, &back, &err), GG_OK);
      advance(g, INFINITY, 20000), advance(back, INFINITY, 20000);
      uint64_t hash[2] = {0};
      g->ops->snapshot(g, false, add_bits, &hash[0]), back->ops->snapshot(back, false, add_bits, &hash[1]);
      assert_true(hash[0] == hash[1]);
      gg_base_archive_clear(&a);
      g->ops->destroy(g), back->ops->destroy(back);
    }
}

int main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test(cooling_follows_haff_for_viscoelastic_grains),
                                     cmocka_unit_test(engines_agree_on_sheared_viscoelastic_grains),
                                     cmocka_unit_test(no_collapse), cmocka_unit_test(a_restored_run_has_the_same_bits)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
