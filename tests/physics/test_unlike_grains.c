/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Rough grains of two species that differ in diameter, mass, moment of inertia and drag, in both engines, against
 * closed forms: without collisions every temperature and mean spin relaxes by the drag of its own species; in a bath,
 * and without one, perfectly rough elastic grains share their energy equally among all degrees of freedom. A parameter
 * of one species taken for the other, or a pair's for another pair's, fails. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "run/run.h"
#include "scene/model_of_scene.h"
#include "scene/scene_reader.h"

#define GRAINS                                                                                                         \
  "particles: 1200, dsmc: {particles: 1200}, species: [{fraction: 0.6, diameter: 1, mass: 1, inertia: 0.4, drag: 1}, " \
  "{fraction: 0.4, diameter: 2, mass: 3, inertia: 0.3, drag: 3}], "
static const double drag_of[] = {1, 3};

enum { T, THETA, SPIN, KINDS, SPECIES = 2 };

/* Values of each species: m <C^2>/3, K m <(s - <s>)^2>/3 and the mean angular velocity along z. */
typedef struct sums {
  double n[SPECIES], c2[SPECIES], s[SPECIES][3], s2[SPECIES];
} sums;

static void add_chunk(void *context, const gg_chunk *k)
{
  sums *x = context;
  for (size_t i = 0; i < k->n; i++) {
    const int of = k->species[i];
    x->n[of]++;
    for (int a = 0; a < 3; a++) {
      x->c2[of] += k->c[a][i] * k->c[a][i];
      x->s[of][a] += k->s[a][i];
      x->s2[of] += k->s[a][i] * k->s[a][i];
    }
  }
}

static void read_state(gg_engine *g, const gg_model *m, double value[KINDS][SPECIES])
{
  sums x = {0};
  g->ops->snapshot(g, false, add_chunk, &x);
  for (int i = 0; i < SPECIES; i++) {
    double own = x.s2[i] / x.n[i];
    for (int a = 0; a < 3; a++) own -= x.s[i][a] / x.n[i] * x.s[i][a] / x.n[i];
    value[T][i] = m->mass[i] * x.c2[i] / x.n[i] / 3;
    value[THETA][i] = m->mass[i] * m->inertia[i] * own / 3;
    value[SPIN][i] = 2 / m->diameter[i] * x.s[i][2] / x.n[i];
  }
}

typedef struct mean {
  int n;
  double sum, squares;
} mean;

static void add(mean *m, double x)
{
  m->n++, m->sum += x, m->squares += x * x;
}

/* Within four errors, and the error small enough that a deviation of `sight` would be seen. */
static void expect(const char *what, int engine, int species, const mean *m, double expected, double sight)
{
  const double value = m->sum / m->n, error = sqrt(fmax(m->squares / m->n - value * value, 0) / (m->n - 1));
  print_message("# %s %s, species %d: %.4f +- %.4f, expected %.4f\n", engine == GG_MD ? "md  " : "dsmc", what,
                species + 1, value, error, expected);
  if (fabs(value - expected) > 4 * error || 4 * error > sight) fail_msg("%s: see above", what);
}

static gg_scene scene_of(const char *yaml, int engine)
{
  gg_scene s = gg_scene_defaults();
  gg_error err = {0};
  if (gg_scene_read(&s, yaml, strlen(yaml), "test", &err) != GG_OK || gg_scene_finish(&s, &err) != GG_OK)
    fail_msg("%s", err.message);
  s.engine = (gg_engine_kind)engine;
  return s;
}

static gg_engine *engine_of(const gg_scene *s, uint64_t seed, gg_model *m)
{
  gg_engine *g = NULL;
  gg_error err = {0};
  if (gg_scene_model_make(s, s->engine, m, &err) != GG_OK ||
      gg_common_engine_of(s->engine)->create(m, seed, 0, &g, &err) != GG_OK)
    fail_msg("%s", err.message);
  return g;
}

static double advance(gg_engine *g, double dt)
{
  double elapsed;
  gg_error err = {0};
  if (g->ops->advance(g, dt, UINT64_MAX, &elapsed, &err) != GG_OK) fail_msg("%s", err.message);
  return elapsed;
}

/* phi 1e-5: hardly a grain collides. T_i = T_b + (T_0 - T_b) exp(-2 gamma_i t), theta_i likewise with the drag of
 * spins; mean spins go to that of the vorticity, -1/2. */
static void without_collisions_each_species_has_its_drag(void **state)
{
  (void)state;
  const double time = 0.4, drag = 0.5, rotation = 2;
  for (int engine = GG_MD; engine <= GG_DSMC; engine++)
    for (int sheared = 0; sheared < 2; sheared++) {
      mean of[KINDS][SPECIES] = {{{0}}};
      const gg_scene s =
          scene_of(sheared ? "{flow: usf, phi: 1.0e-5, collision: {e: 0.9, beta: 0}, thermostat: bath, " GRAINS
                             "bath: {drag: 0.5, temperature: 1, rotation: 2}, start: {temperature: 3, "
                             "rotational_temperature: 0.5, spin: 4}}"
                           : "{flow: hss, phi: 1.0e-5, collision: {e: 0.9, beta: 0}, thermostat: bath, " GRAINS
                             "bath: {drag: 0.5, temperature: 1, rotation: 2}, start: {temperature: 3, "
                             "rotational_temperature: 0.5, spin: 4}}",
                   engine);
      double t = 0;
      for (uint64_t seed = 1; seed <= 6; seed++) {
        static gg_model m;
        double value[KINDS][SPECIES];
        gg_engine *g = engine_of(&s, seed, &m);
        t = advance(g, time);
        read_state(g, &m, value);
        for (int k = 0; k < KINDS; k++)
          for (int i = 0; i < SPECIES; i++) add(&of[k][i], value[k][i]);
        g->ops->destroy(g);
      }
      for (int i = 0; i < SPECIES; i++) {
        const double decay = exp(-2 * drag * drag_of[i] * t), turning = exp(-rotation * drag * drag_of[i] * t),
                     rest = sheared ? -0.5 : 0;
        if (!sheared) expect("T", engine, i, &of[T][i], 1 + 2 * decay, 0.15);
        expect("theta", engine, i, &of[THETA][i], 1 - 0.5 * turning * turning, 0.07);
        expect("spin", engine, i, &of[SPIN][i], rest + (4 - rest) * turning, 0.25);
      }
    }
}

/* Perfectly rough elastic grains: T_i = theta_i for both species, in a bath that of the bath; alone half of T_0 +
 * theta_0, and no energy is lost. */
static void energy_is_shared_equally(void **state)
{
  (void)state;
  for (int engine = GG_MD; engine <= GG_DSMC; engine++)
    for (int alone = 0; alone < 2; alone++) {
      const gg_scene s = scene_of(alone ? "{flow: equilibrium, phi: 0.1, collision: {beta: 1}, " GRAINS
                                          "start: {temperature: 2, rotational_temperature: 0.4}}"
                                        : "{flow: hss, phi: 0.1, collision: {e: 1, beta: 1}, thermostat: bath, " GRAINS
                                          "bath: {drag: 0.5, temperature: 1.5, rotation: 2}}",
                                  engine);
      static gg_model m;
      gg_engine *g = engine_of(&s, 5, &m);
      mean of[KINDS][SPECIES] = {{{0}}};
      advance(g, 20 / gg_common_model_collision_rate(&m, 0.5));
      for (int block = 0; block < 16; block++) {
        double sum[KINDS][SPECIES] = {{0}}, value[KINDS][SPECIES];
        for (int k = 0; k < 6; k++) {
          advance(g, 1 / gg_common_model_collision_rate(&m, 0.5));
          read_state(g, &m, value);
          for (int q = 0; q < KINDS; q++)
            for (int i = 0; i < SPECIES; i++) sum[q][i] += value[q][i] / 6;
        }
        for (int q = 0; q < KINDS; q++)
          for (int i = 0; i < SPECIES; i++) add(&of[q][i], sum[q][i]);
      }
      const double expected = alone ? 0.5 * (0.5 + 0.1) : 1.5;
      for (int i = 0; i < SPECIES; i++) {
        expect("T", engine, i, &of[T][i], expected * (1 - 1. / (double)m.n), 0.05 * expected);
        expect("theta", engine, i, &of[THETA][i], expected * (1 - 1. / (double)m.n_of[i]), 0.05 * expected);
      }
      g->ops->destroy(g);
    }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(without_collisions_each_species_has_its_drag),
      cmocka_unit_test(energy_is_shared_equally),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
