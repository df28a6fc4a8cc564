/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Proves: SIMD kernels give the bits of the plain path on every boundary and with every instruction set; every
 * neighbour search has its kernels; cells may have more candidates than a kernel's buffer. */
#include <stdlib.h>

#include "md_test.h"

#include "md/event_loops.h"
#include "scene/scene.h"

static const int species[] = {1, 2, GG_MAX_SPECIES};
enum { MIXTURES = sizeof species / sizeof *species };

/* Flows with every boundary: resting and moving walls, gravity across walls and along them. */
static const struct {
  gg_flow flow;
  enum gg_md_boundary boundary;
  double gravity[2];
} flows[] = {{GG_HCS, GG_MD_PERIODIC, {0}},
             {GG_USF, GG_MD_SHEARED, {0}},
             {GG_FOURIER, GG_MD_WALLED, {0}},
             {GG_COUETTE, GG_MD_WALLED, {0}},
             {GG_CHUTE, GG_MD_FALLING, {0, -0.01}},
             {GG_CHUTE, GG_MD_FALLING, {0.005, -0.01}},
             {GG_POISEUILLE, GG_MD_FALLING, {0.005, 0}}};
enum { FLOWS = sizeof flows / sizeof *flows, BOUNDARIES = GG_MD_FALLING + 1 };

static gg_scene scene_of(int flow, int mixture)
{
  gg_scene s = md_scene((md_case){flows[flow].flow, 1500, 0.12, 0.9, 0.3, INFINITY, {0}});
  if (flows[flow].boundary == GG_MD_FALLING)
    for (int a = 0; a < 2; a++) s.gravity[a] = flows[flow].gravity[a];
  s.n_species = species[mixture];
  for (int i = 0; i < s.n_species; i++) {
    s.species[i].fraction = 1.0 / s.n_species;
    if (i) s.species[i].diameter = 0.8 + 0.015 * (i - 1);
  }
  return s;
}

static uint64_t run_with(const gg_model *m, const gg_md_kernel *kernel)
{
  gg_md *e = md_create(m, 3);
  e->plain = kernel == NULL;
  gg_md_select(e);
  if (kernel) e->kernel = kernel;
  md_collide(e, 20000);
  uint64_t hash = md_hash(e);
  md_destroy(e);
  return hash;
}

static void simd_leaves_the_plain_bits(void **state)
{
  (void)state;
  for (int flow = 0; flow < FLOWS; flow++)
    for (int mixture = 0; mixture < MIXTURES; mixture++) {
      gg_scene s = scene_of(flow, mixture);
      gg_model m = md_model_of(&s);
      const gg_md_kernel *simd = gg_md_simd_kernel(
          gg_simd_instructions_best(), flows[flow].boundary == GG_MD_SHEARED ? GG_MD_COMOVING_ROWS : GG_MD_PLAIN_CELLS,
          flows[flow].boundary, mixture > 0);
      if (run_with(&m, NULL) != run_with(&m, simd)) fail_msg("flow %d, species %d", flow, species[mixture]);
    }
}

static void instruction_sets_agree(void **state)
{
  (void)state;
  static const double phi[] = {[GG_MD_PLAIN_CELLS] = 0.1,
                               [GG_MD_NEIGHBOUR_LISTS] = 0.45,
                               [GG_MD_OVERLAPPING_CELLS] = 0.01,
                               [GG_MD_OVERLAPPING_ROWS] = 0.01,
                               [GG_MD_COMOVING_ROWS] = 0.1};
  for (int flow = 0; flow < FLOWS; flow++)
    for (gg_md_search_kind kind = GG_MD_PLAIN_CELLS; kind < GG_MD_SEARCH_KINDS; kind++)
      for (int mixture = 0; mixture < MIXTURES; mixture++) {
        if (!gg_md_simd_kernel(gg_simd_instructions_best(), kind, flows[flow].boundary, mixture > 0)) continue;
        gg_scene s = scene_of(flow, mixture);
        s.particles = 700, s.phi = phi[kind], s.aspect[0] = 2;
        gg_model m = md_model_of(&s);
        double radius;
        int32_t n[3];
        if (gg_md_search_select(&m, &radius, n) !=
            kind) { /* not lists in flows along walls, not small cells over a floor */
          const bool flows_along = flows[flow].flow == GG_COUETTE || m.gravity[0] != 0;
          assert_true(m.walled && (kind == GG_MD_NEIGHBOUR_LISTS ? flows_along : m.gravity[1] != 0));
          continue;
        }
        uint64_t hash = 0;
        for (gg_instructions set = GG_BASELINE; set < GG_INSTRUCTION_SETS; set++) {
          if (!gg_simd_instructions_run_here(set)) continue;
          uint64_t its = run_with(&m, gg_md_simd_kernel(set, kind, flows[flow].boundary, mixture > 0));
          if (hash && its != hash)
            fail_msg("%s, search %d, flow %d, species %d", gg_simd_instructions_name(set), (int)kind, flow,
                     species[mixture]);
          hash = its;
        }
      }
}

/* Whatever search is chosen, every compiled set of instructions has kernels for it. Only sheared boxes too small for
 * co-moving rows have none and take the plain path. */
static void every_search_has_its_kernels(void **state)
{
  (void)state;
  static const double phi[] = {0.001, 0.03, 0.06, 0.2, 0.3, 0.42, 0.55};
  static const int64_t sizes[] = {40, 300, 3000};
  unsigned chosen[BOUNDARIES] = {0};
  for (int flow = 0; flow < FLOWS; flow++)
    for (int k = 0; k < 7 * 3 * 2 * 2; k++) {
      const int mixture = k % 2;
      gg_scene s = scene_of(flow, mixture);
      s.phi = phi[k / 4 % 7], s.particles = sizes[k / 28], s.aspect[0] = k / 2 % 2 ? 2 : 1;
      gg_model m = md_model_of(&s);
      double radius;
      int32_t n[3];
      const gg_md_search_kind kind = gg_md_search_select(&m, &radius, n);
      const bool plain = flows[flow].boundary == GG_MD_SHEARED && kind == GG_MD_PLAIN_CELLS;
      chosen[flows[flow].boundary] |= 1u << kind;
      for (gg_instructions set = GG_BASELINE; set < GG_INSTRUCTION_SETS; set++)
        if (gg_simd_instructions_run_here(set) &&
            !gg_md_simd_kernel(set, kind, flows[flow].boundary, mixture > 0) != plain)
          fail_msg("%s, search %d, flow %d", gg_simd_instructions_name(set), (int)kind, flow);
      if (!plain || gg_md_ops.accepts(&m, NULL) != GG_OK) continue;
      gg_md *e = md_create(&m, 1);
      md_collide(e, 100);
      assert_int_equal(md_misplaced(e), 0);
      md_destroy(e);
    }
  const unsigned cells = 1 << GG_MD_PLAIN_CELLS, lists = 1 << GG_MD_NEIGHBOUR_LISTS,
                 rows = 1 << GG_MD_COMOVING_ROWS | 1 << GG_MD_OVERLAPPING_ROWS;
  assert_int_equal(chosen[GG_MD_PERIODIC], cells | lists | 1 << GG_MD_OVERLAPPING_CELLS);
  assert_int_equal(chosen[GG_MD_SHEARED], cells | lists | rows);
  assert_int_equal(chosen[GG_MD_WALLED], cells | lists | 1 << GG_MD_OVERLAPPING_CELLS);
  assert_int_equal(chosen[GG_MD_FALLING], cells | lists | 1 << GG_MD_OVERLAPPING_CELLS);
}

/* An engine with n^3 overlapping cells and all grains in a corner of the box. */
static gg_md *create_huddle(const gg_model *m, int32_t n)
{
  gg_md *e = md_create(m, 3);
  gg_error err;
  assert_true(gg_md_search_overlaps(e->search.kind));
  for (uint32_t i = 0; i < e->n; i++)
    e->grain[i].r = (gg_vec){1 + 1.2 * (i % 15), 1 + 1.2 * (i / 15 % 15), 1 + 1.2 * (i / 225)};
  gg_md_cells_free(&e->cells);
  assert_int_equal(gg_md_cells_make(&e->cells, &e->box, (int32_t[3]){n, n, n}, gg_md_reach(m), &err), GG_OK);
  if (e->search.kind == GG_MD_OVERLAPPING_ROWS) {
    free(e->search.rows.row - 1);
    assert_int_equal(gg_md_make_rows(e, &err), GG_OK);
    gg_md_align_rows(e);
  }
  assert_int_equal(gg_md_begin(e, &err), GG_OK);
  return e;
}

/* In overfull cells a grain has more candidates than the buffer holds. Kernels try them in parts, and the same pairs
 * collide as in smaller cells. */
static void crowds_are_tried_in_parts(void **state)
{
  (void)state;
  for (int sheared = 0; sheared < 2; sheared++) {
    gg_model m = md_model((md_case){sheared ? GG_USF : GG_HCS, 3000, 0.0009, 0.9, 0, INFINITY, {0}});
    gg_md *e = create_huddle(&m, 24), *crowded = create_huddle(&m, 6);
    assert_int_equal(crowded->search.kind == GG_MD_OVERLAPPING_ROWS, sheared);
    assert_true(crowded->cells.cell[0] > GG_MD_MOST_CANDIDATES);
    double time = md_collide(e, 2000);
    assert_true(fabs(md_collide(crowded, 2000) - time) < 1e-9 * time);
    for (uint32_t i = 0; i < e->n; i++) assert_int_equal(e->grain[i].counter, crowded->grain[i].counter);
    md_destroy(e);
    md_destroy(crowded);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(simd_leaves_the_plain_bits), cmocka_unit_test(instruction_sets_agree),
      cmocka_unit_test(every_search_has_its_kernels), cmocka_unit_test(crowds_are_tried_in_parts)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
