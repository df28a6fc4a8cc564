/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Conservation laws hold to rounding: momentum always, energy where e = 1 and beta = +-1. The momentum stays at
 * rounding however far the gas cools. */
#include "lab.h"

static double energy(gg_engine *g, const gg_model *m)
{
  lab_view v = lab_snapshot(g);
  return v.cc[0][0] + v.cc[1][1] + v.cc[2][2] + m->inertia[0] * v.ss;
}

static double drift(double phi, double beta, double mu, int64_t n)
{
  gg_scene s = lab_scene(GG_EQUILIBRIUM, phi, 1, beta, n);
  s.collision.mu[0] = mu;
  gg_model m = lab_model(&s);
  m.ratio0 = 0.3;
  gg_engine *g = lab_engine(&m, 3);
  double before = energy(g, &m);
  lab_advance(g, INFINITY, 50 * (uint64_t)n);
  double after = energy(g, &m);
  gg_dsmc_ops.destroy(g);
  return fabs(after / before - 1);
}

static void energy_is_kept(void **state)
{
  (void)state;
  const int64_t sizes[] = {2, 9, 1000, 20000};
  for (int i = 0; i < 4; i++) {
    double smooth = drift(0.3, -1, INFINITY, sizes[i]), rough = drift(0, 1, INFINITY, sizes[i]);
    printf("# N %d: energy drifts by %.1e (smooth), %.1e (perfectly rough)\n", (int)sizes[i], smooth, rough);
    assert_true(smooth < 1e-13);
    assert_true(rough < 1e-13);
  }
  assert_true(drift(0.3, 1, 0.1, 1000) > 1e-3); /* sliding does lose energy: the test can see it */
}

/* A start has exactly the temperatures asked for, whatever the seed: perfectly rough grains keep their sum for ever. */
static void starts_are_exact(void **state)
{
  (void)state;
  const int64_t sizes[] = {9, 1000};
  for (int i = 0; i < 2; i++)
    for (uint64_t seed = 1; seed <= 3; seed++) {
      gg_scene s = lab_scene(GG_EQUILIBRIUM, 0.1, 1, 1, sizes[i]);
      gg_model m = lab_model(&s);
      m.ratio0 = 0.3;
      gg_engine *g = lab_engine(&m, seed);
      assert_true(fabs(energy(g, &m) / (3 * (double)sizes[i] * m.temperature0 * 1.3) - 1) < 1e-12);
      gg_dsmc_ops.destroy(g);
    }
}

static void momentum_stays_at_rounding(void **state)
{
  (void)state;
  gg_scene s = lab_scene(GG_HCS, 0.1, 0.5, -1, 1000);
  gg_model m = lab_model(&s);
  gg_engine *g = lab_engine(&m, 5);
  gg_error err = {0};
  for (int i = 0; i < 500; i++) {
    lab_advance(g, INFINITY, 1000);
    lab_view v = lab_snapshot(g);
    double T = lab_temperature(&v);
    for (int a = 0; a < 3; a++) assert_true(fabs(v.momentum[a]) / v.n < 1e-15 * sqrt(T));
    if (T < 0x1p-40) assert_int_equal(gg_dsmc_ops.rescale(g, 20, &err), GG_OK);
  }
  gg_dsmc_ops.destroy(g);
}

/* The loss in the collision sums is the energy that the gas has lost: on the plain path, in blocks, and in segments. */
static void sums_account_for_the_loss(void **state)
{
  (void)state;
  const int64_t sizes[] = {500, 5000, 70000};
  for (int k = 0; k < 6; k++) {
    const bool rough = k % 2;
    gg_scene s = lab_scene(GG_HCS, 0.2, 0.7, rough ? 0.3 : -1, sizes[k / 2]);
    if (rough) s.collision.mu[0] = 0.4;
    gg_model m = lab_model(&s);
    gg_engine *g = lab_engine(&m, 7);
    double before = energy(g, &m);
    lab_advance(g, INFINITY, 10 * (uint64_t)m.n);
    gg_collision_sums t;
    gg_dsmc_ops.take_sums(g, &t);
    assert_true(fabs(before - energy(g, &m) - 2 * t.loss[GG_11]) < 1e-12 * before);
    gg_dsmc_ops.destroy(g);
  }
}

/* Largest deviation of e of single collisions from the law of restitution at their normal speed. */
typedef struct by_law {
  const gg_model *model;
  double worst, slowest, fastest;
} by_law;

static void hold_to_law(void *context, const gg_collision_record *r)
{
  by_law *x = context;
  const gg_model *m = x->model;
  const int i = r->species[0], j = r->species[1];
  const double gn = gg_dot(r->k, r->c12), reduced = 1 / (1 / m->mass[i] + 1 / m->mass[j]);
  const double e = gg_dot(r->k, r->J) / (reduced * gn) - 1;
  x->worst = fmax(x->worst, fabs(e - gg_common_law_at(&m->law, gn, i, j, NULL)));
  x->slowest = fmin(x->slowest, gn), x->fastest = fmax(x->fastest, gn);
}

/* On the plain path, where e comes from the table of a built-in law, each collision has the e of the law at its speed,
 * in gases that have cooled by a factor of hundreds, too. */
static void every_pair_has_its_law(void **state)
{
  (void)state;
  for (int species = 1; species <= 2; species++) {
    gg_scene s = lab_scene(GG_HCS, 0.1, 0.8, -1, 300);
    s.collision.law = GG_LAW_VISCOELASTIC;
    s.n_species = species;
    s.species[0] = (gg_species){0.5, 1, 1, 0.4, 1, 0};
    s.species[1] = (gg_species){0.5, 0.7, 2, 0.3, 1, 0};
    gg_model m = lab_model(&s);
    gg_engine *g = lab_engine(&m, 17);
    gg_error err = {0};
    by_law x = {.model = &m, .slowest = INFINITY};
    assert_int_equal(gg_dsmc_ops.set_callback(g, hold_to_law, &x, &err), GG_OK);
    lab_advance(g, INFINITY, 20000);
    printf("# %d species: e off by %.1e at most, at speeds from %.1e to %.1f\n", species, x.worst, x.slowest,
           x.fastest);
    assert_true(x.slowest < 1e-3 * x.fastest);
    assert_true(x.worst < 1e-6);
    gg_dsmc_ops.destroy(g);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test(energy_is_kept), cmocka_unit_test(momentum_stays_at_rounding),
                                     cmocka_unit_test(starts_are_exact), cmocka_unit_test(sums_account_for_the_loss),
                                     cmocka_unit_test(every_pair_has_its_law)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
