/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The local frame of walled flows: a planted profile u(y) of any shape is subtracted, and the remaining variance is
 * that of the planted noise, for few or many grains a slab (the 1/n_c correction). The same for mean spins of slabs,
 * and for the temperature ratio of both. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>

#include <cmocka.h>
#include <math.h>

#include "common/rng.h"
#include "measure/local_frame.h"
#include "scene/model_of_scene.h"

enum { N = 1000 };
static double r[3][N], c[3][N], w[3][N];
static uint8_t species[N];
static bool rough;
static gg_slabs slabs_now;

static void show(gg_engine *engine, bool positions, gg_visit *visit, void *context)
{
  (void)engine;
  gg_chunk chunk = {.n = N, .c = {c[0], c[1], c[2]}};
  if (rough) {
    chunk.species = species;
    for (int a = 0; a < 3; a++) chunk.s[a] = w[a];
  }
  if (positions)
    for (int a = 0; a < 3; a++) chunk.r[a] = r[a];
  visit(context, &chunk);
}

static const gg_engine_ops planted_ops = {.name = "planted", .snapshot = show};
static gg_engine planted = {&planted_ops};

typedef struct sums {
  double square[3], mean[3];
} sums;

static void add(void *context, const gg_chunk *chunk)
{
  sums *s = context;
  for (size_t i = 0; i < chunk->n; i++)
    for (int a = 0; a < 3; a++) s->square[a] += chunk->c[a][i] * chunk->c[a][i], s->mean[a] += chunk->c[a][i];
}

/* A straight line in each slab, different between slabs: noise of unit variance keeps unit variance within four
 * errors. */
static void planted_profile(void **state)
{
  (void)state;
  const double heights[] = {10, 33.3}; /* 100 and 30 grains a slab */
  for (int h = 0; h < 2; h++) {
    gg_model model = {.n = N, .box = {10, heights[h], 10}, .walled = true};
    gg_local_frame frame;
    sums s = {{0}, {0}};
    int samples = 200;
    gg_rng rng = gg_common_rng_seed(21, (uint64_t)h);
    for (int k = 0; k < samples; k++) {
      for (int i = 0; i < N; i++) {
        double y = heights[h] * gg_rng_uniform(&rng), slabs = floor(heights[h]);
        double slab = floor(y / heights[h] * slabs), u = 50 * sin(slab) + 20 * cos(3 * slab) * (y - slab);
        r[0][i] = 0, r[1][i] = y, r[2][i] = 0;
        c[0][i] = u + gg_common_rng_normal(&rng), c[1][i] = 3 + gg_common_rng_normal(&rng),
        c[2][i] = gg_common_rng_normal(&rng);
      }
      gg_measure_slabs_take(&slabs_now, &model, &planted);
      gg_measure_local_frame_make(&frame, &slabs_now);
      assert_int_equal(frame.n, (int)floor(heights[h]));
      gg_measure_local_frame_snapshot(&frame, &planted, add, &s);
    }
    double n = (double)N * samples, error = sqrt(2 / n);
    for (int a = 0; a < 3; a++) {
      assert_true(fabs(s.square[a] / n - 1) < 4 * error * 1.1);
      assert_true(fabs(s.mean[a] / n) < 1e-12 * 50);
    }
  }
}

typedef struct spins {
  double square[2], n[2];
  bool whole;
} spins;

static void add_spins(void *context, const gg_chunk *chunk)
{
  spins *s = context;
  for (size_t i = 0; i < chunk->n; i++) {
    int k = chunk->species[i];
    for (int a = 0; a < 3; a++) s->square[k] += chunk->s[a][i] * chunk->s[a][i];
    s->n[k] += 3;
    s->whole &= chunk->whole_s[2][i] == w[2][i];
  }
}

/* Grains of two sizes roll at the rate of their slab: a profile of spins that is no heat. */
static void planted_spins(void **state)
{
  (void)state;
  gg_model model = {.n = N, .n_species = 2, .diameter = {1, 3}, .box = {10, 20, 10}, .walled = true};
  gg_local_frame frame;
  spins s = {.whole = true};
  gg_rng rng = gg_common_rng_seed(22, 0);
  rough = true;
  for (int k = 0; k < 200; k++) {
    for (int i = 0; i < N; i++) {
      species[i] = i % 2;
      r[1][i] = 20 * gg_rng_uniform(&rng);
      double radius = model.diameter[species[i]] / 2, slab = floor(r[1][i]),
             rolling = 40 * cos(slab) + 30 * sin(slab) * (r[1][i] - slab);
      for (int a = 0; a < 3; a++) w[a][i] = radius * ((a == 2) * rolling + gg_common_rng_normal(&rng));
    }
    gg_measure_slabs_take(&slabs_now, &model, &planted);
    gg_measure_local_frame_make(&frame, &slabs_now);
    gg_measure_local_frame_snapshot(&frame, &planted, add_spins, &s);
  }
  for (int k = 0; k < 2; k++) {
    double variance = model.diameter[k] * model.diameter[k] / 4;
    assert_true(fabs(s.square[k] / (s.n[k] * variance) - 1) < 4 * sqrt(2 / s.n[k]) * 1.1);
  }
  assert_true(s.whole);
  rough = false;
}

/* Neighbours that move together, each slab as one, differently from sample to sample: about the flow of all samples
 * their common velocity is heat, as that of single grains is. About the flow of one instant it would be missing. */
static void common_motion(void **state)
{
  (void)state;
  gg_model model = {.n = N, .box = {10, 20, 10}, .walled = true};
  static gg_slabs window;
  gg_local_frame frame;
  sums s = {{0}, {0}};
  enum { SAMPLES = 2000, WARM = 200 };
  gg_rng rng = gg_common_rng_seed(23, 0);
  gg_measure_slabs_init(&window, &model);
  assert_true(gg_measure_slabs_are_empty(&window));
  for (int k = 0; k < SAMPLES; k++) {
    double together[20];
    for (int j = 0; j < 20; j++) together[j] = 0.5 * gg_common_rng_normal(&rng);
    for (int i = 0; i < N; i++) {
      r[1][i] = 20 * gg_rng_uniform(&rng);
      for (int a = 0; a < 3; a++) c[a][i] = gg_common_rng_normal(&rng);
      c[0][i] += together[(int)r[1][i]] + 3 * r[1][i];
    }
    gg_measure_slabs_take(&slabs_now, &model, &planted);
    gg_measure_slabs_add(&window, &slabs_now);
    gg_measure_local_frame_make(&frame, &window);
    if (k >= WARM) gg_measure_local_frame_snapshot(&frame, &planted, add, &s);
  }
  double n = (double)N * (SAMPLES - WARM), error = sqrt(2 / n), error_x = hypot(error, 0.25 * sqrt(2 / 36e3));
  print_message("# %.4f %.4f %.4f\n", s.square[0] / n, s.square[1] / n, s.square[2] / n);
  assert_true(fabs(s.square[0] / n - 1.25) < 5 * error_x);
  for (int a = 1; a < 3; a++) assert_true(fabs(s.square[a] / n - 1) < 5 * error);
}

static gg_model between_like_walls(void)
{
  gg_model m;
  gg_scene s = gg_scene_defaults();
  s.flow = GG_COUETTE, s.phi = 0.1, s.particles = N;
  assert_int_equal(gg_scene_model_make(&s, GG_MD, &m, NULL), GG_OK);
  return m;
}

/* Grains with a shear flow and a common drift, in a gas that is denser on one side. Between like walls the local frame
 * is antisymmetric about the centre: it has the shear and its spin without the drift. Gravity along x makes the walls
 * unlike; then the frame has the drift, too. */
static void drift_along_walls(void **state)
{
  (void)state;
  gg_model m = between_like_walls();
  const double H = m.box[1];
  gg_local_frame frame;
  gg_rng rng = gg_common_rng_seed(24, 0);
  rough = true;
  for (int i = 0; i < N; i++) {
    const double u = gg_rng_uniform(&rng), y = r[1][i] = H * u * (0.5 + 0.5 * u);
    for (int a = 0; a < 3; a++) c[a][i] = w[a][i] = 0;
    c[0][i] = 0.3 * (y - H / 2) + 0.7, w[2][i] = -0.15, species[i] = 0;
  }
  for (int like = 0; like < 2; like++) {
    m.gravity[0] = like ? 0 : 1;
    gg_measure_slabs_take(&slabs_now, &m, &planted);
    gg_measure_local_frame_of_flow(&frame, &m, &slabs_now);
    for (double y = 1; y < H / 2; y += 0.7) {
      const gg_vec low = gg_measure_local_frame_flow(&frame, y), high = gg_measure_local_frame_flow(&frame, H - y);
      if (like) assert_true(fabs(low.x + high.x) < 1e-12 * H && fabs(low.y + high.y) < 1e-12);
      if (!like) assert_true(fabs(low.x - 0.3 * (y - H / 2) - 0.7) < 1e-9);
    }
    const gg_vec spin = gg_measure_local_frame_spin(&frame, 2, (gg_vec){0, 0, -0.15}, 0);
    assert_true(fabs(spin.z) < 1e-12);
  }
  rough = false;
}

int main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test(planted_profile), cmocka_unit_test(planted_spins),
                                     cmocka_unit_test(common_motion), cmocka_unit_test(drift_along_walls)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
