/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The verdict over a grid: z-scores of pure chance pass, in ninety grids. A shift, a width and a single value beyond
 * chance fail. Rows that are not tested do not count. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>

#include <cmocka.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "graingas.h"

#include "sweep/agreement.h"

enum { POINTS = 36, QUANTITIES = 3 };
static const char grid[] = "flow: usf\nphi: 0.1\nvary:\n - {phi: [0.01, 0.05, 0.1, 0.2, 0.3, 0.5]}\n"
                           " - {collision.e: [0.5, 0.6, 0.7, 0.8, 0.9, 0.99]}\nsweep: {does: compare}\n";
static const char *const quantities[QUANTITIES] = {"temperature", "pressure", "N1"};

typedef struct plan {
  double shift, width, single; /* of the temperature's z */
  bool unsteady;
  const char *reference;
} plan;

/* Student's t with 15 degrees of freedom, as of errors from sixteen blocks. */
static double draw(unsigned short seed[3])
{
  double normal[16], sum = 0, squares = 0;
  for (int i = 0; i < 16; i++) {
    normal[i] = sqrt(-2 * log(1 - erand48(seed))) * cos(2 * M_PI * erand48(seed));
    sum += normal[i];
  }
  for (int i = 0; i < 16; i++) squares += (normal[i] - sum / 16) * (normal[i] - sum / 16);
  return sum / sqrt(16 * squares / 15);
}

static gg_agreement judge(const plan *p, unsigned short seed)
{
  gg_error err;
  gg_sweep *sweep;
  gg_grid_view view;
  gg_agreement a;
  static gg_point_row row[POINTS * QUANTITIES];
  unsigned short stream[3] = {seed, 41, 7};
  assert_int_equal(gg_sweep_parse(grid, "grid", &sweep, &err), GG_OK);
  assert_int_equal(gg_sweep_check(sweep, &err), GG_OK);
  for (size_t i = 0; i < POINTS * QUANTITIES; i++) {
    const bool first = i % QUANTITIES == 0;
    double z = draw(stream);
    if (first) z = z * p->width + p->shift;
    if (i == 0 && p->single != 0) z = p->single;
    row[i] = (gg_point_row){.point = i / QUANTITIES,
                            .method = "dsmc",
                            .quantity = quantities[i % QUANTITIES],
                            .reference = p->reference,
                            .steady = !p->unsteady,
                            .z = z};
  }
  const gg_point_table table = {.n = POINTS * QUANTITIES, .row = row, .n_documents = POINTS};
  assert_int_equal(gg_sweep_grid_view_make(&view, &table, sweep, &err), GG_OK);
  assert_int_equal(view.n_panels, 1);
  assert_true(view.x.n == 6 && view.y.n == 6 && strcmp(view.x.key, "phi") == 0);
  assert_true(gg_sweep_grid_point(&view, 0, 2, 5) == 17);
  gg_sweep_agreement_make(&a, &view);
  gg_sweep_grid_view_clear(&view);
  gg_sweep_free(sweep);
  return a;
}

static void test_chance(void **state)
{
  (void)state;
  for (unsigned short seed = 1; seed <= 90; seed++) {
    const gg_agreement a = judge(&(plan){0, 1, 0, false, "enskog_hermite"}, seed);
    assert_true(a.n == QUANTITIES && a.n_points == POINTS && a.n_values == POINTS * QUANTITIES);
    assert_false(a.fails);
  }
}

static void test_beyond_chance(void **state)
{
  (void)state;
  const plan shifted = {1.2, 1, 0, false, "enskog_hermite"}, wide = {0, 2.2, 0, false, "enskog_hermite"},
             single = {0, 1, -12, false, "enskog_hermite"};
  const plan *const plans[] = {&shifted, &wide, &single};
  for (int k = 0; k < 3; k++)
    for (unsigned short seed = 1; seed <= 10; seed++) {
      const gg_agreement a = judge(plans[k], seed);
      assert_true(a.fails && a.row[0].scores.fails && !a.row[1].scores.fails && !a.row[2].scores.fails);
    }
}

static void test_left_out(void **state)
{
  (void)state;
  const gg_agreement moving = judge(&(plan){5, 1, 0, true, "enskog_hermite"}, 1),
                     other = judge(&(plan){5, 1, 0, false, "dsmc"}, 1);
  assert_true(!moving.fails && moving.n_values == 0 && moving.unsteady == POINTS && moving.unanswered == 0);
  assert_true(!other.fails && other.n_values == 0 && other.unanswered == POINTS);
}

int main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_chance), cmocka_unit_test(test_beyond_chance),
                                     cmocka_unit_test(test_left_out)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
