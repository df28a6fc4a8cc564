/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Mixtures of three species and of ten (a log-normal of diameters cut into tenths, masses as volumes): both engines
 * collide every pair of species, and all together, at Enskog's rate in equilibrium, and have one temperature for all;
 * sheared, where every species has its own, md and the Monte Carlo engine agree within four combined errors, in the
 * part of the stress that collisions carry, too; and the same comparison sees a mass of one species that is off by a
 * factor of two (a canary: it must not pass). */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>
#include <math.h>
#include <string.h>

#include "graingas.h"
#include "run/run.h"
#include "run/z_scores.h"
#include "scene/model_of_scene.h"
#include "theory/answer.h"

/* Medians of the tenths of exp(0.25 x), x normal. */
static const double diameters[] = {0.663, 0.772, 0.845, 0.908, 0.969, 1.032, 1.101, 1.184, 1.296, 1.509};
enum { TEN = sizeof diameters / sizeof *diameters };

static gg_scene scene_of(gg_flow flow, int species, double phi, int64_t particles)
{
  static const gg_species three[] = {{0.5, 1, 1, 0.4, 1, 0}, {0.3, 1.4, 2, 0.4, 1, 0}, {0.2, 0.7, 0.5, 0.4, 1, 0}};
  gg_scene s = gg_scene_defaults();
  s.flow = flow, s.phi = phi, s.particles = particles, s.n_species = species;
  for (int i = 0; i < species; i++) {
    const double d = diameters[i % TEN];
    s.species[i] = species == 3 ? three[i] : (gg_species){1.0 / TEN, d, d * d * d, 0.4, 1, 0};
  }
  for (int p = 0; p < GG_PAIRS; p++) s.collision.e[p] = flow == GG_EQUILIBRIUM ? 1 : 0.9 - 0.02 * (p % 3);
  return s;
}

/* Rates by pair of species over intervals, and of all pairs: their sums, and those of their squares. */
enum { ALL = GG_PAIRS };
typedef struct rates {
  double n, sum[GG_PAIRS + 1], squares[GG_PAIRS + 1];
} rates;

static void add_rates(rates *r, const gg_collision_sums *t, double time)
{
  double all = 0;
  r->n++;
  for (int q = 0; q < GG_PAIRS; q++) {
    double rate = (double)t->collisions[q] / time;
    r->sum[q] += rate, r->squares[q] += rate * rate, all += rate;
  }
  r->sum[ALL] += all, r->squares[ALL] += all * all;
}

/* The mean less what is expected, in errors of its own. */
static double rate_z(const rates *r, int q, double expected, double sight)
{
  double mean = r->sum[q] / r->n, error = sqrt((r->squares[q] / r->n - mean * mean) / (r->n - 1));
  assert_true(error < sight * expected);
  return (mean - expected) / error;
}

/* Against N_i nu_ij, half of that among like grains. Returns the largest difference in errors of its own: not those of
 * counting, for the Monte Carlo kernels collide pairs of blocks, whose collisions come together. All collisions
 * together are known well enough to see 1 %. */
static double worst_rate(const gg_model *m, const rates *r, const char *engine)
{
  double T[GG_MAX_SPECIES], worst = 0, chi2 = 0, all = 0;
  for (int i = 0; i < m->n_species; i++) T[i] = m->temperature0;
  for (int i = 0; i < m->n_species; i++)
    for (int j = i; j < m->n_species; j++) {
      const int q = gg_pair(i, j);
      double expected = gg_theory_pair_collision_rate(m, i, j, T) * (double)m->n_of[i];
      if (i == j) expected *= 0.5 * (1 - 1 / (double)m->n_of[i]);
      double z = rate_z(r, q, expected, 0.04);
      worst = fmax(worst, fabs(z)), chi2 += z * z, all += expected;
    }
  const double together = rate_z(r, ALL, all, 0.0025);
  print_message("# %s, %d species: rates by pair, worst z %.2f, chi^2 %.1f of %d, all together %.2f\n", engine,
                m->n_species, worst, chi2, gg_pairs_of(m->n_species), together);
  return fmax(worst, fabs(together));
}

typedef struct partial {
  const gg_model *model;
  double energy[GG_MAX_SPECIES];
} partial;

static void add_energy(void *context, const gg_chunk *c)
{
  partial *p = context;
  for (size_t k = 0; k < c->n; k++) {
    const int i = c->species[k];
    const double *const *v = c->c;
    p->energy[i] += p->model->mass[i] * (v[0][k] * v[0][k] + v[1][k] * v[1][k] + v[2][k] * v[2][k]);
  }
}

/* Rates in a gas of one temperature; partial temperatures as means over snapshots a collision a grain apart. */
static void equilibrium_of(const gg_engine_ops *ops, gg_engine_kind kind, int species)
{
  enum { SNAPSHOTS = 150 };
  gg_scene s = scene_of(GG_EQUILIBRIUM, species, 0.02, 2000);
  s.dsmc.particles = 10000;
  gg_model m;
  gg_engine *e;
  gg_error err = {0};
  if (gg_scene_model_make(&s, kind, &m, &err) != GG_OK) fail_msg("%s", err.message);
  if (ops->create(&m, 5, 0, &e, &err) != GG_OK) fail_msg("%s", err.message);
  const uint64_t each = (uint64_t)m.n; /* two collisions a grain */
  double elapsed, T[GG_MAX_SPECIES] = {0}, TT[GG_MAX_SPECIES] = {0};
  static rates r;
  r = (rates){0};
  assert_int_equal(ops->advance(e, INFINITY, 5 * each, &elapsed, &err), GG_OK);
  gg_collision_sums t;
  ops->take_sums(e, &t);
  for (int k = 0; k < SNAPSHOTS; k++) {
    partial p = {.model = &m};
    assert_int_equal(ops->advance(e, INFINITY, each, &elapsed, &err), GG_OK);
    ops->take_sums(e, &t);
    add_rates(&r, &t, elapsed);
    ops->snapshot(e, false, add_energy, &p);
    for (int i = 0; i < species; i++) {
      double Ti = p.energy[i] / (3 * (double)m.n_of[i]) / m.temperature0 - 1;
      T[i] += Ti / SNAPSHOTS, TT[i] += Ti * Ti / SNAPSHOTS;
    }
  }
  assert_true(worst_rate(&m, &r, ops->name) < 4.5);
  for (int i = 0; i < species; i++) { /* snapshots are three relaxation times apart, or nearly so */
    double error = sqrt(TT[i] * 3 / SNAPSHOTS), z = T[i] / error;
    if (!(fabs(z) < 4 && error < 0.01)) fail_msg("%s: T_%d/T - 1 = %g +- %g", ops->name, i + 1, T[i], error);
  }
  ops->destroy(e);
}

static void species_share_the_temperature_in_equilibrium(void **state)
{
  (void)state;
  for (int species = 3; species <= TEN; species += TEN - 3) {
    equilibrium_of(&gg_md_ops, GG_MD, species);
    equilibrium_of(&gg_dsmc_ops, GG_DSMC, species);
  }
}

static gg_result *run(gg_scene s, gg_engine_kind engine)
{
  gg_result *r = NULL;
  gg_error err = {0};
  s.engine = engine;
  if (gg_run_scene(&s, NULL, 1, NULL, &r, &err) != GG_OK) fail_msg("%s", err.message);
  assert_int_equal(r->steadiness, GG_STEADY);
  return r;
}

static double worst_z(const gg_result *a, const gg_result *b)
{
  const gg_quantity shared[] = {GG_Q_TEMPERATURE,      GG_Q_PRESSURE,        GG_Q_P_XY, GG_Q_N1, GG_Q_COLLISION_RATE,
                                GG_Q_P_XY_COLLISIONAL, GG_Q_P_YY_COLLISIONAL};
  const int n = (int)(sizeof shared / sizeof *shared);
  double worst = 0;
  for (int k = 0; k < n + a->model.n_species; k++) {
    gg_quantity q = k < n ? shared[k] : (gg_quantity)(GG_Q_PARTIAL_TEMPERATURE + (k - n));
    double z = gg_run_z_score(&a->value[q], &b->value[q]);
    print_message("# %s: md %.5g +- %.2g, dsmc %.5g +- %.2g, z = %.2f\n", gg_common_quantity_name(q), a->value[q].mean,
                  a->value[q].error, b->value[q].mean, b->value[q].error, z);
    assert_true(a->value[q].error > 0 && b->value[q].error > 0);
    worst = fmax(worst, fabs(z));
  }
  return worst;
}

static gg_scene sheared_scene(int species)
{
  gg_scene s = scene_of(GG_USF, species, 0.01, 1500);
  s.run.collisions = species == 3 ? 1600 : 1000;
  return s;
}

/* The canary: a mass of one species that is off by a factor of two is detected. */
static void check_canary(const gg_result *md)
{
  gg_scene wrong = sheared_scene(3);
  wrong.species[2].mass *= 2;
  gg_result *dsmc = run(wrong, GG_DSMC);
  assert_true(worst_z(md, dsmc) > 6);
  gg_result_free(dsmc);
}

static void engines_agree_on_sheared_mixtures(void **state)
{
  (void)state;
  for (int species = 3; species <= TEN; species += TEN - 3) {
    gg_result *md = run(sheared_scene(species), GG_MD), *dsmc = run(sheared_scene(species), GG_DSMC);
    assert_true(worst_z(md, dsmc) < 4);
    if (species == 3) check_canary(md);
    /* Energy is not shared alike: what is compared is no constant. */
    double first = dsmc->value[GG_Q_PARTIAL_TEMPERATURE].mean;
    double last = dsmc->value[GG_Q_PARTIAL_TEMPERATURE + species - 1].mean;
    assert_true(fabs(first / last - 1) > 0.05);
    gg_result_free(md), gg_result_free(dsmc);
  }
}

/* Every curve of every pair and species has room. */
static void curves_of_sixteen(void **state)
{
  (void)state;
  gg_scene s = gg_scene_defaults();
  s.flow = GG_USF, s.phi = 0.1, s.particles = 320, s.n_species = GG_MAX_SPECIES;
  for (int i = 0; i < GG_MAX_SPECIES; i++) s.species[i].fraction = 1.0 / GG_MAX_SPECIES;
  for (int p = 0; p < GG_PAIRS; p++) s.collision.beta[p] = 0;
  s.measure = GG_MEASURE_RHEOLOGY | GG_MEASURE_VELOCITY_DISTRIBUTIONS | GG_MEASURE_PAIR_CORRELATION |
              GG_MEASURE_DIFFUSION | GG_MEASURE_COLLISIONS | GG_MEASURE_LOCAL_DISTRIBUTIONS | GG_MEASURE_ORIENTATION;
  s.run.collisions = 20, s.run.warmup = 5;
  gg_result *r = NULL;
  gg_error err = {0};
  if (gg_run_scene(&s, NULL, 1, NULL, &r, &err) != GG_OK) fail_msg("%s", err.message);
  int pairs = 0;
  for (int i = 0; i < r->curves.n; i++) pairs += strncmp(r->curves.curve[i].name, "pair_correlation_", 17) == 0;
  assert_int_equal(pairs, GG_PAIRS);
  gg_result_free(r);
}

int main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test(species_share_the_temperature_in_equilibrium),
                                     cmocka_unit_test(engines_agree_on_sheared_mixtures),
                                     cmocka_unit_test(curves_of_sixteen)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
