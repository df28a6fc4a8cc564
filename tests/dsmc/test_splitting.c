/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Symmetric splitting of a step over the pairs of species. All pairs get the same time, the second half of the list of
 * substeps mirrors the first, and both orders together take no longer than the step: in the list, and as the collision
 * callback of a mixture sees it. */
#include "dsmc/ensemble.h"
#include "dsmc/splitting.h"
#include "lab.h"

static void substeps_cover_all(void **state)
{
  (void)state;
  for (int pairs = 1; pairs <= GG_PAIRS; pairs++)
    for (int sweeps = 1; sweeps <= GG_DSMC_MAX_SWEEPS; sweeps++) {
      gg_dsmc_substep substep[GG_DSMC_MAX_SUBSTEPS];
      gg_dsmc_splitting splitting = (gg_dsmc_splitting)(sweeps % (GG_DSMC_SYMMETRIC + 1));
      int n = gg_dsmc_list_substeps(pairs, splitting, sweeps, substep), sum[GG_PAIRS] = {0};
      assert_in_range(n, 1, GG_DSMC_MAX_SUBSTEPS);
      for (int k = 0; k < n; k++) {
        assert_int_equal(substep[k].begin, sum[substep[k].pair]); /* whole sweeps that this pair has done */
        sum[substep[k].pair] += substep[k].length;
        assert_true(k == 0 || substep[k].pair != substep[k - 1].pair);
      }
      for (int q = 0; q < pairs; q++) assert_int_equal(sum[q], sweeps);
    }
}

static void the_symmetric_list_is_symmetric(void **state)
{
  (void)state;
  gg_dsmc_substep substep[GG_DSMC_MAX_SUBSTEPS];
  for (int sweeps = 2; sweeps <= GG_DSMC_MAX_SWEEPS; sweeps += 2) {
    int n = gg_dsmc_list_substeps(GG_PAIRS, GG_DSMC_SYMMETRIC, sweeps, substep);
    for (int k = 0; k < n; k++) {
      const gg_dsmc_substep *a = &substep[k], *b = &substep[n - 1 - k];
      assert_true(a->pair == b->pair && a->length == b->length && a->begin + a->length + b->begin == sweeps);
    }
  }
}

static void the_backward_list_is_reversed(void **state)
{
  (void)state;
  gg_dsmc_substep there[GG_DSMC_MAX_SUBSTEPS], back[GG_DSMC_MAX_SUBSTEPS];
  assert_int_equal(gg_dsmc_list_substeps(GG_PAIRS, GG_DSMC_FORWARD, 1, there), GG_PAIRS);
  assert_int_equal(gg_dsmc_list_substeps(GG_PAIRS, GG_DSMC_BACKWARD, 1, back), GG_PAIRS);
  for (int q = 0; q < GG_PAIRS; q++) assert_int_equal(there[q].pair, back[GG_PAIRS - 1 - q].pair);
}

static gg_model mixture(gg_flow flow)
{
  gg_scene s = lab_scene(flow, 0.2, 0.95, -1, 2000);
  s.n_species = 2;
  s.species[0].fraction = 0.5;
  s.species[1] = (gg_species){0.5, 1, 4, 0.4, 1, 0};
  return lab_model(&s);
}

/* Whole steps, the rest of a step at the end of a run, and parts of steps have as many substeps as they should. */
static void substeps_are_as_many_as_the_step_asks(void **state)
{
  (void)state;
  for (int sheared = 0; sheared < 2; sheared++) {
    gg_model m = mixture(sheared ? GG_USF : GG_HCS);
    gg_dsmc_time_step step = gg_dsmc_time_step_choose(&m, 1);
    double free_time = 1 / gg_common_model_collision_rate(&m, 1);
    assert_true(step.splitting <= 0.25 * free_time && step.length > 1.9 * step.splitting);
    for (double dt = step.length; dt > 0.01 * step.splitting; dt *= 0.7) {
      int sweeps = gg_dsmc_sweeps_of(&step, GG_DSMC_SYMMETRIC, dt);
      assert_int_equal(sweeps % 2, 0);
      assert_true(2 * dt / sweeps <= step.splitting * (1 + 1e-6));
      for (int parts = 1; parts <= 16; parts++) {
        int each = gg_dsmc_sweeps_of_part(&step, GG_DSMC_SYMMETRIC, dt, parts);
        assert_true(each % 2 == 0 && each >= 2 && each <= GG_DSMC_MAX_SWEEPS);
        assert_true(each * parts >= sweeps && (each - 2) * parts < sweeps);
      }
    }
    assert_int_equal(gg_dsmc_sweeps_of(&step, GG_DSMC_FORWARD, step.length), 1);
    assert_int_equal(gg_dsmc_sweeps_of_part(&step, GG_DSMC_BACKWARD, step.length, 3), 1);
  }
}

/* Times between collisions of a grain. */
typedef struct flights {
  double unit, shortest; /* unit: the mean free time */
  uint64_t n, middling;  /* middling: from 0.5 to 1.5 units */
} flights;

static void count_flight(void *context, const gg_collision_record *c)
{
  flights *f = context;
  for (int g = 0; g < 2; g++) {
    double since = c->since[g] / f->unit;
    if (!(since < INFINITY)) continue;
    f->n++;
    f->middling += since > 0.5 && since < 1.5;
    f->shortest = fmin(f->shortest, since);
  }
}

/* The time since a grain's last collision may be negative if a step is split over pairs of species, but by no more than
 * the two orders take together. With many substeps per step, flights are as long as in any gas; with all collisions at
 * the beginning of their step, no flight would have a middle length. */
static void collisions_come_in_their_time(void **state)
{
  (void)state;
  gg_model m = mixture(GG_HCS);
  gg_engine *g = lab_engine(&m, 5);
  flights f = {.unit = 1 / gg_common_model_collision_rate(&m, m.temperature0)};
  gg_error err;
  assert_int_equal(gg_dsmc_ops.set_callback(g, count_flight, &f, &err), GG_OK);
  lab_advance(g, 6 * f.unit, UINT64_MAX);
  double share = (double)f.middling / (double)f.n;
  printf("# %d flights, shortest %.3f mean free times, %.3f of them middling\n", (int)f.n, f.shortest, share);
  assert_true(f.n > 5000);
  assert_true(f.shortest > -0.27); /* a quarter, and a little because the mean free time grows as the gas cools */
  assert_true(share > 0.3 && share < 0.45);
  gg_dsmc_ops.destroy(g);
}

/* The most by which the square of a velocity that is constant in the laboratory grows while the strain grows by s. */
static double largest_growth(double s)
{
  return 1 + s * s / 2 + s * sqrt(1 + s * s / 4);
}

/* Bounds of speeds that hold at one strain are raised until they hold over the whole interval of strains that a substep
 * goes back and forth over. */
static void bounds_hold_over_a_sweep(void **state)
{
  (void)state;
  for (double width = 0; width < 0.5; width += 0.07)
    for (double strain = -0.6; strain < 0.6; strain += 0.13) {
      gg_dsmc_ensemble e = {.bound_scale = 1, .bound_strain = 0.1, .bound_width = 0.05};
      gg_dsmc_ensemble_strain_bounds(&e, strain, width);
      double down = 0.1 - strain, up = strain + width - 0.15, far = fmax(fmax(down, up), 0);
      assert_true(e.bound_scale >= largest_growth(far) && e.bound_scale < 1.2 * largest_growth(far));
      double before = e.bound_scale;
      gg_dsmc_ensemble_strain_bounds(&e, strain + 0.3 * width, 0.7 * width); /* within the last */
      assert_true(fabs(e.bound_scale / before - 1) < 1e-12);
    }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(substeps_cover_all),
      cmocka_unit_test(the_symmetric_list_is_symmetric),
      cmocka_unit_test(the_backward_list_is_reversed),
      cmocka_unit_test(substeps_are_as_many_as_the_step_asks),
      cmocka_unit_test(bounds_hold_over_a_sweep),
      cmocka_unit_test(collisions_come_in_their_time),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
