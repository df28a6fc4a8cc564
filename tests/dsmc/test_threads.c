/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The number of threads changes no bit: the same seed leaves the same ensemble, sums, counts and streams with one
 * thread, two, three or more than there are pairs of segments, whatever the scene; also if a run is saved and continued
 * with another number. */
#include "dsmc/dsmc.h"
#include "lab.h"

enum { LARGE = 64003 }; /* from 64000 grains on ensembles are in segments; the last block is not full */

static void same(const gg_archive *a, const gg_archive *b)
{
  assert_int_equal(a->n_items, b->n_items);
  for (size_t i = 0; i < a->n_items; i++) {
    size_t bytes = a->items[i].count * gg_base_archive_item_size(a->items[i].type);
    assert_int_equal(bytes, b->items[i].count * gg_base_archive_item_size(b->items[i].type));
    if (memcmp(a->items[i].data, b->items[i].data, bytes) != 0) fail_msg("%s differs", a->items[i].name);
  }
}

static void save(gg_engine *g, gg_archive *a)
{
  gg_error err = {0};
  if (gg_dsmc_ops.save(g, a, &err) != GG_OK) fail_msg("%s", err.message);
}

/* The number of threads changes during the run; 0 leaves it as it is. */
static gg_archive outcome(const gg_model *m, int first, int then)
{
  gg_engine *g = lab_engine(m, 3);
  gg_archive a = {0};
  if (first) gg_dsmc_ops.threads(g, first);
  assert_int_equal(((gg_dsmc *)g)->ensemble.segments, 8);
  assert_true((((gg_dsmc *)g)->ensemble.pool != NULL) == (first > 1));
  lab_advance(g, INFINITY, (uint64_t)m->n);
  if (then) gg_dsmc_ops.threads(g, then);
  lab_advance(g, INFINITY, (uint64_t)m->n / 2);
  save(g, &a);
  gg_dsmc_ops.destroy(g);
  return a;
}

static void same_bits_on(const gg_model *m)
{
  const int threads[][2] = {{0, 0}, {1, 2}, {2, 0}, {3, 0}, {64, 3}};
  gg_archive first = {0};
  for (int i = 0; i < 5; i++) {
    gg_archive a = outcome(m, threads[i][0], threads[i][1]);
    if (i) same(&first, &a);
    if (i)
      gg_base_archive_clear(&a);
    else
      first = a;
  }
  gg_base_archive_clear(&first);
}

/* The same with three species. */
static void threads_leave_the_same_bits_of_three_species(void **state)
{
  (void)state;
  const gg_flow flows[] = {GG_HCS, GG_USF, GG_HSS};
  for (int flow = 0; flow < 3; flow++) {
    gg_scene s = lab_scene(flows[flow], 0.2, 0.8, flow == 1 ? 0.3 : -1, LARGE);
    s.n_species = 3;
    s.species[0].fraction = 0.4;
    s.species[1] = (gg_species){0.3, 0.7, 2, 0.3, 1, 0};
    s.species[2] = (gg_species){0.3, 1.2, 0.5, 0.4, 1, 0};
    gg_model m = lab_model(&s);
    same_bits_on(&m);
  }
}

/* The number of threads changes no bits, with each rule, flow, thermostat and precision, dilute and dense; with one
 * species, two, and two of which one is too small for segments. */
static void threads_leave_the_same_bits(void **state)
{
  (void)state;
  const double beta[] = {-1, 0.3, 0.3}, mu[] = {INFINITY, INFINITY, 0.2};
  const gg_flow flows[] = {GG_HCS, GG_USF, GG_HSS, GG_HSS};
  for (int rule = 0; rule < 3; rule++)
    for (int dense = 0; dense < 2; dense++)
      for (int flow = 0; flow < 4; flow++)
        for (int species = 1; species <= 3; species++) {
          gg_scene s = lab_scene(flows[flow], dense ? 0.3 : 0, 0.8, beta[rule], LARGE);
          s.collision.mu[0] = s.collision.mu[1] = mu[rule];
          if (flow == 3) s.thermostat = GG_WHITE_NOISE;
          s.dsmc.precision = (rule + dense + flow + species) % 2 ? GG_SINGLE : GG_DOUBLE;
          s.n_species = species > 1 ? 2 : 1;
          s.species[0] = (gg_species){species == 3 ? 0.03 : 0.4, 1, 1, 0.4, 1, 0};
          s.species[1] = (gg_species){species == 3 ? 0.97 : 0.6, 0.7, 2, 0.3, 1, 0};
          gg_model m = lab_model(&s);
          same_bits_on(&m);
        }
}

/* Two threads leave the same bits with every set of instructions that runs here. In single precision all sets have the
 * rule of rough grains. */
static void same_bits_of(gg_precision precision)
{
  gg_scene s = lab_scene(GG_USF, 0.2, 0.8, precision == GG_SINGLE ? 0.3 : -1, LARGE);
  s.dsmc.precision = precision;
  gg_model m = lab_model(&s);
  gg_archive first = {0};
  for (gg_instructions set = GG_BASELINE; set < GG_INSTRUCTION_SETS; set++) {
    if (!gg_simd_instructions_run_here(set)) continue;
    gg_engine *g = lab_engine(&m, 3);
    gg_archive a = {0};
    ((gg_dsmc *)g)->ensemble.kernels = gg_dsmc_kernels_for(set);
    gg_dsmc_ops.threads(g, 2);
    lab_advance(g, INFINITY, (uint64_t)m.n);
    save(g, &a);
    gg_dsmc_ops.destroy(g);
    if (first.n_items) {
      same(&first, &a);
      gg_base_archive_clear(&a);
    } else {
      first = a;
    }
  }
  gg_base_archive_clear(&first);
}

static void instructions_leave_the_same_bits(void **state)
{
  (void)state;
  same_bits_of(GG_DOUBLE);
  same_bits_of(GG_SINGLE);
}

/* Saved with two threads, continued with one, two and three. */
static void resumes_with_other_threads(void **state)
{
  (void)state;
  for (int species = 1; species <= 3; species++) {
    gg_scene s = lab_scene(GG_USF, 0.3, 0.8, 0.2, LARGE);
    s.n_species = species;
    for (int i = 1; i < species; i++) s.species[i] = (gg_species){1, 0.7, 2.0 / i, 0.3, 1, 0};
    gg_model m = lab_model(&s);
    gg_engine *straight = lab_engine(&m, 11);
    gg_error err = {0};
    gg_archive half = {0}, end = {0};
    gg_dsmc_ops.threads(straight, 2);
    lab_advance(straight, INFINITY, (uint64_t)m.n / 3);
    save(straight, &half);
    lab_advance(straight, INFINITY, (uint64_t)m.n);
    save(straight, &end);
    for (int threads = 1; threads <= 3; threads++) {
      gg_engine *resumed = NULL;
      gg_archive a = {0};
      if (gg_dsmc_ops.restore(&m, &half, &resumed, &err) != GG_OK) fail_msg("%s", err.message);
      gg_dsmc_ops.threads(resumed, threads);
      lab_advance(resumed, INFINITY, (uint64_t)m.n);
      save(resumed, &a);
      same(&end, &a);
      gg_base_archive_clear(&a);
      gg_dsmc_ops.destroy(resumed);
    }
    gg_base_archive_clear(&half);
    gg_base_archive_clear(&end);
    gg_dsmc_ops.destroy(straight);
  }
}

/* An ensemble one block too small for segments has one segment, and no threads are started. */
static void small_ensembles_start_no_threads(void **state)
{
  (void)state;
  gg_scene s = lab_scene(GG_HCS, 0.1, 0.8, -1, 63992);
  gg_model m = lab_model(&s);
  gg_engine *g = lab_engine(&m, 5);
  gg_dsmc *d = (gg_dsmc *)g;
  gg_archive a = {0};
  gg_dsmc_ops.threads(g, 4);
  assert_int_equal(d->ensemble.segments, 1);
  assert_null(d->ensemble.pool);
  assert_null(d->schedule);
  save(g, &a);
  assert_null(gg_base_archive_find(&a, "dsmc/schedule"));
  gg_base_archive_clear(&a);
  gg_dsmc_ops.destroy(g);
}

static void find_segments(void *context, const char *text)
{
  *(bool *)context |= strstr(text, "in 8 segments, which threads share") != NULL;
}

/* The description of a scene (`graingas info`) says whether there are segments. */
static void segments_are_described(void **state)
{
  (void)state;
  for (int large = 0; large < 2; large++) {
    gg_scene s = lab_scene(GG_HCS, 0.1, 0.8, -1, large ? 64000 : 63992);
    gg_model m = lab_model(&s);
    bool found = false;
    gg_dsmc_ops.describe(&m, find_segments, &found);
    assert_int_equal(found, large);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test(segments_are_described),
                                     cmocka_unit_test(small_ensembles_start_no_threads),
                                     cmocka_unit_test(resumes_with_other_threads),
                                     cmocka_unit_test(instructions_leave_the_same_bits),
                                     cmocka_unit_test(threads_leave_the_same_bits_of_three_species),
                                     cmocka_unit_test(threads_leave_the_same_bits)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
