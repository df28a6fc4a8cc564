/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A row sampled from the Monte Carlo engine's blocks equals, to the bit, the row sampled from its chunks, for any
 * scene; roots in single precision change the mean speed by less than 1e-8. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>

#include <cmocka.h>
#include <math.h>
#include <string.h>

#include "measure/rheology.h"
#include "scene/model_of_scene.h"

static gg_model model_of(gg_flow flow, double beta, int species, gg_precision precision, int64_t n)
{
  gg_scene s = gg_scene_defaults();
  s.engine = GG_DSMC, s.flow = flow, s.phi = 0.2, s.dsmc.particles = n, s.dsmc.precision = precision;
  s.n_species = species;
  s.species[0] = (gg_species){species == 2 ? 0.4 : 1, 1, 1, 0.4, 1, 0};
  s.species[1] = (gg_species){0.6, 0.7, 2, 0.3, 1, 0};
  for (int p = 0; p < GG_PAIRS; p++) s.collision.beta[p] = beta;
  gg_model m;
  gg_error err = {0};
  if (gg_scene_model_make(&s, GG_DSMC, &m, &err) != GG_OK) fail_msg("%s", err.message);
  return m;
}

static void take_row(gg_engine *g, const gg_model *m, void *self, bool blocks, double elapsed, double *row)
{
  const gg_collision_sums transfer = {.collisions = {100, 20, 30}, .loss = {7, 5, 3}};
  const gg_interval in = {m, &transfer, elapsed, 1};
  gg_measure_rheology.rows->begin(self);
  if (blocks)
    g->ops->blocks(g, gg_measure_rheology.rows->add_blocks, self);
  else
    g->ops->snapshot(g, false, gg_measure_rheology.rows->add_chunk, self);
  gg_measure_rheology.rows->finish(self, &in, row);
}

static void add_speed(void *context, const gg_chunk *chunk)
{
  double *sum = context;
  for (size_t i = 0; i < chunk->n; i++)
    *sum += sqrt(chunk->c[0][i] * chunk->c[0][i] + chunk->c[1][i] * chunk->c[1][i] + chunk->c[2][i] * chunk->c[2][i]);
}

/* The first sample makes no row and takes roots in double precision; later samples have a temperature for their
 * choice. */
static void same_rows_in(const gg_model *m, uint64_t seed)
{
  gg_engine *g = NULL;
  gg_error err = {0};
  double row[2][128] = {{0}}, elapsed, speed = 0;
  if (gg_dsmc_ops.create(m, seed, 0, &g, &err) != GG_OK) fail_msg("%s", err.message);
  void *self[2] = {gg_measure_rheology.create(m, &err), gg_measure_rheology.create(m, &err)};
  for (int sample = 0; sample < 4; sample++) {
    for (int k = 0; k < 2; k++) take_row(g, m, self[k], k, sample ? 0.5 : 0, row[k]);
    assert_memory_equal(row[0], row[1], gg_measure_rheology.rows->width(m) * sizeof(double));
    if (sample == 3) break;
    assert_int_equal(g->ops->advance(g, INFINITY, (uint64_t)m->n, &elapsed, &err),
                     GG_OK); /* ends with shear strain not yet applied */
  }
  g->ops->snapshot(g, false, add_speed, &speed);
  double sampled = 0, T = 1;
  for (int i = 0; i < m->n_species; i++)
    sampled += (double)m->n_of[i] * row[1][CH_SPECIES + (size_t)i * gg_rheology_species_width(m) + CH_SPEED];
  if (m->flow == GG_HCS) T = exp(row[1][CH_LN_T]);
  assert_true(fabs(sampled * sqrt(T) / speed - 1) < 1e-8); /* each root to 9e-8, up or down */
  assert_true(fabs(sampled * sqrt(T) / speed - 1) > 0);
  for (int k = 0; k < 2; k++) gg_measure_rheology.destroy(self[k]);
  g->ops->destroy(g);
}

static void same_rows(void **state)
{
  (void)state;
  const gg_flow flows[] = {GG_USF, GG_HCS, GG_HSS};
  for (int flow = 0; flow < 3; flow++)
    for (int rough = 0; rough < 2; rough++)
      for (int species = 1; species <= 2; species++)
        for (int single = 0; single < 2; single++) {
          gg_model m = model_of(flows[flow], rough ? 0.2 : -1, species, single ? GG_SINGLE : GG_DOUBLE, 1003);
          same_rows_in(&m, (uint64_t)(100 * flow + 10 * rough + species));
        }
}

/* Squares beyond single precision: roots in double, in any unit of velocity. */
static void far_units(void **state)
{
  (void)state;
  const double units[] = {1, 0x1p-60, 0x1p60};
  gg_model m = model_of(GG_USF, 0.2, 1, GG_DOUBLE, 40);
  double c[6][40], row[3][64], speed = 0;
  for (int u = 0; u < 3; u++) {
    void *self = gg_measure_rheology.create(&m, NULL);
    for (int a = 0; a < 6; a++)
      for (int i = 0; i < 40; i++) c[a][i] = units[u] * sin(1 + i + 40 * a);
    const gg_chunk chunk = {.n = 40, .c = {c[0], c[1], c[2]}, .s = {c[3], c[4], c[5]}};
    for (int sample = 0; sample < 2; sample++) {
      const gg_collision_sums transfer = {0};
      const gg_interval in = {&m, &transfer, sample, 1};
      gg_measure_rheology.rows->begin(self);
      gg_measure_rheology.rows->add_chunk(self, &chunk);
      gg_measure_rheology.rows->finish(self, &in, row[u]);
    }
    gg_measure_rheology.destroy(self);
  }
  for (int i = 0; i < 40; i++) speed += sqrt(c[0][i] * c[0][i] + c[1][i] * c[1][i] + c[2][i] * c[2][i]) / 40;
  for (int u = 0; u < 3; u++)
    assert_true(fabs(row[u][CH_SPECIES + CH_SPEED] / units[u] / (speed * 0x1p-60) - 1) < (u ? 1e-15 : 2e-8));
  assert_true(row[1][CH_SPECIES + CH_COS2] == row[0][CH_SPECIES + CH_COS2]);
}

int main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test(same_rows), cmocka_unit_test(far_units)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
