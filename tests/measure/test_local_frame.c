/* The local frame of walled flows: a planted profile u(y) of any shape is taken out, and the variance that is left is
 * that of the planted noise, few grains a slab or many (the 1/n_c correction). Mean spins of slabs likewise, and what
 * comes of both as a temperature ratio. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>

#include <cmocka.h>
#include <math.h>

#include "common/rng.h"
#include "measure/local_frame.h"

enum { N = 1000 };
static double r[3][N], c[3][N], w[3][N];
static uint8_t species[N];
static bool rough;

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

/* Slabs with a constant velocity each: noise of unit variance comes out with unit variance within four errors. */
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
        double u = 50 * sin(floor(y / heights[h] * slabs)); /* constant in each slab */
        r[0][i] = 0, r[1][i] = y, r[2][i] = 0;
        c[0][i] = u + gg_common_rng_normal(&rng), c[1][i] = 3 + gg_common_rng_normal(&rng),
        c[2][i] = gg_common_rng_normal(&rng);
      }
      gg_measure_local_frame_take(&frame, &model, &planted);
      assert_int_equal(frame.n_slabs, (int)floor(heights[h]));
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
      double radius = model.diameter[species[i]] / 2, rolling = 40 * cos(floor(r[1][i]));
      for (int a = 0; a < 3; a++) w[a][i] = radius * ((a == 2) * rolling + gg_common_rng_normal(&rng));
    }
    gg_measure_local_frame_take(&frame, &model, &planted);
    gg_measure_local_frame_snapshot(&frame, &planted, add_spins, &s);
  }
  for (int k = 0; k < 2; k++) {
    double variance = model.diameter[k] * model.diameter[k] / 4;
    assert_true(fabs(s.square[k] / (s.n[k] * variance) - 1) < 4 * sqrt(2 / s.n[k]) * 1.1);
  }
  assert_true(s.whole);
  rough = false;
}

int main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test(planted_profile), cmocka_unit_test(planted_spins)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
