/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Proves: small cells with overflow lists hold what is put into them. With any number of grains in a cell they leave
 * the bits of a run that cells of eight words and the plain path leave: at rest and moving with the flow, with every
 * set of instructions, on one thread and on several, until cells have to grow. Restored runs have small cells, too. */
#include <stdlib.h>

#include "md/event_loops.h"
#include "md/md_operations.h"
#include "md/parallel/slab.h"
#include "md/row_motion.h"
#include "md_test.h"
#include "scene/scene.h"

enum { GRAINS = 40, CELLS = 27, COLLISIONS = 20000 };

/* Each grain is in its cell, once, and in no other. */
static void check_cells(const gg_md_cells *c, const int *cell_of)
{
  int seen = 0, there = 0;
  for (int k = 0; k < CELLS; k++) {
    const uint32_t *cell = c->cell + (size_t)k * c->stride;
    uint32_t found[GG_MD_MOST_IN_SMALL];
    const uint32_t *who = gg_md_cell_members(c, cell, found);
    uint64_t once = 0;
    for (uint32_t m = 0; m < cell[0]; m++, seen++) {
      assert_int_equal(cell_of[who[m]], k);
      assert_false(once >> who[m] & 1);
      once |= 1ull << who[m];
    }
  }
  for (int i = 0; i < GRAINS; i++) there += cell_of[i] >= 0;
  assert_int_equal(seen, there);
}

/* Grains enter and leave at random, most of them the first four cells. A cell has room for seven. */
static void small_cells_hold_what_is_put_in(void **state)
{
  (void)state;
  const gg_md_box box = {.edge = {3, 3, 3}};
  gg_md_cells c;
  gg_error err;
  gg_rng rng = gg_common_rng_seed(1, 1);
  int cell_of[GRAINS], refused = 0, n[CELLS] = {0};
  assert_int_equal(gg_md_cells_make_small(&c, &box, (int32_t[3]){3, 3, 3}, 1, GRAINS, &err), GG_OK);
  for (int i = 0; i < GRAINS; i++) cell_of[i] = -1;
  for (int step = 0; step < 20000; step++) {
    const uint32_t i = (uint32_t)gg_rng_below(&rng, GRAINS);
    const int k = (int)gg_rng_below(&rng, gg_rng_below(&rng, 8) ? 4 : CELLS);
    if (cell_of[i] >= 0) {
      gg_md_cell_remove_from(&c, c.cell + 4 * cell_of[i], i);
      n[cell_of[i]]--;
      cell_of[i] = -1;
    } else if (gg_md_cell_add(&c, (int32_t[3]){k % 3, k / 3 % 3, k / 9}, i)) {
      n[cell_of[i] = k]++;
    } else {
      assert_int_equal(n[k], GG_MD_MOST_IN_SMALL);
      refused++;
    }
    check_cells(&c, cell_of);
  }
  assert_true(refused > 100);
  assert_true(gg_md_cells_grow(&c));
  assert_int_equal(c.stride, 16);
  assert_null(c.next);
  check_cells(&c, cell_of);
  gg_md_cells_free(&c);
}

static const struct {
  md_case scene;
  int species;
  double width; /* width of cells, in largest diameters */
  bool grow;
} cases[] = {
    {{GG_EQUILIBRIUM, 6000, 0.3, 1, -1, INFINITY, {1, 1, 4}}, 1, 1.4, false},
    {{GG_HCS, 6000, 0.39, 0.5, 0, INFINITY, {1, 1, 4}}, 2, 1.3, false},
    {{GG_HCS, 6000, 0.3, 0.5, -1, INFINITY, {1, 1, 4}}, 1, 1.65, true},
    {{GG_USF, 6000, 0.3, 0.9, 0, INFINITY, {1, 1, 4}}, 1, 1.4, false},
    {{GG_USF, 6000, 0.35, 0.5, -1, INFINITY, {1, 1, 4}}, 2, 1.35, false},
    {{GG_USF, 6000, 0.3, 0.8, 0.3, 0.2, {1, 1, 4}}, 1, 1.75, true},
};
enum { CASES = sizeof cases / sizeof *cases };

static gg_model model_of(int k)
{
  gg_scene s = md_scene(cases[k].scene);
  if (cases[k].species > 1) {
    s.n_species = 2;
    s.species[0].fraction = s.species[1].fraction = 0.5;
    s.species[1].diameter = 0.9;
  }
  return md_model_of(&s);
}

/* An engine with cells wider than it would choose, so that many are overfull. */
static gg_md *create(const gg_model *m, double width, bool small)
{
  gg_md *e = md_create(m, 3);
  gg_error err;
  int32_t n[3];
  gg_md_cells_count(&e->box, width * gg_md_reach(m), n);
  gg_md_cells_free(&e->cells);
  assert_int_equal(small ? gg_md_cells_make_small(&e->cells, &e->box, n, gg_md_reach(m), e->n, &err)
                         : gg_md_cells_make(&e->cells, &e->box, n, gg_md_reach(m), &err),
                   GG_OK);
  if (gg_md_search_has_rows(e->search.kind)) {
    free(e->search.rows.row - 1);
    assert_int_equal(gg_md_make_rows(e, &err), GG_OK);
    gg_md_align_rows(e);
  }
  assert_int_equal(gg_md_begin(e, &err), GG_OK);
  return e;
}

static uint32_t overfull(const gg_md *e)
{
  uint32_t n = 0;
  const size_t total = (size_t)e->cells.n[0] * (size_t)e->cells.n[1] * (size_t)e->cells.n[2];
  for (size_t k = 0; k < total; k++) n += e->cells.cell[k * e->cells.stride] > GG_MD_SIDE_BY_SIDE;
  return n;
}

static uint64_t run(const gg_model *m, int k, bool small, const gg_md_kernel *kernel)
{
  gg_md *e = create(m, cases[k].width, small);
  e->plain = !kernel;
  gg_md_select(e);
  if (kernel) e->kernel = kernel;
  md_collide(e, COLLISIONS);
  const uint64_t h = md_hash_all(e);
  assert_int_equal(md_misplaced(e), 0);
  assert_true(overfull(e) > 10);
  md_destroy(e);
  return h;
}

static void small_cells_leave_all_bits(void **state)
{
  (void)state;
  for (int k = 0; k < CASES; k++) {
    gg_model m = model_of(k);
    const uint64_t plain = run(&m, k, false, NULL);
    if (run(&m, k, true, NULL) != plain) fail_msg("case %d, plain path", k);
    const bool sheared = m.shear_rate != 0;
    for (gg_instructions set = GG_BASELINE; set < GG_INSTRUCTION_SETS; set++) {
      if (!gg_simd_instructions_run_here(set)) continue;
      const gg_md_kernel *simd = gg_md_simd_kernel(set, sheared ? GG_MD_COMOVING_ROWS : GG_MD_PLAIN_CELLS,
                                                   sheared ? GG_MD_SHEARED : GG_MD_PERIODIC, m.n_species > 1);
      if (run(&m, k, true, simd) != plain || run(&m, k, false, simd) != plain)
        fail_msg("case %d, %s", k, gg_simd_instructions_name(set));
    }
  }
}

/* Threads leave all bits. Events in overfull cells are rolled back; a window in which a cell gets full is given up. */
static void small_cells_leave_all_bits_to_threads(void **state)
{
  (void)state;
  uint64_t rolled_back = 0, cancelled = 0;
  for (int k = 0; k < CASES; k++) {
    gg_model m = model_of(k);
    uint64_t serial = 0;
    for (int threads = 1; threads <= 4; threads++) {
      if (!getenv("NIGHTLY") && threads > 1 && threads != 2 + k % 3) continue; /* daily one number beside one */
      gg_md *e = create(&m, cases[k].width, true);
      gg_md_use_threads(e, threads, false);
      md_collide(e, 3 * COLLISIONS);
      const uint64_t h = md_hash_all(e);
      serial = threads == 1 ? h : serial;
      if (h != serial) fail_msg("case %d, %d threads", k, threads);
      assert_int_equal(e->cells.stride, cases[k].grow ? 16 : 4);
      if (threads > 1) {
        rolled_back += e->parallel->counts.rolled_back;
        cancelled += e->parallel->counts.cancelled;
      }
      md_destroy(e);
    }
  }
  assert_true(rolled_back > 100 && cancelled > 0);
}

/* A restored run has small cells if the engine chooses them. */
static void restored_runs_have_small_cells(void **state)
{
  (void)state;
  gg_model m = md_model((md_case){GG_HCS, 30000, 0.3, 0.8, -1, INFINITY, {0}}),
           few = md_model((md_case){GG_HCS, 29999, 0.3, 0.8, -1, INFINITY, {0}});
  assert_false(gg_md_has_small_cells(&few, GG_MD_PLAIN_CELLS));
  gg_md *e = md_create(&m, 3);
  gg_archive archive = {0};
  gg_error err;
  gg_engine *back = NULL;
  gg_md_use_threads(e, 2, false);
  md_collide(e, COLLISIONS);
  assert_int_equal(e->cells.stride, GG_MD_SMALL_CELL);
  assert_int_equal(gg_md_save(&e->base, &archive, &err), GG_OK);
  assert_int_equal(gg_md_restore(&m, &archive, &back, &err), GG_OK);
  gg_base_archive_clear(&archive);
  gg_md *again = (gg_md *)back;
  assert_int_equal(again->cells.stride, GG_MD_SMALL_CELL);
  gg_md_use_threads(e, 3, false);
  md_collide(e, COLLISIONS);
  md_collide(again, COLLISIONS);
  assert_int_equal(md_hash(e), md_hash(again));
  md_destroy(e);
  md_destroy(again);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(small_cells_hold_what_is_put_in), cmocka_unit_test(small_cells_leave_all_bits),
      cmocka_unit_test(small_cells_leave_all_bits_to_threads), cmocka_unit_test(restored_runs_have_small_cells)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
