/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Waves of a box's length on planted grains: random grains give 1 over the factor of an ideal gas, planted waves
 * their known power, for all species, and shorter waves next to nothing. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>
#include <math.h>
#include <string.h>

#include "common/rng.h"
#include "measure/long_waves.h"
#include "scene/model_of_scene.h"

enum { N = 4096, CHUNK = 512 };
static double r[3][N], c[3][N];
static uint8_t kind[N];

static gg_model model_of(int species)
{
  gg_scene s = gg_scene_defaults();
  gg_model m;
  s.flow = GG_HCS, s.phi = 0.2, s.particles = N, s.n_species = species;
  if (species == 2) s.species[0] = (gg_species){0.5, 1, 1, 0.4, 1, 0}, s.species[1] = (gg_species){0.5, 1.5, 3, 0.4, 1, 0};
  assert_int_equal(gg_scene_model_make(&s, GG_MD, &m, NULL), GG_OK);
  m.box[1] *= 2, m.box[2] /= 2; /* edges of different lengths */
  return m;
}

static void plant_random(const gg_model *m, gg_rng *rng)
{
  for (int i = 0; i < N; i++) {
    kind[i] = m->n_species == 2 && i % 2;
    for (int a = 0; a < 3; a++)
      r[a][i] = m->box[a] * gg_rng_uniform(rng), c[a][i] = (a + 1) * gg_common_rng_normal(rng);
  }
}

static void measure(const gg_model *m, double *density, double *momentum)
{
  gg_long_waves w = {0};
  for (size_t at = 0; at < N; at += CHUNK) {
    gg_chunk chunk = {.n = CHUNK, .species = m->n_species == 2 ? kind + at : NULL};
    for (int a = 0; a < 3; a++) chunk.r[a] = r[a] + at, chunk.c[a] = c[a] + at;
    gg_measure_long_waves_add(&w, m, &chunk);
  }
  gg_measure_long_waves_finish(&w, m, density, momentum);
}

/* S(0) of Carnahan & Starling from the slope of n Z = n (1 + phi + phi^2 - phi^3)/(1 - phi)^3. */
static double structure_of(double phi)
{
  const double h = 1e-5;
  double p[2];
  for (int k = 0; k < 2; k++) {
    const double x = phi + (k ? h : -h);
    p[k] = x * (1 + x + x * x - x * x * x) / pow(1 - x, 3);
  }
  return 2 * h / (p[1] - p[0]);
}

static void grains_at_random(void **state)
{
  (void)state;
  enum { TIMES = 200 };
  for (int species = 1; species <= 2; species++) {
    const gg_model m = model_of(species);
    gg_rng rng = gg_common_rng_seed(7, (uint64_t)species);
    double density = 0, momentum = 0;
    for (int t = 0; t < TIMES; t++) {
      double d, p;
      plant_random(&m, &rng);
      measure(&m, &d, &p);
      density += d * structure_of(m.phi) / TIMES, momentum += p / TIMES;
    }
    /* 6 and 12 exponential numbers each time: errors 0.029 and 0.020 */
    assert_true(fabs(density - 1) < 4 * 0.029);
    assert_true(fabs(momentum - 1) < 4 * 0.020);
  }
}

/* Grains on a fine lattice along `axis`, displaced by a wave a sin(kx): of matter |sum|^2 = (N k a/2)^2 to first order;
 * velocities across it of sin(kx): (N/2)^2 over N/2. */
static void waves_along(void **state)
{
  (void)state;
  const gg_model m = model_of(1);
  for (int axis = 0; axis < 3; axis++)
    for (int wave = 1; wave <= 2; wave++) {
      const double k = 2 * M_PI * wave / m.box[axis], amplitude = 0.01 / k, across = (axis + 1) % 3;
      double density, momentum;
      memset(c, 0, sizeof c);
      for (int i = 0; i < N; i++) {
        const double x = m.box[axis] * (i + 0.5) / N;
        for (int a = 0; a < 3; a++) r[a][i] = m.box[a] * ((i * (a + 3) * 37) % N + 0.5) / N;
        r[axis][i] = x + amplitude * sin(k * x);
        r[axis][i] -= r[axis][i] >= m.box[axis] ? m.box[axis] : 0;
        r[axis][i] += r[axis][i] < 0 ? m.box[axis] : 0;
        for (int a = 0; a < 3; a++) c[a][i] = 1e-6 * ((i * 61) % N - N / 2);
        c[(int)across][i] = sin(k * x);
      }
      measure(&m, &density, &momentum);
      const double expected = N * 0.01 * 0.01 / 4 / structure_of(m.phi) / 6;
      assert_true(fabs(density / expected - 1) < 0.01);
      assert_true(fabs(momentum / (N / 2.0 / 12) - 1) < 0.02);
    }
}

/* A lattice of planes, many to a box, has no long waves: the slabs leave less than a thousandth of N. */
static void short_waves_do_not_count(void **state)
{
  (void)state;
  const gg_model m = model_of(1);
  for (int planes = 5; planes <= 40; planes++) {
    double density, momentum;
    for (int i = 0; i < N; i++)
      for (int a = 0; a < 3; a++) r[a][i] = m.box[a] * (i % planes + 0.3) / planes, c[a][i] = 1;
    measure(&m, &density, &momentum);
    assert_true(density * structure_of(m.phi) < 1.5e-3 * N);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test(grains_at_random), cmocka_unit_test(waves_along),
                                     cmocka_unit_test(short_waves_do_not_count)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
