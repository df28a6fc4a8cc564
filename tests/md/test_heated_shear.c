/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Proves: the Gaussian thermostat under shear (linear response) returns what collisions take, so that a gas that is
 * hardly sheared keeps its temperature, in every neighbour search, smooth and rough; momentum stays zero; and a run has
 * the same bits however it is cut into advances, and after a checkpoint. */
#include "md/md_operations.h"
#include "md_test.h"

static const md_case cases[] = {{GG_SMALL_SHEAR, 30, 0.2, 0.7, -1, INFINITY, {0}},   /* plain cells */
                                {GG_SMALL_SHEAR, 210, 0.3, 0.8, 0.3, INFINITY, {0}}, /* co-moving rows */
                                {GG_SMALL_SHEAR, 150, 0.01, 0.6, -1, INFINITY, {0}}, /* overlapping rows */
                                {GG_SMALL_SHEAR, 120, 0.45, 0.9, 0, 0.4, {0}}};      /* lists */
enum { CASES = sizeof cases / sizeof *cases };

static gg_model model_of(int c, double T)
{
  gg_scene s = md_scene(cases[c]);
  s.thermostat = GG_GAUSSIAN;
  gg_model m = md_model_of(&s);
  m.temperature0 = T;
  return m;
}

static double advance(gg_md *e, double dt)
{
  gg_error err = {0};
  double gone = 0;
  if (gg_md_ops.advance(&e->base, dt, UINT64_MAX, &gone, &err) != GG_OK) fail_msg("%s", err.message);
  return gone;
}

static double temperature(const gg_md *e)
{
  return 2 * md_energy(e) / (3.0 * e->n);
}

static void slow_shear_leaves_the_temperature(void **state)
{
  (void)state;
  for (int c = 0; c < CASES; c++) {
    const gg_model m = model_of(c, 1e8); /* a* of 1e-4: hardly any work */
    gg_md *e = md_create(&m, 3);
    gg_collision_sums sums;
    double lost = 0, lowest = INFINITY, highest = 0;
    const double T0 = temperature(e), free_time = 1 / gg_common_model_collision_rate(&m, T0);
    for (int k = 0; k < 300; k++) {
      assert_true(fabs(advance(e, 0.37 * free_time) - 0.37 * free_time) < 1e-9 * free_time);
      gg_md_ops.take_sums(&e->base, &sums);
      lost += sums.loss[0];
      if (temperature(e) / T0 < lowest) lowest = temperature(e) / T0;
      if (temperature(e) / T0 > highest) highest = temperature(e) / T0;
    }
    if (!(lost > 3 * 1.5 * e->n * T0)) fail_msg("case %d: collisions took %g of %g", c, lost, 1.5 * e->n * T0);
    if (!(lowest > 0.8 && highest < 1.05)) fail_msg("case %d: T from %g to %g of the start", c, lowest, highest);
    const gg_vec p = md_momentum(e);
    assert_true(gg_dot(p, p) < 1e-18 * e->n * e->n * T0);
    assert_int_equal(md_misplaced(e), 0);
    md_destroy(e);
  }
}

static void bits_do_not_depend_on_cuts(void **state)
{
  (void)state;
  for (int c = 0; c < CASES; c++) {
    const gg_model m = model_of(c, 50);
    gg_md *whole = md_create(&m, 3), *cut = md_create(&m, 3);
    gg_engine *restored = NULL;
    gg_archive a = {0};
    const double time = 40 / gg_common_model_collision_rate(&m, m.temperature0);
    for (int k = 0; k < 16; k++) advance(whole, time / 16);
    for (int k = 0; k < 8; k++) advance(cut, time / 16);
    assert_int_equal(gg_md_ops.save(&cut->base, &a, NULL), GG_OK);
    assert_int_equal(gg_md_ops.restore(&m, &a, &restored, NULL), GG_OK);
    gg_md *next = (gg_md *)restored;
    for (int k = 0; k < 16; k++) {
      uint64_t before = next->k.collisions;
      advance(next, time / 32);
      assert_true(next->k.collisions > before);
    }
    for (uint32_t i = 0; i < whole->n; i++) {
      const gg_vec one = gg_md_position(whole, false, &whole->grain[i], whole->k.now),
                   two = gg_md_position(next, false, &next->grain[i], next->k.now);
      if (whole->grain[i].counter != next->grain[i].counter || fabs(one.x - two.x) > 1e-9 * whole->box.edge[0])
        fail_msg("case %d: grain %u", c, i);
    }
    assert_true(whole->k.collisions == next->k.collisions);
    gg_base_archive_clear(&a);
    md_destroy(whole), md_destroy(cut), md_destroy(next);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test(slow_shear_leaves_the_temperature),
                                     cmocka_unit_test(bits_do_not_depend_on_cuts)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
