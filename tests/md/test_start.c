/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Proves: starts at every solid fraction from 0.001 to 0.6 have no overlaps, no total momentum and exactly the
 * temperatures asked for; boxes too small for the nearest image and impossible solid fractions are rejected by key;
 * long and flat boxes run; grains above an open top are shown there; homogeneous gases without shear collide at
 * Enskog's rate from time zero. */
#include <stdlib.h>
#include <string.h>

#include "md/start/place.h"
#include "md_test.h"
#include "scene/scene.h"

static void check_start(md_case c)
{
  gg_model m = md_model(c);
  gg_md *e = md_create(&m, 11);
  assert_true(md_closest(e) >= 1);
  gg_vec p = md_momentum(e);
  double T = 0, theta = 0;
  for (uint32_t i = 0; i < e->n; i++) {
    gg_vec v = e->grain[i].v;
    v.x -= m.shear_rate * (e->grain[i].r.y - 0.5 * m.box[1]);
    T += gg_dot(v, v) / 3 / e->n;
    if (e->spin) {
      gg_vec s = e->spin[i];
      s.z += 0.25 * m.shear_rate;
      theta += m.inertia[0] * gg_dot(s, s) / 3 / e->n;
    }
  }
  assert_true(sqrt(gg_dot(p, p)) < 1e-11 * sqrt(T) * e->n);
  assert_true(fabs(T / m.temperature0 - 1) < 1e-12);
  if (e->spin) assert_true(fabs(theta / (m.ratio0 * T) - 1) < 1e-12);
  md_destroy(e);
}

static void gases_start_at_any_solid_fraction(void **state)
{
  (void)state;
  static const double phis[] = {0.001, 0.01, 0.1, 0.3, 0.45, 0.5, 0.55, 0.6};
  for (int k = 0; k < 8; k++) {
    check_start((md_case){GG_EQUILIBRIUM, 500, phis[k], 1, -1, INFINITY, {0}});
    check_start((md_case){GG_USF, 1000, phis[k], 0.9, 0, INFINITY, {2, 1, 1}});
  }
  check_start((md_case){GG_HCS, 32, 0.6, 0.9, 0, INFINITY, {0}});
  check_start((md_case){GG_HCS, 2, 0.001, 0.9, 0, INFINITY, {0}});
}

/* Starts of dense mixtures have the composition asked for, and no grain is in a wall. */
static void dense_mixtures_start_between_walls(void **state)
{
  (void)state;
  for (int k = 0; k < 4; k++) {
    gg_scene s = md_scene((md_case){k % 2 ? GG_COUETTE : GG_USF, 600, k % 2 ? 0.5 : 0.6, 0.9, 0, INFINITY, {0}});
    s.n_species = 2;
    s.species[0].fraction = 0.25, s.species[1].fraction = 0.75;
    s.species[1].diameter = k < 2 ? 0.5 : 1.6;
    gg_model m = md_model_of(&s);
    gg_md *e = md_create(&m, 5);
    int64_t first = 0;
    double solid = 0;
    for (uint32_t i = 0; i < e->n; i++) {
      double d = m.diameter[gg_md_species_of(&e->grain[i])], y = e->grain[i].r.y;
      first += gg_md_species_of(&e->grain[i]) == 0;
      solid += M_PI / 6 * d * d * d / m.volume;
      if (m.walled) assert_true(y >= 0.5 * d && y <= m.box[1] - 0.5 * d);
    }
    assert_int_equal(first, 150);
    assert_true(fabs(solid - s.phi) < 1e-12 && md_closest(e) >= 1);
    md_destroy(e);
  }
}

/* Long and flat boxes start and run, dilute and dense. */
static void long_and_flat_boxes_run(void **state)
{
  (void)state;
  static const double shapes[][3] = {{12, 1, 1}, {1, 12, 1}, {1, 1, 12}, {6, 6, 1}, {1, 5, 5}};
  static const struct {
    gg_flow flow;
    double phi;
  } kinds[] = {{GG_HCS, 0.001}, {GG_HCS, 0.45},    {GG_USF, 0.01},
               {GG_USF, 0.5},   {GG_COUETTE, 0.2}, {GG_EQUILIBRIUM, 0.6}};
  for (int s = 0; s < 5; s++)
    for (int k = 0; k < 6; k++) {
      bool elastic = kinds[k].flow == GG_EQUILIBRIUM;
      md_case c = {kinds[k].flow, 500, kinds[k].phi, elastic ? 1 : 0.9, elastic ? -1 : 0, INFINITY, {0}};
      for (int a = 0; a < 3; a++) c.aspect[a] = shapes[s][a];
      gg_model m = md_model(c);
      gg_md *e = md_create(&m, 2);
      md_collide(e, 3000);
      if (md_misplaced(e) || !(md_closest(e) > 1 - 1e-12L && e->k.worst_overlap < 1e-12))
        fail_msg("shape %d kind %d: %u misplaced, worst overlap %g", s, k, md_misplaced(e), e->k.worst_overlap);
      md_destroy(e);
    }
}

static void take_places(void *context, const gg_chunk *chunk)
{
  double *r = context;
  for (size_t k = 0; k < chunk->n; k++)
    for (int a = 0; a < 3; a++) r[3 * chunk->id[k] + (size_t)a] = chunk->r[a][k];
}

/* From 50 000 grains on a start finds overlaps by lists. No pair is closer than contact, which is tested with the check
 * of given places, and that check finds a grain that is moved into its neighbour. Two sizes, dense and dilute. */
static void large_starts_have_no_overlaps(void **state)
{
  (void)state;
  static const double phis[] = {0.001, 0.3, 0.5};
  for (int k = 0; k < 3; k++) {
    gg_scene s = md_scene((md_case){GG_EQUILIBRIUM, 50000, phis[k], 1, -1, INFINITY, {k == 1 ? 2 : 1, 1, 1}});
    s.n_species = k == 1 ? 2 : 1;
    s.species[0].fraction = s.species[1].fraction = s.n_species == 2 ? 0.5 : 1;
    s.species[1].diameter = 0.7;
    gg_model m = md_model_of(&s);
    gg_md *e = md_create(&m, 3);
    gg_engine *again = NULL;
    gg_error err = {0};
    double *r = malloc(3 * 50000 * sizeof *r);
    int *species = malloc(50000 * sizeof *species);
    gg_md_ops.snapshot(&e->base, true, take_places, r);
    for (uint32_t i = 0; i < e->n; i++) species[e->id[i]] = gg_md_species_of(&e->grain[i]);
    const gg_grain_arrays given = {.r = r, .species = species};
    assert_int_equal(gg_md_ops.create_with(&m, 3, 0, &given, NULL, &again, &err), GG_OK);
    gg_md_ops.destroy(again);
    for (int a = 0; a < 3; a++) r[a] = r[3 + a] + (a == 0) * 0.3;
    r[0] = fmin(r[0], m.box[0] * (1 - 1e-9));
    assert_int_equal(gg_md_ops.create_with(&m, 3, 0, &given, NULL, &again, &err), GG_BAD_INPUT);
    free(r);
    free(species);
    md_destroy(e);
  }
}

/* The number of threads that share a large start changes no bit of places, velocities and first events: with two sizes,
 * and in a gas that has run before it begins. */
static void threads_leave_bits_alone(void **state)
{
  (void)state;
  static const gg_flow flows[] = {GG_EQUILIBRIUM, GG_USF, GG_HCS};
  static const double phis[] = {0.5, 0.3, 0.01};
  for (int k = 0; k < 3; k++) {
    gg_scene s = md_scene((md_case){flows[k], 60000, phis[k], k ? 0.9 : 1, -1, INFINITY, {k == 1 ? 2 : 1, 1, 1}});
    s.n_species = k == 1 ? 2 : 1;
    s.species[0].fraction = s.species[1].fraction = s.n_species == 2 ? 0.5 : 1;
    s.species[1].diameter = 0.7;
    gg_model m = md_model_of(&s);
    uint64_t first = 0;
    for (m.threads = 1; m.threads <= 3; m.threads += getenv("NIGHTLY") ? 1 : 2) {
      gg_md *e = md_create(&m, 5);
      const uint64_t hash = md_hash(e);
      if (m.threads == 1) first = hash;
      assert_true(hash == first);
      md_destroy(e);
    }
  }
}

typedef struct shown {
  int64_t n, above;
  double height;
} shown;

static void count_shown(void *context, const gg_chunk *chunk)
{
  shown *s = context;
  for (size_t i = 0; i < chunk->n; i++, s->n++) {
    assert_true(chunk->r[0][i] >= 0 && chunk->r[2][i] >= 0 && chunk->r[1][i] > 0.5 - 1e-9);
    s->above += chunk->r[1][i] > s->height;
  }
}

/* Grains that fly above an open top are shown there. */
static void grains_above_an_open_top_are_shown(void **state)
{
  (void)state;
  gg_scene s = md_scene((md_case){GG_CHUTE, 100, 0.1, 1, -1, INFINITY, {0}});
  s.walls.top = GG_OPEN_TOP, s.walls.e = 1, s.walls.beta = -1;
  s.gravity[1] = -0.05;
  gg_model m = md_model_of(&s);
  m.temperature0 = 0.5; /* warm enough to rise above the box */
  gg_md *e = md_create(&m, 3);
  md_collide(e, 5000);
  shown seen = {.height = m.box[1]};
  int64_t above = 0;
  gg_md_ops.snapshot(&e->base, true, count_shown, &seen);
  for (uint32_t i = 0; i < e->n; i++) above += gg_md_position(e, true, &e->grain[i], e->k.now).y > m.box[1];
  assert_int_equal(seen.n, 100);
  assert_true(seen.above == above && above > 10 && above < 100);
  assert_true(md_closest(e) > 1 - 1e-12L && md_misplaced(e) == 0);
  md_destroy(e);
}

static void check_rejected(md_case c, const char *key)
{
  gg_model m = md_model(c);
  gg_error err = {0};
  gg_engine *engine = NULL;
  assert_int_equal(gg_md_ops.accepts(&m, &err), GG_BAD_INPUT);
  assert_non_null(strstr(err.message, key));
  assert_int_equal(gg_md_ops.create(&m, 1, 0, &engine, &err), GG_BAD_INPUT);
  assert_null(engine);
}

static void impossible_scenes_are_rejected_by_key(void **state)
{
  (void)state;
  check_rejected((md_case){GG_USF, 2, 0.3, 0.9, -1, INFINITY, {0}}, "particles");
  check_rejected((md_case){GG_USF, 100, 0.3, 0.9, -1, INFINITY, {60, 1, 1}}, "two images of another");
  check_rejected((md_case){GG_COUETTE, 100, 0.1, 0.9, -1, INFINITY, {12, 1, 12}},
                 "gap between the walls is 1.538 diameters");
  check_rejected((md_case){GG_USF, 100, 0, 0.9, -1, INFINITY, {0}}, "phi");
  check_rejected((md_case){GG_USF, 100, 0.7, 0.9, -1, INFINITY, {0}}, "phi");
  check_rejected((md_case){GG_USF, 1, 0.1, 0.9, -1, INFINITY, {0}}, "particles");
}

/* A gas so dilute that grains cross 10^7 cells a collision is rejected with a hint to dsmc; a denser one is not. */
static void too_dilute_a_gas_is_rejected(void **state)
{
  (void)state;
  gg_error err = {0};
  gg_model m = md_model((md_case){GG_HCS, 1000, 1e-12, 0.9, -1, INFINITY, {0}});
  assert_int_equal(gg_md_ops.accepts(&m, &err), GG_BAD_INPUT);
  assert_non_null(strstr(err.message, "engine: dsmc is exact"));
  m = md_model((md_case){GG_HCS, 1000, 1e-11, 0.9, -1, INFINITY, {0}});
  assert_int_equal(gg_md_ops.accepts(&m, &err), GG_OK);
  /* The estimated number of crossings is right where it can be measured. */
  m = md_model((md_case){GG_EQUILIBRIUM, 1000, 1e-5, 1, -1, INFINITY, {0}});
  gg_md *e = md_create(&m, 1);
  md_collide(e, 500);
  double measured = (double)e->k.events / 500, estimate = gg_md_crossings_per_collision(&m);
  if (!(fabs(measured / estimate - 1) < 0.2)) fail_msg("%g crossings a collision, not %g", measured, estimate);
  md_destroy(e);
}

/* The lattice has a site for each grain; `nearest` is the smallest distance of two sites. */
static void check_lattice(const double edge[3], uint32_t n, double nearest)
{
  gg_vec r[500] = {{0, 0, 0}};
  gg_md_box box = {.edge = {edge[0], edge[1], edge[2]}};
  for (int a = 0; a < 3; a++) box.inverse[a] = 1 / edge[a];
  gg_rng rng = gg_common_rng_seed(4, 0);
  gg_md_place_lattice(&box, n, &rng, r);
  double least = INFINITY;
  for (uint32_t i = 0; i < n; i++)
    for (uint32_t j = 0; j < i; j++) {
      gg_vec dr = gg_sub(r[i], r[j]), dv = {0, 0, 0};
      gg_md_minimum_image(&box, 0, 0, &dr, &dv);
      least = fmin(least, sqrt(gg_dot(dr, dr)));
    }
  if (!(fabs(least / nearest - 1) < 1e-12)) fail_msg("%d grains: nearest %g, not %g", (int)n, least, nearest);
}

static void lattices_have_their_spacing(void **state)
{
  (void)state;
  check_lattice((double[]){3, 3, 3}, 4 * 27, sqrt(0.5));
  check_lattice((double[]){3, 3, 3}, 4 * 27 - 5, sqrt(0.5)); /* some sites empty */
  check_lattice((double[]){2, 5, 3}, 4 * 30, sqrt(0.5));
  check_lattice((double[]){4, 1.2, 2.4}, 4 * 8,
                0.5 * sqrt(1 + 1.2 * 1.2)); /* 4 x 1 x 2 cells, stretched along two edges */
}

/* The number of collisions in the first quarter of a mean free time over that of Enskog's rate, over 16 starts. */
static double early_rate(gg_flow flow, double phi, double diameter)
{
  double collisions = 0, expected = 0;
  for (uint64_t seed = 1; seed <= 16; seed++) {
    gg_scene s = md_scene((md_case){flow, 4000, phi, 0.9, 0, INFINITY, {0}});
    s.n_species = diameter < 1 ? 2 : 1;
    s.species[0].fraction = s.species[1].fraction = 0.5;
    s.species[1].diameter = diameter;
    const gg_model m = md_model_of(&s);
    gg_md *e = md_create(&m, seed);
    const double rate = gg_common_model_collision_rate(&m, m.temperature0);
    double elapsed;
    gg_error err = {0};
    if (gg_md_ops.advance(&e->base, 0.25 / rate, UINT64_MAX, &elapsed, &err) != GG_OK) fail_msg("%s", err.message);
    collisions += (double)e->k.collisions, expected += 0.25 * 4000 / 2;
    md_destroy(e);
  }
  return collisions / expected;
}

/* Gases without shear begin in equilibrium, with Enskog's rate: counting has an error of 1.1 %, and cooling lowers the
 * rate by 0.4 %. Sheared gases do not: they begin from places in which overlaps were pushed apart. */
static void gases_begin_at_enskogs_rate(void **state)
{
  (void)state;
  static const double phis[] = {0.01, 0.1, 0.3, 0.45};
  for (int k = 0; k < 4; k += getenv("NIGHTLY") ? 1 : 3) {
    const double rate = early_rate(k % 2 ? GG_HSS : GG_HCS, phis[k], 1);
    if (!(fabs(rate - 1) < 0.03)) fail_msg("phi %g: %g times Enskog's rate", phis[k], rate);
  }
  const double mixture = early_rate(GG_HSS, 0.3, 0.7);
  if (!(fabs(mixture - 1) < 0.03)) fail_msg("of two sizes: %g times Enskog's rate", mixture);
  assert_true(early_rate(GG_USF, 0.3, 1) > 1.5);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(gases_start_at_any_solid_fraction),
      cmocka_unit_test(dense_mixtures_start_between_walls),
      cmocka_unit_test(large_starts_have_no_overlaps),
      cmocka_unit_test(threads_leave_bits_alone),
      cmocka_unit_test(long_and_flat_boxes_run),
      cmocka_unit_test(grains_above_an_open_top_are_shown),
      cmocka_unit_test(gases_begin_at_enskogs_rate),
      cmocka_unit_test(lattices_have_their_spacing),
      cmocka_unit_test(impossible_scenes_are_rejected_by_key),
      cmocka_unit_test(too_dilute_a_gas_is_rejected),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
