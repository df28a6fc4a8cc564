/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A majorant that is too low is noticed, counted and corrected for. Forced down before every step, it changes neither
 * the collision rate nor the loss; in a sheared mixture of rough grains it changes neither the collision rate of any
 * pair of species nor the stress, nor how energy is shared between species and with the spins. */
#include "dsmc/dsmc.h"
#include "lab.h"

static void force(gg_engine *g, double majorant)
{
  gg_dsmc *d = (gg_dsmc *)g;
  for (int p = 0; p < GG_PAIRS; p++) d->now.majorant[p] = (gg_dsmc_majorant){.before = majorant};
}

static void run(double forced, lab_mean *rate, lab_mean *loss, uint64_t *overflows)
{
  gg_scene s = lab_scene(GG_EQUILIBRIUM, 0.2, 1, -1, 2000);
  gg_model m = lab_model(&s);
  gg_engine *g = lab_engine(&m, 17);
  gg_collision_sums t;
  for (int b = 0; b < 20; b++) {
    double time = 0;
    for (int i = 0; i < 150; i++) {
      if (forced > 0) force(g, forced);
      time += lab_advance(g, INFINITY, 250);
    }
    gg_dsmc_ops.take_sums(g, &t);
    double trace = t.stress[0][0][0] + t.stress[0][1][1] + t.stress[0][2][2];
    lab_add(rate, 2 * (double)t.collisions[0] / (time * (double)m.n));
    lab_add(loss, trace / (time * m.volume)); /* sigma k.J ~ g_n: mean square of g_n where rates are weighted by g_n */
  }
  gg_engine_state st;
  gg_dsmc_ops.state(g, &st);
  *overflows = st.overflows;
  assert_true(st.overflows < st.events);
  gg_dsmc_ops.destroy(g);
}

static void forced_overflows_change_nothing(void **state)
{
  (void)state;
  gg_scene s = lab_scene(GG_EQUILIBRIUM, 0.2, 1, -1, 2000);
  gg_model m = lab_model(&s);
  double rate = gg_common_model_collision_rate(&m, 0.5), pressure = 4 * m.phi * m.chi[0] * m.density * 0.5 * 3;
  const double forced[] = {0, 3, 1, 0.3};
  for (int i = 0; i < 4; i++) {
    lab_mean r = {0}, p = {0};
    uint64_t overflows;
    run(forced[i], &r, &p, &overflows);
    printf("# majorant %g thermal speeds: %llu overflows\n", forced[i], (unsigned long long)overflows);
    lab_expect("rate", &r, rate * (1 - 1 / (2.0 * 2000)), 0, 0.01);
    lab_expect("collisional stress", &p, pressure, 0, 0.01);
    if (i) assert_true(overflows > 1000);
  }
}

/* Averages of a sheared mixture over blocks of time. */
typedef struct mixed {
  lab_mean rate[GG_PAIRS], loss, shear, pressure, transfer, T, ratio, spins;
} mixed;

static double trace(double a[3][3])
{
  return a[0][0] + a[1][1] + a[2][2];
}

/* One block; the majorant is forced down (if `forced`) after every eighth of a collision per grain. The ensemble must
 * be so large that each interval has candidates of every pair of species that notice it: were there only a few tens of
 * collisions in an interval, about 1 % would be lost unnoticed. */
static void block(gg_engine *g, const gg_model *m, double forced, mixed *out)
{
  enum { INTERVALS = 300 };
  lab_view v = {0};
  gg_collision_sums t;
  double time = 0, collisional[3][3] = {{0}}, energy[2];
  gg_dsmc_ops.take_sums(g, &t);
  for (int i = 0; i < INTERVALS; i++) {
    if (forced > 0) force(g, forced);
    time += lab_advance(g, INFINITY, (uint64_t)m->n / 16);
    if (i % 5 == 0) gg_dsmc_ops.snapshot(g, false, lab_add_chunk, &v);
  }
  gg_dsmc_ops.take_sums(g, &t);
  double samples = v.n / (double)m->n, kinetic = 0, loss = 0;
  for (int q = 0; q < GG_PAIRS; q++) {
    lab_add(&out->rate[q], (double)t.collisions[q] / (time * (double)m->n));
    loss += t.loss[q] / (m->volume * time);
    for (int a = 0; a < 3; a++)
      for (int b = 0; b < 3; b++) collisional[a][b] += t.stress[q][a][b] / (m->volume * time);
  }
  for (int k = 0; k < 2; k++) {
    energy[k] = m->mass[k] * v.cc_of[k] / v.n_of[k] / 3;
    kinetic += m->mass[k] * v.xy_of[k] / (samples * m->volume);
  }
  double T = (energy[0] * v.n_of[0] + energy[1] * v.n_of[1]) / v.n;
  lab_add(&out->T, T);
  lab_add(&out->ratio, energy[0] / energy[1]);
  lab_add(&out->spins, v.ss / v.n);
  lab_add(&out->loss, loss);
  lab_add(&out->shear, -kinetic - collisional[0][1]);
  lab_add(&out->transfer, -collisional[0][1]);
  lab_add(&out->pressure, m->density * T + trace(collisional) / 3);
}

static void shear(gg_dsmc_path path, double forced, uint64_t seed, mixed *out)
{
  gg_scene s = lab_scene(GG_USF, 0.2, 0.8, 0.2, 16000);
  s.n_species = 2;
  s.species[0] = (gg_species){0.4, 1, 1, 0.4, 1, 0};
  s.species[1] = (gg_species){0.6, 0.6, 0.2, 0.4, 1, 0};
  gg_model m = lab_model(&s);
  gg_engine *g = lab_engine(&m, seed);
  gg_dsmc *d = (gg_dsmc *)g;
  for (int q = 0; q < GG_PAIRS && path == GG_DSMC_PLAIN; q++) d->path[q] = path;
  assert_true((d->path[0] == GG_DSMC_PLAIN) == (path == GG_DSMC_PLAIN));
  lab_advance(g, INFINITY, 40 * (uint64_t)m.n / 2);
  uint64_t before = d->now.overflows;
  for (int b = 0; b < 20; b++) block(g, &m, forced, out);
  printf("# %s, majorant %g thermal speeds: %llu overflows\n", path == GG_DSMC_PLAIN ? "one by one" : "blocks", forced,
         (unsigned long long)(d->now.overflows - before));
  if (forced > 0) assert_true(d->now.overflows - before > 1000);
  gg_dsmc_ops.destroy(g);
}

static void forced_overflows_change_no_mixture(void **state)
{
  (void)state;
  const double forced[] = {2, 0.3};
  mixed plain = {0};
  shear(GG_DSMC_PLAIN, 0, 1, &plain);
  for (int i = 0; i < 4; i++) {
    mixed f = {0};
    if (!getenv("NIGHTLY") && i % 3 == 0) continue; /* daily each path with another of the two */
    shear(i < 2 ? GG_DSMC_PLAIN : GG_DSMC_BLOCKS, forced[i % 2], 2 + (uint64_t)i, &f);
    const struct {
      const char *name;
      lab_mean *forced, *plain;
      double sight;
    } pairs[] = {{"rate 11", &f.rate[0], &plain.rate[0], 0.01},
                 {"rate 12", &f.rate[1], &plain.rate[1], 0.01},
                 {"rate 22", &f.rate[2], &plain.rate[2], 0.01},
                 {"shear stress", &f.shear, &plain.shear, 0.01},
                 {"collisional shear stress", &f.transfer, &plain.transfer, 0.015},
                 {"pressure", &f.pressure, &plain.pressure, 0.01},
                 {"loss", &f.loss, &plain.loss, 0.01},
                 {"T", &f.T, &plain.T, 0.01},
                 {"T_1/T_2", &f.ratio, &plain.ratio, 0.015},
                 {"spins", &f.spins, &plain.spins, 0.01}};
    for (size_t k = 0; k < sizeof pairs / sizeof *pairs; k++)
      lab_expect(pairs[k].name, pairs[k].forced, lab_value(pairs[k].plain), lab_error(pairs[k].plain), pairs[k].sight);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test(forced_overflows_change_nothing),
                                     cmocka_unit_test(forced_overflows_change_no_mixture)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
